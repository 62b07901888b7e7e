"""Warnings of a calibration: points that the friction law cannot follow, in plain sentences."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .clutch_fit import Problem
from .clutch_reach import MATERIAL, SCATTERS, TABLE, hidden_fall, out_of_reach
from .clutch_verdicts import Verdict

Array = NDArray[np.float64]

POOR = 0.2  # of the mean friction: an rms residual above it is always worth a warning
RISE = 0.05  # of the mean friction: a smaller rise with speed is not worth one
CHANCE = 1e-4  # probability below which a rise is not the scatter's; the place is searched for
FEWEST = 4  # points that can show a rise


def warnings(
    problem: Problem, best: Array, first: Array, judged: list[Verdict], known_errors: bool
) -> tuple[str, ...]:
    """Return what is wrong with the fit as a whole, the gravest first; each "headline: details".

    Parameters
    ----------
    problem, best : the fit
    first : (constants,) the values before it
    judged : the verdict on every constant
    known_errors : the weights are one over known standard deviations
    """
    scatter = 1.0 / problem.weight if known_errors else _scatter(problem)
    found = [_rising(problem)]
    if not problem.is_constant:
        found = [out_of_reach(problem, scatter, side) for side in (1, -1)] + found
    if not any(found):
        found.append(_missed(problem, best, judged, scatter))
        if not problem.is_constant:
            found.append(hidden_fall(problem, best, first))
    found.append(_poor(problem, best, alone=not any(found)))
    return tuple(text for text in found if text)


def _scatter(problem: Problem) -> Array:
    """Return the standard deviation of a point beside its neighbours in speed, (points,)."""
    sorted_friction = problem.friction[np.argsort(problem.speed, kind="stable")]
    bends = np.diff(sorted_friction, 2)
    size = float(np.sqrt(np.mean(bends**2) / 6.0)) if len(bends) else 0.0
    return np.full(len(sorted_friction), size)


def _rising(problem: Problem) -> str:
    """Return a sentence if friction rises with speed in some range, clearly.

    The best curve that only falls is flat where the points rise; the flat piece that misses them
    most is searched for a trend.
    """
    from scipy.optimize import isotonic_regression
    from scipy.stats import linregress

    order = np.lexsort((-problem.friction, problem.speed))  # one speed's points are no rise
    speed, friction = problem.speed[order], problem.friction[order]
    falling = isotonic_regression(friction, weights=problem.weight[order] ** 2, increasing=False)
    cost = (problem.weight[order] * (friction - falling.x)) ** 2
    piece = slice(*_worst(cost, falling.blocks))
    speed, friction, mean = speed[piece], friction[piece], problem.friction.mean()
    if len(speed) < FEWEST or np.ptp(speed) <= 0.0:
        return ""
    trend = linregress(speed, friction)
    rise = float(trend.slope * np.ptp(speed))
    if rise < RISE * mean or not trend.pvalue < CHANCE:
        return ""
    law = "the constant law cannot change" if problem.is_constant else "this law can only fall"
    return (
        f"Friction rises with speed ({100 * rise / mean:.0f} % of its mean from {speed[0]:.4g} to "
        f"{speed[-1]:.4g} m/s): {law}; {TABLE}"
    )


def _worst(cost: Array, blocks: NDArray[np.int64]) -> tuple[int, int]:
    """Return begin and end of the block with the largest sum."""
    sums = np.add.reduceat(cost, blocks[:-1])
    k = int(np.argmax(sums))
    return int(blocks[k]), int(blocks[k + 1])


def _missed(problem: Problem, best: Array, judged: list[Verdict], scatter: Array) -> str:
    """Return a sentence if the law misses the points by more than they scatter."""
    residuals = problem.curve(best) - problem.friction
    rms, mean = float(np.sqrt(np.mean(residuals**2))), float(problem.friction.mean())
    usual = float(np.sqrt(np.mean(scatter**2)))
    if rms <= max(SCATTERS * usual, MATERIAL * mean):
        return ""
    stops = [
        f"{name} is at its {verdict.reason.rpartition('at its ')[2]}"
        for name, verdict in zip(problem.names, judged, strict=True)
        if "pull beyond" in verdict.reason
    ]
    why = "; ".join(stops) or "its curve has another shape than theirs"
    if problem.is_constant:
        why = 'friction changes with speed, take friction_law = "wang"'
    return (
        f"The law misses the points by more than they scatter (rms residual {rms:.3g}, "
        f"{100 * rms / mean:.0f} % of the mean friction; scatter about {usual:.2g}): {why}; or "
        + TABLE
    )


def _poor(problem: Problem, best: Array, alone: bool) -> str:
    """Return a sentence if the residuals are a large part of the friction itself."""
    rms = float(np.sqrt(np.mean((problem.curve(best) - problem.friction) ** 2)))
    share = rms / float(problem.friction.mean())
    if share <= POOR:
        return ""
    return (
        f"The rms residual is {100 * share:.0f} % of the mean friction: values and intervals "
        "describe the nearest curve of this law, not the clutch"
        + (f"; if the points do not just scatter, {TABLE}" if alone else ".")
    )
