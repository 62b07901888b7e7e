# mypy: disable-error-code="no-any-return"
"""Film and rings over a stretch of time, implicitly, error controlled; with their changes.

SDIRK of order 4 with an embedded one of order 3 (Hairer & Wanner, Solving Ordinary Differential
Equations II, table IV.6.5): L-stable, five stages, the last of which is the result. A stage is an
equation for the film ratio and one temperature for each ring: heat and its conduction modes are
linear but for the ring's power. Newton's method; its matrix is an arrow.
"""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_rings import (
    POWER,
    POWER_F,
    POWER_S,
    POWER_T,
    POWER_U,
    RATE_T,
    ring_rates,
    surfaces,
)  # fmt: skip
from .corners import sign_of

Array = NDArray[np.float64]
GAMMA = 0.25
A = np.array([
    [0.0, 0.0, 0.0, 0.0],
    [0.5, 0.0, 0.0, 0.0],
    [17.0 / 50.0, -1.0 / 25.0, 0.0, 0.0],
    [371.0 / 1360.0, -137.0 / 2720.0, 15.0 / 544.0, 0.0],
    [25.0 / 24.0, -49.0 / 48.0, 125.0 / 16.0, -85.0 / 12.0],
])  # fmt: skip
WHEN = np.array([0.25, 0.75, 0.55, 0.5, 1.0])
MISS = np.array([-3.0 / 16.0, -27.0 / 32.0, 25.0 / 32.0, 0.0, 0.25])  # order 4 less order 3
TOLERANCE_FILM, TOLERANCE_HEAT = 1e-6, 1e-4  # of film ratio + 1; K
NEWTON = 20
MAX_SUBSTEPS = 20_000
LEAST_SHARE, FIRST_SHARE = 1e-13, 1e-25  # smallest substeps, as in clutch_integrate
Course = tuple[float, float, float, float, float, float]


@kernel
def _level(par: Array, gh: float) -> float:
    """Return the rise [K] of the interface per watt within a stage, of all the pack's area."""
    gain = 0.0
    for i in range(int(par[L.D_MODES]) + 1):
        gain += gh * par[np.uintp(L.D_GAIN + i)] / (1.0 + gh * par[np.uintp(L.D_DECAY + i)])
    return gain


@kernel
def _held_heat(par: Array, gh: float, oil: float, work: Array, base: int, k: int) -> float:
    """Return a ring's interface temperature, or its change, without the power of the stage."""
    total = 0.0
    for i in range(int(par[L.D_MODES]) + 1):
        decay = gh * par[np.uintp(L.D_DECAY + i)]
        value = work[np.uintp(base + L.Z_RINGS + k * L.N_BODY + i)]
        total += (value + (decay * oil if i == 0 else 0.0)) / (1.0 + decay)
    return total


@kernel
def _arrow(par: Array, gh: float, rate_u: float, right: float, work: Array, rest: int) -> float:
    """Solve for the film ratio; the rings' right sides at ``work[rest:]`` become their solutions.

    (1 - gh f_u) du - gh sum f_T dT = right; dT - G (P_u du + P_T dT) = rest of the ring.
    """
    gain, whole = _level(par, gh), par[L.D_AREA]
    a, b = 1.0 - gh * rate_u, right
    for k in range(int(par[L.D_RINGS])):
        at = L.W_AT + k * L.N_AT
        g = gain * whole / par[np.uintp(L.D_BLOCKS + k * L.N_PACK + L.D_AREA)]
        d = 1.0 - g * work[np.uintp(at + POWER_T)]
        f = gh * work[np.uintp(at + RATE_T)] / d
        a -= f * g * work[np.uintp(at + POWER_U)]
        b += f * work[np.uintp(rest + k)]
    du = b / a if a != 0.0 else math.nan
    for k in range(int(par[L.D_RINGS])):
        at = L.W_AT + k * L.N_AT
        g = gain * whole / par[np.uintp(L.D_BLOCKS + k * L.N_PACK + L.D_AREA)]
        d = 1.0 - g * work[np.uintp(at + POWER_T)]
        work[np.uintp(rest + k)] = (
            work[np.uintp(rest + k)] + g * work[np.uintp(at + POWER_U)] * du
        ) / d
    return du


