"""What measured points can tell about the friction law: its constants, and whether load acts."""

from dataclasses import dataclass

import numpy as np

from ...numerics.jit import Array
from .friction_law import shares
from .least_squares import Problem

LOST = 1e-9  # a singular value this small beside the largest is rounding
VANISHES = 1e-4  # ... and so is one this much smaller beside the friction itself
LEAKS = 1e-6  # a larger share in a lost direction makes a constant unknown
NAMED = 0.05  # constants with a smaller share in a direction are not worth a word

SAME_LOAD = 1e-6  # relative spread of loads below which there is nothing to compare
FOLLOWS = 1e-4  # share of the load's spread that the law's constants must leave free


@dataclass(frozen=True)
class Information:
    """Singular values of the misfit's slopes, in changes that matter over the scatter."""

    scale: Array
    strength: Array
    """(constants,) one over the standard error of each direction, in scaled constants; 0: lost."""
    directions: Array  # (constants, constants) one direction per row, scaled constants
    quantile: float
    """Half width of an interval in standard errors; infinite where no scatter can be judged."""
    rank: int
    freedom: int  # points less independent constants
    deviation: float  # standard deviation of one weighted point

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

    def half_width_of(self, gradient: Array) -> float:
        """Return the half width of a quantity's interval; infinite if not told."""
        return self.error_of(gradient) * self.quantile if np.isfinite(self.quantile) else np.inf

    def blurred(self) -> list[Array]:
        """Return directions, in changes of the constants, that the points do not resolve."""
        wide = self.quantile > self.strength if np.isfinite(self.quantile) else self.strength <= 0.0
        return [direction * self.scale for direction in self.directions[wide]]


def information(problem: Problem, best: Array, confidence: float) -> Information:
    """Return what the points tell, by linearising at the optimum.

    Without known errors the scatter of the residuals gives the standard deviation of a point, and
    Student's distribution the quantile of the intervals' probability ``confidence``.
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
    if problem.known_errors:
        deviation, quantile = 1.0, float(norm.ppf(tail))
    elif freedom > 0:
        deviation, quantile = np.sqrt(problem.cost(best) / freedom), float(t.ppf(tail, freedom))
    else:
        deviation, quantile = 0.0, np.inf
    floor = 1e-16 * float(np.abs(problem.friction * problem.weight).max())
    strength = singular / max(float(deviation), floor, 1e-300)
    return Information(
        problem.scale, strength, directions, quantile, rank, freedom, float(deviation)
    )


def members(problem: Problem, direction: Array) -> list[int]:
    """Return the places of the constants that a direction is about, the largest share first."""
    share = np.abs(direction / problem.scale)
    return [int(i) for i in np.argsort(-share) if share[i] > NAMED * share.max()]


def combination(problem: Problem, direction: Array) -> str:
    """Say in one sentence which constants the points cannot tell apart."""
    named, names = members(problem, direction), problem.names
    if len(named) == 1:
        return f"no point says enough about {names[named[0]]}"
    change = direction / direction[named[0]] * 0.01 * problem.scale[named[0]]
    parts = [f"{names[i]} {change[i]:+.3g}" for i in named]
    return (
        f"the points cannot tell {listed([names[i] for i in named], 'and')} apart: changed "
        f"together by {listed(parts, 'and')} they move the friction at no point beyond its scatter"
    )


@dataclass(frozen=True, slots=True)
class LoadTest:
    """Whether the residuals follow the load, the law's constants allowed to give way."""

    change: float | None
    """[-] change of friction over the range of loads, relative to its mean; None: no test."""
    p_value: float | None
    """Probability of a change as large if friction did not depend on load."""
    text: str

    @property
    def is_significant(self) -> bool:
        """True if a test at the 1 % level finds a dependence on load."""
        return self.p_value is not None and self.p_value < 0.01


def load_test(problem: Problem, best: Array, told: Information) -> LoadTest:
    """Return the test of a term linear in load beside the law's own constants."""
    load = problem.load
    spread = float(np.ptp(load))
    if spread <= SAME_LOAD * float(load.max()):
        return LoadTest(None, None, "all points have one load: its influence cannot be tested")
    if told.freedom < 2:
        return LoadTest(None, None, "too few points to test the influence of load")
    column = (load - load.mean()) / spread * problem.weight
    basis = np.linalg.svd(problem.slopes(best) * problem.scale, full_matrices=False)[0]
    basis = basis[:, : told.rank]
    free = column - basis @ (basis.T @ column)
    if free @ free < FOLLOWS * (column @ column):
        text = "load changes only together with speed: its influence cannot be told from speed's"
        return LoadTest(None, None, text)
    return _tested(problem, best, free, told.freedom - 1)


