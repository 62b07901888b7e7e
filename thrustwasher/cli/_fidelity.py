"""``--fidelity auto:0.01``: the cheapest rung that holds a tolerance at the point asked for."""

import argparse
from collections.abc import Mapping
from typing import Any

from ..model.spec import ModelSpec
from . import _output


def add_fidelity(parser: argparse.ArgumentParser, spec: ModelSpec) -> None:
    """Add ``--fidelity`` with one sentence per rung, and with ``auto``."""
    rungs = "; ".join(f"{name}: {text}" for name, text in spec.fidelities.items())
    auto = "auto:0.01: the cheapest rung whose torque is verified to 1 % at this point"
    parser.add_argument(
        "--fidelity", type=_name(spec), default=spec.default_fidelity, metavar="RUNG",
        help=f"{rungs}; {auto}; default {spec.default_fidelity}".replace("%", "%%"),
    )  # fmt: skip


def _name(spec: ModelSpec) -> Any:
    """Return the check of the option's text."""

    def check(text: str) -> str:
        if text not in spec.fidelities and not text.startswith("auto"):
            known = " or ".join(repr(name) for name in spec.fidelities)
            raise argparse.ArgumentTypeError(f"{text!r}, allowed: {known} or 'auto:TOLERANCE'")
        return text

    return check


def rung(asked: str, spec: ModelSpec, params: Any, point: Mapping[str, float]) -> str:
    """Return the rung asked for by name, or the one that the cards choose at ``point``.

    Why it was chosen is written to standard error.

    Raises
    ------
    ParameterError : the tolerance is none
    SolveError : no rung is verified to it here
    """
    if asked in spec.fidelities:
        return asked
    from ..ladder.choose import choose
    from ..shift.scene.scene import rung_and_tolerance

    _, tolerance = rung_and_tolerance(spec.key, spec, asked)
    choice = choose(spec.key, dict(point), tol=float(tolerance or 0.0), params=params)
    _output.note(str(choice))
    return choice.fidelity
