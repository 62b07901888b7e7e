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
from .clutch_rates import pack_slopes
from .clutch_rodas import DRIFT, GAMMA, NUDGE, WHEN, A, C
from .clutch_stage import runs, solve_stage, surface_temperature
from .corners import sign_of

Array = NDArray[np.float64]

TOLERANCE_FILM = 1e-6  # error of a substep, of film ratio + 1
TOLERANCE_HEAT = 1e-4  # K
TOLERANCE_RISE = 1e-3  # K, of the interface when conduction modes are on top
MAX_SUBSTEPS = 20_000
LEAST_SHARE = 1e-13  # of the time gone by: no smaller substeps
FIRST_SHARE = 1e-25  # of the stretch: the same at its start


@kernel
def _rates(
    par: Array, course: tuple[float, float, float, float, float, float], x: float, work: Array,
    base: int, place: int,
) -> tuple[float, float, float, float, float, float]:  # fmt: skip
    """Fill the rates at the share ``x`` of the stretch; return film rate, power and their slopes.

    ``course``: load, slip, oil temperature at the start, then at the end. Where a step's inputs run
    straight the slopes are kept, at the ``place``-th of W_KEPT.
    """
    load = course[0] + (course[3] - course[0]) * x
    slip = course[1] + (course[4] - course[1]) * x
    oil = course[2] + (course[5] - course[2]) * x
    found, by = pack_slopes(
        par, max(load, 0.0), slip, work[np.uintp(base + L.Y_FILM)],
        surface_temperature(par, work, base),
    )  # fmt: skip
    if par[L.P_INPUT_COURSE] == L.LINEAR_COURSE:  # else nobody asks
        kept = L.W_KEPT + place * L.N_KEPT
        work[np.uintp(kept)], work[np.uintp(kept + 1)] = found[1], found[2]
        work[np.uintp(kept + 2)], work[np.uintp(kept + 3)] = found[4], found[5]
        work[np.uintp(kept + 4)], work[np.uintp(kept + 5)] = by[0], by[1]
        work[np.uintp(kept + 6)] = by[2] * sign_of(slip)
    work[np.uintp(L.W_RATE + L.Y_FILM)] = found[0]
    work[np.uintp(L.W_RATE + L.Y_ENERGY)] = found[3]
    for i in range(int(par[L.D_MODES]) + 1):
        level = oil if i == 0 else 0.0
        work[np.uintp(L.W_RATE + L.Y_HEAT + i)] = par[np.uintp(L.D_GAIN + i)] * found[3] - par[
            np.uintp(L.D_DECAY + i)
        ] * (work[np.uintp(base + L.Y_HEAT + i)] - level)
    return found


@kernel
def _substep(
    par: Array, course: tuple[float, float, float, float, float, float], x: float, share: float,
    duration: float, work: Array,
) -> float:  # fmt: skip
    """Fill W_TRIAL with the state a substep later; return its error in units of the tolerance."""
    n = L.Y_HEAT + 1 + int(par[L.D_MODES])
    h = share * duration
    s = 1.0 / (GAMMA * h)
    moving = runs(course)
    last = L.W_STAGES + (L.N_STAGES - 1) * L.NY
    if moving:  # the drift of the rates is differenced; it goes where the last stage will be
        _rates(par, course, x + NUDGE * share, work, L.W_NOW, L.N_STAGES)
        for i in range(n):
            work[np.uintp(last + i)] = work[np.uintp(L.W_RATE + i)]
    slopes = _rates(par, course, x, work, L.W_NOW, 0)
    if moving:
        for i in range(n):
            place = np.uintp(last + i)
            work[place] = (work[place] - work[np.uintp(L.W_RATE + i)]) / (NUDGE * h)
    for k in range(L.N_STAGES):
        if k > 0:
            for i in range(n):
                value = work[np.uintp(L.W_NOW + i)]
                for j in range(k):
                    value += A[k, j] * work[np.uintp(L.W_STAGES + j * L.NY + i)]
                work[np.uintp(L.W_TRIAL + i)] = value
            _rates(par, course, x + WHEN[k] * share, work, L.W_TRIAL, k)
        stage = L.W_STAGES + k * L.NY
        for i in range(n):
            value = work[np.uintp(L.W_RATE + i)]
            for j in range(k):
                value += C[k, j] / h * work[np.uintp(L.W_STAGES + j * L.NY + i)]
            if moving and k < 4:
                value += DRIFT[k] * h * work[np.uintp(last + i)]
            work[np.uintp(stage + i)] = value
        solve_stage(par, s, slopes, work, stage)
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
def attempt(
    par: Array, course: tuple[float, float, float, float, float, float], duration: float,
    done: float, share: float, least: float, work: Array,
) -> tuple[bool, float, int]:  # fmt: skip
    """Try a substep from W_NOW to W_TRIAL; return if it counts, how its size should change, status.

    It goes from the share ``done`` of the stretch over ``share`` of it. A jump of the rates inside
    the stretch (the pack opens, a limit is met) shrinks the substeps until it is passed; one as
    small as ``least`` is taken.
    """
    error = _substep(par, course, done, share, duration, work)
    if not math.isfinite(error):
        error = 1e6
        if share <= least:
            return False, 0.1, L.NOT_FINITE
    factor = 6.0 if error < 1e-5 else min(6.0, max(0.1, 0.9 / math.sqrt(math.sqrt(error))))
    if error <= 1.0 or share <= least:
        return True, factor, L.OK
    return False, min(factor, 0.9), L.OK


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
        taken, factor, status = attempt(par, course, duration, done, share, least, work)
        if status != L.OK:
            return status
        if taken:
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
        else:
            refused += 1.0
        share = max(share * factor, least)
    return L.MAX_ITERATIONS
