"""Events and phases of a shift, read from its signals."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.toml_tables import table_beside
from ...numerics.jit import Array
from ...transmission.kernels.shift_figures import held_from, standstill
from ..scene.connections import PACKS
from ..scene.scene import Scene
from ..warning_texts import text_of

Signals = dict[str, Array]
STANDSTILL = 1.0  # rad/s
CHANGES = table_beside(__file__, "changes.toml")
GEARS = {"brake": "first gear", "clutch": "second gear"}  # what holds when a pack is locked
SLIPPING = {"brake": "braking", "clutch": "engaging"}  # a pack that takes over from no other


class Event(NamedTuple):
    """Something that happened at one time [s]."""

    time: float
    kind: str
    text: str


class Phase(NamedTuple):
    """An interval of the shift [s]."""

    name: str
    start: float
    end: float


def turning(signals: Signals) -> NDArray[np.bool_]:
    """Return where the planets turn; washers and teeth that stand still have no film to lose."""
    return np.asarray(np.abs(signals["transmission.washer_speed"]) > STANDSTILL)


def find_events(scene: Scene, time: Array, signals: Signals) -> list[Event]:
    """Return all events in the order of time."""
    start, last = (
        ("shift ramp starts", "shift ramp ends")
        if scene.kiss_end is None
        else ("pressures begin to move", "pressures have settled")
    )
    found = [Event(scene.shift_start, "ramp_start", start)]
    if scene.shift_duration > 0.0:
        found.append(Event(scene.shift_start + scene.shift_duration, "ramp_end", last))
    found = [e for e in found if scene.start_time <= e.time <= scene.stop_time]
    for name, change in CHANGES.items():
        if name not in signals:
            continue
        on = signals[name] > 0.5
        if name == "washer.distress":
            on &= turning(signals)
        if on[0] and name == "washer.distress":
            found.append(Event(float(time[0]), "film_lost", "washer has no film at the start"))
        for i in np.flatnonzero(on[1:] != on[:-1]) + 1:
            kind, text, *located = change["rises" if on[i] else "falls"]
            when = float(signals[located[0]][i] if located else time[i])
            if kind == "brake_locked":
                when = _standstill(time, signals, int(i))
            found.append(Event(when, kind, text))
    limited = ((n, s, s.limit) for n, p in scene.parts.items() for s in p.spec.outputs if s.limit)
    for part, signal, limit in limited:
        hot = np.flatnonzero(signals[f"{part}.{signal.name}"] > limit)
        if len(hot):
            when = float(time[hot[0]])
            found.append(Event(when, f"{part}_hot", text_of("hot_part", part=part, limit=limit)))
    return sorted([*found, *_of_pistons(scene, time, signals)], key=lambda e: e.time)


def _of_pistons(scene: Scene, time: Array, signals: Signals) -> Iterator[Event]:
    """Say where pistons touch, and where the pack that lets go carries nothing any more."""
    if scene.kiss_end is None:
        return
    for pack in PACKS:
        full = signals[f"transmission.{pack}_filled_time"]  # where it is full at once, it touches
        for when in np.setdiff1d(signals[f"transmission.{pack}_kiss_time"], full):
            if when > time[0]:
                yield Event(float(when), f"{pack}_kiss", f"{pack}'s piston touches its plates")
    other = scene.releasing
    torque = signals[f"transmission.{other}_reaction"]
    held = np.sign(np.interp(scene.shift_start, time, torque))
    free = np.flatnonzero((time > scene.shift_start) & (held * torque <= 0.0))
    if held and len(free):
        i = slice(free[0] - 1, free[0] + 1)
        when = np.interp(0.0, -held * torque[i], time[i])
        yield Event(float(when), f"{other}_unloaded", f"{other} carries nothing")


def _standstill(time: Array, signals: Signals, i: int) -> float:
    """Return when the drum came to rest in the step that ends at point ``i``.

    The transmission locates it but does not hand it out. The brake's heat of that step does.
    """
    slip, torque, heat = (
        signals[f"transmission.brake_{name}"] for name in ("speed", "reaction", "heat")
    )
    power, begin, end = abs(slip[i - 1] * torque[i - 1]), float(time[i - 1]), float(time[i])
    return standstill(begin, end, float(power), float(heat[i] - heat[i - 1]))


def locks_of(scene: Scene, found: list[Event]) -> list[float]:
    """Return when the engaging pack locked [s], while it was meant to hold."""
    until = scene.required_until
    kind = f"{scene.engaging}_locked"
    return [e.time for e in found if e.kind == kind and scene.shift_start <= e.time <= until]


def lock_up(scene: Scene, found: list[Event]) -> float | None:
    """Return the lock [s] after which the engaging pack holds, to the end or its wanted release.

    None if it does not: it slips at last, or still sticks and slips in turn for as long as it
    already did.
    """
    locks, released = (
        np.array([e.time for e in found if e.kind == f"{scene.engaging}_{kind}"], np.float64)
        for kind in ("locked", "released")
    )
    held = held_from(locks, released, scene.shift_start, scene.required_until)
    return None if math.isnan(held) else held


def find_phases(scene: Scene, signals: Signals, found: list[Event]) -> list[Phase]:
    """Return gear, fill, torque phase, inertia phase and locked, as far as the run got.

    In the torque phase one pack takes the torque over from the other. In an upshift it comes first;
    in a downshift under power the speeds change first, and the pack that has locked then takes
    over, until the other is no longer pressed. A pack that takes over from no other has no torque
    phase: it slips from the ramp on. The inertia phase ends where the pack holds; one that sticks
    and slips in turn to the end has a phase of its own.
    """
    stop = scene.stop_time
    start = min(max(scene.shift_start, scene.start_time), stop)
    pack, other = scene.engaging, scene.releasing

    def first(kind: str, after: float = start) -> float:
        return next((e.time for e in found if e.kind == kind and e.time >= after), stop)

    locks, held = locks_of(scene, found), lock_up(scene, found)
    lock = held if held is not None else min([*locks[:1], stop])
    release, free = min(first(f"{other}_released"), lock), lock
    was = [
        e.kind
        for e in found
        if e.time <= start and e.kind in (f"{other}_locked", f"{other}_released")
    ]
    if (was[-1] if was else "") == f"{other}_locked" or (
        not was and signals[f"transmission.{other}_locked"][0] > 0.5
    ):
        kiss = start
        if scene.kiss_end is not None:
            full = next((e.time for e in found if e.kind == f"{pack}_filled"), start)
            release = min(release, first(f"{other}_unloaded"))
            kiss = min(max(scene.kiss_end, full), release)  # the other may let go before
        marks = [
            (GEARS[other], scene.start_time, start),
            ("fill", start, kiss),
            ("torque phase", kiss, release),
            ("inertia phase", release, lock),
        ]
        opens = scene.shift_start + scene.shift_duration
        if scene.kiss_end is not None:
            opens = next((e.time for e in found if e.kind == f"{other}_emptied"), lock)
        free = min(max(opens, lock), stop)
        marks.append(("torque phase", lock, free))
    else:
        marks = [("free", scene.start_time, start), (SLIPPING[pack], start, lock)]
    last = free if held is not None else stop
    gone = first(f"{pack}_released", max(last, free))
    marks += [("stick-slip", free, last), ("locked", max(last, free), gone), ("open", gone, stop)]
    return [Phase(name, a, b) for name, a, b in marks if b > a]
