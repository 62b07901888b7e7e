"""What the washer's kernels take: constants of parameters and mesh, memory kept by each thread."""

import threading
from collections.abc import Callable
from functools import lru_cache
from typing import Any, Generic, TypeVar

import numpy as np

from ..errors import ParameterError, Status
from ..model.parameters import as_numbers
from ..numerics.jit import Array
from .kernels import layout as L
from .kernels.constants import derive_grid, size_of_par
from .parameters import WasherParams

NO_MESH = (0, 0)  # of what was looked up
KEPT = 16  # parameter objects
T = TypeVar("T")
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


class Recent(Generic[T]):
    """What ``make(params, *key)`` returned for the last few parameters of this thread.

    The object itself is looked for first, which is quicker than comparing all its fields; one that
    is new and equal finds what was made for the other.
    """

    def __init__(self, make: Callable[..., T]) -> None:
        self.make, self.local = make, threading.local()

    def __call__(self, params: WasherParams, *key: object) -> T:
        """Return what was made for this object, or make it."""
        try:
            known: dict[Any, tuple[Any, T]] = self.local.known
        except AttributeError:
            known, self.local.equal = {}, {}
            self.local.known = known
        found = known.get((id(params), key))
        if found is not None and found[0] is params:
            return found[1]
        equal: dict[Any, T] = self.local.equal
        if len(known) >= KEPT:
            known.clear()
        made = equal.get((params, key))
        if made is None:
            if len(equal) >= KEPT:
                equal.clear()
            made = equal[params, key] = self.make(params, *key)
        known[id(params), key] = params, made
        return made

    def forget(self) -> None:
        """Make all anew: a file that something was made of has changed."""
        self.local = threading.local()
