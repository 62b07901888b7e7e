"""Whether the packs hold when they should: warnings from the signals of a run."""

from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ...clutch.parameters import ClutchParams
from ...clutch.release import cold_release
from ...clutch.solve import doubts_of_warmth
from ...numerics.jit import Array
from ...transmission.kernels.directional_derivative import LEAST_WASHER_LOAD
from ...transmission.kernels.shift_figures import FEW
from ..cosim.loop import Recorder
from ..key_figures.events_and_phases import STANDSTILL, Event, lock_up, locks_of
from ..key_figures.figure_list import KeyFigure
from ..scene.connections import PACKS
from ..scene.scene import Scene
from ..warning_texts import warning
from .capacity import SETTLED, weak_packs

Signals = Mapping[str, Array]
TURNS_SHARE = 0.02  # of the time to lock-up: shorter sticking in turn changes no figure
NUMERICAL = 10.0  # steps between two lock-ups, at most
KISS = 0.1  # of the maximum load: a pack that lets go later has more; one that engages SETTLED
FLARE = 10.0  # rad/s, some 100 rpm: felt and heard


def doubts_of_packs(
    scene: Scene, time: Array, signals: Signals, events: list[Event], figures: Sequence[KeyFigure]
) -> Iterator[str]:
    """Yield what shows that packs do not hold as a shift takes for granted, a line each."""
    held = lock_up(scene, events) is not None
    weak = weak_packs(scene, time, signals, held=held, handed=not _free(scene, time, signals).any())
    yield from weak.values()  # the cause of what follows
    yield from _at_the_start(scene, time, signals, weak)
    yield from _in_turn(scene, time, events)
    yield from _of_temperature(scene, time, signals)
    if not scene.alone:
        yield from _neutral(scene, time, signals, figures, weak)
        yield from _at_the_end(scene, time, signals, events)
    yield from _of_washers(signals)


def _at_the_start(
    scene: Scene, time: Array, signals: Signals, weak: Collection[str]
) -> Iterator[str]:
    before = time <= max(scene.shift_start, time[0])
    for pack in PACKS:
        if pack in weak and pack != scene.engaging:
            continue
        load, slip = (signals[f"transmission.{pack}_{name}"] for name in ("load", "speed"))
        least = SETTLED if pack == scene.engaging else KISS
        slips = (load > least * load.max()) & (np.abs(slip) > STANDSTILL) & before
        if slips.any():
            i = int(np.argmax(slips))
            yield warning("before_shift", time=time[i], pack=pack, load=load[i], slip=abs(slip[i]))


def _in_turn(scene: Scene, time: Array, events: list[Event]) -> Iterator[str]:
    locks, held = locks_of(scene, events), lock_up(scene, events)
    if held is None or len(locks) < FEW:
        return
    first = locks[0]
    if held - first <= TURNS_SHARE * (held - scene.shift_start):
        return
    between = np.diff(time[(time >= first) & (time <= held)])
    step = float(np.median(between)) if len(between) else scene.step
    every = (held - first) / ((len(locks) - 1) * step)
    why = warning("why_numerical", every=every) if every <= NUMERICAL else warning("why_overloaded")
    count = len(locks)
    yield warning("in_turn", pack=scene.engaging, first=first, last=held, count=count, why=why)


def _of_temperature(scene: Scene, time: Array, signals: Signals) -> Iterator[str]:
    for pack in PACKS:
        part = scene.parts[pack]
        if not isinstance(part.params, ClutchParams):
            continue
        warm = signals[f"{pack}.temperature"]
        ends = float(warm.min()), float(warm.max())
        for line in doubts_of_warmth(part.params, *ends, part.fidelity):
            yield warning("warmth", pack=pack, text=line)
        of_pack = {n: signals[f"{pack}.{n}"] for n in ("load", "speed", "film_ratio", "energy")}
        for line in cold_release(
            part.params,
            part.fidelity,
            time=time,
            **of_pack,
            torque=signals[f"{pack}.friction_torque"],
            oil_temperature=scene.oil_temperature,
        ):
            yield f"The {pack} is {line}"


def _free(scene: Scene, time: Array, signals: Signals) -> NDArray[np.bool_]:
    """Return where neither pack is pressed during the shift."""
    return _open(signals) & (time >= scene.shift_start) & (time <= scene.required_until)


def _neutral(
    scene: Scene,
    time: Array,
    signals: Signals,
    figures: Sequence[KeyFigure],
    weak: Collection[str],
) -> Iterator[str]:
    flare = next((f for f in figures if f.name == "flare"), None)
    most = flare.value or 0.0 if flare else 0.0
    pack, other = scene.engaging, scene.releasing
    free = _free(scene, time, signals)
    if not free.any() and (most <= FLARE or weak):
        return
    if free.any():
        begin = int(np.argmax(free))
        end = begin + int(np.argmin(free[begin:])) if not free[begin:].all() else len(time) - 1
        cause = warning("neutral", begin=time[begin], end=time[end], pack=pack, other=other)
        yield cause + (warning("neutral_flare", flare=most) if most > FLARE else "")
    else:
        at = flare.time if flare and flare.time is not None else scene.shift_start
        yield warning("flare", flare=most, time=at, pack=pack, other=other)


def _open(signals: Signals) -> NDArray[np.bool_]:
    """Return where neither pack is pressed, once one was."""
    pressed = np.logical_or(*(signals[f"transmission.{pack}_load"] > 0.0 for pack in PACKS))
    return np.asarray(~pressed & np.logical_or.accumulate(pressed))


def _at_the_end(scene: Scene, time: Array, signals: Signals, events: list[Event]) -> Iterator[str]:
    held = lock_up(scene, events)
    kind = f"{scene.engaging}_released"
    gone = [e.time for e in events if e.kind == kind and held is not None and e.time >= held]
    if gone and not any(signals[f"transmission.{pack}_locked"][-1] > 0.5 for pack in PACKS):
        until = scene.required_until
        yield warning("lets_go", pack=scene.engaging, held=held, gone=gone[-1], until=until)


def _of_washers(signals: Signals) -> Iterator[str]:
    load = signals.get("transmission.washer_load")
    if load is None or "washer.friction_torque" not in signals or load.max() > LEAST_WASHER_LOAD:
        return
    heat = float(signals["transmission.washer_heat"][-1])
    if heat > 0.0:
        yield warning("unloaded_washers", minimum=LEAST_WASHER_LOAD, heat=heat)


def failed_because(scene: Scene, time: Array, recorder: Recorder) -> str:
    """Return what may have made a run fail: nothing pressed at the last point, doubts before it.

    Rows of points that were not reached are NaN.
    """
    signals = recorder.signals()
    done = np.flatnonzero(np.isfinite(signals["transmission.clutch_load"]))
    reasons = list(scene.warnings)
    if len(done):
        reached = {name: values[: done[-1] + 1] for name, values in signals.items()}
        locked = np.logical_or(*(reached[f"transmission.{p}_locked"] > 0.5 for p in PACKS))
        if not locked[-1]:
            held = np.flatnonzero(locked)
            since = float(time[held[-1]]) if len(held) else float(time[0])
            state = warning("failed_open" if _open(reached)[-1] else "failed_slipping")
            speed = float(reached["transmission.engine_speed"][-1])
            at = time[done[-1]]
            why = warning("failed", since=since, state=state, time=at, speed=speed)
            points = time[: done[-1] + 1]
            weak = weak_packs(scene, points, reached, held=False, handed=False)
            reasons = [*weak.values(), why, *reasons]
    return "; ".join(reasons)
