"""What is given and what comes out: a value with its unit and range, a figure with its meaning."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, Literal

from ..units import format_quantity, has_unit, parse_quantity
from .parameters import check_value, earlier_of, former_values
from .spec import ModelSpec

BOOLEANS = {"true": True, "yes": True, "1": True, "false": False, "no": False, "0": False}


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """Something that can be set, varied or scattered: a parameter, an input, a number of a scene.

    One that is searched over has as its range the ends of the search.
    """

    name: str
    """Of a parameter or input; of a value in a scene its path."""
    unit: str = "1"
    nominal: float | str | bool = 0.0
    """Value now [SI]; of a parameter that takes it from another one, that one's."""
    low: float = -math.inf
    high: float = math.inf
    """Allowed range [SI]; no matter for a choice."""
    choices: tuple[Any, ...] = ()
    """Allowed values of a choice (enumeration, Boolean, whole number, level); else none."""
    relative: bool = False
    """A difference of temperatures, no absolute temperature."""
    kind: Literal["real", "integer", "boolean", "enumeration"] = "real"
    is_input: bool = False
    """An input of a model, no parameter."""
    in_degrees: bool = False
    """An angle that was given in degrees, and is shown so."""

    def text(self, value: Any) -> str:
        """Return a value as a person reads it."""
        if self.choices:
            return str(value).lower() if isinstance(value, bool) else str(value)
        if self.in_degrees:
            return f"{math.degrees(value):.4g}\N{DEGREE SIGN}"
        return format_quantity(value, self.unit, difference=self.relative)

    @property
    def range_text(self) -> str:
        """The allowed values in words."""
        if not self.choices:
            return f"{self.text(self.low)} .. {self.text(self.high)}"
        if isinstance(self.choices[0], int) and not isinstance(self.choices[0], bool):
            return f"whole numbers {self.choices[0]} .. {self.choices[-1]}"
        return ", ".join(map(self.text, self.choices))

    def check(self, value: Any) -> float | int | bool | str:
        """Return a value given in Python or as text; ParameterError names what is allowed."""
        if self.kind == "boolean" and str(value).lower() in BOOLEANS:
            return BOOLEANS[str(value).lower()]
        meta = self._metadata
        if self.kind in ("enumeration", "boolean"):
            check_value(self.name, value, meta)
            return str(value) if self.kind == "enumeration" else bool(value)
        given = value if isinstance(value, str) else float(value)
        number = parse_quantity(given, self.unit, self.name, difference=self.relative)
        number = check_value(self.name, number, meta, stated=has_unit(value))
        return int(number) if self.kind == "integer" else number

    @property
    def _metadata(self) -> dict[str, Any]:
        """The range as a parameter's field has it."""
        ends = (self.choices[0], self.choices[-1]) if self.choices else (self.low, self.high)
        return {
            "kind": self.kind,
            "unit": self.unit,
            "min": ends[0],
            "max": ends[1],
            "relative": self.relative,
            "options": self.choices,
        }


def of_field(name: str, value: Any, meta: Mapping[str, Any]) -> Quantity:
    """Return a parameter of a model with this value; ``meta``: its field's metadata."""
    kind = meta["kind"]
    if kind == "real":
        return Quantity(
            name=name,
            unit=meta["unit"],
            nominal=float(value),
            low=meta["min"],
            high=meta["max"],
            relative=bool(meta.get("relative")),
        )
    choices: tuple[Any, ...] = tuple(meta.get("options", (False, True)))
    if kind == "integer":
        choices = tuple(range(meta["min"], meta["max"] + 1))
    nominal = bool(value) if kind == "boolean" else value
    return Quantity(name=name, nominal=nominal, choices=choices, kind=kind)


def part_quantities(
    spec: ModelSpec, params: Any, inputs: Mapping[str, float]
) -> dict[str, Quantity]:
    """Return the quantities of a part by name: parameters, then inputs.

    Parameters
    ----------
    params : all its parameters
    inputs : values [SI] of all the model's own inputs

    A parameter or input whose 0 means that another one counts in its place has that one's value.
    """
    found = {f.name: of_field(f.name, getattr(params, f.name), f.metadata) for f in fields(params)}
    for s in spec.inputs:
        low, high = s.range
        found[s.name] = Quantity(
            name=s.name,
            unit=s.unit,
            nominal=float(inputs[s.name]),
            low=low,
            high=high,
            relative=s.relative,
            is_input=True,
        )
    former, earlier = former_values(params), earlier_of(spec.params)
    found |= {name: of_field(name, former[name], meta) for name, meta in earlier.items()}
    others = {f.name: other_of(f.metadata) for f in fields(params)}
    others |= {s.name: s.at_zero for s in spec.inputs}
    for name, other in others.items():
        if other and found[name].nominal == 0.0:
            found[name] = _resolved(found, found[name], other, params)
    return found


def other_of(meta: Any) -> Any:
    """Return what counts where a parameter is 0: a name, a function of all parameters, or None."""
    over = meta.get("overrides", ())
    return meta.get("at_zero") or (over[0] if len(over) == 1 else None)


def _resolved(
    found: Mapping[str, Quantity], place: Quantity, other: Any, params: object
) -> Quantity:
    """Return a place with the value that counts, and the range that this may have."""
    if callable(other):
        return replace(place, nominal=float(other(params)))
    common = found[other]
    if common.choices or common.unit != place.unit:
        return place
    return replace(place, nominal=common.nominal, low=max(place.low, common.low))


@dataclass(frozen=True)
class Figure:
    """A number that every run gives; ``low`` .. ``high`` [SI] is its usual range."""

    name: str
    unit: str
    help: str
    low: float = -math.inf
    high: float = math.inf
    relative: bool = False
    """A difference of temperatures."""
    kind: str = "real"
    """Or "outcome": 1 where a run says yes, 0 where no."""
    of_curve: bool = False
    """Takes a whole load curve, no point."""
