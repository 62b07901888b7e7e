"""Which of several solutions: the film branch up to its fold, the contact branch beyond it.

A descent along the curve from light load decides when Newton's method alone cannot: it meets the
solutions in order and names their branches. It always arrives, because the curve is
single-valued in film thickness.
"""

import math

from ...numerics.arrays import copy
from ...numerics.jit import inlined, kernel
from ...numerics.status import MAX_ITERATIONS, NO_BRANCH, OK
from . import layout as L
from .continuation import (
    cold_start,
    contact_force,
    enter_curve,
    find_fold,
    recall,
    remember,
    step_down,
    walk_down,
    walk_to,
    walk_within,
)
from .gap import oil_viscosity
from .newton import FILM, LOAD, NO_FLOOR, evaluate_here, film_ratio, newton, smooth_film
from .workspace import Point, Workspace, fields_of, forget_factor, model_of

TOLERANCE = 1e-9  # of a solve from nothing
FILM_RATIO = 3.0  # single-valued curves are called film above it
CLEAR_SHARE = 0.01  # below this share of contact a stable solution is on the film branch
ENTRY_RATIO = 4.0
DESCENT = 0.28  # finest step of the descent [sigma]
ON_FOOT = 120.0  # iterations of a step in film thickness beyond all folds, before going by load
FIRST_ROUNDS = 4  # of settling there, which go by film thickness
ROUGHLY = 1e-4  # tolerance on the way
NOISE = 3e-4  # a load must change by more to count as past a fold; points are good to 1e-4
ONLY_FOLDS = 4.0  # wanted of a descent: no solution, but if the curve has folds
COOL = 3.0  # how much thinner [-]: 6000 curves of the default washer have no fold below 19
COOL_RATIO = 2.0  # film ratio at which it is estimated


@kernel
def first_guess(w: Workspace, pt: Point) -> float:
    """Return about the film ratio: narrow ring, film heated at its mean gap.

    The factors 0.8 and 0.4 were fitted to solutions from 50 to 1367 rad/s: 15 % off at the median.
    Below 0 no film was found that would carry the load.
    """
    m = model_of(w)
    width = m.outer_radius - m.inner_radius
    mean = 0.5 * (m.outer_radius + m.inner_radius)
    mu, dmu = oil_viscosity(m.par, pt.oil_temperature)
    v = abs(pt.speed) * mean
    strength = 0.25 * mu * v * width**3
    if strength <= 0.0 or pt.tilt <= 0.0:
        return ENTRY_RATIO
    conductance = m.carrier_conductivity / m.carrier_thickness
    resistance = 1.0 / (conductance + m.gear_conductivity / m.gear_thickness)
    thinned = 1.0  # viscosity over that at oil temperature
    gap = math.sqrt(strength / pt.load)
    for _ in range(6):  # W = strength (1/gap^2 - 1/(gap + 2 mean tilt)^2)
        rise = 2.0 * resistance * mu * thinned * v * v / (gap + mean * pt.tilt)
        thinned = 1.0 / (1.0 - rise * dmu / mu)
        far = gap + 2.0 * mean * pt.tilt
        lift = 0.8 * thinned * strength
        gap = math.sqrt(lift / (pt.load + lift / (far * far)))
    return min((gap - 0.4 * pt.tilt * width) / m.sigma1, 150.0)


@kernel
def is_cool(w: Workspace, pt: Point) -> bool:
    """Tell if friction warms the washer so little that its curve has no folds.

    What the oil would be thinned by (rise times relative slope of the viscosity) by a film of
    ``COOL_RATIO`` and by asperities that rub under as much load as that film carries.
    """
    m = model_of(w)
    width = m.outer_radius - m.inner_radius
    mean = 0.5 * (m.outer_radius + m.inner_radius)
    mu, dmu = oil_viscosity(m.par, pt.oil_temperature)
    v = abs(pt.speed) * mean
    gap = COOL_RATIO * m.sigma1
    far = gap + 2.0 * mean * pt.tilt
    lift = 0.25 * mu * v * width**3 * (1.0 / (gap * gap) - 1.0 / (far * far))
    rubs = m.par[L.P_FRICTION_REFERENCE]
    if m.par[L.P_FRICTION_LAW] == L.CONSTANT_FRICTION:
        rubs = m.par[L.P_DRY_FRICTION]
    conductance = m.carrier_conductivity / m.carrier_thickness
    if not m.is_insulated:
        conductance += m.gear_conductivity / m.gear_thickness
    area = 2.0 * math.pi * mean * width
    heat = v * (mu * v * area / (gap + mean * pt.tilt) + rubs * lift)
    return bool(-dmu * heat < COOL * mu * conductance * area)


