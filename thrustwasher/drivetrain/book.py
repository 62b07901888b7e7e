"""The energy book and the key figures of a shift, read from its signals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .course import turning
from .result import Event
from .scene import Scene

Signals = dict[str, NDArray[np.float64]]


def energy(signals: Signals) -> dict[str, float]:
    """Return every entry of the energy book [J] and the two errors with their shares.

    ``residual`` is the work of the engine that no entry accounts for. ``coupling_difference`` is
    the clutch's heat on the mechanical side minus the heat its thermal side has booked: the error
    of exchanging signals once per step. Shares are of the engine's work and of the clutch's heat.
    """

    def last(name: str) -> float:
        return float(signals[name][-1]) if name in signals else 0.0

    book = {
        "engine_work": last("transmission.engine_work"),
        "kinetic": last("transmission.kinetic_change"),
        "load_work": last("transmission.load_work"),
        "clutch": last("transmission.clutch_heat"),
        "brake": last("transmission.brake_heat"),
        "washers": last("transmission.washer_heat"),
        "meshes": last("transmission.mesh_heat"),
        "residual": last("transmission.energy_residual"),
    }
    difference = book["clutch"] - last("clutch.energy")
    work = abs(book["engine_work"])
    book["residual_share"] = abs(book["residual"]) / work if work else 0.0
    book["coupling_difference"] = difference
    book["coupling_difference_share"] = abs(difference) / book["clutch"] if book["clutch"] else 0.0
    book["brake_coupling_difference"] = book["brake"] - last("brake.energy")
    return book


def figures(
    scene: Scene, time: NDArray[np.float64], signals: Signals, found: list[Event]
) -> dict[str, float | None]:
    """Return the numbers a shift is judged by, SI units; None where there is no such thing."""
    start = scene.shift_start
    lock = next((e.time for e in found if e.kind == "clutch_locked" and e.time >= start), None)
    release = next((e.time for e in found if e.kind == "brake_released"), None)
    clutch: Any = scene.parts["clutch"].params
    area = clutch.faces * math.pi * (clutch.outer_radius**2 - clutch.inner_radius**2)
    heat = signals["transmission.clutch_heat"]
    power = signals["transmission.clutch_reaction"] * signals["transmission.clutch_speed"]
    result: dict[str, float | None] = {
        "lock_time": lock,
        "lock_after_ramp_start": None if lock is None else lock - start,
        "lock_speed": None if lock is None else float(signals["transmission.lock_speed"][-1]),
        "release_time": release,
        "slip_energy": float(heat[-1]),
        "slip_energy_per_area": float(heat[-1]) / area,
        "peak_power": float(np.max(np.abs(power))),
        "peak_clutch_temperature": float(np.max(signals["clutch.temperature"])),
        "peak_brake_temperature": float(np.max(signals["brake.temperature"])),
        "peak_clutch_torque": float(np.max(np.abs(signals["clutch.friction_torque"]))),
        "peak_sun_thrust": float(np.max(signals["transmission.sun_thrust"])),
        "least_clutch_film_ratio": float(np.min(signals["clutch.film_ratio"])),
        **_friction(time, signals, start, lock),
    }
    if "washer.friction_torque" in signals:
        moving = turning(signals)
        ratio = signals["washer.film_ratio"][moving]
        distress = (signals["washer.distress"] > 0.5) & moving
        result |= {
            "peak_washer_load": float(np.max(signals["transmission.washer_load"])),
            "peak_washer_temperature": float(np.max(signals["washer.temperature"])),
            "peak_washer_temperature_max": float(np.max(signals["washer.temperature_max"])),
            "least_washer_film_ratio": float(np.min(ratio)) if len(ratio) else None,
            "washer_distress_time": float(np.sum(np.diff(time)[distress[1:]])),
        }
    return result


def _friction(
    time: NDArray[np.float64], signals: Signals, start: float, lock: float | None
) -> dict[str, float | None]:
    """Return the clutch's coefficient when slip begins, at half the slip, and before lock-up."""
    coefficient = signals["clutch.friction_coefficient"]
    slip = np.abs(signals["transmission.clutch_speed"])
    stop = time[-1] if lock is None else lock
    during = np.flatnonzero((time >= start) & (time < stop) & (slip > 0.0))
    if not len(during):
        return dict.fromkeys(("friction_start", "friction_middle", "friction_lock"))
    first, last = during[0], during[-1]
    middle = during[int(np.argmin(np.abs(slip[during] - 0.5 * slip[first])))]
    return {
        "friction_start": float(coefficient[first]),
        "friction_middle": float(coefficient[middle]),
        "friction_lock": float(coefficient[last]) if lock is not None else None,
    }
