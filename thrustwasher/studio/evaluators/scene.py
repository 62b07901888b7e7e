"""A gear shift as what is evaluated: figures, outcomes and signals over time at other values.

**Costly** figures are those of the washers: ``costly``; with them, in rows that leave them out, the
outcome ``film_lost`` and the signals ``washer.*`` are NaN. NaN in a row with code 0 says that this
run has no such figure: a shift that does not lock has no lock-up time.

The shortcut of ``scene_runs`` is compared with full runs where values scatter, see
``scene_shortcut``.
Where it errs by more than a tenth of a figure's band all runs are full ones, which a remark says;
then nothing is costly.
"""

import copy
import hashlib
import json
from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from functools import cached_property, partial
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from ...errors import ParameterError, SolveError
from ...fmu.fmu_cache import fmu_paths
from ...fmu.stepper import Instance
from ...model.quantity import Figure, Quantity
from ...model.scatter import Scatter
from ...shift.checks.guard import reset
from ...shift.checks.step_error import recorded_parts, rounded, step_error
from ...shift.checks.step_estimate import StepError, excess
from ...shift.cosim.recorded import Recorded
from ...shift.run import cosimulate
from ...shift.scene.connections import DIRECT
from ...shift.scene.places import scene_places, scene_scatter
from ...shift.scene.scene import Part, Scene
from ...shift.scene.variation import scene_text, varied_scene
from ...shift.shift_result import ShiftResult
from ...shift.tolerance.run_to_tolerance import run_auto, with_levels
from ...units import format_quantity
from ...washer.solve import solve_washer
from .evaluator import Answers, Array, Effort, Remark, Row, efforts
from .scene_figures import (
    LOST,
    WASHER_SERIES,
    figures_of,
    is_of_washers,
    outcomes_of,
    series_of,
    series_values,
    values_of,
)
from .scene_runs import Loop, Signals, followed
from .scene_shortcut import FULL_RUNS, shortcut_errors

SHARE = 0.1  # of a figure's band: an error of the shortcut that is too large
STILL = 1e-4  # of a figure: a band below is none, and less than the error of the step
N_TIME = 131  # instants of the series
NOTABLE = 2.0  # errors of the step that a gain is to exceed
HEAD = "A design of scene {!r}, found by a search"
REASONS = {
    1: "the values do not go together",
    2: "the shift could not be run",
    3: "the washers could not be followed",
}
# Parameters of the transmission that decide on the washers alone.
OF_WASHERS = ("transmission.thrust_share", "transmission.planet_tilt", "transmission.washer_radius")

# Error of the communication step -> figures that it is of, relative; others have its name.
STEP = {
    "heat": ("slip_energy", "slip_energy_per_area"),
    "lock_time": ("lock_time", "lock_after_ramp_start"),
}

Records = dict[tuple[Any, ...], dict[str, Recorded]]


class _Failed(Exception):
    """A run that gives nothing, and why: its code."""

    def __init__(self, code: int) -> None:
        super().__init__(REASONS[code])
        self.code = code


class _Nominal(NamedTuple):
    """What is kept of the run of a scene as it is."""

    scene: Scene
    """With the levels that it ran with."""
    played: dict[str, Any]
    """Its washers as recorded."""
    errors: dict[str, float]
    """Numerical errors of figures, relative."""
    figures: tuple[Figure, ...]
    outcomes: tuple[str, ...]
    series: tuple[str, ...]
    values: Array
    """Figures, outcomes, then signals over time."""