@kernel
def settle(w: Workspace, pt: Point, upper: float, lower: float) -> int:
    """Solve for the load between two film thicknesses [m] that bracket it on a stable interval.

    ``upper`` carries less than the load, ``lower`` at least the load.
    """
    return _settle(w, pt, upper, lower, False)


@kernel
def _settle(w: Workspace, pt: Point, upper: float, lower: float, alone: bool) -> int:
    """Do as `settle`; ``alone``: the load has one solution, in contact.

    There bodies may turn the washer so that its film grows with the load: what Newton's method
    finds outside the bracket counts, but for its first rounds.
    """
    sigma = w.par[L.D_SIGMA1]
    end = w.info[L.ITERATIONS] + 2.0 * ON_FOOT
    for attempt in range(60):
        remember(w, 1.0)
        status = newton(w, pt, LOAD, pt.load, NO_FLOOR, TOLERANCE, 15.0)
        s = smooth_film(w)
        margin = 1e-6 * sigma + 1e-3 * (upper - lower)
        inside = lower - margin <= s <= upper + margin
        if status == OK and (inside or (alone and attempt >= FIRST_ROUNDS)):
            return OK
        recall(w, 1.0)
        forget_factor(w)
        if alone and w.info[L.ITERATIONS] >= end:
            return MAX_ITERATIONS
        if upper - lower < 1e-7 * sigma:  # on the fold itself: the load is met to rounding
            evaluate_here(w, pt)
            return OK if abs(w.curve[L.AT_LOAD] / pt.load - 1.0) < 1e-6 else MAX_ITERATIONS
        middle = 0.5 * (upper + lower)
        status = walk_within(w, pt, middle, ON_FOOT if alone else math.inf)
        if status != OK:
            return status
        if w.curve[L.AT_LOAD] < pt.load:
            upper = w.curve[L.AT_FILM]
        else:
            lower = w.curve[L.AT_FILM]
    return MAX_ITERATIONS


@kernel
def _climb(w: Workspace, pt: Point) -> int:
    """Settle above the walker, which carries more than the load with a thick film."""
    lower = w.curve[L.AT_FILM]
    for _ in range(60):
        status = walk_to(w, pt, 1.25 * w.curve[L.AT_FILM])
        if status != OK:
            return status
        if w.curve[L.AT_LOAD] < pt.load:
            return settle(w, pt, w.curve[L.AT_FILM], lower)
        lower = w.curve[L.AT_FILM]
    return MAX_ITERATIONS


@kernel
def is_near_fold(
    places: tuple[float, float, float], loads: tuple[float, float, float], load: float
) -> bool:
    """Tell if a fold about the middle one of three points may lie beyond the load.

    A parabola through them says how far the fold lies beyond that point; a corner lies up to four
    times as far.
    """
    (s0, s1, s2), (w0, w1, w2) = places, loads
    beyond = 0.25 * load
    if s0 != s1:
        first, second = (w1 - w0) / (s1 - s0), (w2 - w1) / (s2 - s1)
        bend = (second - first) / (s2 - s0)
        slope = first + bend * (s1 - s0)
        if bend != 0.0:
            beyond = min(beyond, 1.25 * slope * slope / abs(bend))
    return abs(w1 - load) < 0.02 * load + beyond


@kernel
def _contact_side(w: Workspace, pt: Point, lost: bool) -> int:
    """Solve for the load below the walker, which has passed every fold above the load.

    One solution is left, so any way to it will do: from the walker, unless it has just ``lost`` the
    film, from a washer pressed on, as warm as its asperities would make it, from a cold one, by
    walking.
    """
    sigma, temp = w.par[L.D_SIGMA1], fields_of(w).temp
    radius = 0.5 * (w.par[L.P_INNER_RADIUS] + w.par[L.P_OUTER_RADIUS])
    friction = fields_of(w).small[L.FRICTION]
    warmer = friction * pt.load * abs(pt.speed) * radius / max(w.info[L.HEAT], 1e-2)
    remember(w, 1.0)
    for attempt in range(3):
        status = OK
        ratio = 0.8 - 0.4 * attempt
        if attempt > 0 and ratio * sigma < w.curve[L.AT_FILM]:
            recall(w, 1.0)
            copy(temp, fields_of(w).trial)
            cold_start(w, pt, ratio)
            if attempt == 1:
                for k in range(temp.size):
                    temp[k] = warmer * fields_of(w).trial[k]
            status = newton(w, pt, FILM, ratio * sigma, NO_FLOOR, 1e-2, 20.0)
        elif attempt > 0 or lost or w.curve[L.AT_LOAD] < 0.7 * pt.load:
            continue
        if status == OK:
            status = newton(w, pt, LOAD, pt.load, NO_FLOOR, TOLERANCE, 20.0)
        if status == OK and smooth_film(w) <= w.curve[L.AT_FILM]:
            return OK
    recall(w, 1.0)
    forget_factor(w)
    for _ in range(200):
        upper, before = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
        # one solution: the load is above that of the fold where the film is lost, if there is one
        alone = before < pt.load and not pt.load < w.found[L.LOST]
        remember(w, 2.0)
        target = step_down(sigma, upper, DESCENT)
        status = walk_within(w, pt, target, ON_FOOT if alone else math.inf)
        if status == OK:
            if not before < pt.load <= w.curve[L.AT_LOAD]:
                continue
            status = _settle(w, pt, upper, w.curve[L.AT_FILM], alone)
        if status == OK or not alone:
            return status
        recall(w, 2.0)
        return _press(w, pt, before)
    return MAX_ITERATIONS


