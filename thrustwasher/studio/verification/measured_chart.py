"""From answers at random points to a chart of a table: the largest error region by region."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np

from ...ladder.error_table import QUANTITIES, Axis, Chart, Division
from .reference_values import OK, Answer, ReferencePoint

FLOOR = 1e-3  # of the largest value: relative errors are taken of at least so much
FEW = 30  # a region holds so many points at least
CLASSES = 8  # of film ratios, at most
AXES = ("load", "speed")
SHAPES = ((4, 4), (4, 3), (3, 3), (3, 2), (2, 2), (2, 1), (1, 1))  # regions along load and speed
NO_ANSWER = 1e9  # the error of a level that has no answer at a point
OPEN = 1e9  # where the first and the last class of film ratios end

Pair = tuple[ReferencePoint, Answer]
Edges = tuple[float, ...]


def deviation(
    quantity: str, known: ReferencePoint, found: float | list[float], floor: float
) -> float:
    """Return the largest that the error of an answer can be, of a row over time the largest.

    That is the distance from the reference plus the reference's own uncertainty at this point.
    Relative errors are taken of the reference's value, of a row its largest, or of ``floor`` if
    that is more.
    """
    error = np.max(np.abs(np.asarray(found) - np.asarray(known.values[quantity])))
    scale = max(_size(known, quantity), floor) if QUANTITIES[quantity] is None else 1.0
    return (float(error) + known.uncertainty[quantity]) / scale


def _size(known: ReferencePoint, quantity: str) -> float:
    return float(np.max(np.abs(np.asarray(known.values[quantity]))))


def floor_of(known: Sequence[ReferencePoint]) -> float:
    """Return the torque that relative errors are taken of at least, by the largest there is."""
    return rounded_up(FLOOR * max((_size(t, "friction_torque") for t in known), default=0.0))


def chart_of(name: str | None, pairs: Sequence[Pair], box: Mapping[str, Axis]) -> Chart:
    """Return the chart of a level's answers in a box; points next to folds are kept apart."""
    away = [(t, a) for t, a in pairs if not t.beside_fold]
    floor = floor_of([t for t, _ in away]) or 1e-300
    errors = [_errors(t, a, floor) for t, a in away]
    inputs = [tuple(t.point[n] for n in AXES) for t, _ in away]
    divisions = [_division(AXES, _finest(inputs, box), inputs, errors)]
    if away and not any(isinstance(t.values["film_ratio"], list) for t, _ in away):
        ratios = [(float(t.values["film_ratio"]),) for t, _ in away]  # type: ignore[arg-type]
        parts = min(max(len(ratios) // FEW, 1), CLASSES)
        classes = _edges((-OPEN, OPEN), [x for (x,) in ratios], parts, digits=3)
        divisions.append(_division(("film_ratio",), (classes,), ratios, errors))
    beside = [_errors(t, a, floor)[0] for t, a in pairs if t.beside_fold and a.verdict == OK]
    return Chart(name, len(away), floor, rounded_up(max(beside, default=0.0)), tuple(divisions))


def _errors(known: ReferencePoint, found: Answer, floor: float) -> list[float]:
    if found.verdict != OK:
        return [NO_ANSWER] * len(QUANTITIES)
    return [deviation(q, known, found.values[q], floor) for q in QUANTITIES]


def _division(
    axes: tuple[str, ...],
    edges: tuple[Edges, ...],
    places: Sequence[tuple[float, ...]],
    errors: Sequence[Sequence[float]],
) -> Division:
    """Return the largest errors in each region between edges; regions without points have none."""
    held: dict[tuple[int, ...], list[Sequence[float]]] = {}
    for place, row in zip(places, errors, strict=True):
        held.setdefault(_region(edges, place), []).append(row)
    rows = []
    for at in np.ndindex(*(len(e) - 1 for e in edges)):
        mine = held.get(at, [])
        ends = [x for k, e in zip(at, edges, strict=True) for x in e[k : k + 2]]
        worst = [rounded_up(max(column)) for column in zip(*mine, strict=True)]
        rows.append((*ends, len(mine), *(worst or [NO_ANSWER] * len(QUANTITIES))))
    return Division(axes, tuple(rows))


def _region(edges: tuple[Edges, ...], place: tuple[float, ...]) -> tuple[int, ...]:
    """Return which region a place is in; an inner edge belongs to the upper one."""
    return tuple(
        min(max(sum(x >= end for end in e) - 1, 0), len(e) - 2)
        for x, e in zip(place, edges, strict=True)
    )


def _finest(places: Sequence[tuple[float, ...]], box: Mapping[str, Axis]) -> tuple[Edges, ...]:
    """Return the ends of the finest regions of which each holds enough points."""
    for shape in SHAPES:
        edges = tuple(
            _edges((box[n].min, box[n].max), [p[k] for p in places], parts)
            for k, (n, parts) in enumerate(zip(AXES, shape, strict=True))
        )
        held = Counter(_region(edges, place) for place in places)
        many = (len(edges[0]) - 1) * (len(edges[1]) - 1)
        if len(held) == many and min(held.values()) >= FEW:
            return edges
    return edges


def _edges(
    ends: tuple[float, float], values: Sequence[float], parts: int, digits: int = 2
) -> Edges:
    """Return the ends of an axis and rounded quantiles of the values between them."""
    low, high = ends
    shares = [k / parts for k in range(1, parts)] if values else []
    inner = {float(f"{np.quantile(values, share):.{digits}g}") for share in shares}
    return (low, *sorted(v for v in inner if low < v < high), high)


def rounded_up(value: float) -> float:
    """Return the value with three digits, not below itself but for the last bits of a double."""
    if not 0.0 < value < math.inf:
        return value
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{math.ceil(value / step - 1e-9) * step:.3g}")
