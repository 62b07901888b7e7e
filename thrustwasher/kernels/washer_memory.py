"""What a washer remembers between calls, in one flat array; all zeros: nothing yet.

The heat factor is not in it: only the positions and temperatures it was made at. A factor in
``work`` is used if it was made at exactly these, else it is made again, so that results never
depend on what ``work`` happens to hold.
"""

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .washer_fields import N_TAG, RATE, Bench, Fields, Point, temperatures_of, washer_fields
from .washer_gap import evaluate_gaps, evaluate_viscosity
from .washer_model import N_PARAM, washer_model
from .washer_newton import RATE_TAG, make_factor

VALID, BRANCH_NOW, MULTIPLICITY_NOW = 0, 1, 2
LOAD_THEN, SPEED_THEN, TILT_THEN, OIL_THEN = 3, 4, 5, 6  # inputs of the last solution
SCAN_SPEED, SCAN_TILT, SCAN_OIL = 7, 8, 9  # inputs of the last descent; a tilt < 0: none
Q, RATIO_THEN, SHARE_THEN, FACTOR_VALID = 10, 14, 15, 16
FACTOR_SPEED, FACTOR_TILT, FACTOR_OIL, FACTOR_Q = 17, 18, 19, 20
FACTOR_RATE, SUBSTEP = 26, 27  # 24 and 25 belong to the map; the next substep to try [s]
FIELDS = 32  # then temperatures, pressures, temperatures of the factor


def size_of_state(n_r: int, n_t: int) -> int:
    """Return the length of ``state`` for a grid."""
    return FIELDS + 2 * temperatures_of(n_r, n_t) + n_r * n_t


@kernel
def _belongs(par: NDArray[np.float64], state: NDArray[np.float64], f: Fields) -> bool:
    """Tell if the factor in ``f`` was made for these parameters and the remembered fields."""
    t = f.tag
    if not (t[0] == 1.0 and t[1] == state[FACTOR_SPEED] and t[2] == state[FACTOR_TILT]
            and t[7] == state[FACTOR_OIL] and t[RATE_TAG] == state[FACTOR_RATE]):  # fmt: skip
        return False
    for k in range(4):
        if t[3 + k] != state[FACTOR_Q + k]:
            return False
    for k in range(N_PARAM + 3):
        if t[8 + k] != par[k]:
            return False
    n_temp = f.temp.size
    base = FIELDS + n_temp + f.p.size
    for k in range(n_temp):
        if t[np.uintp(N_TAG + k)] != state[np.uintp(base + k)]:
            return False
    return True


@kernel
def recall_state(b: Bench, state: NDArray[np.float64], q: NDArray[np.float64]) -> None:
    """Take the remembered solution and its heat factor into ``q`` and the work."""
    par = b.par
    m = washer_model(par)
    f = washer_fields(m, b.work)
    n_temp, n = f.temp.size, f.p.size
    base = FIELDS + n_temp + n
    if state[FACTOR_VALID] != 1.0:
        f.tag[0] = 0.0
    elif not _belongs(par, state, f):
        pt = Point(1.0, state[FACTOR_SPEED], state[FACTOR_TILT], state[FACTOR_OIL])
        for k in range(4):
            q[k] = state[FACTOR_Q + k]
        for k in range(n_temp):
            f.temp[np.uintp(k)] = state[np.uintp(base + k)]
        evaluate_gaps(m, pt, q, f)
        evaluate_viscosity(m, pt, f)
        rate = f.small[RATE]
        f.small[RATE] = state[FACTOR_RATE]
        make_factor(m, pt, q, f.temp, f)
        f.small[RATE] = rate
        own_factor(par, f)
    for k in range(4):
        q[k] = state[Q + k]
    for k in range(n_temp):
        f.temp[np.uintp(k)] = state[np.uintp(FIELDS + k)]
    for k in range(n):
        f.p[np.uintp(k)] = state[np.uintp(FIELDS + n_temp + k)]


@kernel
def own_factor(par: NDArray[np.float64], f: Fields) -> None:
    """Write into the tag which parameters the factor belongs to."""
    for k in range(N_PARAM + 3):
        f.tag[8 + k] = par[k]


@kernel
def remember_state(b: Bench, pt: Point, q: NDArray[np.float64], state: NDArray[np.float64]) -> None:
    """Write the present solution and where its heat factor was made into ``state``."""
    f = washer_fields(washer_model(b.par), b.work)
    n_temp, n = f.temp.size, f.p.size
    base = FIELDS + n_temp + n
    state[VALID] = 1.0
    state[LOAD_THEN], state[SPEED_THEN] = pt.load, pt.speed
    state[TILT_THEN], state[OIL_THEN] = pt.tilt, pt.oil_temperature
    for k in range(4):
        state[Q + k] = q[k]
    for k in range(n_temp):
        state[np.uintp(FIELDS + k)] = f.temp[np.uintp(k)]
    for k in range(n):
        state[np.uintp(FIELDS + n_temp + k)] = f.p[np.uintp(k)]
    own_factor(b.par, f)
    state[FACTOR_VALID] = f.tag[0]
    state[FACTOR_SPEED], state[FACTOR_TILT] = f.tag[1], f.tag[2]
    state[FACTOR_OIL], state[FACTOR_RATE] = f.tag[7], f.tag[RATE_TAG]
    for k in range(4):
        state[FACTOR_Q + k] = f.tag[3 + k]
    for k in range(n_temp):
        state[np.uintp(base + k)] = f.tag[np.uintp(N_TAG + k)]
