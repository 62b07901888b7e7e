"""The lines of the charts: every rung, meshes and tolerances, rivals at their best setting."""

from __future__ import annotations

from functools import partial

from ..models._spec import ModelSpec
from .measure import Quantity, Rung
from .models import spec_of
from .ways import KernelWay, Way2006
from .ways_clutch import ClutchWay

QUANTITIES = {
    "washer": (
        Quantity("friction_torque", True, 1e-3),
        Quantity("temperature", False, unit="K"),
    ),
    "clutch": (
        Quantity("slip_energy", True),
        Quantity("end_temperature", False, unit="K"),
    ),
    "gearmesh": (
        Quantity("friction_torque", True, 1e-4),
        Quantity("temperature", False, unit="K"),
    ),
}
USUAL_STEP = 1e-3
STEPS = (2e-2, 1e-2, 5e-3, 2e-3, 5e-4)
GRIDS = ((7, 20), (9, 24), (10, 32), (13, 40), (16, 48), (19, 64), (28, 96))
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)
GRIDS_2006 = ((13, 67), (17, 67), (17, 134))


def rungs_of(model: str) -> list[Rung]:
    """Return one rung per named fidelity that the kernel knows."""
    spec = spec_of(model)
    if model == "clutch":
        return [
            Rung("rungs", name, "rung", name, partial(ClutchWay, name, USUAL_STEP), "steps")
            for name in spec.fidelities
        ]
    counted = spec.counts[0][0] if spec.counts else "calls"
    return [
        Rung("rungs", name, "rung", name, partial(KernelWay, spec, name), counted)
        for name in spec.fidelities
    ]


def meshes(spec: ModelSpec, *, quick: bool = False) -> list[Rung]:
    """Return the package's washer on meshes from coarse to fine."""
    return [
        Rung("mesh of the package", f"{r} x {t}", "grid", f"{r}x{t}",
             partial(KernelWay, spec, "field", (r, t)), "Newton iterations x nodes")
        for r, t in (GRIDS[::3] if quick else GRIDS)
    ]  # fmt: skip


def steps(*, quick: bool = False) -> list[Rung]:
    """Return the clutch's rungs with a moving film over the communication step."""
    return [
        Rung(f"{name} over the step", f"{name}, {1e3 * h:g} ms", "step", f"{1e3 * h:g} ms",
             partial(ClutchWay, name, h), "steps")
        for name in ("field", "fine") for h in (STEPS[::2] if quick else STEPS)
    ]  # fmt: skip


def method_of_2006(*, quick: bool = False) -> list[Rung]:
    """Return the method of 2006 over its tolerance, and over its mesh at the best tolerance."""
    counted = "sweeps x nodes"
    by_tolerance = [
        Rung("2006, 9 x 67, tolerance", f"2006, 9 x 67, {t:g}", "tolerance", f"{t:g}",
             partial(Way2006, tolerance=t), counted, True)
        for t in (TOLERANCES[1:2] if quick else TOLERANCES)
    ]  # fmt: skip
    by_mesh = [
        Rung("2006, 1e-5, mesh", f"2006, mesh {r} x {t}", "grid", f"{r}x{t}",
             partial(Way2006, tolerance=1e-5, grid=(r, t)), counted, True)
        for r, t in (() if quick else GRIDS_2006)
    ]  # fmt: skip
    return by_tolerance + by_mesh


def lines_of(model: str, *, quick: bool = False) -> list[Rung]:
    """Return everything that is measured for a model."""
    found = rungs_of(model)
    if model == "washer":
        found += meshes(spec_of(model), quick=quick) + method_of_2006(quick=quick)
    if model == "clutch":
        found += steps(quick=quick)
    return found
