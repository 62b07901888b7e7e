# mypy: disable-error-code="no-any-return"
"""The thrust washer for model exchange: a bristle whose capacity is the washer's friction.

Positions and temperatures are algebraic: solved for from the solution kept when the last step or
event was completed, which ``discrete`` holds. What is tried and rejected leaves no trace. They stay
on their branch. Where it has ended they are those of its fold until an event changes the branch;
the indicator of the branch is below 0 there.

Near rest, where the bristle makes less heat than sliding would, temperature rises and the heat of
the oil that flows through are as much less; film and capacity are those of sliding.
"""

import math

import numpy as np

from ...numerics.arrays import are_equal, are_finite, clear, copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.status import (
    BAD_INPUT,
    MAX_ITERATIONS,
    NO_BRANCH,
    NOT_FINITE,
    NOT_IN_MAP,
    OK,
    SINGULAR,
)
from ...tribology.bristle import (
    Bristle,
    bristle,
    bristle_changes,
    bristle_heat,
    bristle_of,
    first_bend,
)
from . import layout as L
from .branch import DESCENT, FILM_RATIO, descend, is_clear_film, settle, solve_cold
from .continuation import BUDGET, exact_slope, find_fold, note, recall, remember, walk_to
from .directional_derivative import differentiate
from .gap import dry_friction, face_area
from .heat import set_steady
from .map import map_layout as M
from .map.map_search import map_covers, map_fits, nearest
from .map.map_step import N_MAP_WORK, N_VERDICT, NOT_HERE, look_up, look_up_slopes
from .newton import (
    EXACT,
    FILM,
    LOAD,
    NO_FLOOR,
    evaluate,
    film_ratio,
    make_factor,
    newton,
    smooth_film,
)
from .outputs import MOST_MARGIN, RISES, coefficient_per_torque, outputs_at
from .regime_and_status import (
    LARGEST_RISE,
    LARGEST_VERIFIED,
    VERIFIED_OIL,
    change_of,
    is_bad,
    judge,
    point_of,
    tell_outside_map,
)
from .solve import CONTINUOUS, FLAT, is_distressed
from .step import FINE_GRID, MAP_WORK, NINP, NOUT, TABLE_AT
from .step import NIOUT as NIOUT
from .step import NPAR as NPAR
from .step import NWORK as NWORK
from .workspace import (
    Point,
    Workspace,
    fields_of,
    forget_factor,
    model_of,
    temperatures_of,
    workspace_of,
)

X_BEND, X_ENERGY, NCONT = range(3)
A_ANGLE, A_DAMPING, A_SPEED, A_LARGEST, NOWN = range(5)
# What is discrete: time of the next event [s], largest capacity [N m]; branch, are there several,
# point of the last search for folds; the kept solution: its point, positions, then temperatures and
# pressures.
D_NEXT, D_LARGEST, D_BRANCH, D_SEVERAL, D_SPEED, D_TILT, D_OIL, D_KEPT = range(8)
K_POSITIONS = D_KEPT + 5
K_FIELDS = K_POSITIONS + 4
NMODE = K_FIELDS + temperatures_of(*FINE_GRID) + FINE_GRID[0] * FINE_GRID[1]
Z_BRANCH, Z_MIXED, Z_BOUNDARY, Z_HOT, Z_RISE, Z_OUTSIDE, NSIGN = range(7)
NEVER = 1.7976931348623157e308
SLOWEST = 1e-6  # rad/s; at rest friction is that of a washer that turns so fast
USUAL = 1e6  # Pa, of the largest capacity
CLOSE = 1e-10  # of all balances, where rounding lets them come so close ...
NEARLY = 1e-7  # ... and where it does not
ITERATIONS = 14.0
EXACTLY = 1e-9  # of a point on the way to a fold
HALVINGS = 60  # of a load, where a branch of the map ends
SMALLEST = 1e-12  # relative load that is missing
MOST_STEPS = 200  # along the curve of solutions
NEAR, NEAR_OIL = 0.05, 3.0  # relative, K: searches for folds that far off count
NOISE = 1e-7  # of a load, which has an extremum where it changes back by more


@kernel
def way_of(speed: float) -> float:
    """Return the sign of a speed, 1 at rest."""
    return -1.0 if speed < 0.0 else 1.0


