"""A scene with other values at some paths, and the text of its file."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ...errors import ParameterError
from ...model.parameters import held_choices
from ...model.toml_tables import unknown
from .places import COLUMNS, scene_places
from .scene import Scene
from .scene_file import merged_tables, scene_of

Tables = dict[str, Any]
OPTIONS = ("step", "master", "stop_time")  # what may be changed in a scene after it is read,
DRAW = "One draw of the scatter of scene {!r}"
LEVEL = ("fidelity", "tolerance", "asked")  # and in its parts


def varied_scene(scene: Scene, values: Mapping[str, object], *, warned: bool = True) -> Scene:
    """Return the scene with other values.

    Parameters
    ----------
    scene : as ``load_scene`` returns it, or with other options and levels since
    values : by path, SI units, as ``scene_places`` names them
    warned : with the warnings of what is doubtful in it

    Raises
    ------
    ParameterError : there is no such path, or the values do not go together
    """
    found = scene_of(scene.source, _with_values(scene, values), warned=warned)
    options = {key: getattr(scene, key) for key in OPTIONS if _differs(scene, found, key)}
    levels = {
        name: replace(part, **{key: getattr(scene.parts[name], key) for key in LEVEL})
        for name, part in found.parts.items()
        if any(_differs(scene.parts[name], part, key) for key in LEVEL)
    }
    if not options and not levels:
        return found
    return replace(found, parts={**found.parts, **levels}, **options).checked()


def scene_text(scene: Scene, values: Mapping[str, object], head: str = DRAW) -> str:
    """Return the text of a file with the scene as its base and other values, by path.

    ``head`` is its first line, with the scene's name in it. Read back it is
    ``varied_scene(scene, values)``, to the bit.
    """
    named = scene.source.endswith(".toml")
    base = Path(scene.source).resolve().as_posix() if named else scene.source
    before, now = merged_tables(scene.source), _with_values(scene, values)
    found = scene_of(scene.source, now)
    now |= {key: getattr(scene, key) for key in OPTIONS if _differs(scene, found, key)}
    for name, part in scene.parts.items():
        if _differs(part, found.parts[name], "fidelity", "tolerance"):
            level = f"auto:{part.tolerance}" if part.tolerance else part.fidelity
            now[name] = now[name] | {"fidelity": level}
    lines = [f"# {head.format(scene.name)}", f"base = {json.dumps(base)}"]
    return "\n".join([*lines, *_written(_difference(before, now))]) + "\n"


def _differs(one: object, other: object, *keys: str) -> bool:
    return any(getattr(one, key) != getattr(other, key) for key in keys)


def _with_values(scene: Scene, values: Mapping[str, object]) -> Tables:
    """Return the scene's tables with other values; what does not change is shared."""
    if not scene.table:
        raise ParameterError(f"scene {scene.name!r}: was made by hand, allowed: of load_scene")
    tables = dict(scene.table)
    for path, value in {**_held(scene, values), **values}.items():
        try:
            _put(tables, path.split("."), value)
        except (KeyError, IndexError, TypeError, ValueError):
            raise unknown(f"scene {scene.name!r}", path, scene_places(scene)) from None
    return tables


def _held(scene: Scene, values: Mapping[str, object]) -> dict[str, Any]:
    """Return the choices by path that hold over these values; see ``held_choices``."""
    changed: dict[str, list[str]] = {}
    for path in values:
        part, _, name = path.partition(".")
        if part in scene.parts:
            changed.setdefault(part, []).append(name)
    return {
        f"{part}.{name}": value
        for part, names in changed.items()
        for name, value in held_choices(scene.parts[part].params, names).items()
    }


def _put(table: Tables, path: list[str], value: object) -> None:
    """Put a value at a path into a table, whose tables and lists on the way are copied."""
    key, *rest = path
    if not rest:
        table[key] = value
    elif rest[0] in COLUMNS and len(rest) == 2:
        own = table[key] = dict(table[key])
        points = own["points"] = list(own["points"])
        pair = points[int(rest[1])] = list(points[int(rest[1])])
        pair[COLUMNS[rest[0]]] = value
    else:
        table[key] = dict(table.get(key, {}))
        _put(table[key], rest, value)


def _difference(before: Mapping[str, object], now: Mapping[str, object]) -> Tables:
    """Return what a table has that another one lacks, or has otherwise."""
    found: Tables = {}
    for key, value in now.items():
        old = before.get(key)
        if isinstance(value, Mapping) and isinstance(old, Mapping):
            if inner := _difference(old, value):
                found[key] = inner
        elif key not in before or value != old or type(value) is not type(old):
            found[key] = value
    return found


def _written(table: Mapping[str, object], above: str = "") -> Iterator[str]:
    """Yield the lines of a TOML table, its own values first."""
    inner = {key: value for key, value in table.items() if isinstance(value, Mapping)}
    own = {key: value for key, value in table.items() if key not in inner}
    if own and above:
        yield from ("", f"[{above}]")
    yield from (f"{_key(key)} = {json.dumps(value)}" for key, value in own.items())
    for key, value in inner.items():
        yield from _written(value, f"{above}.{_key(key)}".removeprefix("."))


def _key(name: str) -> str:
    return name if name.isidentifier() and name.isascii() else json.dumps(name)
