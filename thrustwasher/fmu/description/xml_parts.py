"""What the descriptions of FMI 2.0 and FMI 3.0 have in common; each spells it its own way."""

import os
import subprocess
from datetime import UTC, datetime
from math import pi
from pathlib import Path
from typing import Any, NamedTuple

from ...model.spec import ModelSpec
from ...units import exponents
from ..model_kernels import package_version
from ..package.model_sources import PACKAGE
from .interface import Variable

LOG_CATEGORIES = {  # in the order of the enum in the shell's tables.h
    "logStatusWarning": "Results that need care, such as distress or too hot",
    "logStatusError": "Refused values and failed steps, with the reason",
    "logNonlinearSystems": "What the solver took in each step",
    "logEvents": "Film lost or regained, lock and break-away: once each",
    "logAll": "Everything, also tracebacks of defects",
}
MOST_STEPS = 1000  # of the default experiment; beyond it FMPy silently enlarges the step
RELEASED = 1767225600  # without git and SOURCE_DATE_EPOCH: 2026-01-01
# unit -> display units: (name, factor, offset); display value = factor x value + offset
DISPLAY: dict[str, tuple[tuple[str, float, float], ...]] = {
    "K": (("degC", 1.0, -273.15),),
    "rad/s": (("rpm", 30.0 / pi, 0.0),),
    "rad": (("deg", 180.0 / pi, 0.0), ("mrad", 1e3, 0.0)),
    "m": (("mm", 1e3, 0.0), ("um", 1e6, 0.0)),
    "N": (("kN", 1e-3, 0.0),),
    "W": (("kW", 1e-3, 0.0),),
    "J": (("kJ", 1e-3, 0.0),),
    "Pa": (("MPa", 1e-6, 0.0), ("GPa", 1e-9, 0.0)),
    "Pa.s": (("mPa.s", 1e3, 0.0),),
    "m3/s": (("l/min", 6e4, 0.0),),
}


class RealType(NamedTuple):
    """A declared type: what a number means, whatever variable has it."""

    name: str
    quantity: str
    unit: str
    display: str | None = None
    low: float | None = None
    nominal: float = 1.0
    relative: bool = False


TYPES = (
    RealType("Temperature", "ThermodynamicTemperature", "K", "degC", low=0.0, nominal=300.0),
    RealType("TemperatureDifference", "TemperatureDifference", "K", nominal=10.0, relative=True),
    RealType("AngularVelocity", "AngularVelocity", "rad/s", "rpm", nominal=100.0),
    RealType("Angle", "Angle", "rad", "mrad", nominal=1e-3),
    RealType("Torque", "Torque", "N.m", nominal=10.0),
    RealType("Force", "Force", "N", nominal=1e3),
    RealType("Length", "Length", "m", nominal=0.01),
    RealType("Pressure", "Pressure", "Pa", "MPa", nominal=1e6),
    RealType("Power", "Power", "W", nominal=100.0),
    RealType("Energy", "Energy", "J", "kJ", nominal=1e3),
    RealType("VolumeFlow", "VolumeFlowRate", "m3/s", "l/min", nominal=1e-6),
    RealType("Viscosity", "DynamicViscosity", "Pa.s", "mPa.s", nominal=0.01),
    RealType("Fraction", "Dimensionless", "1"),
)


def declared_type(v: Variable) -> RealType | None:
    """Return the declared type of a real variable, if its unit has one."""
    fitting = (t for t in TYPES if t.unit == v.unit and t.relative == v.relative)
    return next(fitting, None)


def display_unit(v: Variable) -> str | None:
    """Return the unit people say: films in um, geometry in mm, elastic moduli in GPa."""
    declared = declared_type(v)
    size = v.nominal or 0.0
    if v.unit == "m" and size:
        return "um" if size < 1e-4 else "mm"
    if v.unit == "Pa" and size >= 1e9:
        return "GPa"
    return declared.display if declared else None