@kernel
def moving_point(par: Array, inp: Array) -> Point:
    """Return the operating point of a washer that turns."""
    pt = point_of(par, inp)
    speed = pt.speed
    if abs(speed) < SLOWEST:
        speed = SLOWEST * way_of(speed)
    return Point(pt.load, speed, pt.tilt, pt.oil_temperature, pt.far_face)


@kernel
def keep(w: Workspace, pt: Point, discrete: Array) -> None:
    """Keep the present solution."""
    f, kept = fields_of(w), discrete[D_KEPT:K_POSITIONS]
    kept[0], kept[1], kept[2] = pt.load, pt.speed, pt.tilt
    kept[3], kept[4] = pt.oil_temperature, pt.far_face
    end = K_FIELDS + f.temp.size
    copy(w.q, discrete[K_POSITIONS:K_FIELDS])
    copy(f.temp, discrete[K_FIELDS:end])
    copy(f.p, discrete[end : end + f.p.size])


@kernel
def take_kept(w: Workspace, discrete: Array) -> int:
    """Take the kept solution and a heat factor made there; return a status."""
    m, f, kept = model_of(w), fields_of(w), discrete[D_KEPT:K_POSITIONS]
    end = K_FIELDS + f.temp.size
    temp, pressure = discrete[K_FIELDS:end], discrete[end : end + f.p.size]
    at = Point(kept[0], kept[1], kept[2], kept[3], kept[4])
    set_steady(m, at, f)
    copy(discrete[K_POSITIONS:K_FIELDS], w.q)
    copy(temp, f.temp)
    copy(pressure, f.p)
    tag = f.tag
    same = (
        tag[L.TAG_VALID] == 1.0
        and tag[L.TAG_SPEED] == at.speed
        and tag[L.TAG_TILT] == at.tilt
        and tag[L.TAG_OIL] == at.oil_temperature
        and are_equal(tag[L.TAG_POSITIONS : L.TAG_PARAMETERS], w.q)
        and are_equal(tag[L.TAG_PARAMETERS : L.TAG_OUT], w.par[: L.D_SIGMA1])
        and are_equal(tag[L.TAG_OUT : L.TAG_GIVEN], f.small[L.OUT_CARRIER : L.OUT_SIZE])
        and tag[L.TAG_GIVEN] == 1.0
        and are_equal(tag[L.N_TAG : L.N_TAG + temp.size], temp)
    )
    if same:
        return OK
    evaluate(m, at, w.q, f, False)
    if not make_factor(m, at, w.q, f.temp, f, EXACT):
        return SINGULAR
    copy(w.par[: L.D_SIGMA1], tag[L.TAG_PARAMETERS : L.TAG_OUT])
    copy(pressure, f.p)
    return OK


@kernel
def arrive(w: Workspace, pt: Point) -> int:
    """Solve for the load from here until nothing changes any more; return a status."""
    status = newton(w, pt, LOAD, pt.load, NO_FLOOR, CLOSE, ITERATIONS)
    return OK if status == MAX_ITERATIONS and w.info[L.RESIDUAL] < NEARLY else status


@kernel
def room_here(w: Workspace, load: float) -> float:
    """Return how steeply the load falls with the film, in loads per roughness, 1 at most."""
    return min(-w.info[L.LOAD_SLOPE] * w.par[L.D_SIGMA1] / load, 1.0)


@kernel
def stays(w: Workspace, pt: Point, on_film: bool, before: float) -> tuple[bool, float]:
    """Tell if a solution is on the branch of the film ratio ``before``; return its room too."""
    if on_film and is_clear_film(w):
        return True, room_here(w, pt.load)
    ratio = film_ratio(w)
    if not abs(ratio - before) < CONTINUOUS:
        return False, 0.0
    if room_here(w, pt.load) < FLAT:  # the slope is needed with a heat factor made here
        forget_factor(w)
        if arrive(w, pt) != OK or not abs(film_ratio(w) - ratio) < 0.5 * CONTINUOUS:
            return False, 0.0
    room = room_here(w, pt.load)
    return room > 0.0, room


