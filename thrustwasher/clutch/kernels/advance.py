# mypy: disable-error-code="no-any-return"
"""A pack's memory and its way along an interval of time over which the inputs run straight."""

import math

import numpy as np

from ...numerics.arrays import clear, copy
from ...numerics.jit import Array, kernel
from ...numerics.status import MAX_ITERATIONS, OK
from ...tribology.lumped_body import exponential_weights
from . import layout as L
from .pack_friction import coefficient_slopes, settled_slope
from .rates import given_power, moves_film, n_unknowns, settled_cooling, surfaces
from .rosenbrock import Ramp, attempt
from .rosenbrock_derivatives import Change, follow

MAX_SUBSTEPS = 20_000
N_NEWTON = 12
SOLVED = 1e-15  # relative: no further step of Newton's
LEAST_SHARE = 1e-13  # of the time gone by: no smaller substeps
FIRST_SHARE = 1e-25  # of the interval: the same at its start


@kernel
def load_memory(par: Array, load: float, oil: float, state: Array, work: Array) -> int:
    """Copy the memory to W_NOW, or set the start: film open or settled, steel as warm as oil."""
    status = OK
    work[L.W_SETTLED_LOAD] = 0.0
    n, each = n_unknowns(par), 1 + int(par[L.D_MODES])
    if state[L.S_STARTED] != 0.0:
        copy(state[L.S_FILM :], work[L.W_NOW : L.W_NOW + n])
        return status
    ratio = par[L.D_OPEN_RATIO]
    if par[L.P_STARTS_PRESSED] != 0.0:
        ratio, work[L.W_SETTLED_LOAD], status, _ = settled_slope(par, load, 1.0)
    work[np.uintp(L.W_NOW + L.Y_FILM)] = ratio
    work[np.uintp(L.W_NOW + L.Y_ENERGY)] = 0.0
    for i in range(n - L.Y_HEAT):
        work[np.uintp(L.W_NOW + L.Y_HEAT + i)] = oil if i % each == 0 else 0.0
    return status


@kernel
def store_memory(par: Array, work: Array, base: int, state: Array) -> None:
    """Copy the unknowns at ``work[base:]`` to the memory."""
    state[L.S_STARTED] = 1.0
    copy(work[base:], state[L.S_FILM : L.S_FILM + n_unknowns(par)])


@kernel
def settle_film(par: Array, load: float, work: Array) -> int:
    """Put the settled film to W_NOW where the film is no state; return a status."""
    if moves_film(par):
        return OK
    work[np.uintp(L.W_NOW + L.Y_FILM)], work[L.W_SETTLED_LOAD], status, _ = settled_slope(
        par, load, work[np.uintp(L.W_NOW + L.Y_FILM)]
    )
    return status


@kernel
def warm_up(
    par: Array,
    k: int,
    power_start: float,
    power_end: float,
    oil: float,
    cooling: float,
    duration: float,
    work: Array,
) -> None:
    """Advance a ring's heat in W_NOW exactly, and the energy, under a power that runs straight.

    ``power_start``, ``power_end``: of a face [W]; ``cooling`` of the pack's faces [W/(m2 K)].
    """
    block, n = int(par[L.D_FIRST]) + k * L.N_PACK, 1 + int(par[L.D_MODES])
    for i in range(n):
        place = np.uintp(L.W_NOW + L.Y_HEAT + k * n + i)
        level = oil if i == 0 else 0.0
        rate = par[np.uintp(block + L.D_DECAY + i)]
        if i == 0:
            rate = par[np.uintp(block + L.D_GAIN)] * cooling * par[np.uintp(block + L.D_AREA)]
        decay, first, second = exponential_weights(rate * duration)
        gain = power_start * first + (power_end - power_start) * second
        work[place] = (
            level
            + (work[place] - level) * decay
            + (par[np.uintp(block + L.D_GAIN + i)] * gain * duration)
        )
    work[np.uintp(L.W_NOW + L.Y_ENERGY)] += 0.5 * (power_start + power_end) * duration


@kernel
def settled_power(par: Array, load: float, slip: float, work: Array) -> float:
    """Return the friction power of a face [W] in W_NOW, the film settled, or the one given."""
    if work[L.W_GIVEN] != 0.0:
        return given_power(work, slip)
    surfaces(par, work, L.W_NOW, L.W_SURFACE)
    mu, _, _ = coefficient_slopes(par, slip, work[L.W_SURFACE])
    contact = par[L.P_FACES] * par[L.D_RADIUS] * mu * load
    smooth = math.tanh(abs(slip) / par[L.P_SPEED_SMOOTHING])
    return abs(slip) * (contact * smooth) / par[L.P_FACES]


