"""Least squares for the clutch's friction law: several starts, bounds, profiles of one constant."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from itertools import product
from typing import Any

import numpy as np

from ...errors import SolveError
from ...numerics.jit import Array
from ..parameters import ClutchParams
from .friction_law import friction_over, friction_slopes

N_STICK, N_DECAY, N_OTHER = 10, 7, 3  # values of each constant that the coarse search tries
N_STARTS = 4  # best of them, refined
MAX_EVALUATIONS = 250
ROUGH, FINE = 1e-7, 1e-14  # tolerances while starts compete, and for those that are as good
AS_GOOD = 1e-4  # relative excess of the sum of squares of a start that is refined further
AT_BOUND = 1e-5  # of a constant's scale: nearer than this the bound itself is tried
SAME = 1e-3  # of a constant's scale: two starts that end as near count once
PRESSES = 1e-12  # fall of the misfit, beside the points' squares, that puts a constant on its bound
PROFILE_STEPS = 8
_LINEAR = ("plough_weight", "shear_floor")


@dataclass(frozen=True)
class Problem:
    """Measured points and what may be changed to meet them."""

    base: Mapping[str, float]  # every number of the law; those in ``names`` are replaced
    names: tuple[str, ...]
    speed: Array  # (points,) slip speed [m/s], not negative
    friction: Array
    load: Array  # [N]; the law does not know it
    weight: Array  # (points,) one over the standard deviation, or 1
    low: Array
    high: Array
    scale: Array  # (constants,) a change that would certainly matter
    is_constant: bool = False  # the constant law instead of Wang, Wei & Wu's
    known_errors: bool = False
    """The weights are one over known standard deviations; else the residuals' scatter counts."""

    def values(self, guess: Array) -> dict[str, float]:
        """Return the law's numbers with the guess put in."""
        return {**self.base, **dict(zip(self.names, map(float, guess), strict=True))}

    def curve(self, guess: Array, speed: Array | None = None) -> Array:
        """Return the coefficients [-] at the measured or other slip speeds."""
        at = self.speed if speed is None else speed
        return friction_over(self.values(guess), at, self.is_constant)

    def misfit(self, guess: Array) -> Array:
        """Return (computed - measured) x weight."""
        return (self.curve(guess) - self.friction) * self.weight

    def slopes(self, guess: Array) -> Array:
        """Return the derivatives of the misfit, (points, constants)."""
        columns = friction_slopes(self.values(guess), self.speed, self.names)
        return columns * self.weight[:, None]

    def cost(self, guess: Array) -> float:
        """Return the sum of squares of the misfit."""
        misfit = self.misfit(guess)
        return float(misfit @ misfit)

    def holding(self, name: str, value: float) -> "Problem":
        """Return the same problem with one constant fixed."""
        keep = np.array([n != name for n in self.names])
        return replace(
            self, base={**self.base, name: value},
            names=tuple(n for n in self.names if n != name),
            low=self.low[keep], high=self.high[keep], scale=self.scale[keep],
        )  # fmt: skip


def bounds_of(names: tuple[str, ...]) -> tuple[Array, Array]:
    """Return the least and the largest value that ClutchParams allows."""
    meta = {f.name: f.metadata for f in fields(ClutchParams)}
    limits = np.array([(meta[n]["min"], meta[n]["max"]) for n in names], float)
    return limits[:, 0], limits[:, 1]