@kernel
def follow(w: Workspace, pt: Point, on_film: bool) -> tuple[int, float]:
    """Walk along the curve of solutions from here to the load, or to the fold that ends the branch.

    Returns a status and the room: below 0 the relative load that is missing at the fold.
    """
    sigma = w.par[L.D_SIGMA1]
    w.curve[L.ACCURACY] = EXACTLY
    forget_factor(w)
    status = newton(w, pt, FILM, smooth_film(w), NO_FLOOR, EXACTLY, 40.0)
    if status == OK:
        note(w)
        status = exact_slope(w, pt)
    if status != OK:
        return status, 0.0
    if not w.curve[L.AT_SLOPE] < 0.0:  # the fold has come past
        thicker, back = on_film, True
    else:
        thicker, back = w.curve[L.AT_LOAD] >= pt.load, False
    s0, w0 = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
    s1, w1 = s0, w0
    for _ in range(MOST_STEPS):
        step = max(0.5 * DESCENT * sigma, 0.12 * (s1 - 2.5 * sigma))
        status = walk_to(w, pt, s1 + step if thicker else s1 - step)
        if status != OK:
            return status, 0.0
        s2, w2 = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
        grows = w2 > w1
        if back and grows != thicker:  # the slope is that of the branch again
            back = False
            if exact_slope(w, pt) != OK:
                return MAX_ITERATIONS, 0.0
            status = find_fold(w, pt, s2, s0)
            if status != OK:
                return status, 0.0
            fold, most = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
            over = pt.load > most if on_film else pt.load < most
            if over:
                return OK, -abs(pt.load - most) / pt.load
            if (w2 < pt.load) == on_film:
                upper, lower = (s2, fold) if on_film else (fold, s2)
                return settle(w, pt, upper, lower), 1.0
            if walk_to(w, pt, s2) != OK:
                return MAX_ITERATIONS, 0.0
        elif not back and thicker and w2 < pt.load <= w1:
            return settle(w, pt, s2, s1), 1.0
        elif not back and not thicker and w2 >= pt.load > w1:
            return settle(w, pt, s1, s2), 1.0
        elif not back and (w2 - w1 if thicker else w1 - w2) > NOISE * w1:  # past a fold
            status = find_fold(w, pt, s0, s2)
            if status != OK:
                return status, 0.0
            fold, most = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
            if most < pt.load if thicker else most >= pt.load:
                return settle(w, pt, fold if thicker else s0, s0 if thicker else fold), 1.0
            return OK, -abs(pt.load - most) / pt.load
        s0, w0, s1, w1 = s1, w1, s2, w2
    return MAX_ITERATIONS, 0.0


@kernel
def is_held(par: Array, pt: Point, work: Array) -> bool:
    """Tell if the map's answer is that of the nearest point of its box."""
    on_map = par[L.P_FIDELITY] == L.MAP and par[L.P_OUTSIDE_MAP] == L.HOLD
    return bool(on_map and not map_covers(work[TABLE_AT:], pt))


@kernel
def edge_of(data: Array, pt: Point, branch: float, memory: Array, look: Array, out: Array) -> float:
    """Fill ``out`` (N_ALL,) where a branch of the map ends towards a load; return the load there.

    ``look``: scratch of a look-up. Below 0: the branch is nowhere.
    """
    found = look[N_MAP_WORK - N_VERDICT :]
    end = pt.load
    there = data[M.BOX] if branch == L.FILM_BRANCH else data[M.BOX + 1]
    for _ in range(HALVINGS):
        middle = 0.5 * (there + end)
        at = Point(middle, pt.speed, pt.tilt, pt.oil_temperature, pt.far_face)
        if look_up(data, at, branch, memory, look, out, found) == OK:
            there = middle
        else:
            end = middle
    at = Point(there, pt.speed, pt.tilt, pt.oil_temperature, pt.far_face)
    return there if look_up(data, at, branch, memory, look, out, found) == OK else -1.0


