"""Walking along the curve of solutions at fixed speed, tilt and oil: load over film thickness.

With the film thickness prescribed the solution is unique: falling film thickness leads from light
load over the film branch, through the fold where the film is lost, back along the unstable
branch to the fold where it is regained, and along the contact branch.
"""

import math

import numpy as np

from ...numerics.arrays import clear, copy
from ...numerics.jit import Array, inlined, kernel
from ...numerics.status import MAX_ITERATIONS, OK
from . import layout as L
from .constants import WasherModel
from .gap import evaluate_gaps
from .newton import FILM, NO_FLOOR, evaluate, newton, smooth_film
from .workspace import Fields, Point, Workspace, fields_of, forget_factor, model_of, square, vector

LARGEST_RISE = 50.0  # [K] of a temperature by a step along the tangent


@kernel
def _slot(keep: Array, n_temp: int, n: int, slot: float) -> tuple[Array, Array, Array]:
    """Return positions, temperatures and pressures of a slot of ``f.keep``."""
    q = int(slot) * (4 + n_temp + n)
    temp = q + 4
    p = temp + n_temp
    return keep[q:temp], keep[temp:p], keep[p : p + n]


@kernel
def remember(w: Workspace, slot: float) -> None:
    """Keep the present solution in a slot of ``f.keep``."""
    f = fields_of(w)
    q, temp, p = _slot(f.keep, f.temp.size, f.p.size, slot)
    copy(w.q, q)
    copy(f.temp, temp)
    copy(f.p, p)


@kernel
def recall(w: Workspace, slot: float) -> None:
    """Take a solution back from a slot of ``f.keep``."""
    f = fields_of(w)
    q, temp, p = _slot(f.keep, f.temp.size, f.p.size, slot)
    copy(q, w.q)
    copy(temp, f.temp)
    copy(p, f.p)


@kernel
def _press_gear(m: WasherModel, pt: Point, q: Array, f: Fields) -> None:
    """Move the gear until gap 2 carries what film 1 carries; its force is nearly exponential."""
    forces, slopes = vector(f.small, L.FORCES), square(f.small, L.STIFFNESS)
    lift = forces[L.ON_WASHER] + forces[L.ON_GEAR]
    for j in range(m.n_t):
        for i in range(1, m.n_r - 1):
            k = np.uintp(j * m.n_r + i)
            lift += m.weight1[i] * m.weight_t[j] * f.p[k]
    lift = max(lift, 1.0)
    for attempt in range(2):
        if attempt > 0:  # a wide tilt has left the gear far above the washer
            q[L.Z_GEAR] = q[L.Z_WASHER] + (pt.tilt - q[L.TILT_Y]) * m.outer_radius + 3.0 * m.sigma2
        for _ in range(12):
            evaluate_gaps(m, pt, q, f)
            force, slope = forces[L.ON_GEAR], slopes[L.ON_GEAR, L.Z_GEAR]
            if not force > 1e-12 * lift:
                q[L.Z_GEAR] -= m.sigma2
                continue
            move = math.log(force / lift) * force / -slope
            q[L.Z_GEAR] += min(max(move, -m.sigma2), m.sigma2)
            if abs(move) < 0.05 * m.sigma2:
                return
        if force > 1e-12 * lift:
            return


@kernel
def cold_start(w: Workspace, pt: Point, ratio: float) -> None:
    """Place washer and gear for a film of ``ratio`` sigma, everything at oil temperature.

    The bodies' temperatures are those of the oil, the film is settled.
    """
    m, f, q = model_of(w), fields_of(w), w.q
    q[L.TILT_Y] = (0.99 if ratio > 3.0 else 0.95) * pt.tilt
    q[L.TILT_X] = 0.0
    q[L.Z_WASHER] = q[L.TILT_Y] * m.outer_radius + ratio * m.sigma1
    q[L.Z_GEAR] = q[L.Z_WASHER] + 3.0 * m.sigma2 + 0.05 * pt.tilt * m.outer_radius
    clear(f.temp)
    clear(f.dtemp)
    clear(f.p)
    forget_factor(w)
    evaluate(m, pt, q, f, False)
    _press_gear(m, pt, q, f)


@kernel
def contact_force(w: Workspace) -> float:
    """Return the force on the asperities of film 1 [N] as last evaluated."""
    return float(fields_of(w).small[L.CONTACT])


@kernel
def note(w: Workspace) -> None:
    """Write where on the curve the present solution is."""
    reached = w.info[L.REACHED_LOAD]
    w.curve[L.AT_FILM], w.curve[L.AT_LOAD] = smooth_film(w), reached
    w.curve[L.AT_SLOPE] = w.info[L.LOAD_SLOPE]
    w.curve[L.AT_SHARE] = contact_force(w) / max(reached, 1e-12)


@kernel
def enter_curve(w: Workspace, pt: Point, ratio: float) -> int:
    """Solve at a film of ``ratio`` sigma from nothing; thicker films are tried if that fails."""
    sigma = w.par[L.D_SIGMA1]
    status = MAX_ITERATIONS
    for attempt in range(10):
        # a film of cold oil may carry far more than any load, a wide tilt may need a thick one
        wanted = ratio * (1.0 + 0.5 * attempt if attempt < 6 else 5.0 * 3.0 ** (attempt - 6))
        cold_start(w, pt, wanted)
        status = newton(w, pt, FILM, wanted * sigma, NO_FLOOR, w.curve[L.ACCURACY], 40.0)
        if status == OK:
            note(w)
            return OK
    return status


