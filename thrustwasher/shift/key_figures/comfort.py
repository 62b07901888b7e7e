"""What passengers feel of a shift: how long its phases last, jerk, torque hole, flare."""

import numpy as np

from ...numerics.jit import Array
from ..scene.scene import Scene
from .events_and_phases import Event, Signals, find_phases
from .figure_list import Found

JERK_TIME = 0.01  # s over which a change of acceleration counts
SETTLED = 0.1  # s after the shift's end: the new gear's acceleration


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

    The hole is what is missing to the smaller of two accelerations, that at the start of the shift
    and that settled after it. In an upshift this is the one after, in a downshift the one before:
    what the new gear gives or takes for good is no hole. The shift ends at ``end`` [s], where the
    later pack's slip does; without one at lock-up.
    """
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
    engine = signals["transmission.engine_speed"]
    way = -1.0 if np.interp(begin, time, engine) < 0.0 else 1.0
    high = way * (engine - ratio * signals["transmission.output_speed"])
    during = np.flatnonzero((time >= begin) & (time <= (time[-1] if lock is None else lock)))
    if len(during):
        at = during[int(np.argmax(high[during]))]
        found["flare"] = (max(0.0, float(high[at])), float(time[at]))
    if lock is not None:
        settled = max(lock, lock if end is None else end) + SETTLED
        during = np.flatnonzero((time >= begin) & (time <= settled))
        if len(during) and settled <= time[-1]:
            at = during[int(np.argmin(felt[during]))]
            smaller = float(np.min(np.interp((begin, settled), time, felt)))
            found["torque_hole"] = (max(0.0, smaller - float(felt[at])), float(time[at]))
    return found