class SceneEvaluator:
    """A scene as what is evaluated; made by ``scene_evaluator``, run as it is when first asked.

    ``played`` are its washers as the nominal run has recorded them; {}: every run is a full one.
    """

    kind: Literal["scene"] = "scene"
    reasons = REASONS
    remarks: tuple[Remark, ...] = ()

    def __init__(self, scene: Scene) -> None:
        self._given, self.name = scene, scene.name
        self._washers = tuple(n for n in DIRECT if n in scene.parts)
        self._loop: Loop | None = None
        self._whole: Loop | None = None
        self._full = False
        self.shortcut: dict[str, float] = {}
        """Its largest error by figure, relative to the band."""
        self.time = np.linspace(scene.start_time, scene.stop_time, N_TIME)

    def __getstate__(self) -> dict[str, Any]:
        """Return what goes to workers: its own run, while instances are made where they run."""
        return self.__dict__ | {"_loop": None, "_whole": None, "_run": self._run}

    @cached_property
    def _run(self) -> _Nominal:
        return _nominal_run(self._given, self._paths, self.time)

    @cached_property
    def _paths(self) -> dict[str, Path]:
        return fmu_paths(sorted({p.spec.name for p in self._given.parts.values()}), "native")

    @cached_property
    def scene(self) -> Scene:
        """The scene with the levels that it runs with."""
        chosen = any(part.tolerance for part in self._given.parts.values())
        return self._run.scene if chosen else _mapless(self._given)

    @property
    def played(self) -> dict[str, Any]:
        """The washers as recorded; {}: runs are full."""
        return {} if self._full else self._run.played

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """Numbers of the scene and choices of its models, by path."""
        return scene_places(self.scene)

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """Key figures of its own run, and outcomes."""
        found = {f.name: f for f in self._run.figures}
        return found | {n: Figure(n, "1", "", kind="outcome") for n in self._run.outcomes}

    @property
    def costly(self) -> tuple[str, ...]:
        """The washers' figures; () where runs are full."""
        return (
            tuple(f.name for f in self._run.figures if is_of_washers(f.name)) if self.played else ()
        )

    @property
    def identity(self) -> dict[str, str]:
        """The scene, its levels, and how its washers are solved."""
        scene = self.scene
        values = {k: getattr(scene, k) for k in ("step", "master", "stop_time")}
        own = json.dumps([scene.table, values], sort_keys=True)
        return {
            "scene": f"{scene.name} {hashlib.sha256(own.encode()).hexdigest()[:16]}",
            "levels": ", ".join(f"{n} {p.fidelity}" for n, p in scene.parts.items()),
            "washers": "apart" if self.played else "in the loop",
        }

    @property
    def signals(self) -> dict[str, str]:
        """Units of the signals over time, by name."""
        known = {
            f"{name}.{s.name}": s.unit
            for name, part in self.scene.parts.items()
            for s in part.spec.outputs
        }
        known["vehicle.acceleration"] = "m/s2"
        return {name: known.get(name, "") for name in self._run.series}

    def touches(self, source: str) -> bool:
        """Tell if any figure but the costly ones depends on a quantity."""
        alone = source in OF_WASHERS or source.partition(".")[0] in self._washers
        return not (self.played and alone)

    def why(self, row: Row) -> str:
        """Return why a row makes no scene; "" if it does."""
        try:
            varied_scene(self.scene, row)
        except ParameterError as problem:
            return str(problem)
        return ""

    def doubts(self, _figures: Sequence[str], _base: Array) -> tuple[str, ...]:
        """Return nothing: the report of the shift itself has the limits of its parts."""
        return ()

    def error(self) -> dict[str, float]:
        """Return the numerical error of figures for which it is known, relative."""
        errors = self._run.errors
        return {f.name: errors[f.name] for f in self._run.figures if f.name in errors}

    def nominal(self, figures: Sequence[str], signals: Sequence[str]) -> Answers:
        """Return the run with all values as they are, its washers solved in every step."""
        return self._chosen(self._run.values[np.newaxis], np.zeros(1, np.int32), figures, signals)

    def evaluate(
        self,
        rows: Sequence[Row],
        figures: Sequence[str],
        effort: Effort | Sequence[Effort] = "search",
        signals: Sequence[str] = (),
    ) -> Answers:
        """Return figures of rows; ``shown``: the washers solved in every step.

        A costly row runs twice, at last with its own washers' torque; later rows with the same
        washers run with that torque, others with that of the nominal run.
        """
        answers = np.full((len(rows), len(self._run.values)), np.nan)
        codes = np.zeros(len(rows), np.int32)
        asks = LOST in figures or any(is_of_washers(name) for name in figures)
        asks = asks or any(name in WASHER_SERIES for name in signals)
        records: Records = {}
        for i, (row, own) in enumerate(zip(rows, efforts(effort, len(rows)), strict=True)):
            try:
                if own == "shown":
                    self._whole = self._whole or self.new_loop({})
                    answers[i] = self.answer(self._whole, row, True, {})
                else:
                    self._loop = self._loop or self.new_loop(self.played)
                    costly = asks and own == "search"
                    answers[i] = self.answer(self._loop, row, costly, records)
            except _Failed as failed:
                codes[i] = failed.code
        return self._chosen(answers, codes, figures, signals)

    def gradient(self, *_: Any) -> None:
        """Return nothing: lock-up and peaks move with every step."""

    def file(self, row: Row, *, draw: bool = False) -> str:
        """Return a file with the scene as its base and the row's values; a draw needs no run."""
        return scene_text(self._given, row) if draw else scene_text(self.scene, row, HEAD)

    def scattered(self, table: Mapping[str, Any] | None = None, row: Row | None = None) -> Scatter:
        """Return how it scatters, at its values or at those of a row."""
        scene = self._given if row is None else varied_scene(self.scene, row)
        return scene_scatter(scene, table)

    def under(self, scatter: Scatter, figures: Sequence[str]) -> "SceneEvaluator":
        """Return it as it is evaluated where this scatters; the shortcut is to serve ``figures``.

        It is measured once per scene and scatter.
        """
        if not (self.played and scatter.sources and figures):
            return self
        error, band = shortcut_errors(self, scatter)
        found = copy.copy(self)
        found._loop = found._whole = None
        found._learn(error, band, figures)
        return found

    def searched(self) -> "SceneEvaluator":
        """Return the same: designs are run as they are."""
        return self

    def shorter_step(
        self, rows: Sequence[Row], figures: Sequence[str], gain: float
    ) -> tuple[float | None, str]:
        """Return the communication step that rows need, None if the scene's does; and a note.

        A search finds the designs in which an error of the step is in its favour; ``gain``: of the
        figure that was searched for, relative; 0: not to be considered.
        """
        jerk = any("jerk" in name for name in figures)
        errors = []
        for row in rows:
            with suppress(ParameterError, SolveError):
                found = self._step_error(row)
                errors.append(found if jerk else found._replace(peak_jerk=None))
        if not errors:
            return None, "the error of the communication step could not be estimated"
        worst = max(errors, key=lambda e: excess(e.errors()))
        at = format_quantity(worst.step, "s", digits=4)
        text = f"with communication steps of {at} the best design errs by about {worst.words()}"
        if lacking := [e.advice for e in errors if not e.suffices]:
            return min(lacking), text
        if 0.0 < gain < NOTABLE * max(worst.errors().values()):
            return rounded(0.5 * self.scene.step), text
        return None, text

    def with_step(self, step: float) -> "SceneEvaluator":
        """Return the scene with another communication step [s]."""
        return scene_evaluator(self.scene.with_options(step=step))

    @property
    def folder(self) -> Path:
        """Where its FMUs lie, by all that they are made of."""
        return next(iter(self._paths.values())).parents[1]

    def new_loop(self, played: Mapping[str, Any]) -> Loop:
        """Return the scene's instances, some of them played."""
        return Loop(self.scene, partial(_instance, self._paths), played)

    def all_answers(self, loop: Loop, rows: Sequence[Row]) -> Array:
        """Return what runs give (n, m), all figures first; NaN where one fails."""
        found = np.full((len(rows), len(self._run.values)), np.nan)
        for i, row in enumerate(rows):
            with suppress(_Failed):
                found[i] = self.answer(loop, row, True, {})
        return found[:, : len(self._run.figures)]

    def _step_error(self, row: Row) -> StepError:
        """Return what the communication step errs by with other values, the washers in the loop.

        ParameterError, SolveError: the scene, or its run with shorter steps, has no end.
        """
        scene = varied_scene(self.scene, row)
        with ExitStack() as alive:
            instances = {
                name: alive.enter_context(_instance(self._paths, name, part))
                for name, part in scene.parts.items()
            }
            return step_error(cosimulate(scene, instances), reset(instances), cosimulate)

    def _learn(self, error: Array, band: Array, figures: Sequence[str]) -> None:
        """Take over what the shortcut errs by, and the band of each figure (m,)."""
        sizes = np.abs(self._run.values[: len(self._run.figures)])
        shares = np.where(band > STILL * sizes, error / np.maximum(band, 1e-300), 0.0)
        named = zip(self._run.figures, shares, strict=True)
        self.shortcut = {f.name: float(x) for f, x in named if f.name in figures}
        worst = sorted(self.shortcut.items(), key=lambda pair: -pair[1])
        shown = ", ".join(f"{name} {100.0 * share:.2g} %" for name, share in worst[:3])
        text = (
            "the washers are solved apart from the rest of the shift; compared with "
            f"{FULL_RUNS} full runs this errs by at most so much of the band: {shown}"
        )
        if worst[0][1] > SHARE:
            self._full = True
            text += f"; above {100.0 * SHARE:g} %, so that all runs are full ones"
            self.remarks = (Remark("warning", text),)
        else:
            self.remarks = (Remark("note", text),)

    def answer(
        self, loop: Loop, row: Mapping[str, object], costly: bool, records: Records
    ) -> Array:
        """Return the row of a run; ``records``: washers that were followed, by their values."""
        own = tuple(x for name, x in row.items() if not self.touches(name))
        code = 1
        try:
            scene = varied_scene(self.scene, row)
            code = 2
            time, signals = loop.run(scene, records.get(own))
            for name in loop.played if costly else ():
                code = 3
                start = [_start(scene, time)]
                washer = followed(scene.parts[name], name, time, signals, start)
                code = 2
                records[own] = recorded_parts(scene, time, signals | washer)
                signals = loop.run(scene, records[own])[1] | washer
        except (ParameterError, SolveError):
            raise _Failed(code) from None
        known = self._run
        names, solved = [f.name for f in known.figures], costly or not loop.played
        return _row(scene, time, signals, names, known.outcomes, known.series, self.time, solved)

    def _chosen(
        self, answers: Array, codes: Any, figures: Sequence[str], signals: Sequence[str]
    ) -> Answers:
        """Return the columns that were requested."""
        names = list(self.figures)
        values = answers[:, [names.index(name) for name in figures]]
        series = answers[:, len(names) :].reshape(len(answers), len(self._run.series), -1)
        own = series[:, [self._run.series.index(name) for name in signals]] if signals else None
        return Answers(values, codes, own)


