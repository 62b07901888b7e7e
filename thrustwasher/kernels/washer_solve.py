"""One washer solve with memory: warm where it can be, on the branch that the history asks for."""

import numpy as np
from numpy.typing import NDArray

from ._jit import inlined, kernel
from .washer_branch import (
    ANY,
    BRANCH,
    CONTACT_BRANCH,
    FILM_BRANCH,
    FILM_RATIO,
    MULTIPLE,
    MULTIPLICITY,
    NO_BRANCH,
    SINGLE,
    descend,
    is_clear_film,
    solve_cold,
)  # fmt: skip
from .washer_fields import Bench, Point, forget_factor
from .washer_memory import (
    BRANCH_NOW,
    MULTIPLICITY_NOW,
    RATIO_THEN,
    SCAN_OIL,
    SCAN_SPEED,
    SCAN_TILT,
    VALID,
    recall_state,
    remember_state,
)  # fmt: skip
from .washer_model import SIGMA1
from .washer_newton import (
    ARRIVED,
    FACTORED,
    ITERATIONS,
    LOAD,
    LOAD_SLOPE,
    NO_FLOOR,
    OK,
    REACHED_LOAD,
    SCANNED,
    factor_here,
    film_ratio,
    newton,
)  # fmt: skip

WARM_TOLERANCE = 5e-6
CONTINUOUS = 0.2  # a film ratio that moves by less has stayed on its branch


@kernel
def scan_holds(pt: Point, state: NDArray[np.float64]) -> bool:
    """Tell if the last descent was at about this speed, tilt and oil temperature."""
    return bool(
        state[SCAN_TILT] >= 0.0
        and abs(pt.speed - state[SCAN_SPEED]) <= 0.05 * abs(state[SCAN_SPEED])
        and abs(pt.tilt - state[SCAN_TILT]) <= 0.05 * state[SCAN_TILT]
        and abs(pt.oil_temperature - state[SCAN_OIL]) <= 3.0
    )


@inlined
def _warm(
    b: Bench, pt: Point, wanted: float, state: NDArray[np.float64], q: NDArray[np.float64],
    info: NDArray[np.float64], found: NDArray[np.float64],
) -> bool:  # fmt: skip
    """Solve from the remembered solution; return True if it arrived on the remembered branch."""
    branch = state[BRANCH_NOW]
    if branch == 0.0 or (wanted != ANY and wanted != branch):
        return False
    if newton(b, pt, LOAD, pt.load, q, NO_FLOOR, WARM_TOLERANCE, 12.0, info) != OK:
        return False
    found[BRANCH], found[MULTIPLICITY] = branch, state[MULTIPLICITY_NOW]
    if branch == FILM_BRANCH and is_clear_film(b, q, info):
        return True
    ratio = film_ratio(b, q)
    if abs(ratio - state[RATIO_THEN]) > CONTINUOUS or not scan_holds(pt, state):
        return False
    if info[LOAD_SLOPE] * b.par[SIGMA1] > -0.3 * info[REACHED_LOAD]:
        # a fold may be near: the slope is needed with a heat factor made here
        forget_factor(b)
        if newton(b, pt, LOAD, pt.load, q, NO_FLOOR, WARM_TOLERANCE, 12.0, info) != OK:
            return False
        if not info[LOAD_SLOPE] < 0.0 or abs(film_ratio(b, q) - ratio) > 0.5 * CONTINUOUS:
            return False
    if found[MULTIPLICITY] == SINGLE:
        found[BRANCH] = FILM_BRANCH if film_ratio(b, q) >= FILM_RATIO else CONTACT_BRANCH
    return True


@inlined
def solve(
    b: Bench, pt: Point, wanted: float, state: NDArray[np.float64], q: NDArray[np.float64],
    info: NDArray[np.float64], found: NDArray[np.float64], walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve at ``pt``; return a status. The solution is in ``q`` and ``f``, evaluated.

    Parameters
    ----------
    wanted : ANY (the remembered branch while it exists, else the other; without memory the film
        branch up to its fold), FILM_BRANCH or CONTACT_BRANCH
    found : out, branch and multiplicity (see washer_branch)
    """
    info[ITERATIONS], info[FACTORED] = 0.0, 0.0
    scanned = False
    arrived = False
    status = OK
    if state[VALID] == 1.0:
        recall_state(b, state, q)
        arrived = _warm(b, pt, wanted, state, q, info, found)
        if not arrived:
            before = state[BRANCH_NOW]
            if wanted == ANY and before == CONTACT_BRANCH:
                status = descend(b, pt, CONTACT_BRANCH, q, info, found, walk)
                if status == NO_BRANCH:
                    status = OK
                scanned = True
    if not arrived and not scanned:
        status = solve_cold(b, pt, wanted, q, info, found, walk)
        scanned = found[MULTIPLICITY] != 0.0
    info[ARRIVED] = 1.0 if arrived else 0.0
    info[SCANNED] = 1.0 if scanned else 0.0
    return status


@inlined
def keep_solution(
    b: Bench, pt: Point, q: NDArray[np.float64], info: NDArray[np.float64],
    found: NDArray[np.float64], state: NDArray[np.float64],
) -> None:  # fmt: skip
    """Write what ``solve`` has found to ``state``."""
    if info[ARRIVED] == 0.0:  # a factor made here makes the next, warm solve quick
        factor_here(b, pt, q)
    remember_state(b, pt, q, state)
    state[BRANCH_NOW], state[MULTIPLICITY_NOW] = found[BRANCH], found[MULTIPLICITY]
    state[RATIO_THEN] = film_ratio(b, q)
    if info[SCANNED] != 0.0:
        state[SCAN_SPEED], state[SCAN_TILT] = pt.speed, pt.tilt
        state[SCAN_OIL] = pt.oil_temperature
    elif info[ARRIVED] == 0.0:
        state[SCAN_TILT] = -1.0


@kernel
def is_distressed(found: NDArray[np.float64], mean_rise: float) -> bool:
    """Tell if the film is lost: contact branch of a multivalued curve, or 200 K mean rise."""
    lost = found[BRANCH] == CONTACT_BRANCH and found[MULTIPLICITY] == MULTIPLE
    return lost or not mean_rise <= 200.0
