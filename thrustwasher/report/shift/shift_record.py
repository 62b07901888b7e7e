"""What the report needs from a finished shift, as plain data."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any, NamedTuple, Self

import numpy as np

from ...model.spec import ModelSpec

Array = np.ndarray[Any, Any]
PACKS = ("clutch", "brake")


class Phase(NamedTuple):
    """A stretch of the shift [s]."""

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


class Cost(NamedTuple):
    """What one FMU took: calls, and seconds of wall-clock time."""

    name: str
    fidelity: str
    instantiate: float
    initialize: float
    calls: int
    steps: float


class KeyFigure(NamedTuple):
    """A key figure: value in SI units, None where there is none, and the time [s] it belongs to."""

    name: str
    text: str
    unit: str
    value: float | None
    time: float | None = None
    difference: bool = False  # of temperatures


class Published(NamedTuple):
    """A key figure as a source gives it, beside this run's."""

    name: str
    text: str
    unit: str
    difference: bool
    published: float
    run: float | None


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
    published: Sequence[Published] = ()
    source: str = ""
    parts: Sequence[Part]
    costs: Sequence[Cost]
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
    """Why the rungs are what they are (``shift.tolerance``); None: they were named."""
    guard: Any = None
    """How they were checked after the run, and what was run again; None: they were not."""
    """None: all as long as ``step``."""
    reach: float | None = None
    """Way of the vehicle per angle of the output [m/rad]; None: there is no vehicle."""

    @property
    def figures(self) -> dict[str, float | None]:
        """The key figures by name."""
        return {figure.name: figure.value for figure in self.key_figures}

    def figure(self, name: str) -> KeyFigure | None:
        """Return the key figure of that name, or None."""
        return next((figure for figure in self.key_figures if figure.name == name), None)

    @property
    def releasing(self) -> str:
        """The pack that the ramp lets go."""
        return "brake" if self.engaging == "clutch" else "clutch"

    @property
    def whole_name(self) -> str:
        """What shares of the energy book refer to."""
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

    def window(self, start: float, end: float) -> Self:
        """Return the record between two times [s]; key figures and energy stay those of all."""
        inside = (self.time >= start) & (self.time <= end)
        clipped = (Phase(p.name, max(p.start, start), min(p.end, end)) for p in self.phases)
        return replace(
            self,
            time=self.time[inside],
            signals={name: values[inside] for name, values in self.signals.items()},
            phases=[p for p in clipped if p.end > p.start],
            events=[e for e in self.events if start <= e.time <= end],
        )

    def part(self, name: str) -> Part | None:
        """Return the FMU of that name, or None."""
        return next((part for part in self.parts if part.name == name), None)


def record_of(result: Any) -> Record:
    """Return the result of a shift as plain data."""
    scene = result.scene
    return Record(
        name=scene.name,
        title=scene.title,
        help=" ".join(scene.description.split()),
        engaging=scene.engaging,
        alone=scene.alone,
        ramp_start=scene.shift_start,
        oil_temperature=scene.oil_temperature,
        step=result.step,
        master=result.master,
        time=result.time,
        signals=result.signals,
        phases=[Phase(*phase) for phase in result.phases],
        events=[Event(event.time, event.text) for event in result.events],
        energy=result.energy,
        key_figures=[KeyFigure(*figure) for figure in result.key_figures],
        published=[Published(**entry) for entry in result.comparison()],
        source=scene.published.source if scene.published else "",
        parts=[Part(n, part.spec, part.parameters()) for n, part in scene.parts.items()],
        costs=[
            Cost(c.part, c.fidelity, c.instantiate, c.initialize, c.steps, c.wall_time)
            for c in result.cost
        ],
        wall_time=result.wall_time,
        messages=result.messages,
        found=result.found,
        step_error=result.step_error,
        in_time=result.in_time,
        judder=result.judder,
        chatter=result.chatter,
        selection=result.selection,
        guard=result.guard,
        reach=scene.vehicle.reach if scene.vehicle else None,
    )
