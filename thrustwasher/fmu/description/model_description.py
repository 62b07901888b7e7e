"""modelDescription.xml of FMI 2.0 and 3.0, and terminalsAndIcons.xml, from a model's lists."""

import os
import re
import subprocess
from collections.abc import Collection, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ...errors import EnvironmentProblem
from ...model.toml_tables import table_beside
from ...templates import filled
from ...units import UNITS, exponents
from ..model_kernels import package_version
from ..package.model_sources import PACKAGE
from .groups import grouped_names, listed_groups, repeated
from .interface import Interface, Variable

HERE = Path(__file__).parent
# In FMI 3 enumerations are 64-bit integers, whole numbers 32-bit ones; order as in tables.h.
TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}
Attributes = dict[str, Any]  # of an element; those that are None are left out
OF_A_BODY = re.compile(r"^((mesh|shaft|bearing) \d: )+")  # which one it is, the name says too
LAST_SECOND = 253402300799  # 9999-12-31, the last day that the format of dates has
RELEASED = 1767225600  # without git and SOURCE_DATE_EPOCH: 2026-01-01
# unit -> its display units
DISPLAY = {
    "K": ("degC",),
    "rad/s": ("rpm",),
    "rad": ("deg", "mrad"),
    "m": ("mm", "um"),
    "N": ("kN",),
    "W": ("kW",),
    "J": ("kJ",),
    "Pa": ("MPa", "GPa"),
    "Pa.s": ("mPa.s",),
    "m3/s": ("l/min",),
}
# Declared types of real variables: name -> attributes.
REAL_TYPES: dict[str, dict[str, Any]] = table_beside(__file__, "real_types.toml")
PLAIN_CLOCK = "host_time"  # instead of time
DECLARED = {(a["unit"], "relativeQuantity" in a): name for name, a in REAL_TYPES.items()}


def description(
    shown: Interface,
    *,
    fmi: int,
    guid: str,
    derivatives: bool = False,
    moving: bool = False,
    compiled: Sequence[str] = (),
    plain: bool = False,
    exchange: bool = False,
) -> bytes:
    """Return the model description.

    ``derivatives``: the binary has directional ones; ``moving``: it lets inputs move within a step;
    ``compiled``: files in the folder sources that are compiled, which FMI 2 lists here;
    ``plain``: outputs are real numbers, the others local; parameters are real or whole numbers;
    ``exchange``: the binary is for model exchange too, if the model is.
    """
    own = shown.spec.exchange if exchange else None
    found, names = shown.variables, [v.name for v in shown.parameters]
    if own:  # the indicators, which are no variables in FMI 2, come last
        found += tuple(v for v in shown.exchanged if fmi == 3 or v.store != "sign")
    hidden = {v.name for v in shown.outputs if plain and v.type != "Real"}
    told = repeated(shown.spec, [v.name for v in found])
    if plain:
        found = tuple(_plain(shown, v, fmi) for v in found)

    def between(v: Variable) -> Attributes:
        is_there = v.store == "out" or (moving and v.causality == "input")
        return {"intermediateUpdate": "true"} if is_there and fmi == 3 else {}

    text = filled(
        HERE / "modelDescription.xml.jinja",
        shown=shown,
        fmi=fmi,
        guid=guid,
        derivatives=str(derivatives).lower(),
        moving=str(moving and bool(shown.inputs)).lower(),
        compiled=compiled,
        head=head(shown),
        units=units(found),
        types=types(found),
        kinds=TYPES,
        exchange=own,
        structure=structure(shown, hidden, fmi if own else 0),
        enumerations={} if plain else shown.listed,
        groups=listed_groups(shown.spec, names),
        second_names=grouped_names(shown.spec, names),
        variables=[
            (
                v,
                head_attributes(v, v.name in hidden, v.name in told) | between(v),
                value_attributes(v) | _span(shown, v) | _base(shown, v, fmi),
            )
            for v in found
        ],
    )
    return text.replace(b"&#39;", b"'")  # every attribute stands in double quotes


def terminals_and_icons(shown: Interface, *, icon: bool = True) -> bytes:
    """Return torque and speed as one plug; a file of FMI 3.0."""
    return filled(HERE / "terminalsAndIcons.xml.jinja", terminals=shown.spec.terminals, icon=icon)


