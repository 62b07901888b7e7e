"""What measured points can tell about the constants of a fit."""

from dataclasses import dataclass

import numpy as np

from ...numerics.jit import Array
from .least_squares import FitProblem

VANISHES = (
    1e-4  # a singular value is rounding too if as much smaller compared with the measured values
)
LEAKS = 1e-6  # a larger share in a lost direction makes a constant unknown
TOGETHER = 0.3  # correlation of neighbouring residuals from which widths are wider by it,
MOST_TOGETHER = 0.98  # and at most by this one
NAMED = 0.05  # constants with a smaller share in a direction are not worth a word


@dataclass(frozen=True)
class Information:
    """Singular values of the misfit's slopes, in changes that matter over the scatter."""

    scale: Array
    strength: Array
    """(constants,) one over the standard error of each direction, in scaled constants; 0: lost."""
    directions: Array  # (constants, constants) one direction per row, scaled constants
    quantile: float
    """Half width of an interval in standard errors; infinite where no scatter can be judged."""
    freedom: int  # points less independent constants
    deviation: float  # standard deviation of one weighted point
    correlation: float = 0.0
    """Of neighbouring residuals, where it is high enough to count: widths are wider by it."""

    @property
    def rank(self) -> int:
        """Number of directions that are not lost."""
        return int(np.count_nonzero(self.strength))

    @property
    def widened(self) -> float:
        """Factor of all widths by the correlation of neighbouring residuals, 1 or more."""
        return widening(self.correlation)

    def correlations(self) -> Array:
        """Return the correlation of the constants that are told, NaN for the others."""
        kept = self.strength > 0.0
        half = self.directions[kept] / self.strength[kept, None] * self.scale
        covariance = half.T @ half
        width = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
        known = [np.isfinite(self.error_of(row)) for row in np.eye(len(width))]
        return np.where(np.outer(known, known), covariance / np.outer(width, width), np.nan)

    def error_of(self, gradient: Array) -> float:
        """Return the standard error of a quantity from its gradient; infinite if not told."""
        along = self.directions @ (gradient * self.scale)
        size = float(np.abs(gradient * self.scale).max())
        kept = self.strength > 0.0
        if np.any(np.abs(along[~kept]) > LEAKS * size):
            return np.inf
        return float(np.sqrt(np.sum((along[kept] / self.strength[kept]) ** 2)))

    def half_width_of(self, gradient: Array) -> float:
        """Return the half width of a quantity's interval; infinite if not told."""
        return self.error_of(gradient) * self.quantile if np.isfinite(self.quantile) else np.inf

    def blurred(self) -> list[Array]:
        """Return directions, in changes of the constants, that the points do not resolve."""
        wide = self.quantile > self.strength if np.isfinite(self.quantile) else self.strength <= 0.0
        return [direction * self.scale for direction in self.directions[wide]]


def information(problem: FitProblem, best: Array, confidence: float) -> Information:
    """Return what the points tell, by linearising at the optimum.

    Without known errors the scatter of the residuals gives the standard deviation of a point, and
    Student's distribution the quantile of the intervals' probability ``confidence``.
    """
    from scipy.stats import norm, t

    slopes = problem.slopes(best) * problem.scale
    n, p = slopes.shape
    left, singular, directions = np.linalg.svd(slopes, full_matrices=n < p)
    weighted = problem.measured * problem.weight
    singular = np.concatenate([singular, np.zeros(p - len(singular))])
    size = VANISHES * float(np.linalg.norm(weighted))
    singular[singular <= problem.search.resolution * max(singular[0], size)] = 0.0
    freedom, tail = n - int(np.count_nonzero(singular)), 0.5 + 0.5 * confidence
    deviation, quantile = 0.0, np.inf
    if problem.known_errors:
        deviation, quantile = 1.0, float(norm.ppf(tail))
    elif freedom > 0:
        deviation = float(np.sqrt(problem.cost(best) / freedom))
        quantile = float(t.ppf(tail, freedom))
    found = problem.correlation(problem, best)
    together = min(found, MOST_TOGETHER) if found > TOGETHER else 0.0
    least = max(deviation, 1e-16 * float(np.abs(weighted).max()), 1e-300)
    strength = singular / (least * widening(together))
    shifts = problem.input_shifts(problem, best) if n >= p and strength.all() else None
    if shifts is not None:
        moved, known = (
            directions.T @ ((left[:, :p].T @ part) / singular[:, None]) for part in shifts
        )
        strength, directions = _widened(strength, directions, moved, known)
    parts = (problem.scale, strength, directions, quantile, freedom, deviation, together)
    return Information(*parts)


