# mypy: disable-error-code="no-any-return"
"""The functions that a host calls: a bristle whose capacity is the washer's friction.

Positions and temperatures are algebraic: solved for from the solution kept when the last step or
event was completed, which ``discrete`` holds. What is tried and rejected leaves no trace. They stay
on their branch. Where it has ended they are those of its fold until an event changes the branch;
the indicator of the branch is below 0 there.

Near rest, where the bristle makes less heat than sliding would, temperature rises and the heat of
the oil that flows through are as much less; film and capacity are those of sliding.
"""

import math

import numpy as np

from ....numerics.arrays import are_finite, clear, copy
from ....numerics.jit import Array, Ints, kernel
from ....numerics.status import BAD_INPUT, NO_BRANCH, NOT_FINITE, NOT_IN_MAP, OK, SINGULAR
from ....tribology.bristle import (
    Bristle,
    bristle,
    bristle_changes,
    bristle_heat,
    bristle_of,
    first_bend,
)
from .. import layout as L
from ..branch import FILM_RATIO, descend, is_clear_film, solve_cold
from ..continuation import BUDGET, recall, remember
from ..directional_derivative import differentiate
from ..gap import dry_friction, face_area
from ..heat import set_steady
from ..ladder import X_BEND, X_CARRIER, X_ENERGY, X_GEAR, X_WASHER
from ..map.map_search import map_covers
from ..map.map_step import N_MAP_WORK, look_up_slopes
from ..newton import film_ratio
from ..outputs import MOST_MARGIN, RISES, coefficient_per_torque, outputs_at
from ..regime_and_status import (
    LARGEST_RISE,
    LARGEST_VERIFIED,
    VERIFIED_OIL,
    change_of,
    is_bad,
    judge,
    tell_outside_map,
)
from ..solve import is_distressed
from ..step import MAP_WORK, NINP, NOUT, TABLE_AT
from ..step import NIOUT as NIOUT
from ..step import NPAR as NPAR
from ..step import NWORK as NWORK
from ..workspace import Point, Workspace, fields_of, forget_factor, model_of, workspace_of
from .branch import follow, room_here, stays
from .in_time import (
    fill_flux_changes,
    fill_rate_changes,
    fill_rates,
    flux_changes,
    hold_for_slopes,
    room_of_film,
    shapes_sign,
    solved_in_time,
)
from .kept import (
    A_ANGLE,
    A_DAMPING,
    A_LARGEST,
    A_SPEED,
    D_BRANCH,
    D_IN_TIME,
    D_LARGEST,
    D_NEXT,
    D_NOW,
    D_OIL,
    D_ON_MAP,
    D_SEVERAL,
    D_SPEED,
    D_STORED,
    D_TILT,
    K_FIELDS,
    SLOWEST,
    Z_BOUNDARY,
    Z_BRANCH,
    Z_HOT,
    Z_MAP,
    Z_MIXED,
    Z_OUTSIDE,
    Z_RISE,
    Z_SHAPES,
    arrive,
    keep,
    moving_point,
    take_kept,
    way_of,
)
from .kept import NCONT as NCONT
from .kept import NMODE as NMODE
from .kept import NOWN as NOWN
from .kept import NSIGN as NSIGN
from .kept import TIME_AT as TIME_AT
from .on_map import SMALLEST, asks_map, enter_branch, keep_place, looked_up, map_sign
from .shapes import start_in_time, update_in_time

NEVER = 1.7976931348623157e308
USUAL = 1e6  # Pa, of the largest capacity
NEAR, NEAR_OIL = 0.05, 3.0  # relative, K: searches for folds that far off count


