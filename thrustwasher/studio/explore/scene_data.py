"""A scene as the page's scripts run it: parts, connections, profiles, draws; JSON types."""

import base64
import zlib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import FIRST_FAILURE, ParameterError, Status
from ...fmu.description.interface import interface
from ...fmu.running.core import Core
from ...fmu.stepper import DirectInstance
from ...model.parameters import as_numbers
from ...model.prepare import check_together, tables_of
from ...model.registry import kernel_of
from ...model.spec import ModelSpec
from ...model.toml_tables import quantity
from ...native.library import web_functions, web_module
from ...shift.checks.rule_data import map_rows
from ...shift.cosim.schedule import Correct, Pull, Schedule, Step
from ...shift.cosim.system import System
from ...shift.key_figures.comfort import COMFORT
from ...shift.key_figures.figure_list import FIGURES
from ...shift.run import connected, laid_out
from ...shift.scene.connections import COMMAND, DIRECT, PACKS, wired
from ...shift.scene.places import COLUMNS, scene_scatter
from ...shift.scene.scene import PRESSED, Part, Scene
from ...shift.scene.scene_file import builtin_scenes
from ...shift.scene.variation import scene_text, varied_scene
from ...shift.shift_result import ShiftResult
from ...transmission.parameters import POINTS, PROFILES, profile_points
from ...units import UNITS, readable_units
from .draws import DRAWS, fixed_points
from .scene_warnings import warning_data

CALLS = (
    "step",
    "derive",
    "broken_rule",
    "comfort",
    "held_from",
    "shift_heat",
    "slip_end",
    "standstill",
)
# Where a profile stands in a scene's file, and the factor of its values there.
TABLES = {
    "clutch_pressure": ("pressure.clutch", "scale"),
    "brake_pressure": ("pressure.brake", "scale"),
    "engine_torque": ("engine", "torque_scale"),
}
SHOWN = (
    "lock_time",
    "slip_energy",
    "peak_jerk",
    "lock_after_ramp_start",
    "peak_power",
    "torque_hole",
    "flare",
    "shift_heat",
)
# What the figures and plots are read from; of packs for both.
SIGNALS = (
    "engine_speed",
    "drum_speed",
    "output_speed",
    "output_acceleration",
    "lock_time",
    "release_time",
)
OF_PACKS = ("locked", "heat", "speed", "load", "reaction")


def checked(scene: Scene) -> Scene:
    """Return a scene that a page can run.

    ParameterError: it has a sequence, or a master that changes inputs as it goes.
    """
    if scene.sequence is not None:
        raise ParameterError(f"scene {scene.name!r}: it has a [sequence], allowed: one shift")
    if scene.master not in ("gauss-seidel", "jacobi"):
        raise ParameterError(
            f"scene {scene.name!r}: master = {scene.master!r}, allowed in a page: 'gauss-seidel' "
            "or 'jacobi'"
        )
    return scene


def instance_of(_name: str, part: Part) -> DirectInstance:
    """Return the kernels of a part, to be stepped in this process."""
    return DirectInstance(part.spec, parameters=part.parameters())


def scene_data(result: ShiftResult) -> dict[str, Any]:
    """Return the JSON object of a scene's page; ``result``: the run of the scene as it is."""
    scene = result.scene
    system = connected(scene, {n: instance_of(n, p) for n, p in scene.parts.items()})
    run = laid_out(scene, system, [])
    gearbox = scene.parts["transmission"].params
    models = {part.spec.key: part.spec for part in scene.parts.values()}
    return {
        "name": scene.name,
        "start_time": scene.start_time,
        "stop_time": scene.stop_time,
        "time": {"points": len(run.time), "step": run.h},
        "models": {
            key: {
                "functions": web_functions(spec.kernel, CALLS),
                "rules": _rules(spec),
            }
            for key, spec in models.items()
        },
        "parts": {name: _part(name, part, system) for name, part in scene.parts.items()},
        "schedule": _schedule(run.schedule),
        "command": system.transmission.input_names.index(COMMAND),
        "washers": {name: _washer(scene, name, result) for name in DIRECT if name in scene.parts},
        "profiles": _profiles(scene),
        "most_points": POINTS,
        "shift": {
            key: getattr(scene, f"shift_{key}") for key in ("start", "duration", "from", "to")
        },
        "by_pressure": gearbox.actuation == "pressure",
        "reach": scene.vehicle.reach if scene.vehicle else None,
        "ratio": 1.0 + gearbox.ratio,
        "pressed": PRESSED,
        "comfort": COMFORT,
        "signals": [*SIGNALS, *(f"{pack}_{s}" for pack in ("clutch", "brake") for s in OF_PACKS)],
        "figures": {n: FIGURES[n]._asdict() for n in SHOWN}
        | {n: FIGURES[n]._asdict() for n in map("peak_{}_temperature".format, ("clutch", "brake"))},
        "units": readable_units(),
        "scales": UNITS,
        "statuses": {int(s): s.advice for s in Status},
        "first_failure": FIRST_FAILURE,
        "scatter": scene_draws(scene),
        "springs": {pack: getattr(gearbox, f"{pack}_return_spring") for pack in PACKS},
        "file": _file(scene),
        "warnings": warning_data(scene, run.h),
    }


