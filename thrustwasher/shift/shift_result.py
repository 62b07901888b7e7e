"""What a shift run leaves: time series, events, energy balance, key figures, cost."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError
from ..shown import Card, Line, Tabled, Words, plain_dict
from ..storage.whole_files import whole_file
from .account.shift_record import record_of
from .account.summary import sentences, warnings_of_result
from .checks.step_estimate import StepError
from .key_figures.events_and_phases import Event, Phase
from .key_figures.figure_list import KeyFigure
from .oscillation.chatter import Chatter
from .oscillation.judder import Judder
from .scene.connections import PARTS
from .scene.scene import Scene
from .scene.scene_file import KnownBand, known_bands
from .tolerance.selection_record import CheckRecord, Selection

# Of a scene, in the JSON of its run.
RAMP = ("oil_temperature", "shift_start", "shift_duration", "shift_from", "shift_to", "engaging")


@dataclass(frozen=True, kw_only=True)
class Cost:
    """What one part cost: times in s of wall clock, share of the whole run."""

    part: str
    model: str
    fidelity: str
    instantiate: float
    initialize: float
    steps: int
    wall_time: float
    share: float


@dataclass(frozen=True, kw_only=True)
class ShiftResult(Tabled):
    """A finished shift, SI units.

    ``signals`` maps "part.variable" to the values at ``time``, for every input and output: an
    output is that at the time point, an input the one used in the step that ends there.
    """

    _index = "time"
    scene: Scene
    step: float  # [s]
    master: str
    time: NDArray[np.float64]
    signals: dict[str, NDArray[np.float64]]
    events: list[Event]
    phases: list[Phase]
    energy: dict[str, float]
    key_figures: list[KeyFigure]
    cost: list[Cost]
    wall_time: float  # [s] of wall clock for all steps, without building and instantiating
    overhead: float  # [s] of it spent by the master itself
    real_time_factor: float  # Simulated time over wall-clock time
    messages: list[str]
    found: tuple[str, ...] = ()
    """What the run and the checks after it found to be doubtful; ``warnings`` has more."""
    step_error: StepError | None = None
    """What the communication step errs by, estimated; None: that was not checked."""
    in_time: Mapping[str, Any] = field(default_factory=dict)
    """Washers taken as steady in the run, followed in time: ``InTime`` by the part's name."""
    guard: CheckRecord | None = None
    """How the chosen levels were checked afterwards, and what was run again; None: they were
    not."""
    judder: Judder | None = None
    """How the output shaft swings while a pack slips; None: it is rigid or does not swing."""
    chatter: Sequence[Chatter] = ()  # Packs whose slip flips from step to step
    selection: Selection | None = None
    """Why the levels are what they are, if they were chosen for a tolerance."""
    said: tuple[str, ...] | None = None
    """The warnings of a shift whose signals were not kept; None: they are read from these."""
    scatter: Any = field(default=None, repr=False)
    """What the scatter of the scene makes of it (``ScatterResult``), if that was studied."""

    @property
    def steps(self) -> int:
        """The number of communication steps."""
        return round(float(self.time[-1] - self.time[0]) / self.step)

    @property
    def figures(self) -> dict[str, float | None]:
        """The key figures by name, SI units; None where there is no such thing."""
        return {figure.name: figure.value for figure in self.key_figures}

    @property
    def known_bands(self) -> dict[str, KnownBand]:
        """Bands of figures by a study made beforehand; only of a built-in scene as it comes."""
        return known_bands(self.scene)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What must not be missed, a line each, the most severe first."""
        return tuple(warnings_of_result(self)) if self.said is None else self.said

    def comparison(self) -> list[dict[str, Any]]:
        """Return the source's values for comparison with this run: one entry per key figure."""
        published = self.scene.published
        if published is None:
            return []
        run = {figure.name: figure for figure in self.key_figures}
        return [
            {
                **{key: getattr(run[name], key) for key in ("name", "text", "unit", "difference")},
                "published": value,
                "run": run[name].value,
            }
            for name, value in published.figures.items()
            if name in run
        ]

    def units(self) -> dict[str, str]:
        """Return the unit of every signal."""
        found = {
            f"{part}.{signal.name}": signal.unit
            for part, spec in PARTS.items()
            for signal in (*spec.inputs, *spec.outputs)
        }
        return {name: found.get(name, "1") for name in self.signals}

    def to_dict(self) -> dict[str, Any]:
        """Return every number but the time series, as JSON can hold it."""
        scene = self.scene
        found: dict[str, Any] = {
            "scene": scene.name,
            **{name: getattr(scene, name) for name in ("title", "start_time", "stop_time")},
            "step": self.step,
            "master": self.master,
            "steps": self.steps,
            **{name: getattr(scene, name) for name in RAMP},
            **self.figures,
            **{f"{f.name}_time": f.time for f in self.key_figures if f.time is not None},
            "published": self.comparison(),
            "energy": self.energy,
            "energy_residual": self.energy["residual"],
            "events": [e._asdict() for e in self.events],
            "phases": [p._asdict() for p in self.phases],
            "cost": [asdict(c) for c in self.cost],
            "wall_time": self.wall_time,
            "master_overhead": self.overhead,
            "real_time_factor": self.real_time_factor,
            "known_bands": {n: b.as_dict() for n, b in self.known_bands.items()},
            "warnings": list(self.warnings),
            "step_error": self.step_error.relative if self.step_error else None,
            "step_errors": self.step_error._asdict() if self.step_error else None,
            "step_advice": self.step_error.advice if self.step_error else None,
            "messages": self.messages,
            "guard": self.guard.as_dict() if self.guard else None,
            "judder": self.judder.as_dict() if self.judder else None,
            "chatter": [c.as_dict() for c in self.chatter],
            "selection": self.selection.as_dict() if self.selection else None,
            "parameters": {name: part.parameters() for name, part in scene.parts.items()},
            **({"scatter": self.scatter.to_dict()} if self.scatter else {}),
        }
        return plain_dict(found)

    def _axes(self) -> tuple[str, ...]:
        return ("time",)

    def _columns(self) -> dict[str, Any]:
        return {"time": self.time, **self.signals}

    def _words(self) -> dict[str, Words]:
        return {"time": Words("s"), **{name: Words(unit) for name, unit in self.units().items()}}

    def _card(self) -> Card:
        record = record_of(self, self.scatter)
        lines = []
        for figure in record.key_figures:
            if figure.value is None:
                continue
            at = [] if figure.time is None else [f"at {figure.time:.4g} s"]
            if (spread := record.spread(figure.name)) is not None:
                low, middle, high = (figure.words(x, 4) for x in spread)
                at.append(f"median {middle}, 5 .. 95 %: {low} .. {high}")
            words = "; ".join((figure.text, *at))
            lines.append(Line(figure.name, figure.words(figure.value, 4), words))
        return Card(self.scene.title, lines, list(sentences(record)), self.warnings)

    def write_csv(self, path: str | Path) -> None:
        """Write time and all signals with a value; heads carry the units. All of it or nothing."""
        target = Path(path)
        units, parts = self.units(), self.scene.parts.items()
        absent = {f"{n}.{own}" for n, p in parts for own in p.spec.absent(p.params)}
        signals = {name: s for name, s in self.signals.items() if name not in absent}
        head = ["time [s]", *(f"{name} [{units[name]}]" for name in signals)]
        columns = [self.time.tolist(), *(s.tolist() for s in signals.values())]
        try:
            target.parent.stat()  # a folder that is missing is not made
            with whole_file(target) as part, part.open("w", encoding="utf-8", newline="\n") as file:
                file.write(",".join(head) + "\n")
                file.writelines(
                    ",".join(map(repr, row)) + "\n" for row in zip(*columns, strict=True)
                )
        except OSError as problem:
            raise ParameterError(
                f"path = {str(target)!r}: cannot be written ({problem.strerror})"
            ) from None
