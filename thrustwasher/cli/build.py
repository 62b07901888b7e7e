"""``thrustwasher build``: make the FMUs."""

from __future__ import annotations

import argparse

from . import _output

HELP = "build FMUs for co-simulation: ThrustWasher, WetClutch, GearMesh, ShiftTransmission"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument("models", nargs="*", metavar="MODEL", help="names of FMUs; default: all")
    parser.add_argument(
        "--target",
        choices=["python", "native"],
        default="python",
        help="python: needs this package on the machine that runs it (default); native: not in "
        "this version",
    )
    parser.add_argument(
        "--fmi", type=int, choices=[2, 3], default=2, help="FMI version; this version builds 2"
    )
    parser.add_argument(
        "--out", metavar="DIR", default="dist",
        help="the FMUs go to DIR/<target>-fmi<N>/<MODEL>.fmu; default dist",
    )  # fmt: skip
    parser.add_argument("--json", action="store_true", help="one JSON object with the paths")


def run(arguments: argparse.Namespace) -> int:
    """Build, then name the files."""
    folder = _output.check_folder(arguments.out, "--out")

    from ..fmu.build import build
    from ..fmu.registry import all_specs, find_spec, is_compiled
    from ..fmu.validate import validate

    specs = [find_spec(model) for model in arguments.models] or all_specs()
    missing = [spec.name for spec in specs if not is_compiled(spec)]
    if missing and arguments.target == "python":
        _output.note(f"compiling {', '.join(missing)} first: seconds, the washer a minute or two")
    paths = build(arguments.models or None, target=arguments.target, fmi=arguments.fmi, out=folder)
    findings = [f"{path}: {finding}" for path in paths for finding in validate(path)]
    if arguments.json:
        _output.print_json({"fmus": [str(path) for path in paths], "findings": findings})
    else:
        for path in paths:
            print(path)
    for finding in findings:
        _output.note(finding)
    return 3 if findings else 0