def modules(scene: Scene) -> dict[str, str]:
    """Return the compiled kernels of a scene's models: zlib, base64; by the models' keys."""
    kernels = {part.spec.key: part.spec.kernel for part in scene.parts.values()}
    return {key: _packed(web_module(kernel)) for key, kernel in kernels.items()}


def _packed(data: bytes) -> str:
    return base64.b64encode(zlib.compress(data, 6)).decode("ascii")


def _rules(spec: ModelSpec) -> list[str]:
    return [rule.text for rule in spec.rules]


def _numbers(part: Part, fidelity: str) -> list[float]:
    """Return what a kernel's ``par`` begins with: parameters, then the level's number."""
    return [*as_numbers(part.params), list(part.spec.fidelities).index(fidelity) + 1.0]


def _part(name: str, part: Part, system: System) -> dict[str, Any]:
    """Return a part: memory, parameters, inputs with their sources, outputs."""
    kernel, shown = kernel_of(part.spec), interface(part.spec)
    connected_part = system.parts[name]
    return {
        "model": part.spec.key,
        "sizes": {
            "par": kernel.NPAR,
            "inp": kernel.NINP + getattr(kernel, "NRATES", 0),
            "state": kernel.NSTATE,
            "work": kernel.NWORK,
            "out": kernel.NOUT,
            "iout": kernel.NIOUT,
        },
        "numbers": _numbers(part, part.fidelity),
        "names": [*(f.name for f in fields(part.spec.params)), "fidelity"],
        "inp": Core(shown).inp.tolist(),
        "inputs": [[v.name, v.slot, *v.bounds, v.unit] for v in shown.inputs],
        "outputs": [[v.name, v.store == "out", v.slot] for v in shown.outputs],
        "sources": [[slot, source.name, place] for slot, source, place in connected_part.sources],
    }


def _schedule(schedule: Schedule) -> list[list[str]]:
    """Return what is done in a communication step, ["pull" or "step", part] each."""
    words = {Pull: "pull", Step: "step"}
    assert not any(isinstance(action, Correct) for action in schedule)
    return [[words[type(action)], action.part.name] for action in schedule]  # type: ignore[index]


def _washer(scene: Scene, name: str, result: ShiftResult) -> dict[str, Any]:
    """Return how a washer runs while one drags: by its map, else as the scene's run recorded it."""
    part, tables = scene.parts[name], tables_of(scene.parts[name].spec)
    kernel = kernel_of(part.spec)
    found: dict[str, Any] = {"level": part.fidelity, "map": None}
    with suppress(ParameterError):  # there is no map for these parameters
        assert tables is not None
        check_together(part.spec, part.params, tables.level)
        table = np.asarray(tables.find(part.params).data, np.float64)
        numbers = _numbers(part, tables.level)
        found["map"] = {"at": kernel.TABLE["AT"], "numbers": numbers}
        found["map"]["table"] = _packed(table.tobytes())
        found["map"]["boxes"] = [*map_rows(part)]
    outputs = [s.name for s in part.spec.outputs]
    rows = np.column_stack([result.signals[f"{name}.{output}"] for output in outputs])
    needed = {outputs.index(k.output) for k in wired(scene.parts) if k.source == name}
    rows[:, [i for i in range(len(outputs)) if i not in needed]] = 0.0
    moving = result.signals[f"{name}.speed"] != 0.0
    found["recorded"] = {"rows": _packed(rows.tobytes()), "moving": [int(x) for x in moving]}
    return found


