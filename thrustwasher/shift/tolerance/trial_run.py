"""Trial runs: which inputs a part will see, found with cheap rungs and long steps.

A part whose own torque is judged (the washer) takes its map if it has one, else its first mesh; the
others keep theirs, which cost microseconds: with settled films in the packs another shift would be
seen. Two runs, one with steps twice as long as the other, tell what the communication step is
worth; a third one with the finest rungs of all other parts tells what theirs are worth.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from ...ladder.card import fresh_cards
from ...model.spec import ModelSpec
from ..cosim.system import Stepping
from ..run import run_shift
from ..scene.connections import DIRECT
from ..scene.scene import STEP_RANGE, Part, Scene
from ..shift_result import ShiftResult
from .selection_record import Box, StepShare

MARGIN = 0.2  # of the width of the box, added on each side
STRIDE, LEAST_STEPS = 4, 100  # a trial's steps are as many times as long; at least so many steps
ORDER = 1.0  # taken for all figures: steps of packs couple with 2, of parts that drag with 1
FIGURES = ("slip_energy", "lock_time")  # that do not forget
PEAKS = ("peak_clutch_temperature", "peak_brake_temperature")
LEAST_RISE = 1.0  # K
HEATS = ("washers", "meshes")  # of the energy balance
Make = Callable[[str, Part], Stepping]


class Pool:
    """Instances by part, rung and parameters; one that has been used is reset."""

    def __init__(self, make: Make) -> None:
        self._make = make
        self._made: dict[tuple[str, str, Any], Stepping] = {}

    def take(self, name: str, part: Part) -> Stepping:
        """Return an instance that has not been started."""
        key = name, part.fidelity, part.params
        used: Any = self._made.get(key)
        if used is not None and hasattr(used, "reset"):
            used.reset()
        else:
            self._made[key] = self._make(name, part)
        return self._made[key]

    def all_of(self, scene: Scene) -> dict[str, Stepping]:
        """Return an instance for every part of a scene."""
        return self.all_but(scene, {})

    def all_but(self, scene: Scene, given: Mapping[str, Stepping]) -> dict[str, Stepping]:
        """Return an instance for every part of a scene, those that are given as they are."""
        return {n: given.get(n) or self.take(n, part) for n, part in scene.parts.items()}


class TrialRuns(NamedTuple):
    """What trial runs found; ``coarse`` has steps twice as long as ``fine``."""

    coarse: ShiftResult
    fine: ShiftResult
    finest: ShiftResult | None
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


def trial_runs(scene: Scene, pool: Pool, compiled: bool | None = None) -> TrialRuns:
    """Run a scene with cheap rungs and long steps."""
    begin = perf_counter()
    open_ = {name: part.spec for name, part in scene.parts.items() if part.tolerance}
    rungs = {n: cheap_rung(n, scene.parts[n]) for n in open_}
    span = scene.stop_time - scene.start_time
    most = min(STEP_RANGE[1], scene.longest_step) / 2.0
    step = min(STRIDE * scene.step, max(scene.step, span / LEAST_STEPS), most)

    def run(h: float, taken: Mapping[str, str]) -> ShiftResult:
        now = with_rungs(scene, taken).with_options(step=min(h, span))
        return run_shift(now, pool.all_of(now), compiled=compiled)

    coarse, fine = run(2.0 * step, rungs), run(step, rungs)
    finest = rungs | {n: finest_of(s) for n, s in open_.items() if n not in DIRECT}
    found = run(2.0 * step, finest) if finest != rungs else None
    return TrialRuns(coarse, fine, found, perf_counter() - begin)


def cheap_rung(name: str, part: Part) -> str:
    """Return the rung for trial runs: of a washer its map, if a card knows one, or its default."""
    known = name in DIRECT and fresh_cards(part.spec.key, "map", part.params)
    return "map" if known else part.spec.default_fidelity


def finest_of(spec: ModelSpec) -> str:
    """Return a model's last rung."""
    return list(spec.fidelities)[-1]


def with_rungs(scene: Scene, rungs: Mapping[str, str]) -> Scene:
    """Return the scene with these rungs, as they stand."""
    changed = {name: scene.parts[name].at(rung) for name, rung in rungs.items()}
    return replace(scene, parts={**scene.parts, **changed})


def farthest(run: ShiftResult, other: ShiftResult) -> tuple[float, str]:
    """Return the largest difference of two runs in what a shift is judged by, and in what.

    A share of the other run's figure; of a temperature: of the hottest pack's rise above the oil,
    at least 1 K. Infinite where only one of the runs has a figure.
    """
    mine, its = run.figures, other.figures
    rise = max([LEAST_RISE, *((its.get(p) or 0.0) - other.scene.oil_temperature for p in PEAKS)])
    pairs = [(n, mine.get(n), its.get(n), 0.0) for n in FIGURES]
    pairs += [(p, mine.get(p), its.get(p), rise) for p in PEAKS]
    pairs += [(f"heat of the {n}", run.energy[n], other.energy[n], 0.0) for n in HEATS]
    return max((_apart(a, b, scale), name) for name, a, b, scale in pairs)


def step_share(trials: TrialRuns, step: float, tolerance: float) -> StepShare:
    """Return the error of a step, from the difference of the trial runs and the least order."""
    coarse, fine = trials.coarse, trials.fine
    error, figure = farthest(coarse, fine)
    scale = (step / fine.step) ** ORDER / ((coarse.step / fine.step) ** ORDER - 1.0)
    return StepShare(step, tolerance, error * scale, figure)


def _apart(a: float | None, b: float | None, scale: float) -> float:
    """Return the difference of two values over ``scale`` or, if that is 0, over the second."""
    if a is None or b is None:
        return 0.0 if a is b else math.inf
    return abs(a - b) / (scale or abs(b) or 1e-300)
