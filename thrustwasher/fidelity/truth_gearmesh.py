"""The gear mesh's reference values."""

from __future__ import annotations

from typing import Any

from ..errors import SolveError
from .reference_gearmesh import reference_gearmesh
from .truths import QUANTITIES, Point, Source, Truth


def gearmesh_truths(params: Any, point: Point) -> list[Truth]:
    """Return the reference's answer at a point; none where there is none."""
    speed = point["speed"]
    try:
        r = reference_gearmesh(
            params, power=point["load"] * speed, speed=speed,
            oil_temperature=point["oil_temperature"],
        )  # fmt: skip
    except SolveError:
        return []
    values, off = ({q: x[q] for q in QUANTITIES} for x in (r.values, r.uncertainty))
    return [Truth(point, None, None, dict(values), off)]


SOURCE = Source(
    gearmesh_truths, ("gear_line_of_action", "gear_constants"), "reference", None,
    ("adaptive quadrature over the line of action", "search for the hottest position"),
)  # fmt: skip
