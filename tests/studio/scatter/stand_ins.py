"""What can be studied in no time: plain functions, a target with all that a target may have."""

import math
from dataclasses import dataclass, field

import numpy as np

from thrustwasher.errors import SolveError
from thrustwasher.model.quantity import Figure, Quantity
from thrustwasher.model.scatter import Scatter, read_scatter
from thrustwasher.studio.evaluators.evaluator import Answers, efforts

PI = {"uniform": [-math.pi, math.pi]}
ANGLES = {"x1": PI, "x2": PI, "x3": PI}
NORMAL = {"a": {"normal": 3.0}, "b": {"normal": 2.0}, "c": {"normal": 1.0}}


def ishigami(x1, x2, x3):
    return math.sin(x1) * (1.0 + 0.1 * x3**4) + 7.0 * math.sin(x2) ** 2


def linear(a=10.0, b=20.0, c=30.0):
    return {"sum": a + b + c, "difference": a - b, "same": 4.0, "a alone": a}


def picky(a=10.0, b=20.0, c=30.0):
    if a > 13.0:
        raise SolveError("too much")
    return a + b + c


def never(a=10.0):
    raise SolveError("never")


def of_places(table, nominal):
    """Return a scatter of places without unit."""
    places = {n: Quantity(name=n, unit="1", nominal=x) for n, x in nominal.items()}
    return read_scatter("test", table, places)


@dataclass(frozen=True)
class Swing:
    """A signal a sin(t) + b over time; ``dear`` costs, ``lasting`` is there for a > 9 only.

    Runs with b > ``limit`` fail.
    """

    limit: float = math.inf
    scatter: Scatter = field(
        default_factory=lambda: of_places(
            {"a": {"normal": 1.0}, "b": {"normal": 2.0}, "d": {"normal": 1.0}},
            {"a": 10.0, "b": 20.0, "d": 1.0},
        )
    )
    name = "swing"
    kind = "scene"
    costly = ("dear",)
    remarks = ()

    @property
    def figures(self):
        found = (
            Figure("peak", "N m", "largest value", low=25.0, high=33.0),
            Figure("lasting", "s", "there for a > 9"),
            Figure("dear", "1", "costs much"),
            Figure("high", "1", "", kind="outcome"),
        )
        return {f.name: f for f in found}

    @property
    def signals(self):
        return {"signal": ""}

    @property
    def reasons(self):
        return {1: "broken", 2: "b is too large"}

    @property
    def time(self):
        return np.linspace(0.0, math.pi, 5)

    @property
    def identity(self):
        return {"limit": str(self.limit)}

    def touches(self, source):
        return source != "d"

    def why(self, row):
        return ""

    def doubts(self, figures, base):
        return []

    def error(self):
        return {"peak": 0.01}

    def under(self, scatter, figures):
        return self

    def nominal(self, figures, signals):
        return self.evaluate([{"a": 10.0, "b": 20.0, "d": 1.0}], figures, "search", signals)

    def evaluate(self, rows, figures, effort="search", signals=()):
        costly = [own == "search" for own in efforts(effort, len(rows))]
        found = np.array([self._row(*pair) for pair in zip(rows, costly, strict=True)])
        codes = np.array([2 if row["b"] > self.limit else 0 for row in rows], np.int32)
        found[codes > 0] = np.nan
        columns = [list(self.figures).index(name) for name in figures]
        series = found[:, np.newaxis, 4:] if signals else None
        return Answers(found[:, columns], codes, series)

    def _row(self, row, costly):
        a, b, d = row["a"], row["b"], row["d"]
        dear = a + d if costly else np.nan
        lasting = a if a > 9.0 else np.nan
        return np.array([a + b, lasting, dear, a + b > 33.0, *(a * np.sin(self.time) + b)])
