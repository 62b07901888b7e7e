# mypy: disable-error-code="no-any-return"
"""How film and heat at the end of a stretch change with the inputs there.

Every substep is differentiated as it was made, stage by stage, with the slopes that it left in
``work``; its size counts as given. Only a change of the slopes themselves, by what the changes at
its beginning do to them, has no formula here: it is read from slopes at neighbouring states.
"""

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_integrate import FIRST_SHARE, LEAST_SHARE, MAX_SUBSTEPS, attempt
from .clutch_rates import pack_slopes
from .clutch_rodas import DRIFT, GAMMA, NUDGE, WHEN, A, C
from .clutch_stage import runs, solve_stage, surface_temperature

Array = NDArray[np.float64]
APART = 1e-5  # relative distance of the neighbouring states
WARMTH = 100.0  # K, scale of temperatures


@kernel
def _changed_rates(
    work: Array, place: int, film: float, heat: float, load: float, slip: float
) -> tuple[float, float]:
    """Return the changes of film rate and power with those of the states and inputs."""
    kept = L.W_KEPT + place * L.N_KEPT
    rate = work[np.uintp(kept)] * film + work[np.uintp(kept + 1)] * heat
    power = work[np.uintp(kept + 2)] * film + work[np.uintp(kept + 3)] * heat
    rate += work[np.uintp(kept + 4)] * load
    power += work[np.uintp(kept + 5)] * load + work[np.uintp(kept + 6)] * slip
    return rate, power


@kernel
def _changed_slopes(
    par: Array, load: float, slip: float, load_change: float, slip_change: float, work: Array
) -> tuple[float, float, float, float]:
    """Return the changes of the slopes (rate over u, T; power over u, T) at a substep's start."""
    u = work[np.uintp(L.W_NOW + L.Y_FILM)]
    temperature = surface_temperature(par, work, L.W_NOW)
    film = work[np.uintp(L.W_VARIED + L.Y_FILM)]
    heat = surface_temperature(par, work, L.W_VARIED)
    size = max(
        max(abs(film) / (1.0 + abs(u)), abs(heat) / WARMTH),
        max(
            abs(load_change) / (load + L.OPEN_PRESSURE * par[L.D_AREA]),
            abs(slip_change) / (abs(slip) + par[L.P_SPEED_SMOOTHING]),
        ),
    )
    if not size > 0.0:
        return 0.0, 0.0, 0.0, 0.0
    rate_u, rate_t, power_u, power_t = 0.0, 0.0, 0.0, 0.0
    for side in range(2):  # one call in the code: it is long
        e = APART / size if side == 0 else -APART / size
        found, _ = pack_slopes(
            par, max(load + e * load_change, 0.0), slip + e * slip_change, u + e * film,
            temperature + e * heat,
        )  # fmt: skip
        half = 0.5 / e
        rate_u, rate_t = rate_u + half * found[1], rate_t + half * found[2]
        power_u, power_t = power_u + half * found[4], power_t + half * found[5]
    return rate_u, rate_t, power_u, power_t


@kernel
def _jump(
    par: Array, course: tuple[float, float, float, float, float, float], change: float, x: float,
    share: float, duration: float, work: Array,
) -> float:  # fmt: skip
    """Return the change of the film ratio because the pack opens or closes at another instant."""
    limit, rise = L.OPEN_PRESSURE * par[L.D_AREA], course[3] - course[0]
    before, after = course[0] + rise * x, course[0] + rise * (x + share)
    if (before < limit) == (after < limit):
        return 0.0
    later = -duration * (limit - course[0]) / rise * change / rise
    slip, jump = course[1], 0.0
    for side in range(2):
        at = x + share * side
        base = L.W_TRIAL if side == 1 else L.W_NOW
        found, _ = pack_slopes(
            par, max(course[0] + rise * at, 0.0), slip + (course[4] - slip) * at,
            work[np.uintp(base + L.Y_FILM)], surface_temperature(par, work, base),
        )  # fmt: skip
        jump += found[0] if side == 0 else -found[0]
    return jump * later


@kernel
def _drift(
    par: Array, change: tuple[float, float, float], x: float, share: float, h: float, place: int,
    work: Array,
) -> None:  # fmt: skip
    """Fill W_VARIED_DRIFT: how the drift of the rates changes, read as the substep reads it."""
    film = work[np.uintp(L.W_VARIED + L.Y_FILM)]
    heat = surface_temperature(par, work, L.W_VARIED)
    at = x + NUDGE * share
    rate, power = _changed_rates(work, place, film, heat, change[0] * at, change[1] * at)
    rate_0, power_0 = _changed_rates(work, 0, film, heat, change[0] * x, change[1] * x)
    per = 1.0 / (NUDGE * h)
    work[np.uintp(L.W_VARIED_DRIFT + L.Y_FILM)] = (rate - rate_0) * per
    work[np.uintp(L.W_VARIED_DRIFT + L.Y_ENERGY)] = 0.0
    for i in range(int(par[L.D_MODES]) + 1):
        drift = par[np.uintp(L.D_GAIN + i)] * (power - power_0) * per
        if i == 0:
            drift += par[L.D_DECAY] * change[2] * share / h
        work[np.uintp(L.W_VARIED_DRIFT + L.Y_HEAT + i)] = drift


