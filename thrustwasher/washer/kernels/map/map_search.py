"""Looking a washer up: from load, speed, tilt and oil temperature to a point on the map's curve."""

import math

from ....numerics.chebyshev import N_TERMS, contract, enter_cell, polynomial_slope
from ....numerics.jit import Array, kernel
from ..gap import oil_viscosity
from ..workspace import Point
from . import map_layout as M
from .map_layout import THICK

FOUND, LOST, THIN, THICKER = 0, 1, 2, 3  # results of a search
SAMPLES = 8  # of a piece in which a fold may lie
SHALLOW = 3e-4  # relative drop of the load that makes a fold
EXACT = 1e-12  # relative, of the load
CLOSE = 1e-6  # Newton's last step
# places in `place`, where a solution lies
AT_PIECE, AT_U, AT_RATIO, AT_SCALE, N_PLACE = 0, 1, 2, 3, 4


@kernel
def map_fits(data: Array, par: Array, n_params: int) -> bool:
    """Tell if there is a map and if it was made for the first ``n_params`` parameters."""
    if data.size < M.DATA or data[M.KIND] != M.MAGIC:
        return False
    for k in range(n_params):
        if data[M.PARAMS + k] != par[k]:
            return False
    return True


@kernel
def _within(data: Array, axis: int, x: float) -> bool:
    """Tell if ``x`` lies on an axis, rounding allowed for."""
    low, high = data[M.AXES + 3 * axis], data[M.AXES + 3 * axis + 1]
    slack = 1e-9 * max(abs(low), abs(high))
    return bool(low - slack <= x <= high + slack)


@kernel
def map_covers(data: Array, pt: Point) -> bool:
    """Tell if a point lies in the map's box."""
    if not data[M.LOAD_MIN] <= pt.load <= data[M.LOAD_MAX]:
        return False
    bend = data[M.BEND]
    speed = abs(pt.speed)
    if data[M.AXES] <= math.asinh(M.FLOOR_SPEED / bend):
        speed = max(speed, bend * math.sinh(data[M.AXES]))
    return (
        pt.tilt > 0.0 and _within(data, 0, math.asinh(speed / bend))
        and _within(data, 1, math.log(pt.tilt)) and _within(data, 2, pt.oil_temperature)
    )  # fmt: skip


@kernel
def enter_map(data: Array, pt: Point, w: Array) -> float:
    """Place the cell and the thick piece's ends in ``w``; return viscosity x |speed|.

    The other edges wait for `read_edges`: most look-ups end in a thick film.
    """
    speed = abs(pt.speed)
    cell = w[M.CELL :]
    a = M.AXES
    x = math.asinh(speed / data[M.BEND])
    enter_cell(cell, 0, x, data[a], data[a + 1], int(data[a + 2]))
    enter_cell(cell, 1, math.log(pt.tilt), data[a + 3], data[a + 4], int(data[a + 5]))
    enter_cell(cell, 2, pt.oil_temperature, data[a + 6], data[a + 7], int(data[a + 8]))
    mu, _ = oil_viscosity(data[M.PARAMS :], pt.oil_temperature)
    scale = mu * speed
    w[M.EDGES] = math.sqrt(M.LEAST_REACH * M.LEAST_REACH + data[M.REACH] * scale)
    w[M.EDGES + 1] = data[M.ONSET]
    w[M.STEEP] = math.nan
    return float(scale)


@kernel
def read_edges(data: Array, w: Array) -> None:
    """Interpolate the edges of the pieces with contact, and if there are folds, once per place."""
    if not math.isnan(w[M.STEEP]):
        return
    read_lines(data, w, 0, M.N_LINE_HEAD, -1, M.HEAD)
    w[M.EDGES + 2] = w[M.HEAD] + M.MIDDLE * (data[M.ONSET] - w[M.HEAD])
    w[M.EDGES + 3], w[M.EDGES + 4], w[M.EDGES + 5] = w[M.HEAD], w[M.HEAD + 1], w[M.HEAD + 2]
    w[M.STEEP] = w[M.HEAD + M.STEEPEST]


