"""Weighted least squares within bounds: what is fitted to what, several starts, profiles."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import SolveError
from ...model.quantity import Quantity
from ...numerics.jit import Array

STEP = 1e-3  # of a constant's scale, for differences of converged solutions
MOST_KEPT = 200
AS_GOOD = 1e-4  # relative excess of the sum of squares of a start that is refined further
AT_BOUND = 1e-5  # of a constant's scale: nearer than this the bound itself is tried
SAME = 1e-3  # of a constant's scale: two starts that end as near count once
PRESSES = (
    1e-12  # fall of the misfit, next to the points' squares, that puts a constant on its bound
)
Values = Mapping[str, Any]


class Terms(NamedTuple):
    """What is fitted to what, in the words of sentences."""

    law: str = "model"
    subject: str = "outputs"
    counted_as: str = "value"
    error_name: str = "their error"
    instead: str = ""
    """What to take where the points cannot be followed."""
    fidelity: str = ""
    """Level that the outputs are solved with; none of a closed form."""


class Search(NamedTuple):
    """How far a search goes."""

    rough: float = 1e-5
    """Tolerance while starts compete."""
    fine: float = 1e-8
    """And of those that are as good."""
    evaluations: int = 80
    """Most of them in one search."""
    resolution: float = 1e-7
    """A singular value this small compared with the largest is rounding."""


MODEL, SEARCH = Terms(), Search()


@dataclass(frozen=True, kw_only=True)
class FitProblem:
    """Measured values, what computes them, and the constants that may be changed to meet them.

    A guess holds one number per constant: its value, or the logarithm of it.
    """

    computed: Callable[[Values], Array]
    """From all values by name to what was measured, (n,); NaN where there is none."""
    exact_slopes: Callable[[Values, Sequence[str]], Array | None]
    """From values and names to derivatives (n, names); None: by differences."""
    base: Values  # values that are held
    quantities: tuple[Quantity, ...]  # constants that are fitted, in their ranges
    measured: Array  # (n,)
    weight: Array  # (n,) one over the standard deviation, or what makes values comparable
    low: Array  # (constants,) ranges, of the guess
    high: Array
    scale: Array  # (constants,) a change of the guess that would certainly matter
    logarithmic: NDArray[np.bool_]  # (constants,) those whose guess is a logarithm
    known_errors: bool = False
    """The weights are one over known standard deviations; else the residuals' scatter counts."""
    terms: Terms = MODEL
    search: Search = SEARCH
    starts: Callable[["FitProblem", Array], list[Array]] = lambda problem, first: []
    """Further places to start from next to the values before the fit."""
    why_not: Callable[["FitProblem", Array, int], tuple[str, bool]] = lambda problem, best, i: (
        "",
        False,
    )
    """What is special about a constant that is not told, and whether it says it all."""
    why_bound: Callable[["FitProblem", Array, int, str], str] = lambda problem, best, i, side: ""
    """What would free a constant from its bound."""
    input_shifts: Callable[["FitProblem", Array], tuple[Array, Array] | None] = (
        lambda problem, guess: None
    )
    """Changes of the misfit by scatter of what it is computed from, (n, columns).

    Columns are independent, one standard deviation each. And those of the measured values by the
    same scatter, 0 where it is none of theirs. None where inputs count as exact."""
    correlation: Callable[["FitProblem", Array], float] = lambda problem, guess: 0.0
    """Correlation of neighbouring residuals; 0 where values are in no order."""
    ran: Callable[[], None] = lambda: None
    """Called after each evaluation of the curve or its exact slopes."""
    kept: dict[tuple[Any, ...], Array] = field(default_factory=dict, repr=False)

    @property
    def names(self) -> tuple[str, ...]:
        """The constants that are fitted."""
        return tuple(q.name for q in self.quantities)

    def curve(self, guess: Array) -> Array:
        """Return the computed values, (n,); NaN where there is none."""
        values = self.values(guess)
        key = tuple(sorted(values.items()))
        if key not in self.kept:
            if len(self.kept) > MOST_KEPT:
                self.kept.clear()
            self.kept[key] = self.computed(values)
            self.ran()
        return self.kept[key]

    def slopes_of_curve(self, guess: Array) -> Array:
        """Return the derivatives of the curve over the guess, (n, constants)."""
        exact = self.exact_slopes(self.values(guess), self.names)
        if exact is None:
            return self._differences(guess)
        self.ran()
        return exact * self.derivative(guess)

    def _differences(self, guess: Array) -> Array:
        """Return differences of solutions.

        Central ones; at a bound, or where one side has no solution, those of the other side.
        """
        here, columns = self.curve(guess), []
        for i, step in enumerate(STEP * self.scale):
            places, values = [], []
            for end in (max(guess[i] - step, self.low[i]), min(guess[i] + step, self.high[i])):
                there = self.curve(np.where(np.arange(len(guess)) == i, end, guess))
                values.append(np.where(np.isfinite(there), there, here))
                places.append(np.where(np.isfinite(there), end, guess[i]))
            width = places[1] - places[0]
            if not width.any():
                raise SolveError(
                    f"fit = {self.names[i]!r}: next to {self.shown(guess)[i]:g} no point has a "
                    f"solution with fidelity level {self.terms.fidelity!r}; choose another "
                    "fidelity level or start"
                )
            rise = np.where(width > 0.0, values[1] - values[0], 0.0)
            columns.append(rise / np.where(width > 0.0, width, 1.0))
        return np.column_stack(columns)

    def shown(self, guess: Array) -> Array:
        """Return the values that a guess stands for."""
        return np.where(self.logarithmic, np.exp(np.minimum(guess, 700.0)), guess)

    def derivative(self, guess: Array) -> Array:
        """Return the derivatives of the values over the guess."""
        return np.where(self.logarithmic, self.shown(guess), 1.0)

    def values(self, guess: Array) -> dict[str, Any]:
        """Return all values with the guess put in."""
        return {**self.base, **dict(zip(self.names, self.shown(guess).tolist(), strict=True))}

    def misfit(self, guess: Array) -> Array:
        """Return (computed - measured) x weight."""
        return (self.curve(guess) - self.measured) * self.weight

    def slopes(self, guess: Array) -> Array:
        """Return the derivatives of the misfit, (n, constants)."""
        return self.slopes_of_curve(guess) * self.weight[:, None]

    def cost(self, guess: Array) -> float:
        """Return the sum of squares of the misfit."""
        misfit = self.misfit(guess)
        return float(misfit @ misfit)

    def holding(self, i: int, place: float) -> "FitProblem":
        """Return the same problem with one constant fixed."""
        keep = np.arange(len(self.quantities)) != i
        values = np.where(keep, self.low, place)
        parts = {n: getattr(self, n)[keep] for n in ("low", "high", "scale", "logarithmic")}
        base = {**self.base, self.names[i]: float(self.shown(values)[i])}
        rest = self.quantities[:i] + self.quantities[i + 1 :]
        return replace(self, base=base, quantities=rest, **parts)


