"""A washer at rising loads, solved on both ways of the load: loads up, and loads down.

From load to load while the film is clear, then along the curve of solutions until no fold can
follow; between the places there each load is solved on the film branch and on the contact branch.
One call takes one step of this, so that its caller can do something else in between.
"""

import math

from ....numerics.arrays import clear, copy
from ....numerics.jit import Array, Ints, kernel
from ....numerics.status import OK
from .. import layout as L
from ..branch import FILM_RATIO, ROUGHLY, is_clear_film, is_near_fold
from ..continuation import ALONE, SHALLOW, go_to_film, note, start_at, step_down
from ..newton import LOAD, NO_FLOOR, film_ratio, newton
from ..outputs import outputs_at
from ..regime_and_status import point_of
from ..step import step
from ..workspace import Point, Workspace, forget_factor, temperatures_of, workspace_of
from .node_store import (
    film_at,
    go_to_node,
    guess_from,
    keep_node,
    load_at,
    move_node,
)

ENTRY_RATIO = 6.0  # film ratio at which the curve is entered where the film is not clear
COARSE = 0.28  # finest step along the curve [sigma]
EXACT = 2e-6  # tolerance at the loads
MOST_NODES = 200  # along the curve
REACH = 5  # solutions that a guess is made of
HALVINGS = 30
CLIMBS = (2, 4, 8)  # steps in which a load beyond the last place is tried
ROW = 2 + L.N_ALL  # numbers of a solution: branch (0: none), load, outputs

# Where the walk stands: what is done next, loads solved on a clear film, places kept, that of the
# extreme load, does the load rise, places next to the folds and on them (-1: none), the next load,
# places on the branch that is solved, has it no solution at higher loads; then these places.
ENDED, STAGE, CLEAR, NODES, TOP, RISES, LOST, REGAINED = range(8)
UPPER_FOLD, LOWER_FOLD, NEXT, ON_BRANCH, BEYOND, HEAD = range(8, 14)
BEGIN, ON_CLEAR_FILM, ALONG, FILM_LOADS, CONTACT_LOADS = 0.0, 1.0, 2.0, 3.0, 4.0


def size_of_walk(n_r: int, n_t: int, n_loads: int) -> int:
    """Return the length of ``walk`` for a grid and a number of loads."""
    node = 8 + temperatures_of(n_r, n_t) + n_r * n_t
    return HEAD + _capacity(n_loads) * (1 + node)


@kernel
def _capacity(n_loads: int) -> int:
    """Return how many places there are: the curve's, loads beyond it, folds, what is tried."""
    return MOST_NODES + 2 + 2 * n_loads + 2 + REACH


@kernel
def _places(walk: Array, n_loads: int) -> Array:
    """Return the places on the branch that is solved."""
    return walk[HEAD : HEAD + _capacity(n_loads)]


@kernel
def _store(walk: Array, n_loads: int) -> Array:
    """Return the solutions that are kept."""
    return walk[HEAD + _capacity(n_loads) :]


@kernel
def follow_loads(
    par: Array,
    inp: Array,
    work: Array,
    loads: Array,
    memory: Array,
    out: Array,
    iout: Ints,
    walk: Array,
    rows: Array,
) -> int:
    """Take the next step; ``walk[0]`` is 1 after the last one. Return a status.

    Parameters
    ----------
    inp : (NINP,) inputs; their load does not count
    loads : (n,) [N], rising
    memory, out, iout : as ``step`` has them, of its own
    walk : (size_of_walk,) where it stands; zeros: it begins
    rows : (2 n ROW,) solutions by load, loads up; then, loads down, those on the contact branch
        that are others. Branch (0: there is none), load [N], outputs
    """
    n = loads.size
    inp[L.I_LOAD] = loads[0]
    w, pt, stage = workspace_of(par, work), point_of(par, inp), walk[STAGE]
    up, down = rows[: n * ROW], rows[n * ROW :]
    if stage == BEGIN:
        clear(rows)
        clear(memory)
        walk[LOST] = walk[REGAINED] = -1.0
        # it sets how heat leaves the bodies, and is where loads on a clear film begin
        return _begin(w, pt, step(par, inp, memory, work, out, iout, 0.0, 1.0), walk, n, up)
    if stage == ON_CLEAR_FILM:
        _on_clear_film(w, pt, loads, walk, up)
    elif stage == ALONG:
        if not _along(w, pt, loads, walk):
            walk[STAGE] = FILM_LOADS
            _find_folds(w, pt, loads, walk)
            _list_film(w, n, walk)
    elif stage == FILM_LOADS:
        k = int(walk[NEXT])
        is_single = walk[LOST] < 0.0
        if k < n and _solve_along(w, pt, loads, k, is_single, walk, up):
            thick = not is_single or up[k * ROW + 2 + L.O_RATIO] >= FILM_RATIO
            up[k * ROW] = L.FILM_BRANCH if thick else L.CONTACT_BRANCH
        walk[NEXT] += 1.0
        if k + 1 >= n and walk[REGAINED] < 0.0:
            walk[ENDED] = 1.0
        elif k + 1 >= n:
            walk[STAGE] = CONTACT_LOADS
            _list_contact(w, n, walk)
    else:
        k = int(walk[NEXT])
        target = down if up[k * ROW] != 0.0 else up
        if _solve_along(w, pt, loads, k, True, walk, target):
            target[k * ROW] = L.CONTACT_BRANCH
        walk[NEXT] += 1.0
        walk[ENDED] = 1.0 if k + 1 >= n else 0.0
    return OK


