"""The key figures of a shift, read from its signals."""

import numpy as np
from numpy.typing import NDArray

from ..oscillation.judder import Judder, judder_figures
from ..scene.scene import Scene
from .events_and_phases import Event
from .figure_list import Found, KeyFigure, assemble
from .part_figures import (
    area_of,
    friction_figures,
    mesh_figures,
    pack_figures,
    peak,
    tie_up_figures,
    washer_figures,
)  # fmt: skip

Array = NDArray[np.float64]
Signals = dict[str, Array]


def key_figures(
    scene: Scene, time: Array, signals: Signals, events: list[Event], judder: Judder | None = None
) -> list[KeyFigure]:
    """Return the numbers a shift is judged by, SI units; None where there is no such thing."""
    start, pack, other = scene.shift_start, scene.engaging, scene.releasing
    lock = next((e.time for e in events if e.kind == f"{pack}_locked" and e.time >= start), None)
    middle = start + 0.5 * scene.shift_duration
    release = next((e.time for e in events if e.kind == f"{other}_released"), None)
    found: Found = {
        "lock_time": (lock, None),
        "lock_after_ramp_start": (None if lock is None else lock - start, None),
        "lock_after_half_ramp": (None if lock is None else lock - middle, None),
        "release_time": (release, None),
        **_slip(scene, time, signals, lock),
        **friction_figures(scene, time, signals, lock),
        **pack_figures(scene, "clutch", time, signals),
        **pack_figures(scene, "brake", time, signals),
        **tie_up_figures(scene, time, signals),
        **judder_figures(judder),
        "peak_sun_thrust": peak(signals["transmission.sun_thrust"], time),
        **washer_figures(time, signals),
        **mesh_figures(time, signals),
    }
    if not scene.alone:
        found["lock_speed"] = (_engine_speed(scene, time, signals, lock), None)
    return assemble(found, pack, other)


def _engine_speed(scene: Scene, time: Array, signals: Signals, lock: float | None) -> float | None:
    """Return the engine's speed at lock-up; the transmission itself keeps that of the clutch.

    When the brake locks, the ring rests and the engine runs at 1 + r times the output.
    """
    if lock is None:
        return None
    if scene.engaging == "clutch":
        return float(signals["transmission.lock_speed"][-1])
    gearbox = scene.parts["transmission"].params
    ratio = 1.0 + gearbox.ring_teeth / gearbox.sun_teeth
    return float(ratio * np.interp(lock, time, signals["transmission.output_speed"]))


def _slip(scene: Scene, time: Array, signals: Signals, lock: float | None) -> Found:
    """Return slip, heat and power of the pack that engages."""
    pack = scene.engaging
    slip = signals[f"transmission.{pack}_speed"]
    heat = float(signals[f"transmission.{pack}_heat"][-1])
    greatest = float(np.max(np.abs(slip)))
    area = area_of(scene.parts[pack].params)
    found: Found = {
        "greatest_slip": peak(np.abs(slip), time),
        "slip_energy": (heat, None),
        "slip_energy_per_area": (heat / area, None),
        "peak_power": peak(np.abs(signals[f"{pack}.friction_power"]), time),
    }
    if scene.alone and lock is not None and greatest > 0.0:
        found["stopped_inertia"] = (2.0 * heat / greatest**2, None)
    return found