@kernel
def read_lines(data: Array, w: Array, first: int, width: int, slope_of: int, to: int) -> None:
    """Interpolate numbers ``first ..`` of the lines around the cell into ``w[to:]``."""
    patches1, patches2 = int(data[M.AXES + 2]), int(data[M.AXES + 5])
    patches3 = int(data[M.AXES + 8])
    row = M.LINE * (3 * patches3 + 1)
    step1 = row * (3 * patches2 + 1) if patches1 > 0 else 0
    step2 = row if patches2 > 0 else 0
    step3 = M.LINE if patches3 > 0 else 0
    contract(data, M.DATA + first, step1, step2, step3, w, slope_of, width, w, to)


@kernel
def read_loads(data: Array, w: Array, piece: int) -> None:
    """Interpolate the two curves of a piece that make up the load."""
    read_lines(data, w, M.N_LINE_HEAD + piece * M.PIECE, 2 * N_TERMS, -1, M.CURVES)


@kernel
def load_at(w: Array, piece: int, scale: float, u: float) -> tuple[float, float]:
    """Return load [N] and its slope over ``u`` in the piece whose curves are in ``w``."""
    log_fluid, slope_fluid = polynomial_slope(w, M.CURVES + M.GF * N_TERMS, u)
    fluid = scale * math.exp(min(log_fluid, 600.0))
    if piece == THICK:
        return fluid, fluid * slope_fluid
    log_contact, slope_contact = polynomial_slope(w, M.CURVES + M.GC * N_TERMS, u)
    contact = math.exp(min(log_contact, 600.0))
    return fluid + contact, fluid * slope_fluid + contact * slope_contact


@kernel
def ratio_at(w: Array, piece: int, u: float) -> float:
    """Return the film ratio at ``u``, -1 at the thin and 1 at the thick end of a piece."""
    thick, thin = w[M.EDGES + piece], w[M.EDGES + piece + 1]
    if piece == THICK:
        return float(math.exp(0.5 * ((1.0 + u) * math.log(thick) + (1.0 - u) * math.log(thin))))
    return float(0.5 * ((1.0 + u) * thick + (1.0 - u) * thin))


@kernel
def u_at(w: Array, piece: int, ratio: float) -> float:
    """Return where a film ratio lies in a piece."""
    thick, thin = w[M.EDGES + piece], w[M.EDGES + piece + 1]
    if piece == THICK:
        thick, thin, ratio = math.log(thick), math.log(thin), math.log(ratio)
    return float((2.0 * ratio - thick - thin) / (thick - thin))


@kernel
def find_between(
    w: Array, piece: int, scale: float, load: float, heavy: float, light: float, guess: float
) -> float:
    """Return ``u`` between ``heavy`` and ``light`` with the wanted load: Newton kept in brackets.

    In ln(load), in which the curves are nearly straight; at ``heavy`` the load is greater.
    """
    u = guess
    for _ in range(60):
        here, slope = load_at(w, piece, scale, u)
        off = math.log(here / load)
        if off > 0.0:
            heavy = u
        else:
            light = u
        low, high = min(heavy, light), max(heavy, light)
        following = u - off * here / slope if slope != 0.0 else low - 1.0
        if not low < following < high:
            if abs(off) < EXACT:
                return u
            following = 0.5 * (low + high)
        elif abs(following - u) < CLOSE:  # the next one would be right to CLOSE^2
            return following
        u = following
    return u


@kernel
def find_extremum(w: Array, piece: int, scale: float, one: float, two: float) -> float:
    """Return where between two places the slope of the load changes its sign (bisection)."""
    _, rising = load_at(w, piece, scale, one)
    for _ in range(44):
        middle = 0.5 * (one + two)
        _, slope = load_at(w, piece, scale, middle)
        if (slope > 0.0) == (rising > 0.0):
            one = middle
        else:
            two = middle
    return 0.5 * (one + two)


