"""What a scene and the signals of its run show without a further run: warnings."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ...clutch.parameters import ClutchParams
from ...clutch.release import cold_release
from ...errors import Status
from ...model.registry import outside_laws
from ...numerics.jit import Array
from ..cosim.loop import Recorder
from ..key_figures.events_and_phases import Event, lock_up, locks_of
from ..key_figures.figure_list import KeyFigure
from ..scene.connections import PACKS
from ..scene.doubts import idle_parameters
from ..scene.scene import Scene
from ..warning_texts import scope_of, warnings_of
from .rule_data import run_values, scene_values

Signals = Mapping[str, Array]


def doubts(
    scene: Scene,
    step: float,
    time: Array,
    signals: Signals,
    events: list[Event],
    figures: Sequence[KeyFigure],
) -> Iterator[str]:
    """Yield what must not be missed, a line each."""
    yield from dict.fromkeys((*scene.warnings, *idle_parameters(scene)))
    locks, releases = (
        np.array(x, np.float64) for x in (locks_of(scene, events), _let_go(scene, events))
    )
    run = {
        **scene_values(scene, step),
        **run_values(scene, {f.name: f for f in figures}),
        "time": time,
        "locks": locks,
        "releases": releases,
        "lock_time": lock_up(scene, events),
        "whole": True,
        "laws": [*_of_laws(scene, time, signals)],
    }
    yield from warnings_of("run", scope_of(run, signals))
    yield from _of_cold_packs(scene, time, signals)


def failed_because(scene: Scene, time: Array, recorder: Recorder) -> str:
    """Return what may have made a run fail: nothing pressed at the last point, doubts before it.

    Rows of points that were not reached are NaN.
    """
    signals = recorder.signals()
    done = np.flatnonzero(np.isfinite(signals["transmission.clutch_load"]))
    reasons = list(scene.warnings)
    if len(done):
        n = int(done[-1]) + 1
        run = {
            **scene_values(scene, scene.step),
            **run_values(scene, {}),
            **{"time": time[:n], "lock_time": None, "whole": False},
        }
        reached = {name: values[:n] for name, values in signals.items()}
        if not any(reached[f"transmission.{pack}_locked"][-1] > 0.5 for pack in PACKS):
            reasons = [*warnings_of("failed", scope_of(run, reached)), *reasons]
    return "; ".join(reasons)


def _let_go(scene: Scene, events: list[Event]) -> list[float]:
    """Return when the engaging pack let go [s]."""
    return [e.time for e in events if e.kind == f"{scene.engaging}_released"]


def _of_laws(scene: Scene, time: Array, signals: Signals) -> Iterator[dict[str, Any]]:
    """Yield what a part's own laws say where it first left its verified range; packs have rules."""
    for name, part in scene.parts.items():
        status = signals.get(f"{name}.solver_status")
        if status is None or isinstance(part.params, ClutchParams):
            continue
        for i in np.flatnonzero(status == Status.OUTSIDE_VERIFIED)[:1]:
            inputs = {s.name: float(signals[f"{name}.{s.name}"][i]) for s in part.spec.inputs}
            for line in outside_laws(part.spec.key, part.params, inputs):
                yield {"part": name, "moment": time[i], "line": line}


def _of_cold_packs(scene: Scene, time: Array, signals: Signals) -> Iterator[str]:
    """Yield what packs that let go in cold oil still drag."""
    for pack in PACKS:
        part = scene.parts[pack]
        if isinstance(part.params, ClutchParams):
            names = ("load", "speed", "film_ratio", "energy")
            for line in cold_release(
                part.params,
                part.fidelity,
                time=time,
                **{name: signals[f"{pack}.{name}"] for name in names},
                torque=signals[f"{pack}.friction_torque"],
                oil_temperature=scene.oil_temperature,
            ):
                yield f"The {pack} is {line}"