@kernel
def _stage(
    par: Array, change: tuple[float, float, float], at: float, h: float, k: int,
    bent: tuple[float, float, float, float], work: Array,
) -> None:  # fmt: skip
    """Fill the right side of the change of stage ``k``; ``bent``: changes of the slopes."""
    base, own = L.W_VARIED_STAGES + k * L.NY, L.W_STAGES + k * L.NY
    n = L.Y_HEAT + 1 + int(par[L.D_MODES])
    for i in range(n):  # the change of the state where the rates are taken, in W_RATE
        value = work[np.uintp(L.W_VARIED + i)]
        for j in range(k):
            value += A[k, j] * work[np.uintp(L.W_VARIED_STAGES + j * L.NY + i)]
        work[np.uintp(L.W_RATE + i)] = value
    rate, power = _changed_rates(
        work, k, work[np.uintp(L.W_RATE + L.Y_FILM)], surface_temperature(par, work, L.W_RATE),
        change[0] * at, change[1] * at,
    )  # fmt: skip
    film, heat = work[np.uintp(own + L.Y_FILM)], surface_temperature(par, work, own)
    rate += bent[0] * film + bent[1] * heat
    power += bent[2] * film + bent[3] * heat
    for i in range(n):
        value = 0.0
        if i == L.Y_FILM:
            value = rate
        elif i >= L.Y_HEAT:
            level = change[2] * at if i == L.Y_HEAT else 0.0
            value = par[np.uintp(L.D_GAIN + i - L.Y_HEAT)] * power
            value -= par[np.uintp(L.D_DECAY + i - L.Y_HEAT)] * (
                work[np.uintp(L.W_RATE + i)] - level
            )
        for j in range(k):
            value += C[k, j] / h * work[np.uintp(L.W_VARIED_STAGES + j * L.NY + i)]
        if k < 4:
            value += DRIFT[k] * h * work[np.uintp(L.W_VARIED_DRIFT + i)]
        work[np.uintp(base + i)] = value


@kernel
def follow(
    par: Array, course: tuple[float, float, float, float, float, float],
    change: tuple[float, float, float], x: float, share: float, duration: float, work: Array,
) -> None:  # fmt: skip
    """Carry the changes at W_VARIED over a substep from W_NOW to W_TRIAL, whose stages still stand.

    ``course`` and ``change``: inputs at start and end of the stretch and how the latter change;
    the substep goes from the share ``x`` of the stretch over ``share`` of it.
    """
    h = share * duration
    s = 1.0 / (GAMMA * h)
    bent = (0.0, 0.0, 0.0, 0.0)
    if x > 0.0:
        slip = course[1] + (course[4] - course[1]) * x
        bent = _changed_slopes(
            par, max(course[0] + (course[3] - course[0]) * x, 0.0), slip, change[0] * x,
            change[1] * x, work,
        )  # fmt: skip
    _drift(par, change, x, share, h, L.N_STAGES if runs(course) else 0, work)
    first = np.uintp(L.W_KEPT)
    slopes = (
        0.0, work[first], work[np.uintp(L.W_KEPT + 1)],
        0.0, work[np.uintp(L.W_KEPT + 2)], work[np.uintp(L.W_KEPT + 3)],
    )  # fmt: skip
    for k in range(L.N_STAGES):
        _stage(par, change, x + WHEN[k] * share, h, k, bent, work)
        solve_stage(par, s, slopes, work, L.W_VARIED_STAGES + k * L.NY)
    last = L.N_STAGES - 1
    jump = _jump(par, course, change[0], x, share, duration, work)
    for i in range(L.Y_HEAT + 1 + int(par[L.D_MODES])):
        value = work[np.uintp(L.W_VARIED_STAGES + last * L.NY + i)]
        for j in range(last):
            value += A[last, j] * work[np.uintp(L.W_VARIED_STAGES + j * L.NY + i)]
        work[np.uintp(L.W_VARIED + i)] += value
    work[np.uintp(L.W_VARIED + L.Y_FILM)] += jump


@kernel
def engage_and_follow(
    par: Array, course: tuple[float, float, float, float, float, float],
    change: tuple[float, float, float], duration: float, first: float, work: Array,
) -> int:  # fmt: skip
    """Advance the unknowns in W_NOW as ``engage`` does, their changes at W_VARIED with them."""
    for i in range(L.NY):
        work[np.uintp(L.W_VARIED + i)] = 0.0
    done = 0.0
    share = min(1.0, first / duration) if first > 0.0 else 1.0
    for _ in range(MAX_SUBSTEPS):
        remaining = 1.0 - done
        least = LEAST_SHARE * done + FIRST_SHARE
        closing = share >= remaining * (1.0 - 1e-9)
        if closing:
            share = remaining
        taken, factor, status = attempt(par, course, duration, done, share, least, work)
        if status != L.OK:
            return status
        if taken:
            follow(par, course, change, done, share, duration, work)
            for i in range(L.NY):
                work[np.uintp(L.W_NOW + i)] = work[np.uintp(L.W_TRIAL + i)]
            if closing:
                return L.OK
            done += share
        share = max(share * factor, least)
    return L.MAX_ITERATIONS
