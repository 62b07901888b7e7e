"""Where the package's own masters fail, judged as other methods are judged."""

from dataclasses import replace
from functools import cache

from lab.macro_steps import (
    MOST_TURNS,
    STANDING,
    Way,
    figures,
    instances,
    scene_of,
    turns_of,
)
from thrustwasher.shift.masters.master import MASTERS
from thrustwasher.shift.run import cosimulate
from thrustwasher.shift.scene.connections import PACKS
from thrustwasher.shift.shift_result import ShiftResult

from .failure_cells import LIES, OK, SAYS, Cell, Group, off, table

WRONG_HEAT = 0.02
SMOOTHING = 2.0  # rad/s: torques may be handed over in steps of up to 1.2 ms
STOP, LOCKED = 1.5, 0.85  # s
TRUE_STEP, QUICK_TRUE_STEP = 1e-4, 2e-4  # of masters
TRIED = {"capacity": (1e-3, 5e-3, 1e-2), "torque": (2e-4, 2e-3, 1e-2)}  # s
HAZARDS = {f"{c}, {1e3 * step:g} ms": (c, step) for c, steps in TRIED.items() for step in steps}


def masters(*, quick: bool = False) -> Group:
    """Judge every master and coupling of a shift with cold oil by the clutch's heat and chatter.

    Washers and gear mesh are left out. Each coupling is held against its own limit of small steps:
    smoothed friction is another model.
    ``quick``: that limit is taken from longer steps.
    """

    @cache
    def true_heat(coupling: str) -> float:
        step = QUICK_TRUE_STEP if quick else TRUE_STEP
        return figures(_smooth_run("gauss-seidel", coupling, step))["slip_energy"]

    def judge(master: str, hazard: tuple[str, float]) -> Cell:
        return _judged(_smooth_run(master, *hazard), true_heat(hazard[0]))

    named = {f"master {name}": name for name in MASTERS}
    judged = f"clutch's heat off by more than {100 * WRONG_HEAT:g} %, or chatter"
    return table("the shift of the scene planetary-sun", judged, named, HAZARDS, judge)


def _smooth_run(master: str, coupling: str, step: float) -> ShiftResult:
    scene = scene_of(Way(master, coupling), step)
    parts = dict(scene.parts)
    for pack in PACKS:
        smooth = replace(parts[pack].params, speed_smoothing=SMOOTHING)
        parts[pack] = replace(parts[pack], params=smooth)
    scene = replace(scene, parts=parts).with_options(stop_time=STOP)
    return cosimulate(scene, instances(scene))


def _judged(result: ShiftResult, true: float) -> Cell:
    """Look at the heat, at the slip after lock-up, and at what the run says itself."""
    error = figures(result)["slip_energy"] / true - 1.0
    slip = result.signals["transmission.clutch_speed"][result.time > LOCKED]
    turns = turns_of(slip, STANDING)
    right = abs(error) <= WRONG_HEAT
    if right and turns <= MOST_TURNS:
        words = f"{result.steps} steps, heat off by {100 * abs(error):.2g} %"
        return Cell(OK, f"{100 * abs(error):.2f} %", words)
    words = "; ".join(f"{c.pack}: kappa = {c.kappa:.2g}" for c in result.chatter)
    figure = off(error) if not right else "chatters"
    return Cell(SAYS if words else LIES, figure, words or f"{turns} turns after lock-up")
