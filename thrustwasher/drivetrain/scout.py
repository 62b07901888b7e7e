"""Scout runs: which inputs a part will see, found with cheap rungs and long steps.

A part whose own torque is judged (the washer) takes its cheapest rung that knows speed; the others
keep theirs, which cost microseconds: with settled films in the packs another shift would be seen.
Two runs, one with steps twice as long as the other, tell what the communication step is worth; a
third one with the finest rungs of all other parts tells what theirs are worth.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from ..models._spec import ModelSpec
from .result import ShiftResult
from .scene import Part, Scene
from .selection_record import Box
from .shift import run_shift
from .system import Stepping

CHEAP = ("stribeck", "closed")  # what a scout takes, the first that a part has
DIRECT = ("washer",)  # parts whose own torque is judged, beside what it does to the shift
MARGIN = 0.2  # of the width of the box, added on each side
STRIDE, LEAST_STEPS = 4, 100  # a scout's steps are as many times as long; at least so many steps
Make = Callable[[str, Part], Stepping]


class Pool:
    """Instances by part and rung; one that has been used is reset."""

    def __init__(self, make: Make) -> None:
        self._make = make
        self._made: dict[tuple[str, str], Stepping] = {}

    def take(self, name: str, part: Part) -> Stepping:
        """Return an instance that has not been started."""
        key = name, part.fidelity
        used: Any = self._made.get(key)
        if used is not None and hasattr(used, "reset"):
            used.reset()
        else:
            self._made[key] = self._make(name, part)
        return self._made[key]

    def all_of(self, scene: Scene) -> dict[str, Stepping]:
        """Return an instance for every part of a scene."""
        return {name: self.take(name, part) for name, part in scene.parts.items()}


class Scouted(NamedTuple):
    """What scout runs found; ``coarse`` has steps twice as long as ``fine``."""

    coarse: ShiftResult
    fine: ShiftResult
    trial: ShiftResult | None
    """As ``coarse``, with the finest rungs of parts that are not judged by themselves."""
    seconds: float

    def seen(self, part: str, variable: str) -> tuple[float, float]:
        """Return least and largest value of an input or output in both runs."""
        found = [r.signals[f"{part}.{variable}"] for r in (self.coarse, self.fine)]
        return min(float(v.min()) for v in found), max(float(v.max()) for v in found)

    def box(self, part: str, spec: ModelSpec) -> Box:
        """Return the inputs a part may see: those seen and ``MARGIN`` on each side, if legal."""
        found = {}
        for signal in spec.inputs:
            low, high = self.seen(part, signal.name)
            more = MARGIN * (high - low)
            least = -np.inf if signal.low is None else signal.low
            most = np.inf if signal.high is None else signal.high
            found[signal.name] = max(low - more, least), min(high + more, most)
        return found


def scout(scene: Scene, pool: Pool, compiled: bool | None = None) -> Scouted:
    """Run a scene with cheap rungs and long steps."""
    begin = perf_counter()
    open_ = {name: part.spec for name, part in scene.parts.items() if part.tolerance}
    rungs = {n: _cheap(s) if n in DIRECT else s.default_fidelity for n, s in open_.items()}
    span = scene.stop_time - scene.start_time
    step = min(STRIDE * scene.step, max(scene.step, span / LEAST_STEPS))

    def run(h: float, taken: Mapping[str, str]) -> ShiftResult:
        now = _with_rungs(scene, taken).with_options(step=min(h, span))
        return run_shift(now, pool.all_of(now), compiled=compiled)

    coarse, fine = run(2.0 * step, rungs), run(step, rungs)
    finest = rungs | {n: finest_of(s) for n, s in open_.items() if n not in DIRECT}
    trial = run(2.0 * step, finest) if finest != rungs else None
    return Scouted(coarse, fine, trial, perf_counter() - begin)


def finest_of(spec: ModelSpec) -> str:
    """Return a model's last rung."""
    return list(spec.fidelities)[-1]


def _cheap(spec: ModelSpec) -> str:
    return next((rung for rung in CHEAP if rung in spec.fidelities), spec.default_fidelity)


def _with_rungs(scene: Scene, rungs: Mapping[str, str]) -> Scene:
    """Return the scene with these rungs, as they stand."""
    parts = dict(scene.parts)
    for name, rung in rungs.items():
        parts[name] = replace(parts[name], fidelity=rung, tolerance=None)
    return replace(scene, parts=parts)
