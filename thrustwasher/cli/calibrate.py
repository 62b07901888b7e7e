"""``thrustwasher calibrate``: fit the clutch's friction law to measured friction."""

import argparse
import time
from typing import Any

from ..clutch.parameters import SPEC
from ..errors import ParameterError
from ..units import parse_quantity
from . import _options, _output, _table

HELP = "fit the clutch's friction law to measured friction (CSV: speed, load, friction)"
UNITS = {
    "speed": "rad/s", "load": "N", "friction": "1", "friction_error": "1", "oil_temperature": "K",
}  # fmt: skip
EXAMPLES = "plough_weight, shear_floor, stick_speed, decay_speed, hardness_ratio, indentation"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "data", metavar="DATA.csv", nargs="?",
        help="columns speed, load, friction and, if known, friction_error (standard deviation) and "
        "oil_temperature (for --set friction_data=boundary); "
        'a unit may follow in brackets, as in "speed [rpm]"',
    )  # fmt: skip
    parser.add_argument(
        "--fit", metavar="NAMES",
        help=f"constants to fit, separated by commas, of {EXAMPLES}; default the first four "
        "(constant_friction under --set friction_law=constant)",
    )  # fmt: skip
    parser.add_argument(
        "--confidence", metavar="P", default="0.95",
        help="probability of the intervals; above 0, below 1, default 0.95",
    )  # fmt: skip
    _options.add_parameters(parser, SPEC)
    _output.add_targets(parser, plot="draw points, fitted curve and residuals", instead="sentences")


def run(arguments: argparse.Namespace) -> int:
    """Read, fit, then print or draw."""
    if arguments.data is None:
        raise ParameterError("the file with the measured points is missing (DATA.csv)")
    params = _options.read_parameters(arguments, SPEC)
    confidence = parse_quantity(arguments.confidence, "1", "confidence")
    targets = _output.targets(arguments)
    columns: dict[str, Any] = dict(
        _table.read_columns(arguments.data, UNITS, optional=("friction_error", "oil_temperature"))
    )

    from ..clutch.calibration.calibration import DEFAULT_FIT, calibrate

    names = DEFAULT_FIT if params.friction_law != "constant" else ("constant_friction",)
    if arguments.fit is not None:
        names = tuple(name.strip() for name in arguments.fit.split(",") if name.strip())
    began = time.perf_counter()
    found = calibrate(params, **columns, fit=names, confidence=confidence)
    wall_time = time.perf_counter() - began
    for text in found.warnings:
        _output.note(f"warning: {text.partition(': ')[0]}")
    targets.draw("thrustwasher.report.model_plots.fit_plot:calibration_figure", found, columns)
    if arguments.json:
        inputs = {"data": arguments.data, "fit": names, **columns}
        pack = {"parameters": _output.parameters_of(found.params)}
        _output.print_json({**found.as_dict(), **pack, **inputs, "wall_time": wall_time})
        return 0
    print(found)
    print(f"Use it: thrustwasher clutch {_settings(found)}")
    return 0


def _settings(found: Any) -> str:
    """Return the options for the fitted constants and for all that was given beside them."""
    values: dict[str, Any] = {e.name: f"{e.value:.10g}" for e in found.estimates}
    usual = _output.parameters_of(type(found.params)())
    for name, value in _output.parameters_of(found.params).items():
        if value != usual[name]:
            values.setdefault(name, value)
    return " ".join(f"--set {name}={value}" for name, value in values.items())