@kernel
def go_along(w: Workspace, step: float) -> None:
    """Move positions and temperatures along the tangent of the curve by ``step`` [m] of film."""
    f = fields_of(w)
    tangent = vector(f.small, L.TANGENT)
    jump = 0.0
    dt0, dt1, dt2, dt3 = f.following[0], f.following[1], f.following[2], f.following[3]
    for node in range(f.temp.size):
        k = np.uintp(node)
        slope = dt0[k] * tangent[0] + dt1[k] * tangent[1] + dt2[k] * tangent[2]
        f.dtemp[k] = step * (slope + dt3[k] * tangent[3])
        jump = max(jump, abs(f.dtemp[k]))
    share = 1.0 if jump <= LARGEST_RISE else LARGEST_RISE / jump
    for node in range(f.temp.size):
        k = np.uintp(node)
        f.temp[k] += share * f.dtemp[k]
    for c in range(4):
        w.q[c] += tangent[c] * step


@kernel
def walk_to(w: Workspace, pt: Point, target: float) -> int:
    """Solve at the smoothed film thickness ``target`` [m], in smaller steps if need be."""
    return walk_within(w, pt, target, math.inf)


@kernel
def walk_within(w: Workspace, pt: Point, target: float, most: float) -> int:
    """Do as `walk_to`, giving up after ``most`` iterations."""
    end = w.info[L.ITERATIONS] + most
    for part in range(60):
        patience = 12.0 if part < 2 else 36.0  # slow, but it converges: smaller steps are slower
        here = w.curve[L.AT_FILM]
        step = target - here
        if abs(step) < 1e-9 * w.par[L.D_SIGMA1]:
            return OK
        if w.info[L.ITERATIONS] >= end:
            return MAX_ITERATIONS
        for attempt in range(12):
            remember(w, 0.0)
            wanted = target if step == target - here else here + step
            if attempt == 0:  # a tangent that led astray is not followed again
                go_along(w, step)
            status = newton(w, pt, FILM, wanted, NO_FLOOR, w.curve[L.ACCURACY], patience)
            if status == OK and w.info[L.REACHED_LOAD] > 0.0:
                break
            recall(w, 0.0)
            forget_factor(w)
            step *= 0.4
        else:
            return MAX_ITERATIONS
        note(w)
    return MAX_ITERATIONS


@inlined
def exact_slope(w: Workspace, pt: Point) -> int:
    """Solve again where the walker stands, with heat factors made on the spot."""
    forget_factor(w)
    status = newton(w, pt, FILM, smooth_film(w), NO_FLOOR, 1e-7, 20.0)
    note(w)
    return status


@kernel
def step_down(sigma: float, s: float, finest: float) -> float:
    """Return the next film thickness [m]: a tenth less, near contact ``finest`` sigma less."""
    return s - max(finest * sigma, 0.12 * (s - 2.5 * sigma))


@inlined
def walk_down(w: Workspace, pt: Point, finest: float) -> int:
    """Take one step to a thinner film; return a status."""
    return walk_to(w, pt, step_down(w.par[L.D_SIGMA1], w.curve[L.AT_FILM], finest))


@kernel
def find_fold(w: Workspace, pt: Point, upper: float, lower: float) -> int:
    """Walk to the film thickness between two [m] at which the load has an extremum.

    Bracketed secant on dload/ds (Illinois). ``upper`` and ``lower`` lie on different sides of one
    fold; the walker ends on it. Slopes need a heat factor made at the point itself: one from a
    little way off finds the fold 0.1 sigma away.
    """
    sigma = w.par[L.D_SIGMA1]
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
        if walk_to(w, pt, s) != OK:
            return MAX_ITERATIONS
        status = exact_slope(w, pt)
        if status != OK:
            return status
        g = w.curve[L.AT_SLOPE]
        if attempt == 0:
            ga = g
        elif attempt == 1:
            gb = g
            if not ga * gb < 0.0:  # both folds of a narrow pair lie between: look for one
                for k in range(1, 8):
                    two = lower + (upper - lower) * (1.0 - k / 8.0)
                    if walk_to(w, pt, two) != OK:
                        return MAX_ITERATIONS
                    status = exact_slope(w, pt)
                    gb = w.curve[L.AT_SLOPE]
                    if status != OK or ga * gb < 0.0:
                        break
                if not ga * gb < 0.0:
                    return MAX_ITERATIONS
        elif g * gb < 0.0:
            one, ga, two, gb = two, gb, s, g
        else:
            ga *= 0.5
            two, gb = s, g
        if attempt > 1 and (
            abs(one - two) < 1e-5 * sigma or abs(g) * sigma < 1e-6 * w.curve[L.AT_LOAD]
        ):
            return OK
    return OK if math.isfinite(w.curve[L.AT_LOAD]) else MAX_ITERATIONS
