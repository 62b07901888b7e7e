"""Co-simulation masters: who steps when, with which inputs.

A master is a function that lists the moves of one communication step. A new one is a new file and a
line in ``MASTERS``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from . import gauss_seidel, jacobi, linearly_implicit, step_doubling
from .moves import Move
from .system import System


class Master(NamedTuple):
    """One way to step a system."""

    schedule: Callable[[System], list[Move]]
    torque_age: int
    """How many steps the torques that the transmission receives are old."""
    help: str
    adaptive: bool = False
    """It chooses its steps itself; communication points then lie anywhere."""


MASTERS: dict[str, Master] = {
    "gauss-seidel": Master(
        gauss_seidel.schedule, 0, "friction parts first, the transmission with fresh torques"
    ),
    "jacobi": Master(
        jacobi.schedule, 1, "all parts step at once with the inputs of the last point"
    ),
    linearly_implicit.NAME: Master(
        linearly_implicit.schedule, 0,
        "as gauss-seidel, torques corrected to the end of the step by their derivatives",
    ),
    step_doubling.NAME: Master(
        step_doubling.schedule, 0,
        "as gauss-seidel, steps as long as master_tolerance allows, with rollback", adaptive=True,
    ),
}  # fmt: skip
