"""Tables of a scene file: engine, vehicle and pressures."""

from dataclasses import fields
from typing import Any

from ...errors import ParameterError, within
from ...model.toml_tables import nothing_else, quantity, read_value, unknown
from ...transmission.parameters import COURSES, course_fields
from ...transmission.vehicle import Vehicle
from .connections import PACKS

# Key of [pressure.clutch], [pressure.brake] -> parameter of the transmission, {} the pack.
PISTON = {
    key: f"{{}}_{key}"
    for key in ("piston_area", "return_spring", "fill_volume", "fill_flow", "pressure_lag")
}
TURNING = {
    "inner_radius": "piston_inner_radius", "outer_radius": "piston_outer_radius",
    "supply_radius": "piston_supply_radius", "balance_share": "balance_share",
}  # fmt: skip


def pairs(
    where: str, key: str, points: Any, over: tuple[str, str], unit: str, what: str = ""
) -> list[tuple[float, float]]:
    """Return pairs of two quantities in SI units; ``over``: name and unit of the first ones."""
    what = what or key
    if not isinstance(points, list) or not all(isinstance(p, list) and len(p) == 2 for p in points):
        raise ParameterError(f"{where}: {key} = {points!r}, allowed: pairs [{over[0]}, {what}]")
    return [
        (quantity(where, over[0], t, over[1]), quantity(where, what, x, unit)) for t, x in points
    ]


def driveline_table(where: str, table: dict[str, Any], vehicle: Vehicle | None) -> dict[str, Any]:
    """Return the table of the transmission with what engine, vehicle and pressures say of it."""
    given = dict(table["transmission"])
    more: dict[str, Any] = {}
    if vehicle:
        more |= vehicle.driveline(bool(given.get("shaft_stiffness", 0.0)))
    if "engine" in table:
        engine = dict(table["engine"])
        for key, name in (("speed", "initial_engine_speed"), ("inertia", "input_inertia")):
            if key in engine:
                more[name] = engine.pop(key)
        more |= points_of(f"{where} [engine]", "engine_torque", "torque", engine)
        nothing_else(f"{where} [engine]", engine, ["points", "speed", "inertia"])
        if "engine_torque" in given:
            raise ParameterError(
                f"{where} [engine]: beside [transmission] engine_torque, allowed: one"
            )
    for pack, own in table.get("pressure", {}).items():
        if pack not in PACKS or not isinstance(own, dict):
            raise unknown(f"{where} [pressure]", pack, list(PACKS))
        place, own, keys = f"{where} [pressure.{pack}]", dict(own), dict(PISTON)
        keys |= TURNING if pack == "clutch" else {}
        more |= points_of(place, f"{pack}_pressure", "pressure", own)
        more |= {name.format(pack): own.pop(key) for key, name in keys.items() if key in own}
        nothing_else(place, own, ["points", *keys])
        more["actuation"] = "pressure"
    for name in more:
        if name in given:
            raise ParameterError(
                f"{where} [transmission]: {name} = {given[name]!r} beside a table that gives "
                "it ([engine], [vehicle] or [pressure]), allowed: one of them"
            )
    return given | more


def vehicle_of(where: str, table: dict[str, Any] | None) -> Vehicle | None:
    """Return the vehicle of a scene."""
    if table is None:
        return None
    known = {f.name: f.metadata for f in fields(Vehicle)}
    nothing_else(where, table, known)
    values = {k: read_value(where, k, x, known[k]) for k, x in table.items()}
    with within(where):
        return Vehicle(**values)


def points_of(where: str, name: str, what: str, table: dict[str, Any]) -> dict[str, Any]:
    """Return the parameters of a course from the table's ``points``, pairs of time and value."""
    points = pairs(
        where, "points", table.pop("points", None), ("time", "s"), COURSES[name][0], what
    )
    with within(where):
        return course_fields(name, points)