def best_fit(problem: Problem, first: Array) -> Array:
    """Return the constants with the least sum of squares that any start leads to.

    Where several fit equally well, the nearest to ``first``, the values before the fit, is taken;
    SolveError if no start converged.
    """
    starts = [first, *_coarse(problem, first)]
    noise = (1e-13 * np.abs(problem.friction * problem.weight).max()) ** 2 * len(problem.speed)
    rough = [f for f in (_refine(problem, s, ROUGH) for s in starts) if f is not None]
    least = min((problem.cost(f) for f in rough), default=0.0)
    good: list[Array] = []
    for guess in rough:
        is_new = all(np.abs((guess - g) / problem.scale).max() > SAME for g in good)
        if is_new and problem.cost(guess) <= least * (1.0 + AS_GOOD) + 1e6 * noise:
            good.append(guess)
    fine = [_refine(problem, guess) for guess in good]  # a valley may be too flat for it
    found = [
        _on_bounds(problem, g if f is None or problem.cost(f) > problem.cost(g) else f)
        for g, f in zip(good, fine, strict=True)
    ]
    if not found:
        raise SolveError(
            f"the friction law could not be fitted from {len(starts)} starting points; fit fewer "
            "constants or start nearer with --set NAME=VALUE"
        )
    costs = np.array([problem.cost(guess) for guess in found])
    equal = costs <= costs.min() * (1.0 + 1e-9) + noise
    near = [float(np.linalg.norm((guess - first) / problem.scale)) for guess in found]
    return found[int(np.argmin(np.where(equal, near, np.inf)))]


def settled(problem: Problem, best: Array, first: Array, weak: Array, deviation: float) -> Array:
    """Return the fit with its weak constants drawn to their first values.

    Constants that the points do not tell may end anywhere without fitting worse; beside the misfit
    their distance from the first values, in scales, counts like one point's standard deviation.
    """
    floor = 1e-6 * float(np.abs(problem.friction * problem.weight).max())
    pull = weak * max(deviation, floor) / problem.scale
    found = [_refine(problem, start, FINE, pull, first) for start in (best, first)]
    reached = [f for f in found if f is not None]
    pulled = [problem.cost(f) + float(np.sum((pull * (f - first)) ** 2)) for f in reached]
    if not reached:
        return best
    return _pressed(problem, _on_bounds_exactly(problem, reached[int(np.argmin(pulled))]))


def profile_end(problem: Problem, best: Array, index: int, end: float, wanted: float) -> float:
    """Return where one constant alone costs ``wanted`` more, the others refitted.

    ``end`` is a first guess of the place, on the wanted side of ``best``. Where the sum of squares
    rises less up to the constant's bound, it is that bound.
    """
    centre, least = best[index], problem.cost(best)
    bound = problem.high[index] if end > centre else problem.low[index]
    rest = np.delete(best, index)
    inside, outside, depth = 0.0, np.inf, 0.0  # distances from the centre, rise at ``inside``
    step = min(abs(end - centre), abs(bound - centre))
    for _ in range(PROFILE_STEPS):
        place = centre + np.copysign(step, end - centre)
        held = problem.holding(problem.names[index], float(place))
        rest_here = rest if not held.names else _refine(held, rest, ROUGH)
        rise = held.cost(rest if rest_here is None else rest_here) - least
        depth = max(rise, 0.0)
        ratio = np.sqrt(wanted / depth) if depth > 0.0 else 4.0
        if abs(ratio - 1.0) < 5e-3:
            return float(place)
        if depth < wanted:
            inside = step
            if step >= abs(bound - centre):
                return float(bound)
        else:
            outside = step
        step = min(step * min(ratio, 4.0), abs(bound - centre))
        if not inside < step < outside and np.isfinite(outside):
            step = 0.5 * (inside + outside)
    return float(centre + np.copysign(step, end - centre))


def _coarse(problem: Problem, first: Array) -> list[Array]:
    """Return the best points of a coarse search; the two weights follow by linear fits."""
    names = problem.names
    if problem.is_constant:
        return []
    grids = [_candidates(problem, i, float(first[i])) for i in range(len(names))]
    linear = [i for i, name in enumerate(names) if name in _LINEAR]
    tried = []
    for point in product(*grids):
        guess = np.array(point)
        if linear:
            columns = problem.slopes(guess)[:, linear]
            step = np.linalg.lstsq(columns, -problem.misfit(guess), rcond=1e-10)[0]
            guess[linear] += step
        guess = np.clip(guess, problem.low, problem.high)
        tried.append((problem.cost(guess), tuple(guess)))
    return [np.array(point) for _, point in sorted(tried)[:N_STARTS]]


