"""What the corrections of the physics moved: clutch, teeth, washer, shift, before and after.

Before is a model's preset "paper" or the former scene, computed now; where neither gives the old
equations, the figure that version 0.5.0 gave is given and marked as recorded.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from lab.macro_steps import instances
from thrustwasher.clutch.parameters import ClutchParams
from thrustwasher.clutch.solve import solve_clutch
from thrustwasher.gearmesh.parameters import GearMeshParams
from thrustwasher.gearmesh.solve import solve_gearmesh
from thrustwasher.shift.run import cosimulate
from thrustwasher.shift.scene.scene_file import load_scene
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import solve_washer

# Harmonic means of the sample's friction at 0.5 MPa in 0.5.0; measured: 0.053 at both.
RECORDED = {353.15: 0.06753, 297.15: 0.12812}
SLIPS = np.linspace(10.0, 3000.0, 30) * math.pi / 30.0  # rad/s
CLUTCH = "clutch: shear of the oil counted once"
TEETH = "teeth: the whole loss heats the flanks"
WASHER = "washer: one temperature on turning circles, oil carries heat away"
SHIFT = "default scene: sun-driven by ramps, now ring-driven by pressures"
SHOWN = {  # key figure -> words, unit shown, its factor; a temperature counts from the oil's
    "lock_after_ramp_start": ("shift's time", "s", 1.0),
    "slip_energy_per_area": ("energy on the lining", "J/mm2", 1e-6),
    "clutch_viscous_share": ("heat made in the oil", "%", 100.0),
    "peak_clutch_temperature": ("clutch's rise", "K", 1.0),
    "peak_mesh_temperature": ("flanks' rise", "K", 1.0),
    "minimum_washer_film_ratio": ("washers' minimum film ratio", "1", 1.0),
}
Row = dict[str, Any]


def corrections() -> list[Row]:
    """Return a row for each figure, as JSON types."""
    return [*_clutch(), *_teeth(), *_washer(), *_scene()]


def _row(part: str, figure: str, unit: str, values: Sequence[float], recorded: bool = False) -> Row:
    return {
        "part": part,
        "figure": figure,
        "unit": unit,
        "before": values[0],
        "after": values[1],
        "recorded": recorded,
    }


def _clutch() -> list[Row]:
    """Return the friction of Wang, Wei & Wu's sample, settled, at two oil temperatures."""
    p = ClutchParams.preset("paper", friction_data="total")
    a, b = p.inner_radius, p.outer_radius
    load = 0.5e6 * math.pi * (b * b - a * a)
    lever = p.faces * load * 2.0 / 3.0 * (b**3 - a**3) / (b * b - a * a)
    found = []
    for oil, before in RECORDED.items():
        torques = [
            solve_clutch(
                p, load=load, speed=float(w), oil_temperature=oil, interface_temperature=oil
            ).friction_torque
            for w in SLIPS
        ]
        after = 1.0 / float(np.mean(lever / np.array(torques)))
        words = f"mean friction at {oil - 273.15:.0f} degC"
        found.append(_row(CLUTCH, words, "1", (before, after), recorded=True))
    return found


def _teeth() -> list[Row]:
    """Return loss and flank of the default gears at 7.5 kW and 180 rad/s."""
    both = [
        solve_gearmesh(p, power=7500.0, speed=180.0, oil_temperature=299.85)
        for p in (GearMeshParams.preset("paper"), GearMeshParams())
    ]
    loss = [g.friction_power for g in both]
    rise = [g.surface_temperature - 299.85 for g in both]
    return [
        _row(TEETH, "loss at 7.5 kW", "W", loss),
        _row(TEETH, "flank's rise", "K", rise),
        _row(
            TEETH,
            "flank's rise per loss",
            "K/kW",
            [1e3 * r / p for r, p in zip(rise, loss, strict=True)],
        ),
    ]


def _washer() -> list[Row]:
    """Return torque and mean rise in a full film and in contact."""
    found = []
    for words, load, speed in (("film, 300 N", 300.0, 953.0), ("contact, 1361 N", 1361.0, 136.0)):
        both = [
            solve_washer(p, load=load, speed=speed, tilt=2e-3, oil_temperature=297.15)
            for p in (WasherParams.preset("paper"), WasherParams())
        ]
        found += [
            _row(WASHER, f"torque, {words}", "N.m", [w.friction_torque for w in both]),
            _row(WASHER, f"mean rise, {words}", "K", [w.temperature - 297.15 for w in both]),
        ]
    return found


def _scene() -> list[Row]:
    """Return key figures of the former default shift and of the present one."""
    runs = [cosimulate(s, instances(s)) for s in map(load_scene, ("planetary-sun", "planetary"))]
    found = []
    for name, (words, unit, factor) in SHOWN.items():
        zero = [r.scene.oil_temperature if unit == "K" else 0.0 for r in runs]
        values = [
            factor * float(r.figures[name] or 0.0) - z for r, z in zip(runs, zero, strict=True)
        ]
        found.append(_row(SHIFT, words, unit, values))
    return found
