"""What the page of a scene reads its warnings from: rules, and what they know of the scene."""

from collections.abc import Iterator
from typing import Any

from ...shift.checks.rule_data import scene_values
from ...shift.expressions import Tree
from ...shift.scene.connections import PACKS
from ...shift.scene.doubts import idle_parameters, profile_rows
from ...shift.scene.scene import Scene
from ...shift.warning_texts import KINDS, LIMITS, figures, rules, scope_of, warnings_of

FILLED = {f"transmission.{pack}_filled" for pack in PACKS}  # phases are read from it


def warning_data(scene: Scene, step: float) -> dict[str, Any]:
    """Return what the page's warnings are read from; ``step``: that of the run [s]. JSON types."""
    values = scene_values(scene, step)
    own = {"profiles": profile_rows(scene.parts["transmission"].params)}
    of_profiles = {
        *warnings_of("scene", scope_of(values | own))
    }  # the page has profiles of its own
    always = dict.fromkeys((*scene.warnings, *idle_parameters(scene)))
    there = {
        f"{name}.{s.name}"
        for name, part in scene.parts.items()
        for s in (*part.spec.inputs, *part.spec.outputs)
    }
    trees = [*figures().values()]
    for rule in rules():
        trees += [rule.when, *(holds for holds, _ in rule.text), *rule.figures.values()]
    return {
        "rules": [rule._asdict() for rule in rules()],
        "figures": figures(),
        "values": LIMITS | values,
        "kinds": len(KINDS),
        "always": [text for text in always if text not in of_profiles],
        "of_scene": [text for text in scene.warnings if text not in of_profiles],
        "watched": sorted(there & {*_signals(trees), *_texts(values), *FILLED}),
        "checked_outside": _outside(scene),
    }


def _signals(tree: Tree) -> Iterator[str]:
    """Yield the signals that expressions name; a name within one stands for both packs."""
    match tree:
        case ["signal", ["text", name]]:
            yield name
        case ["fill", *pieces]:
            for pack in PACKS:
                yield "".join(x[1] if x[0] == "text" else pack for x in pieces)
        case [*trees]:
            for one in trees:
                yield from _signals(one)


def _texts(value: Any) -> Iterator[str]:
    """Yield the texts in tables and rows."""
    match value:
        case str():
            yield value
        case dict():
            for one in value.values():
                yield from _texts(one)
        case [*rows]:
            for one in rows:
                yield from _texts(one)


def _outside(scene: Scene) -> list[str]:
    """Return what only the command line checks, in a few words each."""
    gearbox, washer = scene.parts["transmission"].params, scene.parts.get("washer")
    found = ["the error of the communication step"]
    if washer is not None and washer.params.thermal_mode != "transient":
        found.append("whether the washers' steady temperatures hold")
    if any(part.tolerance for part in scene.parts.values()):
        found.append("the fidelity levels that auto chose")
    if gearbox.shaft_stiffness:
        found.append("judder of the shaft")
    if gearbox.coupling == "torque":
        found.append("chatter of the packs")
    if scene.oil_temperature < 283.15:
        found.append("drag after a cold release")
    if "losses" in scene.parts:
        found.append("ranges of the laws of driveline losses")
    return found
