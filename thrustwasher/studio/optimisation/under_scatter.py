"""Designs under scatter, by the few draws that decide.

A figure counts at a quantile of its draws. All draws of every design would take a hundred runs, so
a search takes those at the quantile about the best design so far, always the same uniforms. They
are chosen anew in each round.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from ...errors import ParameterError
from ...model.scatter import Scatter
from ..evaluators.evaluator import Answers, Effort, Slopes
from .design_problem import Problem
from .designs import Array, Designs, Row

Uniforms = tuple[tuple[float, ...], ...]


@dataclass(frozen=True, kw_only=True)
class UnderScatter:
    """Designs whose figures are the worst of some draws, and of the values themselves."""

    designs: Designs
    problem: Problem
    uniforms: Uniforms

    def evaluate(
        self, rows: Sequence[Row], figures: Sequence[str], effort: Effort = "search"
    ) -> Answers:
        """Return figures of designs; NaN where a design or one of its draws has none."""
        worst = np.full((len(rows), len(figures)), np.nan)
        for i, row in enumerate(rows):
            with suppress(ParameterError):  # values that do not go together
                drawn = self.designs.evaluate(self._draws(row), figures, effort).values
                worst[i] = (drawn * self._signs).max(0)
        return Answers(worst * self._signs, np.zeros(len(rows), np.int32))

    def gradient(
        self, row: Row, figures: Sequence[str], names: Sequence[str], effort: Effort = "search"
    ) -> Slopes | None:
        """Return figures (m,) and their slopes (m, k) in the worst draw of each."""
        found = []
        try:
            draws = self._draws(row)
        except ParameterError:
            return Slopes(
                np.full(len(figures), np.nan), np.full((len(figures), len(names)), np.nan)
            )
        for drawn in draws:
            one = self.designs.gradient(drawn, figures, names, effort)
            if one is None:
                return None
            follows = np.array([drawn[n] / row[n] if row[n] else 1.0 for n in names])
            found.append((one[0], one[1] * follows))
        values = np.array([one[0] for one in found])
        worst = (values * self._signs).argmax(0)
        m = range(len(figures))
        slopes = np.array([found[j][1][i] for i, j in zip(m, worst, strict=True)])
        return Slopes(values[worst, m], slopes)

    @property
    def _signs(self) -> Array:
        """1 where more of a figure is worse, else -1: as its limit says, else its goal."""
        goals = {g.figure.name: -1.0 if g.most else 1.0 for g in self.problem.goals}
        limits = {x.figure.name: 1.0 if x.upper else -1.0 for x in self.problem.limits}
        return np.array([(goals | limits)[name] for name in self.problem.figures])

    def _draws(self, row: Row) -> list[Row]:
        values = sources_of(self.designs, row).values(np.array(self.uniforms))
        return [row, *({**row, **own} for own in values)]


def judged_by(designs: Designs, problem: Problem, uniforms: Uniforms) -> Designs | UnderScatter:
    """Return the designs themselves, or under the draws that there are."""
    if not uniforms:
        return designs
    return UnderScatter(designs=designs, problem=problem, uniforms=uniforms)


def sources_of(designs: Designs, row: Row) -> Scatter:
    """Return how a design scatters; ParameterError: it does not."""
    found = designs.scattered(None, row)
    if not found.sources:
        raise ParameterError("robust: nothing scatters; add [scatter] to the file")
    return found
