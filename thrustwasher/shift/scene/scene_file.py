"""Scene files: TOML -> ``Scene``, checked before anything runs.

A number may carry its unit, "24 degC" or "3000 rpm"; a bare number is SI. A scene with a ``base``
takes everything from that scene and changes what it names.
"""

import tomllib
from dataclasses import fields
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from ...errors import ParameterError, suggestion
from ...ladder.choose import rung_and_tolerance
from ...model.parameters import allowed, made_of
from ...model.spec import ModelSpec
from ...units import parse_quantity
from ..key_figures.figure_list import FIGURES
from .connections import PARTS, REQUIRED
from .scene import STEP_RANGE, TOLERANCE_RANGE, Part, Published, Scene

# Key -> (unit, least, largest); texts have no unit.
TEXTS = ("title", "description", "base", "master", "fidelity")
NUMBERS = {
    "start_time": ("s", -1e6, 1e6),
    "stop_time": ("s", -1e6, 1e6),
    "step": ("s", *STEP_RANGE),
    "master_tolerance": ("1", *TOLERANCE_RANGE),
    "oil_temperature": ("K", 233.15, 473.15),
}
SHIFT = {
    "start": ("s", -1e6, 1e6),
    "duration": ("s", 0.0, 1e3),
    "from": ("1", 0.0, 1.0),
    "to": ("1", 0.0, 1.0),
}
TABLES = ("shift", "published", *PARTS)


def builtin_scenes() -> list[str]:
    """Return the names of the scenes that come with the package."""
    return sorted(f.name[:-5] for f in _folder().iterdir() if f.name.endswith(".toml"))


def _folder() -> Traversable:
    """Return where the built-in scenes lie: beside this package's folder."""
    return resources.files(__package__.rpartition(".")[0]) / "scenes"


def load_scene(name_or_path: str | Path) -> Scene:
    """Return a built-in scene by name, or the scene of a TOML file."""
    name = str(name_or_path)
    table = _read(name)
    if name.endswith(".toml"):
        name = Path(name).stem
    return _scene(name, table)


def _read(name: str) -> dict[str, Any]:
    """Return the merged tables of a scene and its bases."""
    seen: list[str] = []
    merged: dict[str, Any] = {}
    while name or not seen:
        if name in seen:
            raise ParameterError(f"scene {name!r}: its bases go round in a circle")
        seen.append(name)
        table = _parse(name)
        base = table.pop("base", "")
        if not isinstance(base, str):
            raise ParameterError(f"scene {name!r}: base = {base!r}, allowed: a scene's name")
        merged = _overlay(table, merged)
        if base.endswith(".toml") and name.endswith(".toml"):
            base = str(Path(name).parent / base)
        name = base
    return merged


def _parse(name: str) -> dict[str, Any]:
    if name.endswith(".toml"):
        try:
            text = Path(name).read_text(encoding="utf-8")
        except (OSError, ValueError) as problem:  # bytes that are no text, a path that is none
            reason = getattr(problem, "strerror", None) or "not a text file"
            raise ParameterError(f"scene = {name!r}: cannot be read ({reason})") from None
    elif name in builtin_scenes():
        text = (_folder() / f"{name}.toml").read_text(encoding="utf-8")
    else:
        known = builtin_scenes()
        hint = suggestion(name, known, "; did you mean {!r}?")
        raise ParameterError(
            f"scene = {name!r}, allowed: {', '.join(known)} or the path of a .toml file{hint}"
        )
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as problem:  # also numbers and nesting without end
        raise ParameterError(f"scene = {name!r}: not valid TOML ({problem})") from None


def _overlay(base: dict[str, Any], top: dict[str, Any]) -> dict[str, Any]:
    result = dict(base)
    for key, value in top.items():
        both = isinstance(value, dict) and isinstance(result.get(key), dict)
        both = both and key != "published"  # figures of one source stay together
        result[key] = _overlay(result[key], value) if both else value
    return result


def _unknown(where: str, key: str, known: list[str]) -> ParameterError:
    hint = suggestion(key, known, "; did you mean {!r}?", f", allowed: {', '.join(known)}")
    return ParameterError(f"{where}: there is no {key!r} here{hint}")


def _number(where: str, key: str, value: Any, rule: tuple[str, float, float]) -> float:
    unit, low, high = rule
    number = _quantity(where, key, value, unit)
    if not low <= number <= high:
        tail = "" if unit == "1" else f" {unit}"
        raise ParameterError(
            f"{where}: {key} = {number!r}{tail}, allowed: {low:g} .. {high:g}{tail}"
        )
    return number