@kernel
def _cross_piece(w: Array, piece: int, scale: float, load: float, down: bool, best: Array) -> float:
    """Search a piece from its thick end (``down``) or its thin end; return ``u``, 2 or 3.

    2: not in this piece. 3: a fold came first. ``best`` (1,) is the extreme load on the way, over
    the pieces already passed, and is kept up to date. Going down the load has to rise to ``load``,
    going up it has to fall to it.
    """
    side = 1.0 if down else -1.0
    steps = 1 if piece == THICK or w[M.STEEP] < 0.0 else SAMPLES
    last, load_then = side, 0.0
    for k in range(steps + 1):
        u = side * (1.0 - 2.0 * k / steps)
        here, _ = load_at(w, piece, scale, u)
        if side * (here - load) >= 0.0:
            if k == 0:
                return u  # the border belongs to both
            heavy, light = (u, last) if down else (last, u)
            share = math.log(load / load_then) / math.log(here / load_then)
            return find_between(w, piece, scale, load, heavy, light, last + share * (u - last))
        if best[0] > 0.0 and side * (here - best[0]) < -SHALLOW * best[0]:
            # turned back: the extremum lies within two steps before
            first = min(max(u + side * 4.0 / steps, -1.0), 1.0)
            top = find_extremum(w, piece, scale, first, u)
            peak, _ = load_at(w, piece, scale, top)
            if side * (peak - load) >= 0.0:
                heavy, light = (top, first) if down else (first, top)
                return find_between(w, piece, scale, load, heavy, light, 0.5 * (top + first))
            return 3.0
        if best[0] <= 0.0 or side * (here - best[0]) > 0.0:
            best[0] = here
        last, load_then = u, here
    return 2.0


@kernel
def search_map(data: Array, w: Array, scale: float, load: float, down: bool, place: Array) -> int:
    """Find the first point with the wanted load from the thick or the thin end; fill ``place``."""
    best = w[M.STEEP + 1 : M.STEEP + 2]
    best[0] = 0.0
    for k in range(M.N_PIECES):
        piece = k if down else M.N_PIECES - 1 - k
        if piece != THICK:
            read_edges(data, w)
        read_loads(data, w, piece)
        u = _cross_piece(w, piece, scale, load, down, best)
        if u == 3.0:
            return LOST
        if u < 1.5:
            place[AT_PIECE], place[AT_U], place[AT_SCALE] = piece, u, scale
            place[AT_RATIO] = ratio_at(w, piece, u)
            return FOUND
    return THIN if down else THICKER


@kernel
def continue_map(
    data: Array, w: Array, scale: float, load: float, before: float, reach: float, place: Array
) -> bool:
    """Find the point near film ratio ``before`` on the same stable branch; True if it is there.

    It must lie in the piece that holds ``before`` and within ``reach`` of it (in a thick film:
    relative to it), and the load must fall with the film ratio all the way.
    """
    piece = THICK
    if before < w[M.EDGES + 1]:
        read_edges(data, w)
        if before < w[M.EDGES + M.N_PIECES]:
            return False
    while piece < M.N_PIECES - 1 and before < w[M.EDGES + piece + 1]:
        piece += 1
    if before > w[M.EDGES]:
        return False
    read_loads(data, w, piece)
    u = u_at(w, piece, before)
    for _ in range(8):
        here, slope = load_at(w, piece, scale, u)
        if not slope < 0.0:
            return False
        off = math.log(here / load)
        step = -off * here / slope
        u += step
        if not abs(u) <= 1.0:
            return False
        if abs(step) < CLOSE:
            ratio = ratio_at(w, piece, u)
            allowed = reach * max(1.0, before / 5.0)
            if abs(ratio - before) > allowed:
                return False
            place[AT_PIECE], place[AT_U], place[AT_RATIO], place[AT_SCALE] = piece, u, ratio, scale
            return True
    return False
