"""Directional derivatives of the washer's outputs, from the factored heat balance.

The unknowns' change solves the linearised equations exactly; the factor at hand, made at an earlier
point, is only their preconditioner. Each round takes the heat residual through the factor, lets
positions and film follow so that all forces keep their balance, and combines the last two changes
for the least residual (truncated generalised conjugate residuals).
"""

import numpy as np

from ...numerics.arrays import clear, copy, negate, size_of
from ...numerics.dense import dense_solve
from ...numerics.jit import Array, inlined, kernel
from ...numerics.status import MAX_ITERATIONS, OK, SINGULAR
from . import layout as L
from .constants import WasherModel
from .film import film_solve, hold_pressure, let_flows_follow
from .heat import heat_change, let_film_follow
from .heat_factor import solve_heat
from .ladder import BODIES, angle_of, body_of, out_of
from .layout import MOMENT_X, MOMENT_Y, ON_GEAR, ON_WASHER, TILT_X, TILT_Y, Z_GEAR, Z_WASHER
from .newton import EXACT, FILM, LOAD, add_pressure, linearise, make_factor, set_film_row
from .outputs import change_of_outputs
from .workspace import Fields, Point, Workspace, fields_of, model_of, square, vector

CLOSE = 1e-8  # of the heat that the change moves
ROUNDS = 12  # then a new factor is made
NEAR_FOLD = 1e-8  # dload/dfilm in load per sigma below which there is no derivative


@kernel
def follow_forces(m: WasherModel, q: Array, f: Fields, mode: float, dq: Array) -> bool:
    """Fill ``dq`` so that the forces change by ``dq`` (on entry) [N, N, N m, N m].

    ``mode`` FILM: the second is a change of the film thickness [m], and what the gear carries is
    whatever it is.
    """
    ro = m.outer_radius
    slopes = square(f.small, L.SLOPES)
    system, right = square(f.small, L.SYSTEM), vector(f.small, L.RIGHT)
    for a in range(4):
        row = 1.0 if a <= ON_GEAR else 1.0 / ro
        for c in range(4):
            unit = m.sigma1 if c <= Z_GEAR else m.sigma1 / ro
            system[a, c] = slopes[a, c] * unit * row
        right[a] = dq[a] * row
    if mode == FILM:
        set_film_row(m, q, system, ON_GEAR)
        right[ON_GEAR] = dq[ON_GEAR] / m.sigma1
    if not dense_solve(f.small[L.SYSTEM : L.SYSTEM + 16], right, 4):
        return False
    for c in range(4):
        dq[c] = right[c] * (m.sigma1 if c <= Z_GEAR else m.sigma1 / ro)
    return True


@kernel
def forces_change(m: WasherModel, change: Point, dq: Array, f: Fields, out: Array) -> None:
    """Fill ``out`` (4,), the changes of the forces; `let_film_follow` has filled ``f.dp``."""
    stiffness = square(f.small, L.STIFFNESS)
    for a in range(4):
        out[a] = 0.0
        for c in range(4):
            out[a] += stiffness[a, c] * dq[c]
    if change.tilt != 0.0:
        for j in range(m.n_t):
            for i in range(m.i_g, m.n_r):
                k = np.uintp(j * m.n_r + i)
                x, y = m.r[i] * m.cos[j], m.r[i] * m.sin[j]
                push = -m.weight2[i] * m.weight_t[j] * f.dpc2[k] * x * change.tilt
                out[ON_WASHER] -= push
                out[ON_GEAR] += push
                out[MOMENT_X] -= push * y
                out[MOMENT_Y] += push * x
    add_pressure(m, f.dp, out)


@kernel
def add_slopes(f: Fields, dq: Array, dtemp: Array) -> None:
    """Add what the temperatures gain when the positions change by ``dq``."""
    dt0, dt1, dt2, dt3 = f.following[0], f.following[1], f.following[2], f.following[3]
    for node in range(dtemp.size):
        k = np.uintp(node)
        dtemp[k] += dt0[k] * dq[0] + dt1[k] * dq[1] + dt2[k] * dq[2] + dt3[k] * dq[3]