def _quantity(where: str, key: str, value: Any, unit: str) -> float:
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ParameterError(f"{where}: {key} = {value!r}, a number in {unit} is wanted")
    try:
        return parse_quantity(value, unit, key)
    except ParameterError as problem:
        raise ParameterError(f"{where}: {problem}") from None


def _scene(name: str, table: dict[str, Any]) -> Scene:
    where = f"scene {name!r}"
    known = [*TEXTS, *NUMBERS, *TABLES]
    for key, value in table.items():
        if key not in known:
            raise _unknown(where, key, known)
        if key in TEXTS and not isinstance(value, str):
            raise ParameterError(f"{where}: {key} = {value!r}, allowed: a text")
        if key in TABLES and not isinstance(value, dict):
            raise ParameterError(f"{where}: {key} = {value!r}, allowed: a table [{key}]")
    for key in (*REQUIRED, "shift", "stop_time"):
        if key not in table:
            raise ParameterError(f"{where}: {key!r} is missing")
    numbers = {"start_time": 0.0, "step": 1e-3, "oil_temperature": 297.15}
    numbers |= {k: _number(where, k, table[k], NUMBERS[k]) for k in NUMBERS if k in table}
    parts = {}
    for key in PARTS:
        if key in table:
            given = dict(table[key])
            if "fidelity" in table and len(PARTS[key].fidelities) > 1:
                given.setdefault("fidelity", table["fidelity"])  # the scene's word for all parts
            parts[key] = _part(f"{where} [{key}]", PARTS[key], given)
    scene = Scene(
        name=name,
        title=table.get("title", name),
        description=table.get("description", "").strip(),
        master=table.get("master", "gauss-seidel"),
        parts=parts,
        published=_published(f"{where} [published]", table.get("published")),
        **_shift(f"{where} [shift]", table["shift"]),
        **numbers,
    )
    return scene.checked()


def _shift(where: str, table: dict[str, Any]) -> dict[str, float]:
    """Return the ramp of the shift command, as fields of a scene."""
    for key in table:
        if key not in SHIFT:
            raise _unknown(where, key, list(SHIFT))
    given = {f"shift_{key}": _number(where, key, x, SHIFT[key]) for key, x in table.items()}
    return {"shift_start": 0.0, "shift_duration": 0.0, **given}


def _published(where: str, table: dict[str, Any] | None) -> Published | None:
    """Return what a source says about this scene."""
    if table is None:
        return None
    values = dict(table)
    source = values.pop("source", None)
    if not isinstance(source, str):
        raise ParameterError(f"{where}: source = {source!r}, allowed: a text")
    for key in values:
        if key not in FIGURES:
            raise _unknown(where, key, ["source", *FIGURES])
    figures = {k: _quantity(where, k, v, FIGURES[k].unit) for k, v in values.items()}
    return Published(source=source, figures=figures)


RESERVED = {
    "oil_temperature": "the scene's own oil_temperature sets it for all parts",
    "torque_age": "the choice of master sets it",
    "input_course": "in a shift it is linear, as the transmission expects",
}


def _part(where: str, spec: ModelSpec, table: dict[str, Any]) -> Part:
    known = {f.name: f.metadata for f in fields(spec.params)}
    values: dict[str, Any] = {}
    preset = None
    fidelity, tolerance = spec.default_fidelity, None
    for key, value in table.items():
        if key == "fidelity":
            fidelity, tolerance = rung_and_tolerance(where, spec, value)
        elif key == "preset" and spec.presets:
            preset = str(value)
        elif key not in known:
            raise _unknown(where, key, ["fidelity", *known])
        elif key in RESERVED:
            raise ParameterError(f"{where}: {key} cannot be set here; {RESERVED[key]}")
        else:
            values[key] = _value(where, key, value, known[key])
    try:
        params = made_of(spec, preset, values)
        return Part(spec=spec, fidelity=fidelity, params=params, tolerance=tolerance)
    except ParameterError as problem:
        raise ParameterError(f"{where}: {problem}") from None


def _value(where: str, key: str, value: Any, meta: Any) -> Any:
    if meta["kind"] == "real":
        return _quantity(where, key, value, meta["unit"])
    wanted = {"integer": int, "boolean": bool, "enumeration": str}[meta["kind"]]
    if not isinstance(value, wanted) or (wanted is int and isinstance(value, bool)):
        raise ParameterError(f"{where}: {key} = {value!r}, allowed: {allowed(meta)}")
    return value
