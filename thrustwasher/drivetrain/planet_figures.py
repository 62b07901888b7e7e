"""Key figures of what sits at the planets: thrust washer and gear mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .course import turning
from .figure_list import FILM_SPEED, Found
from .pack_figures import least, peak

Array = NDArray[np.float64]
Signals = dict[str, Array]
# Figure -> signal; of some the least value counts, of the others the greatest.
MESH_PEAKS = {
    "peak_mesh_load": "mesh.load",
    "peak_flash_temperature": "mesh.temperature",
    "peak_flash_rise": "mesh.flash_rise",
    "peak_mesh_temperature": "mesh.surface_temperature",
    "peak_mesh_stress": "mesh.contact_stress",
    "peak_mesh_thermal_stress": "mesh.thermal_stress",
}
STEELS = ("aisi1020", "aisi4340")


def washer_figures(time: Array, signals: Signals) -> Found:
    """Return load, temperatures and film of the washer; nothing without one."""
    if "washer.friction_torque" not in signals:
        return {}
    moving = turning(signals)
    distress = (signals["washer.distress"] > 0.5) & moving
    lost = float(np.sum(np.diff(time)[distress[1:]]))
    return {
        "peak_washer_load": peak(signals["transmission.washer_load"], time),
        "peak_washer_temperature": peak(signals["washer.temperature"], time),
        "peak_washer_temperature_max": peak(signals["washer.temperature_max"], time),
        "least_washer_film_ratio": least_film("washer", time, signals),
        "washer_distress_time": (lost, None),
    }


def mesh_figures(time: Array, signals: Signals) -> Found:
    """Return heat, temperatures, film and margins of the mesh; nothing without one.

    A stress margin is 1 - utilisation: at 0 the endurance limit is reached.
    """
    if "mesh.friction_torque" not in signals:
        return {}
    found: Found = {
        name: peak(signals[signal], time)
        for name, signal in MESH_PEAKS.items() if signal in signals
    }  # fmt: skip
    if "mesh.film_ratio" in signals:
        found["least_mesh_film_ratio"] = least_film("mesh", time, signals)
    if "mesh.allowable_ratio" in signals:
        found["least_allowable_ratio"] = least(signals["mesh.allowable_ratio"], time)
    for steel in STEELS:
        used = signals.get(f"mesh.stress_utilization_{steel}")
        if used is not None:
            found[f"stress_margin_{steel}"] = least(1.0 - used, time)
    found["mesh_loss"] = (float(signals["transmission.mesh_heat"][-1]), None)
    return found


def least_film(part: str, time: Array, signals: Signals) -> tuple[float | None, float | None]:
    """Return the least film ratio of a part above FILM_SPEED, and its time.

    Where the speed passes FILM_SPEED between two samples the ratio is interpolated to that speed:
    the figure must not depend on where the samples happen to lie. A film ratio belongs to the speed
    that the part itself was given.
    """
    ratio, speed = signals[f"{part}.film_ratio"], np.abs(signals[f"{part}.speed"])
    fast = speed >= FILM_SPEED
    i = np.flatnonzero(fast[1:] != fast[:-1])
    done = (FILM_SPEED - speed[i]) / (speed[i + 1] - speed[i])
    ratios, times = (
        np.concatenate((v[fast], v[i] + done * (v[i + 1] - v[i]))) for v in (ratio, time)
    )
    return least(ratios, times) if len(ratios) else (None, None)