@kernel
def looked_up(par: Array, inp: Array, discrete: Array, work: Array) -> tuple[int, float]:
    """Do as ``solved`` by the map."""
    given, w, data = moving_point(par, inp), workspace_of(par, work), work[TABLE_AT:]
    look = work[MAP_WORK : MAP_WORK + N_MAP_WORK]
    found = look[N_MAP_WORK - N_VERDICT :]
    memory = discrete[K_FIELDS : K_FIELDS + L.S_MAP_RATIO + 1]
    if not map_fits(data, par, L.N_STEADY):
        return BAD_INPUT, 0.0
    pt, held = given, is_held(par, given, work)
    if held:
        pt = nearest(data, given)
    elif not map_covers(data, given):
        return NOT_IN_MAP, 0.0
    before, room = discrete[D_BRANCH], 1.0
    status = look_up(data, pt, L.ANY, memory, look, w.outputs, found)
    if status == OK and found[1] == 2.0 and before != 0.0 and found[0] != before:
        edge = edge_of(data, pt, before, memory, look, w.outputs)
        if edge > 0.0:
            room = min(-abs(pt.load - edge) / pt.load, -SMALLEST)
        else:
            status = look_up(data, pt, L.ANY, memory, look, w.outputs, found)
    if status == NOT_HERE:
        return NOT_IN_MAP, 0.0
    if status != OK:
        return status, 0.0
    if held:
        w.outputs[L.O_TORQUE] = abs(w.outputs[L.O_TORQUE]) * way_of(given.speed)
        w.outputs[L.O_POWER] = w.outputs[L.O_TORQUE] * given.speed
    w.found[L.BRANCH] = found[0]
    w.found[L.MULTIPLICITY] = L.MULTIPLE if found[1] == 2.0 else L.SINGLE
    return OK if are_finite(w.outputs) else NOT_FINITE, room


@kernel
def keep_place(w: Workspace, discrete: Array) -> None:
    """Keep where in the map the washer is."""
    memory = discrete[K_FIELDS : K_FIELDS + L.S_MAP_RATIO + 1]
    memory[L.S_MAP_BRANCH], memory[L.S_MAP_RATIO] = w.found[L.BRANCH], w.outputs[L.O_RATIO]


@kernel
def enter_branch(par: Array, inp: Array, discrete: Array, work: Array) -> int:
    """Look up on whatever branch there is, and stay there; return a status."""
    discrete[D_BRANCH] = 0.0
    status, _ = looked_up(par, inp, discrete, work)
    if status == OK:
        w = workspace_of(par, work)
        discrete[D_BRANCH], discrete[D_SEVERAL] = w.found[L.BRANCH], w.found[L.MULTIPLICITY]
        keep_place(w, discrete)
    return status


@kernel
def solved(par: Array, inp: Array, discrete: Array, work: Array) -> tuple[int, float]:
    """Fill ``work`` with the sliding washer on its branch; return a status and the room."""
    if is_bad(inp):
        return BAD_INPUT, 0.0
    if par[L.P_FIDELITY] == L.MAP:
        return looked_up(par, inp, discrete, work)
    pt, w = moving_point(par, inp), workspace_of(par, work)
    clear(w.info)
    clear(w.found)
    clear(w.curve)
    status = take_kept(w, discrete)
    if status != OK:
        return status, 0.0
    set_steady(model_of(w), pt, fields_of(w))
    w.info[L.BUDGET] = BUDGET
    before, on_film = film_ratio(w), discrete[D_BRANCH] != L.CONTACT_BRANCH
    remember(w, 1.0)
    status, on_branch, room = arrive(w, pt), False, 0.0
    if status == OK:
        on_branch, room = stays(w, pt, on_film, before)
    if not on_branch:
        recall(w, 1.0)
        status, room = follow(w, pt, on_film)
        if status == OK and room > 0.0:
            forget_factor(w)
            status = arrive(w, pt)
            room = max(room_here(w, pt.load), SMALLEST)
    w.info[L.BUDGET] = 0.0
    w.found[L.BRANCH], w.found[L.MULTIPLICITY] = discrete[D_BRANCH], discrete[D_SEVERAL]
    if status == OK and not outputs_at(w, pt):
        status = NOT_FINITE
    return status, room


@kernel
def capacity_of(w: Workspace) -> float:
    """Return the torque of sliding [N m >= 0]."""
    return abs(w.outputs[L.O_TORQUE])


@kernel
def bristle_of_washer(own: Array, discrete: Array) -> Bristle:
    """Return the bristle."""
    return bristle_of(discrete[D_LARGEST], own[A_ANGLE], own[A_SPEED], own[A_DAMPING])


