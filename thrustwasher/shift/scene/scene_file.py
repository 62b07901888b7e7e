"""Scene files: TOML -> ``Scene``, checked before anything runs.

A number may carry its unit, "24 degC" or "3000 rpm"; a bare number is SI. A scene with a ``base``
takes everything from that scene and changes what it names.

Next to a built-in scene stand the bands of its figures, from a study made beforehand: a nominal run
takes seconds and says nothing of its luck, a study takes minutes.
"""

import os
from collections.abc import Mapping
from dataclasses import fields, replace
from functools import lru_cache
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, NamedTuple

from ...errors import ParameterError, suggestion, within
from ...model.oil import (
    SHEET,
    VISCOSITY,
    Oil,
    law_of,
    oil_table,
    read_oil,
    too_stiff,
    viscosity_of,
)
from ...model.oil_laws import ZERO
from ...model.parameters import earlier_of, other_names_of, plainly_named
from ...model.part_file import PartFile, load_part, preset_part, scene_of_part, scene_parts
from ...model.registry import MODELS as ALL_MODELS
from ...model.registry import find_model
from ...model.scatter import CORRELATION
from ...model.spec import ModelSpec
from ...model.toml_tables import (
    nothing_else,
    number,
    parse,
    quantity,
    read_file,
    read_value,
    table_beside,
)
from ..key_figures.figure_list import FIGURES
from ..masters.master import FIXED_STEPS
from .connections import MESHES, PARTS, REQUIRED
from .doubts import doubts
from .places import lines_of, of_parts, scene_scatter
from .profile_file import beside, profile_notes, with_profiles, without_old
from .scene import Part, Published, Scene, shift_of_pressures
from .scene_tables import (
    BEARING_TABLES,
    NUMBERS,
    RESERVED,
    SHIFT,
    driveline_table,
    factor_of,
    vehicle_of,
)
from .sequence import checked_sequence, read_sequence

LEVELS = (0.05, 0.5, 0.95)  # of the bands in known_bands.toml
NO_MATTER = ("fidelity", "torque_age")  # parameters of how a run goes
TEXTS = ("title", "description", "base", "master", "fidelity")
REVERSED = 0.7  # share of the limit for teeth that bend both ways, as those of a planet
ONE_OIL = 1.2  # ratio of viscosities up to which parts count as having one oil
LEAST_TEETH = 5  # of sun and planet: fewer make no gear
ROLE = ("starts_pressed",)  # what a scene, not a part file, says of a part
TABLES = (
    "shift",
    "sequence",
    "published",
    "oil",
    "engine",
    "vehicle",
    "pressure",
    "scatter",
    *BEARING_TABLES,
    *PARTS,
)

MOST_MADE = 64  # parts that are kept
_MADE: dict[str, tuple[Part, list[str]]] = {}


RAMP = 'a file with base = "planetary-sun" and [shift] duration = "{}" is that scene'
GONE = {"planetary-fast": RAMP.format("0.1 s"), "planetary-slow": RAMP.format("0.5 s")}
INSTEAD = {"clutch": "; gear pairs without a clutch are a [train]"}  # of what is missing


def builtin_scenes() -> list[str]:
    """Return the names of the scenes that come with the package."""
    return sorted(f.name[:-5] for f in _folder().iterdir() if f.name.endswith(".toml"))


def _folder() -> Traversable:
    """Return where the built-in scenes lie: next to this package's folder."""
    return resources.files(__package__.rpartition(".")[0]) / "scenes"


def load_scene(name_or_path: str | Path, oil: str | Mapping[str, object] | None = None) -> Scene:
    """Return a built-in scene by name, or the scene of a TOML file; with another ``oil``."""
    name = str(name_or_path)
    table = merged_tables(name, {} if oil is None else {"oil": oil_table("oil", oil)})
    if oil is not None:
        table.pop("published", None)  # figures of the scene's own oil
    scene = scene_of(name, table)
    if scene.scatter:
        scene_scatter(scene)
    return scene


def merged_tables(name: str, top: Mapping[str, object] | None = None) -> dict[str, Any]:
    """Return the merged tables of a scene and its bases; ``top`` replaces what they say."""
    seen: list[str] = []
    merged = dict(top or {})
    while name or not seen:
        own = os.path.realpath(name) if name.endswith(".toml") else name
        if own in seen:
            raise ParameterError(f"scene {name!r}: its bases go round in a circle")
        seen.append(own)
        table = _parse(name)
        base = table.pop("base", "")
        if not isinstance(base, str):
            raise ParameterError(f"scene {name!r}: base = {base!r}, allowed: a scene's name")
        merged = _overlay(without_old(_without_parts(table, merged), merged), merged)
        if base.endswith(".toml") and name.endswith(".toml"):
            base = str(Path(name).parent / base)
        name = base
    if merged.get("losses") is False:  # as said in a scene whose base has them
        del merged["losses"]
    return with_profiles(f"scene {seen[0]!r}", merged)


