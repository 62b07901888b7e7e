"""What a sweep varies: ``load=50:1850:50`` becomes a name, a unit and values."""

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from typing import Any

from ..errors import ParameterError, suggestion
from ..model.parameters import check_value
from ..model.registry import find_model
from ..model.spec import ModelSpec
from ..units import has_unit, parse_quantity

MOST_POINTS = 4_000_000
BOOLEANS = {"true": True, "yes": True, "1": True, "false": False, "no": False, "0": False}


@dataclass(frozen=True)
class Place:
    """An input or a parameter that can be varied."""

    name: str
    is_input: bool
    meta: Mapping[str, Any]  # as a parameter's field has it

    @property
    def unit(self) -> str:
        """Unit of numbers without one."""
        return str(self.meta["unit"])

    @property
    def kind(self) -> str:
        """Real, integer, boolean or enumeration."""
        return str(self.meta["kind"])

    def check(self, value: Any) -> float | int | bool | str:
        """Return a value given in Python or as text; ParameterError names what is allowed."""
        if self.kind == "boolean" and str(value).lower() in BOOLEANS:
            return BOOLEANS[str(value).lower()]
        if self.kind in ("enumeration", "boolean"):
            check_value(self.name, value, self.meta)
            return str(value) if self.kind == "enumeration" else bool(value)
        given = value if isinstance(value, str) else float(value)
        relative = bool(self.meta.get("relative"))
        number = parse_quantity(given, self.unit, self.name, difference=relative)
        number = check_value(self.name, number, self.meta, stated=has_unit(value))
        return int(number) if self.kind == "integer" else number


@dataclass(frozen=True)
class Axis:
    """One thing that is varied, with its values in the order of the sweep."""

    place: Place
    values: tuple[Any, ...]


def places(spec: ModelSpec) -> dict[str, Place]:
    """Return everything of a model that a sweep may vary or hold, by name."""
    found: dict[str, Place] = {}
    for s in (*spec.inputs, *find_model(spec.key).inputs()):
        if s.name in found:
            continue
        low, high = s.range
        meta = {"kind": "real", "unit": s.unit, "min": low, "max": high, "relative": s.relative}
        found[s.name] = Place(s.name, True, meta)
    return found | {f.name: Place(f.name, False, f.metadata) for f in fields(spec.params)}


def find_place(name: str, known: dict[str, Place], spec: ModelSpec) -> Place:
    """Return the place of that name, or raise ParameterError with the nearest names."""
    if name not in known:
        hint = suggestion(name, known, "did you mean {}? ")
        inputs = ", ".join(p.name for p in known.values() if p.is_input)
        raise ParameterError(
            f"{spec.name} has neither an input nor a parameter {name!r}; {hint}inputs: {inputs}; "
            f"thrustwasher {spec.key} --parameters lists the parameters"
        )
    return known[name]


def split_settings(texts: Iterable[str], option: str, allowed: str) -> dict[str, str]:
    """Return the values of every ``NAME=VALUES`` or ``NAME [UNIT]=VALUES`` by name, each once."""
    found: dict[str, str] = {}
    for text in texts:
        name, equals, values = (part.strip() for part in text.partition("="))
        if not name or not equals or not values:
            raise ParameterError(f"{option} {text}: allowed: {allowed}")
        if name in found:
            raise ParameterError(f"{option} {text}: {name} is given twice")
        found[name] = values
    return found


def read_axis(
    name: str, values: str | Iterable[Any], known: dict[str, Place], spec: ModelSpec
) -> Axis:
    """Return the axis that a name ("load", or "load [kN]" for bare numbers) and values make.

    The values are a text as in ``parse_values``, or numbers (texts for enumerations).
    """
    match = re.fullmatch(r"([^\[\]]*?)\s*(?:\[([^\[\]]*)\])?", name)
    if match is None:
        raise ParameterError(
            f"{name!r}: allowed: the name of an input or parameter, or NAME [UNIT]"
        )
    place = find_place(match[1].replace("-", "_"), known, spec)
    if isinstance(values, str):
        found = parse_values(values, place, (match[2] or "").strip())
    else:
        items = [values] if isinstance(values, int | float) else list(values)
        found = [place.check(v) for v in items]
    if not found:
        raise ParameterError(f"{place.name}: no value is given")
    return Axis(place, tuple(found))


def parse_values(text: str, place: Place, written: str = "") -> list[Any]:
    """Return the values of a text: single ones and ranges, separated by commas.

    ``start:stop:step`` goes on as long as it is not past ``stop``; ``start:stop:n40`` has 40 values
    with equal differences, ``start:stop:x40`` 40 with equal ratios. Numbers may have units; a bare
    one is SI, or in ``written``.

    Examples
    --------
    >>> from thrustwasher.clutch.parameters import SPEC
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


def _range(item: str, place: Place, written: str) -> list[Any]:
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
        raise ParameterError(f"{where}, allowed: a step that leads from start to stop")
    n = (stop - start) / step
    if n >= MOST_POINTS:
        raise ParameterError(f"{where}: more than {MOST_POINTS} values")
    last = math.floor(n + 1e-9)
    values = [start + step * i for i in range(last + 1)]
    if abs(n - last) < 1e-9:
        values[-1] = stop  # not a rounding error beside it
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
