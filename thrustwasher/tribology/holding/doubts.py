# mypy: disable-error-code="no-any-return"
"""Doubts about a driveline that was proved: it may be another one by now, or none.

With inertia J and age d the slip answers a change p of the torque that acts by -p/J:

    v = D[(s_n - s_(n-1))/H_(n-1)],  p = D[T_(n-1-d)],  e = v + p/J.

e is what outside torques have changed. They are slow, or jump now and then; they do not follow the
pack's own torque step by step. Derived in docs/theory/holding.md.
"""

import numpy as np

from ...numerics.jit import Array, kernel
from . import memory as M
from .asking import SHARE

MISSED, ANSWERED = 0.4, 1.0  # of the capacity squared: what one step says at most
ENOUGH, BY_NOISE = 0.5, 60.0  # of the same: it is refuted; more for the noise over C H/J squared
FADES = 0.9  # of what was missed, at each step of a hold


@kernel
def is_missed(mem: Array, slip: float) -> bool:
    """Tell if the slip leaves large changes of the torque without the answer that was proved."""
    age, made = int(mem[M.AGE]), mem[M.CAPACITY] / mem[M.INERTIA]
    if mem[M.COUNT] < 5.0 or not made > 0.0:
        return False
    change = (mem[M.TORQUE + age] - mem[M.TORQUE + age + 1]) / mem[M.INERTIA]
    turn = (slip - mem[M.SLIP]) / mem[M.STEP] - (mem[M.SLIP] - mem[M.SLIP + 1]) / mem[M.STEP + 1]
    more = change * (2.0 * turn + change) / (made * made)  # e^2 - v^2
    if mem[M.HELD] > 0.0:
        mem[M.MISSED] *= FADES
    mem[M.MISSED] = max(0.0, mem[M.MISSED] + min(MISSED, max(-ANSWERED, more)))
    loud = mem[M.NOISE] / (made * mem[M.STEP])
    return mem[M.MISSED] > ENOUGH + BY_NOISE * loud * loud


@kernel
def ask_anew(mem: Array) -> None:
    """Let a pack whose driveline is refuted ask as in a new engagement, as clear as need be now."""
    mem[M.TURN], mem[M.ASKED], mem[M.SPENT], most = 0.0, 0.0, SHARE * mem[M.HEAT], 0.0
    for k in range(2):
        at = M.SLIP + k
        turn = mem[np.uintp(at + 1)] - mem[np.uintp(at + 2)]
        third = mem[np.uintp(at)] - mem[np.uintp(at + 3)] - 3.0 * turn
        most = max(most, third * third)
    mem[M.ROUGH] = min(mem[M.ROUGH], most)
