"""``thrustwasher doctor``: what works on this machine, and why not."""

import argparse

from .common import _output

HELP = "check what works on this machine"
EXAMPLES = (
    "thrustwasher doctor",
    "thrustwasher doctor --json",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """Look at the machine and report."""
    from ..fmu.diagnosis import diagnose

    findings = diagnose()
    if arguments.json:
        _output.print_json({"findings": [_output.scalars(f) for f in findings]})
        return 0
    _output.print_rows([("ok" if f.ok else "NO", f.name, f.text) for f in findings])
    return 0
