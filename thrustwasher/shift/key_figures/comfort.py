"""What passengers feel of a shift: how long its phases last, jerk, torque hole, flare."""

import numpy as np

from ...numerics.jit import Array
from ..scene.scene import Scene
from .events_and_phases import Event, Signals, find_phases
from .figure_list import Found

JERK_TIME = 0.01  # s over which a change of acceleration counts
SETTLED = 0.1  # s after lock-up: the new gear's acceleration


def phase_figures(scene: Scene, signals: Signals, events: list[Event], lock: float | None) -> Found:
    """Return how long torque and inertia phase last, and when the engaging piston was full."""
    lasts = {p.name: p.end - p.start for p in find_phases(scene, signals, events)}
    found: Found = {}
    if "torque phase" in lasts:
        found["torque_phase"] = (lasts["torque phase"], None)
        found["inertia_phase"] = (lasts.get("inertia phase") if lock is not None else None, None)
    if scene.kiss_end is not None:
        kind = f"{scene.engaging}_filled"
        found["filled_time"] = (next((e.time for e in events if e.kind == kind), None), None)
    return found


def comfort_figures(scene: Scene, time: Array, signals: Signals, lock: float | None) -> Found:
    """Return jerk and torque hole of the vehicle, and the engine's flare; without one none."""
    if scene.vehicle is None:
        return {}
    felt = scene.vehicle.reach * signals["transmission.output_acceleration"]
    begin, ratio = scene.shift_start, 1.0 + scene.parts["transmission"].params.ratio
    after = (time >= begin) & (time <= time[-1] - JERK_TIME)
    change = np.abs(np.interp(time + JERK_TIME, time, felt) - felt)
    at = int(np.argmax(np.where(after, change, -1.0)))
    found: Found = {
        "peak_jerk": (float(change[at]) / JERK_TIME, float(time[at])),
        "torque_hole": (None, None),
    }
    end = time[-1] if lock is None else lock
    high = signals["transmission.engine_speed"] - ratio * signals["transmission.output_speed"]
    during = np.flatnonzero((time >= begin) & (time <= end))
    if len(during):
        at = during[int(np.argmax(high[during]))]
        found["flare"] = (max(0.0, float(high[at])), float(time[at]))
    if lock is not None and lock + SETTLED <= time[-1]:
        during = np.flatnonzero((time >= begin) & (time <= lock + SETTLED))
        at = during[int(np.argmin(felt[during]))]
        settled = float(np.interp(lock + SETTLED, time, felt))
        found["torque_hole"] = (max(0.0, settled - float(felt[at])), float(time[at]))
    return found