@kernel
def _solve_stage(
    par: Array, load: float, slip: float, oil: float, gh: float, u: float, work: Array
) -> tuple[float, float, float, bool]:
    """Return film ratio, slopes of its rate over film ratio and load, and if Newton arrived.

    What the stage starts from is at W_BASE; W_SURFACE holds a guess and then the solution.
    """
    gain, whole, rest = _level(par, gh), par[L.D_AREA], L.W_SURFACE + L.MAX_RINGS
    rate_u, rate_f = 0.0, 0.0
    for n in range(NEWTON):
        rate, rate_u, rate_f = ring_rates(par, load, slip, u, work)
        for k in range(int(par[L.D_RINGS])):
            g = gain * whole / par[np.uintp(L.D_BLOCKS + k * L.N_PACK + L.D_AREA)]
            held = _held_heat(par, gh, oil, work, L.W_BASE, k)
            work[np.uintp(rest + k)] = (
                held + g * work[np.uintp(L.W_AT + k * L.N_AT + POWER)]
                - work[np.uintp(L.W_SURFACE + k)]
            )  # fmt: skip
        du = _arrow(
            par, gh, rate_u, work[np.uintp(L.W_BASE + L.Z_FILM)] + gh * rate - u, work, rest
        )
        u += du
        step = abs(du) / (1.0 + abs(u))
        for k in range(int(par[L.D_RINGS])):
            dt = work[np.uintp(rest + k)]
            work[np.uintp(L.W_SURFACE + k)] += dt
            step = max(step, abs(dt) / 300.0)
        if not step < 1e6:
            return u, rate_u, rate_f, False
        if step < 1e-13 or (n > 2 and step < 1e-11):
            return u, rate_u, rate_f, True
    return u, rate_u, rate_f, False


@kernel
def _take_stage(
    par: Array, oil: float, gh: float, u: float, work: Array, base: int, to: int, wise: bool
) -> None:
    """Fill the rates of a stage, or their changes, at ``to`` from its solution.

    ``u``: film ratio or its change, ``base``: what the stage starts from. Powers are in W_AT, their
    changes (``wise``) at W_SURFACE + MAX_RINGS.
    """
    work[np.uintp(to + L.Z_FILM)] = (u - work[np.uintp(base + L.Z_FILM)]) / gh
    total = 0.0
    for k in range(int(par[L.D_RINGS])):
        power = work[np.uintp(L.W_AT + k * L.N_AT + POWER)]
        if wise:
            power = work[np.uintp(L.W_SURFACE + L.MAX_RINGS + k)]
        total += power
        per = par[L.D_AREA] / par[np.uintp(L.D_BLOCKS + k * L.N_PACK + L.D_AREA)]
        for i in range(int(par[L.D_MODES]) + 1):
            place = np.uintp(L.Z_RINGS + k * L.N_BODY + i)
            decay, gain = par[np.uintp(L.D_DECAY + i)], par[np.uintp(L.D_GAIN + i)] * per
            level = oil if i == 0 else 0.0
            value = (work[np.uintp(base) + place] + gh * (gain * power + decay * level)) / (
                1.0 + gh * decay
            )
            work[np.uintp(to) + place] = gain * power + decay * (level - value)
        for i in range(int(par[L.D_MODES]) + 1, L.N_BODY):
            work[np.uintp(to + L.Z_RINGS + k * L.N_BODY + i)] = 0.0
    work[np.uintp(to + L.Z_ENERGY)] = total


@kernel
def _changed_stage(
    par: Array, change: tuple[float, float, float], gh: float, slip: float, slopes: tuple[
        float, float], work: Array,
) -> float:  # fmt: skip
    """Return the change of a stage's film ratio; leave the changes of the powers in their place."""
    gain, whole, rest = _level(par, gh), par[L.D_AREA], L.W_SURFACE + L.MAX_RINGS
    turn = sign_of(slip) * change[1]
    right = work[np.uintp(L.W_DBASE + L.Z_FILM)] + gh * slopes[1] * change[0]
    for k in range(int(par[L.D_RINGS])):
        at = L.W_AT + k * L.N_AT
        g = gain * whole / par[np.uintp(L.D_BLOCKS + k * L.N_PACK + L.D_AREA)]
        given = work[np.uintp(at + POWER_F)] * change[0] + work[np.uintp(at + POWER_S)] * turn
        held = _held_heat(par, gh, change[2], work, L.W_DBASE, k)
        work[np.uintp(rest + k)] = held + g * given
    du = _arrow(par, gh, slopes[0], right, work, rest)
    for k in range(int(par[L.D_RINGS])):
        at = L.W_AT + k * L.N_AT
        given = work[np.uintp(at + POWER_F)] * change[0] + work[np.uintp(at + POWER_S)] * turn
        work[np.uintp(rest + k)] = (
            given + work[np.uintp(at + POWER_U)] * du
            + work[np.uintp(at + POWER_T)] * work[np.uintp(rest + k)]
        )  # fmt: skip
    return du


