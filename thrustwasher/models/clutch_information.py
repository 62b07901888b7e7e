"""What measured points can tell about the constants of the friction law, and what they cannot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .clutch_fit import Problem

Array = NDArray[np.float64]

LOST = 1e-9  # a singular value this small beside the largest is rounding
VANISHES = 1e-4  # ... and so is one this much smaller beside the friction itself
LEAKS = 1e-6  # a larger share in a lost direction makes a constant unknown
NAMED = 0.05  # constants with a smaller share in a direction are not worth a word


@dataclass(frozen=True)
class Information:
    """Singular values of the misfit's slopes, in changes that matter over the scatter."""

    names: tuple[str, ...]
    scale: Array
    strength: Array
    """(constants,) one over the standard error of each direction, in scaled constants; 0: lost."""
    directions: Array
    """(constants, constants) one direction per row, scaled constants."""
    quantile: float
    """Half width of an interval in standard errors; infinite where no scatter can be judged."""
    rank: int
    freedom: int
    """Points less independent constants."""
    deviation: float
    """Standard deviation of one weighted point."""

    def covariance(self) -> Array:
        """Return the covariance of the constants without the directions that are lost."""
        inverse = np.divide(1.0, self.strength, out=np.zeros_like(self.strength),
                            where=self.strength > 0.0)  # fmt: skip
        half = self.directions * inverse[:, None] * self.scale
        return np.asarray(half.T @ half)

    def error_of(self, gradient: Array) -> float:
        """Return the standard error of a quantity from its gradient; infinite if not told."""
        along = self.directions @ (gradient * self.scale)
        size = float(np.abs(gradient * self.scale).max())
        told = self.strength > 0.0
        if np.any(np.abs(along[~told]) > LEAKS * size):
            return np.inf
        return float(np.sqrt(np.sum((along[told] / self.strength[told]) ** 2)))

    def blurred(self) -> list[Array]:
        """Return directions, in changes of the constants, that the points do not resolve."""
        wide = self.quantile > self.strength if np.isfinite(self.quantile) else self.strength <= 0.0
        return [direction * self.scale for direction in self.directions[wide]]


def information(
    problem: Problem, best: Array, confidence: float, known_errors: bool
) -> Information:
    """Return what the points tell, by linearising at the optimum.

    Parameters
    ----------
    problem, best : the fit
    confidence : probability of the intervals
    known_errors : the weights are one over known standard deviations; otherwise the scatter of
        the residuals gives them, and Student's distribution the quantile
    """
    from scipy.stats import norm, t

    slopes = problem.slopes(best) * problem.scale
    n, p = slopes.shape
    singular, directions = np.linalg.svd(slopes, full_matrices=True)[1:]
    size = float(np.linalg.norm(problem.friction * problem.weight))
    singular = np.concatenate([singular, np.zeros(p - len(singular))])
    singular[singular <= max(LOST * singular[0], LOST * VANISHES * size)] = 0.0
    rank = int(np.count_nonzero(singular))
    freedom = n - rank
    tail = 0.5 + 0.5 * confidence
    if known_errors:
        deviation, quantile = 1.0, float(norm.ppf(tail))
    elif freedom > 0:
        deviation, quantile = np.sqrt(problem.cost(best) / freedom), float(t.ppf(tail, freedom))
    else:
        deviation, quantile = 0.0, np.inf
    floor = 1e-16 * float(np.abs(problem.friction * problem.weight).max())
    strength = singular / max(float(deviation), floor, 1e-300)
    return Information(
        problem.names, problem.scale, strength, directions, quantile, rank, freedom,
        float(deviation),
    )  # fmt: skip


def combination(names: tuple[str, ...], direction: Array, scale: Array) -> str:
    """Say in one sentence which constants the points cannot tell apart."""
    share = np.abs(direction / scale)
    named = [i for i in np.argsort(-share) if share[i] > NAMED * share.max()]
    if len(named) == 1:
        return f"no point says enough about {names[named[0]]}"
    change = direction / direction[named[0]] * 0.01 * scale[named[0]]
    parts = [f"{names[i]} {change[i]:+.3g}" for i in named]
    return (
        f"the points cannot tell {_and([names[i] for i in named])} apart: changed together by "
        f"{_and(parts)} they move the friction at no point beyond its scatter"
    )


def members(names: tuple[str, ...], direction: Array, scale: Array) -> set[str]:
    """Return the constants that a direction is about."""
    share = np.abs(direction / scale)
    return {n for n, s in zip(names, share, strict=True) if s > NAMED * share.max()}


def _and(words: list[str]) -> str:
    return ", ".join(words[:-1]) + f" and {words[-1]}"
