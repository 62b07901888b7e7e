"""A finished shift as plain data: what sentences, reports and pages are made of."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple

import numpy as np

from ...model.spec import ModelSpec
from ...units import format_quantity, format_time

Array = np.ndarray[Any, Any]
PACKS = ("clutch", "brake")


class Phase(NamedTuple):
    """An interval of the shift [s]."""

    name: str
    start: float
    end: float


class Event(NamedTuple):
    """Something that happened at one time [s]."""

    time: float
    text: str


class Part(NamedTuple):
    """One FMU of the run: its name in the scene, its model, its parameters and fidelity."""

    name: str
    spec: ModelSpec
    parameters: Mapping[str, Any]

    def params(self) -> Any:
        """Return its parameters as its model takes them."""
        known = {f.name for f in fields(self.spec.params)}
        return self.spec.params(**{k: v for k, v in self.parameters.items() if k in known})


class KeyFigure(NamedTuple):
    """A key figure: value in SI units, None where there is none, and the time [s] it belongs to."""

    name: str
    text: str
    unit: str
    value: float | None
    time: float | None = None
    difference: bool = False  # of temperatures

    def words(self, value: float, digits: int) -> str:
        """Return a value of this figure with its unit; times stay in seconds."""
        if self.unit == "s":
            return format_time(value, digits)
        return format_quantity(value, self.unit, digits=digits, difference=self.difference)


# Fields of a record that are those of the shift's result.
OF_THE_RESULT = (
    *("step", "master", "time", "signals", "phases", "events", "energy", "cost"),
    *("wall_time", "messages", "found", "step_error", "in_time", "judder", "chatter"),
    *("selection", "guard"),
)


@dataclass(frozen=True, kw_only=True)
class Record:
    """A finished shift; ``signals`` maps "part.variable" to values at ``time``, SI units.

    ``engaging`` is the pack that the ramp presses; ``alone`` says that nothing else acts, neither
    engine nor load nor the other pack.
    """

    name: str
    title: str
    help: str
    engaging: str = "clutch"
    alone: bool = False
    ramp_start: float
    oil_temperature: float
    step: float
    master: str
    time: Array
    signals: Mapping[str, Array]
    phases: Sequence[Phase]
    events: Sequence[Event]
    energy: Mapping[str, float]
    key_figures: Sequence[KeyFigure]
    published: Sequence[Mapping[str, Any]] = ()
    """Key figures as a source gives them, against this run's: ``ShiftResult.comparison``."""
    source: str = ""
    parts: Sequence[Part]
    cost: Sequence[Any]
    """What each FMU took (``shift.shift_result.Cost``)."""
    wall_time: float
    messages: Sequence[str] = ()
    found: Sequence[str] = ()
    """Warnings of the run and of the checks after it."""
    step_error: Any = None
    """What the communication step errs by (``shift.checks.step_estimate``); None: not checked."""
    in_time: Mapping[str, Any] = field(default_factory=dict)
    """Washers taken as steady, followed in time (``shift.checks.washer_in_time``), if checked."""
    judder: Any = None
    """How the output shaft swings (``shift.oscillation.judder.Judder``); None: not at all."""
    chatter: Sequence[Any] = ()
    """Packs whose slip flips from step to step (``shift.oscillation.chatter.Chatter``)."""
    selection: Any = None
    """Why the levels are what they are (``shift.tolerance``); None: they were named."""
    guard: Any = None
    """How they were checked after the run, and what was run again; None: they were not."""
    reach: float | None = None
    """Way of the vehicle per angle of the output [m/rad]; None: there is no vehicle."""
    scatter: Any = None
    """What the scatter of inputs makes of it, if studied (``studio.scatter.result``)."""
    known: Mapping[str, Any] = field(default_factory=dict)
    """Bands of figures that are known of a built-in scene (``ShiftResult.known_bands``)."""

    @property
    def figures(self) -> dict[str, float | None]:
        """The key figures by name."""
        return {figure.name: figure.value for figure in self.key_figures}

    def figure(self, name: str) -> KeyFigure | None:
        """Return the key figure of that name, or None."""
        return next((figure for figure in self.key_figures if figure.name == name), None)

    def band(self, name: str) -> Any:
        """Return what a study says of a figure, also as the minimum of its kind; None: nothing."""
        found = self.band_name(name)
        return self.scatter.figures[found] if found else None

    def band_name(self, name: str) -> str:
        """Return a figure's name in a study; "" where none has it."""
        known = self.scatter.figures if self.scatter else {}
        return next((n for n in (name, f"minimum_{name}") if n in known), "")

    def spread(self, name: str) -> tuple[float, float, float] | None:
        """Return 5, 50 and 95 % quantile of a figure, by a study or known of its scene, or None."""
        found = self.band(name) or self.known.get(name)
        low, middle, high = (
            found.quantiles.get(q, math.nan) if found else math.nan for q in (0.05, 0.5, 0.95)
        )
        return (low, middle, high) if low < high and math.isfinite(middle) else None

    @property
    def releasing(self) -> str:
        """The pack that the ramp lets go."""
        return "brake" if self.engaging == "clutch" else "clutch"

    @property
    def whole_name(self) -> str:
        """What shares of the energy balance refer to."""
        return "the engine's work" if self.energy["engine_work"] else "the kinetic energy"

    @property
    def sticks_and_slips(self) -> bool:
        """Whether the engaging pack sticks and slips in turn at the end."""
        return bool(self.phases) and self.phases[-1].name == "stick-slip"

    @property
    def rated_teeth(self) -> bool:
        """Whether there are teeth whose safeties count, those heated by their own loss."""
        mesh = self.part("mesh")
        return mesh is not None and mesh.params().film_heat == "loss"

    def presses(self, pack: str) -> bool:
        """Return whether a pack is pressed at any time of the run."""
        load = self.series(f"{pack}.load")
        return load is None or bool(np.any(load > 0.0))

    def series(self, name: str) -> Array | None:
        """Return a signal, or None if this run has none of that name."""
        values = self.signals.get(name)
        return None if values is None else np.asarray(values, dtype=float)

    def at(self, name: str, time: float) -> float | None:
        """Return a signal at the last recorded time that is not later."""
        values = self.series(name)
        if values is None:
            return None
        index = int(np.searchsorted(self.time, time, side="right")) - 1
        return float(values[max(index, 0)])

    def part(self, name: str) -> Part | None:
        """Return the FMU of that name, or None."""
        return next((part for part in self.parts if part.name == name), None)


def record_of(result: Any, scatter: Any = None) -> Record:
    """Return the result of a shift, and of a study of its scene, as plain data."""
    scene = result.scene
    return Record(
        name=scene.name,
        title=scene.title,
        help=" ".join(scene.description.split()),
        engaging=scene.engaging,
        alone=scene.alone,
        ramp_start=scene.shift_start,
        oil_temperature=scene.oil_temperature,
        key_figures=[KeyFigure(*figure) for figure in result.key_figures],
        published=result.comparison(),
        source=scene.published.source if scene.published else "",
        parts=[Part(n, part.spec, part.parameters()) for n, part in scene.parts.items()],
        reach=scene.vehicle.reach if scene.vehicle else None,
        scatter=scatter,
        known={} if scatter else result.known_bands,
        **{name: getattr(result, name) for name in OF_THE_RESULT},
    )