@kernel
def _add(to: Array, share: float, a: Array) -> None:
    for k in range(a.size):
        to[np.uintp(k)] += share * a[np.uintp(k)]


@kernel
def _dot(a: Array, b: Array) -> float:
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    n = a.size // 4 * 4
    for k in range(0, n, 4):
        s0 += a[np.uintp(k)] * b[np.uintp(k)]
        s1 += a[np.uintp(k + 1)] * b[np.uintp(k + 1)]
        s2 += a[np.uintp(k + 2)] * b[np.uintp(k + 2)]
        s3 += a[np.uintp(k + 3)] * b[np.uintp(k + 3)]
    for k in range(n, a.size):
        s0 += a[np.uintp(k)] * b[np.uintp(k)]
    return (s0 + s1) + (s2 + s3)


@kernel
def _warm(m: WasherModel, f: Fields, heat: Array) -> None:
    """Add to the change of the heat residual what makes held bodies warmer."""
    warmed = f.small[L.WARMED : L.N_SMALL]
    if warmed[0] == 0.0 and warmed[1] == 0.0 and warmed[2] == 0.0:
        return
    for body in BODIES:
        b = body_of(m, body)
        by = f.small[out_of(body)] * warmed[body - L.OF_CARRIER]
        for j in range(b.columns):
            angle = angle_of(m, b, j)
            for i in range(b.first, m.n_r):
                heat[np.uintp(b.at + j * b.step + i)] -= b.weight[i] * angle * by


@kernel
def _start(
    m: WasherModel, pt: Point, change: Point, q: Array, f: Fields, dtemp: Array, heat: Array
) -> int:
    """Fill a first change of positions and ``dtemp``, with ``heat`` the residual it leaves."""
    dq, step = vector(f.small, L.CHANGE), vector(f.small, L.STEP)
    clear(dq)
    clear(dtemp)
    moved = abs(change.speed) + abs(change.tilt) + abs(change.oil_temperature)
    moved += abs(change.far_face) + size_of(f.small[L.WARMED : L.N_SMALL])
    if moved > 0.0:
        let_film_follow(m, pt, change, q, dq, dtemp, f)
        heat_change(m, pt, change, q, dq, dtemp, f, heat)
        _warm(m, f, heat)
        negate(heat)
        solve_heat(m, heat, dtemp, f)
    let_film_follow(m, pt, change, q, dq, dtemp, f)
    forces_change(m, change, dq, f, step)
    negate(step)
    step[ON_GEAR] += change.load
    if not follow_forces(m, q, f, LOAD, step):
        return SINGULAR
    copy(step, dq)
    add_slopes(f, dq, dtemp)
    let_film_follow(m, pt, change, q, dq, dtemp, f)
    heat_change(m, pt, change, q, dq, dtemp, f, heat)
    _warm(m, f, heat)
    negate(heat)
    return OK


