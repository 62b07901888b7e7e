"""Heat in time: what does not leave a body warms it, so that a lost film takes its time.

Through the thickness of carrier and gear heat takes its way along a ladder (see ``ladder``); film,
contacts and positions follow at once. Each substep is implicit, of second order and damps stiff
parts out: two stages, exact for the ladder where the flux into a body is linear in time. In a stage
everything is solved for together, as in the steady state, which is the limit of long steps.
"""

import math

from ...numerics.arrays import clear, copy
from ...numerics.jit import Array, inlined, kernel
from ...numerics.status import MAX_ITERATIONS, OK
from . import ladder
from . import layout as L
from .branch import DESCENT, ENTRY_RATIO, FILM_RATIO, ONLY_FOLDS, descend, is_cool, settle
from .continuation import BUDGET, enter_curve, note, recall, remember, walk_down, walk_to
from .heat import let_out
from .newton import FILM, LOAD, NO_FLOOR, evaluate_here, is_spent, newton, smooth_film
from .outputs import outputs_at
from .solve import recall_state, scan_holds
from .workspace import Point, Workspace, fields_of, forget_factor, model_of

ATOL, RTOL = 0.02, 2e-3  # [K], and of the largest rise: what a substep may be off
SECOND = 0.35  # of what a held flux would be off: two stages, by 80 sequences of steps
LOST_SHARE = 0.7  # the film carries more above every fold where it is lost, less where regained
ARRIVED = 1e-8  # tolerance of each instant: what is stored counts beside small powers
NEARLY = 1e-7  # where rounding lets no instant come closer, as with hot asperities
MAX_SUBSTEPS = 20_000


@kernel
def start_cold(w: Workspace) -> None:
    """Set all temperatures to the oil's and hold them there."""
    clear(fields_of(w).temp)
    ladder.hold_bodies(w)


@inlined
def along_the_film(w: Workspace, pt: Point) -> int:
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
    """Solve for the load with the conductances outwards as they are set, from the present state.

    A failure leaves the state as it was.
    """
    f = fields_of(w)
    for k in range(3):
        out = f.small[L.OUT_CARRIER + k]
        if not abs(f.tag[L.TAG_OUT + k] - out) <= 0.3 * out:
            forget_factor(w)
    remember(w, 2.0)
    status = newton(w, pt, LOAD, pt.load, NO_FLOOR, ARRIVED, 14.0)
    if status == MAX_ITERATIONS and w.info[L.RESIDUAL] < NEARLY:
        status = OK
    if status != OK:
        recall(w, 2.0)
        status = along_the_film(w, pt)
    if status != OK:
        recall(w, 2.0)
        forget_factor(w)
    return status


@inlined
def advance_heat(w: Workspace, pt: Point, dt: float, first: float) -> tuple[int, float, float]:
    """Bring positions and temperatures through ``dt`` at these inputs; 0: bodies stay as they are.

    Returns a status, the substep to try next [s] and the heat made [J]; substeps, ``first`` the
    first of them, are chosen for temperatures within ``ATOL`` and ``RTOL``. Powers of the stages
    count as their fluxes do.
    """
    f = fields_of(w)
    held = dt <= 0.0
    made, power = 0.0, 0.0
    rest, h = dt, first if first > 0.0 else dt
    status = MAX_ITERATIONS
    copy(f.temp, f.begin)
    for _ in range(MAX_SUBSTEPS):
        parts = 1.0 if held else max(1.0, float(math.ceil(rest / h - 1e-9)))
        h = rest / parts
        for stage in range(1 if held else 2):
            if held:
                ladder.hold_bodies(w)
            elif stage == 0:
                ladder.set_stage(w, pt, h)
            else:
                ladder.set_end(w, pt, h)
            before, status = power, _arrive(w, pt)
            if status != OK or held:
                break
            outputs_at(w, pt)
            power = w.outputs[L.O_POWER]
        if held:
            break
        error, largest = ladder.error_of_flux(w)
        error = SECOND * error / (ATOL + RTOL * largest) if status == OK else 16.0
        if not error <= 1.0:
            if h < 1e-9 * dt or is_spent(w):
                status = status if status != OK else MAX_ITERATIONS
                break
            # after a jump the error falls with h^(2/3)
            h *= max(0.1, 0.8 / (error * math.sqrt(error)))
            copy(f.begin, f.temp)
            status = MAX_ITERATIONS
            continue
        ladder.advance_terms(w, h)
        copy(f.temp, f.begin)
        made += h * ((1.0 - ladder.STAGE) * before + ladder.STAGE * power)
        growth = min(3.0, 0.9 / math.sqrt(max(error, 1e-3)))
        rest -= h
        if growth < 1.0 or growth > 1.5:  # else the heat factor goes on to serve
            h *= growth
        if parts == 1.0:
            break
        status = MAX_ITERATIONS
    return status, h, made


@kernel
def take_up(w: Workspace, pt: Point, state: Array) -> None:
    """Take the remembered state; the bodies stay as warm as they are when the oil changes."""
    recall_state(w, state)
    warmer = pt.oil_temperature - state[L.S_OIL]
    outside = pt.far_face - state[L.S_FAR_FACE]
    if warmer != 0.0 or outside != 0.0:
        ladder.shift_terms(w, warmer, outside)


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
    if is_cool(w, pt):
        w.found[L.MULTIPLICITY] = state[L.S_MULTIPLICITY] = L.SINGLE
        return
    m, f = model_of(w), fields_of(w)
    out, branch = f.small[L.OUT_CARRIER : L.OUT_SIZE], w.found[L.BRANCH]
    carrier, washer, gear = out[0], out[1], out[2]
    copy(f.outward, f.begin)
    let_out(m, pt, f)
    w.info[L.BUDGET] = w.info[L.ITERATIONS] + BUDGET
    status = descend(w, pt, ONLY_FOLDS)
    w.info[L.BUDGET], w.found[L.BRANCH] = 0.0, branch
    if status != OK:
        w.found[L.MULTIPLICITY] = state[L.S_MULTIPLICITY]
    elif w.found[L.MULTIPLICITY] != L.MULTIPLE:
        w.found[L.MULTIPLICITY] = L.SINGLE
    state[L.S_BRANCH], state[L.S_MULTIPLICITY] = branch, w.found[L.MULTIPLICITY]
    state[L.S_SCAN_SPEED], state[L.S_SCAN_TILT] = pt.speed, pt.tilt
    state[L.S_SCAN_OIL] = pt.oil_temperature
    out[0], out[1], out[2] = carrier, washer, gear
    copy(f.begin, f.outward)
    recall_state(w, state)
    evaluate_here(w, pt)