def best_fit(problem: FitProblem, first: Array, more: Sequence[Array] = ()) -> Array:
    """Return the constants with the minimum sum of squares that any start leads to.

    Starts are ``first``, those of the problem and ``more``. Where several fit equally well, the
    nearest to ``first``, the values before the fit, is taken; SolveError if no start converged.
    """
    starts = [first, *problem.starts(problem, first), *more]
    count = len(problem.measured)
    noise = (1e-13 * np.abs(problem.measured * problem.weight).max()) ** 2 * count
    rough = [
        f for f in (_refine(problem, s, problem.search.rough) for s in starts) if f is not None
    ]
    least = min((problem.cost(f) for f in rough), default=0.0)
    good: list[Array] = []
    for guess in rough:
        is_new = all(np.abs((guess - g) / problem.scale).max() > SAME for g in good)
        if is_new and problem.cost(guess) <= least * (1.0 + AS_GOOD) + 1e6 * noise:
            good.append(guess)
    fine = [
        _refine(problem, guess, problem.search.fine) for guess in good
    ]  # None: a valley too flat
    found = [
        _on_bounds(problem, g if f is None or problem.cost(f) > problem.cost(g) else f)
        for g, f in zip(good, fine, strict=True)
    ]
    if not found:
        raise SolveError(
            f"the {problem.terms.subject} could not be fitted from {len(starts)} starting "
            f"point{'s' * (len(starts) > 1)}; fit fewer constants or start nearer with "
            "--set NAME=VALUE"
        )
    costs = np.array([problem.cost(guess) for guess in found])
    equal = costs <= costs.min() * (1.0 + 1e-9) + noise
    near = [float(np.linalg.norm((guess - first) / problem.scale)) for guess in found]
    return found[int(np.argmin(np.where(equal, near, np.inf)))]


