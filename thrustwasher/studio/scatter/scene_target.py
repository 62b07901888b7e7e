"""A gear shift as what a study runs: figures, outcomes and signals over time at other inputs.

**Costly** figures are those of the washers: ``target.costly``; with them, in runs that do not ask
for them, the outcome ``film_lost`` and the series ``washer.*`` are NaN. NaN in a run with code 0
says that this run has no such figure: a shift that does not lock has no lock-up time.

The shortcut of ``scene_runs`` is compared with full runs when the target is made:
``target.shortcut`` has its largest error by figure, ``target.notes`` says it. Where it errs by
more than a tenth of a figure's band all runs are full ones, which ``target.warnings`` says; then
nothing is costly.
"""

import hashlib
import json
import warnings
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, SolveError
from ...fmu.fmu_cache import fmu_paths
from ...fmu.stepper import Instance
from ...model.scatter import Scatter
from ...model.toml_tables import unknown
from ...native.files import write
from ...processes import usable_cores
from ...shift.checks.guard import reset
from ...shift.checks.step_error import recorded_parts, step_error
from ...shift.checks.step_estimate import StepError
from ...shift.cosim.recorded import Recorded
from ...shift.key_figures.figure_list import current
from ...shift.run import cosimulate
from ...shift.scene.connections import DIRECT
from ...shift.scene.places import scene_scatter
from ...shift.scene.scene import Part, Scene
from ...shift.scene.variation import varied_scene
from ...shift.shift_result import ShiftResult
from ...shift.tolerance.run_to_tolerance import run_auto, with_levels
from ...washer.solve import solve_washer
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
from .target import Array, Flags

FULL_RUNS = 16
SHARE = 0.1  # of a figure's band: an error of the shortcut that is too large
STILL = 1e-4  # of a figure: a band below is none, and less than the error of the step
N_TIME = 131  # instants of the series
REASONS = (
    "the values do not go together",
    "the shift could not be run",
    "the washers could not be followed",
)
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
        super().__init__(REASONS[code - 1])
        self.code = code


