# mypy: disable-error-code="no-any-return"
"""Friction that drags on a shaft: of a washer, of teeth, of bearings.

It is small beside what else holds the shaft, and asks nothing. Near rest its torque C rises over a
speed w wide enough not to chatter: C/w <= J/(2 (1 + d) H), d the age of the torque. With J and d
given that is w, for the capacity of the last step; else w doubles where the torque swings to the
other side again within some steps, and narrows once the shaft has left rest. It never exceeds
4 b C H, b the largest 1/J that the answers of the speed to the torque do not exclude: a speed that
does not answer, as a prescribed one, leaves the friction as it is. A shaft that nothing else holds
creeps under a load: by about w times its share of C.

w stands before the torque of a step is known. So heat, temperatures and torque are those of one
torque, and its power is torque times speed.
"""

import math

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import memory as M
from .memory import Coupling
from .plant import largest_answer, learn
from .reversals import watch
from .torque import note

FLAT = 0.5  # of J/((1 + d) H): the steepest rise of the torque
BROADEST = 4.0  # times b C H
LEAST = 1e-4  # of the largest speed: w where nothing has reversed and there is no own one
SWUNG = 0.1  # of the capacity: a torque that differs less from its mean has not swung
FOLLOWS = 0.05  # of the mean, in a step
WIDER, NARROWER = 2.0, 0.9
AGAIN = 20.0  # steps within which a reversal follows another one
AT_ONCE = 4.0  # the same, of a shaft that is to be at rest
LEAST_SHARE = 1e-100
LEFT = 3.0  # times w: a shaft that is faster for so long has left rest


@kernel
def _notice(mem: Array, speed: float, h: float, own: float) -> None:
    """Take in the speed [rad/s] at the start of a step of ``h`` [s], and widen or narrow w."""
    capacity = mem[M.CAPACITY]
    mem[M.MOST_SLIP] = max(mem[M.MOST_SLIP], abs(speed))
    watch(mem, speed, capacity, True)
    learn(mem, speed, 0.0, 0)
    swing, turned = mem[M.TORQUE] - mem[M.MEAN], False
    mem[M.MEAN] += FOLLOWS * swing
    if abs(swing) > SWUNG * capacity:
        turned = swing * mem[M.LEANS] < 0.0
        mem[M.LEANS] = sign_of(swing)
    if turned:
        if mem[M.CALM] <= AT_ONCE and mem[M.COUNT] > mem[M.CALM] + 1.0:
            mem[M.WIDTH] = max(mem[M.WIDTH], abs(speed - mem[M.SLIP]))
        if mem[M.CALM] <= AGAIN and mem[M.COUNT] > AGAIN:
            mem[M.WIDTH] *= WIDER
        mem[M.CALM] = 0.0
    elif abs(speed) < LEFT * mem[M.WIDTH]:
        mem[M.CALM] = min(mem[M.CALM] + 1.0, AGAIN + 1.0)
    else:
        mem[M.CALM] += 1.0
        if mem[M.CALM] > 2.0 * AGAIN:
            mem[M.WIDTH] *= NARROWER
    broadest = BROADEST * largest_answer(mem) * capacity * max(h, mem[M.STEP])
    if broadest > 0.0:
        mem[M.WIDTH] = min(mem[M.WIDTH], broadest)
    mem[M.WIDTH] = max(mem[M.WIDTH], own if own > 0.0 else LEAST * mem[M.MOST_SLIP])


@kernel
def width_at(coupling: Coupling, mem: Array, speed: float, h: float) -> float:
    """Return the speed [rad/s] over which the torque of a step of ``h`` [s] rises; 0: at once.

    With ``h`` > 0 the ``speed`` at the start of the step [rad/s] goes to the memory.
    """
    mode, inertia, age, own, _ = coupling
    if h > 0.0:
        if mode == M.OFF:
            watch(mem, speed, mem[M.CAPACITY], False)
            mem[M.MOST_SLIP] = max(mem[M.MOST_SLIP], abs(speed))
        else:
            _notice(mem, speed, h, own)
    if mode == M.OFF:
        return own
    if mode == M.GIVEN:
        made = max(h, mem[M.STEP]) * mem[M.CAPACITY] / inertia
        return max(own, (1.0 + age) * made / FLAT)
    return max(own, mem[M.WIDTH])


@kernel
def risen(speed: float, width: float) -> tuple[float, float]:
    """Return the share of the torque of sliding that is given, and its slope over the speed."""
    if not width > 0.0 or speed == 0.0:
        return 1.0, 0.0
    share = max(math.tanh(abs(speed) / width), LEAST_SHARE)
    return share, sign_of(speed) * (1.0 - share) * (1.0 + share) / width


@kernel
def keep(
    coupling: Coupling, mem: Array, speed: float, h: float, torque: float, capacity: float
) -> None:
    """Keep the torque that was given in a step, and its size once it has risen [N m].

    At rest, where friction has no size, that of the last step counts.
    """
    if speed == 0.0:
        capacity = max(capacity, mem[M.CAPACITY])
    note(coupling, mem, speed, h, torque, torque, capacity, False)


@kernel
def wants_capacity(coupling: Coupling, mem: Array, speed: float, h: float) -> bool:
    """Tell if the capacity has to be known before the first step."""
    return coupling[0] == M.GIVEN and h > 0.0 and mem[M.COUNT] == 0.0 and speed != 0.0
