"""A gear shift as what a study runs: figures, outcomes and signals over time at other inputs.

**Costly** figures are those of the washers: ``target.costly``; with them, in runs that do not ask
for them, the outcome ``film_lost`` and the series ``washer.*`` are NaN. NaN in a run with code 0
says that this run has no such figure: a shift that does not lock has no lock-up time.

The shortcut of ``scene_runs`` is compared with full runs when the target is made:
``target.shortcut`` has its largest error by figure, ``target.warnings`` says it. Where it errs by
more than a tenth of a figure's band all runs are full ones; then nothing is costly.
"""

import hashlib
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, SolveError
from ..fmu.fmu_cache import fmu_paths
from ..fmu.stepper import Instance
from ..model.scatter import Scatter
from ..model.toml_tables import unknown
from ..processes import usable_cores
from ..report.shift.usual import ranges
from ..shift.checks.guard import reset
from ..shift.checks.step_error import recorded_parts, step_error
from ..shift.cosim.recorded import Recorded
from ..shift.key_figures.events_and_phases import find_events, turning
from ..shift.key_figures.figure_list import FIGURES
from ..shift.key_figures.key_figures import key_figures
from ..shift.run import run_shift
from ..shift.scene.connections import DIRECT, MESHES
from ..shift.scene.places import scene_scatter
from ..shift.scene.scene import Part, Scene
from ..shift.scene.variation import varied_scene
from ..shift.shift_result import ShiftResult
from ..shift.tolerance.run_to_tolerance import run_auto, with_rungs
from .scene_runs import Loop, Signals, followed
from .target import Array, Figure, Flags

