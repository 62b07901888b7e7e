# mypy: disable-error-code="no-any-return"
"""How the outputs of the wet clutch change with its inputs: exact, film and heat held.

Film and temperature are states. They change with the inputs only where the film is settled (it
follows the load), at the start (steel as warm as the oil), and with ``input_profile`` = linear:
there the present inputs also end the interval since the last step, and its change is followed.
"""

import math

import numpy as np

from ...numerics.arrays import are_finite, clear, copy
from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from ...numerics.status import NOT_FINITE, OK
from ...tribology.holding import memory as M
from ...tribology.lumped_body import exponential_weights
from . import layout as L
from .advance import integrate, is_integrated, load_memory, settle, settle_film
from .coupling import answer_slopes
from .pack_friction import coefficient_slopes
from .pack_outputs import ring_outputs
from .rates import n_unknowns, settled_cooling, surfaces
from .rosenbrock_derivatives import follow


@kernel
def heat_of_a_ramp(par: Array, inp: Array, state: Array, work: Array, seed: Array) -> float:
    """Return the change of the interface [K] where the film settles, at the end of an interval.

    The power at that end is the one of the temperature there, that of W_NOW.
    """
    load, slip, modes, rise = inp[L.I_LOAD], inp[L.I_SPEED], int(par[L.D_MODES]), 0.0
    surfaces(par, work, L.W_NOW, L.W_SURFACE)
    for i in range(modes + 1):
        rate = par[np.uintp(L.D_DECAY + i)]
        if i == 0:
            rate = par[L.D_GAIN] * settled_cooling(par, load) * par[L.D_AREA]
        _, _, second = exponential_weights(rate * state[L.S_DURATION])
        rise += par[np.uintp(L.D_GAIN + i)] * second * state[L.S_DURATION]
    if work[L.W_GIVEN] != 0.0:
        return rise * work[L.W_GIVEN_SLOPE] * seed[L.I_SPEED]
    mu, by_t, mu_slip = coefficient_slopes(par, slip, work[L.W_SURFACE])
    faster = sign_of(slip) * seed[L.I_SPEED]
    smooth = math.tanh(abs(slip) / par[L.P_SPEED_SMOOTHING])
    steep = (1.0 - smooth) * (1.0 + smooth) / par[L.P_SPEED_SMOOTHING]
    force = (mu * seed[L.I_LOAD] + mu_slip * load * faster) * smooth + mu * load * steep * faster
    change = rise * par[L.D_RADIUS] * (faster * mu * load * smooth + abs(slip) * force)
    return change / (1.0 - rise * par[L.D_RADIUS] * abs(slip) * smooth * load * by_t)


@kernel
def followed(par: Array, inp: Array, state: Array, work: Array, seed: Array) -> tuple[float, int]:
    """Return the change of the film ratio over the interval since the last step; status.

    Leaves in W_NOW what a step of dt = 0 leaves there, the changes of interfaces [K] in
    W_SURFACE_CHANGE.
    """
    load, slip, oil, drum = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL], inp[L.I_DRUM]
    ramp = (
        state[L.S_LOAD],
        state[L.S_SLIP],
        state[L.S_OIL],
        load,
        slip,
        oil,
        state[L.S_DRUM],
        drum,
    )
    duration = state[L.S_DURATION]
    status = OK
    if is_integrated(par):
        n = n_unknowns(par)
        status = load_memory(par, load, oil, state, work)
        change = (seed[L.I_LOAD], seed[L.I_SPEED], seed[L.I_OIL], seed[L.I_DRUM])
        if work[L.W_DURATION] == 0.0 and work[L.W_SUBSTEPS] == 1.0:
            # the interval was one substep, still as it was: W_NOW is its start again, for a while
            clear(work[L.W_VARIED : L.W_VARIED + n])
            follow(par, ramp, change, 0.0, 1.0, duration, work)
            copy(work[L.W_TRIAL :], work[L.W_NOW : L.W_NOW + n])
        else:
            first = state[L.S_SUBSTEP]
            status = integrate(par, ramp, change, duration, first, True, work)
        status = max(status, settle_film(par, load, work))
        surfaces(par, work, L.W_VARIED, L.W_SURFACE_CHANGE)
        film = work[np.uintp(L.W_VARIED + L.Y_FILM)] + work[L.W_SETTLED_LOAD] * seed[L.I_LOAD]
        return film, status
    if work[L.W_DURATION] != 0.0:
        status = load_memory(par, load, oil, state, work)
        if status == OK:
            status = settle(par, ramp, duration, state[L.S_POWER], work)
        settle_film(par, load, work)
    work[L.W_SURFACE_CHANGE] = heat_of_a_ramp(par, inp, state, work, seed)
    return work[L.W_SETTLED_LOAD] * seed[L.I_LOAD], status


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
    heat = 0.0 if started else seed[L.I_OIL]
    film = work[L.W_SETTLED_LOAD] * seed[L.I_LOAD]
    status = OK
    for k in range(int(par[L.D_RINGS])):
        work[np.uintp(L.W_SURFACE_CHANGE + k)] = heat
    if started and par[L.P_INPUT_PROFILE] == L.LINEAR_PROFILE:
        film, status = followed(par, inp, state, work, seed)
    surfaces(par, work, L.W_NOW, L.W_SURFACE)
    point = (inp[L.I_LOAD], inp[L.I_SPEED], work[np.uintp(L.W_NOW + L.Y_FILM)], inp[L.I_DRUM])
    scratch = work[L.W_VARIED : L.W_VARIED + L.NOUT]
    change = (seed[L.I_LOAD], seed[L.I_SPEED], film, seed[L.I_DRUM])
    ring_outputs(par, point, change, work, scratch, dout)
    dout[L.O_PLANT_INERTIA] = dout[L.O_SLIP_BOUND] = 0.0
    if par[L.P_HOLDING] != M.OFF:
        answer_slopes(par, inp, work, seed, scratch, dout)
    dout[L.O_TEMPERATURE] = heat
    dout[L.O_ENERGY] = dout[L.O_OIL_HEAT] = dout[L.O_STORED_HEAT] = 0.0
    dout[L.O_OIL_ENERGY] = dout[L.O_ADVISED] = 0.0
    return NOT_FINITE if status == OK and not are_finite(dout) else status
