# mypy: disable-error-code="no-any-return"
"""A pack between two shafts of a driveline that it does not know: its torque there, and its heat.

The torques that act on the shafts do work; that is the heat of the pack. It is foreseen while a
step is made; the next one, which knows where the slip went, adds what it was too little, or waits
until what was too much has been made.
"""

import numpy as np

from ...numerics.arrays import copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.smoothing import sign_of
from ...tribology.holding import memory as M
from ...tribology.holding.memory import Coupling
from ...tribology.holding.sampling import extend, is_again, repeats, span_of
from ...tribology.holding.torque import (
    age_of,
    basis_of,
    book_heat,
    bound_of,
    decide,
    expected,
    is_locked,
    note,
    notice,
    shown_inertia,
    slope_of_bound,
)
from ...tribology.holding.work import foreseen
from . import layout as L
from .advance import settle_film
from .pack_outputs import fill_outputs
from .rates import share_power


@kernel
def coupling_of(par: Array) -> Coupling:
    """Return how the pack holds."""
    return (
        int(par[L.P_HOLDING]),
        par[L.P_COUPLING_INERTIA],
        int(par[L.P_COUPLING_AGE]),
        par[L.P_SPEED_SMOOTHING],
        par[L.P_PROBING] != 0.0,
    )


@kernel
def remember(
    par: Array,
    state: Array,
    point: tuple[float, float, float, float],
    linear: bool,
    dt: float,
    work: Array,
    out: Array,
) -> float:
    """Take the memory of the driveline to W_MEMORY, and into account what is seen at ``point``.

    Gives the power of a pack that holds to the interval that is integrated next: of the last step
    with a linear profile, else of this one. Returns the heat of this step, as far as it is
    foreseen [J].
    """
    mem, slip = work[L.W_MEMORY : L.W_MEMORY + M.N_MEMORY], point[1]
    copy(state[L.S_MEMORY : L.S_MEMORY + M.N_MEMORY], mem)
    work[L.W_GIVEN] = ahead = 0.0
    way = coupling_of(par)
    if par[L.P_HOLDING] == M.OFF:
        if dt > 0.0:
            notice(way, mem, slip)
        return ahead
    if dt > 0.0 and mem[M.COUNT] == 0.0:
        settle_film(par, point[0], work)
        fill_outputs(par, point[0], slip, point[3], work, out)
        mem[M.CAPACITY] = out[L.O_CAPACITY]
    film = work[np.uintp(L.W_NOW + L.Y_FILM)]
    if linear:
        share_power(par, state[L.S_LOAD], state[L.S_SLIP], state[L.S_DRUM], film, work)
    else:
        share_power(par, point[0], slip, point[3], film, work)
    if dt > 0.0 and not linear and repeats(way, mem, slip):
        _give(par, mem, max(0.0, mem[M.TORQUE] * slip * dt), dt, 0.0, 0.0, work)
        return work[L.W_GIVEN_POWER] * par[L.P_FACES] * dt
    if dt > 0.0:
        notice(way, mem, slip)
    book_heat(way, mem, slip)
    span = state[L.S_DURATION] if linear else dt
    if dt > 0.0:
        ahead = foreseen(mem, slip, dt, expected(way, mem, slip, span_of(mem, dt)))
    _book(par, mem, slip, span, linear, ahead, work)
    return ahead if linear else work[L.W_GIVEN_POWER] * par[L.P_FACES] * dt


@kernel
def _book(
    par: Array, mem: Array, slip: float, span: float, linear: bool, ahead: float, work: Array
) -> None:
    """Give the heat that is due to the next interval of ``span`` [s], as the power of a face.

    ``ahead`` [J]: that of this step, which a linear profile does not integrate yet.
    """
    if not span > 0.0:
        return
    due = mem[M.HEAT] if linear else mem[M.HEAT] + ahead
    given, slope, mean = max(0.0, due - mem[M.BOOKED]), 0.0, 0.0
    if linear and given > 0.0:  # it changes with the slip at the interval's end
        slope, mean = mem[M.RISES], 0.5 * (mem[M.SLIP] + slip)
    _give(par, mem, given, span, slope, mean, work)


@kernel
def _give(
    par: Array, mem: Array, given: float, span: float, slope: float, mean: float, work: Array
) -> None:
    """Give a heat [J] to the next interval of ``span`` [s].

    Its power changes with the slip by ``slope`` [N m], and is the mean one at ``mean`` [rad/s].
    """
    mem[M.BOOKED] += given
    power = (given / span - slope * mean) / par[L.P_FACES]
    work[L.W_GIVEN], work[L.W_GIVEN_POWER] = 1.0, power
    work[L.W_GIVEN_SLOPE] = slope / par[L.P_FACES]