@kernel
def settle(par: Array, ramp: Ramp, duration: float, power_start: float, work: Array) -> int:
    """Bring W_NOW through an interval where the film is settled: heat only, return a status."""
    work[np.uintp(L.W_NOW + L.Y_FILM)], _, status, _ = settled_slope(
        par, ramp[3], work[np.uintp(L.W_NOW + L.Y_FILM)]
    )
    end = settled_power(par, ramp[3], ramp[4], work)
    cooling = settled_cooling(par, ramp[3])
    start = end if is_held(ramp) else power_start
    follows = par[L.D_TEMPERATURE_LAW] != 0.0 or par[L.P_SHEAR_TEMPERATURE_SLOPE] != 0.0
    if work[L.W_GIVEN] == 0.0 and follows:
        end = warmed_power(par, ramp, start, end, cooling, duration, work)
    warm_up(par, 0, start, end, ramp[2], cooling, duration, work)
    return status


@kernel
def warmed_power(
    par: Array,
    ramp: Ramp,
    start: float,
    end: float,
    cooling: float,
    duration: float,
    work: Array,
) -> float:
    """Return the power of a face [W] at an interval's end, at the temperature it has led to there.

    ``start``, ``end``: at its start, and at its end as warm as at the start. Newton, kept between
    powers that are known to be too low and too high: points over temperature have corners.
    """
    rise, left = 0.0, 0.0  # K per W at the end; K without it
    for i in range(1 + int(par[L.D_MODES])):
        rate = par[np.uintp(L.D_DECAY + i)]
        if i == 0:
            rate = par[L.D_GAIN] * cooling * par[L.D_AREA]
        level = ramp[2] if i == 0 else 0.0
        decay, first, second = exponential_weights(rate * duration)
        gain = par[np.uintp(L.D_GAIN + i)] * duration
        left += level + (work[np.uintp(L.W_NOW + L.Y_HEAT + i)] - level) * decay
        left += gain * (first - second) * start
        rise += gain * second
    smooth = math.tanh(abs(ramp[4]) / par[L.P_SPEED_SMOOTHING])
    lever = abs(ramp[4]) * smooth * par[L.D_RADIUS] * ramp[3]
    low, high = 0.0, math.inf
    for _ in range(N_NEWTON):
        mu, by_t, _ = coefficient_slopes(par, ramp[4], left + rise * end)
        over, steep, last = end - lever * mu, 1.0 - lever * by_t * rise, end
        if over > 0.0:
            high = end
        else:
            low = end
        end = last - over / steep if steep > 0.0 else math.inf
        if not low <= end <= high:
            end = 0.5 * (low + high) if high < math.inf else lever * mu
        if abs(end - last) <= SOLVED * end:
            break
    return end


@kernel
def is_held(ramp: Ramp) -> bool:
    """Tell if load and slip stay as they are."""
    return ramp[0] == ramp[3] and ramp[1] == ramp[4]


@kernel
def is_integrated(par: Array) -> bool:
    """Tell if an interval takes the integrator; else the film is settled and the heat exact."""
    return moves_film(par) or par[L.P_FIDELITY] == L.FINE


@kernel
def advance(
    par: Array, ramp: Ramp, duration: float, power_start: float, first: float, work: Array
) -> int:
    """Bring W_NOW through an interval over which load, slip and oil temperature run straight."""
    if is_integrated(par):
        status = integrate(par, ramp, (0.0, 0.0, 0.0, 0.0), duration, first, False, work)
        return status if status != OK else settle_film(par, ramp[3], work)
    return settle(par, ramp, duration, power_start, work)


@kernel
def integrate(
    par: Array,
    ramp: Ramp,
    change: Change,
    duration: float,
    first: float,
    follows: bool,
    work: Array,
) -> int:
    """Advance the unknowns in W_NOW by ``duration`` [s]; return a status.

    Parameters
    ----------
    ramp : load [N], slip [rad/s], oil temperature [K] at the start, then at the end, then the
        drum's speed [rad/s] at both; straight in between
    change : of the inputs at the end; counts with ``follows`` only
    first : size of the first substep [s] to try, 0 if unknown
    follows : the changes of the unknowns at W_VARIED, which are 0 at the start, go along
    work : unknowns at W_NOW in and out; the numbers of substeps and the next size to try out
    """
    n = n_unknowns(par)
    done, refused = 0.0, 0.0
    share = min(1.0, first / duration) if first > 0.0 else 1.0
    work[L.W_PROPOSED] = duration
    if follows:
        clear(work[L.W_VARIED : L.W_VARIED + n])
    for count in range(MAX_SUBSTEPS):
        remaining = 1.0 - done
        least = LEAST_SHARE * done + FIRST_SHARE
        closing = share >= remaining * (1.0 - 1e-9)
        if closing:
            share = remaining
        taken, factor, status = attempt(par, ramp, duration, done, share, least, work)
        if status != OK:
            return status
        if taken:
            if follows:
                follow(par, ramp, change, done, share, duration, work)
            copy(work[L.W_TRIAL :], work[L.W_NOW : L.W_NOW + n])
            done += share
            proposed = share * factor * duration
            if closing:
                # an interval's last substep may be a crumb: it says nothing about the next one
                work[L.W_PROPOSED] = max(work[L.W_PROPOSED], proposed) if count > 0 else proposed
                work[L.W_SUBSTEPS] = float(count + 1) - refused
                work[L.W_REFUSED] = refused
                return OK
            work[L.W_PROPOSED] = proposed
        else:
            refused += 1.0
        share = max(share * factor, least)
    return MAX_ITERATIONS
