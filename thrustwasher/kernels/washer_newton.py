"""One Newton iteration for everything: positions, pressure, temperature; by block elimination.

Temperatures depend on the positions only, T = T(q); the pressure on both, p = p(q, T). So the heat
block is solved first (for the residual and four slopes), then the film block, and what remains
is a system of four: two forces, two moments.

Wanted is either a load (mode LOAD) or a film thickness (mode FILM, the load is a result), the
latter single-valued through both folds. The film thickness that is wanted is smoothed where
the washer's tilt vanishes: s = z_w - r_o sqrt(gx^2 + gy^2 + e^2), e r_o = sigma/20.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .banded import N_SIDES
from .dense import dense_solve
from .washer_fields import N_TAG, RATE, Bench, Fields, Point, washer_fields
from .washer_film import evaluate_film, film_residual, film_solve
from .washer_gap import FORCE, STIFF, evaluate_gaps, evaluate_viscosity
from .washer_heat import STORED, factor_heat, heat_residual, heat_slopes, solve_heat
from .washer_model import OUTER_RADIUS, SIGMA1, WasherModel, washer_model

OK, MAX_ITERATIONS, SINGULAR, NOT_FINITE = 0, 10, 11, 14  # errors.Status; a test keeps them equal
# modes and counts are floats: numba would compile anew for each integer constant
LOAD, FILM = 0.0, 1.0
NO_FLOOR = -100.0
# places in Fields.small
BALANCE = 32  # (4,) forces conjugate to q [N, N, N m, N m], load not subtracted
SLOPES = 36  # (16,) their slopes over q
SYSTEM = 52  # (16,) scratch
RIGHT = 68  # (8,) scratch
TANGENT = 76  # (4,) dq/ds along the curve of solutions
RATE_TAG = N_TAG - 1  # in the tag: the rate of storage
# places in `info`; iterations and factorings add up over the calls of one solve
ITERATIONS, FACTORED, RESIDUAL, REACHED_LOAD, LOAD_SLOPE, HEAT = 0, 1, 2, 3, 4, 5
ARRIVED, SCANNED, N_INFO = 6, 7, 8  # of a solve with memory: warm, after a descent


@kernel
def smooth_film(b: Bench, q: NDArray[np.float64]) -> float:
    """Return the smoothed least film thickness s [m] that mode FILM prescribes."""
    ro = b.par[OUTER_RADIUS]
    e = 0.05 * b.par[SIGMA1]
    reach = ro * ro * (q[2] * q[2] + q[3] * q[3])
    return float(q[0] - math.sqrt(reach + e * e))


@kernel
def film_ratio(b: Bench, q: NDArray[np.float64]) -> float:
    """Return the least film thickness over the disc in sigma."""
    tilt = math.sqrt(q[2] * q[2] + q[3] * q[3])
    return float((q[0] - b.par[OUTER_RADIUS] * tilt) / b.par[SIGMA1])


@kernel
def make_factor(
    m: WasherModel, pt: Point, q: NDArray[np.float64], temp: NDArray[np.float64], f: Fields
) -> bool:
    """Factor the heat equations and solve for the slopes dT/dq; gaps are already evaluated."""
    f.tag[0] = 0.0
    if not factor_heat(m, pt, f):
        return False
    heat_slopes(m, pt, temp, f)
    n = temp.size
    for s in range(4):
        solve_heat(m, f.sens[s * n : s * n + n], f.sens[s * n : s * n + n], f)
    f.tag[0], f.tag[1], f.tag[2], f.tag[7] = 1.0, pt.speed, pt.tilt, pt.oil_temperature
    f.tag[RATE_TAG] = f.small[RATE]
    for k in range(4):
        f.tag[3 + k] = q[k]
    for k in range(n):
        f.tag[np.uintp(N_TAG + k)] = temp[np.uintp(k)]
    return True


@kernel
def factor_here(b: Bench, pt: Point, q: NDArray[np.float64]) -> bool:
    """Make the heat factor at the present solution; gaps are already evaluated."""
    m = washer_model(b.par)
    f = washer_fields(m, b.work)
    return make_factor(m, pt, q, f.temp, f)


@kernel
def _balance(m: WasherModel, p: NDArray[np.float64], f: Fields) -> None:
    """Fill the forces conjugate to q: film pressure and contacts."""
    s = f.small
    for a in range(4):
        s[BALANCE + a] = s[FORCE + a]
    for j in range(m.n_t):
        for i in range(1, m.n_r - 1):
            push = m.weight1[i] * m.weight_t[j] * p[np.uintp(j * m.n_r + i)]
            s[BALANCE] += push
            s[BALANCE + 2] += push * m.r[i] * m.sin[j]
            s[BALANCE + 3] -= push * m.r[i] * m.cos[j]


@kernel
def _linearise(m: WasherModel, f: Fields) -> None:
    """Fill the forces after the step at fixed q and their slopes, film pressure following."""
    s = f.small
    for a in range(4):
        s[BALANCE + a] = s[FORCE + a]
    for a in range(16):
        s[SLOPES + a] = s[STIFF + a]
    for j in range(m.n_t):
        for i in range(1, m.n_r - 1):
            k = j * m.n_r + i
            w = m.weight1[i] * m.weight_t[j]
            wy, wx = w * m.r[i] * m.sin[j], w * m.r[i] * m.cos[j]
            p0 = f.film_rhs[k * N_SIDES]
            s[BALANCE] += w * p0
            s[BALANCE + 2] += wy * p0
            s[BALANCE + 3] -= wx * p0
            for c in range(4):
                dp = f.film_rhs[k * N_SIDES + c + 1]
                s[SLOPES + c] += w * dp
                s[SLOPES + 8 + c] += wy * dp
                s[SLOPES + 12 + c] -= wx * dp


@kernel
def _steps(m: WasherModel, mode: float, target: float, q: NDArray[np.float64], f: Fields) -> bool:
    """Solve the system of four for the step (RIGHT, RIGHT + 2, ...) and the tangent dq/ds."""
    s = f.small
    ro = m.outer_radius
    reach = math.sqrt(ro * ro * (q[2] * q[2] + q[3] * q[3]) + (0.05 * m.sigma1) ** 2)
    for kind in range(2):  # 0: tangent, always from the FILM row; 1: the step wanted
        film_row = kind == 0 or mode == FILM
        for c in range(4):
            unit = m.sigma1 if c < 2 else m.sigma1 / ro
            s[SYSTEM + c] = s[SLOPES + c] * unit
            s[SYSTEM + 4 + c] = s[SLOPES + 8 + c] * unit / ro
            s[SYSTEM + 8 + c] = s[SLOPES + 12 + c] * unit / ro
            s[SYSTEM + 12 + c] = s[SLOPES + 4 + c] * unit
        if film_row:
            s[SYSTEM + 12], s[SYSTEM + 13] = 1.0, 0.0
            s[SYSTEM + 14], s[SYSTEM + 15] = -ro * q[2] / reach, -ro * q[3] / reach
        if kind == 0:
            s[RIGHT], s[RIGHT + 1], s[RIGHT + 2] = 0.0, 0.0, 0.0
            s[RIGHT + 3] = 1.0 / m.sigma1
        else:
            s[RIGHT], s[RIGHT + 1] = -s[BALANCE], -s[BALANCE + 2] / ro
            s[RIGHT + 2] = -s[BALANCE + 3] / ro
            if mode == FILM:
                s[RIGHT + 3] = (target - (q[0] - reach)) / m.sigma1
            else:
                s[RIGHT + 3] = target - s[BALANCE + 1]
        if not dense_solve(s[SYSTEM : SYSTEM + 16], s[RIGHT : RIGHT + 4], 4, 1):
            return False
        for c in range(4):
            s[RIGHT + c] *= m.sigma1 if c < 2 else m.sigma1 / ro
            if kind == 0:
                s[TANGENT + c] = s[RIGHT + c]
    return True


@kernel
def _limit(m: WasherModel, pt: Point, q: NDArray[np.float64], f: Fields) -> float:
    """Return the share of the step to take.

    The least gaps change by a film thickness' fraction at most; elsewhere, where the gaps are wide
    and a rocking washer moves most, eight times as much.
    """
    s = f.small
    ro = m.outer_radius
    tilt = math.sqrt(q[2] * q[2] + q[3] * q[3])
    ratio = (q[0] - ro * tilt) / m.sigma1
    limit = max(1.0, 0.3 * ratio) * m.sigma1
    small = 1e-3 * m.sigma1 / ro
    rel = pt.tilt - q[3]
    lean = math.sqrt(rel * rel + q[2] * q[2]) + small
    turn = ro * math.sqrt(s[RIGHT + 2] * s[RIGHT + 2] + s[RIGHT + 3] * s[RIGHT + 3])
    lift = s[RIGHT + 1] - s[RIGHT]
    one = s[RIGHT] - ro * (q[2] * s[RIGHT + 2] + q[3] * s[RIGHT + 3]) / (tilt + small)
    two = lift + ro * (rel * s[RIGHT + 3] - q[2] * s[RIGHT + 2]) / lean
    worst = max(abs(one), 0.5 * abs(two), (abs(s[RIGHT]) + turn) / 8.0, (abs(lift) + turn) / 16.0)
    return limit / worst if worst > limit else 1.0


@kernel
def evaluate(m: WasherModel, pt: Point, q: NDArray[np.float64], f: Fields) -> float:
    """Evaluate everything at (q, f.temp, f.p); return the heat made [W]."""
    evaluate_gaps(m, pt, q, f)
    evaluate_viscosity(m, pt, f)
    made = heat_residual(m, pt, f.temp, f)
    evaluate_film(m, pt, q, f)
    return made


@kernel
def evaluate_here(b: Bench, pt: Point, q: NDArray[np.float64]) -> None:
    """Evaluate everything at a solution that was taken back."""
    m = washer_model(b.par)
    f = washer_fields(m, b.work)
    evaluate(m, pt, q, f)
    film_residual(m, f.p, f)


@kernel
def newton(
    b: Bench, pt: Point, mode: float, target: float, q: NDArray[np.float64], floor: float,
    tolerance: float, max_iterations: float, info: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve for positions ``q``, temperatures ``f.temp`` and pressures ``f.p``; return a status.

    The heat factor and its slopes serve as long as each iteration gains a digit (chord), unless
    ``forget_factor`` was called. Film, contacts and the system of four are always exact.

    Parameters
    ----------
    mode, target : LOAD and a load [N], or FILM and a smoothed film thickness [m]
    q : (4,) start in, best estimate out; so are ``f.temp`` and ``f.p``
    floor : give up when the film ratio falls below it
    tolerance : on the largest of force and moment over load, pressure over its maximum, heat over
        the heat made
    info : (N_INFO,) iterations and factorings are added to; out: residual, load reached [N],
        dload/ds [N/m], heat made [W]
    """
    m = washer_model(b.par)
    f = washer_fields(m, b.work)
    n_temp = f.temp.size
    s = f.small
    before = math.inf
    for iteration in range(int(max_iterations) + 1):
        made = evaluate(m, pt, q, f)
        pressure_error, p_max, _ = film_residual(m, f.p, f)
        _balance(m, f.p, f)
        reached = s[BALANCE + 1]
        load = target if mode == LOAD else max(reached, 1e-3)
        error = max(
            abs(s[BALANCE]), max(abs(s[BALANCE + 2]), abs(s[BALANCE + 3])) / m.outer_radius
        ) / load  # fmt: skip
        if mode == LOAD:
            error = max(error, abs(reached - target) / load)
        else:
            error = max(error, abs(smooth_film(b, q) - target) / m.sigma1)
        scale = max(p_max, 1e-6 * load / (m.outer_radius * m.outer_radius))
        error = max(error, pressure_error / scale)
        lost = 0.0
        for k in range(n_temp):
            lost += abs(f.heat[np.uintp(k)])
        flow = made + (f.small[STORED] if f.small[RATE] != 0.0 else 0.0)
        error = max(error, lost / max(flow, 1e-2))
        info[RESIDUAL], info[REACHED_LOAD], info[HEAT] = error, reached, made
        if not math.isfinite(error):
            return NOT_FINITE
        if error < tolerance and iteration > 0:
            return OK
        if iteration == int(max_iterations):
            break
        if film_ratio(b, q) < floor:
            break
        if error > 0.1 * before or f.tag[0] != 1.0:
            if not make_factor(m, pt, q, f.temp, f):
                return SINGULAR
            info[FACTORED] += 1.0
        before = error
        # a change of load alone leaves the heat balanced: no step at fixed positions then
        balanced = lost < tolerance * max(flow, 1e-2)
        for k in range(n_temp):
            f.heat[np.uintp(k)] = -f.heat[np.uintp(k)]
            f.dtemp[np.uintp(k)] = 0.0
        if not balanced:
            solve_heat(m, f.heat, f.dtemp, f)
        if not film_solve(m, f.p, f):
            return SINGULAR
        _linearise(m, f)
        if not _steps(m, mode, target, q, f):
            return SINGULAR
        slope = 0.0
        for c in range(4):
            slope += s[SLOPES + 4 + c] * s[TANGENT + c]
        info[LOAD_SLOPE] = slope
        share = _limit(m, pt, q, f)
        d0, d1 = share * s[RIGHT], share * s[RIGHT + 1]
        d2, d3 = share * s[RIGHT + 2], share * s[RIGHT + 3]
        jump = 0.0
        for k in range(n_temp):
            change = (
                f.dtemp[np.uintp(k)]
                + f.sens[np.uintp(k)] * d0 + f.sens[np.uintp(n_temp + k)] * d1
                + f.sens[np.uintp(2 * n_temp + k)] * d2 + f.sens[np.uintp(3 * n_temp + k)] * d3
            )  # fmt: skip
            f.dtemp[np.uintp(k)] = change
            jump = max(jump, abs(change))
        damp = 1.0 if jump <= 1000.0 else 1000.0 / jump
        for k in range(n_temp):
            f.temp[np.uintp(k)] += damp * f.dtemp[np.uintp(k)]
        n = m.n_r * m.n_t
        for k in range(n):
            a = k * N_SIDES
            f.p[np.uintp(k)] = (
                f.film_rhs[np.uintp(a)]
                + f.film_rhs[np.uintp(a + 1)] * d0 + f.film_rhs[np.uintp(a + 2)] * d1
                + f.film_rhs[np.uintp(a + 3)] * d2 + f.film_rhs[np.uintp(a + 4)] * d3
            )  # fmt: skip
        q[0] += d0
        q[1] += d1
        q[2] += d2
        q[3] += d3
        info[ITERATIONS] += 1.0
    return MAX_ITERATIONS
