"""Look-ups for Python: one number, many rows, and the folds of a curve."""

import math

from ....numerics.chebyshev import SHARES
from ....numerics.jit import Array, kernel
from .. import layout as L
from ..workspace import Point
from . import map_layout as M
from .map_point import map_outputs
from .map_search import (
    SAMPLES,
    SHALLOW,
    enter_map,
    find_extremum,
    load_at,
    ratio_at,
    read_edges,
    read_lines,
    read_loads,
)
from .map_step import N_MAP_WORK, PLACE, place_without_memory


@kernel
def single_look_up(
    data: Array,
    w: Array,
    load: float,
    speed: float,
    tilt: float,
    oil_temperature: float,
    wanted: float,
) -> float:
    """Return the friction torque [N m], nan if there is none; all outputs go to ``w[N_MAP_WORK:]``.

    ``w`` has N_MAP_WORK + L.N_ALL entries. Few arguments: each costs a call from Python 0.1 us.
    """
    pt = Point(load, speed, tilt, oil_temperature, oil_temperature)
    if place_without_memory(data, pt, wanted, w) <= 0.0:
        return math.nan
    out = w[N_MAP_WORK:]
    map_outputs(data, w, pt, w[PLACE:], out)
    return float(out[0])


@kernel
def look_up_rows(
    data: Array, rows: Array, wanted: float, w: Array, out: Array, found: Array
) -> None:
    """Look many points up.

    Parameters
    ----------
    rows : (n, 4) load, speed, tilt, oil temperature
    out : (n, L.N_ALL), nan where there is nothing
    found : (n, 2) branch (0 no such branch, -1 outside) and 2 where there are several, else 1
    """
    for i in range(rows.shape[0]):
        pt = Point(rows[i, 0], rows[i, 1], rows[i, 2], rows[i, 3], rows[i, 3])
        branch = place_without_memory(data, pt, wanted, w)
        found[i, 0], found[i, 1] = branch, 1.0
        if branch <= 0.0:
            for k in range(L.N_ALL):
                out[i, k] = math.nan
            continue
        read_edges(data, w)
        if w[M.STEEP] > 0.0:
            found[i, 1] = 2.0
        map_outputs(data, w, pt, w[PLACE:], out[i])


@kernel
def map_folds(
    data: Array, speed: float, tilt: float, oil_temperature: float, w: Array, folds: Array
) -> int:
    """Fill rows of ``folds`` (n, L.N_ALL + 2): outputs, load; return how many there are.

    They come from the thick end: where the film is lost, where it is regained, and so on.
    """
    place = w[PLACE:]
    scale = enter_map(data, Point(1.0, speed, tilt, oil_temperature, oil_temperature), w)
    read_edges(data, w)
    count, rising = 0, True
    best_piece, best_u, best = 0.0, 1.0, 0.0
    fine = 2 * SAMPLES
    for piece in range(M.N_PIECES):
        read_loads(data, w, piece)
        n = int(data[M.TERMS + piece])
        for k in range(fine + 1):
            u = 1.0 - 2.0 * k / fine
            here, _ = load_at(w, n, piece, scale, u)
            side = 1.0 if rising else -1.0
            if best > 0.0 and side * (here - best) < -SHALLOW * best and count < folds.shape[0]:
                # the extremum lies beside the best sample
                n_best = int(data[M.TERMS + int(best_piece)])
                first = min(best_u + 2.0 / fine, 1.0)
                last = max(best_u - 2.0 / fine, -1.0)
                at = find_extremum(w, n_best, int(best_piece), scale, first, last)
                load, _ = load_at(w, n_best, int(best_piece), scale, at)
                if side * (load - best) < 0.0:
                    at, load = best_u, best
                place[M.AT_PIECE], place[M.AT_U], place[M.AT_SCALE] = best_piece, at, scale
                place[M.AT_RATIO] = ratio_at(w, int(best_piece), at)
                pt = Point(load, speed, tilt, oil_temperature, oil_temperature)
                map_outputs(data, w, pt, place, folds[count])
                folds[count, L.N_ALL] = load
                count += 1
                rising = not rising
                best_piece, best_u, best = piece, u, here
            elif best <= 0.0 or side * (here - best) > 0.0:
                best_piece, best_u, best = piece, u, here
    return count


@kernel
def map_tilts(data: Array, w: Array, tilts: Array) -> None:
    """Fill ``tilts`` (2,): the washer's tilts about x and y over the gear's, at the place in w."""
    piece, u = int(w[PLACE + M.AT_PIECE]), w[PLACE + M.AT_U]
    n, first = M.N_TILT_TERMS, int(data[M.PIECE_AT + piece + 1]) - M.N_TILTS
    read_lines(data, w, first, M.N_TILTS, SHARES, M.CHANGE)
    square = 2.0 * u * u - 1.0
    cube = 2.0 * u * square - u
    for k in range(2):
        c = M.CHANGE + k * n
        tilts[k] = w[c] + w[c + 1] * u + w[c + 2] * square + w[c + 3] * cube
