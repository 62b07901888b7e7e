"""Several shifts in one run: ``[sequence]`` of a scene file, and each shift as a scene."""

import math
from collections.abc import Iterator
from dataclasses import fields, replace
from itertools import pairwise
from typing import Any

from ...errors import ParameterError
from ...model.toml_tables import nothing_else, number, quantity
from ...transmission.parameters import POINTS, PROFILES, profile_fields, profile_points
from .scene import STEP_RANGE, Scene, ShiftSequence, shift_of_pressures
from .scene_tables import points_of

DIRECTIONS = ("up", "down")
KEYS = ("shifts", "repeat", "period", "window", "pause_step", "down")
RUN = ("s", 1e-3, 1e6)  # period and window
DOWN = {"clutch": "clutch_pressure", "brake": "brake_pressure", "engine": "engine_torque"}


def sequence_of(scene: Scene) -> ShiftSequence:
    """Return the sequence of a scene; ParameterError if it has none."""
    if scene.sequence is None:
        raise ParameterError(f"scene {scene.name!r}: it has no [sequence], allowed: cosimulate")
    return scene.sequence


def shift_scene(whole: Scene, i: int) -> Scene:
    """Return one shift of a run of several as a scene of its own."""
    own = sequence_of(whole)
    start, way = own.shifts[i]
    ramp: dict[str, Any] = dict(own.ramp, shift_start=own.ramp["shift_start"] + start)
    if way == "down":
        ramp |= {"shift_from": own.ramp["shift_to"], "shift_to": own.ramp["shift_from"]}
    gearbox = whole.parts["transmission"]
    params = replace(gearbox.params, **own.profiles[way])
    for name in PROFILES:
        if points := profile_points(params, name):
            later = profile_fields(name, [(t + start, x) for t, x in points])
            params = replace(params, **later)
    if params.actuation == "pressure":
        ramp = shift_of_pressures(params)
    return replace(
        whole,
        sequence=None,
        start_time=start,
        stop_time=start + own.window,
        **ramp,
        parts={**whole.parts, "transmission": replace(gearbox, params=params)},
    )


def times(whole: Scene) -> Iterator[float]:
    """Yield all communication points: even in a window, doubling up to ``pause_step`` after."""
    own = sequence_of(whole)
    now = whole.start_time
    yield now
    for start in [*(start for start, _ in own.shifts), whole.stop_time]:
        step = whole.step if now > whole.start_time else own.pause_step
        while step < own.pause_step and start - now > 2.0 * step:
            now += step
            yield now
            step = min(2.0 * step, own.pause_step)
        yield from _even(now, start, step)
        now = min(start + own.window, whole.stop_time)
        yield from _even(start, now, whole.step)


def _even(begin: float, end: float, step: float) -> Iterator[float]:
    """Yield the ends of equal steps of at most ``step`` from ``begin`` to ``end``."""
    n = math.ceil((end - begin) / step - 1e-9)
    yield from (begin + (end - begin) * i / n for i in range(1, n))
    if n:
        yield end


def checked_sequence(where: str, whole: Scene, sequence: ShiftSequence) -> Scene:
    """Return a scene with its sequence and without profiles of its own; ParameterError if wrong."""
    ends = (whole.start_time, whole.stop_time - sequence.window)
    times = [ends[0] - sequence.window, *(t for t, _ in sequence.shifts)]
    for (a, one), (b, other) in pairwise(sequence.shifts):
        if one == other:
            raise ParameterError(
                f"{where}: {other!r} at {b:g} s after {one!r} at {a:g} s, allowed: up and down in "
                "turn"
            )
    for a, b in pairwise(times):
        if not a + sequence.window <= b <= ends[1]:
            raise ParameterError(
                f"{where}: a shift at {b:g} s, allowed: window ({sequence.window:g} s) after the "
                f"one before and before stop_time, here {a + sequence.window:g} .. {ends[1]:g} s"
            )
    gearbox = whole.parts["transmission"]
    for way in dict.fromkeys(way for _, way in sequence.shifts):
        params = replace(gearbox.params, **sequence.profiles[way])
        if params.actuation == "pressure":
            profiles = [profile_points(params, name) for name in PROFILES if "pressure" in name]
            last = max(points[-1][0] for points in profiles if points)
        else:
            last = sequence.ramp["shift_start"] + sequence.ramp["shift_duration"]
        if last > sequence.window:
            raise ParameterError(
                f"{where}: window = {sequence.window:g} s, allowed: from {last:g} s on, where the "
                f"pressures of a shift {way} have settled; steps grow long behind the window"
            )
    none: dict[str, Any] = {}
    for name in PROFILES:
        none |= profile_fields(name, [(0.0, 0.0)] * POINTS) | {f"{name}_points": 0}
    if gearbox.params.engine_torque_points:
        none["engine_torque"] = 0
    parts = {
        **whole.parts,
        "transmission": replace(gearbox, params=replace(gearbox.params, **none)),
    }
    return replace(whole, sequence=sequence, parts=parts)


def read_sequence(where: str, scene: Scene, table: dict[str, Any]) -> ShiftSequence:
    """Return the shifts of a run; those up are the scene's own, those down have a table."""
    nothing_else(where, table, KEYS)
    numbers = {k: number(where, k, table[k], RUN) for k in ("period", "window") if k in table}
    for key in ("shifts", "window"):
        if key not in table:
            raise ParameterError(f"{where}: {key!r} is missing")
    given, repeat = table["shifts"], table.get("repeat", 1)
    pairs = isinstance(given, list) and all(isinstance(p, list) and len(p) == 2 for p in given)
    if not pairs or not given or any(way not in DIRECTIONS for _, way in given):
        raise ParameterError(f"{where}: shifts = {given!r}, allowed: pairs [time, 'up' or 'down']")
    if not isinstance(repeat, int) or not 1 <= repeat <= 1000:
        raise ParameterError(f"{where}: repeat = {repeat!r}, allowed: 1 .. 1000")
    if repeat > 1 and "period" not in table:
        raise ParameterError(f"{where}: 'period' is missing with repeat = {repeat}")
    pause = number(where, "pause_step", table.get("pause_step", 0.5), ("s", *STEP_RANGE))
    first = [(quantity(where, "time", t, "s"), way) for t, way in given]
    later = [i * numbers.get("period", 0.0) for i in range(repeat)]
    params = scene.parts["transmission"].params
    if params.actuation == "pressure" and "down" not in table and "down" in dict(first).values():
        raise ParameterError(f"{where}: [sequence.down] is missing, the profiles of a shift down")
    own: dict[str, Any] = {}
    sources = {f"{name}_from" for name in DOWN}  # what is said of profiles in files
    down = {key: x for key, x in table.get("down", {}).items() if key not in sources}
    nothing_else(f"{where[:-1]}.down]", down, DOWN)
    for name, key in DOWN.items():
        own |= profile_fields(key, points) if (points := profile_points(params, key)) else {}
        if name in down:
            place = f"{where[:-1]}.down]"
            down |= points_of(place, key, name, {"points": down.pop(name)})
    return ShiftSequence(
        shifts=tuple((t + more, way) for more in later for t, way in first),
        window=numbers["window"],
        pause_step=pause,
        profiles={"up": own, "down": down or own},
        ramp={f.name: getattr(scene, f.name) for f in fields(scene) if f.name.startswith("shift_")},
    )
