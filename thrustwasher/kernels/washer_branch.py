"""Which of several solutions: the film branch up to its fold, the contact branch beyond it.

A descent along the curve from light load decides when Newton's method alone cannot: it meets the
solutions in order and names their branches. It always arrives, because the curve is
single-valued in film thickness.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import inlined, kernel
from .viscosity import viscosity
from .washer_curve import (
    ACCURACY,
    SHARE,
    SLOPE,
    S,
    W,
    cold_start,
    contact_force,
    enter_curve,
    find_fold,
    recall,
    remember,
    walk_down,
    walk_to,
)  # fmt: skip
from .washer_fields import Bench, Point, forget_factor
from .washer_model import SIGMA1, washer_model
from .washer_newton import (
    FILM,
    LOAD,
    LOAD_SLOPE,
    MAX_ITERATIONS,
    NO_FLOOR,
    OK,
    REACHED_LOAD,
    evaluate_here,
    film_ratio,
    newton,
    smooth_film,
)  # fmt: skip

NO_BRANCH = 12  # errors.Status; a test keeps them equal
ANY, FILM_BRANCH, UNSTABLE, CONTACT_BRANCH = 0.0, 1.0, 2.0, 3.0
UNKNOWN, SINGLE, MULTIPLE = 0.0, 1.0, 2.0  # is the curve single-valued in load?
TOLERANCE = 1e-9  # of a solve from nothing
FILM_RATIO = 3.0  # single-valued curves are called film above it
CLEAR_SHARE = 0.01  # below this share of contact a stable solution is on the film branch
# results of a descent, in an array: branch, multiplicity, loads of the folds found (nan: not met)
BRANCH, MULTIPLICITY, LOST, REGAINED, N_FOUND = 0, 1, 2, 3, 4
ENTRY_RATIO = 4.0
DESCENT = 0.28  # finest step of the descent [sigma]
NOISE = 3e-4  # a load must change by more to count as past a fold; points are good to 1e-4


@kernel
def first_guess(b: Bench, pt: Point) -> float:
    """Return a film ratio to start from: narrow ring, film heated at its mean gap.

    The factors 0.8 and 0.4 were fitted to solutions from 50 to 1367 rad/s: 15 % off at the median.
    """
    m = washer_model(b.par)
    width = m.outer_radius - m.inner_radius
    mean = 0.5 * (m.outer_radius + m.inner_radius)
    mu, dmu = viscosity(
        pt.oil_temperature, m.viscosity_scale, m.viscosity_constant, m.viscosity_exponent
    )
    v = abs(pt.speed) * mean
    strength = 0.25 * mu * v * width**3
    if strength <= 0.0 or pt.tilt <= 0.0:
        return ENTRY_RATIO
    resistance = 1.0 / (m.conductivity * (1.0 / m.carrier_thickness + 1.0 / m.gear_thickness))
    thinned = 1.0  # viscosity over that at oil temperature
    gap = math.sqrt(strength / pt.load)
    for _ in range(6):  # W = strength (1/gap^2 - 1/(gap + 2 mean tilt)^2)
        rise = 2.0 * resistance * mu * thinned * v * v / (gap + mean * pt.tilt)
        thinned = 1.0 / (1.0 - rise * dmu / mu)
        far = gap + 2.0 * mean * pt.tilt
        lift = 0.8 * thinned * strength
        gap = math.sqrt(lift / (pt.load + lift / (far * far)))
    ratio = (gap - 0.4 * pt.tilt * width) / m.sigma1
    return min(max(ratio, ENTRY_RATIO), 150.0)


@kernel
def _settle(
    b: Bench, pt: Point, upper: float, lower: float, q: NDArray[np.float64],
    info: NDArray[np.float64], walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve for the load between two film thicknesses [m] that bracket it on a stable stretch.

    ``upper`` carries less than the load, ``lower`` at least the load.
    """
    sigma = b.par[SIGMA1]
    for _ in range(60):
        remember(b, q, 1.0)
        status = newton(b, pt, LOAD, pt.load, q, NO_FLOOR, TOLERANCE, 15.0, info)
        s = smooth_film(b, q)
        margin = 1e-6 * sigma + 1e-3 * (upper - lower)
        if status == OK and lower - margin <= s <= upper + margin:
            return OK
        recall(b, q, 1.0)
        forget_factor(b)
        if upper - lower < 1e-7 * sigma:  # on the fold itself: the load is met to rounding
            evaluate_here(b, pt, q)
            return OK if abs(walk[W] / pt.load - 1.0) < 1e-6 else MAX_ITERATIONS
        status = walk_to(b, pt, 0.5 * (upper + lower), q, info, walk)
        if status != OK:
            return status
        if walk[W] < pt.load:
            upper = walk[S]
        else:
            lower = walk[S]
    return MAX_ITERATIONS


