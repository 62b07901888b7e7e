"""What a sweep varies: ``load=50:1850:50`` becomes a name, a unit and values."""

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ...errors import ParameterError, suggestion
from ...model.quantity import Quantity
from ...model.spec import ModelSpec
from ...settings import find_place
from ...units import parse_quantity

MOST_POINTS = 4_000_000


@dataclass(frozen=True)
class Axis:
    """One thing that is varied, with its values in the order of the sweep."""

    place: Quantity
    values: tuple[Any, ...]


def read_axis(
    name: str,
    values: str | Iterable[object],
    known: Mapping[str, Quantity],
    spec: ModelSpec | None = None,
) -> Axis:
    """Return the axis that a name ("load", or "load [kN]" for bare numbers) and values make.

    The values are a text as in ``parse_values``, or numbers (texts for enumerations).
    """
    match = re.fullmatch(r"([^\[\]]*?)\s*(?:\[([^\[\]]*)\])?", name)
    if match is None:
        raise ParameterError(
            f"{name!r}: allowed: the name of an input or parameter, or NAME [UNIT]"
        )
    place = find_quantity(match[1].replace("-", "_"), known, spec)
    if isinstance(values, str):
        found = parse_values(values, place, (match[2] or "").strip())
    else:
        items = [values] if isinstance(values, int | float) else list(values)
        found = [place.check(v) for v in items]
    if not found:
        raise ParameterError(f"{place.name}: no value is given")
    return Axis(place, tuple(found))


def find_quantity(name: str, known: Mapping[str, Quantity], spec: ModelSpec | None) -> Quantity:
    """Return the quantity of that name; ParameterError with the nearest names if there is none."""
    if spec is not None:
        return find_place(name, known, spec)
    if name not in known:
        hint = suggestion(name, known, "; did you mean {}?")
        raise ParameterError(f"{name}: there is no such parameter, input or path{hint}")
    return known[name]


def parse_values(text: str, place: Quantity, written: str = "") -> list[Any]:
    """Return the values of a text: single ones and ranges, separated by commas.

    ``start:stop:step`` goes on as long as it is not past ``stop``; ``start:stop:n40`` has 40 values
    with equal differences, ``start:stop:x40`` 40 with equal ratios. Numbers may have units; a bare
    one is SI, or in ``written``.

    Examples
    --------
    >>> from thrustwasher.clutch.parameters import SPEC
    >>> from thrustwasher.settings import places
    >>> parse_values("1:2:0.5, 8", places(SPEC)["load"])
    [1.0, 1.5, 2.0, 8.0]
    >>> parse_values("1 kN:100 kN:x3", places(SPEC)["load"])
    [1000.0, 10000.0, 100000.0]
    """
    values: list[Any] = []
    for item in (part.strip() for part in text.split(",")):
        if place.kind in ("boolean", "enumeration") or ":" not in item:
            values.append(place.check(_with_unit(item, written)))
        else:
            values += _range(item, place, written)
        if len(values) > MOST_POINTS:
            raise ParameterError(f"{place.name} = {text}: more than {MOST_POINTS} values")
    return values


def _with_unit(item: str, written: str) -> str:
    """Return the text with the unit that bare numbers of this axis have."""
    bare = re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", item)
    return f"{item} {written}" if written and bare else item


def _range(item: str, place: Quantity, written: str) -> list[Any]:
    """Return the values of ``start:stop:step``, ``start:stop:n40`` or ``start:stop:x40``."""
    where = f"{place.name} = {item}"
    parts = [part.strip() for part in item.split(":")]
    if len(parts) != 3:
        raise ParameterError(
            f"{where}, allowed: start:stop:step, start:stop:n40 (40 values, even) or "
            "start:stop:x40 (40 values, equal ratios)"
        )
    start, stop = (float(place.check(_with_unit(p, written))) for p in parts[:2])
    counted = re.fullmatch(r"([nx])(\d{1,8})", parts[2])
    if counted:
        return [place.check(v) for v in _counted(where, start, stop, counted[1], int(counted[2]))]
    step = parse_quantity(_with_unit(parts[2], written), place.unit, place.name, difference=True)
    if step == 0.0 or (stop - start) / step < 0.0:
        raise ParameterError(
            f"{where}, allowed: a step from start towards stop (negative where stop is lower)"
        )
    n = (stop - start) / step
    if n >= MOST_POINTS:
        raise ParameterError(f"{where}: more than {MOST_POINTS} values")
    last = math.floor(n + 1e-9)
    values = [start + step * i for i in range(last + 1)]
    if abs(n - last) < 1e-9:
        values[-1] = stop  # not a rounding error next to it
    return [place.check(v) for v in values]


def _counted(where: str, start: float, stop: float, kind: str, n: int) -> list[float]:
    """Return ``n`` values with equal differences or ratios, both ends among them."""
    if not 2 <= n <= MOST_POINTS:
        raise ParameterError(f"{where}, allowed: 2 .. {MOST_POINTS} values")
    shares = [i / (n - 1) for i in range(n)]
    if kind == "n":
        return [*(start + (stop - start) * share for share in shares[:-1]), stop]
    if start * stop <= 0.0:
        raise ParameterError(f"{where}, allowed: two numbers of one sign, not zero, for x{n}")
    return [*(start * (stop / start) ** share for share in shares[:-1]), stop]
