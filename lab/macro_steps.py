"""Error of a shift against its cost: over step, master, coupling and level.

The shift is the built-in ``planetary-sun`` without washers and gear mesh: what is judged is how the
packs and the driveline are coupled. ``study`` holds every way to couple them against its limit of
small steps, in quantities that a shift does not forget: heat of the clutch, time of lock-up, peak
temperature.
"""

import math
import statistics
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lab.charts.chart_series import Quantity
from lab.charts.work_precision import Sample
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.numerics.jit import Array
from thrustwasher.shift.run import cosimulate
from thrustwasher.shift.scene.connections import PACKS
from thrustwasher.shift.scene.scene import Scene
from thrustwasher.shift.scene.scene_file import load_scene
from thrustwasher.shift.shift_result import ShiftResult

STEPS = (1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4)
QUICK_STEPS = (1e-2, 2e-3)
TRUE_STEPS, QUICK_TRUE_STEPS = (1e-4, 5e-5), (4e-4, 2e-4)
SLOW_SLIP = 0.5  # [rad/s]; with smoothed friction less counts as locked
STANDING = 1e-3  # [rad/s]
MOST_TURNS = 2  # changes of the slip's sign after lock-up; more is chatter
QUANTITIES = (
    Quantity("slip_energy", True),
    Quantity("lock_time", False, unit="s"),
    Quantity("peak_temperature", False, unit="K"),
)


@dataclass(frozen=True)
class Way:
    """One way to couple the shift."""

    master: str
    coupling: str = "capacity"
    extrapolation: bool = True
    level: str = "field"

    @property
    def name(self) -> str:
        """What the line is called."""
        what = "capacity, extrapolated" if self.extrapolation else "capacity, held"
        what = "friction torque" if self.coupling == "torque" else what
        level = "" if self.level == "field" else f", packs {self.level}"
        return f"{self.master}, {what}{level}"


WAYS = (
    Way("gauss-seidel"),
    Way("jacobi"),
    Way("gauss-seidel", extrapolation=False),
    Way("jacobi", extrapolation=False),
    Way("gauss-seidel", "torque"),
    Way("jacobi", "torque"),
    Way("linearly-implicit", "torque"),
    Way("gauss-seidel", level="stribeck"),
    Way("gauss-seidel", level="closed"),
)


def scene_of(way: Way, step: float) -> Scene:
    """Return the shift to be run in steps [s]."""
    scene = load_scene("planetary-sun").with_options(step=step, master=way.master)
    parts = {k: v for k, v in scene.parts.items() if k not in ("washer", "mesh")}
    gearbox = parts["transmission"]
    params = replace(
        gearbox.params, washers=0, coupling=way.coupling, capacity_extrapolation=way.extrapolation
    )
    parts["transmission"] = replace(gearbox, params=params)
    for pack in PACKS:
        parts[pack] = replace(parts[pack], fidelity=way.level)
    return replace(scene, parts=parts)


def instances(scene: Scene) -> dict[str, DirectInstance]:
    """Return an instance in this process for each part of a scene."""
    return {
        name: DirectInstance(part.spec, parameters=part.parameters())
        for name, part in scene.parts.items()
    }


def figures(result: ShiftResult) -> dict[str, float]:
    """Return what the shift is evaluated by; NaN for a lock-up that was not reached."""
    signals, time = result.signals, result.time
    slip = signals["transmission.clutch_speed"]
    peak = float(np.max(signals["clutch.temperature"]))
    located = [f.value for f in result.key_figures if f.name == "lock_time"]
    lock = located[0] if located and located[0] is not None else _slow_since(time, slip)
    energy = float(signals["transmission.clutch_heat"][-1])
    return {"slip_energy": energy, "lock_time": lock, "peak_temperature": peak}


def _slow_since(time: Any, slip: Any) -> float:
    """Return when the slip first fell below ``SLOW_SLIP``, by interpolation; NaN if never."""
    i = int(np.argmax(slip))
    below = np.flatnonzero(np.abs(slip[i:]) < SLOW_SLIP)
    if not len(below) or below[0] == 0:
        return float("nan")
    k = i + int(below[0])
    share = (slip[k - 1] - SLOW_SLIP) / (slip[k - 1] - slip[k])
    return float(time[k - 1] + min(max(share, 0.0), 1.0) * (time[k] - time[k - 1]))


