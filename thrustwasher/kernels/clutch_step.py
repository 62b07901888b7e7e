# mypy: disable-error-code="no-any-return"
"""One co-simulation step of the wet clutch: film, heat and friction of the pack.

``input_course`` says what the inputs do inside a step. Held: they stay, the step ends with all
outputs at its end. Linear: they run straight from one communication point to the next. Then a step
first brings film and heat from the last point to the present one, whose inputs are known now, gives
the friction there, and books heat in advance with the present power; the next step replaces that
advance. This couples with second order to a partner that looks ahead by itself.
"""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_constants import derive
from .clutch_friction import (
    coefficient_of,
    contact_share,
    contact_torque,
    regime_of,
    settled_ratio,
    viscous_torque,
)
from .clutch_integrate import engage, surface_temperature
from .clutch_rules import broken_rule
from .heating import exponential_weights

__all__ = [
    "NINP", "NIOUT", "NOUT", "NPAR", "NSTATE", "NWORK", "N_PARAM", "broken_rule", "derive", "step",
]  # fmt: skip

Array = NDArray[np.float64]
N_PARAM, NPAR, NINP, NSTATE, NWORK = L.N_PARAM, L.NPAR, L.NINP, L.NSTATE, L.NWORK
NOUT, NIOUT = L.NOUT, L.NIOUT


@kernel
def moves_film(par: Array) -> bool:
    """Tell if film and viscous torque belong to the model."""
    return par[L.P_FIDELITY] == L.FIELD and par[L.P_FILM_DYNAMICS] != 0.0


@kernel
def load_memory(par: Array, load: float, oil: float, state: Array, work: Array) -> int:
    """Copy the memory to W_NOW, or set the start: film open or settled, steel as warm as oil."""
    status = L.OK
    if state[L.S_STARTED] != 0.0:
        work[np.uintp(L.W_NOW + L.Y_FILM)] = state[L.S_FILM]
        work[np.uintp(L.W_NOW + L.Y_ENERGY)] = state[L.S_ENERGY]
        work[np.uintp(L.W_NOW + L.Y_HEAT)] = state[L.S_HEAT]
        for i in range(int(par[L.D_MODES])):
            work[np.uintp(L.W_NOW + L.Y_HEAT + 1 + i)] = state[np.uintp(L.S_MODES + i)]
        return status
    ratio = par[L.D_OPEN_RATIO]
    if par[L.P_STARTS_PRESSED] != 0.0:
        ratio, status, _ = settled_ratio(par, load, 1.0)
    work[np.uintp(L.W_NOW + L.Y_FILM)] = ratio
    work[np.uintp(L.W_NOW + L.Y_ENERGY)] = 0.0
    work[np.uintp(L.W_NOW + L.Y_HEAT)] = oil
    for i in range(int(par[L.D_MODES])):
        work[np.uintp(L.W_NOW + L.Y_HEAT + 1 + i)] = 0.0
    return status


@kernel
def store_memory(par: Array, work: Array, state: Array) -> None:
    """Copy W_NOW to the memory."""
    state[L.S_STARTED] = 1.0
    state[L.S_FILM] = work[np.uintp(L.W_NOW + L.Y_FILM)]
    state[L.S_ENERGY] = work[np.uintp(L.W_NOW + L.Y_ENERGY)]
    state[L.S_HEAT] = work[np.uintp(L.W_NOW + L.Y_HEAT)]
    for i in range(int(par[L.D_MODES])):
        state[np.uintp(L.S_MODES + i)] = work[np.uintp(L.W_NOW + L.Y_HEAT + 1 + i)]


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
def face_power(par: Array, load: float, slip: float, film: bool, work: Array) -> float:
    """Return the friction power of a face [W] in the state W_NOW."""
    temperature = surface_temperature(par, work, L.W_NOW)
    if film:
        u = work[np.uintp(L.W_NOW + L.Y_FILM)]
        contact = contact_torque(par, load, slip, u, temperature)[0]
        viscous = viscous_torque(par, slip, u, temperature)[0]
    else:
        mu, _ = coefficient_of(par, slip, temperature)
        contact = par[L.P_FACES] * par[L.D_RADIUS] * mu * load
        viscous = 0.0
    smooth = math.tanh(abs(slip) / par[L.P_SPEED_SMOOTHING])
    return abs(slip) * (contact * smooth + viscous) / par[L.P_FACES]


@kernel
def advance(
    par: Array, course: tuple[float, float, float, float, float, float], duration: float,
    power_start: float, first: float, work: Array,
) -> int:  # fmt: skip
    """Bring W_NOW through a stretch over which load, slip and oil temperature run straight."""
    if moves_film(par):
        return engage(par, course, duration, first, work)
    status = L.OK
    work[np.uintp(L.W_NOW + L.Y_FILM)], status, _ = settled_ratio(
        par, course[3], work[np.uintp(L.W_NOW + L.Y_FILM)]
    )
    end = face_power(par, course[3], course[4], False, work)
    held = course[0] == course[3] and course[1] == course[4]
    warm_up(par, end if held else power_start, end, course[2], duration, work)
    return status