@kernel
def solved(par: Array, inp: Array, cont: Array, discrete: Array, work: Array) -> tuple[int, float]:
    """Fill ``work`` with the sliding washer on its branch; return a status and the room."""
    if is_bad(inp):
        return BAD_INPUT, 0.0
    if discrete[D_IN_TIME] == 1.0:
        status = solved_in_time(par, inp, cont, discrete, work)
        return status, room_of_film(workspace_of(par, work))
    if discrete[D_ON_MAP] == 1.0:
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
def from_nothing(w: Workspace, pt: Point, wanted: float, discrete: Array) -> int:
    """Solve the washer on a branch, on any without one, and keep the solution; return a status."""
    clear(w.info)
    clear(w.curve)
    set_steady(model_of(w), pt, fields_of(w))
    w.info[L.BUDGET] = BUDGET
    if wanted == L.ANY:
        status = solve_cold(w, pt, wanted)
    else:
        status = descend(w, pt, wanted)
    status = adopt(w, pt, discrete, status)
    w.info[L.BUDGET] = 0.0
    if status == OK and not outputs_at(w, pt):
        return NOT_FINITE
    return status


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
    pt, w, status = moving_point(par, inp), workspace_of(par, work), OK
    cont[X_CARRIER] = cont[X_WASHER] = cont[X_GEAR] = pt.oil_temperature
    if par[L.P_THERMAL_MODE] == L.TRANSIENT:
        status = start_in_time(par, inp, cont, discrete, work, t)
    elif asks_map(par, pt, work):
        discrete[D_ON_MAP] = 1.0
        status = enter_branch(par, inp, discrete, work)
        if status == NOT_IN_MAP and par[L.P_OUTSIDE_MAP] == L.SOLVE:
            discrete[D_ON_MAP] = 0.0
    if discrete[D_ON_MAP] != 1.0 and discrete[D_IN_TIME] != 1.0:
        status = from_nothing(w, pt, L.ANY, discrete)
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
    w: Workspace,
    pt: Point,
    sliding: float,
    torque: float,
    heat: float,
    discrete: Array,
    out: Array,
) -> None:
    """Fill outputs from those of sliding, whose power is ``sliding`` [W].

    In time bodies are as warm as they are, however much heat is made.
    """
    own, part = w.outputs, share_of(heat, sliding)
    copy(own[:NOUT], out)
    share = 1.0 if discrete[D_IN_TIME] == 1.0 else part
    for k in range(len(RISES)):
        at = RISES[k]
        out[at] = pt.oil_temperature + share * (own[at] - pt.oil_temperature)
    out[L.O_THROUGHFLOW_HEAT] = part * own[L.O_THROUGHFLOW_HEAT]
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
    status, room = solved(par, inp, cont, discrete, work)
    if status != OK:
        return status
    pt, w = moving_point(par, inp), workspace_of(par, work)
    slip, bend, b = inp[L.I_SPEED], cont[X_BEND], bristle_of_washer(own, discrete)
    capacity = capacity_of(w)
    torque, der[X_BEND] = bristle(b, capacity, slip, bend)
    heat = bristle_heat(b, torque, slip, bend, der[X_BEND])
    fill_given(w, pt, capacity * abs(slip), torque, heat, discrete, out)
    out[L.O_ENERGY] = out[L.O_OIL_ENERGY] = cont[X_ENERGY]
    out[L.O_STORED_HEAT], out[L.O_ADVISED] = 0.0, 0.0
    der[X_ENERGY], sign[Z_SHAPES] = heat, 1.0
    if discrete[D_IN_TIME] == 1.0:
        sliding = capacity * abs(slip)
        left, lacks = sliding - w.outputs[L.O_THROUGHFLOW_HEAT], 1.0 - share_of(heat, sliding)
        grows, stored = fill_rates(w, pt, cont, left, lacks, der)
        out[L.O_STORED_HEAT] = stored - discrete[D_STORED]
        out[L.O_OIL_HEAT] = heat - grows
        out[L.O_OIL_ENERGY] = cont[X_ENERGY] - out[L.O_STORED_HEAT]
        sign[Z_SHAPES] = shapes_sign(w, discrete)
    sign[Z_BRANCH] = room
    sign[Z_MIXED], sign[Z_BOUNDARY] = out[L.O_RATIO] - FILM_RATIO, out[L.O_RATIO] - 1.0
    sign[Z_HOT] = (L.HOT_LIMIT - out[L.O_PEAK]) / L.HOT_LIMIT
    sign[Z_RISE] = (LARGEST_RISE - (out[L.O_MEAN] - pt.oil_temperature)) / LARGEST_RISE
    sign[Z_OUTSIDE], sign[Z_MAP] = room_verified(pt), map_sign(par, pt, discrete, work)
    return OK if are_finite(out) and are_finite(der) and are_finite(sign) else NOT_FINITE


