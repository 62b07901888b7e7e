"""What a finished shift is judged by, read from its signals; reports and pages call the same.

Signals (n,) belong to points in time (n,) [s] that rise. What there is not is NaN.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel

JERK_TIME = 0.01  # s over which a change of acceleration counts
SETTLED = 0.1  # s after the shift's end: the new gear's acceleration
FEW = 3  # lock-ups of one pack; so many are stick-slip
# places of `comfort`: each with its time [s] behind it
JERK, FLARE, HOLE, N_COMFORT = range(0, 8, 2)


@kernel
def interpolated(x: float, xs: Array, ys: Array) -> float:
    """Return the value at ``x`` of points over rising ``xs``, as numpy.interp does."""
    low, high = 0, xs.size - 1
    if x <= xs[low]:
        return float(ys[low])
    if x >= xs[high]:
        return float(ys[high])
    while high - low > 1:
        middle = (low + high) // 2
        if xs[np.uintp(middle)] <= x:
            low = middle
        else:
            high = middle
    i, k = np.uintp(low), np.uintp(low + 1)
    return float((ys[k] - ys[i]) / (xs[k] - xs[i]) * (x - xs[i]) + ys[i])


@kernel
def standstill(begin: float, end: float, power: float, heat: float) -> float:
    """Return when [s] a held drum came to rest in a step, by the brake's heat [J] of that step.

    Slip falls to zero in proportion to time, so heat = power at the step's start x time / 2.
    """
    return end if power == 0.0 else min(end, begin + 2.0 * heat / power)


@kernel
def held_from(locks: Array, released: Array, start: float, until: float) -> float:
    """Return the lock [s] after which a pack holds ``until`` its wanted release.

    ``locks``, ``released``: when it locked and slipped again, rising; locks before ``start`` do not
    count. NaN: it slips at last, or still sticks and slips in turn for as long as it already did.
    """
    count, first, last = 0, math.nan, math.nan
    for k in range(locks.size):
        if start <= locks[k] <= until:
            first = locks[k] if count == 0 else first
            last = locks[k]
            count += 1
    for k in range(released.size):
        if last <= released[k] <= until:
            return math.nan
    return math.nan if count >= FEW and until - last <= last - first else last


@kernel
def slip_end(
    time: Array,
    clutch_load: Array,
    clutch_slip: Array,
    brake_load: Array,
    brake_slip: Array,
    start: float,
) -> int:
    """Return the point from which no pressed pack slips any more; -1: one still does, none did.

    A pack without load may turn on: it drags, but takes no part in the shift.
    """
    last = -1
    for k in range(time.size):
        slips = clutch_load[k] > 0.0 and clutch_slip[k] != 0.0
        slips = slips or (brake_load[k] > 0.0 and brake_slip[k] != 0.0)
        if slips and time[k] >= start:
            last = k
    return last + 1 if 0 <= last < time.size - 1 else -1


@kernel
def shift_heat(time: Array, heat: Array, start: float, end: int) -> float:
    """Return the heat [J] taken up from the ``start`` [s] of a shift to the ``end`` of its slip."""
    return float(heat[end] - interpolated(start, time, heat)) if end >= 0 else math.nan


@kernel
def comfort(
    time: Array,
    felt: Array,
    engine: Array,
    output: Array,
    ratio: float,
    start: float,
    lock: float,
    end: float,
    found: Array,
) -> None:
    """Fill jerk [m/s3], the engine's flare [rad/s] and torque hole [m/s2] of a shift, with times.

    symbol          meaning                                                   unit
    felt            acceleration of the vehicle                               m/s2
    engine, output  speeds                                                    rad/s
    ratio           engine's speed over the output's in first gear            -
    start           of the shift                                              s
    lock, end       where the pack that engages holds, where the last slip    s
                    ends; NaN: not

    The hole is what is missing to the smaller of two accelerations, that at the start of the shift
    and that settled after it. In an upshift this is the one after, in a downshift the one before:
    what the new gear gives or takes for good is no hole.
    """
    for k in range(N_COMFORT):
        found[k] = math.nan
    n, last = time.size, time[time.size - 1]
    most, at = -1.0, 0
    for k in range(n):
        if start <= time[k] <= last - JERK_TIME:
            change = abs(interpolated(time[k] + JERK_TIME, time, felt) - felt[k])
            if change > most:
                most, at = change, k
    found[JERK] = abs(interpolated(time[at] + JERK_TIME, time, felt) - felt[at]) / JERK_TIME
    found[JERK + 1] = time[at]
    way = -1.0 if interpolated(start, time, engine) < 0.0 else 1.0
    most, until = -math.inf, last if math.isnan(lock) else lock
    for k in range(n):
        if start <= time[k] <= until:
            above = way * (engine[k] - ratio * output[k])
            if above > most:
                most, found[FLARE], found[FLARE + 1] = above, max(0.0, above), time[k]
    if math.isnan(lock):
        return
    settled = (lock if math.isnan(end) else max(lock, end)) + SETTLED
    least, at = math.inf, -1
    for k in range(n):
        if start <= time[k] <= settled and felt[k] < least:
            least, at = felt[k], k
    if at >= 0 and settled <= last:
        smaller = min(interpolated(start, time, felt), interpolated(settled, time, felt))
        found[HOLE], found[HOLE + 1] = max(0.0, smaller - least), time[at]