@kernel
def _substep(
    par: Array, course: Course, change: tuple[float, float, float], x: float, share: float,
    duration: float, follow: bool, work: Array,
) -> float:  # fmt: skip
    """Fill the stages' rates (and changes) of a substep; return its error over the tolerance."""
    n = L.Z_RINGS + int(par[L.D_RINGS]) * L.N_BODY
    h = share * duration
    gh = GAMMA * h
    surfaces(par, work, L.W_Z, L.W_SURFACE)
    u = work[np.uintp(L.W_Z + L.Z_FILM)]
    for s in range(L.N_FINE_STAGES):
        for i in range(n):
            value, grows = work[np.uintp(L.W_Z + i)], work[np.uintp(L.W_DZ + i)]
            for j in range(s):
                value += h * A[s, j] * work[np.uintp(L.W_K + j * L.NZ + i)]
                grows += h * A[s, j] * work[np.uintp(L.W_DK + j * L.NZ + i)]
            work[np.uintp(L.W_BASE + i)], work[np.uintp(L.W_DBASE + i)] = value, grows
        at = x + WHEN[s] * share
        load = max(course[0] + (course[3] - course[0]) * at, 0.0)
        slip = course[1] + (course[4] - course[1]) * at
        oil = course[2] + (course[5] - course[2]) * at
        u, rate_u, rate_f, good = _solve_stage(par, load, slip, oil, gh, u, work)
        if not good:
            return math.nan
        _take_stage(par, oil, gh, u, work, L.W_BASE, L.W_K + s * L.NZ, False)
        if follow:
            there = (change[0] * at, change[1] * at, change[2] * at)
            du = _changed_stage(par, there, gh, slip, (rate_u, rate_f), work)
            _take_stage(par, there[2], gh, du, work, L.W_DBASE, L.W_DK + s * L.NZ, True)
    film, worst = 0.0, 0.0
    for s in range(L.N_FINE_STAGES):
        film += h * MISS[s] * work[np.uintp(L.W_K + s * L.NZ + L.Z_FILM)]
    for k in range(int(par[L.D_RINGS])):
        heat = 0.0
        for i in range(int(par[L.D_MODES]) + 1):
            for s in range(L.N_FINE_STAGES):
                place = L.W_K + s * L.NZ + L.Z_RINGS + k * L.N_BODY + i
                heat += h * MISS[s] * work[np.uintp(place)]
        worst = max(worst, abs(heat) / TOLERANCE_HEAT)
    return max(worst, abs(film) / (TOLERANCE_FILM * (1.0 + abs(u))))


@kernel
def _accept(par: Array, h: float, follow: bool, work: Array) -> None:
    """Bring the unknowns (and their changes) to the end of the substep."""
    for i in range(L.Z_RINGS + int(par[L.D_RINGS]) * L.N_BODY):
        value, grows = work[np.uintp(L.W_BASE + i)], work[np.uintp(L.W_DBASE + i)]
        last = (L.N_FINE_STAGES - 1) * L.NZ + i
        work[np.uintp(L.W_Z + i)] = value + GAMMA * h * work[np.uintp(L.W_K + last)]
        if follow:
            work[np.uintp(L.W_DZ + i)] = grows + GAMMA * h * work[np.uintp(L.W_DK + last)]


@kernel
def advance_rings(
    par: Array, course: Course, change: tuple[float, float, float], duration: float, first: float,
    follow: bool, work: Array,
) -> int:  # fmt: skip
    """Advance the unknowns at W_Z by ``duration`` [s]; return a status.

    ``course``: load, slip, oil temperature at the start, then at the end, straight in between;
    with ``follow`` the changes at W_DZ go along, those of the inputs at the end being ``change``.
    ``first``: size of the first substep to try, 0 if unknown.
    """
    done, refused = 0.0, 0.0
    share = min(1.0, first / duration) if first > 0.0 else 1.0
    work[L.W_PROPOSED] = duration
    for count in range(MAX_SUBSTEPS):
        remaining = 1.0 - done
        least = LEAST_SHARE * done + FIRST_SHARE
        closing = share >= remaining * (1.0 - 1e-9)
        if closing:
            share = remaining
        error = _substep(par, course, change, done, share, duration, follow, work)
        if not math.isfinite(error):
            if share <= least:
                return L.NOT_FINITE
            error = 1e6
        factor = 6.0 if error < 1e-5 else min(6.0, max(0.1, 0.9 / math.sqrt(math.sqrt(error))))
        if error <= 1.0 or share <= least:
            _accept(par, share * duration, follow, work)
            done += share
            proposed = share * factor * duration
            if closing:
                work[L.W_PROPOSED] = max(work[L.W_PROPOSED], proposed) if count > 0 else proposed
                work[L.W_SUBSTEPS], work[L.W_REFUSED] = float(count + 1) - refused, refused
                return L.OK
            work[L.W_PROPOSED] = proposed
        else:
            refused += 1.0
            factor = min(factor, 0.9)
        share = max(share * factor, least)
    return L.MAX_ITERATIONS
