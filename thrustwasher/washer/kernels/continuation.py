"""Walking along the curve of solutions at fixed speed, tilt and oil: load over film thickness.

With the film thickness prescribed the solution is unique: falling film thickness leads from light
load over the film branch, through the fold where the film is lost, back along the unstable
branch to the fold where it is regained, and along the contact branch.

Python's ``load_curve`` and the page's are `begin_curve`, then `next_point` and `pass_fold` in turn.
"""

import math

import numpy as np

from ...numerics.arrays import clear, copy
from ...numerics.jit import Array, inlined, kernel
from ...numerics.status import MAX_ITERATIONS, OK, OVER_BUDGET
from . import layout as L
from .constants import WasherModel
from .gap import evaluate_gaps
from .heat import set_steady
from .newton import FILM, LOAD, NO_FLOOR, evaluate, is_spent, newton, smooth_film
from .outputs import outputs_at
from .workspace import Fields, Point, Workspace, fields_of, forget_factor, model_of, square, vector

LARGEST_RISE = 50.0  # [K] of a temperature by a step along the tangent
BUDGET = 1500.0  # Newton iterations that one solution may take
ENTRY_RATIO = 6.0  # film ratio at which the whole curve is entered
FINEST = 0.1  # [sigma] between its points near contact
GOLDEN = 0.618
MOST_LOADS = 100  # by 2 % each: seven times the load
MOST_STEPS = 1000
# where asperities carry this share and the load grows by this factor from point to point, points
# go by load: hot oil may let it grow without bound at one film thickness
ALONE, STEEP = 0.9, 1.1
SHALLOW = 3e-4  # relative drop of the load that makes a fold; solve_washer uses the same


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
def _lift(m: WasherModel, f: Fields) -> float:
    """Return what film 1 carries [N]."""
    forces = vector(f.small, L.FORCES)
    lift = forces[L.ON_WASHER] + forces[L.ON_GEAR]
    for j in range(m.n_t):
        for i in range(1, m.n_r - 1):
            k = np.uintp(j * m.n_r + i)
            lift += m.weight1[i] * m.weight_t[j] * f.p[k]
    return float(max(lift, 1.0))


@kernel
def press_gear(m: WasherModel, pt: Point, q: Array, f: Fields, lift: float) -> None:
    """Move the gear until gap 2 carries ``lift`` [N]; its force is nearly exponential."""
    forces, slopes = vector(f.small, L.FORCES), square(f.small, L.STIFFNESS)
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
    press_gear(m, pt, q, f, _lift(m, f))


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


@kernel
def renew_budget(w: Workspace) -> None:
    """Let the next solve take as many iterations as one from nothing."""
    w.info[L.BUDGET] = w.info[L.ITERATIONS] + BUDGET


@kernel
def _stuck(w: Workspace, status: int, place: float) -> int:
    """Return the status of a solve within a budget; write the place of the walk where it failed."""
    spent = is_spent(w)
    w.info[L.BUDGET] = 0.0
    if status == OK:
        return OK
    w.curve[L.STUCK] = place
    return OVER_BUDGET if spent else status


@kernel
def start_at(w: Workspace, pt: Point, ratio: float) -> int:
    """Solve from nothing at a film ratio, within a budget; return a status."""
    renew_budget(w)
    return _stuck(w, enter_curve(w, pt, ratio), L.AT_ENTRY)


@kernel
def go_to_load(w: Workspace, pt: Point, load: float) -> int:
    """Solve at a load [N] from here, where the asperities carry: no fold is on the way."""
    renew_budget(w)
    for _ in range(MOST_STEPS):
        if not w.curve[L.AT_LOAD] < load * (1.0 - 1e-9):
            return _stuck(w, OK, L.AT_A_LOAD)
        step, status = load - w.curve[L.AT_LOAD], OK
        remember(w, 0.0)
        for _ in range(12):
            target = w.curve[L.AT_LOAD] + step
            status = newton(w, pt, LOAD, target, NO_FLOOR, w.curve[L.ACCURACY], 20.0)
            if status == OK:
                break
            recall(w, 0.0)
            forget_factor(w)
            step *= 0.4
        if status != OK:
            return _stuck(w, status, L.AT_A_LOAD)
        note(w)
    return _stuck(w, MAX_ITERATIONS, L.AT_A_LOAD)


@kernel
def go_to_film(w: Workspace, pt: Point, film: float) -> int:
    """Walk to a film thickness [m]; where that gets stuck less exactly, or by load.

    Much oil on a coarse mesh makes Newton's method slow: a hundredth of the accuracy will do. By
    load where asperities carry.
    """
    renew_budget(w)
    status = walk_to(w, pt, film)
    if status != OK:
        renew_budget(w)
        w.curve[L.ACCURACY] *= 100.0
        status = walk_to(w, pt, film)
        w.curve[L.ACCURACY] *= 0.01
    if status != OK and film < w.curve[L.AT_FILM] and w.curve[L.AT_SHARE] > ALONE:
        for _ in range(MOST_LOADS):
            if w.curve[L.AT_FILM] > film:
                pressed = go_to_load(w, pt, 1.02 * w.curve[L.AT_LOAD])
                if pressed != OK:
                    return pressed
        renew_budget(w)
        status = walk_to(w, pt, film)
    return _stuck(w, status, L.ON_THE_WAY)


