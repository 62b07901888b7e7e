"""modelDescription.xml of FMI 2.0 and 3.0, and terminalsAndIcons.xml, from a model's lists."""

from pathlib import Path

from ...model.spec import ModelSpec
from ...templates import filled
from . import xml_parts as parts
from .interface import enumerations, variables

# In FMI 3 enumerations are 64-bit integers, whole numbers 32-bit ones; order as in tables.h.
TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}
HERE = Path(__file__).parent


def description(spec: ModelSpec, *, fmi: int, guid: str, derivatives: bool = False) -> bytes:
    """Return the model description; ``derivatives``: the binary has directional ones."""
    found = variables(spec)
    stop, step = parts.default_experiment(spec)
    return filled(
        HERE / "modelDescription.xml.jinja", spec=spec, fmi=fmi, guid=guid, stop=stop, step=step,
        derivatives=str(derivatives).lower(), head=parts.head(spec), units=parts.units(found),
        types=parts.types(found), enumerations=enumerations(spec), kinds=TYPES,
        categories=parts.log_categories(spec), structure=parts.structure(found),
        variables=[(v, parts.head_attributes(v), parts.value_attributes(v)) for v in found],
    )  # fmt: skip


def terminals_and_icons(spec: ModelSpec, *, icon: bool = True) -> bytes:
    """Return torque and speed as one plug; a file of FMI 3.0."""
    return filled(HERE / "terminalsAndIcons.xml.jinja", terminals=spec.terminals, icon=icon)
