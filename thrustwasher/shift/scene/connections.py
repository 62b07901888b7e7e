"""The parts of a shift, who passes what to whom, and all else that is told part by part."""

from collections.abc import Mapping
from typing import NamedTuple

from ...clutch import parameters
from ...command import parameters as command_params
from ...gearmesh import parameters as gearmesh_params
from ...model.spec import ModelSpec
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


def _fed(part: str, *names: str, of: str = "") -> list[Link]:
    """Return what the transmission sends to a part: its outputs for it, or ``of`` it, and oil."""
    found = [Link("transmission", f"{of or part}_{name}", part, name) for name in names]
    return [*found, Link("transmission", "oil_supply_temperature", part, "oil_temperature")]


LINKS = (
    *_fed("clutch", "load", "speed"),
    *_fed("brake", "load", "speed"),
    *_fed("washer", "load", "speed", "tilt"),
    Link("washer", "friction_torque", "transmission", "washer_torque"),
    *_fed("mesh", "load", "speed"),
    Link("mesh", "friction_torque", "transmission", "mesh_torque"),
    *_fed("ring_mesh", "load", "speed", of="mesh"),  # the planet carries one force to both
    Link("ring_mesh", "friction_torque", "transmission", "ring_mesh_torque"),
)
PACK_INPUTS = ("clutch_torque", "brake_torque")  # of the transmission
PACK_OUTPUT = {"capacity": "torque_capacity", "torque": "friction_torque"}

HEATS = {  # of the sump
    "clutch": "heat_1", "brake": "heat_2", "washer": "heat_3", "mesh": "heat_4",
    "ring_mesh": "heat_5",
}  # fmt: skip

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
    ("transmission", ("engine_speed", "output_speed", "drum_speed", "clutch_speed",
                      "clutch_reaction", "brake_reaction", "clutch_locked", "brake_locked",
                      "lock_time", "lock_speed", "clutch_heat", "brake_heat", "washer_heat",
                      "mesh_heat", "energy_residual", "vehicle_speed",
                      "shaft_torque")),
    ("clutch", ("temperature", "film_ratio", "energy")),
    ("brake", ("temperature", "film_ratio", "energy")),
    ("washer", ("temperature_max", "film_ratio", "friction_power", "distress")),
    ("mesh", ("temperature", "film_ratio", "friction_power")),
    ("ring_mesh", ("temperature", "film_ratio", "friction_power")),
    ("sump", ("temperature",)),
)  # fmt: skip
# Where the parts are drawn: centre; a part is 40 wide and 30 high.
PLACES = {
    "command": (-120.0, 0.0), "transmission": (0.0, 0.0), "clutch": (120.0, 90.0),
    "brake": (120.0, 30.0), "washer": (120.0, -30.0), "mesh": (120.0, -90.0),
    "ring_mesh": (120.0, -150.0), "sump": (0.0, -90.0),
}  # fmt: skip


def links(coupling: str, present: set[str]) -> list[Link]:
    """Return the links between the parts present; ``coupling`` says what the packs send.

    A sump takes the heat of all parts that say what they give to their oil, and sets its
    temperature.
    """
    packs = [Link(pack, PACK_OUTPUT[coupling], "transmission", f"{pack}_torque") for pack in PACKS]
    packs += [
        Link("transmission", f"{pack}_drum_speed", pack, "drum_speed") for pack in PACKS
        if any(signal.name == "drum_speed" for signal in PARTS[pack].inputs)
    ]  # fmt: skip
    heats = [
        Link(part, "oil_heat", "sump", heat) for part, heat in HEATS.items()
        if any(signal.name == "oil_heat" for signal in PARTS[part].outputs)
    ]  # fmt: skip
    found = [k for k in (*LINKS, *packs, *heats) if k.source in present and k.target in present]
    if "sump" not in present:
        return found
    return [
        Link("sump", "temperature", k.target, k.input) if k.input == "oil_temperature" else k
        for k in found
    ]