def widening(correlation: float) -> float:
    """Return the factor of widths where neighbouring residuals have this correlation.

    Source: mean of an autoregressive process of first order, n (1 - r) / (1 + r) of whose n values
    count.
    """
    return float(np.sqrt((1.0 + correlation) / (1.0 - correlation)))


def _widened(strength: Array, directions: Array, moved: Array, known: Array) -> tuple[Array, Array]:
    """Return strength and directions with a further covariance of the scaled constants.

    ``moved`` : (constants, columns) what the scatter of inputs does to the scaled constants.
    ``known`` : the same, by the scatter of measured values in each column, which counts already.
    """
    half = directions.T / strength
    both = moved + known
    covariance = half @ half.T + both @ both.T - known @ known.T
    if not np.isfinite(covariance).all():
        return strength, directions
    variance, axes = np.linalg.eigh(covariance)
    variance = np.maximum(variance, 1.0 / strength.max() ** 2)
    return 1.0 / np.sqrt(variance), axes.T


def members(problem: FitProblem, direction: Array) -> list[int]:
    """Return the places of the constants that a direction is about, the largest share first."""
    share = np.abs(direction / problem.scale)
    return [int(i) for i in np.argsort(-share) if share[i] > NAMED * share.max()]


def combination(problem: FitProblem, best: Array, direction: Array) -> str:
    """Say in one sentence which constants the points cannot tell apart."""
    named, names = members(problem, direction), problem.names
    if len(named) == 1:
        return f"no {problem.terms.counted_as} says enough about {names[named[0]]}"
    change = direction / direction[named[0]] * 0.01 * problem.scale[named[0]]
    change = change * problem.derivative(best)
    parts = listed([f"{names[i]} {change[i]:+.3g}" for i in named], "and")
    return (
        f"the points cannot tell {listed([names[i] for i in named], 'and')} apart: changed "
        f"together by {parts} they move the {problem.terms.subject} at no point beyond its scatter"
    )


@dataclass(frozen=True)
class Verdict:
    """One constant: told by the points or not, and the reason."""

    half_width: float  # of the linearised interval; infinite if nothing is known
    identifiable: bool
    at_bound: str  # "lower", "upper" or ""
    reason: str


def verdicts(problem: FitProblem, best: Array, learned: Information, weak: Array) -> list[Verdict]:
    """Return the verdict on every constant.

    A constant counts as identifiable where the half width of its interval is below a change that
    would certainly matter (``scale`` of the problem). Those marked in ``weak`` do not, whatever the
    slopes at this place say.
    """
    found = []
    for i, row in enumerate(np.eye(len(best))):
        half = learned.half_width_of(row)
        known = bool(half <= problem.scale[i]) and not weak[i]
        low, high = best[i] <= problem.low[i], best[i] >= problem.high[i]
        side = "lower" if low else "upper" if high else ""
        words = [] if known else [_why_not(problem, best, learned, i, half)]
        if side:
            words.append(_bound_text(problem, best, i, side))
        found.append(Verdict(half, known, side, "; ".join(words)))
    return found


def _bound_text(problem: FitProblem, best: Array, i: int, side: str) -> str:
    """Say that a bound stops the fit, and what would free it."""
    text = f"at its {side} bound {problem.shown(best)[i]:g}"
    gradient = problem.slopes(best)[:, i] @ problem.misfit(best) * problem.scale[i]
    if gradient * (1.0 if side == "lower" else -1.0) <= 1e-9 * problem.cost(best):
        return text
    return f"{text}: the points pull beyond it{problem.why_bound(problem, best, i, side)}"


def _why_not(problem: FitProblem, best: Array, learned: Information, i: int, half: float) -> str:
    """Return the reason why the points do not tell a constant, the most tangible one first."""
    count = len(problem.measured)
    few = f"{counted(count, problem.terms.counted_as)} for {counted(len(best), 'constant')}"
    lead, is_all = problem.why_not(problem, best, i)
    if is_all:
        return lead
    lead = few if count < len(best) else lead
    lead += "; " * bool(lead)
    about = [direction for direction in learned.blurred() if i in members(problem, direction)]
    if about:
        return lead + combination(problem, best, about[0])
    if not np.isfinite(learned.quantile):
        errors = problem.terms.error_name
        return f"{few}: no scatter is left to evaluate by, add points or give {errors}"
    width = f"a factor of {np.exp(half):.2g}" if problem.logarithmic[i] else f"{half:.2g}"
    return f"{lead}at this scatter its interval would be +- {width}"


def counted(number: int, noun: str) -> str:
    """Return "1 point" or "2 points"."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def listed(words: list[str], last: str) -> str:
    """Return "a, b and c" for the word "and"."""
    return f" {last} ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
