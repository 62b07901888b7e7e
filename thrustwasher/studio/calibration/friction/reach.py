"""Warnings of points that no constants of the friction law can follow, in plain sentences."""

from collections.abc import Callable, Mapping
from dataclasses import fields

import numpy as np

from ....clutch.parameters import ClutchParams
from ....numerics.jit import Array
from ..identifiability import listed
from ..least_squares import FitProblem
from ..model_fit import MATERIAL, SCATTERS
from .friction_law import TABLE, LawPoints, end_frictions, friction_over

RISE = 0.05  # of the mean friction: a smaller rise with speed is not worth one
CHANCE = 1e-4  # probability below which a rise is not the scatter's; the place is searched for
FEWEST = 4  # points that can show a rise
SEEN, HIDDEN = 0.5, 0.05  # of the fall still to come at the slowest point: before, after the fit
# Friction grows with each of these all over its range, or falls; so the bounds are the extremes.
GROWING = ("plough_weight", "shear_floor", "stick_speed", "decay_speed", "indentation")
GROWS = dict.fromkeys((*GROWING, "adhesion_factor"), 1) | {"hardness_ratio": -1}
LIMITS = {
    f.name: (f.metadata["min"], f.metadata["max"]) for f in fields(ClutchParams) if f.name in GROWS
}
Reached = Callable[[Mapping[str, float]], bool]


def rising(law: LawPoints, problem: FitProblem) -> str:
    """Return a sentence if friction rises with speed in some range, clearly.

    The best curve that only falls is flat where the points rise; the flat piece that misses them
    most is searched for a trend.
    """
    from scipy.optimize import isotonic_regression
    from scipy.stats import linregress

    order = np.lexsort((-problem.measured, law.speed))  # one speed's points are no rise
    speed, friction = law.speed[order], problem.measured[order]
    falling = isotonic_regression(friction, weights=problem.weight[order] ** 2, increasing=False)
    cost = (problem.weight[order] * (friction - falling.x)) ** 2
    worst = int(np.argmax(np.add.reduceat(cost, falling.blocks[:-1])))
    piece = slice(*falling.blocks[worst : worst + 2])
    speed, friction, mean = speed[piece], friction[piece], problem.measured.mean()
    if len(speed) < FEWEST or np.ptp(speed) <= 0.0:
        return ""
    trend = linregress(speed, friction)
    rise = float(trend.slope * np.ptp(speed))
    if rise < RISE * mean or not trend.pvalue < CHANCE:
        return ""
    words = "the constant law cannot change" if law.is_constant else "this law can only fall"
    return (
        f"Friction rises with speed ({100 * rise / mean:.0f} % of its mean from {speed[0]:.4g} to "
        f"{speed[-1]:.4g} m/s): {words}; {TABLE}."
    )


def out_of_reach(law: LawPoints, problem: FitProblem, scatter: Array, side: int) -> str:
    """Return a sentence if points lie above (side 1) or below (-1) all the law can give, or "".

    ``scatter`` is the standard deviation of ``friction``, (points,).
    """
    measured = problem.measured
    edge = law.friction(_corner(problem, side))
    beyond = side * (measured - edge) > np.maximum(SCATTERS * scatter, MATERIAL * measured.mean())
    if not beyond.any():
        return ""

    def reached(values: Mapping[str, float]) -> bool:
        gap = side * (measured - law.friction(values))
        return bool(np.all(gap <= 1e-12))

    count, total = int(np.count_nonzero(beyond)), len(beyond)
    these = "any of these points" if count == total else f"{count} of {total} points"
    limits = f"at least {edge[beyond].min():.4g}, measured are down to {measured.min():.4g}"
    if side > 0:
        limits = f"at most {edge.max():.4g}, measured are up to {measured.max():.4g}"
    stopped = _stopped(problem, side, law.speed[beyond])
    cures = _cures(problem, side, reached)
    return f"The law cannot reach {these} (it gives {limits}): {stopped}. {cures}"


