"""Run several shifts in one: fine steps in each shift's window, long ones between them."""

from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, SolveError
from ..shown import Card, Line, Tabled, Words, plain_dict
from ..transmission.parameters import profile_points
from ..units import format_quantity
from .account.summary import warnings_of_result
from .checks.guard import REMEDY, followed_washers
from .checks.step_error import by_step, parts_of_a_step, recorded_parts
from .checks.step_estimate import StepError, excess
from .checks.washer_in_time import InTime
from .checks.windows import Windows
from .cosim.loop import Drive, driven
from .cosim.system import Stepping, System
from .run import Progress, check_instances, connected
from .scene.connections import COMMAND
from .scene.scene import Scene
from .scene.sequence import sequence_of, shift_scene, times
from .sequence_rows import EveryPoint, FiguresAlone, read_shift
from .shift_result import ShiftResult
from .warning_texts import Ranked

KEEP = ("all", "figures")  # of a run's points
# Input of the transmission -> profile that drives it.
DRIVEN = {
    "clutch_pressure": "clutch_pressure",
    "brake_pressure": "brake_pressure",
    "engine_torque_input": "engine_torque",
}


@dataclass(frozen=True, kw_only=True)
class SequenceResult(Tabled):
    """A finished sequence: the signals of the whole run, and each shift as a result of its own.

    In the shifts, heats and works count from the start of their window. Where figures alone were
    kept, ``time`` and ``signals`` are those at the ends of the windows and where the oil is
    hottest, and the shifts have no signals.
    """

    _index = "time"
    scene: Scene
    time: NDArray[np.float64]
    signals: dict[str, NDArray[np.float64]]
    shifts: list[ShiftResult]
    wall_time: float
    messages: list[str]
    found: tuple[str, ...] = ()
    """What the run and the checks after it found to be doubtful; ``warnings`` has more."""
    steps: int
    """The number of communication steps."""
    step_errors: dict[int, StepError] = field(default_factory=dict)
    """What the step of a window errs by, by the shift's place: the first and the longest one."""
    in_time: Mapping[str, InTime] = field(default_factory=dict)
    """Washers taken as steady in the run, followed in time, by the part's name."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What must not be missed, a line each; of shifts alike, that of the first."""
        return tuple(warnings_of_result(self))

    @property
    def step_error(self) -> StepError | None:
        """The largest estimated error of the step; None if it was not checked."""
        found = self.step_errors.values()
        return max(found, key=lambda e: excess(e.errors())) if found else None

    @property
    def oil_temperature(self) -> NDArray[np.float64]:
        """Temperature of the oil [K] at each time: the sump's, constant without one."""
        constant = np.full(len(self.time), self.scene.oil_temperature)
        return self.signals.get("sump.temperature", constant)

    def to_dict(self) -> dict[str, Any]:
        """Return every number but the time series, as JSON can hold it."""
        oil = self.oil_temperature
        found: dict[str, Any] = {
            "scene": self.scene.name,
            "title": self.scene.title,
            "steps": self.steps,
            "oil_temperature_start": float(oil[0]),
            "oil_temperature_end": float(oil[-1]),
            "oil_temperature_max": float(oil.max()),
            "energy_residual": float(self.signals["transmission.energy_residual"][-1]),
            "shifts": [
                {"time": start, "direction": way, **shift.figures}
                for (start, way), shift in zip(
                    sequence_of(self.scene).shifts, self.shifts, strict=True
                )
            ],
            "warnings": list(self.warnings),
            "step_error": self.step_error.relative if self.step_error else None,
            "step_errors": {str(i): e._asdict() for i, e in self.step_errors.items()},
            "step_advice": min((e.advice for e in self.step_errors.values()), default=None),
            "wall_time": self.wall_time,
            "messages": self.messages,
        }
        return plain_dict(found)

    def _axes(self) -> tuple[str, ...]:
        return ("time",)

    def _columns(self) -> dict[str, Any]:
        return self._whole()._columns()

    def _words(self) -> dict[str, Words]:
        return self._whole()._words()

    def _whole(self) -> ShiftResult:
        """Return the first shift with the signals of the whole run."""
        return replace(self.shifts[0], time=self.time, signals=self.signals)

    def lines(self) -> list[Line]:
        """Return a line per shift: when it begins, when it locks, the heat of its pack."""
        found, ways = [], (way for _, way in sequence_of(self.scene).shifts)
        for i, (shift, way) in enumerate(zip(self.shifts, ways, strict=True), 1):
            lock, heat = (shift.figures[name] for name in ("lock_after_ramp_start", "slip_energy"))
            locked = "does not lock" if lock is None else f"locks {lock:.3f} s after it began"
            begin = f"{i} {way} at {shift.scene.shift_start:.1f} s"
            found.append(Line(begin, f"{1e-3 * (heat or 0.0):.2f} kJ", locked))
        return found

    def _card(self) -> Card:
        oil = " .. ".join(format_quantity(float(t), "K") for t in self.oil_temperature[[0, -1]])
        title = f"{self.scene.title}: {len(self.shifts)} shifts, oil {oil}"
        return Card(title, self.lines(), self.messages, self.warnings)

    def write_csv(self, path: str | Path) -> None:
        """Write time and all signals, as ``ShiftResult.write_csv`` does."""
        self._whole().write_csv(path)


