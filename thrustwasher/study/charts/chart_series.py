"""What is charted: fixed operating points, hard corners included, and the series of ways to solve.

A series goes over every rung, over meshes and tolerances, or over rivals at their best setting.
Lists of points are data; a changed list is another list (``digest``).
"""

import hashlib
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from ...model.record import resolve
from ...model.registry import ladder_of, spec_of
from ...model.spec import ModelSpec
from ..rivals.plain2006 import Plain2006
from .methods import ChartCase, ClutchMethod, KernelMethod, Method, Method2006


@dataclass(frozen=True)
class Configuration:
    """One method at one setting of its knob."""

    family: str  # series of the chart
    label: str
    knob: str  # what changes along the series: "grid", "tolerance", "rung"
    value: str
    make: Callable[[], Method]
    count_of: str = ""
    is_rival: bool = False


@dataclass(frozen=True)
class Quantity:
    """What is judged: relative errors have a floor, absolute ones a unit."""

    name: str
    relative: bool
    floor: float = 0.0  # least size an error is referred to
    unit: str = "1"

    def size(self, true: float) -> float:
        """Return what an error is referred to."""
        return max(abs(true), self.floor) if self.relative else 1.0

    def error(self, found: float, true: float) -> float:
        """Return the error of a value."""
        return abs(found - true) / self.size(true)

    def as_dict(self) -> dict[str, Any]:
        """Return it as JSON types."""
        kind, floor = ("relative", self.floor) if self.relative else ("absolute", None)
        return {"name": self.name, "kind": kind, "unit": self.unit, "floor": floor}


USUAL_STEP = 1e-3
STEPS = (2e-2, 1e-2, 5e-3, 2e-3, 5e-4)
GRIDS = ((7, 20), (9, 24), (10, 32), (13, 40), (16, 48), (19, 64), (28, 96))
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)
GRIDS_2006 = ((13, 67), (17, 67), (17, 134))
BEST_2006 = 1e-5  # tolerance of the method of 2006 beyond which its answers do not change
LOADS = tuple(range(50, 1851, 50))  # of the washer's whole curve
OIL = 297.15
Settings = Iterable[tuple[str, str, Callable[[], Method]]]  # label, value of the knob, method


def _series(
    family: str, knob: str, settings: Settings, count_of: str, *, is_rival: bool = False
) -> list[Configuration]:
    return [
        Configuration(family, label, knob, value, make, count_of, is_rival)
        for label, value, make in settings
    ]


