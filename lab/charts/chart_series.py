"""What a chart is: fixed operating points, hard corners included, and the series of ways to solve.

A series goes over every level, or over meshes and tolerances; ``work_precision`` lists those of
the models. The points are those of ``cases.toml``. A changed list of points is another list
(``digest``).
"""

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from lab.charts.methods import ChartCase, KernelMethod, Method
from thrustwasher.model.spec import ModelSpec
from thrustwasher.model.toml_tables import table_beside


@dataclass(frozen=True)
class Configuration:
    """One method at one setting of its knob."""

    family: str  # series of the chart
    label: str
    knob: str  # what changes along the series: "grid", "tolerance", "level"
    value: str
    make: Callable[[], Method]
    count_of: str = ""
    is_rival: bool = False
    preset: str = ""  # of the parameters whose equations it solves, if not the default ones


@dataclass(frozen=True)
class Quantity:
    """What is judged: relative errors have a floor, absolute ones a unit."""

    name: str
    relative: bool
    floor: float = 0.0  # minimum size an error is referred to
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


def levels(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return every named fidelity that the kernel knows."""
    counted = next((text for text, _ in spec.counted()), "calls")
    return [
        Configuration(
            "fidelity levels", name, "level", name, partial(KernelMethod, spec, name), counted
        )
        for name in spec.levels
    ]


@dataclass(frozen=True)
class Chart:
    """What a model's chart shows."""

    quantities: tuple[Quantity, Quantity]
    cost_of: str  # its axis
    series: Callable[..., list[Configuration]]


WARM = "warm call, 1 % away [s]"
KELVIN = Quantity("temperature", False, unit="K")
LEVELS = Chart((Quantity("friction_torque", True, 1e-4), KELVIN), WARM, levels)


def cases_of(model: str, *, quick: bool = False) -> tuple[ChartCase, ...]:
    """Return the cases of a model, or those of a quick look."""
    given = table_beside(__file__, "cases.toml")[model]
    before = given.get("before", {})
    return tuple(
        ChartCase(name, tuple(point), tuple(map(tuple, before.get(name, ()))))
        for name, point in given["cases"].items()
        if not quick or name in given["few"]
    )


def digest(cases: tuple[ChartCase, ...]) -> str:
    """Return a short digest of a list of cases."""
    text = repr([(c.name, c.point, c.before) for c in cases])
    return hashlib.sha256(text.encode()).hexdigest()[:16]