def generation_date() -> str:
    """Return the date that goes into the FMU: never the clock, so that builds repeat."""
    seconds = os.environ.get("SOURCE_DATE_EPOCH", "")
    if not seconds.isdigit():
        seconds = _last_commit() or str(RELEASED)
    return datetime.fromtimestamp(int(seconds), UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def _last_commit() -> str:
    root = PACKAGE.parent
    if not (root / ".git").exists():
        return ""
    command = ["git", "-C", str(root), "log", "-1", "--format=%ct"]
    try:
        answer = subprocess.run(command, capture_output=True, text=True, timeout=20, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return answer.stdout.strip()


def default_experiment(spec: ModelSpec) -> tuple[float, float]:
    """Return (stop time, step size) [s]; the start time is 0."""
    return min(spec.stop_time, MOST_STEPS * spec.step_size), spec.step_size


def log_categories(spec: ModelSpec) -> dict[str, str]:
    """Return the categories this model sends messages in."""
    silent = set() if spec.counts else {"logNonlinearSystems"}
    if not any(signal.events for signal in spec.outputs):
        silent.add("logEvents")
    return {name: text for name, text in LOG_CATEGORIES.items() if name not in silent}


def filled(template: Path, **told: Any) -> bytes:
    """Return a template filled in, as it goes into the FMU; values are escaped."""
    from jinja2 import Environment, StrictUndefined  # late: what is built already needs none

    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip
    return environment.from_string(template.read_text("utf-8")).render(told).encode()


def head(spec: ModelSpec) -> dict[str, str]:
    """Return the attributes of the root that both versions have."""
    return {
        "modelName": spec.name, "description": spec.help, "author": "The thrustwasher authors",
        "version": package_version(), "copyright": "The thrustwasher authors",
        "license": "BSD-3-Clause", "generationTool": f"thrustwasher {package_version()}",
        "generationDateAndTime": generation_date(), "variableNamingConvention": "structured",
    }  # fmt: skip


def units(found: tuple[Variable, ...]) -> list[tuple[str, dict[str, int], list[dict[str, str]]]]:
    """Return every unit in use with its base units and display units."""
    listed = []
    for name in sorted({v.unit for v in found if v.type == "Real"}):
        displays = []
        for display, factor, offset in DISPLAY.get(name, ()):
            numbers = {"factor": (factor, 1.0), "offset": (offset, 0.0)}
            given = {k: number(x) for k, (x, default) in numbers.items() if x != default}
            displays.append({"name": display, **given})
        listed.append((name, exponents(name), displays))
    return listed


def types(found: tuple[Variable, ...]) -> list[tuple[str, dict[str, str]]]:
    """Return name and attributes of each declared type of a real that is in use."""
    used = {declared_type(v) for v in found if v.type == "Real"}
    return [(t.name, type_attributes(t)) for t in sorted(filter(None, used), key=lambda t: t.name)]


def number(value: float) -> str:
    """Return the shortest text that reads back as the same number."""
    return repr(float(value))


def type_attributes(t: RealType) -> dict[str, str]:
    """Return what a declared type of a real says."""
    said = {"quantity": t.quantity, "unit": t.unit, **_shown(t.display, t.relative)}
    least = {} if t.low is None else {"min": number(t.low)}
    return said | least | {"nominal": number(t.nominal)}


def _shown(display: str | None, relative: bool) -> dict[str, str]:
    shown = {"displayUnit": display} if display else {}
    return shown | ({"relativeQuantity": "true"} if relative else {})


def head_attributes(v: Variable) -> dict[str, str]:
    """Return what a variable of any type says of itself."""
    said = {"name": v.name, "valueReference": str(v.reference), "description": v.help,
            "causality": v.causality, "variability": v.variability}  # fmt: skip
    return said | ({"initial": v.initial} if v.initial else {})


def value_attributes(v: Variable) -> dict[str, str]:
    """Return what a variable says of its value: unit, range, nominal and start."""
    if v.type == "Real":
        declared = declared_type(v)
        said = {"declaredType": declared.name} if declared else {}
        said |= {"unit": v.unit, **_shown(display_unit(v), v.relative)}
        numbers = {"min": v.low, "max": v.high, "nominal": v.nominal, "start": v.start}
        return said | {name: number(x) for name, x in numbers.items() if x is not None}
    said = {"declaredType": v.type_name} if v.type_name else {}
    if v.type != "Boolean":
        bounds = ("min", v.low), ("max", v.high)
        said |= {name: str(int(bound)) for name, bound in bounds if bound is not None}
    if v.start is not None:
        start = int(v.start)
        said["start"] = str(bool(start)).lower() if v.type == "Boolean" else str(start)
    return said


def structure(found: tuple[Variable, ...]) -> list[tuple[str, str, list[Any]]]:
    """Return name of the list in FMI 2, of an element in FMI 3, and pairs: output, what it needs.

    While running an output depends on the inputs that act at once, when it is initialized also on
    every parameter. Without a list the standard reads "depends on everything".
    """
    parameters = {v.name for v in found if v.causality == "parameter"}
    outputs = [v for v in found if v.causality == "output"]

    def needs(more: set[str]) -> list[Any]:
        return [(v, [k for k in found if k.name in more.union(v.depends)]) for v in outputs]

    return [
        ("Outputs", "Output", needs(set())),
        ("InitialUnknowns", "InitialUnknown", needs(parameters)),
    ]