def _refuse_other(name: str, key: object) -> None:
    """Refuse a file of a model that has scenes of its own, without a shift."""
    known = isinstance(key, str) and key in ALL_MODELS
    if known and (what := find_model(str(key)).scene_of):
        raise ParameterError(
            f"scene = {name!r}: is {what}, without a shift: `thrustwasher efficiency {name}` runs "
            "it; explore, sweep, scatter, optimise take it too"
        )


def _parse(name: str) -> dict[str, Any]:
    if found := scene_parts().get(name):
        _refuse_other(name, found.spec.key)
    if name.endswith(".toml"):
        table = read_file("scene", name)
        _refuse_other(name, scene_of_part(table) or table.get("model"))
        if isinstance(kind := table.get("model"), str):
            place = next((key for key, spec in PARTS.items() if spec.key == kind), kind)
            raise ParameterError(
                f"scene = {name!r}: is a part ({kind}), allowed: a scene; one takes the part by "
                f"[{place}] part = {Path(name).name!r}"
            )
    elif name in builtin_scenes():
        table = parse(f"scene = {name!r}", (_folder() / f"{name}.toml").read_text("utf-8"))
    else:
        if gone := GONE.get(name):
            raise ParameterError(f"scene = {name!r} is gone: {gone}")
        known = builtin_scenes()
        hint = suggestion(name, known, "; did you mean {!r}?")
        raise ParameterError(
            f"scene = {name!r}, allowed: {', '.join(known)} or the path of a .toml file{hint}"
        )
    if name.endswith(".toml"):
        beside(table, Path(name).parent)
    if "master_tolerance" in table:
        raise ParameterError(f"scene {name!r}: master_tolerance: {FIXED_STEPS}")
    if isinstance(table.get("oil"), str):
        table["oil"] = oil_table("oil", table["oil"])
    if isinstance(table.get("scatter"), dict):
        lines = list(lines_of(table["scatter"]))
        table["scatter"] = dict(lines)
        if twice := [path for path, _ in lines if [n for n, _ in lines].count(path) > 1]:
            raise ParameterError(
                f"scene {name!r} [scatter]: {twice[0]} is there twice, allowed: once"
            )
    for part, spec in PARTS.items():
        if isinstance(table.get(part), dict):
            with within(f"scene {name!r} [{part}]"):
                own = plainly_named(other_names_of(spec.params), table[part])
                table[part] = own
            if isinstance(own.get("part"), str) and name.endswith(".toml"):
                own["part"] = str(Path(name).parent / own["part"])  # lies next to the scene
    return table


def _without_parts(base: dict[str, Any], top: dict[str, Any]) -> dict[str, Any]:
    """Return the tables of a base without what a part's file or another viscosity replaces."""
    result = dict(base)
    for key, below in base.items():
        new = top.get(key)
        if key == "oil" and isinstance(new, dict) and isinstance(below, dict):
            gone = set(VISCOSITY) if set(new) & set(VISCOSITY) else set()
            gone |= {"density"} if set(new) & {"name", *SHEET} else set()  # they give one
            result[key] = {k: x for k, x in below.items() if k not in gone}
        if key in PARTS and isinstance(below, dict) and isinstance(new, dict):
            if "part" in new:
                result[key] = {k: x for k, x in below.items() if k in ROLE}
            elif "preset" in new:
                result[key] = {k: x for k, x in below.items() if k != "part"}
    return result


def _overlay(base: dict[str, Any], top: dict[str, Any]) -> dict[str, Any]:
    result = dict(base)
    for key, value in top.items():
        both = isinstance(value, dict) and isinstance(result.get(key), dict)
        both = both and key != "published"  # figures of one source stay together
        if both and key == "scatter":
            result[key] = result[key] | value  # a law is given whole
        else:
            result[key] = _overlay(result[key], value) if both else value
    return result


