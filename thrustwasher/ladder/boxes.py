"""Boxes of inputs: what is asked of one, what part lies inside another, what share that is."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ..errors import ParameterError
from ..model.spec import ModelSpec
from .card_parts import Axis

Interval = tuple[float, float]
Box = dict[str, Interval]


@dataclass(frozen=True, slots=True)
class Part:
    """A part of the box that was asked for: its bounds, its share of the whole, words for it."""

    box: Box
    share: float = 1.0
    where: str = ""


@dataclass(frozen=True, slots=True)
class Request:
    """What is asked of the ladder."""

    spec: ModelSpec
    box: Box
    quantity: str
    tol: float
    n_calls: float
    safety: float
    loaded: bool = False


def checked_box(spec: ModelSpec, box: Mapping[str, float | tuple[float, float]]) -> Box:
    """Return a box with an interval for every input, also of numbers, or say what is wrong."""
    names = [s.name for s in spec.inputs]
    for name in box:
        if name not in names:
            raise ParameterError(f"box: {name!r} is no input; allowed: {', '.join(names)}")
    found: Box = {}
    for signal in spec.inputs:
        if signal.name not in box and signal.optional:
            found[signal.name] = _interval(signal.name, signal.start or 0.0, signal.unit)
            continue
        if signal.name not in box:
            raise ParameterError(
                f"box: {signal.name} [{signal.unit}] is missing; every input is wanted: "
                + ", ".join(names)
            )
        found[signal.name] = _interval(signal.name, box[signal.name], signal.unit)
        (low, high), (least, largest) = found[signal.name], signal.range
        if low < least or high > largest:
            raise ParameterError(
                f"box: {signal.name} = {low:g} .. {high:g} {signal.unit}, "
                f"allowed: {least:g} .. {largest:g} {signal.unit}"
            )
    return found


def _interval(name: str, given: float | tuple[float, float], unit: str) -> Interval:
    try:
        ends = (given, given) if isinstance(given, int | float) else given
        low, high = (float(x) for x in ends)
    except (TypeError, ValueError):
        raise ParameterError(
            f"box: {name} = {given!r}, allowed: a number or (low, high) in {unit}"
        ) from None
    if not (math.isfinite(low) and math.isfinite(high) and low <= high):
        raise ParameterError(f"box: {name} = {given!r} {unit}, allowed: low <= high, both finite")
    return low, high


def sizes(interval: Interval, axis: Axis) -> Interval:
    """Return the interval of sizes where a card knows sizes only (odd or even parts)."""
    low, high = interval
    if axis.min < 0.0 or low >= 0.0:
        return interval
    return (0.0 if high >= 0.0 else -high, max(-low, high))


def split(whole: Part, envelope: Mapping[str, Axis]) -> tuple[Part | None, list[Part]]:
    """Return what of a part lies inside an envelope, and the rest in pieces.

    A box that only touches the envelope with a face has no part inside.
    """
    box, inside = whole.box, dict(whole.box)
    rest: list[tuple[str, Box]] = []
    for name, axis in envelope.items():
        low, high = sizes(box[name], axis)
        slack = 1e-9 * max(abs(axis.min), abs(axis.max))
        below, above = low < axis.min - slack, high > axis.max + slack
        parts = [(f"{name} below {axis.min:g} {axis.unit}", (low, axis.min))] if below else []
        parts += [(f"{name} above {axis.max:g} {axis.unit}", (axis.max, high))] if above else []
        a, b = max(low, axis.min), min(high, axis.max)
        if parts and a >= b:  # nothing of the box, or only its face
            return None, [Part(box, whole.share, " or ".join(words for words, _ in parts))]
        rest += [(words, {**inside, name: part}) for words, part in parts]
        inside[name] = (min(a, b), max(a, b))
    pieces = [Part(b, whole.share * share_of(b, box, envelope), words) for words, b in rest]
    return Part(inside, whole.share - sum(p.share for p in pieces)), pieces


def share_of(part: Box, whole: Box, envelope: Mapping[str, Axis]) -> float:
    """Return the share of a box that a part of it is, in the scale of the envelope's axes.

    Where a logarithmic axis begins at zero its share is taken linearly.
    """
    share = 1.0
    for name, axis in envelope.items():
        low, high = sizes(whole[name], axis)
        a, b = sizes(part[name], axis)
        if high <= low:
            continue
        if axis.scale == "log" and low > 0.0:
            share *= math.log(b / a) / math.log(high / low)
        else:
            share *= (b - a) / (high - low)
    return share
