"""Rules between the transmission's parameters: teeth of no planetary set, a damped rigid shaft."""

import numpy as np
from numpy.typing import NDArray

from . import transmission_layout as L
from ._jit import kernel


@kernel
def broken_rule(par: NDArray[np.float64]) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    sun, planet, ring = par[L.P_SUN_TEETH], par[L.P_PLANET_TEETH], par[L.P_RING_TEETH]
    if not ring > sun:
        return 1
    if planet != 0.0 and not abs(ring - sun - 2.0 * planet) <= 2.0:
        return 2
    if par[L.P_SHAFT_STIFFNESS] == 0.0:
        if par[L.P_SHAFT_DAMPING] != 0.0:
            return 3
        if par[L.P_INITIAL_TWIST] != 0.0:
            return 4
    return 0
