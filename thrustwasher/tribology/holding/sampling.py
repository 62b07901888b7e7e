# mypy: disable-error-code="no-any-return"
"""A speed that comes anew only every k steps, again and again: the pack then steps with it.

A sensor that is read at its own rate, or a master that repeats its steps, shows the same slip to
the bit k times. Steps between two new slips are no steps of the driveline: the pack gives the last
torque on, and takes them as one step that is longer.
"""

import numpy as np

from ...numerics.jit import Array, kernel
from . import memory as M
from .asking import N_AGES
from .memory import Coupling
from .plant import forget

OFTEN = 5.0  # times that the slip came to the bit again, over the same number of steps: it is held
SURELY = 2.0  # times at least, where it is the same so often in all


@kernel
def _begin_anew(mem: Array) -> None:
    """Forget what steps of another length have told."""
    forget(mem)
    mem[M.TURN] = mem[M.ASKED] = mem[M.CLOSED] = 0.0
    mem[M.REVERSALS] = mem[M.AWAY] = mem[M.HEAT_AGE] = 0.0
    mem[M.SINCE] = mem[M.COUNT]


@kernel
def _stretch_work(mem: Array, slip: float) -> None:
    """Make the work that the torques did at each age that of ages in longer steps.

    It changes with the age as between 0 and 2; the torque of the initialization acted. A slip that
    is held is late by half of what it is held longer than a step.
    """
    first = mem[M.FIRST] * (mem[M.FIRST + 5] + mem[M.FIRST + 6])
    late = 0.25 * (mem[M.EVERY] - 1.0) * mem[M.STEP] * (abs(mem[M.FIRST]) + mem[M.CAPACITY])
    change = 0.5 * (mem[M.WORK + 2] + first - mem[M.WORK]) * mem[M.EVERY]
    mem[M.FIRST] = 0.0
    mem[M.WORK] -= late * (mem[M.MOST_SLIP] - abs(slip))
    for k in range(1, N_AGES):
        mem[np.uintp(M.WORK + k)] = mem[M.WORK] + k * change


@kernel
def repeats(coupling: Coupling, mem: Array, slip: float) -> bool:
    """Tell if the slip [rad/s] of a step is that of the last one, and no new one."""
    if coupling[0] != M.IDENTIFIED or mem[M.COUNT] == 0.0:
        return False
    if mem[M.EVERY] == 0.0:
        again = mem[M.REPEATED] == mem[M.REPEATED + 1]
        sure = mem[M.REPEATS] >= SURELY and mem[M.REPEATS] * mem[M.REPEATED] >= OFTEN
        if sure and again and slip != mem[M.SLIP]:
            mem[M.EVERY], mem[M.PHASE] = mem[M.REPEATED] + 1.0, 1.0
            _stretch_work(mem, slip)
            _begin_anew(mem)
        return False
    if mem[M.PHASE] >= mem[M.EVERY]:
        mem[M.PHASE] = 1.0
        return False
    if slip == mem[M.SLIP]:
        mem[M.PHASE] += 1.0
        return True
    mem[M.EVERY] = mem[M.REPEATS] = mem[M.REPEATED] = 0.0
    _begin_anew(mem)
    return False


@kernel
def span_of(mem: Array, h: float) -> float:
    """Return the time to the next new slip [s], in steps of ``h`` [s]."""
    return h * max(1.0, mem[M.EVERY])


@kernel
def is_again(mem: Array) -> bool:
    """Tell if the step whose slip was taken in last is a part of the one before."""
    return mem[M.EVERY] > 0.0 and mem[M.PHASE] > 1.0


@kernel
def held_over(mem: Array) -> float:
    """Return over how many steps the slip is the same, again and again; 0 if it is not."""
    if mem[M.EVERY] > 0.0:
        return mem[M.EVERY]
    return mem[M.REPEATED + 1] + 1.0 if mem[M.REPEATS] >= OFTEN else 0.0


@kernel
def extend(mem: Array, h: float, torque: float, capacity: float) -> None:
    """Make a step of ``h`` [s] a part of the last one, whose torque [N m] is the mean of both."""
    share, before = h / (mem[M.STEP] + h), mem[M.CAPACITY]
    mem[M.CAPACITY] += share * (capacity - before)
    mem[M.TORQUE] += share * (torque - mem[M.TORQUE])
    if mem[M.HELD] == 0.0 and before > 0.0:
        mem[M.CODED] *= mem[M.CAPACITY] / before
    mem[M.STEP] += h
    mem[M.CLOCK] += h
    mem[M.LONGEST] = max(mem[M.LONGEST], mem[M.STEP])
    mem[M.MOST_CAPACITY] = max(mem[M.MOST_CAPACITY], capacity)
