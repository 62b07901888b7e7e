# mypy: disable-error-code="no-any-return"
"""How film and heat at the end of an interval change with the inputs there.

Every substep is differentiated as it was made, stage by stage, with the slopes that it left in
``work``; its size counts as given. Only a change of the slopes themselves, by what the changes at
its beginning do to them, has no formula here: it is read from slopes at neighbouring states.
"""

import numpy as np

from ...numerics.arrays import clear, copy
from ...numerics.jit import Array, kernel
from . import layout as L
from . import rosenbrock
from .rates import film_bend, kept_of, n_unknowns, pack_rates, ring_of, surfaces
from .rosenbrock import Ramp, cooled_by_film, factorise, is_moving, solve_stage, unbent

Change = tuple[float, float, float, float]
APART = 1e-5  # relative distance of the neighbouring states
WARMTH = 100.0  # K, scale of temperatures


@kernel
def _changed_rates(
    par: Array, work: Array, place: int, film: float, change: Change, at: float
) -> float:
    """Return the change of the film rate with those of states and inputs; fill W_POWER_CHANGE.

    ``change`` of the inputs at the end of the interval, at the share ``at`` of it.

    The changes of the rings' temperatures are in W_SURFACE_CHANGE.
    """
    kept = L.W_KEPT + place * L.N_RATES
    rate = work[np.uintp(kept + L.R_RATE_U)] * film
    for k in range(int(par[L.D_RINGS])):
        own, heat = kept_of(work, place, k), work[np.uintp(L.W_SURFACE_CHANGE + k)]
        rate += own[L.R_RATE_T] * heat
        power = own[L.R_POWER_U] * film + own[L.R_POWER_T] * heat
        power += own[L.R_POWER_F] * change[0] * at
        power += own[L.R_POWER_S] * change[1] * at
        power += own[L.R_POWER_D] * change[3] * at
        work[np.uintp(L.W_POWER_CHANGE + k)] = power
    rate += work[np.uintp(kept + L.R_RATE_S)] * change[1] * at
    return rate + work[np.uintp(kept + L.R_RATE_F)] * change[0] * at


@kernel
def _changed_cooling(own: Array, film: float, heat: float, change: Change, at: float) -> float:
    """Return the change of a face's heat to the oil [W]; ``heat``: of its mean temperature [K].

    ``own``: what is kept of the ring.
    """
    better = own[L.R_COOL_F] * change[0] * at * own[L.R_EXCESS]
    better += cooled_by_film(own) * film
    return better + own[L.R_COOL] * (heat - change[2] * at)


@kernel
def _change_slopes(par: Array, ramp: Ramp, change: Change, x: float, work: Array) -> None:
    """Fill W_BENT with the changes of the slopes at a substep's start, at the share ``x``."""
    load = max(ramp[0] + (ramp[3] - ramp[0]) * x, 0.0)
    slip = ramp[1] + (ramp[4] - ramp[1]) * x
    drum = ramp[6] + (ramp[7] - ramp[6]) * x
    load_change, slip_change, drum_change = change[0] * x, change[1] * x, change[3] * x
    clear(work[L.W_BENT : L.W_VARIED])
    work[L.W_BEND_CHANGE] = bend_change = 0.0
    u, film = work[np.uintp(L.W_NOW + L.Y_FILM)], work[np.uintp(L.W_VARIED + L.Y_FILM)]
    surfaces(par, work, L.W_VARIED, L.W_SURFACE_CHANGE)
    size = max(
        abs(film) / (1.0 + abs(u)),
        max(
            abs(load_change) / (load + L.OPEN_PRESSURE * par[L.D_AREA]),
            (abs(slip_change) + abs(drum_change)) / (abs(slip) + par[L.P_SPEED_SMOOTHING]),
        ),
    )
    for k in range(int(par[L.D_RINGS])):
        size = max(size, abs(work[np.uintp(L.W_SURFACE_CHANGE + k)]) / WARMTH)
    if not size > 0.0:
        return
    for side in range(2):  # one call in the code: it is long
        e = APART / size if side == 0 else -APART / size
        surfaces(par, work, L.W_NOW, L.W_SURFACE)
        for k in range(int(par[L.D_RINGS])):
            heat = work[np.uintp(L.W_SURFACE_CHANGE + k)]
            work[np.uintp(L.W_SURFACE + k)] += e * heat
        pack_rates(
            par,
            max(load + e * load_change, 0.0),
            slip + e * slip_change,
            drum + e * drum_change,
            u + e * film,
            work,
            L.W_NEIGHBOUR,
        )
        half, bend = 0.5 / e, film_bend(par, load, u + e * film)
        bend_change += half * bend
        rate = 3.0 * bend * work[np.uintp(L.W_NEIGHBOUR + L.R_RATE)]
        work[np.uintp(L.W_NEIGHBOUR + L.R_RATE_U)] -= rate
        for i in range(L.R_RINGS + int(par[L.D_RINGS]) * L.N_OF_RING):
            work[np.uintp(L.W_BENT + i)] += half * work[np.uintp(L.W_NEIGHBOUR + i)]
    work[L.W_BEND_CHANGE] = bend_change


