# mypy: disable-error-code="no-any-return"
"""Film, heat and energy of an engaging pack over a stretch of time, implicitly, error controlled.

The film follows the load at hundreds per second, so the method is linearly implicit and L-stable:
RODAS of Hairer & Wanner (order 4, six stages, embedded order 3). The heat is linear but for the
friction power, which depends on film ratio and interface temperature alone: every stage is a 2 x 2
system, whatever the number of conduction modes.
"""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_rates import pack_rates

Array = NDArray[np.float64]

# RODAS (Hairer & Wanner, Solving Ordinary Differential Equations II, section VI.4).
GAMMA = 0.25
A = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [1.544, 0.0, 0.0, 0.0, 0.0],
    [0.9466785280815826, 0.2557011698983284, 0.0, 0.0, 0.0],
    [3.314825187068521, 2.896124015972201, 0.9986419139977817, 0.0, 0.0],
    [1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 0.0],
    [1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1.0],
])  # fmt: skip
C = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [-5.6688, 0.0, 0.0, 0.0, 0.0],
    [-2.430093356833875, -0.2063599157091915, 0.0, 0.0, 0.0],
    [-0.1073529058151375, -9.594562251023355, -20.47028614809616, 0.0, 0.0],
    [7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160, 0.0],
    [8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136,
     -6.058818238834054],
])  # fmt: skip
WHEN = np.array([0.0, 0.386, 0.21, 0.63, 1.0, 1.0])  # stage times, share of the substep
DRIFT = np.array([0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0])  # weight of the rates' drift

TOLERANCE_FILM = 1e-6  # error of a substep, of film ratio + 1
TOLERANCE_HEAT = 1e-4  # K
TOLERANCE_RISE = 1e-3  # K, of the interface when conduction modes are on top
MAX_SUBSTEPS = 20_000
LEAST_SHARE = 1e-13  # of the time gone by: no smaller substeps
FIRST_SHARE = 1e-25  # of the stretch: the same at its start


@kernel
def surface_temperature(par: Array, y: Array, base: int) -> float:
    """Return the interface temperature [K]: the plate's mean and the modes on top of it."""
    total = y[np.uintp(base + L.Y_HEAT)]
    for i in range(int(par[L.D_MODES])):
        total += y[np.uintp(base + L.Y_HEAT + 1 + i)]
    return total


@kernel
def _rates(
    par: Array, course: tuple[float, float, float, float, float, float], x: float, work: Array,
    base: int,
) -> tuple[float, float, float, float, float, float]:  # fmt: skip
    """Fill the rates at the share ``x`` of the stretch; return film rate, power and their slopes.

    ``course``: load, slip, oil temperature at the start, then at the end.
    """
    load = course[0] + (course[3] - course[0]) * x
    slip = course[1] + (course[4] - course[1]) * x
    oil = course[2] + (course[5] - course[2]) * x
    found = pack_rates(
        par, max(load, 0.0), slip, work[np.uintp(base + L.Y_FILM)],
        surface_temperature(par, work, base),
    )  # fmt: skip
    work[np.uintp(L.W_RATE + L.Y_FILM)] = found[0]
    work[np.uintp(L.W_RATE + L.Y_ENERGY)] = found[3]
    for i in range(int(par[L.D_MODES]) + 1):
        level = oil if i == 0 else 0.0
        work[np.uintp(L.W_RATE + L.Y_HEAT + i)] = par[np.uintp(L.D_GAIN + i)] * found[3] - par[
            np.uintp(L.D_DECAY + i)
        ] * (work[np.uintp(base + L.Y_HEAT + i)] - level)
    return found


@kernel
def _solve_stage(
    par: Array, s: float, slopes: tuple[float, float, float, float, float, float], work: Array,
    stage: int,
) -> None:  # fmt: skip
    """Turn the right side in the stage's place into its solution of (s - J) U = right side."""
    n = int(par[L.D_MODES]) + 1
    total, gain = 0.0, 0.0
    for i in range(n):
        pivot = s + par[np.uintp(L.D_DECAY + i)]
        total += work[np.uintp(stage + L.Y_HEAT + i)] / pivot
        gain += par[np.uintp(L.D_GAIN + i)] / pivot
    rate_u, rate_t, power_u, power_t = slopes[1], slopes[2], slopes[4], slopes[5]
    # film (s - f_u) du - f_T D = r;   surface (1 - gain P_T) D - gain P_u du = total
    a, d = s - rate_u, 1.0 - gain * power_t
    determinant = a * d - rate_t * gain * power_u
    if determinant == 0.0:
        determinant = math.nan
    r = work[np.uintp(stage + L.Y_FILM)]
    film = (r * d + rate_t * total) / determinant
    surface = (a * total + gain * power_u * r) / determinant
    power = power_u * film + power_t * surface
    work[np.uintp(stage + L.Y_FILM)] = film
    work[np.uintp(stage + L.Y_ENERGY)] = (work[np.uintp(stage + L.Y_ENERGY)] + power) / s
    for i in range(n):
        place = np.uintp(stage + L.Y_HEAT + i)
        work[place] = (work[place] + par[np.uintp(L.D_GAIN + i)] * power) / (
            s + par[np.uintp(L.D_DECAY + i)]
        )


