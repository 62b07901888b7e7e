"""Newton's method for positions and temperatures by block elimination, the film settled.

The pressure is that of Reynolds' equation at the gaps and viscosities, p = p(q, T), at each
iterate. Temperatures follow the positions, T = T(q): the heat block is solved first (for the
residual and four slopes), then the film block, and what remains is a system of four: two forces,
two moments.

Wanted is either a load (mode LOAD) or a film thickness (mode FILM, the load is a result), the
latter single-valued through both folds. The film thickness that is wanted is smoothed where
the washer's tilt vanishes: s = z_w - r_o sqrt(gx^2 + gy^2 + e^2), e r_o = sigma/20.
"""

import math

import numpy as np

from ...numerics.arrays import clear, copy, negate, size_of
from ...numerics.dense import dense_solve
from ...numerics.jit import Array, kernel
from ...numerics.status import MAX_ITERATIONS, NOT_FINITE, OK, SINGULAR
from . import layout as L
from .constants import WasherModel
from .film import evaluate_film, film_solve, settle_film, settle_marked
from .gap import evaluate_gaps, evaluate_viscosity
from .heat import heat_change, heat_residual, let_film_follow
from .heat_factor import factor_heat, solve_heat
from .throughflow import find_flows
from .workspace import Fields, Point, Workspace, fields_of, model_of, square, vector

# modes and counts are floats: numba would compile anew for each integer constant
LOAD, FILM = 0.0, 1.0
NO_FLOOR = -100.0
CHORD = 0.4  # what an iteration with an old factor must bring the error down to
ROUGH, EXACT = 1.0, 2.0  # rounds of the slopes of the temperatures where oil carries heat
ROUGH_FROM = 1e-5  # tolerance from which rough slopes do
LARGEST_JUMP = 1000.0  # [K] of a temperature in one iteration


@kernel
def tilt_of(q: Array) -> float:
    """Return the washer's tilt [rad]."""
    return math.sqrt(q[L.TILT_X] * q[L.TILT_X] + q[L.TILT_Y] * q[L.TILT_Y])


@kernel
def smooth_film(w: Workspace) -> float:
    """Return the smoothed least film thickness s [m] that mode FILM prescribes."""
    return float(w.q[L.Z_WASHER] - _reach(w.par[L.P_OUTER_RADIUS], w.par[L.D_SIGMA1], w.q))


@kernel
def _reach(ro: float, sigma: float, q: Array) -> float:
    """Return by how much the rim dips below the washer's middle [m], smoothed."""
    e = 0.05 * sigma
    return math.sqrt(ro * ro * (q[L.TILT_X] * q[L.TILT_X] + q[L.TILT_Y] * q[L.TILT_Y]) + e * e)


@kernel
def film_ratio(w: Workspace) -> float:
    """Return the least film thickness over the disc in sigma."""
    least = w.q[L.Z_WASHER] - w.par[L.P_OUTER_RADIUS] * tilt_of(w.q)
    return float(least / w.par[L.D_SIGMA1])


@kernel
def make_factor(m: WasherModel, pt: Point, q: Array, temp: Array, f: Fields, rounds: float) -> bool:
    """Factor the heat equations and solve for the slopes dT/dq; all is evaluated at (q, temp).

    ``rounds`` is ROUGH or EXACT.
    """
    f.tag[L.TAG_VALID] = 0.0
    if not factor_heat(m, pt, f):
        return False
    for c in range(4):
        clear(f.following[c])
    for _ in range(int(rounds) if m.film_step > 0 else 1):
        refine_slopes(m, pt, q, f)
    mark_factor(pt, q, temp, f)
    return True


@kernel
def mark_factor(pt: Point, q: Array, temp: Array, f: Fields) -> None:
    """Write what a factor that is made here belongs to."""
    f.tag[L.TAG_VALID] = 1.0
    f.tag[L.TAG_OUT], f.tag[L.TAG_OUT + 1] = f.small[L.OUT_CARRIER], f.small[L.OUT_WASHER]
    f.tag[L.TAG_OUT + 2], f.tag[L.TAG_GIVEN] = f.small[L.OUT_GEAR], f.small[L.GIVEN]
    f.tag[L.TAG_SPEED], f.tag[L.TAG_TILT] = pt.speed, pt.tilt
    f.tag[L.TAG_OIL] = pt.oil_temperature
    copy(q, vector(f.tag, L.TAG_POSITIONS))
    copy(temp, f.tag[L.N_TAG : L.N_TAG + temp.size])


