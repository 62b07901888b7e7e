# mypy: disable-error-code="no-any-return"
"""A pack at a point in time: its memory, its way to the next point, its outputs with slopes."""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_friction import (
    coefficient_of,
    coefficient_slopes,
    contact_slopes,
    settled_ratio,
    settled_slope,
    viscous_slopes,
)
from .clutch_integrate import engage
from .clutch_stage import surface_temperature
from .heating import exponential_weights

Array = NDArray[np.float64]


@kernel
def moves_film(par: Array) -> bool:
    """Tell if film and viscous torque belong to the model."""
    return par[L.P_FIDELITY] == L.FIELD and par[L.P_FILM_DYNAMICS] != 0.0


@kernel
def load_memory(par: Array, load: float, oil: float, state: Array, work: Array) -> int:
    """Copy the memory to W_NOW, or set the start: film open or settled, steel as warm as oil."""
    status = L.OK
    work[L.W_SETTLED_LOAD] = 0.0
    if state[L.S_STARTED] != 0.0:
        work[np.uintp(L.W_NOW + L.Y_FILM)] = state[L.S_FILM]
        work[np.uintp(L.W_NOW + L.Y_ENERGY)] = state[L.S_ENERGY]
        work[np.uintp(L.W_NOW + L.Y_HEAT)] = state[L.S_HEAT]
        for i in range(int(par[L.D_MODES])):
            work[np.uintp(L.W_NOW + L.Y_HEAT + 1 + i)] = state[np.uintp(L.S_MODES + i)]
        return status
    ratio = par[L.D_OPEN_RATIO]
    if par[L.P_STARTS_PRESSED] != 0.0:
        ratio, work[L.W_SETTLED_LOAD], status, _ = settled_slope(par, load, 1.0)
    work[np.uintp(L.W_NOW + L.Y_FILM)] = ratio
    work[np.uintp(L.W_NOW + L.Y_ENERGY)] = 0.0
    work[np.uintp(L.W_NOW + L.Y_HEAT)] = oil
    for i in range(int(par[L.D_MODES])):
        work[np.uintp(L.W_NOW + L.Y_HEAT + 1 + i)] = 0.0
    return status


@kernel
def store_memory(par: Array, work: Array, base: int, state: Array) -> None:
    """Copy the unknowns at ``work[base:]`` to the memory."""
    state[L.S_STARTED] = 1.0
    state[L.S_FILM] = work[np.uintp(base + L.Y_FILM)]
    state[L.S_ENERGY] = work[np.uintp(base + L.Y_ENERGY)]
    state[L.S_HEAT] = work[np.uintp(base + L.Y_HEAT)]
    for i in range(int(par[L.D_MODES])):
        state[np.uintp(L.S_MODES + i)] = work[np.uintp(base + L.Y_HEAT + 1 + i)]


@kernel
def warm_up(
    par: Array, power_start: float, power_end: float, oil: float, duration: float, work: Array
) -> None:
    """Advance heat and energy in W_NOW exactly, under a face's power [W] that changes linearly."""
    if par[L.P_FIDELITY] != L.BOUNDARY_ONLY:
        for i in range(int(par[L.D_MODES]) + 1):
            place = np.uintp(L.W_NOW + L.Y_HEAT + i)
            level = oil if i == 0 else 0.0
            decay, first, second = exponential_weights(par[np.uintp(L.D_DECAY + i)] * duration)
            gain = power_start * first + (power_end - power_start) * second
            work[place] = (
                level
                + (work[place] - level) * decay
                + (par[np.uintp(L.D_GAIN + i)] * gain * duration)
            )
    work[np.uintp(L.W_NOW + L.Y_ENERGY)] += 0.5 * (power_start + power_end) * duration


@kernel
def settled_power(par: Array, load: float, slip: float, work: Array) -> float:
    """Return the friction power of a face [W] in the state W_NOW, the film settled."""
    temperature = surface_temperature(par, work, L.W_NOW)
    mu, _ = coefficient_of(par, slip, temperature)
    contact = par[L.P_FACES] * par[L.D_RADIUS] * mu * load
    smooth = math.tanh(abs(slip) / par[L.P_SPEED_SMOOTHING])
    return abs(slip) * (contact * smooth) / par[L.P_FACES]


