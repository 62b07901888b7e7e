"""What a reader of a result must not miss: warnings, one line each, the same everywhere."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..errors import Status
from ..units import format_quantity
from .quantity import Figure
from .spec import ModelSpec, Signal

VERIFIED = "{value} is outside {range}, for which the accuracy was verified; use with care"
NUMBER = re.compile(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?")


@dataclass(frozen=True, slots=True)
class LawRange:
    """The range of an empirical law in one quantity, and what is to be said outside of it."""

    law: str
    quantity: str
    unit: str  # "" without one
    low: float
    high: float
    beyond: str  # what becomes of the law's numbers there
    source: str

    def line(self, value: float, where: str = "") -> str | None:
        """Return what to say of a value, None within the range; ``where`` goes before it."""
        if self.low <= value <= self.high:
            return None
        side, limit = ("below", self.low) if value < self.low else ("above", self.high)
        unit = f" {self.unit}" if self.unit else ""
        return (
            f"{where}{self.quantity} = {value:.4g}{unit}, {side} {limit:g}{unit}, the range of "
            f"{self.law}: {self.beyond}"
        )

    def words(self) -> str:
        """Return the range in words."""
        unit = f" {self.unit}" if self.unit else ""
        if self.high == math.inf:
            return f"from {self.low:g}{unit} on"
        if self.low == -math.inf:
            return f"up to {self.high:g}{unit}"
        return f"{self.low:g} .. {self.high:g}{unit}"


def quantity_text(signal: Signal | Figure, value: float) -> str:
    """Return name and value of an input or output as a person reads them."""
    return f"{signal.name} = {format_quantity(value, signal.unit, difference=signal.relative)}"


def range_text(signal: Signal, ends: tuple[float, ...]) -> str:
    """Return a range of values as a person reads it."""
    texts = (format_quantity(x, signal.unit, difference=signal.relative) for x in ends)
    return " .. ".join(texts)


def outside_verified(spec: ModelSpec, inputs: Mapping[str, Any]) -> list[str]:
    """Return a line for each input outside the range that the accuracy was verified for."""
    return [
        VERIFIED.format(value=quantity_text(s, inputs[s.name]), range=range_text(s, s.verified))
        for s in spec.inputs
        if s.verified and s.name in inputs and not s.verified[0] <= inputs[s.name] <= s.verified[1]
    ]


def warnings_of(
    spec: ModelSpec,
    status: Status,
    inputs: Mapping[str, object],
    outputs: Mapping[str, Any],
    more: Iterable[str] = (),
) -> tuple[str, ...]:
    """Return the warnings of a solution: limits passed, ranges left, the advice of its status.

    ``inputs`` and ``outputs`` hold values by the model's names; one that is not there is not
    looked at. ``more`` is what the model adds to that.
    """
    found = [f"{status.name}: {status.advice}"] if status.is_failure else []
    outside, more = outside_verified(spec, inputs), [*more]
    hot = [
        f"{quantity_text(s, outputs[s.name])}: {Status.HOT.advice}"
        for s in spec.outputs
        if s.limit and s.name in outputs and outputs[s.name] > s.limit
    ]
    explained = {Status.HOT: hot, Status.OUTSIDE_VERIFIED: [*outside, *more]}
    if not status.is_failure and status is not Status.OK and not explained.get(status):
        found.append(f"{status.name}: {status.advice}")
    return (*found, *hot, *more, *outside)


def of_whole_map(points: Sequence[Any], doubts: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """Return one line for what is said at several points, which differs in numbers alone.

    ``points``: torque [N m] and speed [rad/s] of each.
    """
    found: dict[str, dict[int, str]] = {}  # what is said -> the first such text at each point
    for k, texts in enumerate(doubts):
        for text in texts:
            found.setdefault(NUMBER.sub("", text), {}).setdefault(k, text)
    firsts = [(len(said), *next(iter(said.items()))) for said in found.values()]
    return tuple(
        f"at {n} of {len(points)} points, first at {_place(points[k])}: {text}"
        for n, k, text in firsts
    )


def _place(point: Any) -> str:
    return f"{format_quantity(point[0], 'N.m')} and {format_quantity(point[1], 'rad/s')}"
