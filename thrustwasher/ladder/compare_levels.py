"""How far a level is from the one above, at points: what is known where no table speaks."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import ParameterError, SolveError
from ..model.registry import find_model
from ..model.spec import ModelSpec
from .error_table import QUANTITIES, Box

POINTS = 30
FLOOR = 1e-3  # of the largest value: relative differences are taken of at least so much
Point = Mapping[str, float]


def points_of(box: Box, n: int = POINTS) -> list[Point]:
    """Return ``n`` points spread evenly over a box, ends included; of a point itself.

    An additive recurrence by the generalised golden ratio fills a box of any dimension evenly; it
    gives the same points each time.
    """
    fixed = {name: low for name, (low, _) in box.items()}
    names = [name for name, (low, high) in box.items() if low < high]
    if not names:
        return [fixed]
    ratio = 2.0
    for _ in range(60):  # the root of x^(d + 1) = x + 1
        ratio = (1.0 + ratio) ** (1.0 / (len(names) + 1))
    shares = np.outer(range(n), ratio ** -np.arange(1.0, len(names) + 1.0)) % 1.0
    shares /= shares.max(0)  # the minimum is 0
    return [
        fixed | {name: _between(box[name], float(x)) for name, x in zip(names, row, strict=True)}
        for row in shares
    ]


def _between(interval: tuple[float, float], share: float) -> float:
    """Return the value at a share of an interval, evenly in its logarithm where that exists."""
    low, high = interval
    value = float(low * (high / low) ** share) if low > 0.0 else low + share * (high - low)
    return min(value, high)


def rows_to_compare(rows: Any, n: int = POINTS) -> Any:
    """Return rows of an array: those of lowest and highest values, the rest spread evenly."""
    ends = np.concatenate([rows.argmin(0), rows.argmax(0)])
    more = np.linspace(0, len(rows) - 1, min(len(rows), max(n - len(set(ends)), n // 2)))
    return rows[sorted({*ends.tolist(), *more.round().astype(int).tolist()})]


class Comparison:
    """A model's levels with some parameters, solved at points; each level once, when requested."""

    def __init__(
        self, spec: ModelSpec, params: object, points: Sequence[Point], quantity: str
    ) -> None:
        self.points, self._params, self._quantity = points, params, quantity
        self._model = find_model(spec.key)
        self._known: dict[str, list[float]] = {}

    def difference(self, level: str, above: str) -> float:
        """Return the largest difference of two levels, as errors are measured.

        Points at which one of them has no solution do not count; infinite if all are such.
        """
        pairs = zip(self._solved(level), self._solved(above), strict=True)
        both = [(a, b) for a, b in pairs if math.isfinite(a) and math.isfinite(b)]
        floor = FLOOR * max((abs(b) for _, b in both), default=0.0) or 1e-300
        relative = QUANTITIES[self._quantity] is None
        return max(
            (abs(a - b) / (max(abs(b), floor) if relative else 1.0) for a, b in both),
            default=math.inf,
        )

    def _solved(self, level: str) -> list[float]:
        if level not in self._known:
            self._known[level] = [self._value(level, point) for point in self.points]
        return self._known[level]

    def _value(self, level: str, point: Point) -> float:
        model, params = self._model, self._params
        try:
            result = model.solve(params, **model.back(dict(point)), fidelity=level, throw=False)
        except (ParameterError, SolveError):
            return math.nan
        return math.nan if result.status.is_failure else float(getattr(result, self._quantity))