@kernel
def refine_slopes(m: WasherModel, pt: Point, q: Array, f: Fields) -> None:
    """Improve the slopes dT/dq by one step with the factor, film and flows following."""
    none = Point(0.0, 0.0, 0.0, 0.0, 0.0)
    dq, heat = vector(f.small, L.STEP), f.trial
    for c in range(4):
        clear(dq)
        dq[c] = 1.0
        let_film_follow(m, pt, none, q, dq, f.following[c], f)
        heat_change(m, pt, none, q, dq, f.following[c], f, heat)
        solve_heat(m, heat, heat, f)
        for node in range(heat.size):
            k = np.uintp(node)
            f.following[np.uintp(c), k] -= heat[k]


@kernel
def factor_here(w: Workspace, pt: Point) -> bool:
    """Make the heat factor at the present solution; gaps are already evaluated."""
    f = fields_of(w)
    return make_factor(model_of(w), pt, w.q, f.temp, f, EXACT)


@kernel
def _balance(m: WasherModel, f: Fields) -> None:
    """Fill the forces conjugate to q: film pressure and contacts."""
    forces = vector(f.small, L.BALANCE)
    copy(vector(f.small, L.FORCES), forces)
    add_pressure(m, f.p, forces)


@kernel
def add_pressure(m: WasherModel, p: Array, forces: Array) -> None:
    """Add to ``forces`` (4,) what pressures ``p`` (n,) on the washer make."""
    for j in range(m.n_t):
        for i in range(1, m.n_r - 1):
            push = m.weight1[i] * m.weight_t[j] * p[np.uintp(j * m.n_r + i)]
            forces[L.ON_WASHER] += push
            forces[L.MOMENT_X] += push * m.r[i] * m.sin[j]
            forces[L.MOMENT_Y] -= push * m.r[i] * m.cos[j]


@kernel
def linearise(m: WasherModel, f: Fields) -> None:
    """Fill the forces after the step at fixed q and their slopes, film and heat following."""
    forces, slopes = vector(f.small, L.BALANCE), square(f.small, L.SLOPES)
    copy(f.small[L.STIFFNESS : L.STIFFNESS + 16], f.small[L.SLOPES : L.SLOPES + 16])
    for j in range(m.n_t):
        for i in range(1, m.n_r - 1):
            k = np.uintp(j * m.n_r + i)
            weight = m.weight1[i] * m.weight_t[j]
            wy, wx = weight * m.r[i] * m.sin[j], weight * m.r[i] * m.cos[j]
            p0 = f.film_rhs[k, L.AT_FIXED]
            forces[L.ON_WASHER] += weight * p0
            forces[L.MOMENT_X] += wy * p0
            forces[L.MOMENT_Y] -= wx * p0
            for c in range(4):
                dp = f.film_rhs[k, np.uintp(L.OVER_POSITIONS + c)]
                slopes[L.ON_WASHER, np.uintp(c)] += weight * dp
                slopes[L.MOMENT_X, np.uintp(c)] += wy * dp
                slopes[L.MOMENT_Y, np.uintp(c)] -= wx * dp


@kernel
def set_film_row(m: WasherModel, q: Array, system: Array, row: int) -> None:
    """Fill a row of a scaled system of four: the change of the smoothed film thickness."""
    ro = m.outer_radius
    reach = _reach(ro, m.sigma1, q)
    system[row, L.Z_WASHER], system[row, L.Z_GEAR] = 1.0, 0.0
    system[row, L.TILT_X] = -ro * q[L.TILT_X] / reach
    system[row, L.TILT_Y] = -ro * q[L.TILT_Y] / reach


