"""Co-simulation masters: who steps when, with which inputs.

A master is a function that returns the schedule of one communication step. A new one is such a
function and a line in ``MASTERS``.
"""

from collections.abc import Callable
from typing import NamedTuple

from ..cosim import schedule
from ..cosim.schedule import Schedule
from ..cosim.system import System
from . import linearly_implicit


class Master(NamedTuple):
    """One way to step a system."""

    schedule: Callable[[System], Schedule]
    torque_age: int  # how many steps the torques that the transmission receives are old
    in_python: bool = False  # it works next to the instances in every step: no compiled loop


MASTERS: dict[str, Master] = {
    # Friction parts first, the transmission with fresh torques.
    "gauss-seidel": Master(schedule.gauss_seidel, 0),
    # All parts step at once with the inputs of the last point.
    "jacobi": Master(schedule.jacobi, 1),
    # As gauss-seidel, torques corrected to the end of the step by their derivatives.
    linearly_implicit.NAME: Master(linearly_implicit.schedule, 0, in_python=True),
}
# The message to whoever asks for the master step-doubling or its tolerance.
FIXED_STEPS = (
    "there is no step-doubling any more; every run estimates the error of its step (step_error) "
    "and names a step that would do"
)