def declared_type(v: Variable) -> str | None:
    """Return the declared type of a real variable, if its unit has one."""
    return DECLARED.get((v.unit, v.relative))


def display_unit(v: Variable) -> str | None:
    """Return the unit people say: films in um, geometry in mm, elastic moduli in GPa."""
    size = v.nominal or 0.0
    if v.unit == "m" and size:
        return "um" if size < 1e-4 else "mm"
    if v.unit == "Pa" and size >= 1e9:
        return "GPa"
    return REAL_TYPES.get(declared_type(v) or "", {}).get("displayUnit")


def generation_date() -> str:
    """Return the date that goes into the FMU: never the clock, so that builds repeat.

    EnvironmentProblem: SOURCE_DATE_EPOCH is no whole number of seconds up to the year 9999.
    """
    seconds = os.environ.get("SOURCE_DATE_EPOCH", "")
    if not seconds:
        seconds = _last_commit() or str(RELEASED)
    elif not (re.fullmatch(r"[0-9]{1,12}", seconds) and int(seconds) <= LAST_SECOND):
        raise EnvironmentProblem(
            f"SOURCE_DATE_EPOCH = {seconds!r}, allowed: whole seconds since 1970, 0 .. "
            f"{LAST_SECOND}; unset it for the date of the last commit"
        )
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


def head(shown: Interface) -> dict[str, str]:
    """Return the attributes of the root that both versions have."""
    authors, version = "The thrustwasher authors", package_version()
    return {
        "modelName": shown.spec.name,
        "description": shown.spec.help,
        "author": authors,
        "version": version,
        "copyright": authors,
        "license": "BSD-3-Clause",
        "generationTool": f"thrustwasher {version}",
        "generationDateAndTime": generation_date(),
        "variableNamingConvention": "structured",
    }


def units(found: tuple[Variable, ...]) -> list[tuple[str, dict[str, int], list[Attributes]]]:
    """Return every unit in use with its base units and display units.

    A display value is factor x value + offset, with 1 and 0 where one is not said.
    """
    listed = []
    for name in sorted({v.unit for v in found if v.type == "Real"}):
        displays = []
        for display in DISPLAY.get(name, ()):
            size, zero = UNITS[name][display]
            factor = None if size == 1.0 else 1.0 / size
            displays.append({"name": display, "factor": factor, "offset": -zero / size or None})
        listed.append((name, exponents(name), displays))
    return listed


def types(found: tuple[Variable, ...]) -> list[tuple[str, Attributes]]:
    """Return name and attributes of each declared type of a real that is in use."""
    used = {declared_type(v) for v in found if v.type == "Real"}
    return [(name, REAL_TYPES[name]) for name in sorted(filter(None, used))]


def head_attributes(v: Variable, is_hidden: bool = False, is_told: bool = False) -> Attributes:
    """Return what a variable of any type says of itself; ``is_told``: another one says it too."""
    return {
        "name": v.name,
        "valueReference": v.reference,
        "description": None if is_told else OF_A_BODY.sub("", v.help),
        "causality": "local" if is_hidden else v.causality,
        "variability": v.variability,
        "initial": v.initial,
    }


def value_attributes(v: Variable) -> Attributes:
    """Return what a variable says of its value: unit, range, nominal and start."""
    if v.type == "Boolean":
        return {"start": None if v.start is None else str(bool(v.start)).lower()}
    kind = _short if v.type == "Real" else int
    nominal = None if v.causality == "parameter" else v.nominal
    numbers = {"min": v.low, "max": v.high, "nominal": nominal, "start": v.start}
    shown = {name: None if x is None else kind(x) for name, x in numbers.items()}
    if v.type != "Real":
        return {"declaredType": v.type_name, **shown, "nominal": None}
    relative, own = "true" if v.relative else None, display_unit(v)
    is_usual = own == REAL_TYPES.get(declared_type(v) or "", {}).get("displayUnit")
    return {
        "declaredType": declared_type(v),
        "unit": v.unit,
        "displayUnit": None if is_usual else own,
        "relativeQuantity": relative,
        **shown,
    }


def _short(number: float) -> str:
    """Return the shortest text of a number that is read as the same one."""
    exact = repr(float(number)).removesuffix(".0")
    found = [text for text in (exact, f"{number:g}") if float(text) == number]
    return min(
        (re.sub(r"e([+-])0*", lambda e: f"e{e[1].strip('+')}", text) for text in found), key=len
    )


