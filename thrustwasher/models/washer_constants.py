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
    ParameterError : the parameters admit no surface or no mesh
    """
    par = np.zeros(size_of_par(*grid))
    numbers = as_numbers(params)
    par[: len(numbers)] = numbers
    par[len(numbers)] = 1.0
    status = Status(derive_grid(par, *grid))
    if status is Status.BAD_INPUT:
        raise ParameterError(
            f"asperity_density x asperity_radius = {params.asperity_density:g} 1/m2 x "
            f"{params.asperity_radius:g} m leaves no scatter of the summits at roughness = "
            f"{params.roughness:g} m; raise either, or use asperity_height_law = 'surface'"
        )
    if status is not Status.OK:
        raise ParameterError(
            "the asperity contact cannot be tabulated for these parameters; check yield_strength, "
            "youngs_modulus, asperity_radius and asperity_density"
        )
    return par
