# mypy: disable-error-code="no-any-return"
"""Friction that drags on a shaft: of a washer, of teeth. Where the shaft could stand, it holds it.

While the parts slide the torque is what it is without: nothing dips, nothing is smoothed. Only
where the driveline is known well, by reversals or by what the torque did on the way to rest, and
the torque that ends the speed with the step is less than sliding takes, that torque is given.
"""

from ...numerics.jit import Array, kernel
from . import memory as M
from .memory import Coupling
from .plant import UNSURE
from .torque import hold, knows, note, notice


@kernel
def hold_drag(
    coupling: Coupling, mem: Array, speed: float, dt: float, torque: float, capacity: float
) -> tuple[float, bool, float]:
    """Return the torque to apply [N m], if it holds, its slope over the speed where it does.

    ``torque`` is that of sliding at this speed [rad/s], ``capacity`` its size, 0 at rest: there
    that of the last step counts. With ``dt`` > 0 [s] it all goes to the memory; else at the speed
    that was given last it is the torque given then.
    """
    mode, _, _, _, _ = coupling
    if speed == 0.0:
        capacity = max(capacity, mem[M.CAPACITY])
    if dt > 0.0:
        notice(coupling, mem, speed, capacity)
    elif mem[M.HELD] > 0.0 and speed == mem[M.SLIP]:
        return min(capacity, max(-capacity, mem[M.TORQUE])), True, 0.0
    given, holds, slope, outside = torque, False, 0.0, mem[M.OUTSIDE]
    step = dt if dt > 0.0 else mem[M.STEP]
    sure = mode == M.GIVEN or (mode == M.IDENTIFIED and mem[M.ERROR] < UNSURE)
    if sure and knows(coupling, mem, step):
        found, holds, by_speed, _, _, outside = hold(coupling, mem, speed, step, capacity, 0.0)
        if holds or found * torque < 0.0 or speed == 0.0:
            given, slope = found, by_speed
    if dt > 0.0:
        note(mem, speed, dt, given, holds, outside, False)
        mem[M.CAPACITY] = capacity
    return given, holds, slope