@kernel
def _show(w: Workspace, pt: Point, row: Array) -> None:
    """Fill load and outputs of the present solution."""
    load = w.curve[L.AT_LOAD]
    outputs_at(w, Point(load, pt.speed, pt.tilt, pt.oil_temperature, pt.far_face))
    row[1] = load
    copy(w.outputs, row[2:])


@kernel
def _begin(w: Workspace, pt: Point, status: int, walk: Array, n: int, up: Array) -> int:
    """Begin on a clear film at the first load, else on the curve above it; return a status."""
    store = _store(walk, n)
    w.curve[L.ACCURACY] = ROUGHLY
    if status == OK and is_clear_film(w):
        note(w)
        _show(w, pt, up[:ROW])
        up[0] = L.FILM_BRANCH
        keep_node(w, store, 0)
        walk[CLEAR], walk[NODES] = 1.0, 1.0
        walk[STAGE], walk[ENDED] = ON_CLEAR_FILM, 1.0 if n == 1 else 0.0
        return OK
    status = start_at(w, pt, ENTRY_RATIO)
    for _ in range(MOST_NODES):
        thick = not w.curve[L.AT_FILM] < 1e3 * w.par[L.D_SIGMA1]
        if status != OK or thick or not w.curve[L.AT_LOAD] > pt.load:
            break
        status = go_to_film(w, pt, 1.25 * w.curve[L.AT_FILM])
    _begin_curve(w, walk, store, 0)
    return status


@kernel
def _begin_curve(w: Workspace, walk: Array, store: Array, nodes: int) -> None:
    """Go along the curve from here; ``nodes`` places are kept before."""
    keep_node(w, store, nodes)
    walk[NODES], walk[TOP] = nodes + 1.0, nodes
    walk[RISES], walk[STAGE] = 1.0, ALONG


@kernel
def _on_clear_film(w: Workspace, pt: Point, loads: Array, walk: Array, up: Array) -> None:
    """Solve at the next load while the film is clear, else go along the curve from the last one."""
    n, i, nodes = loads.size, int(walk[CLEAR]), int(walk[NODES])
    store, places = _store(walk, n), _places(walk, n)
    load, here = loads[i], w.curve[L.AT_LOAD]
    thinner = here * math.log(load / here) / w.curve[L.AT_SLOPE] / w.par[L.D_SIGMA1]
    for k in range(nodes):
        places[k] = k
    if (
        film_ratio(w) + thinner >= FILM_RATIO
        and _solve_from(w, pt, store, places, nodes, load)
        and is_clear_film(w)
    ):
        row = up[i * ROW : (i + 1) * ROW]
        _show(w, pt, row)
        row[0] = L.FILM_BRANCH
        if nodes == REACH:
            nodes -= 1
            for k in range(nodes):
                move_node(w, store, k + 1, k)
        keep_node(w, store, nodes)
        walk[CLEAR], walk[NODES] = i + 1.0, nodes + 1.0
        walk[ENDED] = 1.0 if i + 1 >= n else 0.0
        return
    go_to_node(w, store, nodes - 1)
    forget_factor(w)
    if nodes > 1:  # a fold may be next to the last one
        move_node(w, store, nodes - 2, 0)
    _begin_curve(w, walk, store, 1 if nodes > 1 else 0)


@kernel
def _solve_from(w: Workspace, pt: Point, store: Array, places: Array, n: int, load: float) -> bool:
    """Solve at a load [N] from where other solutions lead; tell if that worked."""
    guess_from(w, store, places, n, load)
    if newton(w, pt, LOAD, load, NO_FLOOR, EXACT, 12.0) != OK:
        return False
    note(w)
    return True


