"""``thrustwasher curve``: every solution over the load at one speed, and the folds."""

import argparse
import time
from collections.abc import Sequence
from typing import Any

from ..errors import ParameterError
from ..model.part_file import PartFile
from ..plugins import called
from ..units import format_quantity, parse_quantity
from ..washer.model import GRID
from ..washer.parameters import SPEC
from .common import _options, _output
from .common._solve import Ranking, print_ranking

HELP = "the washer's load curve, with the folds (limit loads) of its film"
EXAMPLES = (
    'thrustwasher curve --speed "5200 rpm" --plot curve.png',
    'thrustwasher curve --speed "5200 rpm" --load 100:1500 --out curve.csv',
)
INPUTS = [signal for signal in SPEC.inputs if signal.name != "load"]
COLUMNS = _output.columns(
    SPEC,
    (
        *("load", "film_ratio", "film_thickness", "friction_torque", "friction_coefficient"),
        *("temperature", "temperature_max", "fluid_load", "contact_load", "friction_power"),
        *("oil_flow", "throughflow_heat", "oil_heat", "oil_outlet_temperature"),
        *("film_temperature", "stick_margin", "branch"),
    ),
    fluid_load="N",
    contact_load="N",
    branch="",
)
TABLE = ("load", "film_ratio", "friction_torque", "friction_coefficient", "temperature", "branch")
WIDTH = 22
LOAD_MIN, LOAD_MAX = 20.0, 3000.0  # N


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    _options.add_inputs(parser, INPUTS)
    ends = "ends of the curve [N], 1 .. 200000; default 20:3000, wider if the part's [box] is"
    _options.add(parser, {"--load LOW:HIGH": ends})
    _options.add_parameters(parser, SPEC)
    _options.add_options(parser, [GRID])
    ranks = "rank the parameters by what one percent more of each changes the loads of the folds"
    _options.add(parser, {"--sensitivities": f"{ranks}; --plot then draws the ranking"})
    _output.add_targets(parser, out="write the points as CSV", plot="draw the curve with its folds")


def run(arguments: argparse.Namespace) -> int:
    """Trace, then print, write or draw."""
    at = _options.read_point(arguments, SPEC, INPUTS)
    point = at.there.values
    grid = _options.read_options(arguments, [GRID])
    targets = _output.targets(arguments)

    from ..washer.load_curve import load_curve

    began = time.perf_counter()
    asked: dict[str, Any] = {**point, **_of_part(at.part), **_loads(arguments.load), **grid}
    curve = load_curve(at.part.params, **asked)
    wall_time = time.perf_counter() - began
    warnings = at.warn(curve.warnings)
    series = {name: [getattr(p, name) for p in curve.points] for name in COLUMNS}
    targets.write(COLUMNS, series)
    slopes = curve.fold_sensitivities() if arguments.sensitivities else []
    ranking = _ranking(curve.folds, slopes, at.part.params)
    if targets.plot:
        ranked = arguments.sensitivities and ranking
        targets.draw(
            called("ranking_figure")(at.part.name, ranking)
            if ranked
            else called("curve_figure")(curve, point)
        )
    if arguments.json:
        found: dict[str, Any] = {
            n: list(map(_output.scalars, getattr(curve, n))) for n in ("points", "folds")
        }
        if arguments.sensitivities:
            found["fold_sensitivities"] = slopes
            found["change_per_percent"] = {name: row for name, (_, row) in ranking.items()}
        _output.print_json({**found, **point, **at.record(warnings, wall_time)})
        return 0
    if at.there.taken:
        print(at.there.taken)
    if not any(targets):
        _output.print_table({name: COLUMNS[name] for name in TABLE}, series, WIDTH)
    if not curve.folds:
        ends = " and ".join(format_quantity(asked[n], "N") for n in ("load_min", "load_max"))
        print(f"no fold between {ends}: one solution at every load there; --load LOW:HIGH for more")
    for fold in curve.folds:
        words = fold.kind.replace("_", " ")
        print(
            f"{words} at {format_quantity(fold.load, 'N')}: film ratio {fold.film_ratio:.3g}, "
            f"{format_quantity(fold.temperature, 'K')}, "
            f"{format_quantity(fold.friction_torque, 'N.m')}"
        )
    if ranking:
        print_ranking(ranking)
    return 0


def _ranking(folds: Sequence[Any], slopes: Sequence[Any], params: Any) -> Ranking:
    """Return the changes of the loads of folds by one percent of each parameter, maximum first."""
    found: Ranking = {}
    for number, (fold, row) in enumerate(zip(folds, slopes, strict=False)):
        if row is not None:
            changes = {name: 0.01 * getattr(params, name) * slope for name, slope in row.items()}
            name = f"{fold.kind}_load" + (f"_{number // 2 + 1}" if number > 1 else "")
            found[name] = "N", dict(sorted(changes.items(), key=lambda item: -abs(item[1])))
    return found


def _loads(text: str | None) -> dict[str, float]:
    """Return the ends of the curve [N] that are requested."""
    if text is None:
        return {}
    ends = text.split(":")
    if len(ends) != 2:
        raise ParameterError(f"--load {text}: allowed: LOW:HIGH, e.g. 20:8kN")
    names = ("load_min", "load_max")
    found = [parse_quantity(end, "N", "load") for end in ends]
    return dict(zip(names, found, strict=True))


def _of_part(part: PartFile) -> dict[str, Any]:
    """Return the ends of the curve [N], wider if the box is, and the part's level."""
    low, high = part.box.get("load", (LOAD_MIN, LOAD_MAX))
    level = "field" if part.fidelity == "map" else part.fidelity  # a curve takes a mesh
    ends = {"load_min": max(min(low, LOAD_MIN), 1.0), "load_max": max(high, LOAD_MAX)}
    return {**ends, "fidelity": level}
