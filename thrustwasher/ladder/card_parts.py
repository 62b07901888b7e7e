"""The parts of a card: what was verified, where, against what, and what it cost."""

import math
from dataclasses import dataclass
from typing import Any

Grid = tuple[tuple[float | None, ...], ...]  # over two axes of cells; None: no point fell there
Counts = tuple[tuple[int, ...], ...]

QUANTITIES = ("friction_torque", "temperature", "film_thickness", "film_ratio")
FEW = 30  # a cell with fewer points takes the worst of itself and its neighbours


@dataclass(frozen=True, slots=True)
class Axis:
    """One input's range; ``scale`` is "log", "linear" or "fixed"."""

    min: float
    max: float
    unit: str
    scale: str


@dataclass(frozen=True, slots=True)
class Errors:
    """Errors of one quantity, cell by cell: worst, points.

    ``kind`` is "relative" (to the reference's value, or to ``floor`` if that is more) or "absolute"
    (in ``unit``).
    """

    kind: str
    unit: str | None
    floor: float | None
    worst: Grid
    n: Counts


@dataclass(frozen=True, slots=True)
class Cells:
    """How the envelope is divided; ``outside`` counts points where the rung gave no answer."""

    axes: tuple[str, ...]
    edges: tuple[tuple[float, ...], ...]
    outside: Counts

    def index(self, axis: int, value: float) -> int | None:
        """Return the cell along one axis; an inner edge belongs to the upper cell."""
        edges = self.edges[axis]
        if not edges[0] <= value <= edges[-1]:
            return None
        return min(sum(value >= e for e in edges) - 1, len(edges) - 2)

    def touched(self, axis: int, low: float, high: float) -> range:
        """Return the cells along one axis that an interval meets; edges count to both sides."""
        edges = self.edges[axis]
        met = [k for k in range(len(edges) - 1) if low <= edges[k + 1] and edges[k] <= high]
        if low < high:  # an interval that only reaches an edge does not enter the next cell
            met = [k for k in met if low < edges[k + 1] and edges[k] < high]
        return range(met[0], met[-1] + 1) if met else range(0)


@dataclass(frozen=True, slots=True)
class ByFilmRatio:
    """Worst errors over the film ratio, which a result knows though a box does not.

    ``edges`` are inner ones: the first and the last class are open. Each class holds 30 points.
    """

    edges: tuple[float, ...]
    n: tuple[int, ...]
    worst: dict[str, tuple[float, ...]]

    def error_of(self, quantity: str, film_ratio: float) -> float | None:
        """Return the worst error of the class that a film ratio is in."""
        table = self.worst.get(quantity)
        return None if table is None else table[sum(film_ratio >= e for e in self.edges)]


@dataclass(frozen=True, slots=True)
class Fold:
    """What was found beside the end of a branch; such points are not in the errors.

    ``margin`` is the share of the fold's load within which a point counts as beside it, ``n`` the
    points there, ``other_side`` those of them that the rung solved on another branch, ``worst`` the
    largest error of the others.
    """

    margin: float
    n: int
    other_side: int
    worst: dict[str, float]


@dataclass(frozen=True, slots=True)
class ParameterSet:
    """Which parameters a card holds for, and how they differ from the defaults."""

    name: str
    sha256: str
    changed: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Sources:
    """The files that the numbers come from: of ``kernels/``; with a slash, of ``data/``."""

    files: tuple[str, ...]
    sha256: str


@dataclass(frozen=True, slots=True)
class HeldOut:
    """The points, random in the scaled box: how many, failures, outside the rung's own range."""

    n: int
    failed: int
    outside: int
    seed: int


@dataclass(frozen=True, slots=True)
class Reference:
    """What it was compared with; ``uncertainty`` is the reference's own, typically, per quantity.

    Errors contain the uncertainty at their point already.
    """

    fidelity: str
    grid: tuple[int, ...] | None
    routes: tuple[str, ...]
    uncertainty: dict[str, float]


@dataclass(frozen=True, slots=True)
class Cost:
    """Seconds per call on the named machine, and what is spent once."""

    call_median_s: float
    call_iqr_s: float
    first_call_s: float
    build_s: float


def worst_near(errors: Errors, i: int, j: int) -> float | None:
    """Return the worst of a cell; with fewer than 30 points there, of it and its neighbours."""
    rows, columns = len(errors.worst), len(errors.worst[0])
    reach = 0 if errors.n[i][j] >= FEW else 1
    found = [
        errors.worst[a][b]
        for a in range(max(i - reach, 0), min(i + reach + 1, rows))
        for b in range(max(j - reach, 0), min(j + reach + 1, columns))
    ]
    return max((w for w in found if w is not None and not math.isnan(w)), default=None)