@kernel
def settle(
    par: Array, course: tuple[float, float, float, float, float, float], duration: float,
    power_start: float, work: Array,
) -> int:  # fmt: skip
    """Bring W_NOW through a stretch where the film is settled: heat only, return a status."""
    work[np.uintp(L.W_NOW + L.Y_FILM)], status, _ = settled_ratio(
        par, course[3], work[np.uintp(L.W_NOW + L.Y_FILM)]
    )
    end = settled_power(par, course[3], course[4], work)
    held = course[0] == course[3] and course[1] == course[4]
    warm_up(par, end if held else power_start, end, course[2], duration, work)
    return status


@kernel
def advance(
    par: Array, course: tuple[float, float, float, float, float, float], duration: float,
    power_start: float, first: float, work: Array,
) -> int:  # fmt: skip
    """Bring W_NOW through a stretch over which load, slip and oil temperature run straight."""
    if moves_film(par):
        return engage(par, course, duration, first, work)
    return settle(par, course, duration, power_start, work)


@kernel
def fill_outputs(par: Array, load: float, slip: float, work: Array, out: Array) -> None:
    """Fill what follows from film and temperature in W_NOW; temperature and energy come later.

    The slopes behind it stay in ``work``, from W_CONTACT on.
    """
    u = work[np.uintp(L.W_NOW + L.Y_FILM)]
    temperature = surface_temperature(par, work, L.W_NOW)
    mu, mu_heat, mu_slip = coefficient_slopes(par, slip, temperature)
    viscous, by_film, by_heat, by_slip, eta, eta_slope, share, share_slope = viscous_slopes(
        par, slip, u, temperature
    )
    if moves_film(par):
        (
            contact, work[L.W_CONTACT_FILM], work[L.W_CONTACT_HEAT], work[L.W_CONTACT_SLIP],
            work[L.W_CONTACT_LOAD], _, _,
        ) = contact_slopes(par, load, slip, u, temperature)  # fmt: skip
    else:
        lever = par[L.P_FACES] * par[L.D_RADIUS]
        contact, work[L.W_CONTACT_FILM] = lever * mu * load, 0.0
        work[L.W_CONTACT_HEAT] = lever * mu_heat * load
        work[L.W_CONTACT_SLIP], work[L.W_CONTACT_LOAD] = lever * mu_slip * load, lever * mu
        viscous, by_film, by_heat, by_slip = 0.0, 0.0, 0.0, 0.0
    smooth = math.tanh(slip / par[L.P_SPEED_SMOOTHING])
    work[L.W_CONTACT], work[L.W_VISCOUS], work[L.W_SMOOTH] = contact, viscous, smooth
    work[L.W_VISCOUS_FILM], work[L.W_VISCOUS_HEAT] = by_film, by_heat
    work[L.W_VISCOUS_SLIP] = by_slip
    work[L.W_FRICTION_SLIP], work[L.W_FRICTION_HEAT] = mu_slip, mu_heat
    work[L.W_SHARE_FILM], work[L.W_VISCOSITY_HEAT] = share_slope, eta_slope
    dry = contact * smooth
    wet = math.copysign(viscous, slip)
    out[L.O_TORQUE] = dry + wet
    out[L.O_CONTACT_TORQUE], out[L.O_VISCOUS_TORQUE] = dry, wet
    out[L.O_CAPACITY] = contact + viscous
    out[L.O_POWER] = out[L.O_TORQUE] * slip
    out[L.O_HEAT_FLUX] = out[L.O_POWER] / (par[L.P_FACES] * par[L.D_AREA])
    out[L.O_COEFFICIENT] = mu
    out[L.O_FILM], out[L.O_RATIO] = u * par[L.P_ROUGHNESS], u
    out[L.O_CONTACT_SHARE], out[L.O_VISCOSITY] = share, eta