def scene_evaluator(scene: Scene) -> SceneEvaluator:
    """Return a scene of one shift as what is evaluated.

    ParameterError: it has a sequence of shifts. SolveError, when it is first asked: the run of the
    scene as it is fails.
    """
    if scene.sequence is not None:
        raise ParameterError(f"scene {scene.name!r}: it has a [sequence], allowed: one shift")
    return SceneEvaluator(scene)


def _mapless(scene: Scene) -> Scene:
    """Return a scene without maps, each of which is for one set of parameters."""
    maps = {n: "field" for n in DIRECT if n in scene.parts and scene.parts[n].fidelity == "map"}
    return with_levels(scene, maps)


def _nominal_run(scene: Scene, paths: Mapping[str, Path], at: Array) -> _Nominal:
    """Return the run of a scene as it is, its signals at the instants ``at`` (n_t,) [s].

    SolveError: it fails.
    """
    with ExitStack() as alive:

        def make(name: str, part: Part) -> Instance:
            return alive.enter_context(_instance(paths, name, part))

        if any(part.tolerance for part in scene.parts.values()):
            scene = run_auto(scene, make, guard=False).scene
        scene = _mapless(scene)
        instances = {name: make(name, part) for name, part in scene.parts.items()}
        run = cosimulate(scene, instances)
        errors = {}
        with suppress(ParameterError, SolveError):
            found = step_error(run, reset(instances), cosimulate).errors()
            errors = {n: x for name, x in found.items() for n in STEP.get(name, (name,))}
        errors |= _of_mesh(run)
    time, signals = run.time, run.signals
    figures, outcomes, series = figures_of(run), outcomes_of(scene), series_of(run)
    values = _row(scene, time, signals, [f.name for f in figures], outcomes, series, at, True)
    played = recorded_parts(scene, time, signals)
    return _Nominal(scene, played, errors, figures, outcomes, series, values)


