"""What a name and a text set of a model: an input or a parameter, as in ``roughness=4e-7``."""

from collections.abc import Iterable, Mapping
from dataclasses import fields

from .errors import ParameterError, suggestion
from .model.quantity import Quantity, of_field
from .model.registry import find_model
from .model.spec import ModelSpec


def places(spec: ModelSpec) -> dict[str, Quantity]:
    """Return everything of a model that may be set or varied, by name."""
    found: dict[str, Quantity] = {}
    for s in (*spec.inputs, *find_model(spec.key).inputs()):
        if s.name in found:
            continue
        low, high = s.range
        found[s.name] = Quantity(
            name=s.name,
            unit=s.unit,
            nominal=s.usual,
            low=low,
            high=high,
            relative=s.relative,
            is_input=True,
        )
    return found | {f.name: of_field(f.name, f.default, f.metadata) for f in fields(spec.params)}


def find_place(name: str, known: Mapping[str, Quantity], spec: ModelSpec) -> Quantity:
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