def scene_of(source: str, table: dict[str, Any], *, warned: bool = True) -> Scene:
    """Return the scene of merged tables; ``source``: its name, or the path of its file.

    ``warned``: with the warnings of what is doubtful in it; one that is only a draw needs none.
    """
    own = source.endswith(".toml")
    name = Path(source).stem if own else source
    where = f"scene {name!r}"
    nothing_else(where, table, [*TEXTS, *NUMBERS, *TABLES])
    for key, value in table.items():
        if key in TEXTS and not isinstance(value, str):
            raise ParameterError(f"{where}: {key} = {value!r}, allowed: a text")
        if key in TABLES and not isinstance(value, dict):
            more = " or false" if key == "losses" else ""
            raise ParameterError(f"{where}: {key} = {value!r}, allowed: a table [{key}]{more}")
    moves = "pressure" if "pressure" in table else "shift"
    if moves == "pressure" and "shift" in table:
        raise ParameterError(
            f"{where}: [shift] together with [pressure], allowed: a ramp or profiles"
        )
    for key in (*REQUIRED, moves, "stop_time"):
        if key not in table:
            raise ParameterError(f"{where}: {key!r} is missing{INSTEAD.get(key, '')}")
    numbers: dict[str, Any] = {"start_time": 0.0, "step": 1e-3, "oil_temperature": 297.15}
    numbers |= {k: number(where, k, table[k], NUMBERS[k]) for k in NUMBERS if k in table}
    vehicle = vehicle_of(f"{where} [vehicle]", table.get("vehicle"))
    merged, the_oil = table, dict(table.get("oil", {}))
    profiles = list(profile_notes(merged))
    table = {**table, "transmission": driveline_table(where, table, vehicle)}
    factor = factor_of(f"{where} [oil]", "viscosity_scale", the_oil)
    given = read_oil(f"{where} [oil]", the_oil)
    parts, notes = _parts(where, table, given or Oil(), numbers["oil_temperature"], factor)
    notes += _without_what_is_not_there(f"{where} [transmission]", parts)
    if "washer" in parts and "mesh" not in parts:
        if parts["washer"].params.gear_far_face == "bulk":
            raise ParameterError(
                f"{where} [washer]: gear_far_face = 'bulk', allowed: with [mesh], whose bulk "
                "temperature it takes"
            )
    scene = Scene(
        name=name,
        title=table.get("title", name),
        description=table.get("description", "").strip(),
        master=table.get("master", "gauss-seidel"),
        parts=parts,
        vehicle=vehicle,
        sequence=None,
        notes=(*notes, *(text for text, is_far in profiles if not is_far)),
        source=source,
        table=merged,
        scatter={**of_parts(parts), **merged.get("scatter", {})},
        warnings=(
            *_oil_warnings(given, parts, numbers["oil_temperature"], own),
            *(text for text, is_far in profiles if is_far),
        ),
        published=_published(f"{where} [published]", table.get("published")),
        **(
            _shift(f"{where} [shift]", table["shift"])
            if moves == "shift"
            else shift_of_pressures(parts["transmission"].params)
        ),
        **numbers,
    )
    if "sequence" in table:
        where = f"{where} [sequence]"
        scene = checked_sequence(where, scene, read_sequence(where, scene, table["sequence"]))
    scene = scene.checked()
    return replace(scene, warnings=(*scene.warnings, *doubts(scene))) if warned else scene


def _parts(
    where: str, table: dict[str, Any], the_oil: Oil, temperature: float, factor: float
) -> tuple[dict[str, Part], list[str]]:
    """Return the parts of a scene, and what is to be known of their oil.

    The viscosity of every part's oil is multiplied by ``factor``.
    """
    parts: dict[str, Part] = {}
    notes = []
    for key in PARTS:
        if key in table:
            given = dict(table[key])
            if "fidelity" in table and len(PARTS[key].fidelities) > 1:
                given.setdefault("fidelity", table["fidelity"])  # the scene's word for all parts
            with within(f"{where} [oil]"):
                common = the_oil.parameters_for(PARTS[key])
            if own := [name for name in common if name in given]:
                notes.append(f"{key}: {', '.join(own)} of its own, not of the scene's oil")
            if key == "sump":
                gearbox = replace(parts["transmission"].params, ring_mesh="ring_mesh" in table)
                given = _sump(f"{where} [sump]", given, gearbox, temperature)
            usual: dict[str, Any] = {}
            if key in MESHES:  # a planet has two mates, its teeth bend both ways
                usual = {"mates_pinion": 2, "mates_gear": parts["transmission"].params.planets}
                usual["reversed_bending"] = REVERSED
            if key == "losses":
                usual = {"planets": parts["transmission"].params.planets}
            part, lost = _part(f"{where} [{key}]", PARTS[key], given, common, usual)
            parts[key] = _with_viscosity(f"{where} [oil]", part, factor)
            if lost:
                notes.append(
                    f"{key}: {', '.join(lost)} of its part or preset give way to "
                    "the scene's oil; named in the scene they stay"
                )
    if the_oil.density_15:
        notes.append(the_oil.words(*_specs(parts)))
    return parts, notes


