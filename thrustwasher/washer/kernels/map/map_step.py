"""One step of a washer through its map: which branch, where on it, what comes out."""

from ....numerics.arrays import are_finite, copy
from ....numerics.jit import Array, Ints, kernel
from ....numerics.smoothing import sign_of
from ....numerics.status import BAD_INPUT, NO_BRANCH, NOT_FINITE, NOT_IN_MAP, OK, SINGULAR
from .. import layout as L
from ..branch import FILM_RATIO
from ..regime_and_status import LARGEST_RISE, change_of, judge, point_of, tell_outside_map
from ..workspace import Point
from . import map_layout as M
from .map_layout import THICK
from .map_point import map_derivative, map_outputs
from .map_search import (
    FOUND,
    LOST,
    continue_map,
    enter_map,
    map_covers,
    map_fits,
    nearest,
    read_edges,
    search_map,
)

OUTSIDE = -1.0  # in place of a branch: the map says nothing here
NOT_HERE = -1  # the same as a status: ask the field
CONTINUOUS = 0.3  # a film ratio that moves by less has stayed on its branch
# scratch: a look-up, then the place found
PLACE = M.N_LOOK_UP
N_VERDICT = 2  # branch, and 2 where there are several
N_MAP_WORK = PLACE + M.N_PLACE + N_VERDICT


@kernel
def branch_before(state: Array) -> float:
    """Return the branch of the last solution, by map or field; L.ANY without one."""
    if state[L.S_MAP_BRANCH] != 0.0:
        return float(state[L.S_MAP_BRANCH])
    return float(state[L.S_BRANCH]) if state[L.S_VALID] == 1.0 else L.ANY


@kernel
def search(
    data: Array, w: Array, scale: float, load: float, wanted: float, first: float, place: Array
) -> float:
    """Search the branch ``first``, then the other unless ``wanted`` names one; fill ``place``."""
    result = search_map(data, w, scale, load, first == L.FILM_BRANCH, place)
    if result == FOUND:
        return first
    if result != LOST:
        return OUTSIDE
    if wanted != L.ANY:
        return 0.0
    result = search_map(data, w, scale, load, first != L.FILM_BRANCH, place)
    if result != FOUND:
        return OUTSIDE
    return L.FILM_BRANCH + L.CONTACT_BRANCH - first


@kernel
def _locate(
    data: Array, w: Array, scale: float, load: float, wanted: float, state: Array, place: Array
) -> float:
    """Fill ``place``; return the branch, 0 if the wanted one is not there, OUTSIDE."""
    before = branch_before(state)
    if state[L.S_MAP_BRANCH] != 0.0 and (wanted == L.ANY or wanted == before):
        ratio = state[L.S_MAP_RATIO]
        if continue_map(data, w, scale, load, ratio, CONTINUOUS, place):
            return before
    first = wanted
    if wanted == L.ANY:
        first = L.CONTACT_BRANCH if before == L.CONTACT_BRANCH else L.FILM_BRANCH
    return search(data, w, scale, load, wanted, first, place)


@kernel
def place_without_memory(data: Array, pt: Point, wanted: float, w: Array) -> float:
    """Find a point from nothing; return its branch, 0 if the wanted one is not there, OUTSIDE."""
    if not map_covers(data, pt):
        return OUTSIDE
    place = w[PLACE:]
    scale = enter_map(data, pt, w)
    first = L.CONTACT_BRANCH if wanted == L.CONTACT_BRANCH else L.FILM_BRANCH
    found = search(data, w, scale, pt.load, wanted, first, place)
    if found > 0.0 and place[M.AT_PIECE] != THICK and not w[M.STEEP] > 0.0:
        found = L.FILM_BRANCH if place[M.AT_RATIO] >= FILM_RATIO else L.CONTACT_BRANCH
    if found > 0.0 and wanted != L.ANY and wanted != found:
        return 0.0
    return found


@kernel
def look_up(
    data: Array, pt: Point, wanted: float, state: Array, w: Array, out: Array, branch: Array
) -> int:
    """Fill ``out`` (L.N_ALL,) at ``pt``; return OK, NO_BRANCH or NOT_HERE.

    Parameters
    ----------
    data : the map
    w : (N_MAP_WORK,) scratch
    branch : (2,) out, the branch and 2 if there are several, 1 if not
    """
    if not map_covers(data, pt):
        return NOT_HERE
    place = w[PLACE:]
    scale = enter_map(data, pt, w)
    found = _locate(data, w, scale, pt.load, wanted, state, place)
    if found == OUTSIDE:
        return NOT_HERE
    if found == 0.0:
        return NO_BRANCH
    several = False
    if place[M.AT_PIECE] != THICK:
        read_edges(data, w)
        several = w[M.STEEP] > 0.0
    if not several:
        found = L.FILM_BRANCH if place[M.AT_RATIO] >= FILM_RATIO else L.CONTACT_BRANCH
        if wanted != L.ANY and wanted != found:
            return NO_BRANCH
    map_outputs(data, w, pt, place, out)
    branch[0], branch[1] = found, 1.0
    if several:
        branch[1] = 2.0
    return OK