def settled(problem: FitProblem, best: Array, first: Array, weak: Array, deviation: float) -> Array:
    """Return the fit with its weak constants drawn to their first values.

    Constants that the points do not tell may end anywhere without fitting worse; next to the misfit
    their distance from the first values, in scales, counts like one point's standard deviation.
    """
    floor = 1e-6 * float(np.abs(problem.measured * problem.weight).max())
    pull = weak * max(deviation, floor) / problem.scale
    found = [_refine(problem, s, problem.search.fine, (pull, first)) for s in (best, first)]
    reached = [f for f in found if f is not None]
    pulled = [problem.cost(f) + float(np.sum((pull * (f - first)) ** 2)) for f in reached]
    if not reached:
        return best
    return _pressed(problem, _on_bounds_exactly(problem, reached[int(np.argmin(pulled))]))


def profile_end(problem: FitProblem, best: Array, index: int, end: float, more: float) -> float:
    """Return where one constant alone costs ``more``, the others refitted.

    ``end`` is a first guess of the place, on one side of ``best``. Where the sum of squares
    rises less up to the constant's bound, it is that bound.
    """
    from scipy.optimize import brentq

    centre, least, rest = best[index], problem.cost(best), np.delete(best, index)
    bound = problem.high[index] if end > centre else problem.low[index]

    def excess(place: float) -> float:
        held = problem.holding(index, place)
        found = _refine(held, rest, problem.search.rough) if held.names else rest
        rise = held.cost(rest if found is None else found) - least
        return float(np.sqrt(max(rise, 0.0) / more)) - 1.0

    near, place = centre, float(np.clip(end, problem.low[index], problem.high[index]))
    while excess(place) < 0.0:
        if place == bound:
            return float(bound)
        step = 2.0 * (place - centre)
        near, place = place, float(np.clip(centre + step, problem.low[index], problem.high[index]))
    width = 2.5e-3 * abs(end - centre)
    return float(brentq(excess, near, place, xtol=width))


def _refine(
    problem: FitProblem, start: Array, tolerance: float, pull: tuple[Array, Array] | None = None
) -> Array | None:
    """Return the local optimum next to a start, or None if it was not reached.

    With ``pull`` (weights, values) the differences from these values count as further points.
    """
    from scipy.optimize import least_squares

    def misfit(guess: Array) -> Array:
        own = problem.misfit(guess)
        return own if pull is None else np.concatenate([own, pull[0] * (guess - pull[1])])

    def slopes(guess: Array) -> Array:
        own = problem.slopes(guess)
        return own if pull is None else np.vstack([own, np.diag(pull[0])])

    begin = np.clip(start, problem.low, problem.high)
    if not np.isfinite(misfit(begin)).all():
        return None
    ends = (problem.low, problem.high)
    options: dict[str, Any] = {"ftol": tolerance, "xtol": tolerance, "gtol": tolerance}
    options |= {"x_scale": problem.scale, "max_nfev": problem.search.evaluations}
    found = least_squares(misfit, begin, jac=slopes, bounds=ends, **options)
    return np.asarray(found.x) if found.status > 0 and np.isfinite(found.cost) else None


def _on_bounds(problem: FitProblem, guess: Array) -> Array:
    """Return the guess with constants close to a bound put on it, where that fits no worse."""
    for i in range(len(problem.names)):
        for bound in (problem.low[i], problem.high[i]):
            if 0.0 < abs(guess[i] - bound) < AT_BOUND * problem.scale[i]:
                held = problem.holding(i, float(bound))
                others = np.delete(guess, i)
                rest = _refine(held, others, problem.search.fine) if held.names else others
                if rest is not None and held.cost(rest) <= problem.cost(guess) * (1.0 + 1e-12):
                    guess = np.insert(rest, i, bound)
    return _on_bounds_exactly(problem, guess)


def _pressed(problem: FitProblem, guess: Array) -> Array:
    """Return the guess with constants put on a bound that only the pull keeps them from."""
    gain = PRESSES * float(np.sum((problem.measured * problem.weight) ** 2))
    for i in range(len(guess)):
        for bound in (problem.low[i], problem.high[i]):
            on = guess.copy()
            on[i] = bound
            near = 0.0 < abs(guess[i] - bound) < SAME * problem.scale[i]
            if near and problem.cost(on) < problem.cost(guess) - gain:
                guess = on
    return guess


def _on_bounds_exactly(problem: FitProblem, guess: Array) -> Array:
    """Return the guess without the hair's breadth that the search keeps from its bounds."""
    hair = 1e-12 * problem.scale
    guess = np.where(guess - problem.low <= hair, problem.low, guess)
    return np.where(problem.high - guess <= hair, problem.high, guess)
