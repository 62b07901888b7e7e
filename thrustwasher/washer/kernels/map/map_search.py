"""Looking a washer up: from load, speed, tilt and oil temperature to a point on the map's curve."""

import math

from ....numerics.chebyshev import (
    SHARES,
    contract,
    enter_cell,
    polynomial,
    polynomial_slope,
    share_out,
)
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
HALVED_FROM = 20  # steps: forty halvings leave 1e-12 of any bracket
SLACK = 1e-9  # relative, of the ends of speed, tilt and oil temperature
LOADS, ALL = 1.0, 2.0  # what of a piece is interpolated


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
def map_covers(data: Array, pt: Point) -> bool:
    """Tell if a point lies in the map's box, rounding of all but the load allowed for."""
    b, speed = M.BOX, abs(pt.speed)
    low, high = 1.0 - SLACK, 1.0 + SLACK
    return bool(
        data[b] <= pt.load <= data[b + 1]
        and low * data[b + 2] <= speed <= high * data[b + 3]
        and low * data[b + 4] <= pt.tilt <= high * data[b + 5]
        and low * data[b + 6] <= pt.oil_temperature <= high * data[b + 7]
    )


@kernel
def nearest(data: Array, pt: Point) -> Point:
    """Return the point of the map's box that is nearest: each input within its own ends."""
    b, speed = M.BOX, abs(pt.speed)
    speed = math.copysign(min(max(speed, data[b + 2]), data[b + 3]), pt.speed)
    oil = min(max(pt.oil_temperature, data[b + 6]), data[b + 7])
    return Point(
        min(max(pt.load, data[b]), data[b + 1]),
        speed,
        min(max(pt.tilt, data[b + 4]), data[b + 5]),
        oil,
        oil,
    )


@kernel
def enter_map(data: Array, pt: Point, w: Array) -> float:
    """Place the cell and the thick piece's ends in ``w``; return viscosity x |speed|.

    The other edges wait for `read_edges`: most look-ups end in a thick film. What is interpolated
    is kept as long as only the load changes.
    """
    speed = abs(pt.speed)
    tag = M.TAG
    if (
        w[tag + 1] == speed
        and w[tag + 2] == pt.tilt
        and w[tag + 3] == pt.oil_temperature
        and w[tag] == data[M.IDENTITY]
    ):
        return float(w[M.SCALE])
    w[tag], w[tag + 1] = data[M.IDENTITY], speed
    w[tag + 2], w[tag + 3] = pt.tilt, pt.oil_temperature
    cell = w[M.CELL :]
    a = M.AXES
    mu, _ = oil_viscosity(data[M.PARAMS :], pt.oil_temperature)
    x = math.asinh(speed / data[M.BEND])
    enter_cell(cell, 0, x, data[a], data[a + 1], int(data[a + 2]))
    enter_cell(cell, 1, math.log(pt.tilt), data[a + 3], data[a + 4], int(data[a + 5]))
    enter_cell(cell, 2, -math.log(mu), data[a + 6], data[a + 7], int(data[a + 8]))
    share_out(cell)
    scale = mu * speed
    w[M.SCALE] = scale
    w[M.EDGES] = math.sqrt(M.LEAST_REACH * M.LEAST_REACH + data[M.REACH] * scale)
    w[M.EDGES + 1] = data[M.ONSET]
    w[M.STEEP] = math.nan
    for piece in range(M.N_PIECES):
        w[M.READ + piece] = 0.0
    return float(scale)


@kernel
def read_lines(data: Array, w: Array, first: int, width: int, shares: int, to: int) -> None:
    """Interpolate numbers ``first ..`` of the lines around the cell into ``w[to:]``."""
    a, line = M.AXES, int(data[M.PIECE_AT + M.N_PIECES])
    contract(
        data,
        M.DATA + first,
        line,
        int(data[a + 2]),
        int(data[a + 5]),
        int(data[a + 8]),
        w,
        shares,
        width,
        w,
        to,
    )


@kernel
def read_edges(data: Array, w: Array) -> None:
    """Interpolate the edges of the pieces with contact, and if there are folds, once per place."""
    if not math.isnan(w[M.STEEP]):
        return
    read_lines(data, w, 0, M.N_LINE_HEAD, SHARES, M.HEAD)
    w[M.EDGES + 2] = w[M.HEAD] + M.MIDDLE * (data[M.ONSET] - w[M.HEAD])
    w[M.EDGES + 3], w[M.EDGES + 4], w[M.EDGES + 5] = w[M.HEAD], w[M.HEAD + 1], w[M.HEAD + 2]
    w[M.STEEP] = w[M.HEAD + M.STEEPEST]