@kernel
def _steps(m: WasherModel, mode: float, target: float, q: Array, f: Fields) -> bool:
    """Solve the system of four for the step (RIGHT) and the tangent dq/ds (TANGENT)."""
    ro = m.outer_radius
    reach = _reach(ro, m.sigma1, q)
    forces, slopes = vector(f.small, L.BALANCE), square(f.small, L.SLOPES)
    system, right = square(f.small, L.SYSTEM), vector(f.small, L.RIGHT)
    for kind in range(2):  # 0: tangent, always from the FILM row; 1: the step wanted
        for c in range(4):
            unit = m.sigma1 if c <= L.Z_GEAR else m.sigma1 / ro
            system[0, c] = slopes[L.ON_WASHER, c] * unit
            system[1, c] = slopes[L.MOMENT_X, c] * unit / ro
            system[2, c] = slopes[L.MOMENT_Y, c] * unit / ro
            system[3, c] = slopes[L.ON_GEAR, c] * unit
        if kind == 0 or mode == FILM:
            set_film_row(m, q, system, 3)
        if kind == 0:
            right[0], right[1], right[2] = 0.0, 0.0, 0.0
            right[3] = 1.0 / m.sigma1
        else:
            right[0], right[1] = -forces[L.ON_WASHER], -forces[L.MOMENT_X] / ro
            right[2] = -forces[L.MOMENT_Y] / ro
            if mode == FILM:
                right[3] = (target - (q[L.Z_WASHER] - reach)) / m.sigma1
            else:
                right[3] = target - forces[L.ON_GEAR]
        if not dense_solve(f.small[L.SYSTEM : L.SYSTEM + 16], right, 4):
            return False
        for c in range(4):
            right[c] *= m.sigma1 if c <= L.Z_GEAR else m.sigma1 / ro
        if kind == 0:
            copy(right, vector(f.small, L.TANGENT))
    return True


@kernel
def _limit(ro: float, sigma: float, pt: Point, q: Array, step: Array) -> float:
    """Return the share of the step to take.

    The least gaps change by a film thickness' fraction at most; elsewhere, where the gaps are wide
    and a rocking washer moves most, eight times as much.
    """
    tilt = tilt_of(q)
    ratio = (q[L.Z_WASHER] - ro * tilt) / sigma
    limit = max(1.0, 0.3 * ratio) * sigma
    small = 1e-3 * sigma / ro
    gx, gy, rel = q[L.TILT_X], q[L.TILT_Y], pt.tilt - q[L.TILT_Y]
    lean = math.sqrt(rel * rel + gx * gx) + small
    turn = ro * math.sqrt(step[L.TILT_X] * step[L.TILT_X] + step[L.TILT_Y] * step[L.TILT_Y])
    lift = step[L.Z_GEAR] - step[L.Z_WASHER]
    one = step[L.Z_WASHER] - ro * (gx * step[L.TILT_X] + gy * step[L.TILT_Y]) / (tilt + small)
    two = lift + ro * (rel * step[L.TILT_Y] - gx * step[L.TILT_X]) / lean
    far1, far2 = abs(step[L.Z_WASHER]) + turn, abs(lift) + turn
    worst = max(abs(one), 0.5 * abs(two), far1 / 8.0, far2 / 16.0)
    return limit / worst if worst > limit else 1.0


@kernel
def evaluate(m: WasherModel, pt: Point, q: Array, f: Fields, marked: bool) -> float:
    """Evaluate everything at (q, f.temp), the film settled; return the heat made [W].

    The residual of the film and of its liquid stays in ``f.small[FILM_ERROR]``. ``marked``: the
    last film in ``f`` was of this washer and point.
    """
    evaluate_gaps(m, pt, q, f)
    evaluate_viscosity(m, pt, f)
    evaluate_film(m, pt, q, f)
    f.small[L.FILM_ERROR] = settle_marked(m, f) if marked else settle_film(m, f)
    if m.film_step > 0:
        f.small[L.FILM_ERROR] = max(f.small[L.FILM_ERROR], find_flows(m, pt, q, f))
    return heat_residual(m, pt, f.temp, f)


@kernel
def evaluate_here(w: Workspace, pt: Point) -> None:
    """Evaluate everything at a solution that was taken back."""
    evaluate(model_of(w), pt, w.q, fields_of(w), False)


@kernel
def is_spent(w: Workspace) -> bool:
    """Tell if the iterations have reached the budget of the solve; without one they never do."""
    return bool(0.0 < w.info[L.BUDGET] <= w.info[L.ITERATIONS])


