"""``thrustwasher shift``: the main job, a gear shift of FMUs with its report."""

from __future__ import annotations

import argparse

from ..errors import ParameterError
from ..units import parse_quantity
from . import _output

HELP = "run a gear shift as co-simulation of FMUs and write its report"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "--scene", metavar="NAME|FILE", default="planetary",
        help="a built-in scene (planetary, msl) or a TOML file; default planetary",
    )  # fmt: skip
    parser.add_argument(
        "--out", metavar="DIR", default="shift-report",
        help="folder for report.html, the plots and shift.csv; default shift-report",
    )  # fmt: skip
    parser.add_argument(
        "--step", metavar="QUANTITY", default=None,
        help="communication step [s]; default: the scene's, 1e-3",
    )  # fmt: skip
    parser.add_argument(
        "--fmu", choices=["python", "native"], default="python",
        help="kind of FMU; this version builds the python kind",
    )  # fmt: skip
    parser.add_argument(
        "--master", choices=["gauss-seidel", "jacobi"], default=None,
        help="order in which the FMUs step; default: the scene's",
    )  # fmt: skip
    parser.add_argument("--json", action="store_true", help="one JSON object with every number")


def run(arguments: argparse.Namespace) -> int:
    """Build what is missing, run the shift, write the report."""
    if arguments.fmu == "native":
        raise ParameterError("fmu = 'native', allowed in this version: 'python'")
    step = None if arguments.step is None else parse_quantity(arguments.step, "s", "step")
    folder = _output.check_folder(arguments.out, "--out")
    raise ParameterError(f"{folder} {step}")
