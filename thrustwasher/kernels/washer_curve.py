"""Walking along the curve of solutions at fixed speed, tilt and oil: load over film thickness.

With the film thickness prescribed the solution is unique: falling film thickness leads from light
load over the film branch, through the fold where the film is lost, back along the unstable
branch to the fold where it is regained, and along the contact branch.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import inlined, kernel
from .banded import N_SIDES
from .washer_fields import Bench, Fields, Point, forget_factor, washer_fields
from .washer_film import film_residual, film_solve
from .washer_gap import CONTACT, FORCE, STIFF, evaluate_gaps
from .washer_model import SIGMA1, WasherModel, washer_model
from .washer_newton import (
    FILM,
    LOAD_SLOPE,
    MAX_ITERATIONS,
    NO_FLOOR,
    OK,
    REACHED_LOAD,
    TANGENT,
    evaluate,
    newton,
    smooth_film,
)  # fmt: skip

# the walker: film thickness s [m], load [N], dload/ds [N/m], contact share [-]; and, set by the
# caller, the tolerance of the points on the way
S, W, SLOPE, SHARE, ACCURACY, N_WALK = 0, 1, 2, 3, 4, 8


@kernel
def remember(b: Bench, q: NDArray[np.float64], slot: float) -> None:
    """Keep the present solution in a slot of ``f.keep``."""
    f = washer_fields(washer_model(b.par), b.work)
    n_temp, n = f.temp.size, f.p.size
    base = int(slot) * (4 + n_temp + n)
    for k in range(4):
        f.keep[base + k] = q[k]
    for k in range(n_temp):
        f.keep[np.uintp(base + 4 + k)] = f.temp[np.uintp(k)]
    for k in range(n):
        f.keep[np.uintp(base + 4 + n_temp + k)] = f.p[np.uintp(k)]


@kernel
def recall(b: Bench, q: NDArray[np.float64], slot: float) -> None:
    """Take a solution back from a slot of ``f.keep``."""
    f = washer_fields(washer_model(b.par), b.work)
    n_temp, n = f.temp.size, f.p.size
    base = int(slot) * (4 + n_temp + n)
    for k in range(4):
        q[k] = f.keep[base + k]
    for k in range(n_temp):
        f.temp[np.uintp(k)] = f.keep[np.uintp(base + 4 + k)]
    for k in range(n):
        f.p[np.uintp(k)] = f.keep[np.uintp(base + 4 + n_temp + k)]


@kernel
def _press_gear(m: WasherModel, pt: Point, q: NDArray[np.float64], f: Fields) -> None:
    """Move the gear until gap 2 carries what film 1 carries; its force is nearly exponential."""
    lift = f.small[FORCE] + f.small[FORCE + 1]
    for j in range(m.n_t):
        for i in range(1, m.n_r - 1):
            k = np.uintp(j * m.n_r + i)
            lift += m.weight1[i] * m.weight_t[j] * f.p[k]
    lift = max(lift, 1.0)
    for _ in range(12):
        evaluate_gaps(m, pt, q, f)
        force, slope = f.small[FORCE + 1], f.small[STIFF + 5]
        if not force > 1e-12 * lift:
            q[1] -= m.sigma2
            continue
        move = math.log(force / lift) * force / -slope
        q[1] += min(max(move, -m.sigma2), m.sigma2)
        if abs(move) < 0.05 * m.sigma2:
            return


@kernel
def cold_start(b: Bench, pt: Point, ratio: float, q: NDArray[np.float64]) -> None:
    """Place washer and gear for a film of ``ratio`` sigma, everything at oil temperature.

    The pressure is that of these gaps: from no pressure at all a film without contact would show
    Newton's method no stiffness.
    """
    m = washer_model(b.par)
    f = washer_fields(m, b.work)
    q[3] = (0.99 if ratio > 3.0 else 0.95) * pt.tilt
    q[2] = 0.0
    q[0] = q[3] * m.outer_radius + ratio * m.sigma1
    q[1] = q[0] + 3.0 * m.sigma2 + 0.05 * pt.tilt * m.outer_radius
    for k in range(f.temp.size):
        f.temp[np.uintp(k)] = 0.0
        f.dtemp[np.uintp(k)] = 0.0
    for k in range(f.p.size):
        f.p[np.uintp(k)] = 0.0
    forget_factor(b)
    evaluate(m, pt, q, f)
    for _ in range(6):
        error, p_max, _size = film_residual(m, f.p, f)
        if not error > 1e-2 * p_max or not film_solve(m, f.p, f):
            break
        for k in range(f.p.size):
            f.p[np.uintp(k)] = max(f.film_rhs[np.uintp(k * N_SIDES)], 0.0)
    _press_gear(m, pt, q, f)


@kernel
def contact_force(b: Bench) -> float:
    """Return the force on the asperities of film 1 [N] as last evaluated."""
    f = washer_fields(washer_model(b.par), b.work)
    return float(f.small[CONTACT])


@kernel
def note(
    b: Bench, q: NDArray[np.float64], info: NDArray[np.float64], walk: NDArray[np.float64]
) -> None:
    """Write where the walker stands."""
    walk[S], walk[W], walk[SLOPE] = smooth_film(b, q), info[REACHED_LOAD], info[LOAD_SLOPE]
    walk[SHARE] = contact_force(b) / max(info[REACHED_LOAD], 1e-12)


@kernel
def enter_curve(
    b: Bench, pt: Point, ratio: float, q: NDArray[np.float64],
    info: NDArray[np.float64], walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve at a film of ``ratio`` sigma from nothing; thicker films are tried if that fails."""
    sigma = b.par[SIGMA1]
    status = MAX_ITERATIONS
    for attempt in range(6):
        wanted = ratio * (1.0 + 0.5 * attempt)
        cold_start(b, pt, wanted, q)
        status = newton(b, pt, FILM, wanted * sigma, q, NO_FLOOR, walk[ACCURACY], 40.0, info)
        if status == OK:
            note(b, q, info, walk)
            return OK
    return status