def _with_viscosity(where: str, part: Part, factor: float) -> Part:
    """Return a part with the viscosity of its oil multiplied by a factor."""
    if factor == 1.0 or not law_of(part.spec):
        return part
    with within(where):
        scale = factor * part.params.viscosity_scale
        return replace(part, params=replace(part.params, viscosity_scale=scale))


def _without_what_is_not_there(where: str, parts: dict[str, Part]) -> list[str]:
    """Refuse gears that are none; drop the washer where there are none, and return that."""
    gearbox = parts["transmission"].params
    for key in ("sun_teeth", "planet_teeth") if gearbox.planet_teeth else ():
        if (z := getattr(gearbox, key)) < LEAST_TEETH:
            raise ParameterError(
                f"{where}: {key} = {z}, allowed: from {LEAST_TEETH} on, or planet_teeth = 0, an "
                "ideal set"
            )
    if "washer" not in parts or gearbox.washers:
        return []
    del parts["washer"]
    return ["[washer] is left out: washers = 0 in [transmission]"]


def _specs(parts: Mapping[str, Part]) -> list[ModelSpec]:
    """Return the models of the parts, each once."""
    return list({part.spec.key: part.spec for part in parts.values()}.values())


def _oil_warnings(
    given: Oil | None, parts: Mapping[str, Part], temperature: float, own: bool
) -> list[str]:
    """Return what is doubtful of the parts' oil; ``own``: the scene is none of the package's."""
    stiff = [text for p in parts.values() for text in too_stiff(p.spec, p.params, temperature)]
    if given and (given.density_15 or given.points):
        return [*given.warnings(_specs(parts), temperature), *dict.fromkeys(stiff)]
    known = {key: viscosity_of(p.spec, p.params, temperature) for key, p in parts.items()}
    found = {key: x for key, x in known.items() if x}
    if not own or not found or max(found.values()) < ONE_OIL * min(found.values()):
        return stiff
    listed = ", ".join(f"{key} {1e3 * x:.3g} mPa.s" for key, x in found.items())
    return [
        f"no viscosity in [oil], so that each part has an oil of its own: {listed} at "
        f'{temperature - ZERO:.4g} degC; give the scene one, as in oil = "Dexron VI"',
        *stiff,
    ]


def _sump(where: str, table: dict[str, Any], gearbox: Any, oil: float) -> dict[str, Any]:
    """Return the sump's table with the oil's temperature and the numbers of parts alike."""
    alike = {"factor_3": gearbox.washers, "factor_4": gearbox.meshes, "factor_5": gearbox.planets}
    if "initial_temperature" in table:
        raise ParameterError(
            f"{where}: initial_temperature cannot be set here; the scene's own oil_temperature "
            "sets it: all parts and the report start from it"
        )
    return {"initial_temperature": oil, **alike, **table}


def _shift(where: str, table: dict[str, Any]) -> dict[str, Any]:
    """Return the ramp of the shift command, as fields of a scene."""
    nothing_else(where, table, SHIFT)
    given = {f"shift_{key}": number(where, key, x, SHIFT[key]) for key, x in table.items()}
    return {"shift_start": 0.0, "shift_duration": 0.0, **given}


def _published(where: str, table: dict[str, Any] | None) -> Published | None:
    """Return what a source says about this scene."""
    if table is None:
        return None
    values = dict(table)
    source = values.pop("source", None)
    if not isinstance(source, str):
        raise ParameterError(f"{where}: source = {source!r}, allowed: a text")
    nothing_else(where, values, ["source", *FIGURES])
    figures = {k: quantity(where, k, v, FIGURES[k].unit) for k, v in values.items()}
    return Published(source=source, figures=figures)


def _part(
    where: str,
    spec: ModelSpec,
    table: dict[str, Any],
    common: dict[str, Any],
    usual: dict[str, Any],
) -> tuple[Part, list[str]]:
    """Return a part, and what its file says of the oil in vain; ``common``: the scene's.

    ``usual`` are the scene's parameters where neither its table nor the part's file has its own.
    What no file decides is made once: most of a scene's parts stay from run to run of a study.
    """
    if "part" in table:
        return _made_part(where, spec, table, common, usual)
    key = repr((where, spec.key, table, common, usual))
    if key not in _MADE:
        if len(_MADE) >= MOST_MADE:
            _MADE.clear()
        _MADE[key] = _made_part(where, spec, table, common, usual)
    return _MADE[key]


