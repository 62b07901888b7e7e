# mypy: disable-error-code="no-any-return"
"""The pistons that press the packs: profiles of pressure, filling, lag, centrifugal head.

Oil fills the piston's chamber with a given flow while the commanded pressure is above that of the
return spring, and leaves it as fast below. Until it is full the piston is on its way: pressure is
no higher than the spring's and nothing presses. A pressed piston begins to go back when pressure
has fallen to the spring's. Pressure follows the command with a lag of first order. The command is
straight between points, so each piece is solved in closed form; its ends are located.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.status import MAX_ITERATIONS, OK
from . import layout as L

MAX_PIECES = 200
HALVINGS = 60


@kernel
def profile(par: Array, first: int, t: float) -> float:
    """Return the value at ``t`` [s] of the points at ``par[first:]``: number, times, values.

    Times count from the run's start. Straight between points, constant before the first and after
    the last; 0 without points.
    """
    n, run = int(par[np.uintp(first)]), par[L.D_RUN_START]
    times, values = first + 1, first + 1 + L.MAX_POINTS
    if n == 0:
        return 0.0
    if t <= run + par[np.uintp(times)]:
        return par[np.uintp(values)]
    for i in range(1, n):
        a, b = run + par[np.uintp(times + i - 1)], run + par[np.uintp(times + i)]
        if t < b:
            low, high = par[np.uintp(values + i - 1)], par[np.uintp(values + i)]
            return low + (high - low) * ((t - a) / (b - a))
    return par[np.uintp(values + n - 1)]


@kernel
def next_point(par: Array, first: int, t: float, end: float) -> float:
    """Return the time [s] of the first point of a profile between ``t`` and ``end``, or ``end``."""
    for i in range(int(par[np.uintp(first)])):
        time = par[L.D_RUN_START] + par[np.uintp(first + 1 + i)]
        if t < time < end:
            return time
    return end


@kernel
def commanded(
    par: Array, pack: int, t: float, begin: float, dt: float, before: float, after: float
) -> float:
    """Return the pressure commanded at ``t`` [Pa]: by points, and by the input in a step."""
    given = before + (after - before) * ((t - begin) / dt) if dt > 0.0 else after
    return profile(par, L.P_CLUTCH_PROFILE + pack * L.N_PROFILE, t) + given


@kernel
def lagged(p: float, start: float, slope: float, lag: float, h: float) -> float:
    """Return a pressure [Pa] ``h`` seconds on, behind a command that is straight: exact."""
    if not lag > 0.0:
        return start + slope * h
    return start + slope * (h - lag) + (p - start + slope * lag) * math.exp(-h / lag)


@kernel
def passing(p: float, start: float, slope: float, lag: float, h: float, level: float) -> float:
    """Return when [s] within ``h`` a lagged pressure passes a level; it does so once."""
    low, high, above = 0.0, h, p > level
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if (lagged(p, start, slope, lag, middle) > level) == above:
            low = middle
        else:
            high = middle
    return high


@kernel
def rest(par: Array, work: Array, pack: int, pressure: float) -> None:
    """Let a piston stand where a pressure [Pa] has held it for long."""
    at, own = L.W_PISTON + pack * L.N_PISTON, L.P_CLUTCH_PISTON_AREA + pack * L.N_OWN
    full = pressure > par[np.uintp(own + L.OWN_SPRING)]
    work[np.uintp(at + L.PISTON_PRESSURE)] = pressure
    work[np.uintp(at + L.PISTON_FULL)] = 1.0 if full else 0.0
    work[np.uintp(at + L.PISTON_VOLUME)] = par[np.uintp(own + L.OWN_VOLUME)] if full else 0.0
    work[np.uintp(at + L.PISTON_FILLED_TIME)] = -1.0
    work[np.uintp(at + L.PISTON_KISS_TIME)] = -1.0


@kernel
def show_now(par: Array, work: Array, pack: int, pressure: float) -> None:
    """Without lag let the pressure be what is commanded now [Pa], no time having passed."""
    at, own = L.W_PISTON + pack * L.N_PISTON, L.P_CLUTCH_PISTON_AREA + pack * L.N_OWN
    if par[np.uintp(own + L.OWN_LAG)] > 0.0:
        return
    spring = par[np.uintp(own + L.OWN_SPRING)]
    if par[np.uintp(own + L.OWN_VOLUME)] == 0.0:
        work[np.uintp(at + L.PISTON_FULL)] = 1.0 if pressure > spring else 0.0
    full = work[np.uintp(at + L.PISTON_FULL)] != 0.0
    work[np.uintp(at + L.PISTON_PRESSURE)] = pressure if full else min(pressure, spring)


@kernel
def advance(
    par: Array, work: Array, pack: int, t: float, dt: float, before: float, after: float
) -> int:
    """Carry the piston of a pack from ``t`` to ``t + dt``; input pressure at both ends [Pa]."""
    at, own = L.W_PISTON + pack * L.N_PISTON, L.P_CLUTCH_PISTON_AREA + pack * L.N_OWN
    spring, volume = par[np.uintp(own + L.OWN_SPRING)], par[np.uintp(own + L.OWN_VOLUME)]
    flow, lag = par[np.uintp(own + L.OWN_FLOW)], par[np.uintp(own + L.OWN_LAG)]
    p, filling = work[np.uintp(at + L.PISTON_PRESSURE)], work[np.uintp(at + L.PISTON_VOLUME)]
    full = work[np.uintp(at + L.PISTON_FULL)] != 0.0
    s, end = t, t + dt
    start = commanded(par, pack, s, t, dt, before, after)
    for _ in range(MAX_PIECES):
        if s >= end:
            work[np.uintp(at + L.PISTON_PRESSURE)] = p
            work[np.uintp(at + L.PISTON_VOLUME)] = filling
            work[np.uintp(at + L.PISTON_FULL)] = 1.0 if full else 0.0
            return OK
        stop = next_point(par, L.P_CLUTCH_PROFILE + pack * L.N_PROFILE, s, end)
        goal = commanded(par, pack, stop, t, dt, before, after)
        slope = (goal - start) / (stop - s)
        if (start - spring) * (goal - spring) < 0.0:
            cut = s + (spring - start) / slope
            if s < cut < stop:
                stop, goal = cut, spring
        landed, pressing = False, start + goal > 2.0 * spring
        if pressing and not full and s + (volume - filling) / flow <= s:
            full, filling = True, volume
            work[np.uintp(at + L.PISTON_FILLED_TIME)] = s
            if p >= spring or not lag > 0.0:
                work[np.uintp(at + L.PISTON_KISS_TIME)] = s
        elif pressing and not full:
            cut = s + (volume - filling) / flow
            if cut < stop:
                stop, goal, filling = cut, start + slope * (cut - s), volume
            else:
                filling += flow * (stop - s)
        elif start + goal < 2.0 * spring and p > spring and full and lag > 0.0:
            if lagged(p, start, slope, lag, stop - s) < spring:
                cut = passing(p, start, slope, lag, stop - s, spring)
                stop, goal, landed = s + cut, start + slope * cut, True
        elif start + goal < 2.0 * spring:
            full, filling = False, max(0.0, filling - flow * (stop - s))
        h = stop - s
        old, p = p, lagged(p, start, slope, lag, h)
        if full and lag > 0.0 and old < spring < p:
            work[np.uintp(at + L.PISTON_KISS_TIME)] = s + passing(old, start, slope, lag, h, spring)
        if landed:
            p = spring
        elif not full:
            p = min(p, spring)
        s, start = stop, goal
    return MAX_ITERATIONS


@kernel
def force(par: Array, work: Array, pack: int, drum: float) -> float:
    """Return the force of a piston [N]; that of the clutch turns with the drum [rad/s]."""
    at, own = L.W_PISTON + pack * L.N_PISTON, L.P_CLUTCH_PISTON_AREA + pack * L.N_OWN
    if work[np.uintp(at + L.PISTON_FULL)] == 0.0:
        return 0.0
    above = work[np.uintp(at + L.PISTON_PRESSURE)] - par[np.uintp(own + L.OWN_SPRING)]
    head = par[L.D_HEAD] * drum * drum if pack == 0 else 0.0
    return max(0.0, above * par[np.uintp(own)] + head)
