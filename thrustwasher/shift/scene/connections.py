"""The parts of a shift, who passes what to whom, and what else differs from part to part."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from ...clutch import parameters
from ...command import parameters as command_params
from ...gearmesh import parameters as gearmesh_params
from ...losses import parameters as losses_params
from ...model.spec import ModelSpec
from ...model.toml_tables import table_beside
from ...sump import parameters as sump_params
from ...transmission import parameters as transmission_params
from ...washer import parameters as washer_params

# Part -> model. A part is in a scene if the scene has a table of its name.
PARTS: dict[str, ModelSpec] = {
    "transmission": transmission_params.SPEC,
    "sump": sump_params.SPEC,  # before the parts whose oil it has
    "clutch": parameters.SPEC,
    "brake": parameters.SPEC,
    "washer": washer_params.SPEC,
    "mesh": gearmesh_params.SPEC,  # of sun and planet; without a ring mesh it stands for both
    "ring_mesh": gearmesh_params.SPEC,
    "losses": losses_params.SPEC,
}
PACKS = ("clutch", "brake")
MESHES = ("mesh", "ring_mesh")
REQUIRED = ("transmission", *PACKS)
SPEED = "speed"  # of a friction part: the slip whose sign its torque has
COMMAND = "shift_command"  # the transmission's input that the scene itself drives


class Link(NamedTuple):
    """One signal from an output to an input."""

    source: str
    output: str
    target: str
    input: str


_TABLE = table_beside(__file__, "links.toml")
PACK_INPUTS = ("clutch_torque", "brake_torque")  # of the transmission

# At a tolerance.
DIRECT = (
    "washer",
)  # parts whose own torque is evaluated, in addition to what it does to the shift
# Models whose outputs follow from the inputs of the moment; a pack has a past: film, temperature.
WITHOUT_PAST = ("washer", "gearmesh")
# The outputs that a part is evaluated by.
JUDGED: Mapping[str, tuple[str, ...]] = {
    "washer": ("friction_torque",),
    "clutch": ("torque_capacity", "temperature"),
    "gearmesh": ("friction_torque",),
}

# In a package for other tools.
SOURCE = "command"  # the part that sends the shift command
SOURCE_SPEC = command_params.SPEC  # its model


def wired(parts: Mapping[str, Any]) -> list[Link]:
    """Return the links between the parts of a scene.

    They depend on what the packs send, and on what the gear behind a washer borders on.
    """
    coupling, present = parts["transmission"].params.coupling, set(parts)
    bulk = "washer" in parts and parts["washer"].params.gear_far_face == "bulk"
    found = []
    for table in ("signals", coupling, "more", *(["bulk"] if bulk else [])):
        for given, taken in _TABLE[table].items():
            link = Link(*taken.split("."), *given.split("."))
            if link.input == "oil_temperature" and "sump" in present:
                link = link._replace(source="sump", output="temperature")
            if {link.source, link.target} <= present:
                found.append(link)
    return found