@kernel
def _read_curves(data: Array, w: Array, piece: int, first: int, end: int) -> None:
    """Interpolate some of a piece's coefficients, and some around them: a width that is fast."""
    start = int(data[M.PIECE_AT + piece])
    width = (end - first + M.WIDTH - 1) // M.WIDTH * M.WIDTH
    first = min(first, int(data[M.PIECE_AT + piece + 1]) - start - width)
    read_lines(data, w, start + first, width, SHARES, M.CURVES + piece * M.MOST + first)


@kernel
def read_loads(data: Array, w: Array, piece: int) -> None:
    """Interpolate the curves of a piece that make up the load, unless they are there."""
    if w[M.READ + piece] >= LOADS:
        return
    n = int(data[M.TERMS + piece])
    _read_curves(data, w, piece, 0, n if piece == THICK else 2 * n)
    w[M.READ + piece] = LOADS


@kernel
def read_rest(data: Array, w: Array, piece: int) -> None:
    """Interpolate the other curves of a piece, unless they are there; its loads are."""
    if w[M.READ + piece] >= ALL:
        return
    n = int(data[M.TERMS + piece])
    first = (M.VISCOUS if piece == THICK else M.DRY) * n
    end = M.N_MAIN * n + M.N_MORE * int(data[M.MORE_TERMS + piece])
    _read_curves(data, w, piece, first, end)
    w[M.READ + piece] = ALL


@kernel
def load_at(w: Array, n: int, piece: int, scale: float, u: float) -> tuple[float, float]:
    """Return load [N] and its slope over ``u`` in a piece whose curves are in ``w``.

    ``n`` is the number of coefficients.
    """
    at = M.CURVES + piece * M.MOST
    log_fluid, slope_fluid = polynomial_slope(w, at, n, u)
    fluid = scale * math.exp(min(log_fluid, 600.0))
    if piece == THICK:
        return fluid, fluid * slope_fluid
    log_contact, slope_contact = polynomial_slope(w, at + n, n, u)
    contact = math.exp(min(log_contact, 600.0))
    return fluid + contact, fluid * slope_fluid + contact * slope_contact


@kernel
def ratio_at(w: Array, piece: int, u: float) -> float:
    """Return the film ratio at ``u``, -1 at the thin and 1 at the thick end of a piece."""
    thick, thin = w[M.EDGES + piece], w[M.EDGES + piece + 1]
    if piece == THICK:
        return float(thin * math.exp(0.5 * (1.0 + u) * math.log(thick / thin)))
    return float(0.5 * ((1.0 + u) * thick + (1.0 - u) * thin))


@kernel
def u_at(w: Array, piece: int, ratio: float) -> float:
    """Return where a film ratio lies in a piece."""
    thick, thin = w[M.EDGES + piece], w[M.EDGES + piece + 1]
    if piece == THICK:
        return float(2.0 * math.log(ratio / thin) / math.log(thick / thin) - 1.0)
    return float((2.0 * ratio - thick - thin) / (thick - thin))


@kernel
def find_between(
    w: Array,
    n: int,
    piece: int,
    scale: float,
    load: float,
    heavy: float,
    light: float,
    guess: float,
) -> float:
    """Return ``u`` between ``heavy`` and ``light`` with the wanted load: Newton kept in brackets.

    In ln(load), in which the curves are nearly straight; at ``heavy`` the load is greater.
    """
    u = guess
    log_fluid = math.log(load / scale) if piece == THICK else 0.0
    for n_steps in range(60):
        if piece == THICK:
            value, slope = polynomial_slope(w, M.CURVES, n, u)
            off = value - log_fluid
        else:
            here, slope = load_at(w, n, piece, scale, u)
            off, slope = math.log(here / load), slope / here
        if off > 0.0:
            heavy = u
        else:
            light = u
        low, high = min(heavy, light), max(heavy, light)
        following = u - off / slope if slope != 0.0 else low - 1.0
        if not low < following < high or n_steps >= HALVED_FROM:
            if abs(off) < EXACT:
                return u
            following = 0.5 * (low + high)
        elif abs(following - u) < CLOSE:  # the next one would be right to CLOSE^2
            return following
        u = following
    return u


@kernel
def find_extremum(w: Array, n: int, piece: int, scale: float, one: float, two: float) -> float:
    """Return where between two places the slope of the load changes its sign (bisection)."""
    _, rising = load_at(w, n, piece, scale, one)
    for _ in range(44):
        middle = 0.5 * (one + two)
        _, slope = load_at(w, n, piece, scale, middle)
        if (slope > 0.0) == (rising > 0.0):
            one = middle
        else:
            two = middle
    return 0.5 * (one + two)


