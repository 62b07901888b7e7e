"""The gear mesh's reference values."""

from __future__ import annotations

from typing import Any

from .truths import QUANTITIES, Point, Source, Truth


def gearmesh_truths(params: Any, point: Point) -> list[Truth]:
    """Return the reference's answer at a point."""
    from .answers import answer

    blank = Truth(point, None, None, {}, {})
    values = answer("gearmesh", params, "field", blank).values
    return [Truth(point, None, None, values, dict.fromkeys(QUANTITIES, 0.0))]


SOURCE = Source(gearmesh_truths, ("gear_point",), "field", None, ("placeholder",))
