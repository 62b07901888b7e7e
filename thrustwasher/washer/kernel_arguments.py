"""What the washer's kernels take: constants of parameters and mesh, memory kept by each thread."""

import threading
from functools import lru_cache

import numpy as np

from ..errors import ParameterError, Status
from ..model.parameters import as_numbers
from ..numerics.jit import Array
from .kernels import layout as L
from .kernels.constants import derive_grid, size_of_par
from .parameters import WasherParams

NO_MESH = (0, 0)  # of what was looked up
_local = threading.local()


@lru_cache(maxsize=64)
def constants(params: WasherParams, grid: tuple[int, int], in_time: bool = False) -> Array:
    """Return the kernel's ``par`` for parameters and grid; read only.

    Without ``in_time`` it is for steady solutions, whatever ``params.thermal_mode`` says.

    Raises
    ------
    ParameterError : the asperity contact cannot be tabulated
    """
    par = np.zeros(size_of_par(*grid))
    par[: L.N_PARAM] = [*as_numbers(params), L.FIELD]
    par[L.P_THERMAL_MODE] = L.TRANSIENT if in_time else L.QUASI_STEADY
    status = Status(derive_grid(par, *grid))
    if status is not Status.OK:
        raise ParameterError(
            "the asperity contact cannot be tabulated for these parameters; check yield_strength, "
            "youngs_modulus, asperity_radius and asperity_density"
        )
    return par


def work_array(key: tuple[object, ...], size: int) -> Array:
    """Return this thread's array of ``size`` numbers for ``key``; contents are left over."""
    arrays: dict[tuple[object, ...], Array] = _local.__dict__.setdefault("arrays", {})
    if key not in arrays or arrays[key].size != size:
        if len(arrays) >= 8:  # many grids in one program: do not hoard
            arrays.clear()
        arrays[key] = np.zeros(size)
    return arrays[key]