@kernel
def map_step(
    par: Array,
    inp: Array,
    wanted: float,
    state: Array,
    numbers: Array,
    w: Array,
    data: Array,
    out: Array,
    iout: Ints,
    dt: float,
) -> int:
    """Step by looking up: outputs, memory and verdict as of `washer_step.step`, or NOT_HERE.

    Parameters
    ----------
    wanted : branch, see washer_branch
    numbers : (L.N_ALL,) out, all outputs
    w : (N_MAP_WORK,) scratch
    data : the table in the caller's work; BAD_INPUT if it is not one of these parameters
    """
    if not map_fits(data, par, L.N_STEADY):
        return BAD_INPUT
    return look_up_step(
        point_of(par, inp), par[L.P_OUTSIDE_MAP], wanted, state, numbers, w, data, out, iout, dt
    )


@kernel
def look_up_step(
    given: Point,
    outside: float,
    wanted: float,
    state: Array,
    numbers: Array,
    w: Array,
    data: Array,
    out: Array,
    iout: Ints,
    dt: float,
) -> int:
    """Step as ``map_step`` at a point; ``outside``: what to do where it is not in the box."""
    pt, branch = given, w[N_MAP_WORK - N_VERDICT :]
    is_held = outside == L.HOLD and not map_covers(data, given)
    if is_held:
        pt = nearest(data, given)
    status = look_up(data, pt, wanted, state, w, numbers, branch)
    if status == NOT_HERE:
        if outside == L.SOLVE:
            return NOT_HERE
        status = NOT_IN_MAP
    if status == OK:
        if is_held:
            numbers[L.O_TORQUE] = abs(numbers[L.O_TORQUE]) * sign_of(given.speed)
            numbers[L.O_POWER] = numbers[L.O_OIL_HEAT] = numbers[L.O_TORQUE] * given.speed
        copy(numbers, out)
        if not are_finite(out):
            status = NOT_FINITE
    if status != OK:
        iout[L.IO_STATUS] = status
        return status
    hot = out[L.O_MEAN] - pt.oil_temperature > LARGEST_RISE
    distressed = hot or (branch[1] == 2.0 and branch[0] == L.CONTACT_BRANCH)
    judge(pt, out, distressed, OK, iout)
    if is_held:
        tell_outside_map(iout)
    if dt > 0.0:
        state[L.S_VALID] = 0.0  # fields solved before count no more
        state[L.S_MAP_BRANCH], state[L.S_MAP_RATIO] = branch[0], out[L.O_RATIO]
    return OK


@kernel
def map_sens(inp: Array, seed: Array, numbers: Array, w: Array, data: Array, dout: Array) -> int:
    """Fill ``dout`` along ``seed`` after a look-up; SINGULAR at a fold."""
    par = data[M.PARAMS :]
    return look_up_slopes(point_of(par, inp), change_of(par, inp, seed), numbers, w, data, dout)


@kernel
def look_up_slopes(
    given: Point, along: Point, numbers: Array, w: Array, data: Array, dout: Array
) -> int:
    """Fill ``dout`` along a change of the point; an input held at an end of the box has no slope.

    SINGULAR at a fold.
    """
    pt, change = given, along
    if not map_covers(data, given):
        pt = nearest(data, given)
        change = Point(
            along.load if pt.load == given.load else 0.0,
            along.speed if pt.speed == given.speed else 0.0,
            along.tilt if pt.tilt == given.tilt else 0.0,
            along.oil_temperature if pt.oil_temperature == given.oil_temperature else 0.0,
            0.0,
        )
    if pt.speed == 0.0 and change.speed != 0.0 and numbers[L.O_CONTACT_LOAD] > 0.0:
        return SINGULAR
    read_edges(data, w)
    if not map_derivative(data, w, pt, change, w[PLACE:], numbers, dout):
        return SINGULAR
    if pt.speed != given.speed:
        turns = sign_of(given.speed) * sign_of(pt.speed)
        dout[L.O_TORQUE] *= turns
        power = dout[L.O_TORQUE] * given.speed + numbers[L.O_TORQUE] * along.speed
        dout[L.O_POWER] = dout[L.O_OIL_HEAT] = power
    return OK
