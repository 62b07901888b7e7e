# mypy: disable-error-code="no-any-return"
"""A washer by its map in model exchange: the branch, its end, the ends of the map."""

import numpy as np

from ....numerics.arrays import are_finite
from ....numerics.jit import Array, kernel
from ....numerics.status import BAD_INPUT, NOT_FINITE, NOT_IN_MAP, OK
from .. import layout as L
from ..map import map_layout as M
from ..map.map_search import map_covers, map_fits, nearest
from ..map.map_step import N_MAP_WORK, N_VERDICT, NOT_HERE, look_up
from ..step import MAP_WORK, TABLE_AT
from ..workspace import Point, Workspace, workspace_of
from .kept import D_BRANCH, D_ON_MAP, D_SEVERAL, K_FIELDS, SLOWEST, moving_point, way_of

WELL_INSIDE = 0.02  # of the ends of a map's box: from there on it is asked again
HALVINGS = 60  # of a load, where a branch of the map ends
SMALLEST = 1e-12  # relative load that is missing


@kernel
def is_held(par: Array, pt: Point, work: Array) -> bool:
    """Tell if the map's answer is that of the nearest point of its box."""
    holds = par[L.P_FIDELITY] == L.MAP and par[L.P_OUTSIDE_MAP] != L.REFUSE
    return bool(holds and not map_covers(work[TABLE_AT:], pt))


@kernel
def room_in_map(data: Array, pt: Point) -> float:
    """Return how far a point is from the nearest end of the map's box, relatively; negative: out.

    One that the map covers is never out.
    """
    b, room = M.BOX, 1.0
    for k in range(4):
        x = pt.load if k == 0 else abs(pt.speed) if k == 1 else pt.tilt
        x = pt.oil_temperature if k == 3 else x
        low, high = data[np.uintp(b + 2 * k)], data[np.uintp(b + 2 * k + 1)]
        room = min(room, min((x - low) / max(low, SLOWEST), (high - x) / high))
    return max(room, 0.0) if map_covers(data, pt) else min(room, -SMALLEST)


@kernel
def map_sign(par: Array, pt: Point, discrete: Array, work: Array) -> float:
    """Return the indicator of the map's box, where the field is solved outside of it."""
    if par[L.P_FIDELITY] != L.MAP or par[L.P_OUTSIDE_MAP] != L.SOLVE:
        return 1.0
    room = room_in_map(work[TABLE_AT:], pt)
    return room + SMALLEST if discrete[D_ON_MAP] == 1.0 else WELL_INSIDE - room


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
    several = found[1] == 2.0 or discrete[D_SEVERAL] == L.MULTIPLE
    if status == OK and several and before != 0.0 and found[0] != before:
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
    discrete[D_SEVERAL] = w.found[L.MULTIPLICITY]
    if w.found[L.MULTIPLICITY] == L.SINGLE:
        discrete[D_BRANCH] = w.found[L.BRANCH]


@kernel
def enter_branch(par: Array, inp: Array, discrete: Array, work: Array) -> int:
    """Look up on the branch, or the other where it has ended, and stay; return a status."""
    status, room = looked_up(par, inp, discrete, work)
    if status == OK and room <= 0.0:
        discrete[D_BRANCH] = 0.0
        status, _ = looked_up(par, inp, discrete, work)
    if status == OK:
        w = workspace_of(par, work)
        discrete[D_BRANCH], discrete[D_SEVERAL] = w.found[L.BRANCH], w.found[L.MULTIPLICITY]
        keep_place(w, discrete)
    return status


@kernel
def asks_map(par: Array, pt: Point, work: Array) -> bool:
    """Tell if the map is asked from the start on."""
    if par[L.P_FIDELITY] != L.MAP:
        return False
    covered = map_covers(work[TABLE_AT:], pt)
    return bool(covered or par[L.P_OUTSIDE_MAP] != L.SOLVE)
