# mypy: disable-error-code="no-any-return"
"""Rules between the washer's parameters: which of them, taken together, describe no washer."""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .washer_model import N_PARAM, THERMAL_MODE, TRANSIENT, _gap_constants, _pair
from .washer_verdict import COARSE

LARGEST_SPREAD = 20.0  # outer over inner radius
LEAST_ROUGHNESS = 1.5e-7  # [m]


@kernel
def _too_smooth(roughness: float) -> bool:
    """Tell if a surface's own roughness is given (not 0) and out of reach."""
    return 0.0 < roughness < LEAST_ROUGHNESS


@kernel
def broken_rule(par: NDArray[np.float64]) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    if not par[0] < par[2] < par[1]:
        return 1
    if not par[1] <= LARGEST_SPREAD * par[0]:
        return 2
    for k in range(3):
        if _too_smooth(par[np.uintp(7 + k)]):
            return 3 + k
    if not par[27] < par[28]:
        return 6
    carrier, washer = _pair(par, 7, 8)
    gear, _ = _pair(par, 9, 8)
    _, _, first = _gap_constants(par, math.sqrt(carrier * carrier + washer * washer))
    _, _, second = _gap_constants(par, math.sqrt(gear * gear + washer * washer))
    if not (first and second):
        return 7
    if par.size >= N_PARAM and par[THERMAL_MODE] == TRANSIENT:  # the fidelity is known
        return 0 if par[N_PARAM - 1] >= COARSE else 8
    return 0