@kernel
def _jump(
    par: Array, ramp: Ramp, change: float, x: float, share: float, duration: float, work: Array
) -> float:
    """Return the change of the film ratio because the pack opens or closes at another instant."""
    limit, rise = L.OPEN_PRESSURE * par[L.D_AREA], ramp[3] - ramp[0]
    before, after = ramp[0] + rise * x, ramp[0] + rise * (x + share)
    if (before < limit) == (after < limit):
        return 0.0
    later = -duration * (limit - ramp[0]) / rise * change / rise
    slip, jump = ramp[1], 0.0
    for side in range(2):
        at = x + share * side
        base = L.W_TRIAL if side == 1 else L.W_NOW
        surfaces(par, work, base, L.W_SURFACE)
        pack_rates(
            par,
            max(ramp[0] + rise * at, 0.0),
            slip + (ramp[4] - slip) * at,
            ramp[6] + (ramp[7] - ramp[6]) * at,
            work[np.uintp(base + L.Y_FILM)],
            work,
            L.W_NEIGHBOUR,
        )
        rate = work[np.uintp(L.W_NEIGHBOUR + L.R_RATE)]
        jump += rate if side == 0 else -rate
    return jump * later


@kernel
def _drift(
    par: Array, change: Change, x: float, share: float, h: float, place: int, work: Array
) -> None:
    """Fill W_VARIED_DRIFT: how the drift of the rates changes, read as the substep reads it."""
    film = work[np.uintp(L.W_VARIED + L.Y_FILM)]
    surfaces(par, work, L.W_VARIED, L.W_SURFACE_CHANGE)
    at = x + rosenbrock.NUDGE * share
    rate = _changed_rates(par, work, place, film, change, at)
    copy(work[L.W_POWER_CHANGE :], work[L.W_SURFACE : L.W_SURFACE + int(par[L.D_RINGS])])
    rate_0 = _changed_rates(par, work, 0, film, change, x)
    kept = L.W_KEPT + place * L.N_RATES + L.R_RATE
    faster = work[np.uintp(kept)] - work[np.uintp(L.W_KEPT + L.R_RATE)]
    rate += 3.0 * work[L.W_BEND] * faster * film
    per = 1.0 / (rosenbrock.NUDGE * h)
    work[np.uintp(L.W_VARIED_DRIFT + L.Y_FILM)] = (rate - rate_0) * per
    work[np.uintp(L.W_VARIED_DRIFT + L.Y_ENERGY)] = 0.0
    n = 1 + int(par[L.D_MODES])
    for k in range(int(par[L.D_RINGS])):
        ring, heat = ring_of(par, k), L.W_VARIED_DRIFT + L.Y_HEAT + k * n
        power = work[np.uintp(L.W_SURFACE + k)] - work[np.uintp(L.W_POWER_CHANGE + k)]
        warm = work[np.uintp(L.W_VARIED + L.Y_HEAT + k * n)]
        cooled = _changed_cooling(kept_of(work, place, k), film, warm, change, at)
        cooled -= _changed_cooling(kept_of(work, 0, k), film, warm, change, x)
        for i in range(n):
            net = power - cooled if i == 0 else power
            work[np.uintp(heat + i)] = ring[np.uintp(L.D_GAIN + i)] * net * per


@kernel
def _change_of_film(work: Array, gone: float, change: float) -> float:
    """Return the change of the film ratio after it has ``gone`` so far; ``change``: of q."""
    w = 1.0 + work[L.W_BEND] * gone
    turned = 0.5 * gone * gone * (2.0 + w) * work[L.W_BEND_CHANGE]
    return work[np.uintp(L.W_VARIED + L.Y_FILM)] + w * w * w * change + turned


