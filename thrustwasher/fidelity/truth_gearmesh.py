"""The gear mesh's reference values: its finest rung."""

from __future__ import annotations

from typing import Any

from ..models.gearmesh_params import SPEC
from .truths import QUANTITIES, Point, Source, Truth

FINEST = list(SPEC.fidelities)[-1]


def gearmesh_truths(params: Any, point: Point) -> list[Truth]:
    """Return the reference's answer at a point."""
    from .answers import answer

    blank = Truth(point, None, None, {}, {})
    values = answer("gearmesh", params, FINEST, blank).values
    return [Truth(point, None, None, values, dict.fromkeys(QUANTITIES, 0.0))]


SOURCE = Source(gearmesh_truths, ("gear_point",), FINEST, None, ("the finest rung",))
