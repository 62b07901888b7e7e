"""An evaluator from a name, a path, a part, a scene or a function: made once, at the door."""

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...errors import ParameterError, suggestion
from ...model.part_file import PartFile, find_part, holds_part, scene_parts
from ...model.point import point_of
from ...model.registry import find_model, models_with_points
from ...model.scatter import Scatter
from ...settings import find_place, places

if TYPE_CHECKING:
    from ...shift.scene.scene import Scene

# kind -> where it scatters, and how
EXAMPLES = {
    "part": ("part file", 'load = "5 %"'),
    "scene": ("scene", 'oil_temperature = "3 K"'),
}


def evaluator(
    target: "str | Path | PartFile | Scene | Callable[..., Any]",
    *,
    at: Mapping[str, object] | None = None,
    reached: str = "below",
    table: Mapping[str, Any] | None = None,
) -> Any:
    """Return what is studied as an ``Evaluator``.

    Parameters
    ----------
    target : a part, a scene of one shift, the path of such a file, the name of a model or of a
        built-in scene, or a function that takes numbers by name
    at : inputs of a part, as numbers [SI] or "1.2 kN"; others are at its box or their defaults
    reached : of a washer with several solutions, the branch: "below" or "above"
    table : quantities of a function, as ``scatter`` of ``propagate``

    Raises
    ------
    ParameterError : there is no such part or scene, or something is not allowed
    """
    if callable(target):
        if at:
            raise ParameterError("at: is of a part's inputs; give a function its defaults")
        from .function import function_evaluator

        return function_evaluator(target, table)
    found: Any = part_or_scene(str(target)) if isinstance(target, str | Path) else target
    if isinstance(found, PartFile):
        from .part import part_evaluator

        return part_evaluator(found, inputs_of(found, at or {}), reached)
    if at:
        raise ParameterError("at: is of a part's inputs; a scene has its own")
    from .scene import scene_evaluator

    return scene_evaluator(found)


def scattering(
    target: Any,
    *,
    scatter: Mapping[str, Any] | None = None,
    at: Mapping[str, object] | None = None,
    reached: str = "below",
) -> tuple[Any, Scatter]:
    """Return what is studied, and how it scatters; ParameterError if nothing does.

    ``scatter``: instead of its own; what is wrong with it is said before a scene is run.
    """
    made = evaluator(target, at=at, reached=reached, table=scatter)
    drawn = made.scattered(scatter)
    if made.kind in EXAMPLES and not drawn.sources:
        what, example = EXAMPLES[made.kind]
        raise ParameterError(
            f"nothing scatters: add [scatter] to the {what}, such as {example}; in Python "
            "scatter = {name: law, ...}" + "".join(f" ({text})" for text in drawn.warnings)
        )
    return made, drawn


def engagements(
    part: "str | Path | PartFile" = "clutch", *, at: Mapping[str, object] | None = None
) -> Any:
    """Return engagements of a wet pack as an ``Evaluator``: load, slip, inertia and times vary.

    Parameters
    ----------
    part : a wet clutch (``load_part``), the path of its file, or "clutch"
    at : its inputs, as numbers [SI] or "1.2 kN"; others are at its box or their defaults
    """
    from .engagement import engagement_evaluator

    found = part if isinstance(part, PartFile) else find_part(str(part))
    return engagement_evaluator(found, inputs_of(found, at or {}))


def gearbox(scene: "str | Path | Scene", gear: str = "first") -> Any:
    """Return a scene's gearbox that runs steadily as an ``Evaluator``: torque and speed vary.

    Parameters
    ----------
    scene : a scene (``load_scene``), the path of its file, or the name of a built-in one
    gear : "first" or "second"
    """
    from ...shift import load_scene
    from .gearbox import gearbox_evaluator

    found = load_scene(scene) if isinstance(scene, str | Path) else scene
    return gearbox_evaluator(found, gear)


def part_of(target: object, *models: str) -> PartFile:
    """Return the part of a part, of parameters, of the name of a model or the path of a file.

    ``models``: the keys of those that are allowed; by default of all that are solved at points.
    ParameterError if it is none of these.
    """
    found = find_part(target) if isinstance(target, str) else target
    known = models or tuple(models_with_points())
    for key in known:
        if isinstance(found, PartFile) and (not models or found.spec.key == key):
            return found
        if isinstance(found, find_model(key).spec.params):
            values = {f.name: getattr(found, f.name) for f in fields(found)}
            return replace(find_part(key), parameters=values)
    kind = found.spec.key if isinstance(found, PartFile) else type(found).__name__
    raise ParameterError(f"part: {kind}, allowed: a part or parameters of {', '.join(known)}")


def is_at_points(target: object) -> bool:
    """Tell if something is a part, or names a model or a part that is solved at points."""
    if isinstance(target, PartFile):
        return True
    if not isinstance(target, str):
        return False
    if target.endswith(".toml"):
        return holds_part(target, "file")
    if target in models_with_points() or target in scene_parts():
        return True
    from ...shift import builtin_scenes

    return target not in builtin_scenes()


def inputs_of(part: PartFile, at: Mapping[str, object]) -> dict[str, float]:
    """Return the values [SI] of the model's inputs: those given, others at box or default."""
    known = {n: p for n, p in places(part.spec).items() if p.is_input}
    given = {name: float(find_place(name, known, part.spec).check(x)) for name, x in at.items()}
    return find_model(part.spec.key).place(point_of(part, given).values)


def part_or_scene(name: str) -> Any:
    """Return the part or scene of a name or a file; ParameterError if there is none."""
    parts = [*models_with_points(), *scene_parts()]
    if name in parts or (name.endswith(".toml") and holds_part(name)):
        return find_part(name)
    from ...shift import builtin_scenes, load_scene

    if name.endswith(".toml") or name in builtin_scenes():
        return load_scene(name)
    known = [*parts, *builtin_scenes()]
    hint = suggestion(name, known, "; did you mean {!r}?")
    raise ParameterError(
        f"target = {name!r}, allowed: a file (.toml) of a part or a scene, {', '.join(known)}{hint}"
    )
