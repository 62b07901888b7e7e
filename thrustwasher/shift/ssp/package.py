"""The files of a package but the FMUs: the system's description and a page of documentation.

The description is XML of the SSP 1.0 schemas. The page says what the package is, how to run it, and
what runs of different masters differ by.
"""

from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ...model.spec import ModelSpec, Signal
from ...units import exponents
from ..scene.connections import PLACES, Link
from .system_structure import Border, Component, Structure

SSP = "http://ssp-standard.org/SSP1/SystemStructure"
# SSP has no place for the step of a master; OMSimulator and OSP look for it in notes of their own.
# libcosim takes a namespace declared on the note itself for an algorithm's name: all stand here.
SPACES = {
    "xmlns:ssd": f"{SSP}Description", "xmlns:ssc": f"{SSP}Common",
    "xmlns:ssv": f"{SSP}ParameterValues",
    "xmlns:oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
    "xmlns:osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
}  # fmt: skip


def files(system: Structure, *, tool: str, date: str) -> dict[str, bytes]:
    """Return the files of the package by path, all but the FMUs.

    ``tool`` is the name of the tool and its version, ``date`` when it was made, ISO 8601.
    """
    return {
        "SystemStructure.ssd": text(structure(system, tool=tool, date=date)),
        "Parts.ssd": text(structure(system, tool=tool, date=date, plain=True)),
        "documentation/index.html": page(system, tool=tool).encode(),
    }


def page(system: Structure, *, tool: str) -> str:
    """Return the page: one file without scripts and outside links."""
    from jinja2 import Environment

    template = Path(__file__).with_name("page.html.jinja").read_text("utf-8")
    environment = Environment(autoescape=True, trim_blocks=True, keep_trailing_newline=True)
    return environment.from_string(template).render(**system._asdict(), tool=tool)


def structure(system: Structure, *, tool: str, date: str, plain: bool = False) -> Element:
    """Return the description of the system.

    ``plain`` leaves out what libcosim does not read: outputs of the system itself and the values of
    the parts, which the FMUs have as their defaults anyway.
    """
    scene = system.scene
    root = Element("ssd:SystemStructureDescription", {
        **SPACES, "version": "1.0", "name": scene.name, "description": scene.title,
        "author": "The thrustwasher authors", "license": "BSD-3-Clause", "generationTool": tool,
        "generationDateAndTime": date,
    })  # fmt: skip
    top = SubElement(root, "ssd:System", {"name": scene.name, "description": scene.title})
    border = [] if plain else system.border
    if border:
        shown = SubElement(top, "ssd:Connectors")
        for out in border:
            _connector(shown, out.name, "output", out.signal)
    elements = SubElement(top, "ssd:Elements")
    for part in system.components:
        entry = _component(elements, part)
        if not plain:
            _values(entry, part)
    _connections(top, system.links, border)
    _note(
        top, "org.openmodelica", "oms:Annotations", "oms:SimulationInformation",
        "oms:FixedStepMaster", description="oms-ma", stepSize=repr(scene.step),
        absoluteTolerance="0.0001", relativeTolerance="0.0001",
    )  # fmt: skip
    if not plain:
        _enumerations(root, system)
    _units(root, system)
    run = SubElement(root, "ssd:DefaultExperiment", {
        "startTime": repr(scene.start_time), "stopTime": repr(scene.stop_time),
    })  # fmt: skip
    _note(
        run, "com.opensimulationplatform", "osp:Algorithm", "osp:FixedStepAlgorithm",
        baseStepSize=repr(scene.step),
    )  # fmt: skip
    return root


