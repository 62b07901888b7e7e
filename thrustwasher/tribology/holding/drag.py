# mypy: disable-error-code="no-any-return"
"""Friction that drags on a shaft: of a washer, of teeth, of bearings.

It is small beside what else holds the shaft, and asks nothing. Near rest its torque C rises over a
speed w wide enough not to chatter: C/w <= J/(2 (1 + d) H), d the age of the torque. With J and d
given that is w; else w doubles where the torque swings to the other side again within some steps,
and narrows once the shaft has left rest. A shaft that nothing else holds creeps under a load: by
about w times its share of C.
"""

import math

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import memory as M
from .memory import Coupling
from .reversals import watch
from .torque import note

FLAT = 0.5  # of J/((1 + d) H): the steepest rise of the torque
LEAST = 1e-4  # of the largest speed: w where nothing has reversed and there is no own one
SWUNG = 0.1  # of the capacity: a torque that differs less from its mean has not swung
FOLLOWS = 0.05  # of the mean, in a step
WIDER, NARROWER = 2.0, 0.9
AGAIN = 20.0  # steps within which a reversal follows another one
LEFT = 3.0  # times w: a shaft that is faster for so long has left rest


@kernel
def _notice(mem: Array, speed: float, capacity: float, own: float) -> None:
    """Take in the speed [rad/s] at the start of a step, and widen or narrow w."""
    mem[M.MOST_SLIP] = max(mem[M.MOST_SLIP], abs(speed))
    watch(mem, speed, capacity, True)
    swing, turned = mem[M.TORQUE] - mem[M.MEAN], False
    mem[M.MEAN] += FOLLOWS * swing
    if abs(swing) > SWUNG * capacity:
        turned = swing * mem[M.LEANS] < 0.0
        mem[M.LEANS] = sign_of(swing)
    if turned:
        if mem[M.CALM] <= AGAIN and mem[M.COUNT] > AGAIN:
            mem[M.WIDTH] *= WIDER
        mem[M.CALM] = 0.0
    elif abs(speed) < LEFT * mem[M.WIDTH]:
        mem[M.CALM] = min(mem[M.CALM] + 1.0, AGAIN + 1.0)
    else:
        mem[M.CALM] += 1.0
        if mem[M.CALM] > 2.0 * AGAIN:
            mem[M.WIDTH] *= NARROWER
    mem[M.WIDTH] = max(mem[M.WIDTH], own if own > 0.0 else LEAST * mem[M.MOST_SLIP])


@kernel
def width_of(coupling: Coupling, mem: Array, h: float, capacity: float) -> float:
    """Return the speed [rad/s] over which the torque rises in a step of ``h`` [s]."""
    mode, inertia, age, own, _ = coupling
    if mode == M.OFF:
        return own
    if mode == M.GIVEN:
        return max(own, (1.0 + age) * max(h, mem[M.STEP]) * capacity / (inertia * FLAT))
    return max(own, mem[M.WIDTH])


@kernel
def share_of(coupling: Coupling, mem: Array, speed: float, h: float, capacity: float) -> float:
    """Return the torque over that of sliding, which has risen over its own width."""
    own, width = coupling[3], width_of(coupling, mem, h, capacity)
    if not width > own:
        return 1.0
    if speed == 0.0:
        return own / width
    full = math.tanh(abs(speed) / own) if own > 0.0 else 1.0
    return math.tanh(abs(speed) / width) / full


@kernel
def slope_of_share(
    coupling: Coupling, mem: Array, speed: float, h: float, capacity: float
) -> float:
    """Return the slope of that share over the speed [s/rad]."""
    own, width = coupling[3], width_of(coupling, mem, h, capacity)
    if not width > own or speed == 0.0:
        return 0.0
    full, by_own = 1.0, 0.0
    if own > 0.0:
        full = math.tanh(abs(speed) / own)
        by_own = (1.0 - full) * (1.0 + full) / own
    risen = math.tanh(abs(speed) / width)
    by_width = (1.0 - risen) * (1.0 + risen) / width
    return sign_of(speed) * (by_width - risen / full * by_own) / full


@kernel
def slope_over_capacity(
    coupling: Coupling, mem: Array, speed: float, h: float, capacity: float
) -> float:
    """Return the slope of that share over the logarithm of the capacity."""
    own, width = coupling[3], width_of(coupling, mem, h, capacity)
    if coupling[0] != M.GIVEN or not width > own or speed == 0.0:
        return 0.0
    full = math.tanh(abs(speed) / own) if own > 0.0 else 1.0
    risen = math.tanh(abs(speed) / width)
    return -abs(speed) / width * (1.0 - risen) * (1.0 + risen) / full


@kernel
def hold_drag(
    coupling: Coupling, mem: Array, speed: float, dt: float, torque: float, capacity: float
) -> tuple[float, float]:
    """Return the torque to apply [N m], and its share of that of sliding.

    ``torque`` is that of sliding at this speed [rad/s], risen over its own width, ``capacity`` its
    size once it has risen, 0 at rest: there that of the last step counts. With ``dt`` > 0 [s] all
    goes to the memory.
    """
    mode, _, _, own, _ = coupling
    if speed == 0.0:
        capacity = max(capacity, mem[M.CAPACITY])
    if dt > 0.0:
        if mode == M.OFF:
            watch(mem, speed, capacity, False)
            mem[M.MOST_SLIP] = max(mem[M.MOST_SLIP], abs(speed))
        else:
            _notice(mem, speed, capacity, own)
    share = share_of(coupling, mem, speed, dt, capacity)
    given = torque if share == 1.0 else share * torque
    if dt > 0.0:
        note(coupling, mem, speed, dt, given, 0.0, capacity, False)
    return given, share
