# mypy: disable-error-code="no-any-return"
"""Stick and slip of two packs: which modes are consistent, and when they end.

A pack slips forward (+1), backward (-1) or sticks (0). Sticking needs |torque| <= capacity,
slipping from rest an acceleration in the direction of the mode. With the symmetric positive
mobility of the driveline exactly one combination holds, apart from ties.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import layout as L
from .dynamics import capacity, clutch_slip, drum_speed, solve_torques, trial_step

MAX_ROOT_STEPS = 100
ROOT_WIDTH = 1e-14  # of the step


@kernel
def slip_of(par: Array, work: Array, pack: int, y: int) -> float:
    """Return the slip [rad/s] of clutch (0) or brake (1) for the vector at ``work[y:]``."""
    driven, carrier = work[np.uintp(y + L.Y_INPUT)], work[np.uintp(y + L.Y_CARRIER)]
    if pack == 0:
        return clutch_slip(par[L.D_RATIO], driven, carrier)
    return drum_speed(par[L.D_RATIO], driven, carrier)


@kernel
def capacity_of(work: Array, pack: int, s: float) -> float:
    """Return what can hold the pack [N m]; for the clutch the planets' drag helps."""
    own = capacity(work, pack, s)
    return own + work[L.W_DRAG] if pack == 0 else own


@kernel
def margin_of(work: Array, pack: int, s: float) -> float:
    """Return capacity minus the torque a stuck pack carries [N m], after ``solve_torques``."""
    given, torque = work[np.uintp(L.W_CLUTCH_GIVEN + pack)], work[np.uintp(L.W_CLUTCH + pack)]
    return capacity_of(work, pack, s) - abs(torque - given)


@kernel
def violation(par: Array, work: Array, pack: int, s: float, free: bool) -> float:
    """Return by how many N m the mode of a pack contradicts the torques; 0 if consistent."""
    mode = work[np.uintp(L.W_CLUTCH_MODE + pack)]
    if mode == L.STUCK:
        return max(0.0, -margin_of(work, pack, s))
    if free:  # slip is not zero, or nothing holds the pack: any acceleration will do
        return 0.0
    mobility = par[L.D_SLIP_CC] if pack == 0 else par[L.D_SLIP_BB]
    rate = slip_of(par, work, pack, L.W_INPUT_RATE)  # after ``solve_torques``
    return max(0.0, -mode * rate) / mobility


@kernel
def candidate(slip: float, active: bool, excluded: bool, n: int) -> float:
    """Return the n-th mode (0, 1, 2) worth trying, or 9 for none."""
    if slip != 0.0 or not active:
        return (-1.0 if slip < 0.0 else 1.0) if n == 0 else 9.0
    if n == 0:
        return 9.0 if excluded else L.STUCK
    return 1.0 if n == 1 else -1.0


@kernel
def decide(par: Array, work: Array, s: float, exclude: int) -> None:
    """Set the modes for the vector at ``work[W_Y:]``; ``exclude`` names a pack that broke away.

    Tries sticking first and takes the first combination without contradiction beyond rounding, or
    else the one with the least.
    """
    slip_c, slip_b = slip_of(par, work, 0, L.W_Y), slip_of(par, work, 1, L.W_Y)
    active_c, active_b = work[L.W_CLUTCH_ACTIVE] > 0.0, work[L.W_BRAKE_ACTIVE] > 0.0
    limit = 1e-12 * (capacity_of(work, 0, s) + capacity_of(work, 1, s) + abs(work[L.W_ENGINE]))
    best, best_c, best_b = math.inf, 1.0, 1.0
    for n in range(9):
        mode_c = candidate(slip_c, active_c, exclude == 0, n // 3)
        mode_b = candidate(slip_b, active_b, exclude == 1, n % 3)
        if mode_c == 9.0 or mode_b == 9.0 or best <= limit:
            continue
        work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE] = mode_c, mode_b
        solve_torques(par, work, s, L.W_Y)
        wrong = max(
            violation(par, work, 0, s, slip_c != 0.0 or not active_c),
            violation(par, work, 1, s, slip_b != 0.0 or not active_b),
        )
        if wrong < best:
            best, best_c, best_b = wrong, mode_c, mode_b
    work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE] = best_c, best_b


