"""One washer solve with memory: warm where it can be, on the branch that the history asks for.

What a washer remembers between calls is one flat array, ``state``; all zeros: nothing yet. The heat
factor is not in it, only the positions and temperatures it was made at: a factor in the work is
used if it was made at exactly these, else it is made again, so that results never depend on what
the work happens to hold.
"""

import math

from ...numerics.arrays import are_equal, clear, copy
from ...numerics.jit import Array, inlined, kernel
from ...numerics.status import NO_BRANCH, OK, OVER_BUDGET
from . import layout as L
from .branch import FILM_RATIO, TOLERANCE, descend, is_clear_film, is_cool, solve_cold
from .continuation import BUDGET, go_along, press_gear
from .newton import (
    EXACT,
    LOAD,
    NO_FLOOR,
    evaluate,
    factor_here,
    film_ratio,
    is_spent,
    make_factor,
    mark_factor,
    newton,
    tilt_of,
)
from .workspace import Point, Workspace, fields_of, forget_factor, model_of, vector

WARM_TOLERANCE = 5e-6
FLAT = 0.15  # of the load per sigma: flatter slopes need a heat factor made here, 0.05 off without
CONTINUOUS = 0.2  # a film ratio that moves by less has stayed on its branch


@kernel
def _remembered(state: Array, n_temp: int, n: int) -> tuple[Array, Array, Array, Array]:
    """Return temperatures, pressures, the factor's temperatures, ladders (flat) in ``state``."""
    pressure = L.S_FIELDS + n_temp
    factor = pressure + n
    ladder = factor + n_temp
    end = ladder + L.N_TERMS * n_temp
    return (
        state[L.S_FIELDS : pressure],
        state[pressure:factor],
        state[factor:ladder],
        state[ladder:end],
    )


@kernel
def _belongs(par: Array, state: Array, tag: Array, temp: Array) -> bool:
    """Tell if the factor was made for these parameters, the remembered point and ``temp``."""
    return (
        tag[L.TAG_VALID] == 1.0
        and are_equal(tag[: L.TAG_PARAMETERS], state[L.S_FACTOR_VALID : L.S_MAP_BRANCH])
        and are_equal(tag[L.TAG_OUT : L.N_TAG], state[L.S_FACTOR_OUT : L.S_SUBSTEP])
        and are_equal(_owner(tag), par[: L.D_SIGMA1])
        and are_equal(tag[L.N_TAG : L.N_TAG + temp.size], temp)
    )


@kernel
def _owner(tag: Array) -> Array:
    """Return where the tag says which parameters and which grid the factor belongs to."""
    return tag[L.TAG_PARAMETERS : L.TAG_PARAMETERS + L.D_SIGMA1]