FULL_RUNS = 16
SHARE = 0.1  # of a figure's band: an error of the shortcut that is too large
STILL = 1e-6  # of a figure: a band below is none
N_TIME = 131  # instants of the series
REASONS = (
    "the values do not go together",
    "the shift could not be run",
    "the washers could not be followed",
)
# Parameters of the transmission that decide on the washers alone.
OF_WASHERS = ("transmission.thrust_share", "transmission.planet_tilt", "transmission.washer_radius")
WASHER_SERIES = ("washer.friction_torque", "washer.film_ratio")
SERIES = (
    "transmission.clutch_reaction",
    "transmission.brake_reaction",
    "vehicle.acceleration",
    "transmission.output_torque",
    "transmission.engine_speed",
    "clutch.temperature",
    *WASHER_SERIES,
)
# As the shift begins: name -> signal, words, unit.
AT_START = {
    "washer_torque": (
        "washer.friction_torque",
        "washer, friction torque as the shift begins",
        "N.m",
    ),
    "washer_film_ratio": ("washer.film_ratio", "washer, film ratio as the shift begins", "1"),
}
SAFETIES = ("pitting_safety", "scuffing_safety", "micropitting_safety")
# Error of the communication step -> figure.
STEP = {"heat": "slip_energy"}
# Key figure -> figure of ``report.shift.usual``, where the names differ.
USUAL = {"least_pitting_safety": "pitting_safety", "least_scuffing_safety": "scuffing_safety"}


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
    """What must not be missed, a line each: what the shortcut errs by among them."""

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
        self._meshes = [n for n in MESHES if n in scene.parts and _safeties(scene.parts[n])]
        self.figures = tuple(_figures(nominal))
        known = {*nominal.signals, *(["vehicle.acceleration"] if scene.vehicle else [])}
        left = "transmission.output_torque" if scene.vehicle else ""
        self.series = tuple(n for n in SERIES if n in known and n != left)
        self._nominal = self._read(scene, nominal.time, nominal.signals)

    def __getstate__(self) -> dict[str, Any]:
        """Return what goes to workers: instances are made where they run."""
        return self.__dict__ | {"_loop": None}

    @property
    def outcomes(self) -> tuple[str, ...]:
        """What a run says yes or no to."""
        lost = ("film_lost",) if self._washers else ()
        return (*lost, *(f"{n}_safety_below_1" for n in self._meshes), "no_lock_up")

    @property
    def costly(self) -> tuple[str, ...]:
        """The washers' figures; {} where runs are full."""
        return tuple(f.name for f in self.figures if _of_washers(f.name)) if self.played else ()

    @property
    def identity(self) -> dict[str, str]:
        """What makes a study of this scene another one."""
        scene = self.scene
        values = {k: getattr(scene, k) for k in ("step", "master", "stop_time")}
        own = json.dumps([scene.table, values], sort_keys=True)
        return {
            "scene": f"{scene.name} {hashlib.sha256(own.encode()).hexdigest()[:16]}",
            "rungs": ", ".join(f"{n} {p.fidelity}" for n, p in scene.parts.items()),
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

    def new_loop(self, played: Mapping[str, Any]) -> Loop:
        """Return the scene's instances, some of them played."""
        return Loop(self.scene, partial(_instance, self._paths), played)

    def answers(self, loop: Loop, rows: Sequence[Mapping[str, Any]]) -> Array:
        """Return what runs give (n, m), all figures; NaN where one fails."""
        found = np.full((len(rows), len(self._nominal)), np.nan)
        for i, row in enumerate(rows):
            with suppress(_Failed):
                found[i] = self._answer(loop, row, True, {})
        return found

    def keep(self, outputs: Sequence[str]) -> None:
        """Leave out all figures and series but these; ParameterError: there is no such output."""
        known = [*(f.name for f in self.figures), *self.series]
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
        self.warnings = (text,)

    def _answer(self, loop: Loop, row: Mapping[str, Any], costly: bool, records: Records) -> Array:
        """Return the row of a run; ``records``: washers that were followed, by their values."""
        own = tuple(x for name, x in row.items() if not self.touches(name))
        code = 1
        try:
            scene = varied_scene(self.scene, row)
            code = 2
            time, signals = loop.run(scene, records.get(own))
            for name in loop.played if costly else ():
                code = 3
                start = int(np.searchsorted(time, min(scene.shift_start, time[-1])))
                washer = followed(scene.parts[name], name, time, signals, [start])
                code = 2
                records[own] = recorded_parts(scene, time, signals | washer)
                signals = loop.run(scene, records[own])[1] | washer
        except (ParameterError, SolveError):
            raise _Failed(code) from None
        return self._read(scene, time, signals, washers=costly or not loop.played)

    def _read(self, scene: Scene, time: Array, signals: Signals, washers: bool = True) -> Array:
        """Return figures, outcomes and series of a run; without ``washers`` theirs are NaN."""
        events = find_events(scene, time, signals)
        found = {f.name: f.value for f in key_figures(scene, time, signals, events)}
        found |= {
            name: float(np.interp(scene.shift_start, time, signals[signal]))
            for name, (signal, *_) in AT_START.items()
            if signal in signals
        }
        there = [f.name for f in self.figures if washers or not _of_washers(f.name)]
        row = [found.get(f.name) if f.name in there else None for f in self.figures]
        if self._washers:
            lost = bool(((signals["washer.distress"] > 0.5) & turning(signals)).any())
            row.append(float(lost) if washers else None)
        row += [float(_unsafe(scene.parts[n], n, signals)) for n in self._meshes]
        row.append(float(found["lock_time"] is None))
        values = [np.array([math.nan if x is None else x for x in row])]
        for name in self.series:
            if name in WASHER_SERIES and not washers:
                values.append(np.full(N_TIME, np.nan))
            elif name == "vehicle.acceleration":
                assert scene.vehicle is not None
                felt = scene.vehicle.reach * signals["transmission.output_acceleration"]
                values.append(np.interp(self.time, time, felt))
            else:
                values.append(np.interp(self.time, time, signals[name]))
        return np.concatenate(values)


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
        scene = with_rungs(scene, maps)
        instances = {name: make(name, part) for name, part in scene.parts.items()}
        nominal = run_shift(scene, instances)
        try:
            step = step_error(nominal, reset(instances), run_shift).errors()
        except (ParameterError, SolveError):
            step = {}
    target = SceneTarget(scene, scatter, nominal, {STEP.get(n, n): x for n, x in step.items()})
    if outputs is not None:
        target.keep(outputs)
    if target.played and scatter.sources:
        _compare(target)
    return target


def _compare(target: SceneTarget) -> None:
    """Find what the shortcut errs by; where that is too much let all runs be full ones."""
    from scipy.stats import qmc  # late: it takes a third of a second

    points = qmc.Sobol(len(target.scatter.sources), seed=np.random.default_rng(0))
    rows = target.scatter.values(points.random(FULL_RUNS))
    n = min(usable_cores(), FULL_RUNS)
    parts = [slice(i, None, n) for i in range(n)]
    loops = [(target.new_loop(target.played), target.new_loop({})) for _ in parts]
    both = np.empty((2, FULL_RUNS, len(target.nominal())))

    def run(part: slice, own: tuple[Loop, Loop]) -> None:
        for k, loop in enumerate(own):
            both[k, part] = target.answers(loop, rows[part])

    with ThreadPoolExecutor(n) as pool:
        list(pool.map(run, parts, loops))
    for pair in loops:
        for loop in pair:
            loop.close()
    n_figures = len(target.figures)
    short, full = both[:, :, :n_figures]
    band = np.nanmax(full, 0) - np.nanmin(full, 0)
    error = np.nanmax(np.abs(short - full), 0)
    target.learn(error, band)


def _paths(scene: Scene) -> dict[str, Path]:
    return fmu_paths(sorted({p.spec.name for p in scene.parts.values()}), "native")


def _instance(paths: Mapping[str, Path], name: str, part: Part) -> Instance:
    return Instance(paths[part.spec.name], parameters=part.parameters(), name=name)


def _of_washers(figure: str) -> bool:
    """Tell if a figure depends on what washers do, or on what decides on them alone."""
    reading = FIGURES[figure].reading.split() if figure in FIGURES else []
    signal = reading[1] if reading else ""
    return (
        figure in AT_START
        or figure == "washer_distress_time"
        or signal.startswith("washer.")
        or signal == "transmission.washer_load"
    )


def _figures(nominal: ShiftResult) -> Iterator[Figure]:
    """Yield the figures that the nominal run has; a swing of the shaft is not looked for."""
    pack, usual = nominal.scene.engaging, ranges()
    for f in nominal.key_figures:
        if f.value is None or f.name.startswith("judder_"):
            continue
        key = USUAL.get(f.name, f.name)
        known = usual.get(key) or usual.get(key.replace(f"_{pack}_", "_{pack}_"))
        low, high = known.range if known else (-math.inf, math.inf)
        scale = known.scale if known else 1.0
        yield Figure(f.name, f.unit, f.text, low * scale, high * scale, f.difference)
    for name, (signal, words, unit) in AT_START.items():
        if signal in nominal.signals:
            yield Figure(name, unit, words)


def _safeties(part: Part) -> list[str]:
    """Return the safeties that a mesh has a value of."""
    outputs = {s.name for s in part.spec.outputs} - part.spec.absent(part.params)
    return [name for name in SAFETIES if name in outputs]


def _unsafe(part: Part, name: str, signals: Signals) -> bool:
    return any(bool((signals[f"{name}.{s}"] < 1.0).any()) for s in _safeties(part))
