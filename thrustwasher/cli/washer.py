"""``thrustwasher washer``: one operating point of the thrust washer."""

from __future__ import annotations

import argparse
import time

from ..models.washer_params import SPEC
from . import _fidelity, _options, _output

HELP = "solve the thrust washer at one load, speed and tilt"
# Result fields that are no FMU output: unit and meaning.
EXTRA = {
    "fluid_load": ("N", "carried by the oil film"),
    "contact_load": ("N", "carried by the asperities"),
    "washer_tilt_x": ("rad", "rotation of the washer about x"),
    "washer_tilt_y": ("rad", "rotation of the washer about y"),
    "branch": ("1", "which of the possible solutions this is"),
    "error_estimate": ("1", "relative error expected in friction_torque"),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    _options.add_inputs(parser, SPEC)
    _options.add_parameters(parser, SPEC)
    _fidelity.add_fidelity(parser, SPEC)
    _options.add_grid(parser)
    parser.add_argument(
        "--branch",
        choices=["film", "contact"],
        help="solution wanted where several exist; default: a washer loaded up from light load",
    )
    parser.add_argument("--plot", metavar="FILE", help="draw pressure, film and temperature fields")
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """Solve, then print or draw."""
    if arguments.parameters:
        print(_options.parameter_table(SPEC))
        return 0
    point = _options.read_inputs(arguments, SPEC)
    params = _options.read_parameters(arguments, SPEC)
    grid = _options.read_grid(arguments)
    plot = arguments.plot and _output.check_file(arguments.plot, "--plot", _output.PLOT_SUFFIXES)

    from ..models.washer import solve_washer

    fidelity = _fidelity.rung(arguments.fidelity, SPEC, params, point)
    began = time.perf_counter()
    result = solve_washer(params, **point, fidelity=fidelity, grid=grid, branch=arguments.branch)
    wall_time = time.perf_counter() - began
    if plot:
        from ..report.washer_plots import field_figure

        with _output.whole_file(plot) as draft:
            field_figure(result, point).savefig(draft)
        _output.note(f"wrote {plot}")
    fields = _output.scalars(result)
    if arguments.json:
        inputs = {**point, "parameters": _output.parameters_of(params)}
        _output.print_json({**fields, **inputs, "wall_time": wall_time})
        return 0
    meanings = {s.name: (s.unit, s.help) for s in SPEC.outputs} | EXTRA
    names = [name for name in fields if name in meanings and name not in point]
    print("thrust washer at " + ", ".join(
        f"{s.name} {_output.shown(point[s.name], s.unit)}" for s in SPEC.inputs
    ))  # fmt: skip
    _output.print_rows(
        [(n, _output.shown(getattr(result, n), meanings[n][0]), meanings[n][1]) for n in names]
    )
    how = f"{result.status.advice}; {result.iterations} iterations"
    print(f"  {how}, {result.fidelity}, grid {result.grid[0]}x{result.grid[1]}, {wall_time:.3g} s")
    return 0