@kernel
def refine_change(
    m: WasherModel,
    pt: Point,
    q: Array,
    f: Fields,
    mode: float,
    dtemp: Array,
    heat: Array,
    enough: float,
) -> int:
    """Improve CHANGE and ``dtemp`` until the residual ``heat`` is below ``enough`` [W]."""
    n = dtemp.size
    none = Point(0.0, 0.0, 0.0, 0.0, 0.0)
    dq, step = vector(f.small, L.CHANGE), vector(f.small, L.STEP)
    before, still = vector(f.small, L.STEP_BEFORE), vector(f.small, L.LOOSE)
    gain, old, old_gain = f.keep[n : 2 * n], f.keep[2 * n : 3 * n], f.trial
    old_square = 0.0
    for _ in range(ROUNDS):
        if size_of(heat) <= enough:
            return OK
        f.small[L.ROUNDS] += 1.0
        solve_heat(m, heat, f.dtemp, f)
        clear(still)
        let_film_follow(m, pt, none, q, still, f.dtemp, f)
        forces_change(m, none, still, f, step)
        negate(step)
        if mode == FILM:
            step[ON_GEAR] = 0.0
        if not follow_forces(m, q, f, mode, step):
            return SINGULAR
        add_slopes(f, step, f.dtemp)
        let_film_follow(m, pt, none, q, step, f.dtemp, f)
        heat_change(m, pt, none, q, step, f.dtemp, f, gain)
        if old_square > 0.0:
            share = _dot(gain, old_gain) / old_square
            _add(f.dtemp, -share, old)
            _add(gain, -share, old_gain)
            _add(step, -share, before)
        old_square = _dot(gain, gain)
        if not old_square > 0.0:
            return MAX_ITERATIONS
        share = _dot(gain, heat) / old_square
        _add(dtemp, share, f.dtemp)
        _add(heat, -share, gain)
        _add(dq, share, step)
        copy(f.dtemp, old)
        copy(gain, old_gain)
        copy(step, before)
    return OK if size_of(heat) <= enough else MAX_ITERATIONS


@kernel
def is_at_fold(m: WasherModel, pt: Point, q: Array, f: Fields) -> bool:
    """Tell if the load has an extremum over the film thickness here."""
    rise = vector(f.small, L.LOOSE)
    clear(rise)
    rise[ON_GEAR] = pt.load
    if not follow_forces(m, q, f, LOAD, rise):
        return True
    move = max(abs(rise[Z_WASHER]), m.outer_radius * max(abs(rise[TILT_X]), abs(rise[TILT_Y])))
    return not move * NEAR_FOLD < m.sigma1


@inlined
def _change_of_state(m: WasherModel, pt: Point, change: Point, q: Array, f: Fields) -> int:
    """Fill CHANGE and the temperatures' change, ``f.keep[: n_temp]``; return a status."""
    n = f.temp.size
    dtemp, heat = f.keep[:n], f.heat
    status = OK
    for attempt in range(2):
        if attempt == 1 or f.tag[L.TAG_VALID] != 1.0:
            if not make_factor(m, pt, q, f.temp, f, EXACT):
                return SINGULAR
        clear(f.dtemp)
        film_solve(m, f)
        linearise(m, f)
        if is_at_fold(m, pt, q, f):
            return SINGULAR
        status = _start(m, pt, change, q, f, dtemp, heat)
        if status != OK:
            return status
        # what the change moves: a heat balance is as good as its largest terms
        moved = size_of(dtemp)
        spread = m.carrier_conductivity * m.outer_radius * m.outer_radius / m.carrier_thickness
        status = refine_change(m, pt, q, f, LOAD, dtemp, heat, CLOSE * moved / n * spread)
        if status == OK:
            break
    if status == OK:
        dq = vector(f.small, L.CHANGE)
        let_film_follow(m, pt, change, q, dq, dtemp, f)
        f.small[L.RIM_CHANGE] = heat_change(m, pt, change, q, dq, dtemp, f, heat)
        # the flows' changes have served as room for heat: those of the film are made again
        hold_pressure(m, pt, change, dq, dtemp, f)
        let_flows_follow(m, f)
    return status


@inlined
def differentiate(w: Workspace, pt: Point, change: Point, dout: Array) -> int:
    """Fill ``dout``, the change of the outputs over a change of the point; return a status.

    Everything is as the last solve at ``pt`` has left it. SINGULAR at a fold: there the film
    thickness moves without bound as the load changes.
    """
    m, f = model_of(w), fields_of(w)
    f.small[L.ROUNDS] = 0.0
    status = _change_of_state(m, pt, change, w.q, f)
    if status == OK:
        status = change_of_outputs(m, pt, change, w, f, dout)
    return status
