"""What a scene says that is hardly meant: the values, why it matters and what to do."""

import math
from collections.abc import Iterator
from typing import Any

from ...clutch.parameters import ClutchParams
from ...clutch.solve import doubts_of_pack
from ...gearmesh.parameters import GearMeshParams
from ...gearmesh.plausibility import doubts_of_parameters
from ...model.idle import idle_warnings
from ...transmission.parameters import PROFILES, profile_points
from ..warning_texts import scope_of, warnings_of
from .connections import MESHES
from .scene import Part, Scene

APART = 0.01  # of the centre distance, which may come from rounded transverse numbers
TURNED = 1e-3  # rad
ROOT = 1.25  # modules from pitch to root


def doubts(scene: Scene) -> Iterator[str]:
    """Say what is doubtful, one line each; nothing of a scene that fits together."""
    gearbox = scene.parts["transmission"].params
    yield from _of_washers(scene, gearbox)
    yield from _of_bearings(scene, gearbox)
    yield from _of_meshes(scene)
    yield from idle_parameters(scene)
    values = {"profiles": profile_rows(gearbox), "stop_time": scene.stop_time}
    yield from warnings_of("scene", scope_of(values))


def profile_rows(gearbox: Any) -> list[dict[str, Any]]:
    """Return the profiles of a transmission's parameters with their last times [s]."""
    last = {name: profile_points(gearbox, name)[-1:] for name in PROFILES}
    return [{"profile": name, "last": points[0][0]} for name, points in last.items() if points]


def idle_parameters(scene: Scene) -> Iterator[str]:
    """Say which levels are gone, and which parameters have no effect."""
    for name, part in scene.parts.items():
        is_pack, level = isinstance(part.params, ClutchParams), part.asked or part.fidelity
        for line in (
            doubts_of_pack(part.params, level, part.usual)
            if is_pack
            else idle_warnings(part.spec.key, part.params, level, part.usual)
        ):
            yield f"[{name}] {line}"


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

    teeth = gearbox.planet_teeth
    if teeth:
        root = 0.5 * teeth * gearbox.normal_module / math.cos(gearbox.helix_angle)
        root -= ROOT * gearbox.normal_module
        if washer.outer_radius > root:
            yield (
                f"[washer] outer_radius = {washer.outer_radius:g} m, but the planet of {teeth} "
                f"teeth has a root radius of {root:.4g} m: the washer does not fit next to it"
            )


def _of_bearings(scene: Scene, gearbox: Any) -> Iterator[str]:
    for name in (name for name, there in scene.bearings.items() if there):
        gear = name.removesuffix("_bearing")
        ends = [getattr(gearbox, f"{name}_shaft_{i}") for i in (1, 2)]
        if gearbox.helix_angle > 0.0 and gear not in ends:
            yield (
                f"[{name}]: between {ends[0]} and {ends[1]}, not at the {gear}, whose thrust it "
                f"takes: the place where that leaves the {gear} rubs as well and is left out"
            )


def _of_meshes(scene: Scene) -> Iterator[str]:
    for name in MESHES:
        mesh = scene.parts[name].params if name in scene.parts else None
        if isinstance(mesh, GearMeshParams):
            for line in _beside_the_set(scene.parts["transmission"], name, mesh):
                yield f"[{name}] {line}"
            for line in doubts_of_parameters(mesh):
                yield f"[{name}] {line}"


def _beside_the_set(gearbox: Part, name: str, mesh: GearMeshParams) -> Iterator[str]:
    own = gearbox.params
    planet = own.planet_teeth or 0.5 * (own.ring_teeth - own.sun_teeth)
    gear, mate = ("ring", own.ring_teeth) if name == "ring_mesh" else ("sun", own.sun_teeth)
    teeth = mesh.gear_ratio * mesh.pinion_teeth
    if mesh.internal != (gear == "ring"):
        yield f"internal = {mesh.internal}, but it is the mesh of planet and {gear}"
    if mesh.pinion_teeth != planet or abs(teeth - mate) > 0.5:
        yield (
            f"pinion_teeth = {mesh.pinion_teeth}, gear_ratio = {mesh.gear_ratio:.6g} ({teeth:.4g} "
            f"teeth), but [transmission] has a planet of {planet:g} and a {gear} of {mate} teeth: "
            "loss and stress are those of another set"
        )
    elif mesh.internal == (gear == "ring"):
        side = -1.0 if mesh.internal else 1.0
        size = 0.5 * (mate + side * planet)  # centre distance over transverse module
        apart = mesh.centre_distance
        if mesh.normal_module > 0.0:
            apart = size * mesh.normal_module / math.cos(mesh.helix_angle)
        expected = size * own.normal_module / math.cos(own.helix_angle)
        if abs(apart / expected - 1.0) > APART:
            yield (
                f"centre distance = {apart:.6g} m, but [transmission] has {expected:.6g} m by its "
                "teeth and normal_module"
            )
    if mesh.film_heat == "loss" and abs(mesh.helix_angle - own.helix_angle) > TURNED:
        yield (
            f"helix_angle = {mesh.helix_angle:.6g} rad, but that of [transmission] is "
            f"{own.helix_angle:.6g} rad: the washers' load belongs to other teeth"
        )
