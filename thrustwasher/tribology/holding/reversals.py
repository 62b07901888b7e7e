# mypy: disable-error-code="no-any-return"
"""Reversals of the slip: three in a row that the torque went along with are chatter."""

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import memory as M
from .plant import doubt

COUNTED = 1e-3  # of the largest slip: a smaller one has no sign
SWUNG = 0.5  # of the capacity: a reversal by less is no chatter
ROW = 30.0  # steps in which three reversals are chatter
SLOWEST = 0.3  # share of the slip that is ended in a step, at least


@kernel
def watch(mem: Array, slip: float, capacity: float) -> None:
    """Count reversals of the slip that the torque went along with; three in a row are chatter."""
    n = mem[M.COUNT]
    if n > 1.0:
        mem[M.SWING] = max(mem[M.SWING], abs(mem[M.TORQUE] - mem[M.TORQUE + 1]))
    mem[M.REVERSES] = 0.0
    if abs(slip) <= COUNTED * mem[M.MOST_SLIP]:
        return
    side = sign_of(slip)
    if side == -mem[M.SIGN]:
        if mem[M.SWING] > SWUNG * capacity:
            mem[M.REVERSES] = 1.0
            mem[M.NARROWED] = max(0.0, 2.0 * mem[M.NARROWED] - 1.0)
            if mem[M.REVERSED + 1] > 0.0 and n - mem[M.REVERSED + 1] < ROW:
                mem[M.CHATTER] = n + ROW
                mem[M.CAUTION] = min(1.0 - SLOWEST, 0.4 + 0.6 * mem[M.CAUTION])
                doubt(mem)
                mem[M.REVERSED + 1] = mem[M.REVERSED] = 0.0
            else:
                mem[M.REVERSED + 1], mem[M.REVERSED] = mem[M.REVERSED], n
        mem[M.SWING] = 0.0
    mem[M.SIGN] = side


@kernel
def chatters(mem: Array) -> bool:
    """Tell if the slip has lately reversed again and again."""
    return mem[M.COUNT] < mem[M.CHATTER]
