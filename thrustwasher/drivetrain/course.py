"""The course of a shift, read from its signals: events and phases."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..kernels.clutch_step import HOT_LIMIT
from .result import Event, Phase
from .scene import Scene

Signals = dict[str, NDArray[np.float64]]
STANDSTILL = 1.0  # rad/s
# What a change of a Boolean signal means: (signal, kind and text when it rises, when it falls,
# signals with the located time; None: known to the communication step only).
CHANGES = (
    ("transmission.clutch_locked", ("clutch_locked", "clutch locks"),
     ("clutch_released", "clutch breaks away"), "transmission.lock_time", None),
    ("transmission.brake_locked", ("brake_locked", "brake holds the ring"),
     ("brake_released", "brake lets go of the ring"), None, "transmission.release_time"),
    ("washer.distress", ("film_lost", "washer loses its film"),
     ("film_regained", "washer regains its film"), None, None),
)  # fmt: skip


def turning(signals: Signals) -> NDArray[np.bool_]:
    """Return where the washer turns; one that stands still has no film to lose."""
    return np.asarray(np.abs(signals["transmission.washer_speed"]) > STANDSTILL)


def events(scene: Scene, time: NDArray[np.float64], signals: Signals) -> list[Event]:
    """Return all events in the order of time."""
    found = [Event(scene.shift_start, "ramp_start", "shift ramp starts")]
    end = scene.shift_start + scene.shift_duration
    found.append(Event(end, "ramp_end", "shift ramp ends"))
    found = [e for e in found if scene.start_time <= e.time <= scene.stop_time]
    for name, up, down, up_time, down_time in CHANGES:
        if name not in signals:
            continue
        on = signals[name] > 0.5
        if name == "washer.distress":
            on &= turning(signals)
        if on[0] and name == "washer.distress":
            found.append(Event(float(time[0]), "film_lost", "washer has no film at the start"))
        for i in np.flatnonzero(on[1:] != on[:-1]) + 1:
            (kind, text), located = (up, up_time) if on[i] else (down, down_time)
            found.append(Event(float(signals[located][i] if located else time[i]), kind, text))
    for pack in ("clutch", "brake"):
        hot = np.flatnonzero(signals[f"{pack}.temperature"] > HOT_LIMIT)
        if len(hot):
            when = float(time[hot[0]])
            found.append(Event(when, f"{pack}_hot", f"{pack} is hotter than {HOT_LIMIT:g} K"))
    return sorted(found, key=lambda e: e.time)


def phases(scene: Scene, found: list[Event]) -> list[Phase]:
    """Return first gear, torque phase, inertia phase and locked, as far as the run got."""
    stop = scene.stop_time
    start = min(max(scene.shift_start, scene.start_time), stop)
    release = next((e.time for e in found if e.kind == "brake_released" and e.time >= start), stop)
    lock = next((e.time for e in found if e.kind == "clutch_locked" and e.time >= start), stop)
    release = min(release, lock)
    marks = [
        ("first gear", scene.start_time, start),
        ("torque phase", start, release),
        ("inertia phase", release, lock),
        ("locked", lock, stop),
    ]
    return [Phase(name, a, b) for name, a, b in marks if b > a]
