"""All designs that a search has tried: their costs, their constraint violation, their order."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .design_problem import Problem
from .designs import Array, Places
from .under_scatter import Uniforms


@dataclass(frozen=True, kw_only=True)
class Archive:
    """Designs tried under one problem: k variables, m figures, and how they are evaluated."""

    problem: Problem
    points: Array
    """(n, k) places in the unit cube."""
    values: Array
    """(n, m) figures; NaN where there is none."""
    scales: Array
    """(m,) sizes of the figures, from the sample."""
    margins: Array
    """(limits,) what the limits are tightened by."""
    scenarios: Uniforms = ()
    """Draws of the scatter of which the worst counts."""

    def with_tried(self, blocks: Sequence[Array]) -> "Archive":
        """Return it with the designs of local searches, each block (n, k + m)."""
        k = len(self.problem.variables)
        points = np.concatenate((self.points, *(b[:, :k] for b in blocks)))
        return replace(
            self, points=points, values=np.concatenate((self.values, *(b[:, k:] for b in blocks)))
        )

    def row(self, place: int) -> dict[str, float]:
        """Return the values [SI] of a design by name."""
        return self.problem.row(self.points[place])

    @property
    def costs(self) -> Array:
        """What is to be small (n, goals)."""
        return self.problem.costs(self.values)

    @property
    def excess(self) -> Array:
        """By how much each design exceeds its tightened limits (n, limits); inf without figures."""
        found = self.problem.excess(self.values) + self.margins
        found[~np.isfinite(self.values).all(1)] = np.inf
        return found

    @property
    def violation(self) -> Array:
        """How far each design is outside its limits in all, in scales (n,); inf without figures."""
        outside = np.maximum(self.excess, 0.0) / self.scales[self.limit_columns]
        sound = np.isfinite(self.values).all(1)
        return np.where(sound, outside.sum(1), np.inf)

    @property
    def limit_columns(self) -> list[int]:
        """The column of ``values`` of each limit's figure."""
        return [self.problem.figures.index(x.figure.name) for x in self.problem.limits]

    @property
    def feasible(self) -> Places:
        """Places of the designs inside all limits."""
        return np.flatnonzero(self.violation <= 0.0)

    def ranked(self, goal: int) -> Places:
        """Return the places of all designs: feasible ones by their cost, then by violation."""
        return np.lexsort((self.costs[:, goal], self.violation))