@kernel
def fill_outputs(par: Array, load: float, slip: float, work: Array, out: Array) -> None:
    """Fill what follows from film and temperature in W_NOW; temperature and energy come later."""
    film = moves_film(par)
    u = work[np.uintp(L.W_NOW + L.Y_FILM)]
    temperature = surface_temperature(par, work, L.W_NOW)
    mu, _ = coefficient_of(par, slip, temperature)
    viscous, _, _, eta, _, share = viscous_torque(par, slip, u, temperature)
    if film:
        contact = contact_torque(par, load, slip, u, temperature)[0]
    else:
        contact, viscous = par[L.P_FACES] * par[L.D_RADIUS] * mu * load, 0.0
        share = contact_share(par, u)[0]
    dry = contact * math.tanh(slip / par[L.P_SPEED_SMOOTHING])
    wet = math.copysign(viscous, slip)
    out[L.O_TORQUE] = dry + wet
    out[L.O_CONTACT_TORQUE], out[L.O_VISCOUS_TORQUE] = dry, wet
    out[L.O_CAPACITY] = contact + viscous
    out[L.O_POWER] = out[L.O_TORQUE] * slip
    out[L.O_HEAT_FLUX] = out[L.O_POWER] / (par[L.P_FACES] * par[L.D_AREA])
    out[L.O_COEFFICIENT] = mu
    out[L.O_FILM], out[L.O_RATIO] = u * par[L.P_ROUGHNESS], u
    out[L.O_CONTACT_SHARE], out[L.O_VISCOSITY] = share, eta


@kernel
def step(
    par: Array,
    inp: Array,
    state: Array,
    work: Array,
    out: Array,
    iout: NDArray[np.int32],
    t: float,
    dt: float,
) -> int:
    """Advance the pack from t to t + dt, then fill the outputs.

    Returns 0 or the status of a failure; advice stands in ``iout`` only.
    """
    load, slip, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    if not (
        math.isfinite(load) and load >= 0.0 and math.isfinite(slip) and math.isfinite(oil)
        and math.isfinite(dt) and dt >= 0.0 and oil > 0.0
    ):  # fmt: skip
        iout[L.IO_STATUS] = L.BAD_INPUT
        return L.BAD_INPUT
    started = state[L.S_STARTED] != 0.0
    linear = par[L.P_INPUT_COURSE] == L.LINEAR_COURSE
    film = moves_film(par)
    work[L.W_SUBSTEPS] = work[L.W_REFUSED] = 0.0
    work[L.W_PROPOSED] = state[L.S_SUBSTEP]
    status = load_memory(par, load, oil, state, work)
    if par[L.P_FIDELITY] == L.BOUNDARY_ONLY:
        work[np.uintp(L.W_NOW + L.Y_HEAT)] = oil
    if linear:
        if started and status == L.OK:
            course = (state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL], load, slip, oil)
            status = advance(
                par, course, state[L.S_DURATION], state[L.S_POWER], state[L.S_SUBSTEP], work
            )
    elif dt > 0.0 and status == L.OK:
        course = (load, slip, oil, load, slip, oil)
        status = advance(par, course, dt, 0.0, state[L.S_SUBSTEP], work)
    if not film and status == L.OK:
        work[np.uintp(L.W_NOW + L.Y_FILM)], status, _ = settled_ratio(
            par, load, work[np.uintp(L.W_NOW + L.Y_FILM)]
        )
    fill_outputs(par, load, slip, work, out)
    power = out[L.O_POWER] / par[L.P_FACES]
    temperature = surface_temperature(par, work, L.W_NOW)
    energy = par[L.P_FACES] * work[np.uintp(L.W_NOW + L.Y_ENERGY)]
    keep = dt > 0.0 and status == L.OK
    if keep:
        keep = _is_finite(work, par, out)
        if not keep:
            status = L.NOT_FINITE
    if keep:
        store_memory(par, work, state)
        state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL] = load, slip, oil
        state[L.S_POWER], state[L.S_DURATION], state[L.S_SUBSTEP] = power, dt, work[L.W_PROPOSED]
    if linear and dt > 0.0:
        warm_up(par, power, power, oil, dt, work)
        temperature = surface_temperature(par, work, L.W_NOW)
        energy = par[L.P_FACES] * work[np.uintp(L.W_NOW + L.Y_ENERGY)]
    elif linear and started:
        energy = state[L.S_SHOWN_ENERGY]
        if par[L.P_FIDELITY] != L.BOUNDARY_ONLY:
            temperature = state[L.S_SHOWN_TEMPERATURE]
    # Heat does not come back: where the advance was too large the output waits.
    energy = max(energy, state[L.S_SHOWN_ENERGY])
    if keep:
        state[L.S_SHOWN_TEMPERATURE], state[L.S_SHOWN_ENERGY] = temperature, energy
    out[L.O_TEMPERATURE], out[L.O_ENERGY] = temperature, energy
    iout[L.IO_REGIME] = regime_of(par, out[L.O_RATIO], slip)
    if status == L.OK:
        for i in range(L.NOUT):
            if not math.isfinite(out[np.uintp(i)]):
                status = L.NOT_FINITE
    advice = L.OK
    if out[L.O_RATIO] < L.LEAST_RATIO:
        advice = L.OUTSIDE_VERIFIED
    if temperature > L.HOT_LIMIT:
        advice = L.HOT
    iout[L.IO_STATUS] = advice if status == L.OK else status
    return status


@kernel
def _is_finite(work: Array, par: Array, out: Array) -> bool:
    """Tell if the unknowns and the outputs filled so far are numbers."""
    good = True
    for i in range(L.Y_HEAT + 1 + int(par[L.D_MODES])):
        good = good and math.isfinite(work[np.uintp(L.W_NOW + i)])
    return good and math.isfinite(out[L.O_POWER])