@kernel
def _take(f: Fields, share: float, q: Array) -> None:
    """Go ``share`` of the step: positions, and the temperatures that follow them."""
    step = vector(f.small, L.RIGHT)
    d0, d1 = share * step[L.Z_WASHER], share * step[L.Z_GEAR]
    d2, d3 = share * step[L.TILT_X], share * step[L.TILT_Y]
    n_temp = f.temp.size
    dt0, dt1, dt2, dt3 = f.following[0], f.following[1], f.following[2], f.following[3]
    jump = 0.0
    for node in range(n_temp):
        k = np.uintp(node)
        change = f.dtemp[k] + dt0[k] * d0 + dt1[k] * d1 + dt2[k] * d2 + dt3[k] * d3
        f.dtemp[k] = change
        jump = max(jump, abs(change))
    damp = 1.0 if jump <= LARGEST_JUMP else LARGEST_JUMP / jump
    for node in range(n_temp):
        k = np.uintp(node)
        f.temp[k] += damp * f.dtemp[k]
    q[L.Z_WASHER] += d0
    q[L.Z_GEAR] += d1
    q[L.TILT_X] += d2
    q[L.TILT_Y] += d3


@kernel
def newton(
    w: Workspace,
    pt: Point,
    mode: float,
    target: float,
    floor: float,
    tolerance: float,
    max_iterations: float,
) -> int:
    """Solve for positions ``w.q`` and temperatures ``f.temp``; return a status.

    The pressure ``f.p`` is solved for at each of them. The heat factor and its slopes serve as
    long as an iteration gains half a digit (chord), unless ``forget_factor`` was called. Film,
    contacts and the system of four are always exact. What is in ``w.q``, ``f.temp`` and ``f.p`` is
    the start, then the best estimate. ``w.info``: iterations and factorings are added to; out:
    residual, load reached [N], dload/ds [N/m], heat made [W]. None begins beyond the budget.

    Parameters
    ----------
    mode, target : LOAD and a load [N], or FILM and a smoothed film thickness [m]
    floor : give up when the film ratio falls below it
    tolerance : on the largest of force and moment over load, pressure over its maximum, heat over
        the heat made
    """
    m, f = model_of(w), fields_of(w)
    forces, slopes = vector(f.small, L.BALANCE), square(f.small, L.SLOPES)
    tangent = vector(f.small, L.TANGENT)
    before = math.inf
    rounds = ROUGH if tolerance > ROUGH_FROM else EXACT
    for iteration in range(int(max_iterations) + 1):
        made = evaluate(m, pt, w.q, f, iteration > 0)
        _balance(m, f)
        reached = forces[L.ON_GEAR]
        load = target if mode == LOAD else max(reached, 1e-3)
        moment = max(abs(forces[L.MOMENT_X]), abs(forces[L.MOMENT_Y])) / m.outer_radius
        error = max(abs(forces[L.ON_WASHER]), moment) / load
        if mode == LOAD:
            error = max(error, abs(reached - target) / load)
        else:
            error = max(error, abs(smooth_film(w) - target) / m.sigma1)
        error = max(error, f.small[L.FILM_ERROR])
        lost = size_of(f.heat)
        flow = made + f.small[L.OUT_SIZE]
        error = max(error, lost / max(flow, 1e-2))
        w.info[L.RESIDUAL], w.info[L.REACHED_LOAD], w.info[L.HEAT] = error, reached, made
        if not math.isfinite(error):
            return NOT_FINITE
        if error < tolerance and iteration > 0:
            return OK
        if iteration == int(max_iterations) or film_ratio(w) < floor or is_spent(w):
            break
        if error > CHORD * before or f.tag[L.TAG_VALID] != 1.0:
            if not make_factor(m, pt, w.q, f.temp, f, rounds):
                return SINGULAR
            w.info[L.FACTORED] += 1.0
        before = error
        # a change of load alone leaves the heat balanced: no step at fixed positions then
        balanced = lost < tolerance * max(flow, 1e-2)
        negate(f.heat)
        clear(f.dtemp)
        if not balanced:
            solve_heat(m, f.heat, f.dtemp, f)
        film_solve(m, f)
        linearise(m, f)
        if not _steps(m, mode, target, w.q, f):
            return SINGULAR
        slope = 0.0
        for c in range(4):
            slope += slopes[L.ON_GEAR, c] * tangent[c]
        w.info[L.LOAD_SLOPE] = slope
        share = _limit(m.outer_radius, m.sigma1, pt, w.q, vector(f.small, L.RIGHT))
        _take(f, share, w.q)
        w.info[L.ITERATIONS] += 1.0
    return MAX_ITERATIONS