class SceneTarget:
    """A scene as what is studied; made by ``scene_target``.

    ``played`` are its washers as the nominal run has recorded them; {}: every run is a full one.
    """

    kind: Literal["scene"] = "scene"
    reasons = REASONS
    warnings: tuple[str, ...] = ()
    """What must not be missed, a line each."""
    notes: tuple[str, ...] = ()
    """What else is to be known of its errors."""

    def __init__(
        self, scene: Scene, scatter: Scatter, nominal: ShiftResult, errors: Mapping[str, float]
    ) -> None:
        self.scene, self.scatter, self.name = scene, scatter, scene.name
        self._errors = dict(errors)
        self._washers = tuple(n for n in DIRECT if n in scene.parts)
        self._paths = _paths(scene)
        self._loop: Loop | None = None
        self.played = recorded_parts(scene, nominal.time, nominal.signals)
        self.shortcut: dict[str, float] = {}
        self.time = np.linspace(scene.start_time, scene.stop_time, N_TIME)
        self.figures, self.outcomes = figures_of(nominal), outcomes_of(scene)
        self.series = series_of(nominal)
        self._nominal = self._read(scene, nominal.time, nominal.signals)

    def __getstate__(self) -> dict[str, Any]:
        """Return what goes to workers: instances are made where they run."""
        return self.__dict__ | {"_loop": None}

    @property
    def costly(self) -> tuple[str, ...]:
        """The washers' figures; {} where runs are full."""
        return tuple(f.name for f in self.figures if is_of_washers(f.name)) if self.played else ()

    @property
    def identity(self) -> dict[str, str]:
        """What makes a study of this scene another one."""
        scene = self.scene
        values = {k: getattr(scene, k) for k in ("step", "master", "stop_time")}
        own = json.dumps([scene.table, values], sort_keys=True)
        return {
            "scene": f"{scene.name} {hashlib.sha256(own.encode()).hexdigest()[:16]}",
            "levels": ", ".join(f"{n} {p.fidelity}" for n, p in scene.parts.items()),
            "figures": ", ".join(f.name for f in self.figures),
            "series": ", ".join(self.series),
            "washers": "apart" if self.played else "in the loop",
        }

    @property
    def series_units(self) -> dict[str, str]:
        """Units of the series."""
        known = {
            f"{name}.{s.name}": s.unit
            for name, part in self.scene.parts.items()
            for s in part.spec.outputs
        }
        known["vehicle.acceleration"] = "m/s2"
        return {name: known.get(name, "") for name in self.series}

    def touches(self, source: str) -> bool:
        """Tell if any figure but the costly ones depends on a source."""
        alone = source in OF_WASHERS or source.partition(".")[0] in self._washers
        return not (self.played and alone)

    def why(self, row: Mapping[str, object]) -> str:
        """Return why a row makes no scene; "" if it does."""
        try:
            varied_scene(self.scene, row)
        except ParameterError as problem:
            return str(problem)
        return ""

    def doubts(self, _base: Array) -> Iterator[str]:
        """Yield nothing: the report of the shift itself has the limits of its parts."""
        yield from ()

    def error(self) -> dict[str, float]:
        """Return the numerical error of figures for which it is known, relative."""
        return {f.name: self._errors[f.name] for f in self.figures if f.name in self._errors}

    def nominal(self) -> Array:
        """Return what the run at the nominal values gives, its washers solved in every step."""
        return self._nominal.copy()

    def solve(self, rows: list[dict[str, Any]], costly: NDArray[np.bool_]) -> tuple[Array, Flags]:
        """Return what runs give (n, m) and their codes (n,): figures, outcomes, series.

        A costly row runs twice, at last with its own washers' torque; later rows of the batch with
        the same washers run with that torque, others with that of the nominal run.
        """
        if self._loop is None:
            self._loop = self.new_loop(self.played)
        answers, codes = np.full((len(rows), len(self._nominal)), np.nan), np.zeros(len(rows), int)
        records: Records = {}
        for i, row in enumerate(rows):
            try:
                answers[i] = self._answer(self._loop, row, bool(costly[i]), records)
            except _Failed as failed:
                codes[i] = failed.code
        return answers, codes.astype(np.int32)

    @property
    def folder(self) -> Path:
        """Where its FMUs lie, by all that they are made of."""
        return next(iter(self._paths.values())).parents[1]

    def new_loop(self, played: Mapping[str, Any]) -> Loop:
        """Return the scene's instances, some of them played."""
        return Loop(self.scene, partial(_instance, self._paths), played)

    def answers(self, loop: Loop, rows: Sequence[Mapping[str, object]]) -> Array:
        """Return what runs give (n, m), all figures; NaN where one fails."""
        found = np.full((len(rows), len(self._nominal)), np.nan)
        for i, row in enumerate(rows):
            with suppress(_Failed):
                found[i] = self._answer(loop, row, True, {})
        return found

    def step_error(self, row: Mapping[str, object]) -> StepError:
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

    def keep(self, outputs: Sequence[str]) -> None:
        """Leave out all figures and series but these; ParameterError: there is no such output."""
        known = [*(f.name for f in self.figures), *self.series]
        outputs = [current(name) for name in outputs]
        for name in outputs:
            if name not in known:
                raise unknown(f"scene {self.name!r}: outputs", name, known)
        stay = [f.name in outputs for f in self.figures] + [True] * len(self.outcomes)
        stay += [name in outputs for name in self.series for _ in self.time]
        self.figures = tuple(f for f in self.figures if f.name in outputs)
        self.series = tuple(name for name in self.series if name in outputs)
        self._nominal = self._nominal[np.array(stay)]

    def learn(self, error: Array, band: Array) -> None:
        """Take over what the shortcut errs by, and the band of each figure (m,)."""
        sizes = np.abs(self._nominal[: len(self.figures)])
        shares = np.where(band > STILL * sizes, error / np.maximum(band, 1e-300), 0.0)
        self.shortcut = {f.name: float(x) for f, x in zip(self.figures, shares, strict=True)}
        worst = sorted(self.shortcut.items(), key=lambda pair: -pair[1])
        shown = ", ".join(f"{name} {100.0 * share:.2g} %" for name, share in worst[:3])
        text = (
            "the washers are solved apart from the rest of the shift; compared with "
            f"{FULL_RUNS} full runs this errs by at most so much of the band: {shown}"
        )
        if worst[0][1] > SHARE:
            self.played = {}
            text += f"; above {100.0 * SHARE:g} %, so that all runs are full ones"
            self.warnings, self.notes = (text,), ()
        else:
            self.notes = (text,)

    def _answer(
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
        return self._read(scene, time, signals, washers=costly or not loop.played)

    def _read(self, scene: Scene, time: Array, signals: Signals, washers: bool = True) -> Array:
        names = tuple(f.name for f in self.figures)
        row = values_of(scene, time, signals, names, self.outcomes)
        series = series_values(scene, time, signals, self.series, self.time)
        if not washers:
            row[[n == LOST or is_of_washers(n) for n in (*names, *self.outcomes)]] = np.nan
            series[[n in WASHER_SERIES for n in self.series]] = np.nan
        return np.concatenate((row, series.ravel()))


def scene_target(
    scene: Scene, scatter: Scatter | None = None, outputs: Sequence[str] | None = None
) -> SceneTarget:
    """Return a scene as what is studied, after its nominal run and 16 draws run both ways.

    Parameters
    ----------
    scene : one shift, as ``load_scene`` returns it
    scatter : what scatters; None: what the scene and its parts say
    outputs : names of figures and series; None: all that the nominal run has

    Raises
    ------
    ParameterError : it has a sequence of shifts, or no such output
    SolveError : the nominal run fails
    """
    if scene.sequence is not None:
        raise ParameterError(f"scene {scene.name!r}: it has a [sequence], allowed: one shift")
    scatter = scene_scatter(scene) if scatter is None else scatter
    with ExitStack() as alive:
        paths = _paths(scene)

        def make(name: str, part: Part) -> Instance:
            return alive.enter_context(_instance(paths, name, part))

        if any(part.tolerance for part in scene.parts.values()):
            scene = run_auto(scene, make, guard=False).scene
        # A map is for one set of parameters.
        maps = {n: "field" for n in DIRECT if n in scene.parts and scene.parts[n].fidelity == "map"}
        scene = with_levels(scene, maps)
        instances = {name: make(name, part) for name, part in scene.parts.items()}
        nominal = cosimulate(scene, instances)
        errors = {}
        with suppress(ParameterError, SolveError):
            found = step_error(nominal, reset(instances), cosimulate).errors()
            errors = {n: x for name, x in found.items() for n in STEP.get(name, (name,))}
        errors |= _of_mesh(nominal)
    target = SceneTarget(scene, scatter, nominal, errors)
    if outputs is not None:
        target.keep(outputs)
    if target.played and scatter.sources and target.figures:
        _compare(target)
    return target


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


def _compare(target: SceneTarget) -> None:
    """Let the target know what the shortcut errs by; it is measured once per scene and scatter."""
    from scipy.stats import qmc  # late: it takes a third of a second

    points = qmc.Sobol(len(target.scatter.sources), seed=np.random.default_rng(0))
    rows = target.scatter.values(points.random(FULL_RUNS))
    own = json.dumps([target.identity, rows]).encode()
    file = target.folder / f"shortcut-{hashlib.sha256(own).hexdigest()[:16]}.json"
    try:
        error, band = json.loads(file.read_text("utf-8"))
    except (OSError, ValueError):
        error, band = (x.tolist() for x in _measured(target, rows))
        with suppress(OSError):
            write(file, json.dumps([error, band]).encode())
    target.learn(np.array(error), np.array(band))


def _measured(target: SceneTarget, rows: list[dict[str, Any]]) -> tuple[Array, Array]:
    """Return the largest error of the shortcut and the band, of each figure (m,), by full runs."""
    n = min(usable_cores(), len(rows))
    parts = [slice(i, None, n) for i in range(n)]
    loops = [(target.new_loop(target.played), target.new_loop({})) for _ in parts]
    both = np.empty((2, len(rows), len(target.nominal())))

    def run(part: slice, own: tuple[Loop, Loop]) -> None:
        for k, loop in enumerate(own):
            both[k, part] = target.answers(loop, rows[part])

    with ThreadPoolExecutor(n) as pool:
        list(pool.map(run, parts, loops))
    for pair in loops:
        for loop in pair:
            loop.close()
    short, full = both[:, :, : len(target.figures)]
    with warnings.catch_warnings():  # a figure may be absent in all of these runs
        warnings.simplefilter("ignore", RuntimeWarning)
        band = np.nan_to_num(np.nanmax(full, 0) - np.nanmin(full, 0))
        error = np.nan_to_num(np.nanmax(np.abs(short - full), 0))
    one_alone = (np.isnan(short) != np.isnan(full)).any(0)  # as a lock-up that the other lacks
    return np.where(one_alone, band, error), band


def _start(scene: Scene, time: Array) -> int:
    """Return the point at which the shift begins."""
    return int(np.searchsorted(time, min(scene.shift_start, float(time[-1]))))


def _paths(scene: Scene) -> dict[str, Path]:
    return fmu_paths(sorted({p.spec.name for p in scene.parts.values()}), "native")


def _instance(paths: Mapping[str, Path], name: str, part: Part) -> Instance:
    return Instance(paths[part.spec.name], parameters=part.parameters(), name=name)
