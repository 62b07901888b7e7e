"""What passengers feel of a shift: how long its phases last, jerk, torque hole, flare."""

import math

import numpy as np

from ...numerics.jit import Array
from ...transmission.kernels import shift_figures as K
from ..scene.scene import Scene
from .events_and_phases import Event, Signals, find_phases
from .figure_list import Found

COMFORT = {"peak_jerk": K.JERK, "flare": K.FLARE, "torque_hole": K.HOLE}


def phase_figures(scene: Scene, signals: Signals, events: list[Event], lock: float | None) -> Found:
    """Return how long torque and inertia phase last, and when the engaging piston was full."""
    lasts: dict[str, float] = {}
    for p in find_phases(scene, signals, events):
        lasts[p.name] = lasts.get(p.name, 0.0) + p.end - p.start
    found: Found = {}
    if "torque phase" in lasts or "inertia phase" in lasts:
        found["torque_phase"] = (lasts.get("torque phase"), None)
        found["inertia_phase"] = (lasts.get("inertia phase") if lock is not None else None, None)
    if scene.kiss_end is not None:
        kind = f"{scene.engaging}_filled"
        found["filled_time"] = (next((e.time for e in events if e.kind == kind), None), None)
    return found


def comfort_figures(
    scene: Scene, time: Array, signals: Signals, lock: float | None, end: float | None = None
) -> Found:
    """Return jerk and torque hole of the vehicle, and the engine's flare; without one none.

    The shift ends at ``end`` [s], where the later pack's slip does; without one at lock-up.
    """
    if scene.vehicle is None:
        return {}
    names = (
        f"transmission.{name}" for name in ("output_acceleration", "engine_speed", "output_speed")
    )
    points, turning, engine, output = map(
        np.ascontiguousarray, (time, *(signals[n] for n in names))
    )
    ratio, found = 1.0 + scene.parts["transmission"].params.ratio, np.empty(K.N_COMFORT)
    held, over = (math.nan if t is None else t for t in (lock, end))
    felt = scene.vehicle.reach * turning
    K.comfort(points, felt, engine, output, ratio, scene.shift_start, held, over, found)
    values = [None if math.isnan(x) else float(x) for x in found]
    return {name: (values[at], values[at + 1]) for name, at in COMFORT.items()}