@kernel
def finish(
    par: Array, own: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Keep the solution at a completed step; return 0 or the status of a failure."""
    discrete[D_NOW] = t
    status, room = solved(par, inp, cont, discrete, work)
    if status != OK:
        return status
    w = workspace_of(par, work)
    if discrete[D_ON_MAP] != 1.0:
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
    pt, w = moving_point(par, inp), workspace_of(par, work)
    in_time, room = discrete[D_IN_TIME] == 1.0, 1.0
    if is_bad(inp):
        return BAD_INPUT
    if in_time:
        status = update_in_time(par, inp, cont, discrete, work, t)
    else:
        status, room = solved(par, inp, cont, discrete, work)
    if status != OK:
        return status
    if in_time:
        pass
    elif map_sign(par, pt, discrete, work) <= 0.0:  # from the map to the field, or back
        discrete[D_ON_MAP] = 1.0 - discrete[D_ON_MAP]
        if discrete[D_ON_MAP] == 1.0:
            memory = discrete[K_FIELDS : K_FIELDS + L.S_MAP_RATIO + 1]
            clear(memory)
            memory[L.S_VALID], memory[L.S_BRANCH] = 1.0, discrete[D_BRANCH]
            status = enter_branch(par, inp, discrete, work)
        if discrete[D_ON_MAP] != 1.0 or status == NOT_IN_MAP:
            discrete[D_ON_MAP] = 0.0
            status = from_nothing(w, pt, discrete[D_BRANCH], discrete)
    elif discrete[D_ON_MAP] == 1.0:
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
    fill_given(w, pt, capacity * abs(slip), torque, heat, discrete, out)
    if not in_time:
        discrete[D_NEXT] = NEVER
    judge(pt, out, is_distressed(w, out[L.O_MEAN] - pt.oil_temperature), OK, iout)
    if par[L.P_FIDELITY] == L.MAP and not map_covers(work[TABLE_AT:], pt):
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
    status, room = solved(par, inp, cont, discrete, work)
    if status != OK:
        return status
    in_time = discrete[D_IN_TIME] == 1.0
    if room <= 0.0 and not in_time:
        return SINGULAR
    pt, w, change = moving_point(par, inp), workspace_of(par, work), change_of(par, inp, along)
    slip, bend, b = inp[L.I_SPEED], cont[X_BEND], bristle_of_washer(own, discrete)
    if abs(slip) < SLOWEST:
        change = Point(change.load, 0.0, change.tilt, change.oil_temperature, change.far_face)
    slid, changes = w.outputs, found[:NOUT]
    moved = abs(change.load) + abs(change.speed) + abs(change.tilt)
    moved += abs(change.oil_temperature) + abs(change.far_face)
    fluxes = work[MAP_WORK : MAP_WORK + 3]
    clear(fields_of(w).small[L.WARMED : L.N_SMALL])
    if in_time:
        clear(fluxes)
        states = along[NINP:]
        hold_for_slopes(w, states)
        moved += abs(states[X_CARRIER]) + abs(states[X_WASHER]) + abs(states[X_GEAR])
    if moved > 0.0:
        if discrete[D_ON_MAP] == 1.0:
            look = work[MAP_WORK : MAP_WORK + N_MAP_WORK]
            status = look_up_slopes(pt, change, slid, look, work[TABLE_AT:], changes)
        else:
            status = differentiate(w, pt, change, changes)
        if in_time:
            flux_changes(w, pt, change, fluxes)
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
    oil, warmer, goes = pt.oil_temperature, along[L.I_OIL], changes[L.O_THROUGHFLOW_HEAT]
    for k in range(0 if in_time else len(RISES)):
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
    if in_time:
        kept = sliding - slid[L.O_THROUGHFLOW_HEAT], 1.0 - share
        of_kept = grows * abs(slip) + capacity * way_of(slip) * along[L.I_SPEED] - goes, -shares
        fill_flux_changes(w, kept, of_kept, fluxes)
        rates = found[NOUT:]
        stores, stored = fill_rate_changes(w, change, along[NINP:], fluxes, rates)
        changes[L.O_OIL_HEAT] -= stores
        changes[L.O_STORED_HEAT] = stored
        changes[L.O_OIL_ENERGY] -= stored
    found[np.uintp(NOUT + X_BEND)], found[np.uintp(NOUT + X_ENERGY)] = turns, heats
    return OK if are_finite(found) and math.isfinite(rate) else NOT_FINITE
