"""Solutions on a washer's curve that are kept, and guesses made of them.

A store is one flat array of places, each as long as ``size_of_node`` says: film thickness, load,
slope and share of the contact, positions, temperatures, pressures.
"""

import math

from ....numerics.arrays import copy
from ....numerics.jit import Array, kernel
from .. import layout as L
from ..workspace import Workspace, fields_of

FILM, LOAD, SLOPE, SHARE, POSITIONS, TEMPERATURES = 0, 1, 2, 3, 4, 8


@kernel
def size_of_node(w: Workspace) -> int:
    """Return how many numbers a place has."""
    f = fields_of(w)
    return TEMPERATURES + int(f.temp.size) + int(f.p.size)


@kernel
def film_at(w: Workspace, store: Array, k: int) -> float:
    """Return the film thickness [m] of a place."""
    return float(store[k * size_of_node(w) + FILM])


@kernel
def load_at(w: Workspace, store: Array, k: int) -> float:
    """Return the load [N] of a place."""
    return float(store[k * size_of_node(w) + LOAD])


@kernel
def keep_node(w: Workspace, store: Array, k: int) -> None:
    """Keep the present solution as place ``k``."""
    f, size = fields_of(w), size_of_node(w)
    own = store[k * size : (k + 1) * size]
    own[FILM], own[LOAD] = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
    own[SLOPE], own[SHARE] = w.curve[L.AT_SLOPE], w.curve[L.AT_SHARE]
    copy(w.q, own[POSITIONS:TEMPERATURES])
    copy(f.temp, own[TEMPERATURES : TEMPERATURES + f.temp.size])
    copy(f.p, own[TEMPERATURES + f.temp.size :])


@kernel
def move_node(w: Workspace, store: Array, fro: int, to: int) -> None:
    """Copy a place over another one."""
    size = size_of_node(w)
    copy(store[fro * size : (fro + 1) * size], store[to * size : (to + 1) * size])


@kernel
def go_to_node(w: Workspace, store: Array, k: int) -> None:
    """Make a place the present solution; the heat factor stays that of the one before."""
    f, size = fields_of(w), size_of_node(w)
    own = store[k * size : (k + 1) * size]
    w.curve[L.AT_FILM], w.curve[L.AT_LOAD] = own[FILM], own[LOAD]
    w.curve[L.AT_SLOPE], w.curve[L.AT_SHARE] = own[SLOPE], own[SHARE]
    copy(own[POSITIONS:TEMPERATURES], w.q)
    copy(own[TEMPERATURES : TEMPERATURES + f.temp.size], f.temp)
    copy(own[TEMPERATURES + f.temp.size :], f.p)


@kernel
def _weight(w: Workspace, store: Array, places: Array, n: int, i: int, load: float) -> float:
    """Return how much place ``i`` of ``n`` counts at a load: Lagrange, over its logarithm."""
    at, own, weight = math.log(load), math.log(load_at(w, store, int(places[i]))), 1.0
    for j in range(n):
        if j != i:
            other = math.log(load_at(w, store, int(places[j])))
            weight = weight * (at - other) / (own - other)
    return weight


@kernel
def guess_from(w: Workspace, store: Array, places: Array, n: int, load: float) -> None:
    """Stand where the polynomial through the first ``n`` of ``places`` leads at a load [N]."""
    f, size = fields_of(w), size_of_node(w)
    for i in range(n):
        weight, first = _weight(w, store, places, n, i, load), int(places[i]) * size
        own = store[first : first + size]
        _add(own[POSITIONS:TEMPERATURES], weight, w.q, i == 0)
        _add(own[TEMPERATURES : TEMPERATURES + f.temp.size], weight, f.temp, i == 0)
        _add(own[TEMPERATURES + f.temp.size :], weight, f.p, i == 0)


@kernel
def _add(own: Array, weight: float, to: Array, is_first: bool) -> None:
    """Add a multiple of an array; the first one takes the place of what is there."""
    for k in range(to.size):
        to[k] = (0.0 if is_first else to[k]) + weight * own[k]