def hidden_fall(law: LawPoints, problem: FitProblem, best: Array, first: Array) -> str:
    """Return a sentence if the fit hides a fall it is forced to have below the slowest point.

    Points that all lie below the lowest possible friction at rest, and would be in the law's fall
    by the values before the fit, can be met by a fall that is over before the first of them.
    """
    lowest = end_frictions(_corner(problem, -1))[0]
    highest, slowest = float(problem.measured.max()), float(law.speed.min())
    left = [_fall_left(problem.values(guess), slowest) for guess in (first, best)]
    if highest >= lowest * (1.0 - MATERIAL) or left[0] < SEEN or left[1] > HIDDEN:
        return ""
    at_rest, at_speed = end_frictions(problem.values(best))
    cures = _cures(problem, -1, lambda values: end_frictions(values)[0] <= highest)
    return (
        f"The fit puts the fall from {at_rest:.4g} at rest to {at_speed:.4g} below the slowest "
        f"point, {slowest:.4g} m/s, where nothing was measured (no point is above {highest:.4g}): "
        f"friction at rest cannot be below {lowest:.4g}, "
        f"{_stopped(problem, -1, np.zeros(1))}. {cures}"
    )


def _corner(problem: FitProblem, side: int) -> dict[str, float]:
    """Return the law's numbers for its most (1) or minimum (-1) friction within the ranges."""
    ends = zip(problem.names, problem.low.tolist(), problem.high.tolist(), strict=True)
    base: dict[str, float] = dict(problem.base)
    return base | {n: high if GROWS[n] * side > 0 else low for n, low, high in ends if n in GROWS}


def _fall_left(values: Mapping[str, float], speed: float) -> float:
    """Return the share of the law's fall that is still to come at a slip speed."""
    unit = {**values, "plough_weight": 0.0, "shear_floor": 0.0}
    return float(friction_over(unit, np.array([speed]))[0] / end_frictions(unit)[0])


def _stopped(problem: FitProblem, side: int, speed: Array) -> str:
    """Name the bounds without which the law would give more, or less, at slip speeds [m/s]."""
    corner, stopping = _corner(problem, side), []
    edge = friction_over(corner, speed)
    for name, width in zip(problem.names, problem.high - problem.low, strict=True):
        inside = corner[name] - 0.01 * width * GROWS[name] * side
        if np.any(friction_over({**corner, name: inside}, speed) != edge):
            which = "upper" if GROWS[name] * side > 0 else "lower"
            stopping.append(f"{name} is stopped by its {which} bound {corner[name]:g}")
    return " and ".join(stopping) or "none of the fitted constants acts on that"


def _cures(problem: FitProblem, side: int, reached: Reached) -> str:
    """Say which constants that are not fitted would help, and from which value on alone."""
    words, corner = [], _corner(problem, side)
    at_rest = end_frictions(corner)[0]
    for name in (name for name in GROWS if name not in problem.names):
        is_larger = GROWS[name] * side > 0
        at_bound = {**corner, name: float(LIMITS[name][is_larger])}
        if reached(at_bound):
            enough = f" ({_enough(corner, name, at_bound[name], reached)})"
        elif abs(end_frictions(at_bound)[0] / at_rest - 1.0) < MATERIAL:
            continue
        else:
            enough = ""
        words.append(f"a {'larger' if is_larger else 'smaller'} {name}{enough}")
    helps = f"What would help: {listed(words, 'or')}. " if words else ""
    return f"{helps}Or {TABLE}."


def _enough(corner: Mapping[str, float], name: str, bound: float, reached: Reached) -> str:
    """Return the value of one constant from which on it alone is enough."""
    short, far = corner[name], bound
    for _ in range(50):
        middle = 0.5 * (short + far)
        short, far = (short, middle) if reached({**corner, name: middle}) else (middle, far)
    step = 0.005 * abs(far)  # more than rounding to three digits takes away
    if bound > corner[name]:
        return f"{min(far + step, bound):.3g} or more"
    return f"{max(far - step, bound):.3g} or less"
