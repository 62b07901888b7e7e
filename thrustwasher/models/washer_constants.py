"""From the washer's parameters to what its kernels take: mesh, contact tables, scalars."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, Status
from ..kernels.washer_model import derive_grid, size_of_par
from ._params import as_numbers
from .washer_params import WasherParams

Array = NDArray[np.float64]


@lru_cache(maxsize=64)
def constants(params: WasherParams, grid: tuple[int, int]) -> Array:
    """Return the kernel's ``par`` for parameters and grid; read only.

    Raises
    ------
    ParameterError : the asperity contact cannot be tabulated
    """
    par = np.zeros(size_of_par(*grid))
    numbers = as_numbers(params)
    par[: len(numbers)] = numbers
    par[len(numbers)] = 1.0
    status = Status(derive_grid(par, *grid))
    if status is not Status.OK:
        raise ParameterError(
            "the asperity contact cannot be tabulated for these parameters; check yield_strength, "
            "youngs_modulus, asperity_radius and asperity_density"
        )
    return par