@kernel
def _substep(
    par: Array, course: tuple[float, float, float, float, float, float], x: float, share: float,
    duration: float, work: Array,
) -> float:  # fmt: skip
    """Fill W_TRIAL with the state a substep later; return its error in units of the tolerance."""
    n = L.Y_HEAT + 1 + int(par[L.D_MODES])
    h = share * duration
    s = 1.0 / (GAMMA * h)
    moving = course[0] != course[3] or course[1] != course[4] or course[2] != course[5]
    last = L.W_STAGES + (L.N_STAGES - 1) * L.NY
    if moving:  # the drift of the rates is differenced; it goes where the last stage will be
        nudge = 1e-3 * share
        _rates(par, course, x + nudge, work, L.W_NOW)
        for i in range(n):
            work[np.uintp(last + i)] = work[np.uintp(L.W_RATE + i)]
    slopes = _rates(par, course, x, work, L.W_NOW)
    if moving:
        for i in range(n):
            place = np.uintp(last + i)
            work[place] = (work[place] - work[np.uintp(L.W_RATE + i)]) / (1e-3 * h)
    for k in range(L.N_STAGES):
        if k > 0:
            for i in range(n):
                value = work[np.uintp(L.W_NOW + i)]
                for j in range(k):
                    value += A[k, j] * work[np.uintp(L.W_STAGES + j * L.NY + i)]
                work[np.uintp(L.W_TRIAL + i)] = value
            _rates(par, course, x + WHEN[k] * share, work, L.W_TRIAL)
        stage = L.W_STAGES + k * L.NY
        for i in range(n):
            value = work[np.uintp(L.W_RATE + i)]
            for j in range(k):
                value += C[k, j] / h * work[np.uintp(L.W_STAGES + j * L.NY + i)]
            if moving and k < 4:
                value += DRIFT[k] * h * work[np.uintp(last + i)]
            work[np.uintp(stage + i)] = value
        _solve_stage(par, s, slopes, work, stage)
    heat = 0.0
    for i in range(n):
        work[np.uintp(L.W_TRIAL + i)] += work[np.uintp(last + i)]
        if i >= L.Y_HEAT:
            heat += work[np.uintp(last + i)]
    film = work[np.uintp(last + L.Y_FILM)] / (
        TOLERANCE_FILM * (1.0 + abs(work[np.uintp(L.W_TRIAL + L.Y_FILM)]))
    )
    tolerance = TOLERANCE_HEAT if par[L.D_MODES] == 0.0 else TOLERANCE_RISE
    return max(abs(film), abs(heat) / tolerance)


@kernel
def engage(
    par: Array, course: tuple[float, float, float, float, float, float], duration: float,
    first: float, work: Array,
) -> int:  # fmt: skip
    """Advance the unknowns in W_NOW by ``duration`` [s]; return a status.

    Parameters
    ----------
    course : load [N], slip [rad/s], oil temperature [K] at the start, then at the end; straight
        in between
    first : size of the first substep [s] to try, 0 if unknown
    work : unknowns at W_NOW in and out; the numbers of substeps and the next size to try out

    Notes
    -----
    A jump of the rates inside the stretch (the pack opens, a limit is met) shrinks the substeps
    until it is passed; when they reach LEAST_SHARE of the time gone by, a substep is taken.
    """
    n = L.Y_HEAT + 1 + int(par[L.D_MODES])
    done, refused = 0.0, 0.0
    share = min(1.0, first / duration) if first > 0.0 else 1.0
    work[L.W_PROPOSED] = duration
    for count in range(MAX_SUBSTEPS):
        remaining = 1.0 - done
        least = LEAST_SHARE * done + FIRST_SHARE
        closing = share >= remaining * (1.0 - 1e-9)
        if closing:
            share = remaining
        error = _substep(par, course, done, share, duration, work)
        if not math.isfinite(error):
            error = 1e6
            if share <= least:
                return L.NOT_FINITE
        factor = 6.0 if error < 1e-5 else min(6.0, max(0.1, 0.9 / math.sqrt(math.sqrt(error))))
        if error <= 1.0 or share <= least:
            for i in range(n):
                work[np.uintp(L.W_NOW + i)] = work[np.uintp(L.W_TRIAL + i)]
            done += share
            proposed = share * factor * duration
            if closing:
                # a stretch's last substep may be a crumb: it says nothing about the next one
                work[L.W_PROPOSED] = max(work[L.W_PROPOSED], proposed) if count > 0 else proposed
                work[L.W_SUBSTEPS] = float(count + 1) - refused
                work[L.W_REFUSED] = refused
                return L.OK
            work[L.W_PROPOSED] = proposed
            share = max(share * factor, least)
        else:
            refused += 1.0
            share = max(share * min(factor, 0.9), least)
    return L.MAX_ITERATIONS
