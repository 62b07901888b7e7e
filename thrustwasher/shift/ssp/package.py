"""The files of a package but the FMUs: the system's description and a page of documentation.

Both are templates next to this module. The page says what the package is, how to run it, and what
runs of different masters differ by.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from functools import partial
from pathlib import Path
from typing import Any

from ...model.spec import ModelSpec, Signal
from ...templates import filled
from ...units import exponents
from ..scene.connections import SOURCE
from .system_structure import BORDER, PASSED_ON, Border, Component, Structure, identifier

HERE = Path(__file__).parent
TEMPLATE = HERE / "system.ssd.jinja"


def files(
    system: Structure, *, tool: str, date: str, fmi: int = 2, plain: bool = False
) -> dict[str, bytes]:
    """Return the files of the package by path, all but the FMUs.

    ``tool`` is the name of the tool and its version, ``date`` when it was made, ISO 8601, ``fmi``
    the version of the FMUs, 2 or 3; ``plain``: real and whole numbers only, and connectors of real
    ones.
    """
    used = [_meta(part.spec) for part in system.components]
    units = {m["unit"] for found in used for m in found.values() if m["kind"] == "real"}
    units |= {s.unit for p in system.components for s in p.spec.outputs if s.kind == "real"}
    given = {
        **system._asdict(),
        "border": [b for b in system.border if _shown([b.signal], plain)],
        "name": identifier(system.scene.name),
        "title": system.title,
        "tool": tool,
        "date": date,
        "fmi": fmi,
        "places": BORDER["places"],
        "values_of": partial(values_of, plain=plain, above=system.parameters),
        "units_of": units_of,
        "parameter_values": _values_above(system),
        "inlet_values": [
            (i.name, "Real", {"value": repr(float(i.start)), "unit": i.signal.unit})
            for i in system.inlets
        ],
        "command": SOURCE,
        "shown": partial(_shown, plain=plain),
        "units": {name: exponents(name) for name in units},
    }
    return {
        "SystemStructure.ssd": filled(TEMPLATE, bare=False, open=False, **given),
        "Open.ssd": filled(TEMPLATE, bare=False, open=True, **given),
        "Parts.ssd": filled(TEMPLATE, bare=True, open=False, **given),
        "documentation/index.html": filled(HERE / "page.html.jinja", **given),
    }


def _shown(signals: Iterable[Signal], plain: bool) -> list[Signal]:
    """Return the signals that are connectors.

    libcosim ends the process at one that is an enumeration; nothing is wired to one.
    """
    return [s for s in signals if s.kind == "real" or not (plain or s.kind == "enumeration")]


def values_of(
    part: Component, *, plain: bool = False, above: Iterable[Border] = ()
) -> Iterator[tuple[str, str, dict[str, str]]]:
    """Yield name, type and attributes of each parameter and start value of a part.

    Masters that read them (OMSimulator) pass values on until they agree: nothing arrives late.
    Enumerations are left out: OMSimulator does not know them here, and the FMU has the value as its
    default; so are parameters that are connected to one of the system, ``above``.
    """
    known, given = _meta(part.spec), {b.signal.name for b in above if b.part == part.name}
    for name, value in {**part.parameters, **part.starts}.items():
        if name in given:
            continue
        value = PASSED_ON.get((part.name, name), value)
        meta = known.get(name, {"kind": "real", "unit": ""})
        kind, attributes = meta["kind"], {"value": str(value)}
        if kind == "enumeration":
            continue
        if kind == "boolean" and plain:
            kind = "integer"
        if kind == "real":
            attributes = {"value": repr(float(value)), "unit": meta["unit"]}
        else:
            attributes["value"] = str(bool(value)).lower() if kind == "boolean" else str(int(value))
        yield name, kind.capitalize(), attributes


def units_of(values: Iterable[tuple[str, str, dict[str, str]]]) -> dict[str, Mapping[str, int]]:
    """Return the units that values refer to, each with the powers of its base units.

    SSP 1.0 and 2.0, section 6: a set of values defines all of them itself.
    """
    names = (attributes.get("unit") for _, _, attributes in values)
    return {name: exponents(name) for name in names if name is not None}


def _values_above(system: Structure) -> list[tuple[str, str, dict[str, str]]]:
    """Return name, type and attributes of each parameter of the system."""
    given = {part.name: part.parameters for part in system.components}
    return [
        (
            b.name,
            "Real",
            {"value": repr(float(given[b.part][b.signal.name])), "unit": b.signal.unit},
        )
        for b in system.parameters
    ]


def _meta(spec: ModelSpec) -> dict[str, Mapping[str, Any]]:
    """Return kind and unit of everything that can be given a value."""
    found: dict[str, Mapping[str, Any]] = {f.name: f.metadata for f in fields(spec.params)}
    found["fidelity"] = {"kind": "enumeration"}
    return found | {s.name: {"kind": s.kind, "unit": s.unit} for s in spec.inputs}
