"""Heat in time: what does not leave a body warms it, so that a lost film takes its time.

Carrier, washer and gear store density x specific heat x thickness x area x change of temperature;
film, contacts and positions follow at once. Each substep is implicit, of second order and damps
stiff parts out (two stages with the same coefficient, Alexander 1977, gamma = 1 - 1/sqrt(2)). In a
stage everything is solved for together, as in the steady state, which is the limit of long steps.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import inlined, kernel
from .washer_branch import (
    BRANCH,
    CONTACT_BRANCH,
    DESCENT,
    ENTRY_RATIO,
    FILM_BRANCH,
    FILM_RATIO,
    MULTIPLE,
    MULTIPLICITY,
    NO_BRANCH,
    SINGLE,
    _settle,
    descend,
)  # fmt: skip
from .washer_curve import ACCURACY, S, W, enter_curve, note, recall, remember, walk_down, walk_to
from .washer_fields import RATE, Bench, Point, forget_factor, washer_fields
from .washer_memory import (
    BRANCH_NOW,
    MULTIPLICITY_NOW,
    OIL_THEN,
    SCAN_OIL,
    SCAN_SPEED,
    SCAN_TILT,
    recall_state,
)  # fmt: skip
from .washer_model import SIGMA1, washer_model
from .washer_newton import (
    FILM,
    LOAD,
    MAX_ITERATIONS,
    NO_FLOOR,
    OK,
    RATE_TAG,
    evaluate_here,
    newton,
    smooth_film,
)  # fmt: skip
from .washer_solve import WARM_TOLERANCE, scan_holds

GAMMA = 1.0 - math.sqrt(0.5)
AHEAD = (1.0 - GAMMA) / GAMMA  # share of the first stage's gain that the second starts with
ATOL, RTOL = 0.02, 2e-3  # [K], and of the largest rise: what a substep may be off
HELD = 1e6  # [1/s] storage that lets no temperature move
LOST_SHARE = 0.7  # the film carries more above every fold where it is lost, less where regained
MAX_SUBSTEPS = 20_000


@kernel
def start_cold(b: Bench) -> None:
    """Set all temperatures to the oil's and hold them there."""
    f = washer_fields(washer_model(b.par), b.work)
    f.small[RATE] = HELD
    for k in range(f.past.size):
        f.past[np.uintp(k)] = 0.0


@kernel
def set_rate(b: Bench, rate: float) -> None:
    """Weigh what is stored by ``rate`` [1/s]; 0: nothing is."""
    washer_fields(washer_model(b.par), b.work).small[RATE] = rate