def _row(
    scene: Scene,
    time: Array,
    signals: Signals,
    figures: Sequence[str],
    outcomes: Sequence[str],
    series: Sequence[str],
    at: Array,
    washers: bool,
) -> Array:
    """Return figures, outcomes and signals of a run; NaN of washers that were not solved."""
    row = values_of(scene, time, signals, figures, outcomes)
    found = series_values(scene, time, signals, series, at)
    if not washers:
        row[[n == LOST or is_of_washers(n) for n in (*figures, *outcomes)]] = np.nan
        found[[n in WASHER_SERIES for n in series]] = np.nan
    return np.concatenate((row, found.ravel()))


def _of_mesh(nominal: ShiftResult) -> dict[str, float]:
    """Return the error of the washer's torque by its verification table, if there is one."""
    found: dict[str, float] = {}
    for name in (name for name in DIRECT if name in nominal.scene.parts):
        part, i = nominal.scene.parts[name], _start(nominal.scene, nominal.time)
        point: Any = {
            s.name: float(nominal.signals[f"{name}.{s.name}"][i]) for s in part.spec.inputs
        }
        with suppress(ParameterError, SolveError):
            error = solve_washer(part.params, **point, fidelity=part.fidelity).error_estimate
            found |= {} if error is None else {"washer_torque": error}
    return found


def _start(scene: Scene, time: Array) -> int:
    """Return the point at which the shift begins."""
    return int(np.searchsorted(time, min(scene.shift_start, float(time[-1]))))


def _instance(paths: Mapping[str, Path], name: str, part: Part) -> Instance:
    return Instance(paths[part.spec.name], parameters=part.parameters(), name=name)
