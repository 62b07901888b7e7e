"""An operating point of a part: what is given, what its box fixes, what is left to the defaults.

The inputs are those of the model's command, which may have another in place of one of the model's
own: a gear mesh takes power for torque.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from ..errors import ParameterError
from .advice import quantity_text, range_text
from .oil import Oil, oil_doubts
from .record import Values
from .registry import find_model
from .spec import ModelSpec, Signal

OUTSIDE = (
    "{} is outside {}, the part's box: solved all the same, but it is not what the part is meant "
    "for; change the point, or [box] in the part file"
)


class Boxed(Protocol):
    """What a point needs of a part file."""

    @property
    def spec(self) -> ModelSpec:
        """The model."""

    @property
    def box(self) -> Mapping[str, tuple[float, float]]:
        """Range [SI] of each input that it is meant for."""

    @property
    def params(self) -> Any:
        """All its parameters."""

    @property
    def oil(self) -> Oil | None:
        """Its oil, if that has a name or a data sheet."""

    def inside(self, name: str, value: float) -> float:
        """Return the value of an input, moved into the box."""


@dataclass(frozen=True, kw_only=True)
class Point:
    """Values [SI] of all inputs of a command, and where those come from that were not given."""

    values: Values
    box: Values  # fixed or moved by the part's box
    default: Values  # the model's defaults
    warnings: tuple[str, ...]  # of values outside the box
    inputs: tuple[Signal, ...]

    @property
    def taken(self) -> str:
        """In one line what was not given; "" if all was."""
        return taken_text(self.box, self.default, self.inputs)

    def origin(self, name: str) -> str:
        """Return where the value of an input comes from."""
        if name in self.box:
            return "from the part's [box]"
        return "default" if name in self.default else "given"


def taken_text(box: Values, default: Values, inputs: Sequence[Signal]) -> str:
    """Return a line that names what was taken from a box and by default; "" if nothing was."""
    parts = []
    for words, values in {"from the part's box": box, "by default": default}.items():
        known = [s for s in inputs if s.name in values]
        known = [s for s in known if not (s.optional and values[s.name] == s.usual)]
        shown = [quantity_text(s, values[s.name]) for s in known]
        if shown:
            parts.append(f"{words}: {', '.join(shown)}")
    return f"taken {'; '.join(parts)}" if parts else ""


def from_box(part: Boxed, name: str, value: float, usual: float) -> bool:
    """Tell if the value of an input that is not given is the box's doing."""
    low, high = part.box.get(name, (-math.inf, math.inf))
    return low == high or value != usual


def point_of(
    part: Boxed, given: Mapping[str, float], inputs: Iterable[Signal] | None = None
) -> Point:
    """Return the point of a part at the inputs ``given`` [SI], the rest from its box or by default.

    ``inputs`` are those of a command that has others than the model's own command. A value outside
    the box is taken, with a warning.
    """
    model = find_model(part.spec.key)
    inputs = tuple(model.inputs() if inputs is None else inputs)
    names, own = {s.name for s in inputs}, {s.name: s for s in part.spec.inputs}
    values, box = dict(given), {}
    for s in inputs:
        if s.name not in given:
            values[s.name] = part.inside(s.name, s.usual)
            if from_box(part, s.name, values[s.name], s.usual):
                box[s.name] = values[s.name]
    other = {n: values.pop(n) for n in given if n not in names}  # the model's own, as it is
    if other:
        if both := names & given.keys() - own.keys():
            raise ParameterError(f"{both.pop()} and {', '.join(other)}: allowed: one of both")
        values = model.back({n: v for n, v in values.items() if n in own} | other)
        given = {**given, **{n: v for n, v in values.items() if n not in own}}
    there = model.place(values)
    for name in [n for n in values if n not in own and n not in given]:
        moved = {n: _moved(part, n, v) for n, v in there.items()}
        if moved != there:  # the box of the model's own input decides the one instead of it
            there, values = moved, model.back(moved)
            box[name] = values[name]
    outside = [
        OUTSIDE.format(quantity_text(own[n], there[n]), range_text(own[n], ends))
        for n, ends in part.box.items()
        if n in there and _moved(part, n, there[n]) != there[n]
    ]
    if "oil_temperature" in there:
        outside += oil_doubts(part.oil, part.spec, part.params, [there["oil_temperature"]])
    left_out = {s.name for s in inputs if s.optional} | given.keys() | box.keys()
    default = {n: v for n, v in values.items() if n not in left_out}
    return Point(values=values, box=box, default=default, warnings=tuple(outside), inputs=inputs)


def _moved(part: Boxed, name: str, value: float) -> float:
    """Return a value moved into the box; where another input stands for it only its size counts."""
    inside = part.inside(name, value)
    if inside == value or name in [s.name for s in find_model(part.spec.key).inputs()]:
        return inside
    return value if part.inside(name, -value) == -value else abs(inside)