@inlined
def _along_the_film(
    b: Bench, pt: Point, q: NDArray[np.float64], info: NDArray[np.float64],
    walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve for the load by walking in film thickness from where the washer is."""
    sigma = b.par[SIGMA1]
    walk[ACCURACY] = 1e-4
    forget_factor(b)
    status = newton(b, pt, FILM, smooth_film(b, q), q, NO_FLOOR, 1e-4, 40.0, info)
    if status == OK:
        note(b, q, info, walk)
    else:
        status = enter_curve(b, pt, ENTRY_RATIO, q, info, walk)
    if status != OK:
        return status
    rising = walk[W] >= pt.load
    for _ in range(400):
        before = walk[S]
        if rising:
            status = walk_to(b, pt, before + max(0.25 * before, 0.5 * sigma), q, info, walk)
        else:
            status = walk_down(b, pt, DESCENT, q, info, walk)
        if status != OK:
            return status
        if rising and walk[W] < pt.load:
            return _settle(b, pt, walk[S], before, q, info, walk)
        if not rising and walk[W] >= pt.load:
            return _settle(b, pt, before, walk[S], q, info, walk)
    return MAX_ITERATIONS


@inlined
def _arrive(
    b: Bench, pt: Point, q: NDArray[np.float64], info: NDArray[np.float64],
    walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve for the load with the storage as it is set, from the present state.

    A failure leaves the state as it was.
    """
    f = washer_fields(washer_model(b.par), b.work)
    rate = f.small[RATE]
    if not abs(f.tag[RATE_TAG] - rate) <= 0.3 * rate:
        forget_factor(b)
    remember(b, q, 2.0)
    status = newton(b, pt, LOAD, pt.load, q, NO_FLOOR, WARM_TOLERANCE, 12.0, info)
    if status != OK:
        recall(b, q, 2.0)
        status = _along_the_film(b, pt, q, info, walk)
    if status != OK:
        recall(b, q, 2.0)
        forget_factor(b)
    return status


@kernel
def _set_stage(b: Bench, stage: int) -> None:
    """Set what the stage's storage counts from, and a guess of where it ends."""
    f = washer_fields(washer_model(b.par), b.work)
    for k in range(f.temp.size):
        start = f.begin[np.uintp(k)]
        gain = f.temp[np.uintp(k)] - start
        f.past[np.uintp(k)] = start
        if stage == 1:
            f.past[np.uintp(k)] += AHEAD * gain
            f.temp[np.uintp(k)] = f.past[np.uintp(k)] + gain


@kernel
def _error(b: Bench) -> float:
    """Return the error of both stages over what a substep may be off.

    The stages' rates of temperature differ by what a method of first order would be off.
    """
    f = washer_fields(washer_model(b.par), b.work)
    error, largest = 0.0, 0.0
    for k in range(f.temp.size):
        past = f.past[np.uintp(k)]
        first = (past - f.begin[np.uintp(k)]) / AHEAD
        error = max(error, abs(f.temp[np.uintp(k)] - past - first))
        largest = max(largest, abs(f.temp[np.uintp(k)]))
    return float(error / (ATOL + RTOL * largest))


@kernel
def _copy(fro: NDArray[np.float64], to: NDArray[np.float64]) -> None:
    for k in range(to.size):
        to[np.uintp(k)] = fro[np.uintp(k)]


@inlined
def advance_heat(
    b: Bench, pt: Point, dt: float, first: float, q: NDArray[np.float64],
    info: NDArray[np.float64], walk: NDArray[np.float64],
) -> tuple[int, float]:  # fmt: skip
    """Bring positions and temperatures through ``dt`` at these inputs; 0: temperatures are held.

    Returns a status and the substep to try next [s]; substeps, ``first`` the first of them, are
    chosen for temperatures within ``ATOL`` and ``RTOL``.
    """
    f = washer_fields(washer_model(b.par), b.work)
    held = dt <= 0.0
    rest, h = dt, first if first > 0.0 else dt
    status = MAX_ITERATIONS
    _copy(f.temp, f.begin)
    for _ in range(MAX_SUBSTEPS):
        parts = 1.0 if held else max(1.0, float(math.ceil(rest / h - 1e-9)))
        h = rest / parts
        f.small[RATE] = HELD if held else 1.0 / (GAMMA * h)
        for stage in range(1 if held else 2):
            _set_stage(b, stage)
            status = _arrive(b, pt, q, info, walk)
            if status != OK:
                break
        if held:
            break
        error = _error(b) if status == OK else 16.0
        if not error <= 1.0:
            if h < 1e-9 * dt:
                status = status if status != OK else MAX_ITERATIONS
                break
            h *= max(0.2, 0.9 / math.sqrt(error))
            _copy(f.begin, f.temp)
            status = MAX_ITERATIONS
            continue
        _copy(f.temp, f.begin)
        growth = min(3.0, 0.9 / math.sqrt(max(error, 1e-3)))
        rest -= h
        if growth < 1.0 or growth > 1.5:  # else the heat factor goes on to serve
            h *= growth
        if parts == 1.0:
            break
        status = MAX_ITERATIONS
    return status, h


@kernel
def take_up(b: Bench, pt: Point, state: NDArray[np.float64], q: NDArray[np.float64]) -> None:
    """Take the remembered state; the bodies stay as warm as they are when the oil changes."""
    recall_state(b, state, q)
    f = washer_fields(washer_model(b.par), b.work)
    warmer = pt.oil_temperature - state[OIL_THEN]
    if warmer != 0.0:
        for k in range(f.temp.size):
            f.temp[np.uintp(k)] -= warmer


@kernel
def name_branch(found: NDArray[np.float64], ratio: float, share: float) -> bool:
    """Write the branch that film ratio and the film's share of the load stand for; True if lost."""
    lost = share < LOST_SHARE and ratio < FILM_RATIO
    found[BRANCH] = CONTACT_BRANCH if lost else FILM_BRANCH
    return lost


@inlined
def look_for_folds(
    b: Bench, pt: Point, state: NDArray[np.float64], q: NDArray[np.float64],
    info: NDArray[np.float64], found: NDArray[np.float64], walk: NDArray[np.float64],
) -> None:  # fmt: skip
    """Tell if the steady curve at these inputs has folds: without them nothing can be lost.

    ``state`` holds the solution; ``q`` and the fields are given back as they were.
    """
    if state[MULTIPLICITY_NOW] != 0.0 and scan_holds(pt, state):
        found[MULTIPLICITY] = state[MULTIPLICITY_NOW]
        return
    f = washer_fields(washer_model(b.par), b.work)
    rate, branch = f.small[RATE], found[BRANCH]
    f.small[RATE] = 0.0
    status = descend(b, pt, CONTACT_BRANCH, q, info, found, walk)
    found[BRANCH] = branch
    if status != OK and status != NO_BRANCH:
        found[MULTIPLICITY] = state[MULTIPLICITY_NOW]
    elif found[MULTIPLICITY] != MULTIPLE:
        found[MULTIPLICITY] = SINGLE
    state[BRANCH_NOW], state[MULTIPLICITY_NOW] = branch, found[MULTIPLICITY]
    state[SCAN_SPEED], state[SCAN_TILT] = pt.speed, pt.tilt
    state[SCAN_OIL] = pt.oil_temperature
    f.small[RATE] = rate
    recall_state(b, state, q)
    evaluate_here(b, pt, q)
