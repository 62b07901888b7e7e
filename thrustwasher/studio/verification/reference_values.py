"""Reference values, at held-out points too, and what a level computes for comparison."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Point = dict[str, float]
Values = dict[str, float | list[float]]
MARGIN = 0.05  # of a fold's load: points nearer are kept apart
OK, FAILED, OUTSIDE, OTHER_SIDE = "ok", "failed", "outside", "other side"


@dataclass(frozen=True, slots=True)
class ReferenceValues:
    """The equations of `field` (clutch, gear mesh: of `fine`), solved as well as can be; SI units.

    ``uncertainty`` bounds the numerical error, by what the last refinement changed. Whether the
    equations are those of a real part is another question.
    """

    values: dict[str, float]
    uncertainty: dict[str, float]
    routes: tuple[str, ...] = ()

    def of(self, names: Collection[str]) -> tuple[Values, dict[str, float]]:
        """Return some of the values, and what they may be off by."""
        return {q: self.values[q] for q in names}, {q: self.uncertainty[q] for q in names}


@dataclass(frozen=True)
class ReferencePoint:
    """What the reference says at a held-out point on one chart.

    ``values`` holds the quantities, numbers or a row over time; ``uncertainty`` is the reference's
    own for each, in the same unit. ``by_mesh`` holds what a mesh gave on the way.
    """

    point: Point
    chart: str | None
    branch: str | None
    values: Values
    uncertainty: dict[str, float]
    beside_fold: bool = False
    by_mesh: dict[str, Values] = field(default_factory=dict)


@dataclass(frozen=True)
class Answer:
    """What a level says at a held-out point, and whether it counts: one of the words above."""

    values: Values
    verdict: str


@dataclass(frozen=True)
class Source:
    """How a model's reference values are found and its levels asked."""

    solve: Callable[[Any, Point], list[ReferencePoint]]
    answer: Callable[[Any, str, ReferencePoint], Answer]  # of parameters, level; on the branch
    at_case: Callable[..., ReferenceValues]  # of a chart: its point, those before it, a preset
    kernels: tuple[str, ...]  # whose change makes kept values worthless
    grid: tuple[int, ...] | None
    routes: tuple[str, ...]
    branches: Mapping[str, float] = field(default_factory=dict)
    """What asks the kernel for a branch, behind its inputs."""


def extrapolated(
    rows: Sequence[Mapping[str, Any]], ratios: tuple[float, float], order: float
) -> tuple[dict[str, Any], dict[str, float]]:
    """Return values from the two finest of three rows, and what each may still be off by.

    ``ratios`` of the resolution from row to row, ``order`` of the error. The uncertainty is the
    correction or, if larger, the difference from the value that the two coarser rows give; of
    values over time the largest.
    """
    before, gain = (ratio**order - 1.0 for ratio in ratios)
    values, uncertainty = {}, {}
    for name in rows[0]:
        a, b, c = (row[name] for row in rows)
        values[name] = c + (c - b) / gain
        other = b + (b - a) / before
        off = np.maximum(abs(c - b) / gain, abs(values[name] - other))
        uncertainty[name] = float(np.max(off))
    return values, uncertainty
