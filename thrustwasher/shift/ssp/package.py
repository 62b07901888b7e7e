"""The files of a package but the FMUs: the system's description and a page of documentation.

Both are templates next to this module. The page says what the package is, how to run it, and what
runs of different masters differ by.
"""

from collections.abc import Iterator, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from ...model.spec import ModelSpec
from ...templates import filled
from ...units import exponents
from .system_structure import BORDER, PASSED_ON, Component, Structure, identifier

HERE = Path(__file__).parent


def files(system: Structure, *, tool: str, date: str, fmi: int = 2) -> dict[str, bytes]:
    """Return the files of the package by path, all but the FMUs.

    ``tool`` is the name of the tool and its version, ``date`` when it was made, ISO 8601, ``fmi``
    the version of the FMUs, 2 or 3.
    """
    used = [_meta(part.spec) for part in system.components]
    units = {m["unit"] for found in used for m in found.values() if m["kind"] == "real"}
    units |= {s.unit for p in system.components for s in p.spec.outputs if s.kind == "real"}
    given = {
        **system._asdict(),
        "name": identifier(system.scene.name),
        "title": system.title,
        "tool": tool,
        "date": date,
        "fmi": fmi,
        "places": BORDER["places"],
        "values_of": values_of,
        "units_of": units_of,
        "units": {name: exponents(name) for name in units},
    }
    return {
        "SystemStructure.ssd": filled(HERE / "system.ssd.jinja", plain=False, **given),
        "Parts.ssd": filled(HERE / "system.ssd.jinja", plain=True, **given),
        "documentation/index.html": filled(HERE / "page.html.jinja", **given),
    }


def values_of(part: Component) -> Iterator[tuple[str, str, dict[str, str]]]:
    """Yield name, type and attributes of each parameter and start value of a part.

    Masters that read them (OMSimulator) pass values on until they agree: nothing arrives late.
    Enumerations are left out: OMSimulator does not know them here, and the FMU has the value as its
    default.
    """
    known = _meta(part.spec)
    for name, value in {**part.parameters, **part.starts}.items():
        value = PASSED_ON.get((part.name, name), value)
        meta = known.get(name, {"kind": "real", "unit": ""})
        kind, attributes = meta["kind"], {"value": str(value)}
        if kind == "enumeration":
            continue
        if kind == "real":
            attributes = {"value": repr(float(value)), "unit": meta["unit"]}
        else:
            attributes["value"] = str(bool(value)).lower() if kind == "boolean" else str(int(value))
        yield name, kind.capitalize(), attributes


def units_of(part: Component) -> dict[str, Mapping[str, int]]:
    """Return the units that the values of a part refer to, each with the powers of its base units.

    SSP 1.0 and 2.0, section 6: a set of values defines all of them itself.
    """
    names = (attributes.get("unit") for _, _, attributes in values_of(part))
    return {name: exponents(name) for name in names if name is not None}


def _meta(spec: ModelSpec) -> dict[str, Mapping[str, Any]]:
    """Return kind and unit of everything that can be given a value."""
    found: dict[str, Mapping[str, Any]] = {f.name: f.metadata for f in fields(spec.params)}
    found["fidelity"] = {"kind": "enumeration"}
    return found | {s.name: {"kind": s.kind, "unit": s.unit} for s in spec.inputs}
