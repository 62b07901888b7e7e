"""The files of a package but the FMUs: the system's description and a page of documentation.

The description is XML of the SSP 1.0 schemas. The page says what the package is, how to run it, and
what runs of different masters differ by.
"""

from collections.abc import Mapping, Sequence
from dataclasses import fields
from html import escape
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
STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;
color:#263242}table{border-collapse:collapse;width:100%;margin:1em 0}
th,td{border:1px solid #c4ccd4;padding:.25em .5em;text-align:left;vertical-align:top}
th{background:#eef1f4}code,pre{background:#f4f6f8}pre{padding:1em;overflow:auto}"""

MASTER = """<p>Step all parts at once by {step:g} s with the values of the last point, held
(a parallel master), from {start:g} s to {stop:g} s. Between the parts values are handed over as
they are: no scaling, no filter, no sum.</p>
<ul>
<li>A torque arrives at the transmission one step late. Its parameter <code>torque_age</code> = 1
tells it so, and it looks ahead by itself (<code>capacity_extrapolation</code>). A master that steps
the transmission last, with fresh torques, wants <code>torque_age</code> = 0.</li>
<li>The shift command would be one step late too: <code>lead</code> of the command source is that
step. With another step, set <code>lead</code> to it.</li>
<li>The oil's temperature is a value of every part, not a connection.</li>
<li>Parameters and start values of the scene are the defaults of the FMUs. They stand in
<code>SystemStructure.ssd</code> too, for tools that show and change them.</li>
<li>The start values of all inputs are those at which the parts agree. A master that exchanges
values before it starts finds the same.</li>
<li><code>Parts.ssd</code> is the same system without outputs of its own and without written values,
for masters that know neither (libcosim).</li>
</ul>"""

DIFFERENCES = """<p>A master that exchanges values before the first step (libcosim was tried)
gives the numbers of <code>thrustwasher shift --master jacobi</code> to about 1e-12. FMPy's
simulator sends zero to every connected input in its first step, so that a pack that holds lets go
for two steps: in the scene <code>planetary</code> the clutch then locks 0.75 ms earlier with 0.12 %
less heat, and the brake has 9 % more. Stepping the transmission last with fresh torques, as
<code>thrustwasher shift</code> does by default, moves lock-up there by 4 microseconds.</p>"""


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
    scene = system.scene
    times = {"step": scene.step, "start": scene.start_time, "stop": scene.stop_time}
    parts = [
        f"<h1>{escape(scene.title)}</h1><p>{escape(scene.description)}</p>",
        f"<p>A package after System Structure and Parameterization 1.0, made by {escape(tool)} "
        f"from the scene <code>{escape(scene.name)}</code>. The FMUs in it are co-simulation FMUs "
        "after FMI 2.0; each brings its own documentation.</p>",
        "<h2>How to step it</h2>", MASTER.format(**times),
        "<h2>What masters differ by</h2>", DIFFERENCES,
        "<h2>Parts</h2>", _table(["part", "FMU", "fidelity", "what it is"], [
            [p.name, p.spec.name, p.parameters["fidelity"], p.spec.help]
            for p in system.components]),
        "<h2>Connections</h2>", _table(["from", "to"], [
            [f"{k.source}.{k.output}", f"{k.target}.{k.input}"] for k in system.links]),
        "<h2>Outputs of the system</h2>", _table(["output", "unit", "meaning"], [
            [b.name, "" if b.signal.unit == "1" else b.signal.unit, b.signal.help]
            for b in system.border]),
    ]  # fmt: skip
    title = f"<title>{escape(scene.title)}</title><style>{STYLE}</style>"
    head = f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">{title}</head>'
    return "\n".join([f"{head}<body>", *parts, "</body></html>", ""])


def _table(heads: list[str], rows: list[list[str]]) -> str:
    top = "".join(f"<th>{escape(h)}</th>" for h in heads)
    body = "\n".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><tr>{top}</tr>\n{body}</table>"


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