@kernel
def _along(w: Workspace, pt: Point, loads: Array, walk: Array) -> bool:
    """Go on to a thinner film; tell if a fold may still follow, or a load that is asked for."""
    n, sigma, last = loads.size, w.par[L.D_SIGMA1], loads[loads.size - 1]
    store, nodes, top = _store(walk, n), int(walk[NODES]), int(walk[TOP])
    rises, film = walk[RISES] != 0.0, w.curve[L.AT_FILM]
    over = w.curve[L.AT_LOAD] >= last and (walk[LOST] >= 0.0 or film < 0.5 * sigma)
    if nodes > MOST_NODES or (rises and (w.curve[L.AT_SHARE] > ALONE or film < 0.0 or over)):
        return False
    if go_to_film(w, pt, step_down(sigma, film, COARSE)) != OK:
        return False
    keep_node(w, store, nodes)
    walk[NODES] += 1.0
    highest = load_at(w, store, top)
    gain, noise = w.curve[L.AT_LOAD] - highest, SHALLOW * highest + 1e-3
    way = 1.0 if rises else -1.0
    if way * gain < -noise:
        kind = LOST if rises else REGAINED
        if walk[kind] < 0.0:
            walk[kind] = top
        if rises and highest > last:  # the film is lost beyond the loads
            return False
        walk[RISES] = 0.0 if rises else 1.0
        walk[TOP] = nodes
    elif way * gain > 0.0:
        walk[TOP] = nodes
    return True


@kernel
def _find_folds(w: Workspace, pt: Point, loads: Array, walk: Array) -> None:
    """Locate the folds beyond which a load may lie."""
    n = loads.size
    store, lost, regained = _store(walk, n), int(walk[LOST]), int(walk[REGAINED])
    walk[UPPER_FOLD] = walk[LOWER_FOLD] = -1.0
    for k in range(n):
        beyond = lost > 0 and loads[k] > load_at(w, store, lost)
        if beyond and _is_near(w, store, lost, loads[k]):
            walk[UPPER_FOLD] = _fold_at(w, pt, walk, n, lost, 1.0)
            break
    for k in range(n):
        beyond = regained > 0 and loads[k] < load_at(w, store, regained)
        if beyond and _is_near(w, store, regained, loads[k]):
            walk[LOWER_FOLD] = _fold_at(w, pt, walk, n, regained, -1.0)
            break


@kernel
def _list_film(w: Workspace, n: int, walk: Array) -> None:
    """List the places of the film branch up to its fold, all where the curve has none."""
    store, places, kept = _store(walk, n), _places(walk, n), 0
    lost, fold = int(walk[LOST]), int(walk[UPPER_FOLD])
    for k in range(lost + 1 if lost >= 0 else int(walk[NODES])):
        if fold < 0 or film_at(w, store, k) > film_at(w, store, fold):
            places[kept] = k
            kept += 1
    if fold >= 0:
        places[kept] = fold
        kept += 1
    walk[ON_BRANCH], walk[BEYOND], walk[NEXT] = kept, 0.0, walk[CLEAR]


@kernel
def _list_contact(w: Workspace, n: int, walk: Array) -> None:
    """List the places of the contact branch from its fold on."""
    store, places, kept, fold = _store(walk, n), _places(walk, n), 0, int(walk[LOWER_FOLD])
    if fold >= 0:
        places[0] = fold
        kept = 1
    for k in range(int(walk[REGAINED]), int(walk[NODES])):
        if fold < 0 or film_at(w, store, k) < film_at(w, store, fold):
            places[kept] = k
            kept += 1
    walk[ON_BRANCH], walk[BEYOND], walk[NEXT] = kept, 0.0, 0.0


@kernel
def _is_near(w: Workspace, store: Array, k: int, load: float) -> bool:
    """Tell if the fold next to place ``k`` may lie beyond a load."""
    films = film_at(w, store, k - 1), film_at(w, store, k), film_at(w, store, k + 1)
    return is_near_fold(
        films, (load_at(w, store, k - 1), load_at(w, store, k), load_at(w, store, k + 1)), load
    )


@kernel
def _spare(walk: Array, n: int) -> int:
    """Return the first of the places that are for what is tried; behind the last fold's."""
    return MOST_NODES + 2 + 2 * n + 2


