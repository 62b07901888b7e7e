"""Where masters and couplings of a shift fail: the package's own, on its own scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache

import numpy as np

from ..fidelity.failure_cells import LIES, OK, SAYS, SLOW, Cell, Group, off, table
from .macro_steps import MOST_TURNS, Way, scene_of
from .master import MASTERS
from .result import ShiftResult
from .scene import Scene
from .shift import run_shift
from .system import Stepping

WRONG_HEAT = 0.02
MANY_STEPS = 10  # of the master for each that was asked for
SMOOTHING = 2.0  # rad/s: torques may be handed over in steps of up to 1.2 ms
STOP, LOCKED = 1.1, 0.70  # s
TRUE_STEP, QUICK_TRUE_STEP = 1e-4, 2e-4
HAZARDS = {
    "capacity, 1 ms": ("capacity", 1e-3),
    "capacity, 5 ms": ("capacity", 5e-3),
    "capacity, 10 ms": ("capacity", 1e-2),
    "torque, 0.2 ms": ("torque", 2e-4),
    "torque, 2 ms": ("torque", 2e-3),
    "torque, 10 ms": ("torque", 1e-2),
}
Make = Callable[[Scene], Mapping[str, Stepping]]


def masters(make: Make, *, quick: bool = False) -> Group:
    """Judge every master and coupling of the default shift by the clutch's heat and chatter.

    ``make`` gives an instance for each part of a scene. Washers and gear mesh are left out. Each
    coupling is held against its own limit of small steps: smoothed friction is another model.
    ``quick``: that limit is taken from longer steps.
    """

    @cache
    def true_heat(coupling: str) -> float:
        step = QUICK_TRUE_STEP if quick else TRUE_STEP
        return _heat(_run(make, "gauss-seidel", coupling, step))

    def judge(master: str, hazard: tuple[str, float]) -> Cell:
        return _judged(_run(make, master, *hazard), true_heat(hazard[0]))

    named = {f"master {name}": name for name in MASTERS}
    judged = f"clutch's heat off by more than {100 * WRONG_HEAT:g} %, or chatter"
    return table("the default shift", judged, named, HAZARDS, judge)


def _run(make: Make, master: str, coupling: str, step: float) -> ShiftResult:
    scene = scene_of(Way(master, coupling), step)
    parts = dict(scene.parts)
    for pack in ("clutch", "brake"):
        smooth = replace(parts[pack].params, speed_smoothing=SMOOTHING)
        parts[pack] = replace(parts[pack], params=smooth)
    scene = replace(scene, parts=parts).with_options(stop_time=STOP)
    return run_shift(scene, make(scene))


def _heat(result: ShiftResult) -> float:
    return float(result.signals["transmission.clutch_heat"][-1])


def _judged(result: ShiftResult, true: float) -> Cell:
    """Look at the heat, at the slip after lock-up, and at what the run says itself."""
    error = _heat(result) / true - 1.0
    slip = result.signals["transmission.clutch_speed"][result.time > LOCKED]
    moving = np.sign(slip[np.abs(slip) > 1e-3])
    turns = int(np.count_nonzero(np.diff(moving)))
    right = abs(error) <= WRONG_HEAT
    if right and turns <= MOST_TURNS:
        taken = len(result.time) - 1
        slow = taken > MANY_STEPS * (result.time[-1] - result.time[0]) / result.scene.step
        words = f"{taken} steps, heat off by {100 * abs(error):.2g} %"
        if slow:
            return Cell(SLOW, f"{taken} steps", words)
        return Cell(OK, f"{100 * abs(error):.2f} %", words)
    words = "; ".join(f"{c.pack}: kappa = {c.kappa:.2g}" for c in result.chatter)
    figure = off(error) if not right else "chatters"
    return Cell(SAYS if words else LIES, figure, words or f"{turns} turns after lock-up")
