"""Heat in time: what does not leave a body warms it, so that a lost film takes its time.

Carrier, washer and gear store density x specific heat x thickness x area x change of temperature;
film, contacts and positions follow at once. Each substep is implicit, of second order and damps
stiff parts out (two stages with the same coefficient, Alexander 1977, gamma = 1 - 1/sqrt(2)). In a
stage everything is solved for together, as in the steady state, which is the limit of long steps.
"""

import math

from ...numerics.jit import Array, inlined, kernel
from ...numerics.status import MAX_ITERATIONS, NO_BRANCH, OK
from . import layout as L
from .branch import DESCENT, ENTRY_RATIO, FILM_RATIO, descend, settle
from .continuation import enter_curve, note, recall, remember, walk_down, walk_to
from .newton import FILM, LOAD, NO_FLOOR, evaluate_here, newton, smooth_film
from .solve import WARM_TOLERANCE, recall_state, scan_holds
from .workspace import Point, Workspace, clear, copy, fields_of, forget_factor

GAMMA = 1.0 - math.sqrt(0.5)
AHEAD = (1.0 - GAMMA) / GAMMA  # share of the first stage's gain that the second starts with
ATOL, RTOL = 0.02, 2e-3  # [K], and of the largest rise: what a substep may be off
HELD = 1e6  # [1/s] storage that lets no temperature move
LOST_SHARE = 0.7  # the film carries more above every fold where it is lost, less where regained
MAX_SUBSTEPS = 20_000


@kernel
def start_cold(w: Workspace) -> None:
    """Set all temperatures to the oil's and hold them there."""
    f = fields_of(w)
    f.small[L.RATE] = HELD
    clear(f.past)


@kernel
def set_rate(w: Workspace, rate: float) -> None:
    """Weigh what is stored by ``rate`` [1/s]; 0: nothing is."""
    fields_of(w).small[L.RATE] = rate


@inlined
def _along_the_film(w: Workspace, pt: Point) -> int:
    """Solve for the load by walking in film thickness from where the washer is."""
    sigma = w.par[L.D_SIGMA1]
    w.curve[L.ACCURACY] = 1e-4
    forget_factor(w)
    status = newton(w, pt, FILM, smooth_film(w), NO_FLOOR, 1e-4, 40.0)
    if status == OK:
        note(w)
    else:
        status = enter_curve(w, pt, ENTRY_RATIO)
    if status != OK:
        return status
    rising = w.curve[L.AT_LOAD] >= pt.load
    for _ in range(400):
        before = w.curve[L.AT_FILM]
        if rising:
            status = walk_to(w, pt, before + max(0.25 * before, 0.5 * sigma))
        else:
            status = walk_down(w, pt, DESCENT)
        if status != OK:
            return status
        if rising and w.curve[L.AT_LOAD] < pt.load:
            return settle(w, pt, w.curve[L.AT_FILM], before)
        if not rising and w.curve[L.AT_LOAD] >= pt.load:
            return settle(w, pt, before, w.curve[L.AT_FILM])
    return MAX_ITERATIONS


@inlined
def _arrive(w: Workspace, pt: Point) -> int:
    """Solve for the load with the storage as it is set, from the present state.

    A failure leaves the state as it was.
    """
    f = fields_of(w)
    rate = f.small[L.RATE]
    if not abs(f.tag[L.TAG_RATE] - rate) <= 0.3 * rate:
        forget_factor(w)
    remember(w, 2.0)
    status = newton(w, pt, LOAD, pt.load, NO_FLOOR, WARM_TOLERANCE, 12.0)
    if status != OK:
        recall(w, 2.0)
        status = _along_the_film(w, pt)
    if status != OK:
        recall(w, 2.0)
        forget_factor(w)
    return status


@kernel
def _set_stage(w: Workspace, stage: int) -> None:
    """Set what the stage's storage counts from, and a guess of where it ends."""
    f = fields_of(w)
    copy(f.begin, f.past)
    if stage == 1:
        for k in range(f.temp.size):
            gain = f.temp[k] - f.begin[k]
            f.past[k] += AHEAD * gain
            f.temp[k] = f.past[k] + gain


