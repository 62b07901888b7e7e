"""A train as the text of its file: nested, with the file's names of shafts, bearings and meshes.

What is at its default, or as usual for a type of bearing, is left out.
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any

from ..gearmesh.parameters import GearMeshParams
from ..model.part_file import PartFile
from ..units import exact_quantity
from .kernels import layout as L
from .parameters import TrainParams
from .train_file import ARRANGEMENTS, BEARING, FORCE, GLOBAL, OF_MESH, OWN_OF_PAIR, SHORT, USUAL

NO_FORCE = dict.fromkeys(FORCE, 0.0)
PLAIN = re.compile(r"[A-Za-z0-9_-]+")
ALWAYS = ("type", "position", "diameter", "section", "capacity")  # of a bearing


def train_lines(part: PartFile) -> Iterator[str]:
    """Yield the lines of a train's file from its oil to its meshes; read back it is the same."""
    p, meshes = part.params, int(part.params.meshes)
    named = {flat: own.removesuffix(".") for own, flat in part.names.items()}
    shafts = [named[f"shaft_{i}_"] for i in range(1, meshes + 2)]
    yield f"title = {json.dumps(part.description or part.name, ensure_ascii=False)}"
    if part.notes:
        yield f"notes = {json.dumps(part.notes, ensure_ascii=False)}"
    yield f"fidelity = {json.dumps(part.fidelity)}"
    set_by_oil = {}
    if part.oil and part.oil.is_in(part.spec, p):  # or it is not this oil any more
        set_by_oil = part.oil.parameters_for(part.spec)
        yield f"oil = {part.oil.as_toml()}  # sets {', '.join(set_by_oil)}"
    yield from (
        "",
        "[train]",
        f"name = {json.dumps(part.name)}",
        f"input = {json.dumps(shafts[0])}",
    )
    plain = TrainParams()
    names = [n for n in GLOBAL if n not in set_by_oil and getattr(p, n) != getattr(plain, n)]
    yield from (_line(n, n, getattr(p, n)) for n in names)
    for i, shaft in enumerate(shafts, 1):
        ends = [named.get(f"shaft_{i}_bearing_{k}_", "") for k in range(1, L.ENDS + 1)]
        yield from _shaft(p, i, shaft, [e.removeprefix(f"{shaft}.") for e in ends])
    for i in range(1, meshes + 1):
        yield from _mesh(p, i, named[f"mesh_{i}_"], shafts)


def _line(key: str, name: str, value: Any) -> str:
    """Return a key with its value; ``name``: of the parameter whose unit it has."""
    return f"{key} = {_value(name, value)}"


def _value(name: str, value: Any) -> str:
    meta = TrainParams.__dataclass_fields__[name].metadata
    if meta["kind"] == "real":
        value = exact_quantity(value, meta["unit"], difference=bool(meta.get("relative")))
    return json.dumps(value)


def _key(name: str) -> str:
    return name if PLAIN.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def _inline(start: str, values: Mapping[str, Any]) -> str:
    short = {long: key for key, long in SHORT.items()}
    found = (f"{short.get(n, n)} = {_value(start + n, x)}" for n, x in values.items())
    return "{ " + ", ".join(found) + " }"


def _shaft(p: Any, i: int, shaft: str, ends: list[str]) -> Iterator[str]:
    start = f"shaft_{i}_"
    yield from ("", f"[train.shafts.{_key(shaft)}]")
    axial = getattr(p, f"{start}axial")
    yield f"{'arrangement' if axial in ARRANGEMENTS else 'axial'} = {json.dumps(axial)}"
    if seals := getattr(p, f"{start}seals"):
        yield f"seals = {seals}"
    if getattr(p, f"{start}seal_diameter"):
        name = f"{start}seal_diameter"
        yield _line("seal_diameter", name, getattr(p, name))
    bearings = [_bearing(p, f"{start}bearing_{k}_") for k in range(1, L.ENDS + 1)]
    if all(ends):
        yield from (f"bearings.{_key(n)} = {b}" for n, b in zip(ends, bearings, strict=True))
    else:
        yield from ("bearings = [", *(f"  {b}," for b in bearings), "]")
    for k in range(1, L.PUSHES + 1):
        yield from _force(p, f"{start}force_{k}_", shaft)


def _bearing(p: Any, start: str) -> str:
    own = {name: getattr(p, start + name) for name in BEARING}
    plain = {n: TrainParams.__dataclass_fields__[start + n].default for n in BEARING}
    usual = {**plain, **USUAL.get(own["type"], USUAL["ball"])}
    kept = {n: x for n, x in own.items() if n in ALWAYS or x != usual[n]}
    return _inline(start, kept)


def _force(p: Any, start: str, shaft: str) -> Iterator[str]:
    own = {name: getattr(p, start + name) for name in FORCE}
    if own == NO_FORCE:
        return
    sizes = {"radial": ("position", "radial", "direction"), "axial": ("axial",)}
    sizes["moment"] = ("moment", "moment_direction")
    yield from ("", f"[[train.shafts.{_key(shaft)}.forces]]")
    for size, names in sizes.items():
        if own[size]:
            yield from (_line(n, start + n, own[n]) for n in names)


def _mesh(p: Any, i: int, mesh: str, shafts: list[str]) -> Iterator[str]:
    start, before, behind = f"mesh_{i}_", shafts[i - 1], shafts[i]
    if getattr(p, f"{start}driver") == "gear":
        before, behind = behind, before
    yield from ("", f"[train.meshes.{_key(mesh)}]")
    yield from (f"pinion = {json.dumps(before)}", f"gear = {json.dumps(behind)}")
    places = {n: getattr(p, start + n) for n in OF_MESH if n != "position"}
    if places["pinion_position"] == places["gear_position"]:
        yield _line("position", f"{start}pinion_position", places["pinion_position"])
        del places["pinion_position"], places["gear_position"]
    for n in ("pinion_immersion", "gear_immersion"):
        places = {k: x for k, x in places.items() if k != n or x}
    yield from (_line(n, start + n, x) for n, x in places.items())
    defaults = {f.name: f.default for f in fields(GearMeshParams)}
    for n in OWN_OF_PAIR:
        if (x := getattr(p, start + n)) != defaults[n]:
            yield _line(n, start + n, x)
