"""What can scatter in a scene, by the path of its value in the file: ``clutch.friction_scale``."""

from collections.abc import Iterator, Mapping
from dataclasses import fields, replace
from typing import Any

from ...model.oil import NUMBERS as OIL
from ...model.oil import SHEET
from ...model.parameters import earlier_of
from ...model.part_file import PartFile
from ...model.quantity import Quantity
from ...model.scatter import CORRELATION, LAWS, Scatter, read_scatter
from ...model.toml_tables import quantity
from ...transmission.parameters import POINTS, PROFILES, profile_fields
from ...transmission.vehicle import Vehicle
from .connections import PACKS, PARTS
from .scene import Part, Scene
from .scene_tables import (
    BEARING_TABLES,
    ENGINE,
    NUMBERS,
    PISTON,
    RESERVED,
    SCALE,
    SHIFT,
    TURNING,
    USELESS,
    driveline_table,
)

COLUMNS = {"times": 0, "points": 1}  # of a profile's points: path -> place in the pair


def lines_of(table: Mapping[str, object], above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the lines of a scene's ``[scatter]``, a path and a law; tables in it are paths too."""
    for key, given in table.items():
        if isinstance(given, Mapping) and not {*LAWS, "source"} & set(given):
            yield from lines_of(given, f"{above}{key}.")
        else:
            yield f"{above}{key}", given


def of_parts(parts: Mapping[str, Part]) -> dict[str, Any]:
    """Return what scatters by the parts' own files and presets, by path."""
    found: dict[str, Any] = {}
    pairs = []
    for name, part in parts.items():
        found |= {f"{name}.{k}": x for k, x in part.scatter.items() if k != CORRELATION}
        pairs += [
            [f"{name}.{a}", f"{name}.{b}", x] for a, b, x in part.scatter.get(CORRELATION, ())
        ]
    return found | ({CORRELATION: pairs} if pairs else {})


def scene_scatter(scene: Scene, table: Mapping[str, object] | None = None) -> Scatter:
    """Return what scatters in a scene.

    Parameters
    ----------
    scene : its own ``[scatter]``, with that of its parts' files and presets, unless
    table : is given, with the same keys: paths, laws, ``correlation``

    Raises
    ------
    ParameterError : an unknown path, or a law that does not fit

    Notes
    -----
    Lines about a part or table that this scene lacks are left out, with a warning: its base may
    have had it.
    """
    places = scene_places(scene)
    there = {name.partition(".")[0] for name in places} | {CORRELATION}
    known = {*there, *PARTS, *BEARING_TABLES, "shift", "engine", "vehicle", "pressure"}
    lines = dict(scene.scatter if table is None else lines_of(table))
    gone = [name for name in lines if name.partition(".")[0] in known - there]
    kept = {name: law for name, law in lines.items() if name not in gone}
    if gone and CORRELATION in kept:
        kept[CORRELATION] = [p for p in kept[CORRELATION] if not {*p[:2]} & {*gone}]
    found = read_scatter(f"scene {scene.name!r} [scatter]", kept, places)
    words = [f"scatter of {name}: there is no such part or table in this scene" for name in gone]
    return replace(found, warnings=(*found.warnings, *words))


def scene_places(scene: Scene) -> dict[str, Quantity]:
    """Return what can scatter in a scene, by path: numbers [SI] and choices of its models."""
    given = dict(scene.table)
    found = [_place("oil_temperature", scene.oil_temperature, NUMBERS["oil_temperature"])]
    if "shift" in given:
        found += [
            _place(f"shift.{k}", getattr(scene, f"shift_{k}"), rule) for k, rule in SHIFT.items()
        ]
    found += _of_vehicle(scene)
    found += _of_oil(given.get("oil", {}))
    if "engine" in given:
        found += _of_profile("engine", "torque_scale", "engine_torque", given["engine"])
    for pack in PACKS:
        if pack in (own := given.get("pressure", {})):
            found += _of_profile(f"pressure.{pack}", "scale", f"{pack}_pressure", own[pack])
    for name, part in scene.parts.items():
        own = _of_part(part, given.get(name, {}))
        if name == "transmission":
            moved = _moved(given)
            found += [replace(own[k], name=path) for path, k in moved.items()]
            hidden = {*moved.values(), *_hidden(scene)}
            own = {k: p for k, p in own.items() if k not in hidden}
        found += [replace(p, name=f"{name}.{k}") for k, p in own.items()]
    return {p.name: p for p in found}


def _place(name: str, nominal: float, rule: tuple[str, float, float]) -> Quantity:
    return Quantity(name=name, nominal=nominal, unit=rule[0], low=rule[1], high=rule[2])


def _of_part(part: Part, table: Mapping[str, object]) -> dict[str, Quantity]:
    """Return the parameters of a part that a scene may give, by their own names.

    Those of an earlier form are among them where the part's ``table`` is of that form.
    """
    own = {f.name: getattr(part.params, f.name) for f in fields(part.params)}
    file = PartFile(spec=part.spec, name=part.spec.name, parameters=own, fidelity=part.fidelity)
    earlier = {*earlier_of(part.spec.params)}
    known = {*own, *(earlier if earlier & {*table} else ())} - {*RESERVED}
    return {k: p for k, p in file.places().items() if k in known}


def _of_vehicle(scene: Scene) -> list[Quantity]:
    if scene.vehicle is None:
        return []
    rules = {f.name: f.metadata for f in fields(Vehicle)}
    return [
        _place(f"vehicle.{k}", getattr(scene.vehicle, k), (m["unit"], m["min"], m["max"]))
        for k, m in rules.items()
    ]


def _of_oil(table: Mapping[str, object]) -> list[Quantity]:
    """Return the factor of the viscosity, and the numbers that a scene's oil is given by."""
    rules = {k: (unit, low, high) for k, (unit, low, high, _) in OIL.items() if k in table}
    rules |= {k: rule for k, rule in SHEET.items() if k in table}
    rules["viscosity_scale"] = SCALE
    return [
        _place(f"oil.{k}", quantity("[oil]", k, table.get(k, 1.0), rule[0]), rule)
        for k, rule in rules.items()
    ]


def _of_profile(path: str, factor: str, profile: str, table: Mapping[str, Any]) -> list[Quantity]:
    """Return the factor of a profile, and times and values of its points."""
    found = [_place(f"{path}.{factor}", float(table.get(factor, 1.0)), SCALE)]
    rules = "s", -1e9, 1e9
    for i, pair in enumerate(table["points"]):
        for column, place in COLUMNS.items():
            rule = PROFILES[profile][:3] if place else rules
            value = quantity(path, column, pair[place], rule[0])
            found.append(_place(f"{path}.{column}.{i}", value, rule))
    return found


def _moved(table: Mapping[str, Any]) -> dict[str, str]:
    """Return the paths of numbers that make parameters of the transmission: path -> its name."""
    found = {f"engine.{k}": name for k, name in ENGINE.items()} if "engine" in table else {}
    for pack in table.get("pressure", {}):
        keys = PISTON | (TURNING if pack == "clutch" else {})
        found |= {f"pressure.{pack}.{k}": name.format(pack) for k, name in keys.items()}
    for name in BEARING_TABLES:
        if name in table:
            found |= {f"{name}.{k}": f"{name}_{k}" for k in ("coefficient", "mean_radius")}
    return found


def _hidden(scene: Scene) -> Iterator[str]:
    """Yield parameters of the transmission that other tables set, or that mean nothing there."""
    given = dict(scene.table)
    yield from {*driveline_table("", given, scene.vehicle)} - {*given["transmission"]}
    yield from (name for name, (table, _) in USELESS.items() if table in given)
    for profile in PROFILES:
        yield from profile_fields(profile, [(0.0, 0.0)] * POINTS)
