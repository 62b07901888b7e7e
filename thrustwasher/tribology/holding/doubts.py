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
from .asking import SHARE, next_bit
from .plant import evidence, excludes, learn

MISSED, ANSWERED = 0.4, 1.0  # of the capacity squared: what one step says at most
ENOUGH, BY_NOISE = 0.5, 60.0  # of the same: it is refuted; more for the noise over C H/J squared
LITTLE = 1e-3  # of the capacity: a smaller change says nothing
FADES = 0.9  # of what was missed, at each step of a hold
SETTLES = 20.0  # steps of a hold that show how large its slip usually is
SMALL, TINY = 1e-3, 1e-3  # of the largest slip, of C H/J: a slip that is none
LARGER = 2.0  # times the usual one: it strays
CODED, QUESTIONS = 0.02, 16.0  # of the capacity; steps in which a pack that holds asks again
ROUNDS = 3.0  # of questions: an outside torque that jumps drowns an answer
SURELY = 7.0  # ln of the likelihood, 1000: with it an answer confirms or refutes
ALIKE = 3.0  # standard deviations: two inertias that differ by less are one


@kernel
def is_missed(mem: Array, slip: float) -> bool:
    """Tell if the slip leaves large changes of the torque without the answer that was proved."""
    at = M.TORQUE + int(mem[M.AGE])
    if mem[M.HELD] > 0.0:
        mem[M.MISSED] *= FADES
    change = mem[np.uintp(at)] - mem[np.uintp(at + 1)]
    if mem[M.COUNT] < 5.0 or not abs(change) > LITTLE * mem[M.CAPACITY]:
        return False
    made, change = mem[M.CAPACITY] / mem[M.INERTIA], change / mem[M.INERTIA]
    if not made > 0.0:
        return False
    turn = (slip - mem[M.SLIP]) / mem[M.STEP] - (mem[M.SLIP] - mem[M.SLIP + 1]) / mem[M.STEP + 1]
    more = change * (2.0 * turn + change) / (made * made)  # e^2 - v^2
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


@kernel
def is_strange(mem: Array) -> bool:
    """Tell if a slip that is held has lately been larger than outside torques have left so far."""
    return mem[M.UNSURE] > 0.0 or mem[M.STRAYS] > 1.0 + mem[M.AGE]


@kernel
def asked_in_hold(mem: Array, slip: float, room: float, capacity: float, made: float) -> float:
    """Return the coded torque of a pack that holds [N m], 0 where it has nothing to ask.

    ``room``: what its torque may grow by; ``made``: slip that the capacity makes in a step.
    """
    size, late = abs(slip), 1.0 + mem[M.AGE]
    if mem[M.AGAIN] == 0.0:
        if mem[M.HELD] < SETTLES and mem[M.UNSURE] == 0.0:
            mem[M.USUAL] = max(mem[M.USUAL], size) if mem[M.HELD] > late else 0.0
            mem[M.STRAYS] = 0.0
            return 0.0
        none = max(SMALL * mem[M.MOST_SLIP], TINY * made) + 4.0 * mem[M.NOISE]
        usual = LARGER * mem[M.USUAL] if not 0.0 < mem[M.UNSURE] < ROUNDS else 0.0
        strays = size > none + usual
        mem[M.STRAYS] = mem[M.STRAYS] + 1.0 if strays else max(0.0, mem[M.STRAYS] - 0.5)
        if mem[M.STRAYS] <= 1.0 + 2.0 * late:
            return 0.0
        for i in range(M.ZZ, M.WEIGHT + 1):
            mem[np.uintp(i)] = 0.0
        mem[M.AGAIN], mem[M.TURN], mem[M.STRAYS] = QUESTIONS, 0.0, 0.0
        mem[M.UNSURE] += 1.0
    mem[M.USUAL] = max(mem[M.USUAL], size)
    if room < CODED * capacity:
        return 0.0
    mem[M.AGAIN] -= 1.0
    return CODED * capacity * (0.5 - next_bit(mem))


@kernel
def hear(mem: Array, slip: float) -> bool:
    """Take in the slip of a driveline that is known; tell if it is refuted."""
    missed = is_missed(mem, slip)
    inertia, age, error, noise = mem[M.INERTIA], mem[M.AGE], mem[M.ERROR], mem[M.NOISE]
    learn(mem, slip, 0.0, 0)
    if missed or mem[M.UNSURE] == 0.0:
        return missed
    if evidence(mem, mem[M.INERTIA], int(mem[M.AGE])) > SURELY:
        mem[M.UNSURE] = mem[M.AGAIN] = 0.0
    differs = abs(mem[M.INERTIA] - inertia) > ALIKE * (error + mem[M.ERROR]) * inertia
    if mem[M.AGE] == age and mem[M.ERROR] > error and not differs:
        mem[M.INERTIA], mem[M.ERROR], mem[M.NOISE] = inertia, error, noise
    return excludes(mem, mem[M.INERTIA], int(mem[M.AGE]))