@kernel
def _climb(
    b: Bench, pt: Point, q: NDArray[np.float64], info: NDArray[np.float64],
    walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Settle above the walker, which carries more than the load with a thick film."""
    lower = walk[S]
    for _ in range(60):
        status = walk_to(b, pt, 1.25 * walk[S], q, info, walk)
        if status != OK:
            return status
        if walk[W] < pt.load:
            return _settle(b, pt, walk[S], lower, q, info, walk)
        lower = walk[S]
    return MAX_ITERATIONS


@kernel
def _near(value: float, load: float, side: float) -> bool:
    """Tell if a fold's load estimate is too close to the load to decide without refining.

    The highest or lowest point of a descent lies short of the fold by up to a tenth of its load,
    towards ``side``: -1 if it is too low (film lost), 1 if too high (film regained).
    """
    above = value / load - 1.0
    return abs(above) < 0.02 or 0.0 < side * above < 0.25


@inlined
def _contact_side(
    b: Bench, pt: Point, q: NDArray[np.float64], info: NDArray[np.float64],
    walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve for the load below the walker, which has passed every fold above the load.

    One solution is left, so any way to it will do: first from a washer pressed on, then by walking.
    """
    sigma = b.par[SIGMA1]
    remember(b, q, 1.0)
    for attempt in range(2):
        ratio = 0.8 - 0.6 * attempt
        if ratio * sigma < walk[S]:
            cold_start(b, pt, ratio, q)
            status = newton(b, pt, FILM, ratio * sigma, q, NO_FLOOR, 1e-2, 20.0, info)
            if status == OK:
                status = newton(b, pt, LOAD, pt.load, q, NO_FLOOR, TOLERANCE, 20.0, info)
            if status == OK and smooth_film(b, q) <= walk[S]:
                return OK
    recall(b, q, 1.0)
    forget_factor(b)
    for _ in range(200):
        upper, before = walk[S], walk[W]
        status = walk_down(b, pt, DESCENT, q, info, walk)
        if status != OK:
            return status
        if before < pt.load <= walk[W]:
            return _settle(b, pt, upper, walk[S], q, info, walk)
    return MAX_ITERATIONS


@kernel
def descend(
    b: Bench, pt: Point, wanted: float, q: NDArray[np.float64],
    info: NDArray[np.float64], found: NDArray[np.float64], walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve for the load on the wanted branch by a descent from light load; return a status.

    ``wanted``: FILM_BRANCH, CONTACT_BRANCH, or ANY: film up to the fold, contact beyond it. If the
    wanted branch has no solution at this load, the other one is solved and NO_BRANCH returned.
    """
    found[BRANCH], found[MULTIPLICITY] = 0.0, 0.0
    found[LOST], found[REGAINED] = math.nan, math.nan
    walk[ACCURACY] = 1e-4
    for attempt in range(3):
        status = enter_curve(b, pt, ENTRY_RATIO * (1.0 + 0.5 * attempt), q, info, walk)
        if status != OK:
            return status
        clear = walk[SHARE] < CLEAR_SHARE and walk[SLOPE] < 0.0
        if clear or walk[W] < 1e-2 * pt.load:  # above every fold
            break
    above = walk[W] >= pt.load  # the film branch carries the load above the entry
    if above and wanted != CONTACT_BRANCH:
        found[BRANCH] = FILM_BRANCH
        return _climb(b, pt, q, info, walk)
    # the highest point so far (after the film is lost, the lowest), and the place before it
    s0, s1, w1 = walk[S], walk[S], walk[W]
    upper, lower = math.nan, math.nan  # bracket of the solution above any fold
    lost = False
    for _ in range(400):
        status = walk_down(b, pt, DESCENT, q, info, walk)
        if status != OK:
            return status
        s2, w2 = walk[S], walk[W]
        has_film = above or not math.isnan(upper)
        if not lost and w2 < w1 * (1.0 - NOISE) - 1e-3:  # film lost between s0 and s2
            lost = True
            found[MULTIPLICITY] = MULTIPLE
            found[LOST] = w1
            if not has_film and _near(w1, pt.load, -1.0):
                remember(b, q, 2.0)
                status = find_fold(b, pt, s0, s2, q, info, walk)
                if status != OK:
                    return status
                found[LOST] = walk[W]
                if walk[W] >= pt.load:
                    upper, lower, has_film = s0, walk[S], True
                    remember(b, q, 2.0)
                else:
                    recall(b, q, 2.0)
                    forget_factor(b)
                    walk[S], walk[W] = s2, w2
            if has_film and wanted != CONTACT_BRANCH:
                break
            if not has_film:  # beyond the fold: one solution only, on the contact branch
                found[BRANCH] = CONTACT_BRANCH
                status = _contact_side(b, pt, q, info, walk)
                return NO_BRANCH if status == OK and wanted == FILM_BRANCH else status
        elif lost and w2 > w1 * (1.0 + NOISE):
            # film regained between s0 and s2; the contact branch is wanted
            found[REGAINED] = w1
            if _near(w1, pt.load, 1.0):
                status = find_fold(b, pt, s0, s2, q, info, walk)
                if status != OK:
                    return status
                found[REGAINED] = walk[W]
            if found[REGAINED] > pt.load:
                break  # no solution on the contact branch
            found[BRANCH] = CONTACT_BRANCH
            if w2 >= pt.load:  # the step has passed the solution already
                return _settle(b, pt, walk[S] if walk[S] > s2 else s1, s2, q, info, walk)
            return _contact_side(b, pt, q, info, walk)
        elif not lost and not has_film and w2 >= pt.load:
            upper, lower = s1, s2
            remember(b, q, 2.0)
        if not lost and (above or not math.isnan(upper)) and (
            walk[SHARE] > 0.9 or walk[S] < 0.5 * b.par[SIGMA1]
        ):  # fmt: skip
            found[MULTIPLICITY] = SINGLE  # the asperities carry: no fold will come
            break
        if (w2 < w1) == lost:
            s0, s1, w1 = s1, s2, w2
        if walk[S] < -12.0 * b.par[SIGMA1]:
            return MAX_ITERATIONS
    if above:  # no contact branch at this load after all
        status = enter_curve(b, pt, ENTRY_RATIO, q, info, walk)
        if status == OK:
            status = _climb(b, pt, q, info, walk)
        found[BRANCH] = FILM_BRANCH
        return NO_BRANCH if status == OK else status
    if math.isnan(upper):
        return MAX_ITERATIONS
    recall(b, q, 2.0)
    forget_factor(b)
    walk[S], walk[W] = lower, pt.load
    status = _settle(b, pt, upper, lower, q, info, walk)
    thick = film_ratio(b, q) >= FILM_RATIO
    single = found[MULTIPLICITY] == SINGLE
    found[BRANCH] = FILM_BRANCH if thick or not single else CONTACT_BRANCH
    if status == OK and wanted != ANY and found[BRANCH] != wanted:
        return NO_BRANCH
    return status


@inlined
def solve_cold(
    b: Bench, pt: Point, wanted: float, q: NDArray[np.float64],
    info: NDArray[np.float64], found: NDArray[np.float64], walk: NDArray[np.float64],
) -> int:  # fmt: skip
    """Solve from nothing: Newton from a guess if that lands on a clear film, else a descent."""
    found[BRANCH], found[MULTIPLICITY] = 0.0, 0.0
    found[LOST], found[REGAINED] = math.nan, math.nan
    if wanted != CONTACT_BRANCH:
        cold_start(b, pt, first_guess(b, pt), q)
        status = newton(b, pt, LOAD, pt.load, q, 2.4, TOLERANCE, 40.0, info)
        if status == OK and is_clear_film(b, q, info):
            found[BRANCH] = FILM_BRANCH
            return OK
    return descend(b, pt, wanted, q, info, found, walk)


@kernel
def is_clear_film(b: Bench, q: NDArray[np.float64], info: NDArray[np.float64]) -> bool:
    """Tell if the present solution is stable, thicker than 3 sigma and carried by the film."""
    return (
        info[LOAD_SLOPE] < 0.0
        and film_ratio(b, q) >= FILM_RATIO
        and contact_force(b) < CLEAR_SHARE * info[REACHED_LOAD]
    )
