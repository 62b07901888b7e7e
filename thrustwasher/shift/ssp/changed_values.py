"""A scene with other values of its parts, as ``shift --ssp --set`` asks for.

Hosts differ in what they read of the values in a package: some nothing at all. Changed before the
package is made, a value stands in the FMU's start values and in the package alike.
"""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from ...errors import ParameterError, suggestion
from ...model.quantity import of_field
from ...model.unread import unread
from ..scene.connections import SOURCE, SOURCE_SPEC
from ..scene.scene import Part, Scene
from .system_structure import BORDER, shown_as

# Of the source of the shift command: its parameter -> the scene's.
COMMAND = {
    "start": "shift_start",
    "duration": "shift_duration",
    "before": "shift_from",
    "after": "shift_to",
}


def changed(scene: Scene, settings: Mapping[str, str]) -> Scene:
    """Return the scene with other values.

    Parameters
    ----------
    scene : of one shift
    settings : by "part.parameter" ("clutch.friction_scale") or by the name of a parameter of the
        package's system ("engine_torque_1"), texts as in ``--set``

    Raises
    ------
    ParameterError : there is no such parameter, it is not used in this scene, or a value is not
        allowed
    """
    known = {path: (part, name) for part, name in _places(scene) for path in _paths(part, name)}
    parts, own = dict(scene.parts), dict[str, Any]()
    for path, text in settings.items():
        if path not in known:
            hint = suggestion(path, known, "did you mean {}? ")
            raise ParameterError(
                f"--set {path}={text}: the package has no parameter {path!r}; {hint}a parameter is "
                f"PART.NAME; parts: {', '.join((SOURCE, *scene.parts))}"
            )
        part, name = known[path]
        if part == SOURCE:
            own[COMMAND[name]] = _value(path, SOURCE_SPEC.params, name, text, scene.start_time)
            continue
        parts[part] = _with_value(parts[part], path, name, text)
    for path in settings:  # when all are set: one may switch another one on
        part, name = known[path]
        if part != SOURCE:
            _check_used(parts[part], path, name)
    return replace(scene, parts=parts, **own).checked()


def _places(scene: Scene) -> list[tuple[str, str]]:
    """Return part and name of all parameters."""
    of_parts = [(n, f.name) for n, p in scene.parts.items() for f in fields(p.params)]
    return [*((SOURCE, name) for name in COMMAND), *of_parts]


def _paths(part: str, name: str) -> list[str]:
    """Return what a parameter is called: by its part, and as one of the system if it is one."""
    is_shown = name in BORDER["parameters"].get(part, ())
    return [f"{part}.{name}", *([shown_as(part, name)] if is_shown else [])]


def _value(path: str, params: Any, name: str, text: str, start: float) -> Any:
    """Return a value; a time that counts from the ``start`` of the run [s] as the scene's."""
    about = next(f for f in fields(params) if f.name == name)
    value = of_field(path, about.default, about.metadata).check(text)
    return float(value) + start if "instant" in about.metadata else value


def _with_value(part: Part, path: str, name: str, text: str) -> Part:
    value = _value(path, part.params, name, text, part.start)
    return replace(part, params=replace(part.params, **{name: value}))


def _check_used(part: Part, path: str, name: str) -> None:
    if failing := unread(part.params, name, part.fidelity):
        by = ", ".join(dict.fromkeys(c.by for c in failing if c.by))
        raise ParameterError(
            f"--set {path}: not used in this scene" + (f", see {by}" if by else "")
        )
