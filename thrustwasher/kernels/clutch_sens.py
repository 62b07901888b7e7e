# mypy: disable-error-code="no-any-return"
"""How the outputs of the wet clutch change with its inputs: exact, film and heat held.

Film and temperature are states. They change with the inputs only where the film is settled (it
follows the load), at the start (steel as warm as the oil), and with ``input_course`` = linear:
there the present inputs also end the stretch since the last step, and its change is followed.
"""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_follow import engage_and_follow, follow
from .clutch_friction import coefficient_slopes, settled_slope
from .clutch_point import fill_outputs, load_memory, moves_film, settle
from .clutch_stage import surface_temperature
from .corners import sign_of
from .heating import exponential_weights

Array = NDArray[np.float64]


@kernel
def heat_of_a_ramp(par: Array, inp: Array, state: Array, seed: Array) -> float:
    """Return the change of the interface [K] where the film settles, at the end of a stretch.

    The power at that end is the one of the temperature at its start.
    """
    load, slip, modes = inp[L.I_LOAD], inp[L.I_SPEED], int(par[L.D_MODES])
    temperature, rise = state[L.S_HEAT], 0.0
    for i in range(modes):
        temperature += state[np.uintp(L.S_MODES + i)]
    for i in range(modes + 1):
        _, _, second = exponential_weights(par[np.uintp(L.D_DECAY + i)] * state[L.S_DURATION])
        rise += par[np.uintp(L.D_GAIN + i)] * second * state[L.S_DURATION]
    mu, _, mu_slip = coefficient_slopes(par, slip, temperature)
    faster = sign_of(slip) * seed[L.I_SPEED]
    smooth = math.tanh(abs(slip) / par[L.P_SPEED_SMOOTHING])
    steep = (1.0 - smooth) * (1.0 + smooth) / par[L.P_SPEED_SMOOTHING]
    force = (mu * seed[L.I_LOAD] + mu_slip * load * faster) * smooth + mu * load * steep * faster
    return rise * par[L.D_RADIUS] * (faster * mu * load * smooth + abs(slip) * force)


@kernel
def torque_change(
    par: Array, slip: float, load_change: float, slip_change: float, film: float, heat: float,
    work: Array,
) -> tuple[float, float, float]:  # fmt: skip
    """Return changes of contact torque, viscous torque (with sign) and capacity [N m].

    ``film``, ``heat``: changes of the film ratio and of the interface temperature [K].
    """
    sign = sign_of(slip)
    contact = (
        work[L.W_CONTACT_LOAD] * load_change + work[L.W_CONTACT_SLIP] * sign * slip_change
        + work[L.W_CONTACT_FILM] * film + work[L.W_CONTACT_HEAT] * heat
    )  # fmt: skip
    viscous = work[L.W_VISCOUS_FILM] * film + work[L.W_VISCOUS_HEAT] * heat
    smooth = work[L.W_SMOOTH]
    steep = (1.0 - smooth) * (1.0 + smooth) / par[L.P_SPEED_SMOOTHING]
    dry = contact * smooth + work[L.W_CONTACT] * steep * slip_change
    wet = sign * viscous + work[L.W_VISCOUS_SLIP] * slip_change
    return dry, wet, contact + viscous + work[L.W_VISCOUS_SLIP] * sign * slip_change