@kernel
def guard(par: Array, work: Array, pack: int, s: float, y: int) -> float:
    """Return a number that falls below 0 when the mode of a pack ends, for ``work[y:]`` at ``s``.

    Slipping: the slip in the direction of the mode [rad/s]. Sticking: capacity minus torque [N m],
    with a hair of play so that a tie does not chatter.
    """
    mode = work[np.uintp(L.W_CLUTCH_MODE + pack)]
    if mode != L.STUCK:
        return mode * slip_of(par, work, pack, y)
    solve_torques(par, work, s, y)
    return margin_of(work, pack, s) + 1e-12 * capacity_of(work, pack, s)


@kernel
def locate(par: Array, work: Array, pack: int, s: float, h: float, start: float) -> float:
    """Return the fraction of the step ``h`` at which the guard of a pack passes through zero.

    ``start`` is the guard at the beginning; at ``h`` it is negative. Chandrupatla's method (1997):
    inverse quadratic interpolation where the last three points allow it, else halving; each trial
    integrates from the beginning, so the result lies on the solution.
    """
    if start <= 0.0:
        return 0.0
    # newest point, the one on the other side of zero, the one that left the bracket
    x, y = 1.0, guard(par, work, pack, s + h, L.W_NEW)
    other_x, other_y, last_x, last_y = 0.0, start, 1.0, y
    share = y / (y - start)
    for _ in range(MAX_ROOT_STEPS):
        width = abs(other_x - x)
        if width < ROOT_WIDTH:
            break
        least = 0.5 * ROOT_WIDTH / width
        trial = x + min(max(share, least), 1.0 - least) * (other_x - x)
        trial_step(par, work, s, trial * h)
        g = guard(par, work, pack, s + trial * h, L.W_NEW)
        if g == 0.0:
            return trial
        if (g < 0.0) == (y < 0.0):
            last_x, last_y = x, y
        else:
            last_x, last_y, other_x, other_y = other_x, other_y, x, y
        x, y = trial, g
        share = _next_share(x, y, other_x, other_y, last_x, last_y)
    return x if y < 0.0 else other_x


@kernel
def _next_share(
    x: float, y: float, far_x: float, far_y: float, out_x: float, out_y: float
) -> float:
    """Return where between ``x`` (0) and ``far_x`` (1) to look next; ``out_x`` left the bracket."""
    place, value = (x - far_x) / (out_x - far_x), (y - far_y) / (out_y - far_y)
    if not (value * value < place and (1.0 - value) * (1.0 - value) < 1.0 - place):
        return 0.5
    inner = y / (far_y - y) * (out_y / (far_y - out_y))
    return inner + (out_x - x) / (far_x - x) * (y / (out_y - y)) * (far_y / (out_y - far_y))


@kernel
def dip(par: Array, work: Array, pack: int, h: float) -> float:
    """Return the fraction of the step at which a slip that starts and ends positive is least.

    Reads the cubic through values and slopes at both ends of the last trial step; 1 if the least
    value is at the end or not below zero.
    """
    mode = work[np.uintp(L.W_CLUTCH_MODE + pack)]
    last = L.W_SLOPES + (L.N_STAGES - 1) * L.N_Y
    v0 = mode * slip_of(par, work, pack, L.W_Y)
    v1 = mode * slip_of(par, work, pack, L.W_NEW)
    d0 = mode * h * slip_of(par, work, pack, L.W_SLOPES)
    d1 = mode * h * slip_of(par, work, pack, last)
    if v0 <= 0.0 or d0 >= 0.0 or d1 <= 0.0:
        return 1.0
    # value = v0 + d0 x + c x^2 + e x^3; its slope has one rising root in (0, 1).
    c = 3.0 * (v1 - v0) - 2.0 * d0 - d1
    e = d0 + d1 - 2.0 * (v1 - v0)
    x = -d0 / (c + math.sqrt(max(c * c - 3.0 * e * d0, 0.0)))
    if not 0.0 < x < 1.0 or v0 + x * (d0 + x * (c + x * e)) >= 0.0:
        return 1.0
    return x
