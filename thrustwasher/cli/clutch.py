"""``thrustwasher clutch``: one operating point of a wet friction pack."""

from __future__ import annotations

import argparse
import time
from typing import Any

from ..models.clutch_params import SPEC, SPEED, ClutchParams
from . import _fidelity, _options, _output

HELP = "friction torque of a wet clutch or brake pack at one load and slip speed"
# Result fields that are no FMU output, or mean something else here: unit and meaning.
EXTRA = {
    "shear_ratio": ("1", "share of the full adhesive shear strength, s/s_m"),
    "friction_torque": ("N.m", "friction torque of the pack, sign of the slip, 0 without slip"),
    "temperature": ("K", "interface temperature if this slip lasted for ever"),
}
SAMPLES = 121


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    _options.add_inputs(parser, SPEC)
    _options.add_parameters(parser, SPEC)
    _fidelity.add_fidelity(parser, SPEC)
    parser.add_argument(
        "--plot", metavar="FILE", help="draw shear ratio, coefficient and torque over slip"
    )
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """Solve, then print or draw."""
    if arguments.parameters:
        print(_options.parameter_table(SPEC))
        return 0
    point = _options.read_inputs(arguments, SPEC)
    params = _options.read_parameters(arguments, SPEC)
    plot = arguments.plot and _output.check_file(arguments.plot, "--plot", _output.PLOT_SUFFIXES)

    from ..models.clutch import solve_clutch

    fidelity = _fidelity.rung(arguments.fidelity, SPEC, params, point)
    began = time.perf_counter()
    result = solve_clutch(params, **point, fidelity=fidelity)
    wall_time = time.perf_counter() - began
    if plot:
        with _output.whole_file(plot) as draft:
            _figure(params, point, result).savefig(draft)
        _output.note(f"wrote {plot}")
    fields = _output.scalars(result)
    if arguments.json:
        inputs = {**point, "parameters": _output.parameters_of(params)}
        _output.print_json({**fields, **inputs, "wall_time": wall_time})
        return 0
    meanings = {s.name: (s.unit, s.help) for s in SPEC.outputs} | EXTRA
    names = [name for name in fields if name in meanings and name not in point]
    print("friction pack at " + ", ".join(
        f"{s.name} {_output.shown(point[s.name], s.unit)}" for s in SPEC.inputs
    ))  # fmt: skip
    _output.print_rows(
        [(n, _output.shown(getattr(result, n), meanings[n][0]), meanings[n][1]) for n in names]
    )
    print(f"  {result.status.advice}; {fidelity}, {wall_time:.3g} s")
    return 0


def _figure(params: ClutchParams, point: dict[str, Any], result: Any) -> Any:
    """Return the plot over slip at the given load and oil temperature."""
    from ..models.clutch import boundary_friction, solve_clutch
    from ..models.clutch_friction import friction_radius
    from ..report.clutch_plot import clutch_figure

    p = params
    has_shares = p.friction_law == "wang" and result.fidelity != "closed"
    fall = (p.stick_speed + 2.0 * p.decay_speed) / friction_radius(p) if has_shares else 1.0
    fastest = min(max(2.0 * abs(point["speed"]), fall), SPEED.high or fall)
    speeds = [fastest * (i / (SAMPLES - 1)) ** 2 for i in range(SAMPLES)]
    sweep = [
        solve_clutch(params, **{**point, "speed": speed}, fidelity=result.fidelity, throw=False)
        for speed in speeds
    ]
    share = (p.indentation, 0.0, p.plough_weight, p.hardness_ratio)
    ploughing = boundary_friction(*share) if has_shares else None
    return clutch_figure(speeds, sweep, result, point, ploughing)
