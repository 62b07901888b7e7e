"""From answers at held-out points to a card's tables: worst and rms error cell by cell."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..store.card_parts import Axis, Cells, Errors, Fold
from .answers import OK, OTHER_SIDE, OUTSIDE, Answer
from .truths import MARGIN, Truth

FLOOR = 1e-3  # of the largest value: relative errors are taken of at least so much
KINDS = {"friction_torque": ("relative", None), "temperature": ("absolute", "K"),
         "film_thickness": ("absolute", "m"), "film_ratio": ("absolute", "1")}  # fmt: skip
AXES = ("load", "speed")
SHAPE = (3, 2)  # cells along load and speed

Place = tuple[int, int]
Pairs = Sequence[tuple[Truth, Answer]]


def deviation(quantity: str, truth: Truth, found: float | list[float], floor: float) -> float:
    """Return the error of an answer, of a course the largest one.

    Relative errors are taken of the reference's value, of a course its largest, or of ``floor`` if
    that is more.
    """
    error = np.max(np.abs(np.asarray(found) - np.asarray(truth.values[quantity])))
    return float(error) / _scale(quantity, truth, floor)


def _scale(quantity: str, truth: Truth, floor: float) -> float:
    return max(_size(truth, quantity), floor) if KINDS[quantity][0] == "relative" else 1.0


def _size(truth: Truth, quantity: str) -> float:
    return float(np.max(np.abs(np.asarray(truth.values[quantity]))))


def floor_of(quantity: str, truths: Sequence[Truth]) -> float:
    """Return what relative errors are taken of at least, from the largest reference value."""
    return _up(FLOOR * max((_size(t, quantity) for t in truths), default=0.0)) or 1e-300


def cells_for(points: Sequence[dict[str, float]], envelope: dict[str, Axis]) -> list[list[float]]:
    """Return edges so that the cells hold about equally many points."""
    found = []
    for name, parts in zip(AXES, SHAPE, strict=True):
        axis, values = envelope[name], [p[name] for p in points]
        shares = [k / parts for k in range(1, parts)] if len(values) > parts else []
        rounded = [float(f"{np.quantile(values, share):.2g}") for share in shares]
        kept = sorted({v for v in rounded if axis.min < v < axis.max})
        found.append([axis.min, *kept, axis.max])
    return found


def tables(pairs: Pairs, envelope: dict[str, Axis]) -> tuple[dict[str, Errors], Cells]:
    """Return the error tables and cells of one chart; points beside folds are left out."""
    pairs = [(t, a) for t, a in pairs if not t.beside_fold]
    edges = cells_for([t.point for t, _ in pairs], envelope)
    blank = Cells(AXES, tuple(map(tuple, edges)), ())
    place = [
        (blank.index(0, t.point[AXES[0]]) or 0, blank.index(1, t.point[AXES[1]]) or 0)
        for t, _ in pairs
    ]
    shape = (len(edges[0]) - 1, len(edges[1]) - 1)
    outside = np.zeros(shape, int)
    for at, (_, a) in zip(place, pairs, strict=True):
        outside[at] += a.verdict == OUTSIDE
    placed = list(zip(place, pairs, strict=True))
    errors = {q: _table(q, placed, shape, floor_of(q, [t for t, _ in pairs])) for q in KINDS}
    return errors, Cells(AXES, blank.edges, tuple(map(tuple, outside.tolist())))


def _table(
    quantity: str, placed: list[tuple[Place, tuple[Truth, Answer]]], shape: Place, floor: float
) -> Errors:
    """Return the table of one quantity over answers that count."""
    found: dict[Place, list[float]] = {(i, j): [] for i in range(shape[0]) for j in range(shape[1])}
    for at, (t, a) in placed:
        if a.verdict == OK:
            found[at].append(deviation(quantity, t, a.values[quantity], floor))
    kind, unit = KINDS[quantity]
    worst, rms, n = (
        tuple(tuple(of(found[i, j]) for j in range(shape[1])) for i in range(shape[0]))
        for of in (_worst, _rms, len)
    )
    return Errors(kind, unit, floor if kind == "relative" else None, worst, rms, n)  # type: ignore[arg-type]


def _worst(errors: list[float]) -> float | None:
    """Return the worst of the errors, rounded up to three digits."""
    return _up(max(errors)) if errors else None


def _rms(errors: list[float]) -> float | None:
    if not errors:
        return None
    return float(f"{math.sqrt(sum(e * e for e in errors) / len(errors)):.3g}")


def _up(value: float) -> float:
    """Return the value with three digits, not below itself but for the last bits of a double."""
    if not 0.0 < value < math.inf:
        return value
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{math.ceil(value / step - 1e-9) * step:.3g}")


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
    return Fold(None, MARGIN, len(beside), other, worst)


def uncertainties(truths: Sequence[Truth]) -> dict[str, float]:
    """Return the reference's largest uncertainty of each quantity, as errors are measured."""
    away = [t for t in truths if not t.beside_fold]
    return {
        q: _up(max((t.uncertainty[q] / _scale(q, t, floor_of(q, away)) for t in away),
                   default=0.0))
        for q in KINDS
    }  # fmt: skip
