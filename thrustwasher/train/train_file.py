"""A scene ``[train]``: shafts and meshes by name, made into the table of a part file.

    title = "My reducer"

    [train]
    oil_volume = "1.2 l"

    [train.shafts.rotor]
    bearings = [{ position = "0 mm", ... }, { position = "90 mm", ... }]

    [[train.shafts.rotor.forces]]
    position = "120 mm"
    radial = "800 N"

    [train.meshes.first]
    pinion = "rotor"
    gear = "middle"
    position = "30 mm"
    pinion_teeth = 25

A mesh has the parameters of a pair, from a ``preset`` or a ``part`` of the gear mesh or one by one.
The shafts are a chain: the input is the first of them or that which ``input`` names.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from ..errors import ParameterError, within
from ..gearmesh.parameters import SPEC as PAIR_SPEC
from ..model.part_file import (
    PartFile,
    flat_name,
    load_part,
    preset_file,
    preset_part,
    preset_parts,
    read_parameters,
    usual_name,
)
from ..model.toml_tables import nothing_else, read_file, unknown
from .kernels import layout as L
from .parameters import PAIR, SPEC, TrainParams

OWN_OF_PAIR = tuple(PAIR[k] for k in L.OWN)
PLACES = ("position", "pinion_position", "gear_position", "angle", "hand")
OF_MESH = (*PLACES, "pinion_immersion", "gear_immersion")
TRAIN = ("name", "input", "shafts", "meshes")
GLOBAL = tuple(
    f.name for f in fields(TrainParams) if not f.name.startswith(("mesh_", "shaft_", "meshes"))
)
LINKS = ("pinion", "gear", "preset", "part")
SHAFT = ("axial", "arrangement", "seals", "seal_diameter", "bearings", "forces")
SHORT = {"X": "x_factor", "Y": "y_factor", "e": "e_factor", "C": "capacity"}
SHORT |= {"C0": "static_capacity"}
SHORT |= {"f0": "viscous_factor", "f1": "load_factor"}
_KEYS = ("viscous_factor", "load_factor", "x_factor", "y_factor", "section")
USUAL = {  # of catalogues and handbooks, where a bearing does not say otherwise; estimates
    "ball": dict(zip(_KEYS, (2.0, 4e-4, 0.56, 1.6, 0.6), strict=True)),
    "angular": dict(zip(_KEYS, (3.0, 1e-3, 0.35, 0.57, 0.6), strict=True)),
    "cylindrical": dict(zip(_KEYS, (3.0, 3e-4, 1.0, 0.0, 0.6), strict=True)),
    "taper": dict(zip(_KEYS, (4.0, 4e-4, 0.4, 1.6, 0.6), strict=True)),
}
USUAL_PLACE = {"angle": 0.0, "hand": "right", "pinion_immersion": 0.0, "gear_immersion": 0.0}
INDUCING, ARRANGEMENTS = ("taper", "angular"), ("O", "X")


def _below(start: str) -> tuple[str, ...]:
    names = [f.name for f in fields(TrainParams) if f.name.startswith(start)]
    return tuple(name.removeprefix(start) for name in names)


BEARING, FORCE = _below("shaft_1_bearing_1_"), _below("shaft_1_force_1_")
TEXTS = ("title", "description", "notes", "oil", "box", "scatter", "fidelity")


@dataclass(frozen=True)
class TrainScene:
    """A train with the names that its file has for shafts and meshes, from input to output."""

    title: str
    part: PartFile
    shafts: tuple[str, ...]
    meshes: tuple[str, ...]


def train_of(part: PartFile) -> TrainScene:
    """Return the scene of a part of a gear train."""
    count = int(part.params.meshes)
    named = {flat: own.removesuffix(".") for own, flat in part.names.items()}
    shafts, meshes = (
        tuple(named.get(f"{kind}_{i + 1}_", f"{kind} {i + 1}") for i in range(n))
        for kind, n in (("shaft", count + 1), ("mesh", count))
    )
    return TrainScene(part.description or part.name, part, shafts, meshes)


def is_train(name: str) -> bool:
    """Return whether a word names a train: a preset, or a file of a scene or part."""
    if not name.endswith(".toml"):
        return name in preset_parts(SPEC)
    table = read_file("scene", name)
    return SPEC.key in table or table.get("model") == SPEC.key


def load_train(path: str | Path, oil: Any = None) -> TrainScene:
    """Return the scene of a file, or of a part file or preset of the gear train.

    ParameterError if it cannot be read, or something in it is not allowed.
    """
    where = f"train {str(path)!r}"
    found: tuple[Iterable[str], Iterable[str]] | None = None
    title = ""
    file: Any = path if str(path).endswith(".toml") else preset_file(SPEC, str(path))
    table, part = read_file("train", file), load_part(file)
    if SPEC.key in table:
        title, found = str(table.get("title", "")), _chain(where, table[SPEC.key])
    if part.spec.key != SPEC.key:
        raise ParameterError(f"{where}: is a part of {part.spec.name}, allowed: {SPEC.name}")
    part = part if oil is None else part.with_oil(oil)
    count = int(part.params.meshes)
    plain = ([f"shaft {i + 1}" for i in range(count + 1)], [f"mesh {i + 1}" for i in range(count)])
    shafts, meshes = found or plain
    return TrainScene(title or part.description or part.name, part, tuple(shafts), tuple(meshes))


def flat_part(where: str, table: dict[str, Any], folder: Path | None = None) -> dict[str, Any]:
    """Return the table of a part file for a scene; ``folder`` of the part files it names.

    ``names`` in it: how names of shafts and meshes begin, and how those of the model.
    """
    nothing_else(where, table, ("train", *TEXTS))
    train = table["train"]
    if not isinstance(train, dict):
        raise ParameterError(f"{where}: train = {train!r}, allowed: a table [train]")
    at = f"{where} [train]"
    nothing_else(at, train, (*TRAIN, *GLOBAL))
    shafts, meshes = _chain(where, train)
    values: dict[str, Any] = {name: train[name] for name in GLOBAL if name in train}
    values["meshes"] = len(meshes)
    for i, name in enumerate(shafts, 1):
        values |= _shaft(f"{at[:-1]}.shafts.{name}]", f"shaft_{i}_", train["shafts"][name])
    for i, name in enumerate(meshes, 1):
        place = f"{at[:-1]}.meshes.{name}]"
        values |= _mesh(place, f"mesh_{i}_", train["meshes"][name], folder)
        upstream = train["meshes"][name]["pinion"] == shafts[i - 1]
        values[f"mesh_{i}_driver"] = "pinion" if upstream else "gear"
    named = {
        f"{name}.{end}.": f"shaft_{i}_bearing_{k}_"
        for i, name in enumerate(shafts, 1)
        if isinstance(ends := train["shafts"][name].get("bearings"), dict)
        for k, end in enumerate(ends, 1)
    }
    named |= {f"{name}.": f"shaft_{i}_" for i, name in enumerate(shafts, 1)}
    named |= {f"{name}.": f"mesh_{i}_" for i, name in enumerate(meshes, 1)}
    found = {key: table[key] for key in TEXTS if key in table and key != "title"}
    for key in ("box", "scatter"):
        if isinstance(found.get(key), dict):
            found[key] = {flat_name(SPEC, named, n): law for n, law in found[key].items()}
    title = {"description": table["title"]} if "title" in table else {}
    own = {"model": SPEC.key, "name": train.get("name", usual_name(SPEC)), "parameters": values}
    own["names"] = named
    return {**title, **found, **own}


def _tables(where: str, train: Mapping[str, Any], key: str, most: int) -> dict[str, Any]:
    found = train.get(key)
    if not isinstance(found, dict) or not all(isinstance(x, dict) for x in found.values()):
        raise ParameterError(f"{where} [train]: tables [train.{key}.NAME] are required")
    if len(found) > most:
        raise ParameterError(f"{where} [train]: {len(found)} {key}, allowed: {most} at most")
    return found


def _chain(where: str, train: Mapping[str, Any]) -> tuple[list[str], list[str]]:
    """Return the names of shafts and meshes from input to output; refuse what is no chain."""
    shafts = _tables(where, train, "shafts", L.SHAFTS)
    meshes = _tables(where, train, "meshes", L.MESHES)
    ends = {}
    if both := [*shafts.keys() & meshes.keys()]:
        raise ParameterError(f"{where} [train]: {both[0]!r} is a shaft and a mesh, allowed: one")
    for name, mesh in meshes.items():
        at = f"{where} [train.meshes.{name}]"
        for side in ("pinion", "gear"):
            if mesh.get(side) not in shafts:
                raise ParameterError(
                    f"{at}: {side} = {mesh.get(side)!r}, allowed: {' or '.join(map(repr, shafts))}"
                )
        if mesh["pinion"] == mesh["gear"]:
            raise ParameterError(f"{at}: pinion and gear are on the same shaft")
        ends[name] = {mesh["pinion"], mesh["gear"]}
    start = train.get("input", next(iter(shafts)))
    if start not in shafts:
        raise unknown(f"{where} [train] input", str(start), shafts)
    along, order = [start], list[str]()
    while found := [n for n, both in ends.items() if along[-1] in both and n not in order]:
        if len(found) > 1 or (other := next(iter(ends[found[0]] - {along[-1]}))) in along:
            raise ParameterError(
                f"{where} [train]: meshes {', '.join(found)} at shaft {along[-1]!r}, allowed: a "
                "chain of meshes, without branches, from the input to the output"
            )
        along.append(other)
        order.append(found[0])
    if left := [n for n in (*shafts, *meshes) if n not in (*along, *order)]:
        raise ParameterError(
            f"{where} [train]: {', '.join(left)}: no power from the input {start!r} gets there"
        )
    return along, order


def _shaft(where: str, start: str, given: Mapping[str, Any]) -> dict[str, Any]:
    nothing_else(where, given, SHAFT)
    bearings = given.get("bearings")
    ends = [f"bearing {k}" for k in range(1, L.ENDS + 1)]
    if isinstance(bearings, dict):  # each by a name of its own
        ends, bearings = [*bearings], [*bearings.values()]
    if not isinstance(bearings, list) or len(bearings) != L.ENDS:
        raise ParameterError(f"{where}: bearings = {bearings!r}, allowed: exactly two tables")
    own: dict[str, Any] = {"axial": given.get("arrangement", given.get("axial", "first"))}
    own |= {"seals": int("seal_diameter" in given), "seal_diameter": 0.0}
    own |= {key: given[key] for key in ("seals", "seal_diameter") if key in given}
    found = {start + key: value for key, value in own.items()}
    for k, bearing in enumerate(bearings, 1):
        at = f"{where} {ends[k - 1]}"
        if not isinstance(bearing, dict):
            raise ParameterError(f"{at}: {bearing!r}, allowed: a table")
        found |= {f"{start}bearing_{k}_{n}": value for n, value in _bearing(at, bearing).items()}
    if {"axial", "arrangement"} <= given.keys():
        raise ParameterError(f"{where}: axial and arrangement, allowed: one of the two")
    if given.get("arrangement", "O") not in ARRANGEMENTS:
        raise ParameterError(
            f"{where}: arrangement = {given['arrangement']!r}, allowed: 'O' or 'X'"
        )
    types = [t for b in bearings if (t := b["type"]) in INDUCING and not _is_plain(b)]
    if types and own["axial"] not in ARRANGEMENTS:
        raise ParameterError(
            f"{where}: 'arrangement' is missing, allowed: 'O' (back to back) or 'X' (face to face, "
            f"as axial = 'pushed'), as {' and '.join(types)} bearings induce axial forces in each "
            "other; or induced_factor = 0 of those that induce none"
        )
    return found | _forces(where, start, given.get("forces", []))


def _is_plain(bearing: Mapping[str, Any]) -> bool:
    """Return whether a bearing is given as one that induces no axial force."""
    return str(bearing.get("induced_factor")) in ("0", "0.0")


def _forces(where: str, start: str, forces: Any) -> dict[str, Any]:
    if not isinstance(forces, list) or len(forces) > L.PUSHES:
        raise ParameterError(f"{where}: forces = {forces!r}, allowed: {L.PUSHES} tables at most")
    found: dict[str, Any] = {}
    for number, force in enumerate(forces, 1):
        at = f"{where} force {number}"
        if not isinstance(force, dict):
            raise ParameterError(f"{at}: {force!r}, allowed: a table")
        nothing_else(at, force, FORCE)
        if "radial" in force and "position" not in force:
            raise ParameterError(f"{at}: radial without 'position', where it acts along the shaft")
        for key, size in (("direction", "radial"), ("moment_direction", "moment")):
            if size in force and key not in force:
                raise ParameterError(f"{at}: {size} without {key!r}, an angle from y to z")
        own = force if "radial" in force else {k: v for k, v in force.items() if k != "position"}
        found |= {f"{start}force_{number}_{key}": value for key, value in own.items()}
    return found


def _bearing(at: str, given: Mapping[str, Any]) -> dict[str, Any]:
    own = {SHORT.get(key, key): value for key, value in given.items()}
    nothing_else(at, own, BEARING)
    for key in ("type", "position", "diameter", "capacity"):
        if key not in own:
            raise ParameterError(f"{at}: {key!r} is missing")
    return {**USUAL.get(str(own["type"]), USUAL["ball"]), **own}


def _mesh(where: str, start: str, given: Mapping[str, Any], folder: Path | None) -> dict[str, Any]:
    nothing_else(where, given, (*LINKS, *OF_MESH, *OWN_OF_PAIR))
    named = {key: value for key, value in given.items() if key in OF_MESH and key != "position"}
    own = {**USUAL_PLACE, **named}
    if "position" in given:
        own = {f"{side}_position": given["position"] for side in ("pinion", "gear")} | own
    for side in ("pinion", "gear"):
        if f"{side}_position" not in own:
            raise ParameterError(f"{where}: 'position' or '{side}_position' is missing")
    found = _pair(where, given, folder)
    return {start + key: value for key, value in (found | own).items()}


def _pair(where: str, given: Mapping[str, Any], folder: Path | None) -> dict[str, Any]:
    """Return the parameters of a mesh's pair: those given over those of its preset or part."""
    defaults = {f.name: f.default for f in fields(PAIR_SPEC.params) if f.name in OWN_OF_PAIR}
    if "preset" in given and "part" in given:
        raise ParameterError(f"{where}: preset and part, allowed: one of the two")
    with within(where):
        if "preset" in given:
            defaults |= _own(preset_part(PAIR_SPEC, str(given["preset"])))
        elif "part" in given:
            defaults |= _own(load_part((folder or Path()) / str(given["part"])))
    own = {key: value for key, value in given.items() if key in OWN_OF_PAIR}
    return defaults | read_parameters(where, PAIR_SPEC, own)


def _own(part: PartFile) -> dict[str, Any]:
    if part.spec.key != PAIR_SPEC.key:
        raise ParameterError(f"a part of {part.spec.name}, allowed: one of {PAIR_SPEC.name}")
    if part.parameters.get("internal"):
        raise ParameterError(f"part {part.name!r} is a ring: internal = true, allowed: false")
    return {key: value for key, value in part.parameters.items() if key in OWN_OF_PAIR}