def complaint(result: ShiftResult, found: Mapping[str, float]) -> str:
    """Say what is wrong with a run that came to its end; empty if nothing is.

    Its numbers are kept all the same: that is what a user would have got.
    """
    if not all(map(np.isfinite, found.values())):
        return "does not lock"
    slip, time = result.signals["transmission.clutch_speed"], result.time
    turns = turns_of(slip[time > found["lock_time"]], STANDING)
    return f"chatters: the slip turns round {turns} times" if turns > MOST_TURNS else ""


def turns_of(slip: Array, least: float) -> int:
    """Return how often a slip changes its sign, sizes up to ``least`` left out."""
    return int(np.count_nonzero(np.diff(np.sign(slip[np.abs(slip) > least]))))


def study(*, quick: bool = False, progress: Callable[[str], None] = print) -> dict[str, Any]:
    """Return truth and samples of all ways and steps, as JSON types.

    ``quick``: few steps, one repeat.
    """
    progress("shift: reference")
    truth, uncertainty = small_step_limit(quick=quick)
    samples = []
    for way in WAYS:
        progress(f"shift: {way.name}")
        for step in QUICK_STEPS if quick else STEPS:
            samples.append(sample(way, step, truth, uncertainty, 1 if quick else 3))
    return {
        "scene": "planetary-sun without washers and gear mesh",
        "truth": truth,
        "samples": samples,
        "quantities": [q.as_dict() for q in QUANTITIES],
    }


def small_step_limit(*, quick: bool = False) -> tuple[dict[str, float], dict[str, float]]:
    """Return the figures both masters tend to, and how far these limits are apart.

    Two steps of each master are extrapolated with first order; the mean of the limits counts.
    """
    coarse, fine = QUICK_TRUE_STEPS if quick else TRUE_STEPS
    limits = []
    for master in ("gauss-seidel", "jacobi"):
        a, b = (figures(run(Way(master), step)) for step in (coarse, fine))
        limits.append({k: b[k] + (b[k] - a[k]) * fine / (coarse - fine) for k in b})
    truth = {k: 0.5 * (limits[0][k] + limits[1][k]) for k in limits[0]}
    apart = {k: abs(limits[0][k] - limits[1][k]) for k in truth}
    return truth, apart


def run(way: Way, step: float) -> ShiftResult:
    """Run the shift once in steps [s]."""
    scene = scene_of(way, step)
    return cosimulate(scene, instances(scene))


def sample(
    way: Way,
    step: float,
    truth: Mapping[str, float],
    uncertainty: Mapping[str, float],
    repeats: int,
) -> dict[str, Any]:
    """Return one sample in the layout of all charts; the cost is per simulated second."""
    wall: list[float] = []
    found: dict[str, float] = {}
    count = 0
    try:
        for _ in range(repeats):
            result = run(way, step)
            span = float(result.time[-1] - result.time[0])
            wall.append(result.wall_time / span)
        count = sum(c.steps for c in result.cost)
        found = figures(result)
        why = complaint(result, found)
    except (ParameterError, SolveError) as error:
        why = f"{type(error).__name__}: {error}"
    failures = {"shift": why} if why else {}
    errors: dict[str, dict[str, Any]] = {}
    for q in QUANTITIES:
        off = q.error(found.get(q.name, math.nan), truth[q.name])
        errors[q.name] = {"worst": off, "rms": off, "case": "shift"}
    value = f"{1e3 * step:g} ms"
    quartiles = statistics.quantiles(wall, n=4) if len(wall) > 1 else [0.0, 0.0, 0.0]
    return Sample(
        way.name,
        f"{way.name}, {value}",
        "macro step",
        value,
        "planetary-sun",
        errors,
        {q.name: uncertainty[q.name] / q.size(truth[q.name]) for q in QUANTITIES},
        statistics.median(wall) if wall else math.nan,
        quartiles[2] - quartiles[0],
        min(wall, default=math.nan),
        len(wall),
        math.nan,
        0.0,
        float(count),
        "steps of all parts",
        1,
        len(failures),
        failures,
    ).as_dict()
