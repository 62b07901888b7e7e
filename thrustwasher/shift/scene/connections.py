"""The parts of a shift, who passes what to whom, and all else that is told part by part."""

from collections.abc import Mapping
from typing import NamedTuple

from ...clutch import parameters
from ...command import parameters as command_params
from ...gearmesh import parameters as gearmesh_params
from ...model.spec import ModelSpec
from ...transmission import parameters as transmission_params
from ...washer import parameters as washer_params

# Part -> model. A part is in a scene if the scene has a table of its name.
PARTS: dict[str, ModelSpec] = {
    "transmission": transmission_params.SPEC,
    "clutch": parameters.SPEC,
    "brake": parameters.SPEC,
    "washer": washer_params.SPEC,
    "mesh": gearmesh_params.SPEC,
}
PACKS = ("clutch", "brake")
REQUIRED = ("transmission", *PACKS)
SPEED = "speed"  # of a friction part: the slip whose sign its torque has
COMMAND = "shift_command"  # the transmission's input that the scene itself drives


class Link(NamedTuple):
    """One signal from an output to an input."""

    source: str
    output: str
    target: str
    input: str


def _fed(part: str, *names: str) -> list[Link]:
    """Return what the transmission sends to a part: its own outputs for it, and the oil."""
    found = [Link("transmission", f"{part}_{name}", part, name) for name in names]
    return [*found, Link("transmission", "oil_supply_temperature", part, "oil_temperature")]


LINKS = (
    *_fed("clutch", "load", "speed"),
    *_fed("brake", "load", "speed"),
    *_fed("washer", "load", "speed", "tilt"),
    Link("washer", "friction_torque", "transmission", "washer_torque"),
    *_fed("mesh", "load", "speed"),
    Link("mesh", "friction_torque", "transmission", "mesh_torque"),
)
PACK_INPUTS = ("clutch_torque", "brake_torque")  # of the transmission
PACK_OUTPUT = {"capacity": "torque_capacity", "torque": "friction_torque"}

# At a tolerance.
DIRECT = ("washer",)  # parts whose own torque is judged, beside what it does to the shift
# Models whose outputs follow from the inputs of the moment; a pack has a past: film, temperature.
WITHOUT_PAST = ("washer", "gearmesh")
# What a part is judged by: quantity of its cards, output that the check compares.
QUANTITIES: Mapping[str, tuple[tuple[str, str], ...]] = {
    "washer": (("friction_torque", "friction_torque"),),
    "clutch": (("friction_torque", "torque_capacity"), ("temperature", "temperature")),
    "gearmesh": (("friction_torque", "friction_torque"),),
}

# In a package for other tools.
SOURCE = "command"  # the part that sends the shift command
SOURCE_SPEC = command_params.SPEC  # its model
# What the system shows at its border: part, outputs.
SHOWN = (
    ("command", ("command",)),
    ("transmission", ("engine_speed", "output_speed", "ring_speed", "clutch_speed",
                      "clutch_reaction", "brake_reaction", "clutch_locked", "brake_locked",
                      "lock_time", "lock_speed", "clutch_heat", "brake_heat", "washer_heat",
                      "mesh_heat", "energy_residual", "vehicle_speed",
                      "shaft_torque")),
    ("clutch", ("temperature", "film_ratio", "energy")),
    ("brake", ("temperature", "film_ratio", "energy")),
    ("washer", ("temperature_max", "film_ratio", "friction_power", "distress")),
    ("mesh", ("temperature", "film_ratio", "friction_power")),
)  # fmt: skip
# Where the parts are drawn: centre; a part is 40 wide and 30 high.
PLACES = {
    "command": (-120.0, 0.0), "transmission": (0.0, 0.0), "clutch": (120.0, 90.0),
    "brake": (120.0, 30.0), "washer": (120.0, -30.0), "mesh": (120.0, -90.0),
}  # fmt: skip


def links(coupling: str, present: set[str]) -> list[Link]:
    """Return the links between the parts present; ``coupling`` says what the packs send."""
    packs = [Link(pack, PACK_OUTPUT[coupling], "transmission", f"{pack}_torque") for pack in PACKS]
    return [k for k in (*LINKS, *packs) if k.source in present and k.target in present]
