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
from .clutch_layout import (
    BAD_INPUT,
    BOUNDARY_ONLY,
    D_AREA,
    D_DECAY,
    D_GAIN,
    D_MODES,
    D_OPEN_RATIO,
    D_RADIUS,
    FIELD,
    HOT,
    HOT_LIMIT,
    I_LOAD,
    I_OIL,
    I_SPEED,
    IO_REGIME,
    IO_STATUS,
    LINEAR_COURSE,
    N_PARAM,
    NINP,
    NIOUT,
    NOT_FINITE,
    NOUT,
    NPAR,
    NSTATE,
    NWORK,
    O_CAPACITY,
    O_COEFFICIENT,
    O_CONTACT_SHARE,
    O_CONTACT_TORQUE,
    O_ENERGY,
    O_FILM,
    O_HEAT_FLUX,
    O_POWER,
    O_RATIO,
    O_TEMPERATURE,
    O_TORQUE,
    O_VISCOSITY,
    O_VISCOUS_TORQUE,
    OK,
    P_FACES,
    P_FIDELITY,
    P_FILM_DYNAMICS,
    P_INPUT_COURSE,
    P_ROUGHNESS,
    P_SPEED_SMOOTHING,
    P_STARTS_PRESSED,
    S_DURATION,
    S_ENERGY,
    S_FILM,
    S_HEAT,
    S_LOAD,
    S_MODES,
    S_OIL,
    S_POWER,
    S_SHOWN_ENERGY,
    S_SHOWN_TEMPERATURE,
    S_SLIP,
    S_STARTED,
    S_SUBSTEP,
    W_NOW,
    W_PROPOSED,
    W_REFUSED,
    W_SUBSTEPS,
    Y_ENERGY,
    Y_FILM,
    Y_HEAT,
)  # fmt: skip
from .heating import exponential_weights

__all__ = ["NINP", "NIOUT", "NOUT", "NPAR", "NSTATE", "NWORK", "N_PARAM", "derive", "step"]

Array = NDArray[np.float64]


@kernel
def moves_film(par: Array) -> bool:
    """Tell if film and viscous torque belong to the model."""
    return par[P_FIDELITY] == FIELD and par[P_FILM_DYNAMICS] != 0.0


@kernel
def load_memory(par: Array, load: float, oil: float, state: Array, work: Array) -> int:
    """Copy the memory to W_NOW, or set the start: film open or settled, steel as warm as oil."""
    status = OK
    if state[S_STARTED] != 0.0:
        work[np.uintp(W_NOW + Y_FILM)] = state[S_FILM]
        work[np.uintp(W_NOW + Y_ENERGY)] = state[S_ENERGY]
        work[np.uintp(W_NOW + Y_HEAT)] = state[S_HEAT]
        for i in range(int(par[D_MODES])):
            work[np.uintp(W_NOW + Y_HEAT + 1 + i)] = state[np.uintp(S_MODES + i)]
        return status
    ratio = par[D_OPEN_RATIO]
    if par[P_STARTS_PRESSED] != 0.0:
        ratio, status, _ = settled_ratio(par, load, 1.0)
    work[np.uintp(W_NOW + Y_FILM)] = ratio
    work[np.uintp(W_NOW + Y_ENERGY)] = 0.0
    work[np.uintp(W_NOW + Y_HEAT)] = oil
    for i in range(int(par[D_MODES])):
        work[np.uintp(W_NOW + Y_HEAT + 1 + i)] = 0.0
    return status


@kernel
def store_memory(par: Array, work: Array, state: Array) -> None:
    """Copy W_NOW to the memory."""
    state[S_STARTED] = 1.0
    state[S_FILM] = work[np.uintp(W_NOW + Y_FILM)]
    state[S_ENERGY] = work[np.uintp(W_NOW + Y_ENERGY)]
    state[S_HEAT] = work[np.uintp(W_NOW + Y_HEAT)]
    for i in range(int(par[D_MODES])):
        state[np.uintp(S_MODES + i)] = work[np.uintp(W_NOW + Y_HEAT + 1 + i)]


@kernel
def warm_up(
    par: Array, power_start: float, power_end: float, oil: float, duration: float, work: Array
) -> None:
    """Advance heat and energy in W_NOW exactly, under a face's power [W] that changes linearly."""
    if par[P_FIDELITY] != BOUNDARY_ONLY:
        for i in range(int(par[D_MODES]) + 1):
            place = np.uintp(W_NOW + Y_HEAT + i)
            level = oil if i == 0 else 0.0
            decay, first, second = exponential_weights(par[np.uintp(D_DECAY + i)] * duration)
            gain = power_start * first + (power_end - power_start) * second
            work[place] = (
                level
                + (work[place] - level) * decay
                + (par[np.uintp(D_GAIN + i)] * gain * duration)
            )
    work[np.uintp(W_NOW + Y_ENERGY)] += 0.5 * (power_start + power_end) * duration


@kernel
def face_power(par: Array, load: float, slip: float, film: bool, work: Array) -> float:
    """Return the friction power of a face [W] in the state W_NOW."""
    temperature = surface_temperature(par, work, W_NOW)
    if film:
        u = work[np.uintp(W_NOW + Y_FILM)]
        contact = contact_torque(par, load, slip, u, temperature)[0]
        viscous = viscous_torque(par, slip, u, temperature)[0]
    else:
        mu, _ = coefficient_of(par, slip, temperature)
        contact = par[P_FACES] * par[D_RADIUS] * mu * load
        viscous = 0.0
    smooth = math.tanh(abs(slip) / par[P_SPEED_SMOOTHING])
    return abs(slip) * (contact * smooth + viscous) / par[P_FACES]