@kernel
def _press(w: Workspace, pt: Point, here: float) -> int:
    """Solve for the load by raising it from ``here`` [N], the present one, where it has one."""
    forget_factor(w)
    for _ in range(40):
        step, last = pt.load - here, False
        for _ in range(6):
            remember(w, 1.0)
            last = here + step == pt.load
            tolerance = TOLERANCE if last else ROUGHLY
            status = newton(w, pt, LOAD, here + step, NO_FLOOR, tolerance, 40.0 if last else 20.0)
            if status == OK:
                break
            recall(w, 1.0)
            forget_factor(w)
            step *= 0.4
        if status != OK or last:
            return status
        here += step
    return MAX_ITERATIONS


@kernel
def _named(w: Workspace, status: int, wanted: float) -> int:
    """Name the branch arrived at: that of the film, but where a single-valued curve is in contact.

    Returns ``status``, or NO_BRANCH if another branch was wanted.
    """
    thick = film_ratio(w) >= FILM_RATIO or w.found[L.MULTIPLICITY] != L.SINGLE
    w.found[L.BRANCH] = L.FILM_BRANCH if thick else L.CONTACT_BRANCH
    return NO_BRANCH if status == OK and wanted not in (L.ANY, w.found[L.BRANCH]) else status


@kernel
def descend(w: Workspace, pt: Point, wanted: float) -> int:
    """Solve for the load on the wanted branch by a descent from light load; return a status.

    ``wanted``: FILM_BRANCH, CONTACT_BRANCH, or ANY: film up to the fold, contact beyond it. If the
    wanted branch has no solution at this load, the other one is solved and NO_BRANCH returned. With
    ONLY_FOLDS it ends as soon as the multiplicity is known, wherever that is.
    """
    w.found[L.BRANCH], w.found[L.MULTIPLICITY] = 0.0, 0.0
    w.found[L.LOST], w.found[L.REGAINED] = math.nan, math.nan
    w.curve[L.ACCURACY] = ROUGHLY
    for attempt in range(3):
        status = enter_curve(w, pt, ENTRY_RATIO * (1.0 + 0.5 * attempt))
        if status != OK:
            return status
        clear = w.curve[L.AT_SHARE] < CLEAR_SHARE and w.curve[L.AT_SLOPE] < 0.0
        if clear or w.curve[L.AT_LOAD] < 1e-2 * pt.load:  # above every fold
            break
    above = w.curve[L.AT_LOAD] >= pt.load  # the film branch carries the load above the entry
    if above and wanted != L.CONTACT_BRANCH and wanted != ONLY_FOLDS:
        w.found[L.BRANCH] = L.FILM_BRANCH
        return _climb(w, pt)
    if is_cool(w, pt):
        w.found[L.MULTIPLICITY] = L.SINGLE
        status = _climb(w, pt) if above else _contact_side(w, pt, False)
        return _named(w, status, wanted)
    # the highest point so far (after the film is lost, the lowest), and the place before it
    s0, s1 = w.curve[L.AT_FILM], w.curve[L.AT_FILM]
    w0, w1 = w.curve[L.AT_LOAD], w.curve[L.AT_LOAD]
    upper, lower = math.nan, math.nan  # bracket of the solution above any fold
    lost = False
    for _ in range(400):
        status = walk_down(w, pt, DESCENT)
        if status != OK:
            return status
        s2, w2 = w.curve[L.AT_FILM], w.curve[L.AT_LOAD]
        has_film = above or not math.isnan(upper)
        if not lost and w2 < w1 * (1.0 - NOISE) - 1e-3:  # film lost between s0 and s2
            lost = True
            w.found[L.MULTIPLICITY] = L.MULTIPLE
            w.found[L.LOST] = w1
            if wanted == ONLY_FOLDS:
                return OK
            if not has_film and is_near_fold((s0, s1, s2), (w0, w1, w2), pt.load):
                remember(w, 2.0)
                status = find_fold(w, pt, s0, s2)
                if status != OK:
                    return status
                w.found[L.LOST] = w.curve[L.AT_LOAD]
                if w.curve[L.AT_LOAD] >= pt.load:
                    upper, lower, has_film = s0, w.curve[L.AT_FILM], True
                    remember(w, 2.0)
                else:
                    recall(w, 2.0)
                    forget_factor(w)
                    w.curve[L.AT_FILM], w.curve[L.AT_LOAD] = s2, w2
            if has_film and wanted != L.CONTACT_BRANCH:
                break
            if not has_film:  # beyond the fold: one solution only, on the contact branch
                w.found[L.BRANCH] = L.CONTACT_BRANCH
                status = _contact_side(w, pt, True)
                return NO_BRANCH if status == OK and wanted == L.FILM_BRANCH else status
        elif lost and w2 > w1 * (1.0 + NOISE):
            # film regained between s0 and s2; the contact branch is wanted
            w.found[L.REGAINED] = w1
            if is_near_fold((s0, s1, s2), (w0, w1, w2), pt.load):
                status = find_fold(w, pt, s0, s2)
                if status != OK:
                    return status
                w.found[L.REGAINED] = w.curve[L.AT_LOAD]
            if w.found[L.REGAINED] > pt.load:
                break  # no solution on the contact branch
            w.found[L.BRANCH] = L.CONTACT_BRANCH
            if w2 >= pt.load:  # the step has passed the solution already
                return settle(w, pt, w.curve[L.AT_FILM] if w.curve[L.AT_FILM] > s2 else s1, s2)
            return _contact_side(w, pt, False)
        elif not lost and not has_film and w2 >= pt.load:
            upper, lower = s1, s2
            remember(w, 2.0)
        dry = not lost and w.curve[L.AT_SHARE] > 0.9  # the asperities carry: no fold will come
        if has_film or not math.isnan(upper):
            if dry or (not lost and w.curve[L.AT_FILM] < 0.5 * w.par[L.D_SIGMA1]):
                w.found[L.MULTIPLICITY] = L.SINGLE
                if wanted == ONLY_FOLDS:
                    return OK
                break
        elif dry:
            w.found[L.MULTIPLICITY] = L.SINGLE
            if wanted == ONLY_FOLDS:
                return OK
            return _named(w, _contact_side(w, pt, False), wanted)
        if (w2 < w1) == lost:
            s0, s1, w0, w1 = s1, s2, w1, w2
        if w.curve[L.AT_FILM] < -12.0 * w.par[L.D_SIGMA1]:
            return MAX_ITERATIONS
    if above:  # no contact branch at this load after all
        status = enter_curve(w, pt, ENTRY_RATIO)
        if status == OK:
            status = _climb(w, pt)
        w.found[L.BRANCH] = L.FILM_BRANCH
        return NO_BRANCH if status == OK else status
    if math.isnan(upper):
        return MAX_ITERATIONS
    recall(w, 2.0)
    forget_factor(w)
    w.curve[L.AT_FILM], w.curve[L.AT_LOAD] = lower, pt.load
    status = settle(w, pt, upper, lower)
    return _named(w, status, wanted)


@inlined
def solve_cold(w: Workspace, pt: Point, wanted: float) -> int:
    """Solve from nothing: Newton from a guess if that lands on a clear film, else a descent."""
    w.found[L.BRANCH], w.found[L.MULTIPLICITY] = 0.0, 0.0
    w.found[L.LOST], w.found[L.REGAINED] = math.nan, math.nan
    guess = first_guess(w, pt)
    if wanted != L.CONTACT_BRANCH and guess > 0.0:
        cold_start(w, pt, max(guess, ENTRY_RATIO))
        status = newton(w, pt, LOAD, pt.load, 2.4, TOLERANCE, 40.0)
        if status == OK and is_clear_film(w):
            w.found[L.BRANCH] = L.FILM_BRANCH
            return OK
    return descend(w, pt, wanted)


@kernel
def is_clear_film(w: Workspace) -> bool:
    """Tell if the present solution is stable, thicker than 3 sigma and carried by the film."""
    return (
        w.info[L.LOAD_SLOPE] < 0.0
        and film_ratio(w) >= FILM_RATIO
        and contact_force(w) < CLEAR_SHARE * w.info[L.REACHED_LOAD]
    )
