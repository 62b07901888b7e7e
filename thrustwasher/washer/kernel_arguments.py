"""From the washer's parameters to what its kernels take: mesh, contact tables, scalars."""

from functools import lru_cache

import numpy as np

from ..errors import ParameterError, Status
from ..model.parameters import as_numbers
from ..numerics.jit import Array
from .kernels import layout as L
from .kernels.constants import derive_grid, size_of_par
from .kernels.simple import N_SIMPLE_PAR, derive_simple
from .parameters import WasherParams

NO_MESH = (0, 0)
SIMPLE = {"closed": L.CLOSED, "stribeck": L.STRIBECK}  # rungs without a mesh


@lru_cache(maxsize=64)
def constants(
    params: WasherParams, grid: tuple[int, int], fidelity: str = "field", in_time: bool = False
) -> Array:
    """Return the kernel's ``par`` for parameters and grid, or a rung without one; read only.

    Without ``in_time`` it is for steady solutions, whatever ``params.thermal_mode`` says.

    Raises
    ------
    ParameterError : the asperity contact cannot be tabulated
    """
    simple = fidelity in SIMPLE
    par = np.zeros(N_SIMPLE_PAR if simple else size_of_par(*grid))
    par[: L.N_PARAM] = [*as_numbers(params), SIMPLE.get(fidelity, L.FIELD)]
    par[L.P_THERMAL_MODE] = L.TRANSIENT if in_time else L.QUASI_STEADY
    status = Status(derive_simple(par) if simple else derive_grid(par, *grid))
    if status is not Status.OK:
        raise ParameterError(
            "the asperity contact cannot be tabulated for these parameters; check yield_strength, "
            "youngs_modulus, asperity_radius and asperity_density"
        )
    return par