def _rungs(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return every named fidelity that the kernel knows."""
    rungs = ((name, name, partial(KernelMethod, spec, name)) for name in spec.fidelities)
    return _series("rungs", "rung", rungs, spec.counts[0][0] if spec.counts else "calls")


def _washer(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return rungs, meshes from coarse to fine, and the method of 2006.

    That goes over its tolerance, and over its mesh at the best tolerance.
    """
    meshes: Settings = (
        (f"{r} x {t}", f"{r}x{t}", partial(KernelMethod, spec, "field", (r, t)))
        for r, t in (GRIDS[::3] if quick else GRIDS)
    )
    tolerances: Settings = (
        (f"2006, 9 x 67, {t:g}", f"{t:g}", partial(Method2006, tolerance=t))
        for t in (TOLERANCES[1:2] if quick else TOLERANCES)
    )
    meshes_2006: Settings = (
        (f"2006, mesh {r} x {t}", f"{r}x{t}", partial(Method2006, tolerance=1e-5, grid=(r, t)))
        for r, t in (() if quick else GRIDS_2006)
    )
    swept = "sweeps x nodes"
    return [
        *_rungs(spec),
        *_series("mesh of the package", "grid", meshes, "Newton iterations x nodes"),
        *_series("2006, 9 x 67, tolerance", "tolerance", tolerances, swept, is_rival=True),
        *_series("2006, 1e-5, mesh", "grid", meshes_2006, swept, is_rival=True),
    ]


def _clutch(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return every rung, and those with a moving film over the communication step."""
    rungs = ((name, name, partial(ClutchMethod, name, USUAL_STEP)) for name in spec.fidelities)
    found = _series("rungs", "rung", rungs, "steps")
    for name in ("field", "fine"):
        steps: Settings = (
            (f"{name}, {1e3 * h:g} ms", f"{1e3 * h:g} ms", partial(ClutchMethod, name, h))
            for h in (STEPS[::2] if quick else STEPS)
        )
        found += _series(f"{name} over the step", "step", steps, "steps")
    return found


def whole_curve(*, quick: bool = False) -> dict[str, float]:
    """Return the seconds that one curve up in load takes, by the method of 2006 and by ours.

    545 rad/s, tilt 0.002 rad, 24 degC, 50 .. 1850 N in steps of 50 N; and the first load step of
    the method of 2006 alone, which took 30 minutes then.
    """
    loads = LOADS[::4] if quick else LOADS
    washer = Plain2006(tolerance=BEST_2006)
    began = time.perf_counter()
    washer.solve(loads[0], 545.0, 2e-3, OIL)
    first = time.perf_counter() - began
    for load in loads[1:]:
        washer.solve(load, 545.0, 2e-3, OIL)
    whole = time.perf_counter() - began
    ours = KernelMethod(spec_of("washer"), "field")
    points = tuple((float(load), 545.0, 2e-3, OIL) for load in loads)
    ours.solve(ChartCase("curve", points[-1], points[:-1]))
    began = time.perf_counter()
    ours.solve(ChartCase("curve", points[-1], points[:-1]))
    return {
        "points": len(loads), "first_step_2006_s": first, "curve_2006_s": whole,
        "curve_field_s": time.perf_counter() - began, "first_step_then_s": 1800.0,
    }  # fmt: skip


def _case(name: str, load: float, speed: float, tilt: float = 2e-3, oil: float = OIL,
          down_from: float = 0.0) -> ChartCase:  # fmt: skip
    before = ((down_from, speed, tilt, oil),) if down_from else ()
    return ChartCase(name, (load, speed, tilt, oil), before)


# load N, speed rad/s, tilt rad, oil K
WASHER_CASES = (
    _case("centre", 300.0, 545.0),
    _case("full film, fast", 300.0, 953.0),
    _case("edge: fastest, heavy", 600.0, 1367.0),
    _case("edge: slow, light", 50.0, 136.0),
    _case("light load", 20.0, 545.0),
    _case("small tilt", 300.0, 545.0, tilt=2e-4),
    _case("large tilt", 200.0, 545.0, tilt=4e-3),
    _case("hot oil", 200.0, 545.0, oil=353.15),
    _case("transition", 320.0, 136.0),
    _case("just below the fold", 700.0, 545.0),
    _case("mixed", 450.0, 136.0),
    _case("boundary", 1361.0, 136.0),
    _case("contact branch below the fold", 500.0, 545.0, down_from=1200.0),
    _case("film lost", 1200.0, 545.0),
)
# pinion torque N m, speed rad/s, oil K
GEARMESH_CASES = (
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
CLUTCH_CASES = (
    ChartCase("centre", (5898.0, 350.0, 297.15)),
    ChartCase("light", (1500.0, 350.0, 297.15)),
    ChartCase("heavy", (12000.0, 350.0, 297.15)),
    ChartCase("slow", (5898.0, 40.0, 297.15)),
    ChartCase("fast", (3000.0, 600.0, 297.15)),
    ChartCase("hot oil", (5898.0, 350.0, 353.15)),
)


@dataclass(frozen=True)
class Chart:
    """What a model's chart shows."""

    quantities: tuple[Quantity, Quantity]
    cost_of: str  # its axis
    series: Callable[..., list[Configuration]]
    cases: tuple[ChartCase, ...]
    few: tuple[int, ...]  # of the cases, for a quick look
    more: Mapping[str, Callable[..., object]] = field(default_factory=dict)  # measured beside it


WARM = "warm call, 1 % away [s]"
KELVIN = Quantity("temperature", False, unit="K")
WASHER = Chart(
    (Quantity("friction_torque", True, 1e-3), KELVIN), WARM, _washer,
    WASHER_CASES, (0, 1, 8, 11, 12), {"curve": whole_curve},
)  # fmt: skip
CLUTCH = Chart(
    (Quantity("slip_energy", True), Quantity("end_temperature", False, unit="K")),
    "engagement of 0.6 s [s]", _clutch, CLUTCH_CASES, (0, 2, 3),
)  # fmt: skip
GEARMESH = Chart(
    (Quantity("friction_torque", True, 1e-4), KELVIN), WARM, _rungs, GEARMESH_CASES, (0, 2, 3, 4)
)


def chart_of(model: str) -> Chart:
    """Return what a model's chart shows."""
    found: Chart = resolve(ladder_of(model).chart)
    return found


def cases_of(model: str, *, quick: bool = False) -> tuple[ChartCase, ...]:
    """Return the cases of a model, or those of a quick look."""
    chart = chart_of(model)
    return tuple(chart.cases[i] for i in chart.few) if quick else chart.cases


def digest(cases: tuple[ChartCase, ...]) -> str:
    """Return a short digest of a list of cases."""
    text = repr([(c.name, c.point, c.before) for c in cases])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def series_of(model: str, *, quick: bool = False) -> list[Configuration]:
    """Return everything that is measured for a model."""
    return chart_of(model).series(spec_of(model), quick=quick)