@kernel
def _along(b: Bench, step: float, q: NDArray[np.float64]) -> None:
    """Move the positions along the tangent of the curve by ``step`` [m] of film thickness."""
    f = washer_fields(washer_model(b.par), b.work)
    for k in range(4):
        q[k] += f.small[TANGENT + k] * step


@kernel
def walk_to(
    b: Bench, pt: Point, target: float, q: NDArray[np.float64],
    info: NDArray[np.float64], walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve at the smoothed film thickness ``target`` [m], in smaller steps if need be."""
    for _ in range(60):
        step = target - walk[S]
        if abs(step) < 1e-9 * b.par[SIGMA1]:
            return OK
        for _half in range(12):
            remember(b, q, 0.0)
            wanted = target if abs(step - (target - walk[S])) == 0.0 else walk[S] + step
            _along(b, step, q)
            status = newton(b, pt, FILM, wanted, q, NO_FLOOR, walk[ACCURACY], 12.0, info)
            if status == OK and info[REACHED_LOAD] > 0.0:
                break
            recall(b, q, 0.0)
            forget_factor(b)
            step *= 0.4
        else:
            return MAX_ITERATIONS
        note(b, q, info, walk)
    return MAX_ITERATIONS


@inlined
def exact_slope(
    b: Bench, pt: Point, q: NDArray[np.float64], info: NDArray[np.float64],
    walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve again where the walker stands, with heat factors made on the spot."""
    forget_factor(b)
    status = newton(b, pt, FILM, smooth_film(b, q), q, NO_FLOOR, 1e-7, 20.0, info)
    note(b, q, info, walk)
    return status


@kernel
def step_down(sigma: float, s: float, finest: float) -> float:
    """Return the next film thickness [m]: a tenth less, near contact ``finest`` sigma less."""
    return s - max(finest * sigma, 0.12 * (s - 2.5 * sigma))


@inlined
def walk_down(
    b: Bench, pt: Point, finest: float, q: NDArray[np.float64],
    info: NDArray[np.float64], walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Take one step to a thinner film; return a status."""
    return walk_to(b, pt, step_down(b.par[SIGMA1], walk[S], finest), q, info, walk)


@kernel
def find_fold(
    b: Bench, pt: Point, upper: float, lower: float, q: NDArray[np.float64],
    info: NDArray[np.float64], walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Walk to the film thickness between two [m] at which the load has an extremum.

    Bracketed secant on dload/ds (Illinois). ``upper`` and ``lower`` lie on different sides of one
    fold; the walker ends on it. Slopes need a heat factor made at the point itself: one from a
    little way off finds the fold 0.1 sigma away.
    """
    sigma = b.par[SIGMA1]
    one, two = upper, lower
    ga, gb = 0.0, 0.0
    for attempt in range(40):
        if attempt == 0:
            s = one
        elif attempt == 1:
            s = two
        else:
            s = (one * gb - two * ga) / (gb - ga)
            if not min(one, two) < s < max(one, two):
                s = 0.5 * (one + two)
        if walk_to(b, pt, s, q, info, walk) != OK:
            return MAX_ITERATIONS
        status = exact_slope(b, pt, q, info, walk)
        if status != OK:
            return status
        g = walk[SLOPE]
        if attempt == 0:
            ga = g
        elif attempt == 1:
            gb = g
            if not ga * gb < 0.0:  # both folds of a narrow pair lie between: look for one
                for k in range(1, 8):
                    two = lower + (upper - lower) * (1.0 - k / 8.0)
                    if walk_to(b, pt, two, q, info, walk) != OK:
                        return MAX_ITERATIONS
                    status = exact_slope(b, pt, q, info, walk)
                    gb = walk[SLOPE]
                    if status != OK or ga * gb < 0.0:
                        break
                if not ga * gb < 0.0:
                    return MAX_ITERATIONS
        elif g * gb < 0.0:
            one, ga, two, gb = two, gb, s, g
        else:
            ga *= 0.5
            two, gb = s, g
        if attempt > 1 and (abs(one - two) < 1e-5 * sigma or abs(g) * sigma < 1e-6 * walk[W]):
            return OK
    return OK if math.isfinite(walk[W]) else MAX_ITERATIONS
