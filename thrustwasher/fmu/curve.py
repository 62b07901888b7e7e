"""The characteristic curve of a model, for the page inside its FMU."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any

from ..models._spec import ModelSpec
from .direct import DirectInstance
from .drawing import Line, drawing
from .interface import variables
from .reference import reference_run

POINTS = 40
MOST = 150  # points of a course over time: enough for the width of the picture
CELSIUS = 273.15  # K


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """One input from ``low`` to ``high``, the others as in ``held``, else at their start.

    ``there_and_back``: up and down again in steps, with memory; otherwise each point is a run that
    starts there.
    """

    title: str
    x: str
    low: float
    high: float
    y: Mapping[str, str]  # output -> what its line is called
    held: Mapping[str, float] = field(default_factory=dict)
    parameters: Mapping[str, Any] = field(default_factory=dict)
    there_and_back: bool = False


SWEEPS = {
    "ThrustWasher": Sweep(
        title="Friction torque over load at 545 rad/s, loaded up and unloaded",
        x="load", low=50.0, high=1200.0, y={"friction_torque": "load rising, load falling"},
        there_and_back=True),
    "WetClutch": Sweep(
        title="Torque over slip at 5 kN, film settled, oil at 80 degC",
        x="speed", low=0.5, high=150.0,
        y={"friction_torque": "all", "contact_torque": "asperities alone"},
        held={"load": 5e3, "oil_temperature": 353.15}, parameters={"starts_pressed": True}),
    "GearMesh": Sweep(
        title="Temperatures where contact starts, over the torque at 180 rad/s",
        x="load", low=2.0, high=80.0,
        y={"temperature": "asperities", "film_temperature": "oil film",
           "surface_temperature": "flank"}, held={"speed": 180.0}),
}  # fmt: skip
# Of models without a sweep: what the reference run is drawn of.
COURSES = {"ShiftTransmission": ("engine_speed", "ring_speed", "output_speed")}


def curve(spec: ModelSpec) -> str:
    """Return a figure with the model's curve; of a model without one, an output over time."""
    sweep = SWEEPS.get(spec.name)
    if not sweep:
        return _course(spec)
    up = [sweep.low + (sweep.high - sweep.low) * i / POINTS for i in range(POINTS + 1)]
    if sweep.there_and_back:
        rows = _stepped(spec, sweep, [*up, *reversed(up)])
        torque = [row[0] for row in rows]
        half = len(up)
        names = next(iter(sweep.y.values())).split(", ")
        lines = [Line(names[0], up, torque[:half]), Line(names[1], up[::-1], torque[half:])]
    else:
        columns = zip(*_started(spec, sweep, up), strict=True)
        named = zip(sweep.y.values(), columns, strict=True)
        lines = [Line(name, up, list(column)) for name, column in named]
    return _drawn(spec, sweep.title, (sweep.x, next(iter(sweep.y))), lines)


def _stepped(spec: ModelSpec, sweep: Sweep, course: Sequence[float]) -> list[list[float]]:
    rows, h = [], spec.step_size
    with DirectInstance(spec, parameters=sweep.parameters) as model:
        point = {s.name: sweep.held.get(s.name, s.start or 0.0) for s in spec.inputs}
        model.initialize(0.0, point | {sweep.x: course[0]})
        for i, value in enumerate(course):
            model.set_inputs([*(point | {sweep.x: value}).values()])
            model.step(i * h, h)
            rows.append(model.get(list(sweep.y)))
    return rows


def _started(spec: ModelSpec, sweep: Sweep, points: Sequence[float]) -> list[list[float]]:
    rows = []
    with DirectInstance(spec, parameters=sweep.parameters) as model:
        for value in points:
            model.reset()
            model.initialize(0.0, {**sweep.held, sweep.x: value})
            rows.append(model.get(list(sweep.y)))
    return rows


def _course(spec: ModelSpec) -> str:
    first = next(s.name for s in spec.outputs if s.kind == "real")
    names = COURSES.get(spec.name, (first,))
    rows = reference_run(spec)
    rows = rows[:: max(1, len(rows) // MOST)]
    places = {s.name: i for i, s in enumerate(spec.outputs, 1)}
    times = [row[0] for row in rows]
    lines = [Line(_words(n), times, [row[places[n]] for row in rows]) for n in names]
    return _drawn(spec, "Course of the default experiment", ("time", names[0]), lines)


def _drawn(spec: ModelSpec, title: str, axes: tuple[str, str], lines: list[Line]) -> str:
    units = {v.name: v.unit for v in variables(spec)}
    x, y = axes
    shown, quantity = units[y], _words(y).rpartition(" ")[2]
    if shown == "K":
        shown, lines = "degC", [Line(n, xs, [v - CELSIUS for v in ys]) for n, xs, ys in lines]
    picture = drawing(title, f"{_words(x)} [{units[x]}]", f"{quantity} [{shown}]", lines)
    return f"<figure>{picture}<figcaption>{escape(title)}</figcaption></figure>"


def _words(name: str) -> str:
    return name.replace("_", " ")
