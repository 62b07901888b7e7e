"""How far two runs of a scene are apart, and what that says of the communication step."""

from __future__ import annotations

import math

from .result import ShiftResult
from .scout import Scouted
from .selection_record import StepShare

ORDER = 1.0  # taken for all figures: steps of packs couple with 2, of parts that drag with 1
FIGURES = ("slip_energy", "lock_time")  # that do not forget
PEAKS = ("peak_clutch_temperature", "peak_brake_temperature")
LEAST_RISE = 1.0  # K
HEATS = ("washers", "meshes")  # of the energy book


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


def step_share(scouted: Scouted, step: float, tolerance: float) -> StepShare:
    """Return the error of a step, from the difference of the scouts and the least order."""
    coarse, fine = scouted.coarse, scouted.fine
    error, figure = farthest(coarse, fine)
    scale = (step / fine.step) ** ORDER / ((coarse.step / fine.step) ** ORDER - 1.0)
    return StepShare(step, tolerance, error * scale, figure)


def _apart(a: float | None, b: float | None, scale: float) -> float:
    """Return the difference of two values over ``scale`` or, if that is 0, over the second."""
    if a is None or b is None:
        return 0.0 if a is b else math.inf
    return abs(a - b) / (scale or abs(b) or 1e-300)