@kernel
def _error(w: Workspace) -> float:
    """Return the error of both stages over what a substep may be off.

    The stages' rates of temperature differ by what a method of first order would be off.
    """
    f = fields_of(w)
    error, largest = 0.0, 0.0
    for k in range(f.temp.size):
        first = (f.past[k] - f.begin[k]) / AHEAD
        error = max(error, abs(f.temp[k] - f.past[k] - first))
        largest = max(largest, abs(f.temp[k]))
    return float(error / (ATOL + RTOL * largest))


@inlined
def advance_heat(w: Workspace, pt: Point, dt: float, first: float) -> tuple[int, float]:
    """Bring positions and temperatures through ``dt`` at these inputs; 0: temperatures are held.

    Returns a status and the substep to try next [s]; substeps, ``first`` the first of them, are
    chosen for temperatures within ``ATOL`` and ``RTOL``.
    """
    f = fields_of(w)
    held = dt <= 0.0
    rest, h = dt, first if first > 0.0 else dt
    status = MAX_ITERATIONS
    copy(f.temp, f.begin)
    for _ in range(MAX_SUBSTEPS):
        parts = 1.0 if held else max(1.0, float(math.ceil(rest / h - 1e-9)))
        h = rest / parts
        f.small[L.RATE] = HELD if held else 1.0 / (GAMMA * h)
        for stage in range(1 if held else 2):
            _set_stage(w, stage)
            status = _arrive(w, pt)
            if status != OK:
                break
        if held:
            break
        error = _error(w) if status == OK else 16.0
        if not error <= 1.0:
            if h < 1e-9 * dt:
                status = status if status != OK else MAX_ITERATIONS
                break
            h *= max(0.2, 0.9 / math.sqrt(error))
            copy(f.begin, f.temp)
            status = MAX_ITERATIONS
            continue
        copy(f.temp, f.begin)
        growth = min(3.0, 0.9 / math.sqrt(max(error, 1e-3)))
        rest -= h
        if growth < 1.0 or growth > 1.5:  # else the heat factor goes on to serve
            h *= growth
        if parts == 1.0:
            break
        status = MAX_ITERATIONS
    return status, h


@kernel
def take_up(w: Workspace, pt: Point, state: Array) -> None:
    """Take the remembered state; the bodies stay as warm as they are when the oil changes."""
    recall_state(w, state)
    f = fields_of(w)
    warmer = pt.oil_temperature - state[L.S_OIL]
    if warmer != 0.0:
        for k in range(f.temp.size):
            f.temp[k] -= warmer


@kernel
def name_branch(w: Workspace, ratio: float, share: float) -> bool:
    """Write the branch that film ratio and the film's share of the load stand for; True if lost."""
    lost = share < LOST_SHARE and ratio < FILM_RATIO
    w.found[L.BRANCH] = L.CONTACT_BRANCH if lost else L.FILM_BRANCH
    return lost


@inlined
def look_for_folds(w: Workspace, pt: Point, state: Array) -> None:
    """Tell if the steady curve at these inputs has folds: without them nothing can be lost.

    ``state`` holds the solution; positions and fields are given back as they were.
    """
    if state[L.S_MULTIPLICITY] != 0.0 and scan_holds(pt, state):
        w.found[L.MULTIPLICITY] = state[L.S_MULTIPLICITY]
        return
    f = fields_of(w)
    rate, branch = f.small[L.RATE], w.found[L.BRANCH]
    f.small[L.RATE] = 0.0
    status = descend(w, pt, L.CONTACT_BRANCH)
    w.found[L.BRANCH] = branch
    if status != OK and status != NO_BRANCH:
        w.found[L.MULTIPLICITY] = state[L.S_MULTIPLICITY]
    elif w.found[L.MULTIPLICITY] != L.MULTIPLE:
        w.found[L.MULTIPLICITY] = L.SINGLE
    state[L.S_BRANCH], state[L.S_MULTIPLICITY] = branch, w.found[L.MULTIPLICITY]
    state[L.S_SCAN_SPEED], state[L.S_SCAN_TILT] = pt.speed, pt.tilt
    state[L.S_SCAN_OIL] = pt.oil_temperature
    f.small[L.RATE] = rate
    recall_state(w, state)
    evaluate_here(w, pt)