def _tested(problem: Problem, best: Array, free: Array, freedom: int) -> LoadTest:
    """Return the size of the term and its significance."""
    from scipy.stats import norm, t

    misfit = -problem.misfit(best)
    slope = float(free @ misfit / (free @ free))
    left = max(problem.cost(best) - slope * slope * float(free @ free), 0.0)
    floor = 1e-13 * float(np.abs(problem.friction * problem.weight).max())
    deviation = max(1.0 if problem.known_errors else float(np.sqrt(left / freedom)), floor)
    score = abs(slope) * float(np.sqrt(free @ free)) / deviation
    p_value = 2.0 * float(norm.sf(score) if problem.known_errors else t.sf(score, freedom))
    change = slope / float(problem.friction.mean())
    where = f"from {problem.load.min():g} to {problem.load.max():g} N"
    if p_value < 0.01:
        text = (
            f"friction changes by {100 * change:+.2g} % {where}, more than scatter explains "
            f"(p = {p_value:.2g}); the law knows no load, fit narrower ranges of load one by one"
        )
    else:
        text = (
            f"no dependence on load beyond the scatter ({100 * change:+.2g} % {where}, "
            f"p = {p_value:.2g})"
        )
    return LoadTest(change, p_value, text)


@dataclass(frozen=True)
class Verdict:
    """One constant: told by the points or not, and the reason."""

    half_width: float  # of the linearised interval; infinite if nothing is known
    identifiable: bool
    at_bound: str  # "lower", "upper" or ""
    reason: str


def verdicts(
    problem: Problem, best: Array, told: Information, weak: Array | None = None
) -> list[Verdict]:
    """Return the verdict on every constant.

    A constant counts as identifiable where the half width of its interval is below a change that
    would certainly matter: 1 for weights and ratios, the fastest slip for speeds. Those marked in
    ``weak`` do not, whatever the slopes at this place say.
    """
    blurred = told.blurred()
    found = []
    for i in range(len(best)):
        half = told.half_width_of(np.eye(len(best))[i])
        known = bool(half <= problem.scale[i]) and not (weak is not None and weak[i])
        low, high = best[i] <= problem.low[i], best[i] >= problem.high[i]
        side = "lower" if low else "upper" if high else ""
        words = [] if known else [_why_not(problem, best, told, i, half, blurred)]
        if side:
            words.append(_bound_text(problem, best, i, side))
        found.append(Verdict(half, known, side, "; ".join(words)))
    return found


def _bound_text(problem: Problem, best: Array, i: int, side: str) -> str:
    """Say that a bound stops the fit, and what would free it."""
    text = f"at its {side} bound {best[i]:g}"
    gradient = problem.slopes(best)[:, i] @ problem.misfit(best) * problem.scale[i]
    if gradient * (1.0 if side == "lower" else -1.0) <= 1e-9 * problem.cost(best):
        return text
    text += ": the points pull beyond it"
    if problem.names[i] == "plough_weight" and side == "lower":
        adhesion = shares(problem.values(best))[1]
        text += (
            f" (friction at rest cannot be below the adhesive share alone, {adhesion:.4g}; "
            "a larger hardness_ratio lowers that)"
        )
    return text


def _why_not(
    problem: Problem, best: Array, told: Information, i: int, half: float, blurred: list[Array]
) -> str:
    """Return the reason why the points do not tell a constant, the most tangible one first."""
    name, speed = problem.names[i], problem.speed
    stick, fastest, slowest = problem.values(best)["stick_speed"], speed.max(), speed.min()
    few = f"{counted(len(speed), 'point')} for {counted(len(best), 'constant')}"
    if name in ("shear_floor", "decay_speed", "stick_speed") and fastest <= stick:
        return (
            f"all points lie below stick_speed ({stick:.4g} m/s; fastest slip {fastest:.4g} m/s), "
            "where friction does not change with speed"
        )
    lead = ""
    if len(speed) < len(best):
        lead = f"{few}; "
    elif fastest == slowest:
        lead = f"all points have one slip speed ({fastest:.4g} m/s); "
    elif name == "stick_speed" and slowest >= stick:
        lead = f"all points lie above it (slowest slip {slowest:.4g} m/s); "
    about = [direction for direction in blurred if i in members(problem, direction)]
    if about:
        return lead + combination(problem, about[0])
    if not np.isfinite(told.quantile):
        return f"{few}: no scatter is left to judge by, add points or give friction_error"
    return f"{lead}at this scatter its interval would be +- {half:.2g}"


def counted(number: int, noun: str) -> str:
    """Return "1 point" or "2 points"."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def listed(words: list[str], last: str) -> str:
    """Return "a, b and c" for the word "and"."""
    return f" {last} ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
