"""What the communication step is worth: two scout runs of different steps beside each other."""

from __future__ import annotations

from .scout import Scouted
from .selection_record import StepShare

ORDER = 1.0  # taken for all figures: steps of packs couple with 2, of parts that drag with 1
# Figures that do not forget, and whether they count from the oil's temperature.
FIGURES = (
    ("slip_energy", False), ("lock_time", False), ("peak_clutch_temperature", True),
    ("peak_brake_temperature", True),
)  # fmt: skip
HEATS = ("washers", "meshes")  # of the energy book


def step_share(scouted: Scouted, step: float, tolerance: float) -> StepShare:
    """Return the error of a step, from the difference of the scouts and the least order."""
    coarse, fine = scouted.coarse, scouted.fine
    scale = (step / fine.step) ** ORDER / ((coarse.step / fine.step) ** ORDER - 1.0)
    oil = fine.scene.oil_temperature
    found = []
    for name, hot in FIGURES:
        a, b = coarse.figures.get(name), fine.figures.get(name)
        if a is not None and b is not None:
            found.append((_apart(a, b, oil if hot else 0.0, 1.0 if hot else 0.0) * scale, name))
    for name in HEATS:
        a, b = coarse.energy[name], fine.energy[name]
        if b:
            found.append((_apart(a, b, 0.0, 0.0) * scale, f"heat of the {name}"))
    error, figure = max(found, default=(0.0, "nothing"))
    return StepShare(step, tolerance, error, figure)


def _apart(a: float, b: float, zero: float, least: float) -> float:
    """Return the difference of two values as a share of the second, counted from ``zero``."""
    return abs(a - b) / max(abs(b - zero), least, 1e-300)
