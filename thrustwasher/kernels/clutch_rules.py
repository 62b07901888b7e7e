"""Rules between the clutch's parameters: which of them, taken together, describe no pack."""

import numpy as np

from . import clutch_layout as L
from ._jit import Array, kernel


@kernel
def broken_rule(par: Array) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    if not par[L.P_INNER_RADIUS] < par[L.P_OUTER_RADIUS]:
        return 1
    if par[L.P_FRICTION_LAW] == L.TABLE_LAW:
        last = 0.0
        for k in range(L.N_TABLE):
            speed = par[np.uintp(L.P_TABLE_SPEED_1 + 2 * k)]
            if not speed > last:
                return 2 + k
            last = speed
    return 0
