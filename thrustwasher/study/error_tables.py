"""From answers at held-out points to a card's tables: the worst error cell by cell."""

import math
import statistics
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..ladder.card_parts import FEW, Axis, ByFilmRatio, Cells, Errors, Fold
from .reference_values import MARGIN, OK, OTHER_SIDE, OUTSIDE, Answer, Point, ReferencePoint

FLOOR = 1e-3  # of the largest value: relative errors are taken of at least so much
KINDS = {"friction_torque": ("relative", None), "temperature": ("absolute", "K"),
         "film_thickness": ("absolute", "m"), "film_ratio": ("absolute", "1")}  # fmt: skip
CLASSES = 8  # of film ratios, at most
AXES = ("load", "speed")
SHAPES = ((4, 4), (4, 3), (3, 3), (3, 2), (2, 2), (2, 1), (1, 1))  # cells along load and speed

Place = tuple[int, int]
Pair = tuple[ReferencePoint, Answer]
Pairs = Sequence[Pair]


def deviation(
    quantity: str, known: ReferencePoint, found: float | list[float], floor: float
) -> float:
    """Return the largest that the error of an answer can be, of a row over time the largest.

    That is the distance from the reference plus the reference's own uncertainty at this point.
    Relative errors are taken of the reference's value, of a row its largest, or of ``floor`` if
    that is more.
    """
    error = np.max(np.abs(np.asarray(found) - np.asarray(known.values[quantity])))
    return (float(error) + known.uncertainty[quantity]) / _scale(quantity, known, floor)


def _scale(quantity: str, known: ReferencePoint, floor: float) -> float:
    return max(_size(known, quantity), floor) if KINDS[quantity][0] == "relative" else 1.0


def _size(known: ReferencePoint, quantity: str) -> float:
    return float(np.max(np.abs(np.asarray(known.values[quantity]))))


def floor_of(quantity: str, known: Sequence[ReferencePoint]) -> float:
    """Return what relative errors are taken of at least, from the largest reference value."""
    return _up(FLOOR * max((_size(t, quantity) for t in known), default=0.0)) or 1e-300


def cells_for(points: Sequence[Point], envelope: dict[str, Axis]) -> Cells:
    """Return the finest cells of which each holds enough points to speak for itself.

    Edges are quantiles of the points, with two digits. Counts of ``outside`` are still zero.
    """
    for shape in SHAPES:
        edges = tuple(
            _edges(envelope[name], [p[name] for p in points], parts)
            for name, parts in zip(AXES, shape, strict=True)
        )
        n = (len(edges[0]) - 1, len(edges[1]) - 1)
        cells = Cells(AXES, edges, tuple((0,) * n[1] for _ in range(n[0])))
        held = Counter(place_of(cells, p) for p in points)
        if shape == SHAPES[-1] or (len(held) == n[0] * n[1] and min(held.values()) >= FEW):
            return cells
    raise AssertionError  # the last shape is always taken


def _edges(axis: Axis, values: Sequence[float], parts: int) -> tuple[float, ...]:
    """Return the ends of an axis and rounded quantiles between them."""
    shares = [k / parts for k in range(1, parts)] if values else []
    inner = {float(f"{np.quantile(values, share):.2g}") for share in shares}
    return (axis.min, *sorted(v for v in inner if axis.min < v < axis.max), axis.max)


def place_of(cells: Cells, point: Point) -> Place:
    """Return the cell of a point inside the envelope."""
    i, j = (cells.index(k, point[name]) for k, name in enumerate(cells.axes))
    return i or 0, j or 0


