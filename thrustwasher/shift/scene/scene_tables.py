"""Tables of a scene file: engine, vehicle, pressures, thrust bearings and oil."""

from dataclasses import fields
from typing import Any

from ...errors import ParameterError, within
from ...model.toml_tables import nothing_else, number, quantity, read_value, unknown
from ...transmission.bearings import BEARINGS, SHAFT
from ...transmission.parameters import PROFILES, profile_fields
from ...transmission.vehicle import Vehicle
from .connections import PACKS
from .scene import STEP_RANGE

# Key -> (unit, minimum, maximum).
NUMBERS = {
    "start_time": ("s", -1e6, 1e6),
    "stop_time": ("s", -1e6, 1e6),
    "step": ("s", *STEP_RANGE),
    "oil_temperature": ("K", 233.15, 473.15),
}
SHIFT = {
    "start": ("s", -1e6, 1e6),
    "duration": ("s", 0.0, 1e3),
    "from": ("1", 0.0, 1.0),
    "to": ("1", 0.0, 1.0),
}
PROFILE = ("points", "points_from")  # of a table with a profile
SCALE = ("1", 0.01, 100.0)  # a factor, 1 where none is given
ENGINE = {"speed": "initial_engine_speed", "inertia": "input_inertia"}
# Key of [pressure.clutch], [pressure.brake] -> parameter of the transmission, {} the pack.
PISTON = {
    key: f"{{}}_{key}"
    for key in ("piston_area", "return_spring", "fill_volume", "fill_flow", "pressure_lag")
}
TURNING = {
    "inner_radius": "piston_inner_radius",
    "outer_radius": "piston_outer_radius",
    "supply_radius": "piston_supply_radius",
    "balance_share": "balance_share",
}

# What a part of a scene cannot say for itself.
RESERVED = {
    "oil_temperature": "the scene's own oil_temperature sets it for all parts",
    "torque_age": "the choice of master sets it",
    "ring_mesh": "a table [ring_mesh] sets it",
    "input_profile": "in a shift it is linear, as the transmission expects",
    "holding": "in a shift it is off: the transmission decides between stick and slip",
}

NEEDLES = 0.004  # friction of a needle thrust bearing at its mean radius: an estimate
BEARING_TABLES = tuple(BEARINGS)
# Of [transmission], what acts no more next to a table: key -> (table, what it says instead).
USELESS = {
    "engine_torque": ("engine", "its points"),
    "engine_start_time": ("engine", "its points"),
    "clutch_force": ("pressure", "profiles of pressure"),
    "brake_force": ("pressure", "profiles of pressure"),
}


def driveline_table(where: str, table: dict[str, Any], vehicle: Vehicle | None) -> dict[str, Any]:
    """Return the table of the transmission with what engine, vehicle and pressures say of it."""
    given = dict(table["transmission"])
    more: dict[str, Any] = {}
    if vehicle:
        more |= vehicle.driveline(bool(given.get("shaft_stiffness", 0.0)))
    if "engine" in table:
        engine = dict(table["engine"])
        more |= {name: engine.pop(key) for key, name in ENGINE.items() if key in engine}
        factor = factor_of(f"{where} [engine]", "torque_scale", engine)
        more |= points_of(f"{where} [engine]", "engine_torque", "torque", engine, factor)
        nothing_else(f"{where} [engine]", engine, [*PROFILE, "torque_scale", *ENGINE])
    for pack, own in table.get("pressure", {}).items():
        if pack not in PACKS or not isinstance(own, dict):
            raise unknown(f"{where} [pressure]", pack, list(PACKS))
        place, own, keys = f"{where} [pressure.{pack}]", dict(own), dict(PISTON)
        keys |= TURNING if pack == "clutch" else {}
        factor = factor_of(place, "scale", own)
        more |= points_of(place, f"{pack}_pressure", "pressure", own, factor)
        more |= {name.format(pack): own.pop(key) for key, name in keys.items() if key in own}
        nothing_else(place, own, [*PROFILE, "scale", *keys])
        more["actuation"] = "pressure"
    for name in BEARING_TABLES:
        if name in table:
            more |= bearing_of(f"{where} [{name}]", name, table[name])
    for name, (other, says) in USELESS.items():
        if name in given and other in table:
            raise ParameterError(
                f"{where} [transmission]: {name} = {given[name]!r} together with [{other}], "
                f"allowed: one "
                f"of them ({says} would act alone)"
            )
    for name in more:
        if name in given:
            raise ParameterError(
                f"{where} [transmission]: {name} = {given[name]!r} together with a table "
                f"that gives "
                "it ([engine], [vehicle], [pressure] or a bearing's), allowed: one of them"
            )
    return given | more


def bearing_of(where: str, name: str, table: dict[str, Any]) -> dict[str, Any]:
    """Return the parameters of a thrust bearing: the shafts it lies between, friction, radius."""
    nothing_else(where, table, ["between", "coefficient", "mean_radius"])
    more = {f"{name}_coefficient": table.get("coefficient", NEEDLES)}
    if "mean_radius" in table:
        more[f"{name}_mean_radius"] = table["mean_radius"]
    if "between" in table:
        ends = table["between"]
        pair = isinstance(ends, list) and len(ends) == 2 and all(end in SHAFT for end in ends)
        if not pair or ends[0] == ends[1]:
            raise ParameterError(
                f"{where}: between = {ends!r}, allowed: two different shafts of "
                f'{", ".join(SHAFT)}, as in ["{next(iter(SHAFT))}", "carrier"]'
            )
        more |= {f"{name}_shaft_1": ends[0], f"{name}_shaft_2": ends[1]}
    return more


def vehicle_of(where: str, table: dict[str, Any] | None) -> Vehicle | None:
    """Return the vehicle of a scene."""
    if table is None:
        return None
    known = {f.name: f.metadata for f in fields(Vehicle)}
    table = {key: x for key, x in table.items() if key != "points_from"}
    nothing_else(where, table, known)
    values = {k: read_value(where, k, x, known[k]) for k, x in table.items()}
    with within(where):
        return Vehicle(**values)


def factor_of(where: str, key: str, table: dict[str, Any]) -> float:
    """Take a factor out of a table and return it; 1 without."""
    return number(where, key, table.pop(key, 1.0), SCALE)


def points_of(
    where: str, name: str, what: str, table: dict[str, Any], factor: float = 1.0
) -> dict[str, Any]:
    """Return the parameters of a profile from the table's ``points``, pairs of time and value.

    The values are multiplied by ``factor``.
    """
    points = table.pop("points", None)
    table.pop("points_from", None)
    if not isinstance(points, list) or not all(isinstance(p, list) and len(p) == 2 for p in points):
        raise ParameterError(
            f"{where}: points = {points!r}, allowed: pairs [time, {what}] or a file"
        )
    unit = PROFILES[name][0]
    found = [
        (quantity(where, "time", t, "s"), factor * quantity(where, what, x, unit))
        for t, x in points
    ]
    with within(where):
        return profile_fields(name, found)
