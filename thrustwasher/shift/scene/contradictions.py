"""What the parts of a scene say against each other: gear meshes beside their planetary set."""

import math
from collections.abc import Iterator, Mapping

from ...gearmesh.doubts import doubts_of_parameters
from ...gearmesh.parameters import GearMeshParams
from .connections import MESHES
from .scene import Part

APART = 0.01  # of the centre distance, which may come from rounded transverse numbers
TURNED = 1e-3  # rad


def contradictions(parts: Mapping[str, Part]) -> tuple[str, ...]:
    """Return a line for each thing that two parts say differently, and for each idle parameter."""
    meshes = {name: parts[name].params for name in MESHES if name in parts}
    return tuple(
        f"[{name}] {line}"
        for name, mesh in meshes.items() if isinstance(mesh, GearMeshParams)
        for line in (*_beside_the_set(parts["transmission"], name, mesh),
                     *doubts_of_parameters(mesh))
    )  # fmt: skip


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
        wanted = size * own.normal_module / math.cos(own.helix_angle)
        if abs(apart / wanted - 1.0) > APART:
            yield (
                f"centre distance = {apart:.6g} m, but [transmission] has {wanted:.6g} m by its "
                "teeth and normal_module"
            )
    if mesh.film_heat == "loss" and abs(mesh.helix_angle - own.helix_angle) > TURNED:
        yield (
            f"helix_angle = {mesh.helix_angle:.6g} rad, but that of [transmission] is "
            f"{own.helix_angle:.6g} rad: the washers' load belongs to other teeth"
        )