@kernel
def _fold_at(w: Workspace, pt: Point, walk: Array, n: int, middle: int, sign: float) -> int:
    """Return the place of greatest (``sign`` 1) or least load about one, by parabolas."""
    store, sigma = _store(walk, n), w.par[L.D_SIGMA1]
    one, top, two = middle - 1, middle, middle + 1
    free = _spare(walk, n)
    for _ in range(6):
        s0, s1, s2 = film_at(w, store, one), film_at(w, store, top), film_at(w, store, two)
        load = load_at(w, store, top)
        p, q = (
            (load - load_at(w, store, one)) / (s1 - s0),
            (load - load_at(w, store, two)) / (s1 - s2),
        )
        film = 0.5 * (s1 + s0 - p * (s2 - s0) / (q - p))
        if not s2 < film < s0 or abs(film - s1) < 1e-3 * sigma:
            break
        go_to_node(w, store, top)
        if go_to_film(w, pt, film) != OK:
            break
        keep_node(w, store, free)
        better, found = sign * (load_at(w, store, free) - load) > 0.0, free
        free = _other(found, one, top, two, _spare(walk, n))
        if better and film > s1:
            one, top, two = one, found, top
        elif better:
            one, top, two = top, found, two
        elif film > s1:
            one = found
        else:
            two = found
    if top < _spare(walk, n):
        return top
    fold = _spare(walk, n) - (2 if sign > 0.0 else 1)
    move_node(w, store, top, fold)
    return fold


@kernel
def _other(a: int, b: int, c: int, d: int, first: int) -> int:
    """Return a place from ``first`` on that is none of four."""
    for k in range(first, first + REACH):
        if k not in (a, b, c, d):
            return k
    return first


@kernel
def _solve_along(
    w: Workspace, pt: Point, loads: Array, which: int, on: bool, walk: Array, rows: Array
) -> bool:
    """Solve at a load between places of rising load, ``on`` beyond the last one too.

    Fills the load's row, but for its branch; False: there is no such solution.
    """
    n, load = loads.size, loads[which]
    store, places, count = _store(walk, n), _places(walk, n), int(walk[ON_BRANCH])
    i = 0
    while i < count and load_at(w, store, int(places[i])) < load:
        i += 1
    if i == 0 or (i == count and (not on or walk[BEYOND] != 0.0)):
        return False
    end = min(i, count - 1)
    first = max(0, end - 2)
    near = places[first : end + 1]
    solved = _solve_from(w, pt, store, near, end + 1 - first, load)
    if i == count:
        if not solved and not _climb(w, pt, walk, n, int(places[end]), load):
            walk[BEYOND] = 1.0  # nor is there a solution at higher loads
            return False
        nodes = int(walk[NODES])
        keep_node(w, store, nodes)
        places[count] = nodes
        walk[NODES], walk[ON_BRANCH] = nodes + 1.0, count + 1.0
    else:
        upper, lower = int(places[i - 1]), int(places[i])
        if (not solved or _is_outside(w, store, upper, lower)) and not _search(
            w, pt, walk, n, upper, lower, load
        ):
            return False
    _show(w, pt, rows[which * ROW : (which + 1) * ROW])
    return True


@kernel
def _is_outside(w: Workspace, store: Array, upper: int, lower: int) -> bool:
    """Tell if the present film is clearly not between those of two places."""
    above, below, film = film_at(w, store, upper), film_at(w, store, lower), w.curve[L.AT_FILM]
    margin = 0.1 * (above - below)
    return bool(film > above + margin or film < below - margin)


@kernel
def _climb(w: Workspace, pt: Point, walk: Array, n: int, fro: int, load: float) -> bool:
    """Solve at a load above a place in 2, 4 or 8 steps; tell if that goes."""
    store, free = _store(walk, n), _spare(walk, n)
    from_load = load_at(w, store, fro)
    places = walk[HEAD + free : HEAD + free + 2]
    for steps in CLIMBS:
        before, known, solved = fro, 0, True
        places[1] = fro
        for k in range(1, steps + 1):
            target = from_load * math.exp(math.log(load / from_load) * k / steps)
            near = places[1:] if known == 0 else places
            solved = solved and _solve_from(w, pt, store, near, 1 if known == 0 else 2, target)
            if not solved:
                break
            before, known = free + k % 2, known + 1
            keep_node(w, store, before)
            places[0], places[1] = places[1], before
        if solved:
            return True
    return False


@kernel
def _search(
    w: Workspace, pt: Point, walk: Array, n: int, upper: int, lower: int, load: float
) -> bool:
    """Solve at a load between two places that Newton's method alone does not find."""
    store, free = _store(walk, n), _spare(walk, n)
    places = walk[HEAD + free : HEAD + free + 2]
    for _ in range(HALVINGS):
        go_to_node(w, store, upper)
        forget_factor(w)
        middle = 0.5 * (film_at(w, store, upper) + film_at(w, store, lower))
        if go_to_film(w, pt, middle) != OK:
            return False
        if w.curve[L.AT_LOAD] < load:
            upper = free
            keep_node(w, store, upper)
        else:
            lower = free + 1
            keep_node(w, store, lower)
        places[0], places[1] = upper, lower
        if _solve_from(w, pt, store, places, 2, load) and not _is_outside(w, store, upper, lower):
            return True
    return False