def _profiles(scene: Scene) -> dict[str, Any]:
    """Return the profiles that can be dragged: points as in the file, factor, place in ``par``."""
    found: dict[str, Any] = {}
    part = scene.parts["transmission"]
    names = [f.name for f in fields(part.spec.params)]
    for name, (table, key) in TABLES.items():
        own: Any = scene.table
        for word in table.split("."):
            own = own.get(word, {})
        if not profile_points(part.params, name):
            continue
        unit, low, high, text = PROFILES[name]
        points = profile_points(part.params, name)
        if "points" in own:
            points = [
                (quantity(table, "time", t, "s"), quantity(table, "value", x, unit))
                for t, x in own["points"]
            ]
        found[name] = {
            "points": points,
            "factor": float(own.get(key, 1.0)),
            "unit": unit,
            "min": low,
            "max": high,
            "text": text,
            "table": table,
            "at": {
                "count": names.index(f"{name}_points"),
                "times": [names.index(f"{name}_time_{i}") for i in range(1, POINTS + 1)],
                "values": [names.index(f"{name}_{i}") for i in range(1, POINTS + 1)],
            },
        }
    return found


def _file(scene: Scene) -> dict[str, Any]:
    """Return the tables of a file that gives this scene; of a built-in one, what differs."""
    if scene.source in builtin_scenes():
        import tomllib

        return dict(tomllib.loads(scene_text(scene, {})))
    tables = dict(scene.table)
    for name, own in tables.items():
        if isinstance(own, dict) and isinstance(own.get("part"), str):
            tables[name] = own | {"part": Path(own["part"]).resolve().as_posix()}
    return tables


def scene_draws(scene: Scene) -> dict[str, Any] | None:
    """Return draws of what scatters in a scene; None without any.

    Each draw is {"parts": {part: [[place in par, number], ...]}, "profiles": {name: {"factor": f,
    "times": {i: seconds more}, "points": {i: more}}}}; a draw whose values do not go together has a
    "problem".
    """
    scatter = scene_scatter(scene)
    if not scatter.sources:
        return None
    rows = scatter.values(fixed_points(len(scatter.sources)))
    nominal = {s.place.name: s.place.nominal for s in scatter.sources}
    sources = [
        {"name": s.place.name, "law": s.law.words(), "reason": s.reason} for s in scatter.sources
    ]
    before = {name: _numbers(part, part.fidelity) for name, part in scene.parts.items()}
    return {
        "draws": DRAWS,
        "sources": sources,
        "rows": [_draw(scene, nominal, before, row) for row in rows],
        "warnings": scatter.warnings,
    }


def _draw(
    scene: Scene,
    nominal: Mapping[str, Any],
    before: Mapping[str, list[float]],
    row: Mapping[str, Any],
) -> dict[str, Any]:
    """Return what a draw changes; ``nominal``: values by path, ``before``: numbers of the parts."""
    profiles: dict[str, Any] = {}
    rest = dict(row)
    for name, (table, key) in TABLES.items():
        own: dict[str, Any] = {"factor": 1.0, **{column: {} for column in COLUMNS}}
        for path in [p for p in row if p.startswith(f"{table}.")]:
            word, *place = path.removeprefix(f"{table}.").split(".")
            if word == key:
                own["factor"] = float(rest.pop(path)) / float(nominal[path])
            elif word in COLUMNS and len(place) == 1:
                own[word][place[0]] = float(rest.pop(path)) - float(nominal[path])
        if own["factor"] != 1.0 or any(own[column] for column in COLUMNS):
            profiles[name] = own
    try:
        other = varied_scene(scene, rest, warned=False)
    except ParameterError as problem:
        return {"problem": str(problem)}
    parts = {}
    for name, part in other.parts.items():
        now = _numbers(part, scene.parts[name].fidelity)
        if changed := [
            [i, x] for i, (x, y) in enumerate(zip(now, before[name], strict=True)) if x != y
        ]:
            parts[name] = changed
    return {"parts": parts, "profiles": profiles}


def started(result: ShiftResult) -> dict[str, float | None]:
    """Return the figures of the scene as it is, by name."""
    known = {f.name: f.value for f in result.key_figures}
    peaks = (f"peak_{result.scene.engaging}_temperature",)
    return {name: known.get(name) for name in (*SHOWN, *peaks)}