@kernel
def advance(
    par: Array, course: tuple[float, float, float, float, float, float], duration: float,
    power_start: float, first: float, work: Array,
) -> int:  # fmt: skip
    """Bring W_NOW through a stretch over which load, slip and oil temperature run straight."""
    if moves_film(par):
        return engage(par, course, duration, first, work)
    status = OK
    work[np.uintp(W_NOW + Y_FILM)], status, _ = settled_ratio(
        par, course[3], work[np.uintp(W_NOW + Y_FILM)]
    )
    end = face_power(par, course[3], course[4], False, work)
    held = course[0] == course[3] and course[1] == course[4]
    warm_up(par, end if held else power_start, end, course[2], duration, work)
    return status


@kernel
def fill_outputs(par: Array, load: float, slip: float, work: Array, out: Array) -> None:
    """Fill what follows from film and temperature in W_NOW; temperature and energy come later."""
    film = moves_film(par)
    u = work[np.uintp(W_NOW + Y_FILM)]
    temperature = surface_temperature(par, work, W_NOW)
    mu, _ = coefficient_of(par, slip, temperature)
    viscous, _, _, eta, _, share = viscous_torque(par, slip, u, temperature)
    if film:
        contact = contact_torque(par, load, slip, u, temperature)[0]
    else:
        contact, viscous = par[P_FACES] * par[D_RADIUS] * mu * load, 0.0
        share = contact_share(par, u)[0]
    dry = contact * math.tanh(slip / par[P_SPEED_SMOOTHING])
    wet = math.copysign(viscous, slip)
    out[O_TORQUE] = dry + wet
    out[O_CONTACT_TORQUE], out[O_VISCOUS_TORQUE] = dry, wet
    out[O_CAPACITY] = contact + viscous
    out[O_POWER] = out[O_TORQUE] * slip
    out[O_HEAT_FLUX] = out[O_POWER] / (par[P_FACES] * par[D_AREA])
    out[O_COEFFICIENT] = mu
    out[O_FILM], out[O_RATIO] = u * par[P_ROUGHNESS], u
    out[O_CONTACT_SHARE], out[O_VISCOSITY] = share, eta


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

    Returns 0 or the status of a failure; HOT is advice and stands in ``iout`` only.
    """
    load, slip, oil = inp[I_LOAD], inp[I_SPEED], inp[I_OIL]
    if not (
        math.isfinite(load) and load >= 0.0 and math.isfinite(slip) and math.isfinite(oil)
        and math.isfinite(dt) and dt >= 0.0 and oil > 0.0
    ):  # fmt: skip
        iout[IO_STATUS] = BAD_INPUT
        return BAD_INPUT
    started = state[S_STARTED] != 0.0
    linear = par[P_INPUT_COURSE] == LINEAR_COURSE
    film = moves_film(par)
    work[W_SUBSTEPS] = work[W_REFUSED] = 0.0
    work[W_PROPOSED] = state[S_SUBSTEP]
    status = load_memory(par, load, oil, state, work)
    if par[P_FIDELITY] == BOUNDARY_ONLY:
        work[np.uintp(W_NOW + Y_HEAT)] = oil
    if linear:
        if started and status == OK:
            course = (state[S_LOAD], state[S_SLIP], state[S_OIL], load, slip, oil)
            status = advance(par, course, state[S_DURATION], state[S_POWER], state[S_SUBSTEP], work)
    elif dt > 0.0 and status == OK:
        course = (load, slip, oil, load, slip, oil)
        status = advance(par, course, dt, 0.0, state[S_SUBSTEP], work)
    if not film and status == OK:
        work[np.uintp(W_NOW + Y_FILM)], status, _ = settled_ratio(
            par, load, work[np.uintp(W_NOW + Y_FILM)]
        )
    fill_outputs(par, load, slip, work, out)
    power = out[O_POWER] / par[P_FACES]
    temperature = surface_temperature(par, work, W_NOW)
    energy = par[P_FACES] * work[np.uintp(W_NOW + Y_ENERGY)]
    keep = dt > 0.0 and status == OK
    if keep:
        keep = _is_finite(work, par, out)
        if not keep:
            status = NOT_FINITE
    if keep:
        store_memory(par, work, state)
        state[S_LOAD], state[S_SLIP], state[S_OIL] = load, slip, oil
        state[S_POWER], state[S_DURATION], state[S_SUBSTEP] = power, dt, work[W_PROPOSED]
    if linear and dt > 0.0:
        warm_up(par, power, power, oil, dt, work)
        temperature = surface_temperature(par, work, W_NOW)
        energy = par[P_FACES] * work[np.uintp(W_NOW + Y_ENERGY)]
    elif linear and started and par[P_FIDELITY] != BOUNDARY_ONLY:
        temperature = state[S_SHOWN_TEMPERATURE]
    # Heat does not come back: where the advance was too large the output waits.
    energy = max(energy, state[S_SHOWN_ENERGY])
    if keep:
        state[S_SHOWN_TEMPERATURE], state[S_SHOWN_ENERGY] = temperature, energy
    out[O_TEMPERATURE], out[O_ENERGY] = temperature, energy
    iout[IO_REGIME] = regime_of(par, out[O_RATIO], slip)
    if status == OK:
        for i in range(NOUT):
            if not math.isfinite(out[np.uintp(i)]):
                status = NOT_FINITE
    iout[IO_STATUS] = HOT if status == OK and temperature > HOT_LIMIT else status
    return status


@kernel
def _is_finite(work: Array, par: Array, out: Array) -> bool:
    """Tell if the unknowns and the outputs filled so far are numbers."""
    good = True
    for i in range(Y_HEAT + 1 + int(par[D_MODES])):
        good = good and math.isfinite(work[np.uintp(W_NOW + i)])
    return good and math.isfinite(out[O_POWER])
