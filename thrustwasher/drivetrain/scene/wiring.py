"""The parts of a shift and who passes what to whom."""

from __future__ import annotations

from typing import NamedTuple

from ...models import clutch_params, gearmesh_params, transmission_params, washer_params
from ...models._spec import ModelSpec

# Part -> model. A part is in a scene if the scene has a table of its name.
PARTS: dict[str, ModelSpec] = {
    "transmission": transmission_params.SPEC,
    "clutch": clutch_params.SPEC,
    "brake": clutch_params.SPEC,
    "washer": washer_params.SPEC,
    "mesh": gearmesh_params.SPEC,
}
REQUIRED = ("transmission", "clutch", "brake")
SPEED = "speed"  # of a friction part: the slip whose sign its torque has
COMMAND = "shift_command"  # the transmission's input that the scene itself drives


class Link(NamedTuple):
    """One signal from an output to an input."""

    source: str
    output: str
    target: str
    input: str


LINKS = (
    Link("transmission", "clutch_load", "clutch", "load"),
    Link("transmission", "clutch_speed", "clutch", "speed"),
    Link("transmission", "oil_supply_temperature", "clutch", "oil_temperature"),
    Link("transmission", "brake_load", "brake", "load"),
    Link("transmission", "brake_speed", "brake", "speed"),
    Link("transmission", "oil_supply_temperature", "brake", "oil_temperature"),
    Link("transmission", "washer_load", "washer", "load"),
    Link("transmission", "washer_speed", "washer", "speed"),
    Link("transmission", "washer_tilt", "washer", "tilt"),
    Link("transmission", "oil_supply_temperature", "washer", "oil_temperature"),
    Link("washer", "friction_torque", "transmission", "washer_torque"),
    Link("transmission", "mesh_load", "mesh", "load"),
    Link("transmission", "mesh_speed", "mesh", "speed"),
    Link("transmission", "oil_supply_temperature", "mesh", "oil_temperature"),
    Link("mesh", "friction_torque", "transmission", "mesh_torque"),
)
PACK_INPUTS = ("clutch_torque", "brake_torque")  # of the transmission
PACK_OUTPUT = {"capacity": "torque_capacity", "torque": "friction_torque"}


def links(coupling: str, present: set[str]) -> list[Link]:
    """Return the links between the parts present; ``coupling`` says what the packs send."""
    packs = [
        Link(pack, PACK_OUTPUT[coupling], "transmission", f"{pack}_torque")
        for pack in ("clutch", "brake")
    ]
    return [k for k in (*LINKS, *packs) if k.source in present and k.target in present]
