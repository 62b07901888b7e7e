# mypy: disable-error-code="no-any-return"
"""Reversals of the slip that the torque went along with: chatter, if there are more than three."""

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import memory as M

COUNTED = 1e-3  # of the largest slip: a smaller one has no sign
SWUNG = 0.5  # of the capacity: a reversal by less is no chatter
FADES = 0.98  # of what was counted, at each step
OLDER = 0.99  # of the two half swings before
N_ROW = 4  # reversals that are chatter, within ...
SPAN, SPAN_STEPS = 0.5, 10.0  # s, or steps where these are longer
ROW = 30.0  # steps in which three are chatter where nothing is held; for which chatter is told


@kernel
def watch(mem: Array, slip: float, capacity: float, holds: bool) -> None:
    """Count reversals of the slip that the torque went along with; follow its swings.

    ``holds``: friction holds, or could; else it passes through zero as it does.
    """
    n = mem[M.COUNT]
    if n >= 2.0:
        mem[M.SWING] = max(mem[M.SWING], abs(mem[M.TORQUE] - mem[M.TORQUE + 1]))
    mem[M.REVERSES] = 0.0
    mem[M.REVERSALS] *= FADES
    mem[M.AMPLITUDE] = max(FADES * mem[M.AMPLITUDE], abs(slip))
    mem[M.AMPLITUDE + 1] *= OLDER
    mem[M.AMPLITUDE + 2] *= OLDER
    if abs(slip) <= COUNTED * mem[M.MOST_SLIP] + 2.0 * mem[M.NOISE]:
        return
    side = sign_of(slip)
    if side == -mem[M.SIGN]:
        if mem[M.SWING] > SWUNG * capacity:
            mem[M.REVERSES] = 1.0
            mem[M.REVERSALS] += 1.0
            mem[M.STUCK] = 0.0
            if not holds:
                _in_steps(mem)
            elif mem[M.QUIET] == 0.0:
                _in_time(mem)
        mem[M.AMPLITUDE + 2], mem[M.AMPLITUDE + 1] = mem[M.AMPLITUDE + 1], mem[M.AMPLITUDE]
        mem[M.AMPLITUDE], mem[M.SWING] = abs(slip), 0.0
    mem[M.SIGN] = side


@kernel
def count_repeats(mem: Array, slip: float) -> None:
    """Count how often the slip has come again to the bit, over the same number of steps.

    A speed that is held jumps by what it has become meanwhile, one that is rounded by a quantum:
    equal jumps do not count.
    """
    if mem[M.COUNT] == 0.0 or mem[M.EVERY] > 0.0:
        return
    jump = abs(slip - mem[M.SLIP])
    if jump == 0.0:
        mem[M.REPEATED] += 1.0
        return
    again = mem[M.REPEATED] > 0.0 and mem[M.REPEATED] == mem[M.REPEATED + 1]
    varies = abs(jump - mem[M.JUMP]) > 1e-6 * jump
    mem[M.REPEATS] = mem[M.REPEATS] + 1.0 if again and varies else 0.0
    mem[M.REPEATED + 1], mem[M.REPEATED], mem[M.JUMP] = mem[M.REPEATED], 0.0, jump


@kernel
def _in_steps(mem: Array) -> None:
    """Note the step of a reversal; three in a row are chatter."""
    n = mem[M.COUNT]
    if mem[M.REVERSED + 1] > 0.0 and n - mem[M.REVERSED + 1] < ROW:
        mem[M.CHATTER] = n + ROW
        mem[M.REVERSED + 1] = mem[M.REVERSED] = 0.0
    else:
        mem[M.REVERSED + 1], mem[M.REVERSED] = mem[M.REVERSED], n


@kernel
def _in_time(mem: Array) -> None:
    """Note the time of a reversal; more than three within the span are chatter."""
    for k in range(N_ROW - 1, 0, -1):
        mem[np.uintp(M.REVERSED + k)] = mem[np.uintp(M.REVERSED + k - 1)]
    mem[M.REVERSED] = mem[M.CLOCK]
    oldest = mem[M.REVERSED + N_ROW - 1]
    if oldest > 0.0 and mem[M.CLOCK] - oldest <= max(SPAN, SPAN_STEPS * mem[M.STEP]):
        mem[M.CHATTER] = mem[M.COUNT] + ROW


@kernel
def chatters(mem: Array) -> bool:
    """Tell if the slip has lately reversed again and again."""
    return mem[M.COUNT] < mem[M.CHATTER]


@kernel
def calm(mem: Array) -> None:
    """Forget the reversals: the pack was open."""
    for k in range(N_ROW):
        mem[np.uintp(M.REVERSED + k)] = 0.0
    mem[M.REVERSALS] = mem[M.CHATTER] = 0.0