@kernel
def begin_curve(w: Workspace, pt: Point, load: float, whole: Array) -> int:
    """Go to where the steady washer carries less than ``load`` [N]; return a status."""
    set_steady(model_of(w), pt, fields_of(w))
    w.curve[L.ACCURACY] = 1e-8
    status = start_at(w, pt, ENTRY_RATIO)
    for _ in range(MOST_STEPS):
        thick = not w.curve[L.AT_FILM] < 1e3 * w.par[L.D_SIGMA1]
        if status != OK or thick or not w.curve[L.AT_LOAD] > load:
            break
        status = go_to_film(w, pt, 1.25 * w.curve[L.AT_FILM])
    clear(whole)
    whole[L.CURVE_LOAD] = whole[L.TOP_LOAD] = w.curve[L.AT_LOAD]
    whole[L.BEFORE_FILM] = whole[L.TOP_FILM] = w.curve[L.AT_FILM]
    whole[L.BEFORE_LOAD], whole[L.RISES] = math.inf, 1.0
    return status


@kernel
def next_point(w: Workspace, pt: Point, whole: Array) -> int:
    """Go on to the next point of the curve; return a status."""
    rises, here = whole[L.RISES] != 0.0, w.curve[L.AT_FILM]
    steep = whole[L.CURVE_LOAD] > STEEP * whole[L.BEFORE_LOAD] and w.curve[L.AT_SHARE] > ALONE
    by_load = rises and (whole[L.BY_LOAD] != 0.0 or steep)
    whole[L.BEFORE_FILM], whole[L.BEFORE_LOAD] = here, whole[L.CURVE_LOAD]
    status = OK
    if not by_load:
        status = go_to_film(w, pt, step_down(w.par[L.D_SIGMA1], here, FINEST))
        # soft bodies turn the washer so that its film grows with the load
        by_load = status != OK and rises and (whole[L.FOLDS] > 0.0 or w.curve[L.AT_FILM] < 0.0)
    if by_load:
        status = go_to_load(w, pt, STEEP * w.curve[L.AT_LOAD])
    whole[L.BY_LOAD] = 1.0 if by_load else 0.0
    whole[L.CURVE_LOAD] = w.curve[L.AT_LOAD]
    return status


@kernel
def pass_fold(w: Workspace, pt: Point, whole: Array) -> int:
    """Look if a fold lies behind the last point, then find it and come back; return a status."""
    load, way = whole[L.CURVE_LOAD], 1.0 if whole[L.RISES] != 0.0 else -1.0
    gain, noise = load - whole[L.TOP_LOAD], SHALLOW * whole[L.TOP_LOAD] + 1e-3
    status, whole[L.FOLD] = OK, 0.0
    if way * gain < -noise:
        found = whole[L.FOLD_LOAD : L.N_WHOLE]
        status = locate_fold(w, pt, way, whole[L.TOP_FILM], w.curve[L.AT_FILM], found)
        whole[L.FOLD], whole[L.RISES] = way, 1.0 - whole[L.RISES]
        whole[L.FOLDS] += 1.0
    elif not way * gain > 0.0:
        return OK
    whole[L.TOP_LOAD], whole[L.TOP_FILM] = load, whole[L.BEFORE_FILM]
    return status


@kernel
def locate_fold(
    w: Workspace, pt: Point, way: float, upper: float, lower: float, found: Array
) -> int:
    """Fill load and outputs where the load is greatest (``way`` 1) or least (-1), and come back.

    Between two film thicknesses [m]; ``found``: (1 + N_ALL,).
    """
    film, load, slope = w.curve[L.AT_FILM], w.curve[L.AT_LOAD], w.curve[L.AT_SLOPE]
    share, accuracy = w.curve[L.AT_SHARE], w.curve[L.ACCURACY]
    status = OK
    remember(w, 1.0)
    for attempt in range(2):
        if attempt == 0:
            renew_budget(w)
            status = _stuck(w, find_fold(w, pt, upper, lower), L.ON_THE_WAY)
        else:
            status = _search(w, pt, way, upper, lower)
        if status == OK:
            there = Point(w.curve[L.AT_LOAD], pt.speed, pt.tilt, pt.oil_temperature, pt.far_face)
            outputs_at(w, there)
            found[0] = w.curve[L.AT_LOAD]
            copy(w.outputs, found[1:])
        recall(w, 1.0)
        forget_factor(w)
        w.curve[L.AT_FILM], w.curve[L.AT_LOAD], w.curve[L.AT_SLOPE] = film, load, slope
        w.curve[L.AT_SHARE], w.curve[L.ACCURACY] = share, accuracy
        if status == OK:
            break
    return status


@kernel
def _search(w: Workspace, pt: Point, way: float, upper: float, lower: float) -> int:
    """Go to the greatest or least load between two film thicknesses [m]; return a status.

    By golden section, for folds too flat for the slope to say on which side they lie.
    """
    for _ in range(MOST_STEPS):
        if not upper - lower > 1e-3 * w.par[L.D_SIGMA1]:
            return OK
        loads = (0.0, 0.0)
        for share in (GOLDEN, 1.0 - GOLDEN):
            status = go_to_film(w, pt, lower + share * (upper - lower))
            if status != OK:
                return status
            loads = (loads[1], way * w.curve[L.AT_LOAD])
        if loads[0] > loads[1]:
            lower += (1.0 - GOLDEN) * (upper - lower)
        else:
            upper -= (1.0 - GOLDEN) * (upper - lower)
    return OK
