# mypy: disable-error-code="no-any-return"
"""How the outputs of the wet clutch change with its inputs: exact, film and heat held.

Film and temperature are states. They change with the inputs only where the film is settled (it
follows the load), at the start (steel as warm as the oil), and with ``input_course`` = linear:
there the present inputs also end the stretch since the last step, and its change is followed.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from ...numerics.status import NOT_FINITE, OK
from ...tribology.lumped_body import exponential_weights
from . import layout as L
from .advance import integrate, is_integrated, load_memory, settle, settle_film
from .pack_friction import coefficient_slopes
from .pack_outputs import fill_outputs, ring_outputs
from .rates import n_unknowns, surfaces
from .rosenbrock_derivatives import follow


@kernel
def heat_of_a_ramp(par: Array, inp: Array, state: Array, seed: Array) -> float:
    """Return the change of the interface [K] where the film settles, at the end of a stretch.

    The power at that end is the one of the temperature at its start.
    """
    load, slip, modes = inp[L.I_LOAD], inp[L.I_SPEED], int(par[L.D_MODES])
    temperature, rise = state[L.S_HEAT], 0.0
    for i in range(modes):
        temperature += state[np.uintp(L.S_HEAT + 1 + i)]
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

    Leaves in ``work`` what a step of dt = 0 leaves there, the changes of rings' interfaces in
    W_SURFACE_CHANGE; ``scratch`` is as long as the outputs.
    """
    load, slip, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    course = (state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL], load, slip, oil)
    duration = state[L.S_DURATION]
    status = OK
    if is_integrated(par):
        n = n_unknowns(par)
        status = load_memory(par, load, oil, state, work)
        change = (seed[L.I_LOAD], seed[L.I_SPEED], seed[L.I_OIL])
        if work[L.W_DURATION] == 0.0 and work[L.W_SUBSTEPS] == 1.0:
            # the stretch was one substep, still as it was: W_NOW is its start again, for a while
            for i in range(n):
                work[np.uintp(L.W_VARIED + i)] = 0.0
            follow(par, course, change, 0.0, 1.0, duration, work)
            for i in range(n):
                work[np.uintp(L.W_NOW + i)] = work[np.uintp(L.W_TRIAL + i)]
            status = max(status, settle_film(par, load, work))
        else:
            first = state[L.S_SUBSTEP]
            status = integrate(par, course, change, duration, first, True, work)
            status = max(status, settle_film(par, load, work))
            if par[L.P_FIDELITY] != L.FINE:
                fill_outputs(par, load, slip, work, scratch)
        surfaces(par, work, L.W_VARIED, L.W_SURFACE_CHANGE)
        film = work[np.uintp(L.W_VARIED + L.Y_FILM)] + work[L.W_SETTLED_LOAD] * seed[L.I_LOAD]
        return film, work[L.W_SURFACE_CHANGE], status
    if work[L.W_DURATION] != 0.0:
        status = load_memory(par, load, oil, state, work)
        if status == OK:
            status = settle(par, course, duration, state[L.S_POWER], work)
        if par[L.P_FIDELITY] == L.BOUNDARY_ONLY:
            work[np.uintp(L.W_NOW + L.Y_HEAT)] = oil
        settle_film(par, load, work)
        fill_outputs(par, load, slip, work, scratch)
    film = work[L.W_SETTLED_LOAD] * seed[L.I_LOAD]
    if par[L.P_FIDELITY] == L.BOUNDARY_ONLY:
        return film, seed[L.I_OIL], status
    return film, heat_of_a_ramp(par, inp, state, seed), status


@kernel
def lumped_change(
    par: Array, inp: Array, seed: Array, film: float, heat: float, work: Array, dout: Array
) -> None:
    """Fill the change of a lumped pack's outputs; ``film``, ``heat``: as in torque_change."""
    slip, slip_change = inp[L.I_SPEED], seed[L.I_SPEED]
    dry, wet, capacity = torque_change(par, slip, seed[L.I_LOAD], slip_change, film, heat, work)
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


@kernel
def directional_derivative(
    par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array
) -> int:
    """Fill ``dout`` with the change of the real outputs when the inputs change by ``seed``.

    ``work`` is as the last successful step with these inputs left it. At zero slip what depends on
    the size of the slip alone counts as flat there; at other corners the side counts that the
    point is on. Returns 0 or the status of a failure.
    """
    started = state[L.S_STARTED] != 0.0
    follows_oil = par[L.P_FIDELITY] == L.BOUNDARY_ONLY or not started
    heat = seed[L.I_OIL] if follows_oil else 0.0
    film = work[L.W_SETTLED_LOAD] * seed[L.I_LOAD]
    status = OK
    for k in range(int(par[L.D_RINGS])):
        work[np.uintp(L.W_SURFACE_CHANGE + k)] = heat
    if started and par[L.P_INPUT_COURSE] == L.LINEAR_COURSE:
        film, heat, status = followed(par, inp, state, work, seed, dout)
    if par[L.P_FIDELITY] == L.FINE:
        surfaces(par, work, L.W_NOW, L.W_SURFACE)
        point = (inp[L.I_LOAD], inp[L.I_SPEED], work[np.uintp(L.W_NOW + L.Y_FILM)])
        scratch = work[L.W_VARIED : L.W_VARIED + L.NOUT]
        change = (seed[L.I_LOAD], seed[L.I_SPEED], film)
        ring_outputs(par, point, change, work, scratch, dout)
    else:
        lumped_change(par, inp, seed, film, heat, work, dout)
    dout[L.O_TEMPERATURE] = seed[L.I_OIL] if follows_oil else 0.0
    dout[L.O_ENERGY] = 0.0
    if status == OK:
        for i in range(L.NOUT):
            if not math.isfinite(dout[np.uintp(i)]):
                status = NOT_FINITE
    return status