@kernel
def answer(
    par: Array, state: Array, slip: float, dt: float, work: Array, out: Array, iout: Ints
) -> None:
    """Put the torque of a pack that holds to ``out``, with what is known of the driveline.

    Takes ``slip`` [rad/s] and torque to W_MEMORY if ``dt`` > 0. Else, at the slip that was given
    last, it is the torque given then, as far as the capacity now allows.
    """
    mem = work[L.W_MEMORY : L.W_MEMORY + M.N_MEMORY]
    wet = abs(out[L.O_VISCOUS_TORQUE])
    capacity, way = out[L.O_CAPACITY], coupling_of(par)
    dry, torque = capacity - wet, out[L.O_TORQUE]
    out[L.O_PLANT_INERTIA] = out[L.O_SLIP_BOUND] = 0.0
    iout[L.IO_PLANT_AGE], iout[L.IO_LOCKED], iout[L.IO_LOCK_BASIS] = -1, 0, 0
    if par[L.P_HOLDING] == M.OFF:
        if dt > 0.0:
            note(way, mem, slip, dt, torque, 0.0, capacity, False)
        return
    last = state[L.S_MEMORY : L.S_MEMORY + M.N_MEMORY]
    step, locked = span_of(mem, dt) if dt > 0.0 else mem[M.STEP], False
    slides, number, slope, coded = True, 0.0, 0.0, 0.0
    again = dt > 0.0 and is_again(mem)
    if not again:
        slides, number, slope, coded = decide(way, mem, slip, step, capacity)
    if again or (dt == 0.0 and mem[M.COUNT] > 0.0 and slip == last[M.SLIP]):
        slides = last[M.HELD] == 0.0
        number = last[M.TORQUE]
        if slides:
            number = number / last[M.CAPACITY] if last[M.CAPACITY] > 0.0 else 0.0
    holds, share = False, number
    if slides:
        torque, slope, coded = number * capacity, slope * capacity, coded * capacity
    else:
        holds = abs(number) < capacity
        torque = min(capacity, max(-capacity, number))
        share = 0.0 if holds else sign_of(number)
        if not holds:
            slope = 0.0
    work[L.W_BY_SLIP], work[L.W_BY_CAPACITY] = slope, share
    work[L.W_GIVEN_TORQUE] = torque
    whole = torque / capacity if capacity > 0.0 else 0.0
    out[L.O_TORQUE] = torque
    out[L.O_CONTACT_TORQUE], out[L.O_VISCOUS_TORQUE] = dry * whole, wet * whole
    out[L.O_POWER] = torque * slip
    out[L.O_HEAT_FLUX] = out[L.O_POWER] / (par[L.P_FACES] * par[L.D_AREA])
    bound = bound_of(way, mem, capacity, step)
    work[L.W_BOUND_SLOPE] = slope_of_bound(way, mem, capacity, step)
    if dt > 0.0:
        if again:
            extend(mem, dt, torque, capacity)
        else:
            note(way, mem, slip, dt, torque, coded, capacity, holds)
        locked = is_locked(way, mem)
    else:
        locked = holds and abs(slip) <= bound and is_locked(way, last)
    out[L.O_PLANT_INERTIA], out[L.O_SLIP_BOUND] = shown_inertia(way, mem), bound
    iout[L.IO_PLANT_AGE], iout[L.IO_LOCKED] = age_of(way, mem), 1 if locked else 0
    iout[L.IO_LOCK_BASIS] = basis_of(way, locked)


@kernel
def answer_slopes(
    par: Array, inp: Array, work: Array, seed: Array, out: Array, dout: Array
) -> None:
    """Change ``dout`` to that of a pack that holds; ``out``: of one that does not."""
    slip, capacity, grows = inp[L.I_SPEED], out[L.O_CAPACITY], dout[L.O_CAPACITY]
    wet, dwet = abs(out[L.O_VISCOUS_TORQUE]), sign_of(slip) * dout[L.O_VISCOUS_TORQUE]
    dry, torque, share = capacity - wet, work[L.W_GIVEN_TORQUE], 0.0
    rises = work[L.W_BY_SLIP] * seed[L.I_SPEED] + work[L.W_BY_CAPACITY] * grows
    if capacity > 0.0:
        share = torque / capacity
        more = (rises - share * grows) / capacity
        dout[L.O_CONTACT_TORQUE] = (grows - dwet) * share + dry * more
        dout[L.O_VISCOUS_TORQUE] = dwet * share + wet * more
    dout[L.O_TORQUE] = rises
    dout[L.O_POWER] = rises * slip + torque * seed[L.I_SPEED]
    dout[L.O_HEAT_FLUX] = dout[L.O_POWER] / (par[L.P_FACES] * par[L.D_AREA])
    dout[L.O_SLIP_BOUND] = work[L.W_BOUND_SLOPE] * grows