def text(root: Element) -> bytes:
    """Return the XML as it goes into the package."""
    indent(root, "  ")
    body: bytes = tostring(root, "utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + body + b"\n"


def _connector(
    listed: Element, name: str, kind: str, signal: Signal, place: tuple[float, float] | None = None
) -> None:
    entry = SubElement(listed, "ssd:Connector", {
        "name": name, "kind": kind, "description": signal.help,
    })  # fmt: skip
    if signal.kind == "real":
        SubElement(entry, "ssc:Real", {"unit": signal.unit})
    else:
        SubElement(entry, f"ssc:{signal.kind.capitalize()}")
    if place:
        SubElement(entry, "ssd:ConnectorGeometry", {"x": repr(place[0]), "y": repr(place[1])})


def _component(elements: Element, part: Component) -> Element:
    """Add one FMU: connectors first, then where it is drawn."""
    entry = SubElement(elements, "ssd:Component", {
        "name": part.name, "description": part.spec.help, "type": "application/x-fmu-sharedlibrary",
        "implementation": "CoSimulation", "source": part.source,
    })  # fmt: skip
    listed = SubElement(entry, "ssd:Connectors")
    # libcosim ends the process at a connector that is an enumeration; nothing is wired to one.
    outputs = tuple(s for s in part.spec.outputs if s.kind != "enumeration")
    for kind, x, signals in (("input", 0.0, part.inputs), ("output", 1.0, outputs)):
        for i, signal in enumerate(signals, 1):
            _connector(listed, signal.name, kind, signal, (x, i / (len(signals) + 1)))
    x, y = PLACES[part.name]
    SubElement(entry, "ssd:ElementGeometry", {
        "x1": repr(x - 20), "y1": repr(y - 15), "x2": repr(x + 20), "y2": repr(y + 15),
    })  # fmt: skip
    return entry


def _values(entry: Element, part: Component) -> None:
    """Bind parameters and start values, written out here."""
    binding = SubElement(SubElement(entry, "ssd:ParameterBindings"), "ssd:ParameterBinding")
    inline = SubElement(binding, "ssd:ParameterValues")
    values = SubElement(inline, "ssv:ParameterSet", {"version": "1.0", "name": part.name})
    given = SubElement(values, "ssv:Parameters")
    for name, value in {**part.parameters, **part.starts}.items():
        _value(given, part.spec, name, value)


def _value(given: Element, spec: ModelSpec, name: str, value: Any) -> None:
    """Add one value in the type that the FMU's variable has."""
    entry = SubElement(given, "ssv:Parameter", {"name": name})
    meta = _meta(spec).get(name, {"kind": "real", "unit": ""})
    kind, said = meta["kind"], {"value": str(value)}
    if kind == "enumeration":
        said["name"] = meta["type"]
    elif kind == "real":
        said = {"value": repr(float(value)), "unit": meta["unit"]}
    else:
        said["value"] = str(bool(value)).lower() if kind == "boolean" else str(int(value))
    SubElement(entry, f"ssv:{kind.capitalize()}", said)


def _meta(spec: ModelSpec) -> dict[str, Mapping[str, Any]]:
    """Return kind, unit and type of everything that can be given a value."""
    found: dict[str, Mapping[str, Any]] = {f.name: f.metadata for f in fields(spec.params)}
    found["fidelity"] = {"kind": "enumeration", "type": _fidelity(spec)}
    return found | {s.name: {"kind": s.kind, "unit": s.unit, "type": s.type} for s in spec.inputs}


def _fidelity(spec: ModelSpec) -> str:
    """Each model has its own list of fidelities; in the system their names must differ."""
    return f"{spec.name}Fidelity"


def _connections(top: Element, links: Sequence[Link], border: Sequence[Border]) -> None:
    listed = SubElement(top, "ssd:Connections")
    names = ("startElement", "startConnector", "endElement", "endConnector")
    for link in links:
        SubElement(listed, "ssd:Connection", dict(zip(names, link, strict=True)))
    for out in border:
        SubElement(listed, "ssd:Connection", {
            "startElement": out.part, "startConnector": out.signal.name, "endConnector": out.name,
        })  # fmt: skip


def _note(place: Element, owner: str, *path: str, **values: str) -> None:
    """Leave a note for one tool: nested elements, the last one with the values."""
    notes = SubElement(place, "ssd:Annotations")
    entry = SubElement(notes, "ssc:Annotation", {"type": owner})
    for name in path:
        entry = SubElement(entry, name)
    entry.attrib.update(values)


def _enumerations(root: Element, system: Structure) -> None:
    """List every enumeration that a value refers to."""
    found: dict[str, dict[str, int]] = {}
    for part in system.components:
        found[_fidelity(part.spec)] = _counted(part.spec.fidelities)
        for f in fields(part.spec.params):
            if f.metadata["kind"] == "enumeration":
                found[f.metadata["type"]] = _counted(f.metadata["options"])
    listed = SubElement(root, "ssd:Enumerations")
    for name, items in sorted(found.items()):
        entry = SubElement(listed, "ssc:Enumeration", {"name": name})
        for item, number in items.items():
            SubElement(entry, "ssc:Item", {"name": item, "value": str(number)})


def _counted(options: Mapping[str, str]) -> dict[str, int]:
    return {name: i for i, name in enumerate(options, 1)}


def _units(root: Element, system: Structure) -> None:
    used: set[str] = set()
    for part in system.components:
        used |= {m["unit"] for m in _meta(part.spec).values() if m["kind"] == "real"}
        used |= {s.unit for s in part.spec.outputs if s.kind == "real"}
    listed = SubElement(root, "ssd:Units")
    for name in sorted(used):
        entry = SubElement(listed, "ssc:Unit", {"name": name})
        SubElement(entry, "ssc:BaseUnit", {n: str(p) for n, p in exponents(name).items()})
