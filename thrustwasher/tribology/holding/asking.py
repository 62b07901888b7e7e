# mypy: disable-error-code="no-any-return"
"""The code by which a pack asks: it lowers its torque where a bit is 1.

Only a torque that owes nothing to the slip can prove a driveline. The first bits are fixed: of
sines of any frequency none looks like them within 5 to 24 samples. A shift register of 16 bits
follows, with period 65535.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import memory as M

FIRST_BITS, N_FIRST = 0b10011100000111011011000111, 26  # the first bit is the highest
SEED = 0xACE1
N_AGES = 3  # of the torque: it acts up to two steps late
FAINT, DEEPEST = 0.02, 0.5  # of the torque
CLEAR = 8.0  # times the third difference of the slip: how far an answer is to stand out
NEAR, NEAR_GIVEN = 14.0, 30.0  # steps to zero at the last rate; where it would hold before it asks
FIRST_STEPS = 10.0  # of an engagement, in which it asks faintly wherever the slip is
FREE = 12.0  # steps of asking near zero in an engagement, whatever they cost
SHARE = 0.003  # of the heat: what more may cost
SURE = 0.02  # relative standard deviation of the inertia: no more asking


@kernel
def next_bit(mem: Array) -> float:
    """Return the next bit of the code."""
    turn = int(mem[M.TURN])
    mem[M.TURN] += 1.0
    if turn < N_FIRST:
        return float((FIRST_BITS >> (N_FIRST - 1 - turn)) & 1)
    bits = int(mem[M.REGISTER])
    if bits == 0:
        bits = SEED
    new = (bits ^ (bits >> 2) ^ (bits >> 3) ^ (bits >> 5)) & 1
    mem[M.REGISTER] = float((bits >> 1) | (new << 15))
    return float(new)


@kernel
def rate_of(mem: Array, slip: float) -> float:
    """Return the mean change of the slip a step over the last four [rad/s]."""
    if mem[M.COUNT] - mem[M.SINCE] >= 4.0:
        return 0.25 * abs(slip - mem[M.SLIP + 3])
    return largest_move(mem, slip)


@kernel
def largest_move(mem: Array, slip: float) -> float:
    """Return the largest change of the slip over one of the last three steps [rad/s]."""
    n, most = mem[M.COUNT] - mem[M.SINCE], 0.0
    if n >= 1.0:
        most = abs(slip - mem[M.SLIP])
    for k in range(2):
        if n >= k + 2.0:
            most = max(most, abs(mem[np.uintp(M.SLIP + k)] - mem[np.uintp(M.SLIP + k + 1)]))
    return most


@kernel
def is_near(mem: Array, slip: float, steps: float) -> bool:
    """Tell if the slip will be zero in so many steps, or cannot be told from it."""
    return abs(slip) <= steps * rate_of(mem, slip) + 3.0 * math.sqrt(mem[M.ROUGH])


@kernel
def is_clean(mem: Array, slip: float) -> bool:
    """Tell if the speeds are so smooth that an answer to the faintest question stands out."""
    return CLEAR * math.sqrt(mem[M.ROUGH]) <= FAINT * rate_of(mem, slip)


@kernel
def share_asked(mem: Array, slip: float, near: bool, proved: bool) -> float:
    """Return the share of the torque that a bit takes away now, 0 where nothing is to be asked.

    ``proved``: the plant is known well.
    """
    early = 1.0 <= mem[M.CLOSED] <= FIRST_STEPS
    if proved or mem[M.COUNT] < 1.0 or not (near or early):
        return 0.0
    if not (mem[M.ASKED] < FREE or mem[M.SPENT] < SHARE * mem[M.HEAT]):
        return 0.0
    if not near:
        return FAINT
    rate = max(rate_of(mem, slip), 1e-300)
    return min(DEEPEST, max(FAINT, CLEAR * math.sqrt(mem[M.ROUGH]) / rate))
