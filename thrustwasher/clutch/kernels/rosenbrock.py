# mypy: disable-error-code="no-any-return"
"""Film, heat and energy of an engaging pack over an interval of time, implicitly, error controlled.

The film follows the load at hundreds per second, so the method is linearly implicit and L-stable:
RODAS (order 4, six stages, embedded order 3) of Hairer & Wanner, Solving Ordinary Differential
Equations II, VI.4. The heat of a ring is linear but for its friction power, which depends on film
ratio and interface temperature alone, and for the cooling, which depends on the film ratio: every
stage is a 2 x 2 system for each ring, whatever the number of conduction modes.

A film is squeezed out through the cube of its thickness: in its ratio u a substep may shrink it by
a few per cent only. The unknown of a substep is therefore q(u), so bent that the ease of flow is
constant along it at the substep's start: 1 - 2 b q = 1/(1 + b (u - u_0))^2 with b a third of the
ease's logarithmic slope, which for u^3 is exact and for a settled or opening film is u itself.
"""

import math

import numpy as np

from ...numerics.arrays import copy
from ...numerics.jit import Array, kernel
from ...numerics.status import NOT_FINITE, OK
from . import layout as L
from .rates import n_unknowns, pack_rates, ring_at, surfaces

Ramp = tuple[float, float, float, float, float, float, float, float]
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
ALPHA = np.array([0.0, 0.386, 0.21, 0.63, 1.0, 1.0])  # of the stages, share of the substep
DRIFT = np.array([0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0])  # weight of the rates' drift
NUDGE = 1e-3  # share of a substep after which the drift of the rates is read

TOLERANCE_FILM = 1e-5  # error of a substep, of film ratio + 1
LATE = 2e-4  # of the interval: by so much a substep's film may be early or late
LATE_SHARE = 1e-1  # of its way in the substep: by no more
TOLERANCE_HEAT = 1e-4  # K
TOLERANCE_ENERGY = 1e-5  # the same, of the energy, in the warmth of the pack's steel
TOLERANCE_RISE = 1e-3  # K, of a lumped pack's interface when conduction modes are on top
SHARE_IN_RINGS = 0.3  # of the tolerance that a pack in rings may use
FAR = 5.0  # of film ratio + 1: a substep after a refused one goes no further at the first rate


@kernel
def is_moving(ramp: Ramp) -> bool:
    """Tell if the inputs at the end of an interval differ from those at its start."""
    return ramp[0] != ramp[3] or ramp[1] != ramp[4] or ramp[2] != ramp[5] or ramp[6] != ramp[7]


@kernel
def unbent(q: float, bend: float) -> float:
    """Return the change of the film ratio that belongs to the unknown q; nan where there is none.

    q = (1 - 1/w^2)/(2 bend), w = 1 + bend (u - u_0): dq/du = 1/w^3, 1 at the substep's start.
    """
    rest = 1.0 - 2.0 * bend * q
    if not rest > 0.0:
        return math.nan
    w = 1.0 / math.sqrt(rest)
    return 2.0 * q * w * w / (1.0 + w)


@kernel
def bend_rates(par: Array, work: Array, kept: int, u: float) -> None:
    """Turn the rates and slopes at ``work[kept:]``, at the film ratio ``u``, to those of q."""
    bend = work[L.W_BEND]
    if bend == 0.0:
        return
    w = 1.0 + bend * (u - work[np.uintp(L.W_NOW + L.Y_FILM)])
    cube = w * w * w
    steep = 1.0 / cube
    work[np.uintp(kept + L.R_RATE_U)] -= 3.0 * bend / w * work[np.uintp(kept + L.R_RATE)]
    work[np.uintp(kept + L.R_RATE)] *= steep
    work[np.uintp(kept + L.R_RATE_F)] *= steep
    for k in range(int(par[L.D_RINGS])):
        ring = kept + L.R_RINGS + k * L.N_OF_RING
        work[np.uintp(ring + L.R_RATE_T)] *= steep
        work[np.uintp(ring + L.R_POWER_U)] *= cube
        work[np.uintp(ring + L.R_COOL_U)] *= cube


