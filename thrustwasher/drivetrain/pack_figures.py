"""Key figures of the two packs: heat, flux, temperature, film and friction."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..models.clutch_params import lining_area, mean_radius
from .figure_list import Found
from .scene import Scene

Array = NDArray[np.float64]
Signals = dict[str, Array]
FULL = 0.999  # of the friction at lock-up: a little slip above the plateau is still full friction


def area_of(params: Any) -> float:
    """Return the area of all friction faces of a pack [m2]."""
    return lining_area(params.inner_radius, params.outer_radius, params.faces)


def radius_of(params: Any) -> float:
    """Return the radius friction acts at [m]: the one that was set, or that of even pressure."""
    return float(params.effective_radius) or mean_radius(params.inner_radius, params.outer_radius)


def peak(values: Array, time: Array) -> tuple[float, float]:
    """Return the largest value and its time."""
    i = int(np.argmax(values))
    return float(values[i]), float(time[i])


def least(values: Array, time: Array, where: NDArray[np.bool_] | None = None) -> tuple[
    float | None, float | None
]:  # fmt: skip
    """Return the least value among the places given, and its time."""
    shown = values if where is None else np.where(where, values, np.inf)
    i = int(np.argmin(shown))
    return (float(shown[i]), float(time[i])) if np.isfinite(shown[i]) else (None, None)


def pack_figures(scene: Scene, pack: str, time: Array, signals: Signals) -> Found:
    """Return the heat, flux, torque, temperature and film of one pack; of one in use only.

    Peaks are those of the pack itself: the driveline's torque overshoots for a step where the
    extrapolated capacity has a corner.
    """
    if not np.any(signals[f"{pack}.load"] > 0.0):
        return {}
    area = area_of(scene.parts[pack].params)
    found: Found = {
        f"{pack}_heat_per_area": (float(signals[f"transmission.{pack}_heat"][-1]) / area, None),
        f"peak_{pack}_heat_flux": peak(np.abs(signals[f"{pack}.friction_power"]) / area, time),
        f"peak_{pack}_temperature": peak(signals[f"{pack}.temperature"], time),
        f"peak_{pack}_torque": peak(np.abs(signals[f"{pack}.friction_torque"]), time),
        f"least_{pack}_film_ratio": least(signals[f"{pack}.film_ratio"], time),
    }
    if f"{pack}.viscous_torque" in signals:
        slip = signals[f"{pack}.speed"]
        oil, whole = (
            float(np.trapezoid(np.abs(signals[f"{pack}.{name}"] * slip), time))
            for name in ("viscous_torque", "friction_torque")
        )
        found[f"{pack}_viscous_share"] = (oil / whole if whole > 0.0 else None, None)
    return found


def friction_figures(scene: Scene, time: Array, signals: Signals, lock: float | None) -> Found:
    """Return the coefficient of the pack that engages, along its slip.

    The mean is the torque integrated over time by load, effective radius and faces integrated over
    time: with constant load the harmonic mean of the coefficient over speed, which is what a
    braking time measures. A coefficient belongs to the slip that the pack itself was given.
    """
    pack, start = scene.engaging, scene.shift_start
    coefficient = signals[f"{pack}.friction_coefficient"]
    slip = np.abs(signals[f"{pack}.speed"])
    stop = time[-1] if lock is None else lock
    during = np.flatnonzero((time >= start) & (time < stop) & (slip > 0.0))
    names = ("friction_start", "friction_middle", "friction_lock", "friction_mean")
    if len(during) < 2:
        return dict.fromkeys(names, (None, None))
    first, last = during[0], during[-1]
    middle = during[int(np.argmin(np.abs(slip[during] - 0.5 * slip[first])))]
    found: Found = {
        "friction_start": (float(coefficient[first]), float(time[first])),
        "friction_middle": (float(coefficient[middle]), float(time[middle])),
        "friction_lock": (None, None),
        "friction_mean": (_mean_friction(scene, time[during], signals, during), None),
    }
    if lock is not None:
        found["friction_lock"] = (float(coefficient[last]), float(time[last]))
        less = during[coefficient[during] < FULL * coefficient[last]]
        if len(less) and less[-1] < last:
            pair = slice(less[-1], less[-1] + 2)
            full = FULL * coefficient[last]
            speed, when = (np.interp(full, coefficient[pair], v[pair]) for v in (slip, time))
            found["full_friction_speed"] = (float(speed), float(when))
    return found


def _mean_friction(
    scene: Scene, time: Array, signals: Signals, during: NDArray[np.intp]
) -> float | None:
    """Return the mean coefficient behind the torque of the slipping pack."""
    pack, params = scene.engaging, scene.parts[scene.engaging].params
    torque = np.abs(signals[f"transmission.{pack}_reaction"][during])
    load = signals[f"transmission.{pack}_load"][during]
    pressed = float(np.trapezoid(load, time)) * radius_of(params) * params.faces
    return float(np.trapezoid(torque, time)) / pressed if pressed > 0.0 else None
