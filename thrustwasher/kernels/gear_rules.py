"""Rules between the gear mesh's parameters: which of them, taken together, describe no mesh."""

import numpy as np
from numpy.typing import NDArray

from . import gear_layout as L
from ._jit import kernel
from .gear_constants import effective_roughness
from .gear_geometry import path_lengths, slide_roll, start_of_contact

LEAST_EFFECTIVE = 2.143e-5 / 2.873  # the film's term of Li & Seireg's law changes sign there
LARGEST_EFFECTIVE = 0.0864 / 1372.0  # the film has no effect from there on
LEAST_SLIDE_ROLL = 0.27


@kernel
def broken_rule(par: NDArray[np.float64]) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    ratio, teeth = par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH]
    angle, addendum = par[L.P_PRESSURE_ANGLE], par[L.P_ADDENDUM]
    start = start_of_contact(ratio, teeth, angle, addendum)
    if not start > 0.0:
        return 1
    approach, recess = path_lengths(ratio, teeth, angle, addendum, start)
    if not approach + recess >= 1.0:
        return 2
    if par[L.P_FRICTION_LAW] == L.LI_SEIREG:
        s = effective_roughness(par)
        if not LEAST_EFFECTIVE < s < LARGEST_EFFECTIVE:
            return 3
        if not par[L.P_F0] >= 0.0864 - 1372.0 * s:
            return 4
        if not slide_roll(ratio, start) > LEAST_SLIDE_ROLL:
            return 5
    return 0