@kernel
def _rates(par: Array, ramp: Ramp, x: float, work: Array, base: int, place: int) -> None:
    """Fill W_RATE with the rates of all unknowns at the share ``x`` of the interval.

    ``ramp``: load, slip, oil temperature at the start, then at the end, then the drum's speed at
    both. The slopes are kept at the ``place``-th of W_KEPT.
    """
    load = ramp[0] + (ramp[3] - ramp[0]) * x
    slip = ramp[1] + (ramp[4] - ramp[1]) * x
    oil = ramp[2] + (ramp[5] - ramp[2]) * x
    drum = ramp[6] + (ramp[7] - ramp[6]) * x
    kept = L.W_KEPT + place * L.N_RATES
    surfaces(par, work, base, L.W_SURFACE)
    pack_rates(par, max(load, 0.0), slip, drum, work[np.uintp(base + L.Y_FILM)], work, kept)
    n, total = 1 + int(par[L.D_MODES]), 0.0
    for k in range(int(par[L.D_RINGS])):
        ring, own, heat = ring_at(par, k), kept + L.R_RINGS + k * L.N_OF_RING, L.Y_HEAT + k * n
        power = work[np.uintp(own + L.R_POWER)]
        total += power
        excess = work[np.uintp(base + heat)] - oil
        work[np.uintp(own + L.R_EXCESS)] = excess
        net = power - work[np.uintp(own + L.R_COOL)] * excess
        work[np.uintp(L.W_RATE + heat)] = par[np.uintp(ring + L.D_GAIN)] * net
        for i in range(1, n):
            cooled = par[np.uintp(ring + L.D_DECAY + i)] * work[np.uintp(base + heat + i)]
            warmed = par[np.uintp(ring + L.D_GAIN + i)] * power
            work[np.uintp(L.W_RATE + heat + i)] = warmed - cooled
    bend_rates(par, work, kept, work[np.uintp(base + L.Y_FILM)])
    work[np.uintp(L.W_RATE + L.Y_FILM)] = work[np.uintp(kept + L.R_RATE)]
    work[np.uintp(L.W_RATE + L.Y_ENERGY)] = total


@kernel
def factorise(par: Array, s: float, work: Array) -> None:
    """Fill what all stages' systems (s - J) U = right side share; J is kept at the first place.

    A ring and the film: (s - f_u) du - f_T D = r, (1 - gain P_T) D - warmed du = held, D being the
    change of the ring's interface. The other rings are eliminated from that of the film and the
    first one, which needs no pivot but its determinant.
    """
    n, others = 1 + int(par[L.D_MODES]), 0.0
    for k in range(int(par[L.D_RINGS])):
        ring, own = ring_at(par, k), L.W_KEPT + L.R_RINGS + k * L.N_OF_RING
        pivot = L.W_PIVOT + k * n
        first = par[np.uintp(ring + L.D_GAIN)]
        per = 1.0 / (s + first * work[np.uintp(own + L.R_COOL)])
        work[np.uintp(pivot)] = per
        gain = mean = first * per
        for i in range(1, n):
            per = 1.0 / (s + par[np.uintp(ring + L.D_DECAY + i)])
            work[np.uintp(pivot + i)] = per
            gain += par[np.uintp(ring + L.D_GAIN + i)] * per
        cooled = work[np.uintp(own + L.R_COOL_U)] * work[np.uintp(own + L.R_EXCESS)]
        warmed = gain * work[np.uintp(own + L.R_POWER_U)] - mean * cooled
        diagonal = 1.0 - gain * work[np.uintp(own + L.R_POWER_T)]
        work[np.uintp(L.W_WARMED + k)], work[np.uintp(L.W_DIAGONAL + k)] = warmed, diagonal
        work[np.uintp(L.W_COOLED + k)] = cooled
        if k > 0:
            slope = work[np.uintp(own + L.R_RATE_T)] / diagonal
            work[np.uintp(L.W_COUPLED + k)] = slope
            others += slope * warmed
    left = s - work[L.W_KEPT + L.R_RATE_U] - others
    coupled = work[L.W_KEPT + L.R_RINGS + L.R_RATE_T]
    determinant = left * work[L.W_DIAGONAL] - coupled * work[L.W_WARMED]
    work[L.W_FILM_PIVOT], work[L.W_COUPLED] = left, coupled
    work[L.W_DETERMINANT] = determinant if determinant != 0.0 else math.nan