def _span(shown: Interface, v: Variable) -> Attributes:
    """Return the minimum and the maximum number of an enumeration that is listed."""
    if v.type_name is None:
        return {}
    numbers = [item.value for item in shown.listed[v.type_name]]
    return {"min": min(numbers), "max": max(numbers)}


def _plain(shown: Interface, v: Variable, fmi: int) -> Variable:
    """Return a variable with a type that every host knows: a choice is its number, a flag 0 or 1.

    In FMI 3 inputs say what is so anyway, that their start value is exact. In FMI 2 the clock has a
    name of its own: OpenModelica declares it next to the time of Modelica.
    """
    if v.causality == "input" and fmi == 3:
        v = replace(v, initial="exact")
    if v.causality == "independent" and fmi == 2:
        v = replace(v, name=PLAIN_CLOCK)
    if v.type == "Boolean":
        return replace(v, type="Integer", low=0, high=1)
    if v.type_name is None:
        return v
    items = shown.listed[v.type_name]
    numbers = [item.value for item in items]
    words = ", ".join(f"{item.value} {item.name}" for item in items)
    low, high, help = min(numbers), max(numbers), f"{v.help}: {words}"
    return replace(v, type="Integer", type_name=None, low=low, high=high, help=help)


def _base(shown: Interface, v: Variable, fmi: int) -> Attributes:
    """Return which variable a derivative is of: its place from 1 in FMI 2, its reference in 3."""
    if v.derivative_of is None:
        return {}
    state = next(k for k in shown.continuous if k.name == v.derivative_of)
    return {"derivative": state.reference + (1 if fmi == 2 else 0)}


def structure(
    shown: Interface, hidden: Collection[str] = (), exchange: int = 0
) -> list[tuple[str, str, list[Any]]]:
    """Return name of the list in FMI 2, of an element in FMI 3, and pairs: output, what it needs.

    Hidden outputs are left out. ``exchange``: the version of FMI whose model exchange is written
    too, else 0.

    While running an output depends on the inputs that act at once, when it is initialized also on
    every parameter. Without a list the standard reads "depends on everything".
    """
    outputs = [v for v in shown.outputs if v.name not in hidden]
    if not exchange:
        return [
            ("Outputs", "Output", _needs(shown, outputs, states=False)),
            ("InitialUnknowns", "InitialUnknown", _first_needs(shown, outputs, shown.variables)),
        ]
    everything, own = shown.everything, [*outputs, *shown.derivatives]
    own += [v for v in shown.continuous if v not in outputs]
    own.sort(key=lambda v: v.reference)
    signs = [v for v in everything if v.store == "sign"]
    return [
        ("Outputs", "Output", _needs(shown, outputs)),
        ("Derivatives", "ContinuousStateDerivative", _needs(shown, shown.derivatives)),
        ("InitialUnknowns", "InitialUnknown", _first_needs(shown, own, everything)),
        *([("", "EventIndicator", _needs(shown, signs))] if exchange == 3 else []),
    ]


def _needs(shown: Interface, found: Sequence[Variable], *, states: bool = True) -> list[Any]:
    """Return pairs: variable, the inputs and, if wanted, the states that act on it at once."""
    known = [
        (v, {*v.depends, *((*v.states, *v.exchange_depends) if states else ())}) for v in found
    ]
    return [(v, [k for k in shown.everything if k.name in names]) for v, names in known]


def _first_needs(
    shown: Interface, found: Sequence[Variable], known: Sequence[Variable]
) -> list[Any]:
    """Return pairs: variable, the inputs and parameters that act on it at the start.

    Where a state starts from inputs, what depends on the state does so too.
    """
    parameters = {v.name for v in known if v.causality == "parameter"}
    exchange = shown.spec.exchange if known is not shown.variables else None
    starts = exchange.needs if exchange else {}

    def names(v: Variable) -> set[str]:
        of = {v.name, *v.states}
        return parameters.union(v.depends, *(starts.get(f"start({n})", ()) for n in of))

    needed = [(v, names(v)) for v in found]
    return [(v, [k for k in known if k.name in own]) for v, own in needed]