@kernel
def _cross_thick(w: Array, n: int, scale: float, load: float, down: bool, best: Array) -> float:
    """Do what `_cross_piece` does in the piece without contact, where the load has no folds."""
    if scale <= 0.0:
        return 2.0 if down else 1.0
    wanted = math.log(load / scale)
    light, heavy = polynomial(w, M.CURVES, n, 1.0), polynomial(w, M.CURVES, n, -1.0)
    if down:
        if wanted <= light:
            return 1.0
        if wanted > heavy:
            best[0] = scale * math.exp(min(heavy, 600.0))
            return 2.0
    else:
        if wanted >= heavy:
            return -1.0
        if wanted < light:
            return 2.0
    guess = 1.0 - 2.0 * (wanted - light) / (heavy - light)
    return find_between(w, n, THICK, scale, load, -1.0, 1.0, guess)


@kernel
def _cross_piece(
    w: Array, n: int, piece: int, scale: float, load: float, down: bool, best: Array
) -> float:
    """Search a piece from its thick end (``down``) or its thin end; return ``u``, 2 or 3.

    2: not in this piece. 3: a fold came first. ``best`` (1,) is the extreme load on the way, over
    the pieces already passed, and is kept up to date. Going down the load has to rise to ``load``,
    going up it has to fall to it.
    """
    side = 1.0 if down else -1.0
    steps = 1 if w[M.STEEP] < 0.0 else SAMPLES
    last, load_then = side, 0.0
    for k in range(steps + 1):
        u = side * (1.0 - 2.0 * k / steps)
        here, _ = load_at(w, n, piece, scale, u)
        if side * (here - load) >= 0.0:
            if k == 0:
                return u  # the border belongs to both
            heavy, light = (u, last) if down else (last, u)
            share = math.log(load / load_then) / math.log(here / load_then)
            return find_between(w, n, piece, scale, load, heavy, light, last + share * (u - last))
        if best[0] > 0.0 and side * (here - best[0]) < -SHALLOW * best[0]:
            # turned back: the extremum lies within two steps before
            first = min(max(u + side * 4.0 / steps, -1.0), 1.0)
            top = find_extremum(w, n, piece, scale, first, u)
            peak, _ = load_at(w, n, piece, scale, top)
            if side * (peak - load) >= 0.0:
                heavy, light = (top, first) if down else (first, top)
                middle = 0.5 * (top + first)
                return find_between(w, n, piece, scale, load, heavy, light, middle)
            return 3.0
        if best[0] <= 0.0 or side * (here - best[0]) > 0.0:
            best[0] = here
        last, load_then = u, here
    # a fold so near to the end that the load has hardly turned back: nobody else looks here
    first, end = side * (4.0 / steps - 1.0), -side
    if steps == 1 or load_at(w, n, piece, scale, end)[1] <= 0.0:
        return 2.0
    if load_at(w, n, piece, scale, first)[1] >= 0.0:
        return 2.0
    top = find_extremum(w, n, piece, scale, first, end)
    peak, _ = load_at(w, n, piece, scale, top)
    if side * (peak - load) >= 0.0:
        heavy, light = (top, first) if down else (first, top)
        return find_between(w, n, piece, scale, load, heavy, light, 0.5 * (top + first))
    if side * (peak - best[0]) > 0.0:
        best[0] = peak
    return 2.0


@kernel
def search_map(data: Array, w: Array, scale: float, load: float, down: bool, place: Array) -> int:
    """Find the first point with the wanted load from the thick or the thin end; fill ``place``."""
    best = w[M.BEST : M.BEST + 1]
    best[0] = 0.0
    for k in range(M.N_PIECES):
        piece = k if down else M.N_PIECES - 1 - k
        n = int(data[M.TERMS + piece])
        read_loads(data, w, piece)
        if piece == THICK:
            u = _cross_thick(w, n, scale, load, down, best)
        else:
            read_edges(data, w)
            u = _cross_piece(w, n, piece, scale, load, down, best)
        if u == 3.0:
            return LOST
        if u < 1.5:
            place[M.AT_PIECE], place[M.AT_U], place[M.AT_SCALE] = piece, u, scale
            place[M.AT_RATIO] = ratio_at(w, piece, u)
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
    if piece == THICK and scale <= 0.0:
        return False
    read_loads(data, w, piece)
    n = int(data[M.TERMS + piece])
    u = u_at(w, piece, before)
    log_fluid = math.log(load / scale) if piece == THICK else 0.0
    for _ in range(8):
        if piece == THICK:
            value, slope = polynomial_slope(w, M.CURVES, n, u)
            off = value - log_fluid
        else:
            here, slope = load_at(w, n, piece, scale, u)
            off, slope = math.log(here / load), slope / here
        if not slope < 0.0:
            return False
        step = -off / slope
        u += step
        if not abs(u) <= 1.0:
            return False
        if abs(step) < CLOSE:
            ratio = ratio_at(w, piece, u)
            allowed = reach * max(1.0, before / 5.0)
            if abs(ratio - before) > allowed:
                return False
            place[M.AT_PIECE], place[M.AT_U], place[M.AT_SCALE] = piece, u, scale
            place[M.AT_RATIO] = ratio
            return True
    return False