@kernel
def cooled_by_film(own: Array) -> float:
    """Return the slope of a face's heat to the oil over the film ratio [W]; ``own`` of a ring."""
    return own[L.R_COOL_U] * own[L.R_EXCESS]


@kernel
def solve_stage(par: Array, s: float, work: Array, stage: int) -> None:
    """Turn the right side in the stage's place into its solution, with what ``factorise`` left."""
    n, rings = 1 + int(par[L.D_MODES]), int(par[L.D_RINGS])
    right, energy = work[np.uintp(stage + L.Y_FILM)], work[np.uintp(stage + L.Y_ENERGY)]
    heat, pivot = stage + L.Y_HEAT, L.W_PIVOT
    for k in range(rings):
        held = 0.0
        for i in range(n):
            held += work[np.uintp(heat + i)] * work[np.uintp(pivot + i)]
        work[np.uintp(L.W_HELD + k)] = held
        if k > 0:
            right += work[np.uintp(L.W_COUPLED + k)] * held
        heat, pivot = heat + n, pivot + n
    per, first = 1.0 / work[L.W_DETERMINANT], work[L.W_HELD]
    film = (right * work[L.W_DIAGONAL] + work[L.W_COUPLED] * first) * per
    surface = (work[L.W_FILM_PIVOT] * first + work[L.W_WARMED] * right) * per
    heat, pivot = stage + L.Y_HEAT, L.W_PIVOT
    for k in range(rings):
        ring, own = ring_at(par, k), L.W_KEPT + L.R_RINGS + k * L.N_OF_RING
        if k > 0:
            surface = work[np.uintp(L.W_HELD + k)] + work[np.uintp(L.W_WARMED + k)] * film
            surface /= work[np.uintp(L.W_DIAGONAL + k)]
        power = work[np.uintp(own + L.R_POWER_U)] * film
        power += work[np.uintp(own + L.R_POWER_T)] * surface
        energy += power
        net = power - work[np.uintp(L.W_COOLED + k)] * film
        for i in range(n):
            gained = par[np.uintp(ring + L.D_GAIN + i)] * (net if i == 0 else power)
            place = np.uintp(heat + i)
            work[place] = (work[place] + gained) * work[np.uintp(pivot + i)]
        heat, pivot = heat + n, pivot + n
    work[np.uintp(stage + L.Y_FILM)] = film
    work[np.uintp(stage + L.Y_ENERGY)] = energy / s


@kernel
def _sum_up(work: Array, shares: Array, k: int, i: int) -> float:
    """Return the sum of the stages before ``k`` times their shares; of the i-th unknown."""
    total = 0.0
    for j in range(k):
        total += shares[k, j] * work[np.uintp(L.W_STAGES + j * L.NY + i)]
    return total


@kernel
def _start_bend(work: Array, kept: int) -> None:
    """Turn the slope over the film at a substep's start into that over q; the rest is the same."""
    bent = 3.0 * work[L.W_BEND] * work[np.uintp(kept + L.R_RATE)]
    work[np.uintp(kept + L.R_RATE_U)] -= bent


