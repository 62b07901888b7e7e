"""What of a part can scatter: its parameters and inputs, each with its nominal value and range."""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from .parameters import earlier_of, former_values
from .scatter import Place
from .spec import ModelSpec


def part_places(spec: ModelSpec, params: Any, inputs: Mapping[str, float]) -> dict[str, Place]:
    """Return the places of a part by name: parameters, then inputs.

    Parameters
    ----------
    params : all its parameters
    inputs : values [SI] of all the model's own inputs

    A parameter or input whose 0 means that another one counts in its place has that one's value.
    """
    found = {
        f.name: _parameter(f.name, getattr(params, f.name), f.metadata) for f in fields(params)
    }
    for s in spec.inputs:
        low, high = s.range
        found[s.name] = Place(
            name=s.name,
            unit=s.unit,
            nominal=float(inputs[s.name]),
            low=low,
            high=high,
            relative=s.relative,
        )
    former, earlier = former_values(params), earlier_of(spec.params)
    found |= {name: _parameter(name, former[name], meta) for name, meta in earlier.items()}
    others = {f.name: other_of(f.metadata) for f in fields(params)}
    others |= {s.name: s.at_zero for s in spec.inputs}
    for name, other in others.items():
        if other and found[name].nominal == 0.0:
            found[name] = _resolved(found, found[name], other, params)
    return found


def _parameter(name: str, value: Any, meta: Any) -> Place:
    kind, low, high = meta["kind"], meta["min"], meta["max"]
    if kind == "real":
        difference = bool(meta.get("relative"))
        return Place(
            name=name,
            unit=meta["unit"],
            nominal=float(value),
            low=low,
            high=high,
            relative=difference,
        )
    choices: tuple[Any, ...] = tuple(meta.get("options", (False, True)))
    if kind == "integer":
        choices = tuple(range(low, high + 1))
    return Place(
        name=name, unit="1", nominal=bool(value) if kind == "boolean" else value, choices=choices
    )


def other_of(meta: Any) -> Any:
    """Return what counts where a parameter is 0: a name, a function of all parameters, or None."""
    over = meta.get("overrides", ())
    return meta.get("at_zero") or (over[0] if len(over) == 1 else None)


def _resolved(found: Mapping[str, Place], place: Place, other: Any, params: object) -> Place:
    """Return a place with the value that counts, and the range that this may have."""
    if callable(other):
        return replace(place, nominal=float(other(params)))
    common = found[other]
    if common.choices or common.unit != place.unit:
        return place
    return replace(place, nominal=common.nominal, low=max(place.low, common.low))