@kernel
def recall_state(w: Workspace, state: Array) -> None:
    """Take the remembered solution and its heat factor into ``w.q`` and the work."""
    m, f = model_of(w), fields_of(w)
    temp, pressure, of_factor, ladder = _remembered(state, f.temp.size, f.p.size)
    copy(pressure, f.p)
    if state[L.S_FACTOR_VALID] != 1.0:
        forget_factor(w)
    elif not _belongs(w.par, state, f.tag, of_factor):
        oil = state[L.S_FACTOR_OIL]
        pt = Point(1.0, state[L.S_FACTOR_SPEED], state[L.S_FACTOR_TILT], oil, oil)
        out = f.small[L.OUT_CARRIER : L.OUT_SIZE]
        now0, now1, now2, given = out[0], out[1], out[2], f.small[L.GIVEN]
        copy(vector(state, L.S_FACTOR_POSITIONS), w.q)
        copy(of_factor, f.temp)
        copy(state[L.S_FACTOR_OUT : L.S_FACTOR_GIVEN], out)
        f.small[L.GIVEN] = state[L.S_FACTOR_GIVEN]
        evaluate(m, pt, w.q, f, False)
        make_factor(m, pt, w.q, f.temp, f, EXACT)
        out[0], out[1], out[2], f.small[L.GIVEN] = now0, now1, now2, given
        copy(w.par[: L.D_SIGMA1], _owner(f.tag))
    copy(vector(state, L.S_POSITIONS), w.q)
    copy(temp, f.temp)
    copy(pressure, f.p)
    if w.par[L.P_THERMAL_MODE] == L.TRANSIENT:
        for k in range(ladder.size):
            f.ladder[k // f.temp.size, k % f.temp.size] = ladder[k]


@kernel
def remember_state(w: Workspace, pt: Point, state: Array) -> None:
    """Write the present solution and where its heat factor was made into ``state``."""
    f = fields_of(w)
    temp, pressure, of_factor, ladder = _remembered(state, f.temp.size, f.p.size)
    state[L.S_VALID] = 1.0
    state[L.S_LOAD], state[L.S_SPEED] = pt.load, pt.speed
    state[L.S_TILT], state[L.S_OIL] = pt.tilt, pt.oil_temperature
    state[L.S_FAR_FACE] = pt.far_face
    copy(w.q, vector(state, L.S_POSITIONS))
    copy(vector(f.small, L.TANGENT), vector(state, L.S_TANGENT))
    state[L.S_LOAD_SLOPE] = w.info[L.LOAD_SLOPE]
    copy(f.temp, temp)
    copy(f.p, pressure)
    copy(w.par[: L.D_SIGMA1], _owner(f.tag))
    copy(f.tag, state[L.S_FACTOR_VALID : L.S_MAP_BRANCH])
    copy(f.tag[L.TAG_OUT : L.N_TAG], state[L.S_FACTOR_OUT : L.S_SUBSTEP])
    copy(f.tag[L.N_TAG : L.N_TAG + temp.size], of_factor)
    if w.par[L.P_THERMAL_MODE] == L.TRANSIENT:
        for k in range(ladder.size):
            ladder[k] = f.ladder[k // temp.size, k % temp.size]


@kernel
def scan_holds(pt: Point, state: Array) -> bool:
    """Tell if the last descent was at about this speed, tilt and oil temperature."""
    return bool(
        state[L.S_SCAN_TILT] >= 0.0
        and abs(pt.speed - state[L.S_SCAN_SPEED]) <= 0.05 * abs(state[L.S_SCAN_SPEED])
        and abs(pt.tilt - state[L.S_SCAN_TILT]) <= 0.05 * state[L.S_SCAN_TILT]
        and abs(pt.oil_temperature - state[L.S_SCAN_OIL]) <= 3.0
    )


@kernel
def _is_flat(w: Workspace) -> bool:
    """Tell if the load changes so little with the film that a fold may be near."""
    return bool(w.info[L.LOAD_SLOPE] * w.par[L.D_SIGMA1] > -FLAT * w.info[L.REACHED_LOAD])


@inlined
def _from_guess(w: Workspace, pt: Point, state: Array) -> bool:
    """Solve from where ``state`` guesses that the washer is; return True if it is there.

    The guess is film ratio, tilts, branch, multiplicity, and at the head of the fields the rises of
    the oil film and of the bodies. There: on a stable part of the curve, no fold near.
    """
    m, f, q = model_of(w), fields_of(w), w.q
    guess, rise = state[L.S_RATIO], state[L.S_FIELDS + 1]
    copy(vector(state, L.S_POSITIONS), q)
    q[L.Z_WASHER] = guess * m.sigma1 + m.outer_radius * tilt_of(q)
    q[L.Z_GEAR] = q[L.Z_WASHER] + 3.0 * m.sigma2 + (pt.tilt - q[L.TILT_Y]) * m.outer_radius
    for k in range(f.temp.size):
        f.temp[k] = rise
    if m.film_step > 0:
        for j in range(m.n_t):
            for i in range(m.n_r):
                f.temp[m.film_at + j * m.film_step + i] = state[L.S_FIELDS]
    clear(f.dtemp)
    clear(f.p)
    forget_factor(w)
    press_gear(m, pt, q, f, pt.load)
    if newton(w, pt, LOAD, pt.load, NO_FLOOR, TOLERANCE, 20.0) != OK:
        return False
    ratio = film_ratio(w)
    if abs(ratio - guess) > CONTINUOUS * max(1.0, 0.2 * guess) or not w.info[L.LOAD_SLOPE] < 0.0:
        return False
    w.found[L.BRANCH] = L.FILM_BRANCH
    if is_clear_film(w):
        return bool(state[L.S_BRANCH] == L.FILM_BRANCH)
    multiplicity = state[L.S_MULTIPLICITY]
    if multiplicity == L.SINGLE:
        w.found[L.BRANCH] = L.FILM_BRANCH if ratio >= FILM_RATIO else L.CONTACT_BRANCH
    else:
        w.found[L.BRANCH] = state[L.S_BRANCH]
    w.found[L.MULTIPLICITY] = multiplicity
    return not _is_flat(w)


@inlined
def _predict(w: Workspace, pt: Point, state: Array) -> None:
    """Move the remembered solution along the curve of solutions if the load alone has changed."""
    slope, change = state[L.S_LOAD_SLOPE], pt.load - state[L.S_LOAD]
    same = (
        pt.speed == state[L.S_SPEED]
        and pt.tilt == state[L.S_TILT]
        and pt.oil_temperature == state[L.S_OIL]
        and pt.far_face == state[L.S_FAR_FACE]
    )
    if same and slope < 0.0 and state[L.S_FACTOR_VALID] == 1.0 and abs(change) < 0.2 * pt.load:
        step = change / slope
        if abs(step) < 0.1 * abs(state[L.S_RATIO]) * w.par[L.D_SIGMA1]:
            copy(vector(state, L.S_TANGENT), vector(fields_of(w).small, L.TANGENT))
            go_along(w, step)


@inlined
def _warm(w: Workspace, pt: Point, wanted: float, state: Array) -> bool:
    """Solve from the remembered solution; return True if it arrived on the remembered branch."""
    branch = state[L.S_BRANCH]
    if branch == 0.0 or (wanted != L.ANY and wanted != branch):
        return False
    _predict(w, pt, state)
    if newton(w, pt, LOAD, pt.load, NO_FLOOR, WARM_TOLERANCE, 12.0) != OK:
        return False
    w.found[L.BRANCH], w.found[L.MULTIPLICITY] = branch, state[L.S_MULTIPLICITY]
    if branch == L.FILM_BRANCH and is_clear_film(w):
        return True
    ratio = film_ratio(w)
    if is_cool(w, pt):
        w.found[L.MULTIPLICITY] = L.SINGLE
    elif abs(ratio - state[L.S_RATIO]) > CONTINUOUS or not scan_holds(pt, state):
        return False
    elif _is_flat(w):
        # a fold may be near: the slope is needed with a heat factor made here
        forget_factor(w)
        if newton(w, pt, LOAD, pt.load, NO_FLOOR, WARM_TOLERANCE, 12.0) != OK:
            return False
        if not w.info[L.LOAD_SLOPE] < 0.0 or abs(film_ratio(w) - ratio) > 0.5 * CONTINUOUS:
            return False
    if w.found[L.MULTIPLICITY] == L.SINGLE:
        w.found[L.BRANCH] = L.FILM_BRANCH if film_ratio(w) >= FILM_RATIO else L.CONTACT_BRANCH
    return True


@inlined
def solve(w: Workspace, pt: Point, wanted: float, state: Array) -> int:
    """Solve at ``pt``; return a status. The solution is in ``w``, evaluated, with its branch.

    Parameters
    ----------
    wanted : ANY (the remembered branch while it exists, else the other; without memory the film
        branch up to its fold), FILM_BRANCH or CONTACT_BRANCH

    Notes
    -----
    OVER_BUDGET after ``BUDGET`` iterations: more than ever a solution of the default washer took.
    """
    w.info[L.ITERATIONS], w.info[L.FACTORED] = 0.0, 0.0
    w.info[L.BUDGET] = BUDGET
    scanned = False
    arrived = False
    status = OK
    if state[L.S_VALID] == L.GUESSED:
        w.found[L.MULTIPLICITY] = L.UNKNOWN
        w.found[L.LOST], w.found[L.REGAINED] = math.nan, math.nan
        arrived = _from_guess(w, pt, state)
        if arrived and wanted != L.ANY and w.found[L.BRANCH] != wanted:
            arrived = False
        scanned = arrived and w.found[L.MULTIPLICITY] != L.UNKNOWN
    elif state[L.S_VALID] == 1.0:
        recall_state(w, state)
        arrived = _warm(w, pt, wanted, state)
        if not arrived:
            before = state[L.S_BRANCH]
            if wanted == L.ANY and before == L.CONTACT_BRANCH:
                status = descend(w, pt, L.CONTACT_BRANCH)
                if status == NO_BRANCH:
                    status = OK
                scanned = True
    if not (arrived or scanned):
        status = solve_cold(w, pt, wanted)
        scanned = w.found[L.MULTIPLICITY] != 0.0
    w.info[L.ARRIVED] = 1.0 if arrived else 0.0
    w.info[L.SCANNED] = 1.0 if scanned else 0.0
    return end_of_budget(w, status)


@kernel
def end_of_budget(w: Workspace, status: int) -> int:
    """Return how a solve with a budget ended; what follows has none."""
    failed = status != OK and status != NO_BRANCH
    spent = failed and is_spent(w)
    w.info[L.BUDGET] = 0.0
    return OVER_BUDGET if spent else status


@inlined
def keep_solution(w: Workspace, pt: Point, state: Array) -> None:
    """Write what ``solve`` has found to ``state``."""
    guessed = state[L.S_VALID] == L.GUESSED
    is_cold = w.info[L.ARRIVED] == 0.0
    is_first = guessed or (is_cold and state[L.S_VALID] == 0.0)
    if is_first:  # it is made, as it is remembered, if there is a second solve
        f = fields_of(w)
        mark_factor(pt, w.q, f.temp, f)
    elif is_cold:  # a factor made here makes the next, warm solve quick
        factor_here(w, pt)
    remember_state(w, pt, state)
    if is_first:
        forget_factor(w)
    state[L.S_BRANCH], state[L.S_MULTIPLICITY] = w.found[L.BRANCH], w.found[L.MULTIPLICITY]
    state[L.S_RATIO] = film_ratio(w)
    if w.info[L.SCANNED] != 0.0:
        state[L.S_SCAN_SPEED], state[L.S_SCAN_TILT] = pt.speed, pt.tilt
        state[L.S_SCAN_OIL] = pt.oil_temperature
    elif w.info[L.ARRIVED] == 0.0 or guessed:
        state[L.S_SCAN_TILT] = -1.0


@kernel
def is_distressed(w: Workspace, mean_rise: float) -> bool:
    """Tell if the film is lost: contact branch of a multivalued curve, or 200 K mean rise."""
    lost = w.found[L.BRANCH] == L.CONTACT_BRANCH and w.found[L.MULTIPLICITY] == L.MULTIPLE
    return lost or not mean_rise <= 200.0