def error_tables(pairs: Pairs, envelope: dict[str, Axis]) -> tuple[dict[str, Errors], Cells]:
    """Return the error tables and cells of one chart; points beside folds are left out."""
    pairs = [(t, a) for t, a in pairs if not t.beside_fold]
    blank = cells_for([t.point for t, _ in pairs], envelope)
    placed = [(place_of(blank, t.point), (t, a)) for t, a in pairs]
    shape = (len(blank.edges[0]) - 1, len(blank.edges[1]) - 1)
    errors = {q: _table(q, placed, shape, floor_of(q, [t for t, _ in pairs])) for q in KINDS}
    silent = Counter(at for at, (_, a) in placed if a.verdict == OUTSIDE)
    outside = tuple(tuple(silent[i, j] for j in range(shape[1])) for i in range(shape[0]))
    return errors, replace(blank, outside=outside)


def _table(quantity: str, placed: list[tuple[Place, Pair]], shape: Place, floor: float) -> Errors:
    """Return the table of one quantity over answers that count."""
    found: dict[Place, list[float]] = {(i, j): [] for i in range(shape[0]) for j in range(shape[1])}
    for at, (t, a) in placed:
        if a.verdict == OK:
            found[at].append(deviation(quantity, t, a.values[quantity], floor))
    kind, unit = KINDS[quantity]
    worst, n = (
        tuple(tuple(of(found[i, j]) for j in range(shape[1])) for i in range(shape[0]))
        for of in (_worst, len)
    )
    return Errors(kind, unit, floor if kind == "relative" else None, worst, n)  # type: ignore[arg-type]


def _worst(errors: list[float]) -> float | None:
    """Return the worst of the errors, rounded up to three digits."""
    return _up(max(errors)) if errors else None


def _up(value: float) -> float:
    """Return the value with three digits, not below itself but for the last bits of a double."""
    if not 0.0 < value < math.inf:
        return value
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{math.ceil(value / step - 1e-9) * step:.3g}")


def by_film_ratio(pairs: Pairs) -> ByFilmRatio | None:
    """Return the worst errors over the film ratio, in classes of 30 points; None over time."""
    good = [(t, a) for t, a in pairs if a.verdict == OK and not t.beside_fold]
    if not good or any(isinstance(t.values["film_ratio"], list) for t, _ in good):
        return None
    ratios = np.array([float(t.values["film_ratio"]) for t, _ in good])  # type: ignore[arg-type]
    parts = min(max(len(good) // FEW, 1), CLASSES)
    inner = np.quantile(ratios, [k / parts for k in range(1, parts)]) if parts > 1 else ()
    edges = sorted({float(f"{v:.3g}") for v in inner})
    place = [sum(r >= e for e in edges) for r in ratios]
    worst = {}
    for q in KINDS:
        floor = floor_of(q, [t for t, _ in good])
        found: list[list[float]] = [[0.0] for _ in range(len(edges) + 1)]
        for k, (t, a) in zip(place, good, strict=True):
            found[k].append(deviation(q, t, a.values[q], floor))
        worst[q] = tuple(_up(max(errors)) for errors in found)
    counts = tuple(place.count(k) for k in range(len(edges) + 1))
    return ByFilmRatio(tuple(edges), counts, worst)


def fold_part(pairs: Pairs) -> Fold | None:
    """Return what was found beside folds, or None if the chart has none."""
    beside = [(t, a) for t, a in pairs if t.beside_fold]
    if not beside:
        return None
    worst = {}
    for q in KINDS:
        floor = floor_of(q, [t for t, _ in pairs])
        errors = [deviation(q, t, a.values[q], floor) for t, a in beside if a.verdict == OK]
        worst[q] = _up(max(errors, default=0.0))
    other = sum(a.verdict == OTHER_SIDE for _, a in beside)
    return Fold(MARGIN, len(beside), other, worst)


def uncertainties(known: Sequence[ReferencePoint]) -> dict[str, float]:
    """Return the reference's typical uncertainty of each quantity, as errors are measured.

    It is the median over the points; what it is at each point is in the errors already.
    """
    away = [t for t in known if not t.beside_fold]
    return {
        q: _up(statistics.median(t.uncertainty[q] / _scale(q, t, floor_of(q, away)) for t in away))
        for q in KINDS
        if away
    }
