"""The clutch's reference values, of its finest rung: lasting slip, and an engagement."""

from __future__ import annotations

from typing import Any

from ..models.clutch_params import SPEC
from .truths import QUANTITIES, Point, Source, Truth

FINEST = list(SPEC.fidelities)[-1]
CHARTS = ("settled", "engagement")


def clutch_truths(params: Any, point: Point) -> list[Truth]:
    """Return the reference's answers at a point, settled and in an engagement."""
    from .answers import answer

    found = []
    for chart in CHARTS:
        blank = Truth(point, chart, None, {}, {})
        values = answer("clutch", params, FINEST, blank).values
        found.append(Truth(point, chart, None, values, dict.fromkeys(QUANTITIES, 0.0)))
    return found


SOURCE = Source(
    clutch_truths, ("clutch_steady", "clutch_point"), FINEST, None, ("the finest rung",)
)
