"""One step of a washer through its map: which branch, where on it, what comes out."""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .washer_branch import (
    ANY,
    CONTACT_BRANCH,
    FILM_BRANCH,
    FILM_RATIO,
    NO_BRANCH,
)  # fmt: skip
from .washer_fields import Point
from .washer_map import (
    AT_PIECE,
    AT_RATIO,
    FOUND,
    LOST,
    N_PLACE,
    continue_map,
    enter_map,
    map_covers,
    map_fits,
    read_edges,
    search_map,
)  # fmt: skip
from .washer_map_layout import N_LOOK_UP, STEEP, THICK
from .washer_map_point import map_derivative, map_outputs
from .washer_memory import BRANCH_NOW, VALID
from .washer_model import BAD_INPUT, N_STEADY, NOT_FINITE, OK
from .washer_newton import SINGULAR
from .washer_outputs import CONTACT_LOAD, MEAN_TEMPERATURE, N_REAL, RATIO
from .washer_verdict import STATUS_OUT, change_of, judge, point_of

MAP_BRANCH, MAP_RATIO = 24, 25  # places in `state`: the last look-up's branch, 0 if there is none
OUTSIDE = -1.0  # in place of a branch: the map says nothing here
NOT_HERE = -1  # the same as a status: ask the field
CONTINUOUS = 0.3  # a film ratio that moves by less has stayed on its branch
# scratch: a look-up, then the place found
PLACE = N_LOOK_UP
N_VERDICT = 2  # branch, and 2 where there are several
N_MAP_WORK = PLACE + N_PLACE + N_VERDICT
HOT = 200.0  # [K] mean rise that counts as distress


@kernel
def branch_before(state: NDArray[np.float64]) -> float:
    """Return the branch of the last solution, by map or field; ANY without one."""
    if state[MAP_BRANCH] != 0.0:
        return float(state[MAP_BRANCH])
    return float(state[BRANCH_NOW]) if state[VALID] == 1.0 else ANY


@kernel
def search(
    data: NDArray[np.float64], w: NDArray[np.float64], scale: float, load: float, wanted: float,
    first: float, place: NDArray[np.float64],
) -> float:  # fmt: skip
    """Search the branch ``first``, then the other unless ``wanted`` names one; fill ``place``."""
    result = search_map(data, w, scale, load, first == FILM_BRANCH, place)
    if result == FOUND:
        return first
    if result != LOST:
        return OUTSIDE
    if wanted != ANY:
        return 0.0
    result = search_map(data, w, scale, load, first != FILM_BRANCH, place)
    if result != FOUND:
        return OUTSIDE
    return FILM_BRANCH + CONTACT_BRANCH - first


@kernel
def _locate(
    data: NDArray[np.float64], w: NDArray[np.float64], scale: float, load: float, wanted: float,
    state: NDArray[np.float64], place: NDArray[np.float64],
) -> float:  # fmt: skip
    """Fill ``place``; return the branch, 0 if the wanted one is not there, OUTSIDE."""
    before = branch_before(state)
    if state[MAP_BRANCH] != 0.0 and (wanted == ANY or wanted == before):
        ratio = state[MAP_RATIO]
        if continue_map(data, w, scale, load, ratio, CONTINUOUS, place):
            return before
    first = wanted
    if wanted == ANY:
        first = CONTACT_BRANCH if before == CONTACT_BRANCH else FILM_BRANCH
    return search(data, w, scale, load, wanted, first, place)


@kernel
def place_without_memory(
    data: NDArray[np.float64],
    pt: Point,
    wanted: float,
    w: NDArray[np.float64],
) -> float:
    """Find a point from nothing; return its branch, 0 if the wanted one is not there, OUTSIDE."""
    if not map_covers(data, pt):
        return OUTSIDE
    place = w[PLACE:]
    scale = enter_map(data, pt, w)
    first = CONTACT_BRANCH if wanted == CONTACT_BRANCH else FILM_BRANCH
    found = search(data, w, scale, pt.load, wanted, first, place)
    if found > 0.0 and place[AT_PIECE] != THICK and not w[STEEP] > 0.0:
        found = FILM_BRANCH if place[AT_RATIO] >= FILM_RATIO else CONTACT_BRANCH
    if found > 0.0 and wanted != ANY and wanted != found:
        return 0.0
    return found


@kernel
def look_up(
    data: NDArray[np.float64], pt: Point, wanted: float,
    state: NDArray[np.float64], w: NDArray[np.float64], out: NDArray[np.float64],
    branch: NDArray[np.float64],
) -> int:  # fmt: skip
    """Fill ``out`` (N_ALL,) at ``pt``; return OK, NO_BRANCH or NOT_HERE.

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
    if place[AT_PIECE] != THICK:
        read_edges(data, w)
        several = w[STEEP] > 0.0
    if not several:
        found = FILM_BRANCH if place[AT_RATIO] >= FILM_RATIO else CONTACT_BRANCH
        if wanted != ANY and wanted != found:
            return NO_BRANCH
    map_outputs(data, w, pt, place, out)
    branch[0], branch[1] = found, 1.0
    if several:
        branch[1] = 2.0
    return OK


@kernel
def map_step(
    par: NDArray[np.float64], inp: NDArray[np.float64], wanted: float,
    state: NDArray[np.float64], numbers: NDArray[np.float64], w: NDArray[np.float64],
    data: NDArray[np.float64], out: NDArray[np.float64], iout: NDArray[np.int32], dt: float,
) -> int:  # fmt: skip
    """Step by looking up: outputs, memory and verdict as of `washer_step.step`, or NOT_HERE.

    Parameters
    ----------
    wanted : branch, see washer_branch
    numbers : (N_ALL,) out, all outputs
    w : (N_MAP_WORK,) scratch
    data : the table in the caller's work; BAD_INPUT if it is not one of these parameters
    """
    if not map_fits(data, par, N_STEADY):
        return BAD_INPUT
    pt = point_of(inp)
    branch = w[N_MAP_WORK - N_VERDICT :]
    status = look_up(data, pt, wanted, state, w, numbers, branch)
    if status == NOT_HERE:
        return NOT_HERE
    if status == OK:
        total = 0.0
        for k in range(N_REAL):
            out[k] = numbers[k]
            total += numbers[k]
        if not math.isfinite(total):
            status = NOT_FINITE
    if status != OK:
        iout[STATUS_OUT] = status
        return status
    hot = out[MEAN_TEMPERATURE] - pt.oil_temperature > HOT
    distressed = hot or (branch[1] == 2.0 and branch[0] == CONTACT_BRANCH)
    judge(pt, out[RATIO], distressed, OK, iout)
    if dt > 0.0:
        state[VALID] = 0.0  # fields solved before count no more
        state[MAP_BRANCH], state[MAP_RATIO] = branch[0], out[RATIO]
    return OK


@kernel
def map_sens(
    inp: NDArray[np.float64], seed: NDArray[np.float64], numbers: NDArray[np.float64],
    w: NDArray[np.float64], data: NDArray[np.float64], dout: NDArray[np.float64],
) -> int:  # fmt: skip
    """Fill ``dout`` along ``seed`` after a look-up; SINGULAR at a fold."""
    pt, change = point_of(inp), change_of(inp, seed)
    if pt.speed == 0.0 and seed[1] != 0.0 and numbers[CONTACT_LOAD] > 0.0:
        return SINGULAR
    read_edges(data, w)
    if map_derivative(data, w, pt, change, w[PLACE:], numbers, dout):
        return OK
    return SINGULAR
