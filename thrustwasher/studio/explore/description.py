"""A model as the page's scripts read it: from its interface, verification tables, kernels."""

from collections.abc import Mapping
from dataclasses import asdict, fields
from typing import Any, get_type_hints

from ...ladder.error_table import QUANTITIES, SAFETY, Chart, LevelErrors, fresh_levels
from ...model.levels import level_named
from ...model.oil import named_oils, oil
from ...model.part_file import PartFile
from ...model.record import Model
from ...model.spec import NAMED, Signal
from ...units import UNITS, readable_units
from .draws import draws_of
from .view import View

QUANTITY = "friction_torque"


def inputs_of(model: Model, view: View) -> list[Signal]:
    """Return the inputs of what the page solves."""
    if view.inputs:
        return list(view.inputs)
    return model.inputs()


def outputs_of(model: Model, view: View) -> dict[str, dict[str, Any]]:
    """Return what is known of each of the API's results: unit, meaning, an enumeration's names."""
    found: dict[str, dict[str, Any]] = {}
    if view.outputs:
        return {
            name: {"kind": "real", "relative": False, "unit": unit, "help": words}
            for name, (unit, words) in view.outputs.items()
        }
    assert model.command is not None
    result = get_type_hints(model.solve)["return"]
    for s in (s for s in model.spec.outputs if hasattr(result, s.name)):
        keys = ("unit", "help", "kind", "relative")
        found[s.name] = {**{key: getattr(s, key) for key in keys}, "scale": s.nominal}
        if s.type in NAMED:
            found[s.name]["options"] = list(NAMED[s.type])
    for name, (unit, words) in model.command.extra.items():
        before = found.get(name, {"relative": False})
        found[name] = {"kind": "real", **before, "unit": unit, "help": words}
    return found


def describe(
    model: Model, view: View, part: PartFile, point: Mapping[str, float]
) -> dict[str, Any]:
    """Return the JSON object of a model's page; ``point``: value of each input at the start."""
    spec = model.spec
    level = level_named(spec, part.fidelity)
    level = level if level in view.worker.levels else spec.default_fidelity
    params = part.params
    known = {s.name for s in inputs_of(model, view)} | {f.name for f in fields(spec.params)}
    return {
        "key": spec.key,
        "name": part.name if part.name != spec.name else f"My{spec.name}",
        "main": view.main,
        "group": view.group[1],
        "inputs": [_input(s, view, point[s.name]) for s in inputs_of(model, view)],
        "parameters": [_field(f.name, f.metadata, view) for f in fields(spec.params)],
        "defaults": {f.name: f.default for f in fields(spec.params)},
        "given": {f.name: getattr(params, f.name) for f in fields(spec.params)},
        "oils": {name: oil(name).parameters_for(spec) for name in named_oils()},
        "outputs": outputs_of(model, view),
        "units": readable_units(),
        "scales": UNITS,
        "levels": spec.levels,
        "level": level,
        "usual_level": spec.default_fidelity,
        "rules": [rule.text for rule in spec.rules],
        "error_tables": [
            _error_table(level, chart)
            for name, level in fresh_levels(spec.key, params).items()
            if name in view.worker.levels
            for chart in level.charts
        ],
        "safety": SAFETY,
        "scatter": draws_of(part, view.verified_point(point), known, view.load),
        **view.more,
        "python": {"params": view.params, "solve": view.solve},
        "worker": view.worker.data(spec),
    }


def _input(s: Signal, view: View, value: float) -> dict[str, Any]:
    low, unit, relative = view.least.get(s.name, s.low), s.unit, s.relative
    m = {"kind": "real", "unit": unit, "help": s.help, "min": low, "max": s.high}
    return _field(s.name, {**m, "relative": relative}, view) | {"value": value}


def _field(name: str, m: Mapping[str, object], view: View) -> dict[str, Any]:
    """Return an input or parameter with its limits and the ends of its slider."""
    first, last = view.spans.get(name, (m["min"], m["max"]))
    keys = ("unit", "help", "kind", "min", "max", "options")
    ends = {"from": first, "to": last, "relative": m.get("relative", False)}
    return {"name": name, **ends, **{key: m[key] for key in keys if key in m}}


def _error_table(level: LevelErrors, chart: Chart) -> dict[str, Any]:
    """Return what was measured on a chart: the ends of each region and its error of the torque."""
    error = list(QUANTITIES).index(QUANTITY) - len(QUANTITIES)
    return {
        "fidelity": level.fidelity,
        "chart": chart.name,
        "envelope": {name: asdict(axis) for name, axis in level.box.items()},
        "divisions": [
            {"axes": d.axes, "rows": [[*row[: 2 * len(d.axes)], row[error]] for row in d.rows]}
            for d in chart.divisions
        ],
    }
