"""What a scene and the signals of its run show without a further run: warnings."""

from collections.abc import Iterator, Mapping
from contextlib import suppress

import numpy as np

from ...errors import ParameterError, Status
from ...model.advice import outside_verified
from ...model.registry import outside_laws
from ...numerics.jit import Array
from ...units import format_quantity as say
from ..key_figures.figure_list import FILM_SPEED
from ..scene.connections import PACKS
from ..scene.doubts import idle_parameters
from ..scene.scene import Scene
from ..warning_texts import warning

Signals = Mapping[str, Array]
OTHER_STEP = 0.01  # of the step requested: by so much another is worth a word
MOST_OUTSIDE = 0.05  # share of a run's points that a map may leave to the field
ROOM = 1e-6  # of a box's width
STATUS_RANKS = {Status.STALLED: 0, Status.CHATTER: 0, Status.HOT: 1}  # as of tables of texts


def doubts(scene: Scene, step: float, time: Array, signals: Signals) -> Iterator[str]:
    """Yield what must not be missed, a line each."""
    yield from dict.fromkeys((*scene.warnings, *idle_parameters(scene)))
    yield from _of_times(scene, step)
    yield from _of_solvers(scene, time, signals)
    yield from _of_boxes(scene, signals)
    yield from _of_linings(scene, signals)
    yield from _of_maps(scene, signals)
    yield from _of_dry_friction(scene, time, signals)


def _of_times(scene: Scene, step: float) -> Iterator[str]:
    begin, end = scene.shift_start, scene.shift_start + scene.shift_duration
    if begin < scene.start_time:
        yield warning("begins_before", begin=begin, start=scene.start_time)
    if begin >= scene.stop_time:
        yield warning("begins_after", begin=begin, stop=scene.stop_time)
    elif end > scene.stop_time:
        yield warning("ends_after", stop=scene.stop_time, end=end)
    if abs(step / scene.step - 1.0) > OTHER_STEP:
        yield warning("other_step", step=step, given=scene.step)


def _of_solvers(scene: Scene, time: Array, signals: Signals) -> Iterator[str]:
    """Yield the advice behind every solver status that occurred, with its first time."""
    for name, values in signals.items():
        if name.endswith(".solver_status"):
            for code in np.unique(values[values > 0.0]):
                i, status = int(np.argmax(values == code)), Status(int(code))
                part = name.partition(".")[0]
                if status == Status.DISTRESS:  # the film's loss has an event of its own
                    continue
                spec, params = scene.parts[part].spec, scene.parts[part].params
                now = {s.name: float(signals[f"{part}.{s.name}"][i]) for s in spec.inputs}
                found = []
                if status == Status.OUTSIDE_VERIFIED:
                    found = [
                        *outside_verified(spec, now),
                        *outside_laws(spec.key, params, now),
                    ]
                advice = warning("advice", advice=status.advice, name=status.name)
                for text in found or [advice]:
                    rank = STATUS_RANKS.get(status)
                    yield warning("status", rank, part=part, time=time[i], text=text)


def _of_boxes(scene: Scene, signals: Signals) -> Iterator[str]:
    """Yield the inputs that left what a part's file is meant for."""
    for name, part in scene.parts.items():
        for key, (low, high) in part.labels.get("box", {}).items():
            values, room = signals.get(f"{name}.{key}"), ROOM * max(high - low, abs(high), abs(low))
            if values is None:
                continue
            least, most = float(values.min()), float(values.max())
            if least < low - room or most > high + room:
                unit = next(s.unit for s in part.spec.inputs if s.name == key)
                found = {"low": least, "high": most, "minimum": low, "most": high}
                ends = {end: say(value, unit) for end, value in found.items()}
                yield warning("box", part=name, key=key, **ends)


def _of_linings(scene: Scene, signals: Signals) -> Iterator[str]:
    """Yield what a pack's lining does not bear, at the maximum load."""
    for name in PACKS:
        if (load := signals.get(f"{name}.load")) is not None:
            part = scene.parts[name]
            found = outside_laws(part.spec.key, part.params, {"load": float(load.max())})
            yield from (warning("of_part", part=name, text=text) for text in found)


def _of_maps(scene: Scene, signals: Signals) -> Iterator[str]:
    """Yield how much of a run a washer's map did not answer."""
    part = scene.parts.get("washer")
    names = [f"washer.{n}" for n in ("load", "speed", "tilt", "oil_temperature")]
    if part is None or part.fidelity != "map" or any(n not in signals for n in names):
        return
    from ...washer.map.look_up import outside_text

    points = np.column_stack([signals[n] for n in names])
    with suppress(ParameterError):  # another's washer: it answered without a map of ours
        if text := outside_text(part.params, points, "steps", MOST_OUTSIDE):
            yield warning("of_part", part="washer", text=text)


def _of_dry_friction(scene: Scene, time: Array, signals: Signals) -> Iterator[str]:
    """Yield how often a washer's contacts press outside the data of their dry friction."""
    part = scene.parts.get("washer")
    names = [f"washer.{n}" for n in ("load", "speed", "fluid_load_share", "friction_torque")]
    if part is None or any(n not in signals for n in names):
        return
    from ...washer.washer_result import friction_warning

    load, speed, share, torque = (signals[n] for n in names)
    contact = np.where(np.abs(speed) >= FILM_SPEED, load * (1.0 - share), 0.0)
    texts = [
        friction_warning(part.params, *point)
        for point in zip(contact.tolist(), np.abs(torque).tolist(), strict=True)
    ]
    if n := sum(map(bool, texts)):
        first = next(i for i, text in enumerate(texts) if text)
        points = len(texts)
        yield warning("dry_friction", count=n, points=points, time=time[first], text=texts[first])