def run_sequence(
    scene: Scene,
    instances: Mapping[str, Stepping],
    *,
    progress: Progress | None = None,
    guard: bool = False,
    keep: str = KEEP[0],
) -> SequenceResult:
    """Simulate all shifts of a scene's ``[sequence]`` with living instances.

    Instances, ``progress`` and errors are those of ``cosimulate``; ParameterError also with another
    master than gauss-seidel, whose torques are not bound to a constant step. ``guard``: check the
    run afterwards; the first and the longest shift run once more from where they began, with
    shorter steps, and washers that were taken as steady are followed in time. ``keep``: "all"
    points, about 2 MB a shift, or the "figures" alone, so that a run of any length fits; figures
    and warnings are the same.
    """
    if keep not in KEEP:
        raise ParameterError(f"keep = {keep!r}, allowed: {' or '.join(map(repr, KEEP))}")
    shifts = [shift_scene(scene, i) for i in range(len(sequence_of(scene).shifts))]
    for shift in shifts:
        shift.check_step()
    if scene.master != "gauss-seidel":
        raise ParameterError(
            f"scene {scene.name!r}: master = {scene.master!r}, allowed with [sequence]: "
            "'gauss-seidel'"
        )
    system = connected(scene, instances)
    drive = _drives(system, shifts)
    drive(scene.start_time, scene.start_time)
    system.initialize(scene.start_time)
    check_instances(scene, instances)
    time = np.array(list(times(scene)))
    windows, steps = Windows(system, shifts if guard else ()), count()
    kept = (
        EveryPoint(system, shifts, time)
        if keep == "all"
        else FiguresAlone(system, shifts, time, followed=guard)
    )

    def one_step(t: float, end: float) -> None:
        done = next(steps)
        if len(kept.shifts) > windows.over:
            windows.over = len(kept.shifts)
            windows.free(but={*kept.whole, windows.over})
        if progress is not None and done and done % 100 == 0:
            progress(done, len(time) - 1)
        windows.pass_by(t)
        drive(t, end)

    begin = perf_counter()
    driven(system, time, one_step, kept.keep)
    points, signals = kept.points()
    result = SequenceResult(
        scene=scene,
        time=points,
        signals=signals,
        wall_time=perf_counter() - begin,
        shifts=kept.shifts,
        messages=[f"first shift: {message}" for message in kept.shifts[0].messages],
        steps=len(time) - 1,
    )
    return _guarded(result, kept, windows, drive) if guard else result


def _guarded(
    result: SequenceResult, kept: EveryPoint, windows: Windows, drive: Drive
) -> SequenceResult:
    """Return a finished sequence with what the checks after it have found."""
    found: list[str] = []
    errors: dict[int, StepError] = {}
    for i, shift in kept.whole.items():
        if not windows.able:
            found.append("The step was not checked: there are parts that cannot save their state")
            break
        try:
            errors[i] = error = by_step(shift, _finer(shift, i, windows, drive))
            found += [Ranked(f"Shift {i + 1}: {text}") for text in error.warnings()]
        except (ParameterError, SolveError) as problem:
            found.append(
                f"The step of shift {i + 1} was not checked: a second run failed ({problem})"
            )
    windows.free()
    followed = followed_washers(result.scene, *kept.watched(), result.scene.step)
    for name, washer in followed.items():
        found += washer.warnings(name, REMEDY)
    return replace(result, found=tuple(found), step_errors=errors, in_time=followed)


def _finer(whole: ShiftResult, i: int, windows: Windows, drive: Drive) -> ShiftResult:
    """Run one shift once more from where it began, with shorter steps."""
    shift = whole.scene
    steps = round(whole.steps * parts_of_a_step(shift, shift.step, whole.steps))
    window = shift.stop_time - shift.start_time
    played = recorded_parts(shift, whole.time, whole.signals)
    time, rows = windows.again(i, window, steps, drive, played)
    return read_shift(replace(shift, step=window / steps), windows.system, time, rows)


def _drives(system: System, shifts: list[Scene]) -> Drive:
    """Return what sets the transmission's inputs for a step: each shift's until the next begins.

    Pressures and the command are those of the step's end, the engine's torque is its mean.
    """
    names, inputs = system.transmission.input_names, system.transmission.inputs
    profiles = [
        {
            name: np.array(profile_points(s.parts["transmission"].params, profile)).T
            for name, profile in DRIVEN.items()
        }
        for s in shifts
    ]

    starts = [shift.start_time for shift in shifts]

    def drive(t: float, end: float) -> None:
        k = max(0, bisect_right(starts, t + 1e-9) - 1)
        inputs[names.index(COMMAND)] = shifts[k].command(end)
        for name, points in profiles[k].items():
            if len(points):
                at = 0.5 * (t + end) if name == "engine_torque_input" else end
                inputs[names.index(name)] = float(np.interp(at, *points))

    return drive
