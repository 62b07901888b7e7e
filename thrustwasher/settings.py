"""What a name and a text set of a model: an input or a parameter, as in ``roughness=4e-7``."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from typing import Any

from .errors import ParameterError, suggestion
from .model.parameters import check_value
from .model.registry import find_model
from .model.spec import ModelSpec
from .units import has_unit, parse_quantity

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


def places(spec: ModelSpec) -> dict[str, Place]:
    """Return everything of a model that may be set or varied, by name."""
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
