"""What a scene says that is hardly meant: the values, why it matters and what to do."""

from collections.abc import Iterator
from typing import Any

from ...transmission.parameters import COURSES, course_points
from .scene import Scene


def doubts(scene: Scene) -> Iterator[str]:
    """Say what is doubtful, one line each; nothing of a scene that fits together."""
    gearbox = scene.parts["transmission"].params
    yield from _of_washers(scene, gearbox)
    yield from _of_bearings(scene, gearbox)
    for name in COURSES:
        last = [t for t, _ in course_points(gearbox, name)][-1:]
        if last and last[0] > scene.stop_time:
            yield (
                f"{name}: the last point is at {last[0]:g} s, the run ends at {scene.stop_time:g} "
                "s: the shift is cut off; a later stop_time shows all of it"
            )


def _of_washers(scene: Scene, gearbox: Any) -> Iterator[str]:
    if "washer" not in scene.parts or not gearbox.washers:
        return
    if gearbox.washers != 2 * gearbox.planets:
        yield (
            f"washers = {gearbox.washers} with planets = {gearbox.planets}: thrust_share is shared "
            f"by the two washers of a planet; {2 * gearbox.planets} washers go with it"
        )
    washer = scene.parts["washer"].params
    if not washer.inner_radius <= gearbox.washer_radius <= washer.outer_radius:
        yield (
            f"washer_radius = {gearbox.washer_radius:g} m, where the load acts, is off the washer "
            f"of {washer.inner_radius:g} .. {washer.outer_radius:g} m: its load is wrong by about "
            "their ratio; give [transmission] washer_radius the washer's mean radius"
        )


def _of_bearings(scene: Scene, gearbox: Any) -> Iterator[str]:
    for name in (name for name, there in scene.bearings.items() if there):
        gear = name.removesuffix("_bearing")
        ends = [getattr(gearbox, f"{name}_shaft_{i}") for i in (1, 2)]
        if gearbox.helix_angle == 0.0:
            yield f"[{name}]: helix_angle = 0, spur teeth give no thrust: the bearing does nothing"
        elif gear not in ends:
            yield (
                f"[{name}]: between {ends[0]} and {ends[1]}, not at the {gear}, whose thrust it "
                f"takes: the place where that leaves the {gear} rubs as well and is left out"
            )