@kernel
def substep(par: Array, ramp: Ramp, x: float, share: float, duration: float, work: Array) -> float:
    """Fill W_TRIAL with the state a substep later; return its error in units of the tolerance."""
    n, h = n_unknowns(par), share * duration
    s, per = 1.0 / (GAMMA * h), 1.0 / h
    moving = is_moving(ramp)
    last = L.W_STAGES + (L.N_STAGES - 1) * L.NY
    now, film = work[np.uintp(L.W_NOW + L.Y_FILM)], np.uintp(L.W_TRIAL + L.Y_FILM)
    work[L.W_BEND] = 0.0
    if moving:  # the drift of the rates is differenced; it goes where the last stage will be
        _rates(par, ramp, x + NUDGE * share, work, L.W_NOW, L.DRIFTED)
        copy(work[L.W_RATE :], work[last : last + n])
    _rates(par, ramp, x, work, L.W_NOW, 0)
    bend = work[L.W_BEND] = work[L.W_BEND_HERE]
    _start_bend(work, L.W_KEPT)
    if moving:
        _start_bend(work, L.W_KEPT + L.DRIFTED * L.N_RATES)
    factorise(par, s, work)
    if moving:
        for i in range(n):
            place = np.uintp(last + i)
            work[place] = (work[place] - work[np.uintp(L.W_RATE + i)]) / (NUDGE * h)
    for k in range(L.N_STAGES):
        if k > 0:
            for i in range(L.Y_ENERGY, n):
                value = work[np.uintp(L.W_NOW + i)] + _sum_up(work, A, k, i)
                work[np.uintp(L.W_TRIAL + i)] = value
            q = _sum_up(work, A, k, L.Y_FILM)
            work[film] = now + unbent(q, bend)
            _rates(par, ramp, x + ALPHA[k] * share, work, L.W_TRIAL, k)
            work[film] = q
        stage = L.W_STAGES + k * L.NY
        for i in range(n):
            value = work[np.uintp(L.W_RATE + i)] + _sum_up(work, C, k, i) * per
            if moving and k < 4:
                value += DRIFT[k] * h * work[np.uintp(last + i)]
            work[np.uintp(stage + i)] = value
        solve_stage(par, s, work, stage)
    for i in range(n):
        work[np.uintp(L.W_TRIAL + i)] += work[np.uintp(last + i)]
    work[film] = now + unbent(work[film], bend)
    return _error(par, work, last, duration)


@kernel
def _error(par: Array, work: Array, last: int, duration: float) -> float:
    """Return the error of a substep, its last stage, in units of the tolerance.

    An error of the film counts less where it moves: it is then a matter of when it is where, as
    long as it is small beside the way that the film goes in the substep.
    """
    ratio = work[np.uintp(L.W_TRIAL + L.Y_FILM)]
    w = 1.0 + work[L.W_BEND] * (ratio - work[np.uintp(L.W_NOW + L.Y_FILM)])
    steep = 1.0 / (w * w * w)
    begins = abs(work[np.uintp(L.W_KEPT + L.R_RATE)])
    ends = abs(work[np.uintp(L.W_KEPT + (L.N_STAGES - 1) * L.N_RATES + L.R_RATE)])
    gone = abs(ratio - work[np.uintp(L.W_NOW + L.Y_FILM)])
    late = min(LATE * duration * min(begins, ends), LATE_SHARE * gone * steep)
    allowed = TOLERANCE_FILM * (1.0 + abs(ratio)) * steep + late
    film = work[np.uintp(last + L.Y_FILM)] / allowed
    n, is_lumped = 1 + int(par[L.D_MODES]), par[L.D_FIRST] == 0.0
    tolerance = TOLERANCE_RISE if is_lumped and n > 1 else TOLERANCE_HEAT
    energy = abs(work[np.uintp(last + L.Y_ENERGY)]) * par[L.D_GAIN]
    error = max(abs(film), energy / TOLERANCE_ENERGY)
    for k in range(int(par[L.D_RINGS])):
        heat = 0.0
        for i in range(n):
            heat += work[np.uintp(last + L.Y_HEAT + k * n + i)]
        error = max(error, abs(heat) / tolerance)
    return error if is_lumped else error / SHARE_IN_RINGS


@kernel
def attempt(
    par: Array,
    ramp: Ramp,
    duration: float,
    done: float,
    share: float,
    least: float,
    work: Array,
) -> tuple[bool, float, int]:
    """Try a substep from W_NOW to W_TRIAL; return if it counts, how its size should change, status.

    It goes from the share ``done`` of the interval over ``share`` of it. A jump of the rates inside
    the interval (the pack opens, a limit is met) shrinks the substeps until it is passed; one as
    small as ``least`` is taken.
    """
    error = substep(par, ramp, done, share, duration, work)
    if not math.isfinite(error):
        error = 1e6
        if share <= least:
            return False, 0.1, NOT_FINITE
    factor = 6.0 if error < 1e-5 else min(6.0, max(0.1, 0.9 / math.sqrt(math.sqrt(error))))
    if error <= 1.0 or share <= least:
        return True, factor, OK
    rate = abs(work[np.uintp(L.W_KEPT + L.R_RATE)])
    near = FAR * (1.0 + abs(work[np.uintp(L.W_NOW + L.Y_FILM)]))
    factor = min(factor, 0.9)
    if near < factor * share * duration * rate:
        factor = near / (share * duration * rate)
    return False, factor, OK
