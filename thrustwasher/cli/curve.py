"""``thrustwasher curve``: every solution over the load at one speed, and the folds."""

from __future__ import annotations

import argparse
import csv
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..models.washer_params import SPEC
from ..units import format_quantity
from . import _options, _output

HELP = "trace the washer's load curve with the folds where the film is lost and regained"
COLUMNS = {
    "load": "N", "film_ratio": "1", "film_thickness": "m", "friction_torque": "N.m",
    "friction_coefficient": "1", "temperature": "K", "temperature_max": "K", "fluid_load": "N",
    "contact_load": "N", "branch": "",
}  # fmt: skip
TABLE = ("load", "film_ratio", "friction_torque", "friction_coefficient", "temperature", "branch")
LINES = 16


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    _options.add_inputs(parser, SPEC, without="load")
    _options.add_parameters(parser, SPEC)
    _options.add_grid(parser)
    parser.add_argument("--out", metavar="FILE", help="write the points as CSV")
    parser.add_argument("--plot", metavar="FILE", help="draw the curve with its folds")
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """Trace, then print, write or draw."""
    if arguments.parameters:
        print(_options.parameter_table(SPEC))
        return 0
    point = _options.read_inputs(arguments, SPEC)
    params = _options.read_parameters(arguments, SPEC)
    grid = _options.read_grid(arguments)
    out = arguments.out and _output.check_file(arguments.out, "--out", (".csv",))
    plot = arguments.plot and _output.check_file(arguments.plot, "--plot", _output.PLOT_SUFFIXES)

    from ..models.washer_curve import load_curve

    began = time.perf_counter()
    curve = load_curve(params, **point, grid=grid)
    wall_time = time.perf_counter() - began
    if out:
        with _output.whole_file(out) as draft:
            _write_csv(draft, curve.points)
        _output.note(f"wrote {out}")
    if plot:
        from ..report.washer_plots import curve_figure

        with _output.whole_file(plot) as draft:
            curve_figure(curve, point).savefig(draft)
        _output.note(f"wrote {plot}")
    if arguments.json:
        _output.print_json({
            "points": [_output.scalars(p) for p in curve.points],
            "folds": [_output.scalars(f) for f in curve.folds],
            **point, "parameters": _output.parameters_of(params), "wall_time": wall_time,
        })  # fmt: skip
    elif not out and not plot:
        _print_table(curve.points)
    if not arguments.json:
        _print_folds(curve.folds)
    return 0


def _write_csv(path: Path, points: Sequence[Any]) -> None:
    """Write one line per point; the unit stands in the head of each column."""
    with path.open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream)
        table.writerow(f"{name} [{unit}]" if unit else name for name, unit in COLUMNS.items())
        for p in points:
            table.writerow(_output.as_json(getattr(p, name)) for name in COLUMNS)


def _print_table(points: Sequence[Any]) -> None:
    """Print some points, evenly picked along the curve."""
    print("".join(f"{name:>22}" for name in TABLE))
    last = len(points) - 1
    for index in sorted({round(last * i / (LINES - 1)) for i in range(LINES)}):
        cells = (_output.shown(getattr(points[index], name), COLUMNS[name]) for name in TABLE)
        print("".join(f"{cell:>22}" for cell in cells))


def _print_folds(folds: Sequence[Any]) -> None:
    """Say where the film is lost and regained."""
    if not folds:
        print("no fold: one solution at every load")
    for fold in folds:
        words = fold.kind.replace("_", " ")
        print(
            f"{words} at {format_quantity(fold.load, 'N')}: film ratio {fold.film_ratio:.3g}, "
            f"{format_quantity(fold.temperature, 'K')}, "
            f"{format_quantity(fold.friction_torque, 'N.m')}"
        )
