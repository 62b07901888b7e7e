# mypy: disable-error-code="no-any-return"
"""Friction that drags on a shaft: of a washer, of teeth, of bearings.

It is small beside what else holds the shaft, and asks nothing. Near rest its torque rises over a
speed w in which it cannot chatter: C/w <= 1/(4 b H), b the largest 1/J that the speed's answers do
not exclude. All of the torque counts for that: it is good enough for a bound, though it proves no
plant. Before there are enough answers w doubles where the torque reverses, and narrows after a
while without. A shaft that is held by nothing else creeps: by less than w.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import memory as M
from .memory import Coupling
from .plant import ENOUGH, EXCITED, KEPT, N_AGES, ROUNDING, SEEN, largest_answer
from .reversals import watch
from .torque import note

FLAT = 0.25  # of 1/(b H): the steepest rise of the torque
LEAST = 1e-4  # of the largest speed: w before anything is known
WIDER, NARROWER = 2.0, 0.9
LONG = 20.0  # steps without a reversal


@kernel
def _learn(mem: Array, speed: float) -> None:
    """Take in the speed [rad/s] at the start of a step: what it may answer to the torque."""
    if mem[M.COUNT] < SEEN + 1.0:
        return
    rate_1 = (mem[M.SLIP] - mem[M.SLIP + 1]) / mem[M.STEP + 1]
    rate_2 = (mem[M.SLIP + 1] - mem[M.SLIP + 2]) / mem[M.STEP + 2]
    y = (speed - mem[M.SLIP]) / mem[M.STEP] - 2.0 * rate_1 + rate_2
    if abs(y) * mem[M.STEP] < ROUNDING * mem[M.MOST_SLIP]:
        y = 0.0
    most = 0.0
    for d in range(N_AGES):
        at = M.TORQUE + d
        x = mem[np.uintp(at)] - 2.0 * mem[np.uintp(at + 1)] + mem[np.uintp(at + 2)]
        most = max(most, abs(x))
    if not most > EXCITED * mem[M.MOST_CAPACITY]:
        return
    for d in range(N_AGES):
        at = M.TORQUE + d
        x = mem[np.uintp(at)] - 2.0 * mem[np.uintp(at + 1)] + mem[np.uintp(at + 2)]
        mem[np.uintp(M.ZZ + d)] = KEPT * mem[np.uintp(M.ZZ + d)] + x * x
        mem[np.uintp(M.ZY + d)] = KEPT * mem[np.uintp(M.ZY + d)] - x * y
    mem[M.YY] = KEPT * mem[M.YY] + y * y
    mem[M.WEIGHT] = KEPT * mem[M.WEIGHT] + 1.0


@kernel
def _notice(mem: Array, speed: float, capacity: float) -> None:
    """Take in the speed at the start of a step, and widen or narrow w."""
    mem[M.MOST_SLIP] = max(mem[M.MOST_SLIP], abs(speed))
    watch(mem, speed, capacity, True)
    _learn(mem, speed)
    least = LEAST * mem[M.MOST_SLIP]
    mem[M.CALM] += 1.0
    if mem[M.REVERSES] > 0.0:
        mem[M.CALM] = 0.0
        if mem[M.WEIGHT] < ENOUGH:
            mem[M.WIDTH] = WIDER * max(mem[M.WIDTH], least)
    elif mem[M.CALM] > LONG or mem[M.WEIGHT] >= ENOUGH:
        mem[M.WIDTH] *= NARROWER
    mem[M.WIDTH] = max(mem[M.WIDTH], least)


@kernel
def width_of(coupling: Coupling, mem: Array, h: float, capacity: float) -> float:
    """Return the speed [rad/s] over which the torque rises in a step of ``h`` [s]."""
    mode, inertia, _, own, _ = coupling
    if mode == M.OFF:
        return own
    answer, width = largest_answer(mem), mem[M.WIDTH]
    if mode == M.GIVEN:
        answer, width = 1.0 / inertia, 0.0
    return max(max(own, width), answer * max(h, mem[M.STEP]) * capacity / FLAT)


@kernel
def hold_drag(
    coupling: Coupling, mem: Array, speed: float, dt: float, torque: float, capacity: float
) -> tuple[float, bool, float]:
    """Return the torque to apply [N m], if it is less than that of sliding, its further slope.

    ``torque`` is that of sliding at this speed [rad/s], risen over the own width, ``capacity`` its
    size once it has risen, 0 at rest: there that of the last step counts. The share of the torque
    grows with the speed; torque times this slope is the third number. With ``dt`` > 0 [s] all goes
    to the memory.
    """
    mode, _, _, own, _ = coupling
    if speed == 0.0:
        capacity = max(capacity, mem[M.CAPACITY])
    if dt > 0.0:
        if mode == M.OFF:
            watch(mem, speed, capacity, False)
            mem[M.MOST_SLIP] = max(mem[M.MOST_SLIP], abs(speed))
        else:
            _notice(mem, speed, capacity)
    given, less, slope = torque, False, 0.0
    width = width_of(coupling, mem, dt, capacity)
    if width > own and speed != 0.0:
        size, full, by_own = abs(speed), 1.0, 0.0
        if own > 0.0:
            full = math.tanh(size / own)
            by_own = (1.0 - full) * (1.0 + full) / own
        risen = math.tanh(size / width)
        by_width = (1.0 - risen) * (1.0 + risen) / width
        given, less = torque * risen / full, True
        slope = torque * math.copysign(1.0, speed) * (by_width - risen / full * by_own) / full
    if dt > 0.0:
        note(coupling, mem, speed, dt, given, 0.0, capacity, False)
    return given, less, slope