def _candidates(problem: Problem, index: int, first: float) -> list[float]:
    """Return the values of one constant that the coarse search tries."""
    name, low, high = problem.names[index], problem.low[index], problem.high[index]
    speeds = np.unique(problem.speed)
    if name in _LINEAR:
        return [0.5]
    if name == "stick_speed":  # between neighbouring speeds the sum of squares is smooth
        middles = 0.5 * (speeds[1:] + speeds[:-1])
        picked = np.quantile(middles, np.linspace(0.0, 1.0, N_STICK)) if len(middles) else speeds
        values: Any = [first, *picked]
    elif name == "decay_speed":
        values = np.geomspace(0.03, 3.0, N_DECAY) * max(float(speeds[-1]), 1e-3)
    elif name == "indentation":
        values = [first, 0.03, 0.3]
    else:
        values = [first, *np.geomspace(max(low, 2.0), high, N_OTHER)]
    return [float(v) for v in np.unique(np.clip(values, low, high))]


def _refine(
    problem: Problem,
    start: Array,
    tolerance: float = FINE,
    pull: Array | None = None,
    anchor: Array | float = 0.0,
) -> Array | None:
    """Return the local optimum beside a start, or None if it was not reached.

    With ``pull`` the differences from ``anchor``, weighted by it, count as further points.
    """
    from scipy.optimize import least_squares

    def misfit(guess: Array) -> Array:
        own = problem.misfit(guess)
        return own if pull is None else np.concatenate([own, pull * (guess - anchor)])

    def slopes(guess: Array) -> Array:
        own = problem.slopes(guess)
        return own if pull is None else np.vstack([own, np.diag(pull)])

    found = least_squares(
        misfit, np.clip(start, problem.low, problem.high), jac=slopes,
        bounds=(problem.low, problem.high), x_scale=problem.scale, max_nfev=MAX_EVALUATIONS,
        ftol=tolerance, xtol=tolerance, gtol=tolerance,
    )  # fmt: skip
    return np.asarray(found.x) if found.status > 0 and np.isfinite(found.cost) else None


def _on_bounds(problem: Problem, guess: Array) -> Array:
    """Return the guess with constants close to a bound put on it, where that fits no worse."""
    for i, name in enumerate(problem.names):
        for bound in (problem.low[i], problem.high[i]):
            if 0.0 < abs(guess[i] - bound) < AT_BOUND * problem.scale[i]:
                held = problem.holding(name, float(bound))
                rest = _refine(held, np.delete(guess, i)) if held.names else np.zeros(0)
                if rest is not None and held.cost(rest) <= problem.cost(guess) * (1.0 + 1e-12):
                    guess = np.insert(rest, i, bound)
    return _on_bounds_exactly(problem, guess)


def _pressed(problem: Problem, guess: Array) -> Array:
    """Return the guess with constants put on a bound that only the pull keeps them from."""
    gain = PRESSES * float(np.sum((problem.friction * problem.weight) ** 2))
    for i in range(len(guess)):
        for bound in (problem.low[i], problem.high[i]):
            on = guess.copy()
            on[i] = bound
            near = 0.0 < abs(guess[i] - bound) < SAME * problem.scale[i]
            if near and problem.cost(on) < problem.cost(guess) - gain:
                guess = on
    return guess


def _on_bounds_exactly(problem: Problem, guess: Array) -> Array:
    """Return the guess without the hair's breadth that the search keeps from its bounds."""
    hair = 1e-12 * problem.scale
    guess = np.where(guess - problem.low <= hair, problem.low, guess)
    return np.where(problem.high - guess <= hair, problem.high, guess)