@kernel
def _stage(par: Array, change: Change, x: float, at: float, h: float, k: int, work: Array) -> None:
    """Fill the right side of the change of stage ``k``; W_BENT: changes of the slopes."""
    base, own = L.W_VARIED_STAGES + k * L.NY, L.W_STAGES + k * L.NY
    n, m = n_unknowns(par), 1 + int(par[L.D_MODES])
    for i in range(n):  # the change of the state where the rates are taken, in W_RATE
        value = work[np.uintp(L.W_VARIED + i)]
        for j in range(k):
            value += rosenbrock.A[k, j] * work[np.uintp(L.W_VARIED_STAGES + j * L.NY + i)]
        work[np.uintp(L.W_RATE + i)] = value
    surfaces(par, work, L.W_RATE, L.W_SURFACE_CHANGE)
    first, q = work[np.uintp(L.W_VARIED + L.Y_FILM)], 0.0
    for j in range(k):
        q += rosenbrock.A[k, j] * work[np.uintp(L.W_STAGES + j * L.NY + L.Y_FILM)]
    gone = unbent(q, work[L.W_BEND])
    w = 1.0 + work[L.W_BEND] * gone
    now = _change_of_film(work, gone, work[np.uintp(L.W_RATE + L.Y_FILM)] - first) / (w * w * w)
    rate = _changed_rates(par, work, k, now, change, at)
    turned = gone * work[L.W_BEND_CHANGE] - work[L.W_BEND] * first
    rate -= 3.0 * work[np.uintp(L.W_KEPT + k * L.N_RATES + L.R_RATE)] / w * turned
    film = work[np.uintp(own + L.Y_FILM)]
    surfaces(par, work, own, L.W_SURFACE)
    bent = work[np.uintp(L.W_BENT + L.R_RATE_U)] * film
    work[np.uintp(base + L.Y_ENERGY)] = 0.0
    for r in range(int(par[L.D_RINGS])):
        of, heat = kept_of(work, L.BENT, r), work[np.uintp(L.W_SURFACE + r)]
        bent += of[L.R_RATE_T] * heat
        power = work[np.uintp(L.W_POWER_CHANGE + r)] + (
            of[L.R_POWER_U] * film + of[L.R_POWER_T] * heat
        )
        place, ring, start = L.Y_HEAT + r * m, ring_of(par, r), kept_of(work, 0, r)
        warmer = work[np.uintp(L.W_VARIED + place)] - change[2] * x
        warm = work[np.uintp(L.W_RATE + place)]
        cooled = _changed_cooling(kept_of(work, k, r), now, warm, change, at)
        cooled += of[L.R_COOL] * work[np.uintp(own + place)]
        cooled += film * (of[L.R_COOL_U] * start[L.R_EXCESS] + start[L.R_COOL_U] * warmer)
        work[np.uintp(base + place)] = ring[L.D_GAIN] * (power - cooled)
        for i in range(1, m):
            value = ring[np.uintp(L.D_GAIN + i)] * power
            value -= ring[np.uintp(L.D_DECAY + i)] * work[np.uintp(L.W_RATE + place + i)]
            work[np.uintp(base + place + i)] = value
    work[np.uintp(base + L.Y_FILM)] = rate + bent
    for i in range(n):
        value = work[np.uintp(base + i)]
        for j in range(k):
            value += rosenbrock.C[k, j] / h * work[np.uintp(L.W_VARIED_STAGES + j * L.NY + i)]
        if k < 4:
            value += rosenbrock.DRIFT[k] * h * work[np.uintp(L.W_VARIED_DRIFT + i)]
        work[np.uintp(base + i)] = value


@kernel
def follow(
    par: Array,
    ramp: Ramp,
    change: Change,
    x: float,
    share: float,
    duration: float,
    work: Array,
) -> None:
    """Carry the changes at W_VARIED over a substep from W_NOW to W_TRIAL, whose stages still stand.

    ``ramp`` and ``change``: inputs at start and end of the interval and how the latter change;
    the substep goes from the share ``x`` of the interval over ``share`` of it.
    """
    h = share * duration
    s = 1.0 / (rosenbrock.GAMMA * h)
    if x > 0.0:
        _change_slopes(par, ramp, change, x, work)
    else:
        clear(work[L.W_BENT : L.W_VARIED])
        work[L.W_BEND_CHANGE] = 0.0
    _drift(par, change, x, share, h, L.DRIFTED if is_moving(ramp) else 0, work)
    factorise(par, s, work)
    for k in range(L.N_STAGES):
        _stage(par, change, x, x + rosenbrock.ALPHA[k] * share, h, k, work)
        solve_stage(par, s, work, L.W_VARIED_STAGES + k * L.NY)
    last = L.N_STAGES - 1
    jump = _jump(par, ramp, change[0], x, share, duration, work)
    for i in range(n_unknowns(par)):
        value = work[np.uintp(L.W_VARIED_STAGES + last * L.NY + i)]
        for j in range(last):
            value += rosenbrock.A[last, j] * work[np.uintp(L.W_VARIED_STAGES + j * L.NY + i)]
        if i == L.Y_FILM:
            gone = work[np.uintp(L.W_TRIAL + i)] - work[np.uintp(L.W_NOW + i)]
            value = _change_of_film(work, gone, value) - work[np.uintp(L.W_VARIED + i)]
        work[np.uintp(L.W_VARIED + i)] += value
    work[np.uintp(L.W_VARIED + L.Y_FILM)] += jump
