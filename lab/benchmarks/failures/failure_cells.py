"""Cells of the stability map: what one method does at one hazard, measured.

=======  =========================================================================================
ok       right, or off by its mesh only
slow     right, but many sweeps (100), solves (10), turns (20), or torques or steps for one (10)
says     fails, and says so: by a status, an exception, a message, or its own error estimate
LIES     silently wrong
-        does not apply
=======  =========================================================================================
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from thrustwasher.errors import ParameterError, SolveError

OK, SLOW, SAYS, LIES, NONE = "ok", "slow", "says", "LIES", "-"


@dataclass(frozen=True)
class Cell:
    """One method at one hazard."""

    verdict: str
    figure: str = ""  # what is off, or how much was done
    words: str = ""


@dataclass(frozen=True)
class Group:
    """Methods for one thing, hazards it meets, and cells[method][hazard]."""

    name: str
    judged: str
    methods: list[str]
    hazards: list[str]
    cells: list[list[Cell]]


Judge = Callable[[Any, Any], Cell]


def table(
    name: str, judged: str, methods: dict[str, Any], hazards: dict[str, Any], judge: Judge
) -> Group:
    """Return all cells; an exception is a way of saying it."""
    cells = []
    for method in methods.values():
        row = []
        for hazard in hazards.values():
            try:
                row.append(judge(method, hazard))
            except (ParameterError, SolveError, ArithmeticError, ValueError) as error:
                row.append(Cell(SAYS, "", f"{type(error).__name__}: {error}"))
        cells.append(row)
    return Group(name, judged, list(methods), list(hazards), cells)


def off(error: float) -> str:
    """Return a relative error as a figure."""
    if not abs(error) < 10.0:
        return f"x {1.0 + error:.2g}"
    digits = 0 if abs(error) >= 0.095 else 1
    plain = f"{100 * error:+.{digits}f} %"
    return plain if abs(error) >= 5e-4 else f"{100 * error:+.0e} %"
