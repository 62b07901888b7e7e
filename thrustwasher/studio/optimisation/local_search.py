"""One search from one start: SLSQP where slopes are exact, COBYQA where there are none.

Sources: Kraft 1988 (SLSQP); Ragonneau & Zhang 2023 (COBYQA); both as in SciPy.
"""

import warnings
from dataclasses import dataclass
from typing import Any, TypedDict

import numpy as np

from ..evaluators.evaluator import Effort
from .design_problem import Problem
from .designs import Array, Designs
from .under_scatter import UnderScatter, Uniforms, judged_by

BAD = 10.0  # cost, in scales of its figure, of a design without figures; its limits are 1 beyond
SAFE = 1e-4  # of a limit's value, to the inside: a design shown is solved again
FINEST = 1e-4  # of the box, where COBYQA ends
EXACT = 1e-9  # change of the cost at which SLSQP ends
VIOLATION = -1  # aim: to meet the limits


class Ways(TypedDict, total=False):
    """How one local search differs from another: see `LocalSearch`."""

    levels: tuple[tuple[int, float], ...]
    tries: int
    whole: bool


@dataclass(frozen=True, kw_only=True)
class LocalSearch:
    """From where to search for what."""

    start: tuple[float, ...]
    aim: int
    """Place of the goal, or ``VIOLATION``."""
    levels: tuple[tuple[int, float], ...] = ()
    """Goals whose cost must not exceed a value."""
    margins: tuple[float, ...]
    """What the limits are tightened by (limits,)."""
    uniforms: Uniforms = ()
    """Draws of the scatter whose worst counts."""
    scales: tuple[float, ...]
    """Sizes of the figures (m,)."""
    radius: float
    """How far the first steps go, of the box."""
    tries: int
    whole: bool = False

    def width(self, problem: Problem) -> int:
        """Return how many numbers each design that is tried gives."""
        return len(problem.variables) + len(problem.figures)

    def run(self, designs: Designs, problem: Problem) -> Array:
        """Return all designs that were tried (n, k + m): places in the cube, figures."""
        from scipy.optimize import Bounds, NonlinearConstraint, minimize

        search = _Tried(judged_by(designs, problem, self.uniforms), problem, self)
        k = len(self.start)
        start = np.array(self.start)
        box = Bounds(np.zeros(k), np.ones(k))
        limited = self.aim != VIOLATION and search.n_constraints > 0
        more: dict[str, Any] = {}
        if search.at(start).slopes is not None:
            if limited:
                slopes = {"fun": lambda u: -search.at(u).beyond, "jac": search.inside_slopes}
                more = {"constraints": {"type": "ineq", **slopes}}
            more |= {"method": "SLSQP", "jac": search.cost_slopes}
            more |= {"options": {"maxiter": self.tries, "ftol": EXACT}}
        else:
            if limited:
                beyond = NonlinearConstraint(lambda u: search.at(u).beyond, -np.inf, 0.0)
                more = {"constraints": beyond}
            first = max(self.radius, 2.0 * FINEST)
            steps = {"initial_tr_radius": first, "final_tr_radius": FINEST}
            more |= {"method": "COBYQA", "options": {"maxfev": self.tries, **steps}}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                minimize(search.cost, start, bounds=box, **more)
            except _EnoughError:
                pass
        return np.array(search.rows)


class _EnoughError(Exception):
    """As many designs were tried as allowed."""


@dataclass(frozen=True)
class _Judged:
    cost: float
    beyond: Array  # (constraints,), below 0 inside
    slopes: tuple[Array, Array] | None  # of cost (k,) and of beyond (constraints, k)


class _Tried:
    """The designs of one search, each judged once."""

    def __init__(
        self, designs: Designs | UnderScatter, problem: Problem, search: LocalSearch
    ) -> None:
        self.designs, self.problem, self.search = designs, problem, search
        self.rows: list[Array] = []
        self._known: dict[bytes, _Judged] = {}
        scales = np.array(search.scales)
        self._goal_scales = np.abs(problem.costs(scales[np.newaxis])[0])
        columns = [problem.figures.index(x.figure.name) for x in problem.limits]
        self._limit_scales = scales[columns]
        bounds = np.array([x.bound for x in problem.limits])
        self._margins = np.array(search.margins) + SAFE * np.abs(bounds)
        self.n_constraints = len(problem.limits) + len(search.levels)

    def cost(self, u: Array) -> float:
        return self.at(u).cost

    def cost_slopes(self, u: Array) -> Array:
        slopes = self.at(u).slopes
        return np.zeros(len(u)) if slopes is None else slopes[0]

    def inside_slopes(self, u: Array) -> Array:
        slopes = self.at(u).slopes
        return np.zeros((self.n_constraints, len(u))) if slopes is None else -slopes[1]

    def at(self, u: Array) -> _Judged:
        """Return what a design is worth."""
        u = np.clip(u, 0.0, 1.0)
        key = u.tobytes()
        if key not in self._known:
            if len(self.rows) >= self.search.tries:
                raise _EnoughError
            self._known[key] = self._judge(u)
        return self._known[key]

    def _judge(self, u: Array) -> _Judged:
        problem, search = self.problem, self.search
        row, figures = problem.row(u), problem.figures
        effort: Effort = "shown" if search.whole else "search"
        found = self.designs.gradient(row, figures, problem.names, effort)
        if found is None:
            values, slopes = self.designs.evaluate([row], figures, effort).values[0], None
        else:
            values, slopes = found.values, found.slopes * problem.spans
        self.rows.append(np.concatenate((u, values)))
        if not np.isfinite(values).all() or (slopes is not None and not np.isfinite(slopes).all()):
            k = len(u)
            none = np.zeros(k), np.zeros((self.n_constraints, k))
            return _Judged(BAD, np.ones(self.n_constraints), None if slopes is None else none)
        return self._scaled(values, slopes)

    def _scaled(self, values: Array, slopes: Array | None) -> _Judged:
        problem, search = self.problem, self.search
        costs = problem.costs(values[np.newaxis])[0] / self._goal_scales
        excess = (problem.excess(values[np.newaxis])[0] + self._margins) / self._limit_scales
        levels = [costs[g] - top / self._goal_scales[g] for g, top in search.levels]
        beyond = np.concatenate((excess, levels))
        by_u = None
        if slopes is not None:
            of_costs = problem.costs(slopes.T).T / self._goal_scales[:, np.newaxis]
            columns = [problem.figures.index(x.figure.name) for x in problem.limits]
            of_limits = slopes[columns] * (problem.sides / self._limit_scales)[:, np.newaxis]
            of_beyond = np.vstack((of_limits, *(of_costs[g] for g, _ in search.levels)))
            by_u = of_costs[max(search.aim, 0)], of_beyond
        if search.aim != VIOLATION:
            return _Judged(float(costs[search.aim]), beyond, by_u)
        outside = np.maximum(beyond, 0.0)
        if by_u is not None:
            by_u = 2.0 * outside @ by_u[1], by_u[1]
        return _Judged(float(outside @ outside), beyond, by_u)
