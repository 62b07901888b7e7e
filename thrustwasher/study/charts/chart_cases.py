"""The fixed lists of operating points that errors and costs are measured on, hard corners included.

A case is reached as a user would reach it: from rest over the points of ``before``, so that the
branch is that of the history. Lists are data; a changed list is another list (``digest``).
"""

import hashlib
from dataclasses import dataclass

from ...model.record import resolve
from ...model.registry import ladder_of

OIL = 297.15


@dataclass(frozen=True)
class ChartCase:
    """An operating point in the order of the model's inputs, and the way to it."""

    name: str
    point: tuple[float, ...]
    before: tuple[tuple[float, ...], ...] = ()


def _washer(name: str, load: float, speed: float, tilt: float = 2e-3, oil: float = OIL,
            down_from: float = 0.0) -> ChartCase:  # fmt: skip
    before = ((down_from, speed, tilt, oil),) if down_from else ()
    return ChartCase(name, (load, speed, tilt, oil), before)


# load N, speed rad/s, tilt rad, oil K
WASHER = (
    _washer("centre", 300.0, 545.0),
    _washer("full film, fast", 300.0, 953.0),
    _washer("edge: fastest, heavy", 600.0, 1367.0),
    _washer("edge: slow, light", 50.0, 136.0),
    _washer("light load", 20.0, 545.0),
    _washer("small tilt", 300.0, 545.0, tilt=2e-4),
    _washer("large tilt", 200.0, 545.0, tilt=4e-3),
    _washer("hot oil", 200.0, 545.0, oil=353.15),
    _washer("transition", 320.0, 136.0),
    _washer("just below the fold", 700.0, 545.0),
    _washer("mixed", 450.0, 136.0),
    _washer("boundary", 1361.0, 136.0),
    _washer("contact branch below the fold", 500.0, 545.0, down_from=1200.0),
    _washer("film lost", 1200.0, 545.0),
)
# pinion torque N m, speed rad/s, oil K
GEARMESH = (
    ChartCase("centre", (7500.0 / 180.0, 180.0, 299.85)),
    ChartCase("light", (5.0, 180.0, 299.85)),
    ChartCase("heavy", (120.0, 180.0, 299.85)),
    ChartCase("slow", (40.0, 10.0, 299.85)),
    ChartCase("fast", (40.0, 1000.0, 299.85)),
    ChartCase("hot oil", (40.0, 180.0, 373.15)),
    ChartCase("fast, light, hot", (5.0, 1000.0, 373.15)),
    ChartCase("slow, heavy, cold", (120.0, 10.0, 263.15)),
)
# an engagement: full force N, slip at the start rad/s, oil K
CLUTCH = (
    ChartCase("centre", (5898.0, 350.0, 297.15)),
    ChartCase("light", (1500.0, 350.0, 297.15)),
    ChartCase("heavy", (12000.0, 350.0, 297.15)),
    ChartCase("slow", (5898.0, 40.0, 297.15)),
    ChartCase("fast", (3000.0, 600.0, 297.15)),
    ChartCase("hot oil", (5898.0, 350.0, 353.15)),
)
# with those of a quick look
WASHER_CASES = (WASHER, (0, 1, 8, 11, 12))
CLUTCH_CASES = (CLUTCH, (0, 2, 3))
GEARMESH_CASES = (GEARMESH, (0, 2, 3, 4))


def cases_of(model: str, *, quick: bool = False) -> tuple[ChartCase, ...]:
    """Return the cases of a model, or those of a quick look."""
    cases, few = resolve(ladder_of(model).cases)
    return tuple(cases[i] for i in few) if quick else cases


def digest(cases: tuple[ChartCase, ...]) -> str:
    """Return a short digest of a list of cases."""
    text = repr([(c.name, c.point, c.before) for c in cases])
    return hashlib.sha256(text.encode()).hexdigest()[:16]