def _made_part(
    where: str,
    spec: ModelSpec,
    table: dict[str, Any],
    common: dict[str, Any],
    usual: dict[str, Any],
) -> tuple[Part, list[str]]:
    known = {f.name: f.metadata for f in fields(spec.params)}
    earlier = earlier_of(spec.params)
    given = dict(table)
    with within(where):
        start = _start(spec, given.pop("part", None), given.pop("preset", None))
    values, level = ({}, spec.default_fidelity) if start is None else _values(start)
    own = {k: x for k, x in values.items() if x != getattr(spec.params(), k)}
    lost = [k for k, x in common.items() if k not in given and own.get(k, x) != x]
    values = usual | values | common
    level = given.pop("fidelity", level)
    nothing_else(where, given, ["fidelity", "part", "preset", *known, *earlier])
    known |= earlier
    for key, value in given.items():
        if key in RESERVED:
            raise ParameterError(f"{where}: {key} cannot be set here; {RESERVED[key]}")
        values[key] = read_value(where, key, value, known[key])
    with within(where):
        params = spec.params(**values)
    part = Part(
        spec=spec,
        fidelity=spec.default_fidelity,
        params=params,
        labels=start.about if start and "part" in table else {},
        scatter=_own_scatter(start, {*known} - {*given, *common}) if start else {},
        usual={n: getattr(params, n) for n in {**usual, **common} if n not in given},
    )
    return part.asked_for(where, level), lost


def _start(spec: ModelSpec, file: object, preset: object) -> PartFile | None:
    """Return the part of a file or a preset; None where neither is named."""
    if file is not None and preset is not None:
        raise ParameterError(
            f"preset = {preset!r} together with part = {file!r}, allowed: one of them"
        )
    if file is None and preset is None:
        return None
    own = preset_part(spec, str(preset)) if file is None else load_part(str(file))
    if own.spec.key != spec.key:
        raise ParameterError(f"part = {file!r} is one of {own.spec.name}, allowed: {spec.name}")
    return own


def _values(own: PartFile) -> tuple[dict[str, Any], str]:
    """Return parameters and level that a part's file or a preset gives."""
    return {k: x for k, x in own.parameters.items() if k not in RESERVED}, own.fidelity


def _own_scatter(own: PartFile, free: set[str]) -> dict[str, Any]:
    """Return the scatter of a part's file or preset, of parameters that are ``free`` in the scene.

    What the scene gives itself does not scatter as the part's did.
    """
    lines = {k: x for k, x in own.scatter.items() if k in free}
    pairs = [p for p in own.scatter.get(CORRELATION, ()) if {*p[:2]} <= {*lines}]
    return lines | ({CORRELATION: pairs} if pairs else {})


class KnownBand(NamedTuple):
    """A figure by a study of its scene [SI]: its nominal value and quantiles by level."""

    nominal: float
    quantiles: Mapping[float, float]
    runs: int

    def as_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        quantiles = {str(level): x for level, x in self.quantiles.items()}
        return {"nominal": self.nominal, "quantiles": quantiles, "runs": self.runs}


def known_bands(scene: Scene) -> dict[str, KnownBand]:
    """Return the bands of a built-in scene's figures by name, {} if anything of it was changed."""
    table = table_beside(__file__, "known_bands.toml").get(scene.name)
    if table is None or scene.name not in builtin_scenes() or not _as_it_comes(scene):
        return {}
    return {
        name: KnownBand(nominal, dict(zip(LEVELS, quantiles, strict=True)), table["runs"])
        for name, (nominal, *quantiles) in table["figures"].items()
    }


def _as_it_comes(scene: Scene) -> bool:
    """Tell if a scene has the numbers of the built-in one of its name."""
    own = _unchanged(scene.name, scene.step, scene.master)
    return all(_numbers(scene, part) == _numbers(own, part) for part in {*scene.parts, *own.parts})


@lru_cache(maxsize=16)
def _unchanged(name: str, step: float, master: str) -> Scene:
    """Return a built-in scene, read once: nobody changes it."""
    return load_scene(name).with_options(step=step, master=master)


def _numbers(scene: Scene, name: str) -> dict[str, Any]:
    part = scene.parts.get(name)
    given = part.parameters() if part else {}
    return {key: value for key, value in given.items() if key not in NO_MATTER}