@kernel
def largest_of(par: Array) -> float:
    """Return the dry friction [N m] under a mean pressure of USUAL."""
    inner, outer = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS]
    load = USUAL * face_area(par)
    friction, _ = dry_friction(par, load)
    return max(friction, 0.01) / coefficient_per_torque(inner, outer, load)


@kernel
def adopt(w: Workspace, pt: Point, discrete: Array, status: int) -> int:
    """Keep what a search for folds has found, solved exactly; return a status."""
    if status != OK and status != NO_BRANCH:
        return status
    branch, several = w.found[L.BRANCH], w.found[L.MULTIPLICITY]
    forget_factor(w)
    status = arrive(w, pt)
    if status != OK:
        return status
    discrete[D_BRANCH], discrete[D_SEVERAL] = branch, several
    discrete[D_SPEED], discrete[D_TILT] = pt.speed, pt.tilt
    discrete[D_OIL] = pt.oil_temperature
    keep(w, pt, discrete)
    return OK


@kernel
def start(
    par: Array, own: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Fill the states at the start: the washer loaded up from light load; return a status."""
    clear(cont)
    clear(discrete)
    discrete[D_NEXT], discrete[D_LARGEST] = NEVER, own[A_LARGEST]
    if is_bad(inp):
        return BAD_INPUT
    if own[A_LARGEST] == 0.0:
        discrete[D_LARGEST] = largest_of(par)
    pt, w = moving_point(par, inp), workspace_of(par, work)
    if par[L.P_FIDELITY] == L.MAP:
        status = enter_branch(par, inp, discrete, work)
    else:
        clear(w.info)
        clear(w.curve)
        set_steady(model_of(w), pt, fields_of(w))
        w.info[L.BUDGET] = BUDGET
        status = adopt(w, pt, discrete, solve_cold(w, pt, L.ANY))
        if status == OK and not outputs_at(w, pt):
            status = NOT_FINITE
    if status != OK:
        return status
    b = bristle_of_washer(own, discrete)
    cont[X_BEND] = first_bend(b, capacity_of(w), inp[L.I_SPEED])
    return OK if are_finite(discrete) and are_finite(cont) else NOT_FINITE


@kernel
def share_of(heat: float, sliding: float) -> float:
    """Return what of the heat of sliding [W] is made, 1 at most."""
    return heat / sliding if heat < sliding else 1.0


@kernel
def fill_given(
    w: Workspace, pt: Point, sliding: float, torque: float, heat: float, out: Array
) -> None:
    """Fill outputs from those of sliding, whose power is ``sliding`` [W]."""
    own, share = w.outputs, share_of(heat, sliding)
    copy(own[:NOUT], out)
    for k in range(len(RISES)):
        at = RISES[k]
        out[at] = pt.oil_temperature + share * (own[at] - pt.oil_temperature)
    out[L.O_THROUGHFLOW_HEAT] = share * own[L.O_THROUGHFLOW_HEAT]
    out[L.O_TORQUE], out[L.O_POWER], out[L.O_OIL_HEAT] = torque, heat, heat
    inner, outer = w.par[L.P_INNER_RADIUS], w.par[L.P_OUTER_RADIUS]
    out[L.O_COEFFICIENT] = coefficient_per_torque(inner, outer, pt.load) * abs(torque)
    hold = own[L.O_STICK_MARGIN] * capacity_of(w)
    out[L.O_STICK_MARGIN] = MOST_MARGIN
    if own[L.O_STICK_MARGIN] < MOST_MARGIN and abs(torque) * MOST_MARGIN > hold:
        out[L.O_STICK_MARGIN] = hold / abs(torque)


@kernel
def room_verified(pt: Point) -> float:
    """Return how far the point is from the ends of what is verified; negative beyond them."""
    load, speed, tilt = LARGEST_VERIFIED
    room = min((load - pt.load) / load, (speed - abs(pt.speed)) / speed)
    room = min(room, (tilt - pt.tilt) / tilt)
    cold, warm = VERIFIED_OIL
    return min(room, min(pt.oil_temperature - cold, warm - pt.oil_temperature) / warm)


@kernel
def rates(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    out: Array,
    der: Array,
    sign: Array,
) -> int:
    """Fill outputs, rates of the states, event indicators; return 0 or the status of a failure."""
    clear(der)
    status, room = solved(par, inp, discrete, work)
    if status != OK:
        return status
    pt, w = moving_point(par, inp), workspace_of(par, work)
    slip, bend, b = inp[L.I_SPEED], cont[X_BEND], bristle_of_washer(own, discrete)
    capacity = capacity_of(w)
    torque, der[X_BEND] = bristle(b, capacity, slip, bend)
    heat = bristle_heat(b, torque, slip, bend, der[X_BEND])
    fill_given(w, pt, capacity * abs(slip), torque, heat, out)
    out[L.O_ENERGY] = out[L.O_OIL_ENERGY] = cont[X_ENERGY]
    out[L.O_STORED_HEAT], out[L.O_ADVISED] = 0.0, 0.0
    der[X_ENERGY] = heat
    sign[Z_BRANCH] = room
    sign[Z_MIXED], sign[Z_BOUNDARY] = out[L.O_RATIO] - FILM_RATIO, out[L.O_RATIO] - 1.0
    sign[Z_HOT] = (L.HOT_LIMIT - out[L.O_PEAK]) / L.HOT_LIMIT
    sign[Z_RISE] = (LARGEST_RISE - (out[L.O_MEAN] - pt.oil_temperature)) / LARGEST_RISE
    sign[Z_OUTSIDE] = room_verified(pt)
    return OK if are_finite(out) and are_finite(der) and are_finite(sign) else NOT_FINITE


@kernel
def finish(
    par: Array, own: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Keep the solution at a completed step; return 0 or the status of a failure."""
    status, room = solved(par, inp, discrete, work)
    if status != OK:
        return status
    w = workspace_of(par, work)
    if par[L.P_FIDELITY] != L.MAP:
        keep(w, moving_point(par, inp), discrete)
    elif room > 0.0:
        keep_place(w, discrete)
    return OK


@kernel
def search_holds(pt: Point, discrete: Array) -> bool:
    """Tell if the last search for folds was at about this speed, tilt and oil temperature."""
    speed, tilt, oil = discrete[D_SPEED], discrete[D_TILT], discrete[D_OIL]
    near = abs(pt.speed - speed) <= NEAR * abs(speed) and abs(pt.tilt - tilt) <= NEAR * tilt
    return bool(near and abs(pt.oil_temperature - oil) <= NEAR_OIL)


@kernel
def search(w: Workspace, pt: Point, discrete: Array, room: float) -> int:
    """Look at an event for the other branch where this one has ended, for folds where they may be.

    The solution is kept. A curve without folds is called film where it is thick.
    """
    branch, ended = discrete[D_BRANCH], room <= 0.0
    if not ended and branch == L.FILM_BRANCH and is_clear_film(w):
        keep(w, pt, discrete)
        return OK
    if not ended and search_holds(pt, discrete):
        if discrete[D_SEVERAL] == L.SINGLE:
            thick = film_ratio(w) >= FILM_RATIO
            discrete[D_BRANCH] = L.FILM_BRANCH if thick else L.CONTACT_BRANCH
        keep(w, pt, discrete)
        return OK
    wanted = branch
    if ended:
        wanted = L.FILM_BRANCH if branch == L.CONTACT_BRANCH else L.CONTACT_BRANCH
    w.info[L.BUDGET] = w.info[L.ITERATIONS] + BUDGET
    status = adopt(w, pt, discrete, descend(w, pt, wanted))
    w.info[L.BUDGET] = 0.0
    return status


@kernel
def update(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    out: Array,
    iout: Ints,
    t: float,
) -> int:
    """Fill what is discrete, branch, regime, status; return 0 or the status of a failure."""
    if not math.isfinite(t):
        return BAD_INPUT
    status, room = solved(par, inp, discrete, work)
    if status != OK:
        return status
    pt, w = moving_point(par, inp), workspace_of(par, work)
    if par[L.P_FIDELITY] == L.MAP:
        status = enter_branch(par, inp, discrete, work)
    else:
        status = search(w, pt, discrete, room)
        if status == OK and not outputs_at(w, pt):
            status = NOT_FINITE
    if status != OK:
        return status
    w.found[L.BRANCH], w.found[L.MULTIPLICITY] = discrete[D_BRANCH], discrete[D_SEVERAL]
    slip, bend, b = inp[L.I_SPEED], cont[X_BEND], bristle_of_washer(own, discrete)
    capacity = capacity_of(w)
    torque, rate = bristle(b, capacity, slip, bend)
    heat = bristle_heat(b, torque, slip, bend, rate)
    fill_given(w, pt, capacity * abs(slip), torque, heat, out)
    discrete[D_NEXT] = NEVER
    judge(pt, out, is_distressed(w, out[L.O_MEAN] - pt.oil_temperature), OK, iout)
    if is_held(par, pt, work):
        tell_outside_map(iout)
    return OK


@kernel
def slopes(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    along: Array,
    found: Array,
) -> int:
    """Fill ``found``, changes of outputs and rates, with changes of inputs and states ``along``.

    SINGULAR where the branch has ended.
    """
    clear(found)
    status, room = solved(par, inp, discrete, work)
    if status != OK:
        return status
    if room <= 0.0:
        return SINGULAR
    pt, w, change = moving_point(par, inp), workspace_of(par, work), change_of(par, inp, along)
    slip, bend, b = inp[L.I_SPEED], cont[X_BEND], bristle_of_washer(own, discrete)
    if abs(slip) < SLOWEST:
        change = Point(change.load, 0.0, change.tilt, change.oil_temperature, change.far_face)
    slid, changes = w.outputs, found[:NOUT]
    moved = abs(change.load) + abs(change.speed) + abs(change.tilt)
    if moved + abs(change.oil_temperature) + abs(change.far_face) > 0.0:
        if par[L.P_FIDELITY] == L.MAP:
            look = work[MAP_WORK : MAP_WORK + N_MAP_WORK]
            status = look_up_slopes(pt, change, slid, look, work[TABLE_AT:], changes)
        else:
            status = differentiate(w, pt, change, changes)
        if status != OK:
            return status
    capacity, grows = capacity_of(w), changes[L.O_TORQUE] * way_of(pt.speed)
    torque, rate = bristle(b, capacity, slip, bend)
    way = (grows, along[L.I_SPEED], along[NINP + X_BEND])
    heat, torques, turns, heats = bristle_changes(b, capacity, slip, bend, way, (0.0, 0.0))
    sliding = capacity * abs(slip)
    share, shares = share_of(heat, sliding), 0.0
    if heat < sliding:
        faster = grows * abs(slip) + capacity * way_of(slip) * along[L.I_SPEED]
        shares = (heats - share * faster) / sliding
    oil, warmer = pt.oil_temperature, along[L.I_OIL]
    for k in range(len(RISES)):
        at = RISES[k]
        changes[at] = warmer + share * (changes[at] - warmer) + shares * (slid[at] - oil)
    changes[L.O_THROUGHFLOW_HEAT] = (
        share * changes[L.O_THROUGHFLOW_HEAT] + shares * slid[L.O_THROUGHFLOW_HEAT]
    )
    inner, outer = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS]
    per_torque, away = coefficient_per_torque(inner, outer, pt.load), way_of(torque)
    changes[L.O_COEFFICIENT] = per_torque * away * torques
    changes[L.O_COEFFICIENT] -= per_torque * abs(torque) * change.load / pt.load
    margin = slid[L.O_STICK_MARGIN]
    hold = margin * capacity
    if margin < MOST_MARGIN and abs(torque) * MOST_MARGIN > hold:
        holds = changes[L.O_STICK_MARGIN] * capacity + margin * grows
        changes[L.O_STICK_MARGIN] = (holds - hold / torque * torques) / abs(torque)
    else:
        changes[L.O_STICK_MARGIN] = 0.0
    changes[L.O_TORQUE], changes[L.O_POWER], changes[L.O_OIL_HEAT] = torques, heats, heats
    changes[L.O_ENERGY] = changes[L.O_OIL_ENERGY] = along[NINP + X_ENERGY]
    found[np.uintp(NOUT + X_BEND)], found[np.uintp(NOUT + X_ENERGY)] = turns, heats
    return OK if are_finite(found) and math.isfinite(rate) else NOT_FINITE
