"""modelDescription.xml of FMI 2.0, from the list of variables alone."""

import os
import subprocess
from datetime import UTC, datetime
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ..models._spec import ModelSpec
from .interface import Variable, enumerations, variables
from .registry import package_version
from .units import DISPLAY, declared_type, display_unit, exponents

# What an import tool may do; every entry is proved by a test.
CAPABILITIES = {
    "needsExecutionTool": "false",
    "canHandleVariableCommunicationStepSize": "true",
    "canInterpolateInputs": "false",
    "maxOutputDerivativeOrder": "0",
    "canRunAsynchronuously": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "providesDirectionalDerivative": "false",
}
LOG_CATEGORIES = {
    "logStatusWarning": "Results that need care, such as distress or too hot",
    "logStatusError": "Refused values and failed steps, with the reason",
    "logNonlinearSystems": "What the solver took in each step",
    "logEvents": "Film lost or regained, lock and break-away: once each",
    "logAll": "Everything, also tracebacks of defects",
}
MOST_STEPS = 1000  # of the default experiment; beyond it FMPy silently enlarges the step
RELEASED = 1767225600  # without git and SOURCE_DATE_EPOCH: 2026-01-01


def generation_date() -> str:
    """Return the date that goes into the FMU: never the clock, so that builds repeat."""
    seconds = os.environ.get("SOURCE_DATE_EPOCH", "")
    if not seconds.isdigit():
        seconds = _last_commit() or str(RELEASED)
    return datetime.fromtimestamp(int(seconds), UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def _last_commit() -> str:
    root = Path(__file__).parents[2]
    if not (root / ".git").exists():
        return ""
    command = ["git", "-C", str(root), "log", "-1", "--format=%ct"]
    try:
        answer = subprocess.run(command, capture_output=True, text=True, timeout=20, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return answer.stdout.strip()


def description(spec: ModelSpec, *, guid: str) -> Element:
    """Return the model description."""
    root = Element("fmiModelDescription", {
        "fmiVersion": "2.0", "modelName": spec.name, "guid": guid, "description": spec.help,
        "author": "The thrustwasher authors", "version": package_version(),
        "copyright": "The thrustwasher authors", "license": "BSD-3-Clause",
        "generationTool": f"thrustwasher {package_version()}",
        "generationDateAndTime": generation_date(), "variableNamingConvention": "structured",
        "numberOfEventIndicators": "0",
    })  # fmt: skip
    SubElement(root, "CoSimulation", {"modelIdentifier": spec.name, **CAPABILITIES})
    found = variables(spec)
    _units(root, found)
    _types(root, spec, found)
    categories = SubElement(root, "LogCategories")
    for name, text in log_categories(spec).items():
        SubElement(categories, "Category", {"name": name, "description": text})
    stop, step = default_experiment(spec)
    SubElement(root, "DefaultExperiment", {
        "startTime": "0.0", "stopTime": _number(stop), "tolerance": "1e-06",
        "stepSize": _number(step),
    })  # fmt: skip
    listed = SubElement(root, "ModelVariables")
    for v in found:
        _variable(listed, v)
    _structure(root, found)
    return root


def default_experiment(spec: ModelSpec) -> tuple[float, float]:
    """Return (stop time, step size) [s]; the start time is 0."""
    return min(spec.stop_time, MOST_STEPS * spec.step_size), spec.step_size


def log_categories(spec: ModelSpec) -> dict[str, str]:
    """Return the categories this model sends messages in."""
    silent = set() if spec.counts else {"logNonlinearSystems"}
    if not any(signal.events for signal in spec.outputs):
        silent.add("logEvents")
    return {name: text for name, text in LOG_CATEGORIES.items() if name not in silent}


def text(root: Element) -> bytes:
    """Return the XML as it goes into the FMU."""
    indent(root, "  ")
    body: bytes = tostring(root, "utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + body + b"\n"


def _number(value: float) -> str:
    return repr(float(value))


def _units(root: Element, found: tuple[Variable, ...]) -> None:
    definitions = SubElement(root, "UnitDefinitions")
    for name in sorted({v.unit for v in found if v.type == "Real"}):
        unit = SubElement(definitions, "Unit", {"name": name})
        SubElement(unit, "BaseUnit", {n: str(p) for n, p in exponents(name).items()})
        for display, factor, offset in DISPLAY.get(name, ()):
            numbers = {"factor": (factor, 1.0), "offset": (offset, 0.0)}
            given = {k: _number(x) for k, (x, default) in numbers.items() if x != default}
            SubElement(unit, "DisplayUnit", {"name": display, **given})


def _types(root: Element, spec: ModelSpec, found: tuple[Variable, ...]) -> None:
    definitions = SubElement(root, "TypeDefinitions")
    used = {t.name: t for v in found if v.type == "Real" and (t := declared_type(v))}
    for name, t in sorted(used.items()):
        simple = SubElement(definitions, "SimpleType", {"name": name})
        real = SubElement(simple, "Real", {"quantity": t.quantity, "unit": t.unit})
        if t.display:
            real.set("displayUnit", t.display)
        if t.relative:
            real.set("relativeQuantity", "true")
        if t.low is not None:
            real.set("min", _number(t.low))
        real.set("nominal", _number(t.nominal))
    for name, items in sorted(enumerations(spec).items()):
        simple = SubElement(definitions, "SimpleType", {"name": name})
        listed = SubElement(simple, "Enumeration")
        for item in items:
            SubElement(listed, "Item", {"name": item.name, "value": str(item.value),
                                        "description": item.help})  # fmt: skip


def _variable(listed: Element, v: Variable) -> None:
    head = {"name": v.name, "valueReference": str(v.reference), "description": v.help,
            "causality": v.causality, "variability": v.variability}  # fmt: skip
    if v.initial:
        head["initial"] = v.initial
    body = SubElement(SubElement(listed, "ScalarVariable", head), v.type)
    if v.type == "Real":
        _real(body, v)
        return
    if v.type == "Enumeration":
        body.set("declaredType", v.type_name or "")
    if v.type != "Boolean":
        for name, bound in (("min", v.low), ("max", v.high)):
            if bound is not None:
                body.set(name, str(int(bound)))
    if v.start is not None:
        start = int(v.start)
        body.set("start", str(bool(start)).lower() if v.type == "Boolean" else str(start))


def _real(body: Element, v: Variable) -> None:
    declared, display = declared_type(v), display_unit(v)
    if declared:
        body.set("declaredType", declared.name)
    body.set("unit", v.unit)
    if display:
        body.set("displayUnit", display)
    if v.relative:
        body.set("relativeQuantity", "true")
    for name in ("low", "high", "nominal", "start"):
        value = getattr(v, name)
        if value is not None:
            body.set({"low": "min", "high": "max"}.get(name, name), _number(value))


def _structure(root: Element, found: tuple[Variable, ...]) -> None:
    """FMI 2 counts variables from 1 here; missing dependencies would mean "on everything"."""
    structure = SubElement(root, "ModelStructure")
    index = {v.name: str(v.reference + 1) for v in found}
    outputs = [v for v in found if v.causality == "output"]
    parameters = [v.name for v in found if v.causality == "parameter"]
    order = [v.name for v in found]
    for part, extra in (("Outputs", []), ("InitialUnknowns", parameters)):
        listed = SubElement(structure, part)
        for v in outputs:
            names = sorted([*v.depends, *extra], key=order.index)
            SubElement(listed, "Unknown", {
                "index": index[v.name], "dependencies": " ".join(index[n] for n in names),
                "dependenciesKind": " ".join("dependent" for _ in names),
            })  # fmt: skip