@kernel
def followed(
    par: Array, inp: Array, state: Array, work: Array, seed: Array, scratch: Array
) -> tuple[float, float, int]:
    """Return changes of film ratio and interface [K] over the stretch since the last step; status.

    Leaves in ``work`` what a step of dt = 0 leaves there; ``scratch`` is as long as the outputs.
    """
    load, slip, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    course = (state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL], load, slip, oil)
    duration = state[L.S_DURATION]
    status = L.OK
    if moves_film(par):
        status = load_memory(par, load, oil, state, work)
        change = (seed[L.I_LOAD], seed[L.I_SPEED], seed[L.I_OIL])
        if work[L.W_DURATION] == 0.0 and work[L.W_SUBSTEPS] == 1.0:
            # the stretch was one substep, still as it was: W_NOW is its start again, for a while
            for i in range(L.NY):
                work[np.uintp(L.W_VARIED + i)] = 0.0
            follow(par, course, change, 0.0, 1.0, duration, work)
            for i in range(L.NY):
                work[np.uintp(L.W_NOW + i)] = work[np.uintp(L.W_TRIAL + i)]
        else:
            status = engage_and_follow(par, course, change, duration, state[L.S_SUBSTEP], work)
            fill_outputs(par, load, slip, work, scratch)
        return work[L.W_VARIED + L.Y_FILM], surface_temperature(par, work, L.W_VARIED), status
    if work[L.W_DURATION] != 0.0:
        status = load_memory(par, load, oil, state, work)
        if status == L.OK:
            status = settle(par, course, duration, state[L.S_POWER], work)
        if par[L.P_FIDELITY] == L.BOUNDARY_ONLY:
            work[np.uintp(L.W_NOW + L.Y_HEAT)] = oil
        _, work[L.W_SETTLED_LOAD], _, _ = settled_slope(
            par, load, work[np.uintp(L.W_NOW + L.Y_FILM)]
        )
        fill_outputs(par, load, slip, work, scratch)
    film = work[L.W_SETTLED_LOAD] * seed[L.I_LOAD]
    if par[L.P_FIDELITY] == L.BOUNDARY_ONLY:
        return film, seed[L.I_OIL], status
    return film, heat_of_a_ramp(par, inp, state, seed), status


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` with the change of the real outputs when the inputs change by ``seed``.

    ``work`` is as the last successful step with these inputs left it. At zero slip what depends on
    the size of the slip alone counts as flat there; at other corners the side counts that the
    point is on. Returns 0 or the status of a failure.
    """
    slip = inp[L.I_SPEED]
    load_change, slip_change, oil_change = seed[L.I_LOAD], seed[L.I_SPEED], seed[L.I_OIL]
    started = state[L.S_STARTED] != 0.0
    follows_oil = par[L.P_FIDELITY] == L.BOUNDARY_ONLY or not started
    film, heat = work[L.W_SETTLED_LOAD] * load_change, oil_change if follows_oil else 0.0
    status = L.OK
    if started and par[L.P_INPUT_COURSE] == L.LINEAR_COURSE:
        film, heat, status = followed(par, inp, state, work, seed, dout)
    dry, wet, capacity = torque_change(par, slip, load_change, slip_change, film, heat, work)
    torque = math.copysign(work[L.W_VISCOUS], slip) + work[L.W_CONTACT] * work[L.W_SMOOTH]
    dout[L.O_TORQUE], dout[L.O_CONTACT_TORQUE], dout[L.O_VISCOUS_TORQUE] = dry + wet, dry, wet
    dout[L.O_CAPACITY] = capacity
    dout[L.O_POWER] = (dry + wet) * slip + torque * slip_change
    dout[L.O_HEAT_FLUX] = dout[L.O_POWER] / (par[L.P_FACES] * par[L.D_AREA])
    dout[L.O_COEFFICIENT] = (
        work[L.W_FRICTION_SLIP] * sign_of(slip) * slip_change + work[L.W_FRICTION_HEAT] * heat
    )
    dout[L.O_FILM], dout[L.O_RATIO] = film * par[L.P_ROUGHNESS], film
    dout[L.O_CONTACT_SHARE] = work[L.W_SHARE_FILM] * film
    dout[L.O_VISCOSITY] = work[L.W_VISCOSITY_HEAT] * heat
    dout[L.O_TEMPERATURE] = oil_change if follows_oil else 0.0
    dout[L.O_ENERGY] = 0.0
    if status == L.OK:
        for i in range(L.NOUT):
            if not math.isfinite(dout[np.uintp(i)]):
                status = L.NOT_FINITE
    return status
