# mypy: disable-error-code="no-any-return"
"""A pack between two shafts of a driveline that it does not know: its torque there, and its heat.

The torques that act on the shafts do work; that is the heat of the pack. It is foreseen while a
step is made and corrected in the next one, which knows where the slip went.
"""

import numpy as np

from ...numerics.arrays import copy
from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from ...tribology.holding import memory as M
from ...tribology.holding.memory import Coupling
from ...tribology.holding.torque import age_of, dip_of, hold, inertia_of, knows, note, notice
from ...tribology.holding.work import work_done, work_foreseen
from . import layout as L
from .advance import settle_film
from .pack_outputs import fill_outputs
from .rates import add_heat, share_power


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
    with a linear profile, else of this one. Returns the work foreseen in this step [J].
    """
    mem, slip = work[L.W_MEMORY : L.W_MEMORY + M.N_MEMORY], point[1]
    copy(state[L.S_MEMORY : L.S_MEMORY + M.N_MEMORY], mem)
    work[L.W_GIVEN] = foreseen = 0.0
    holds = par[L.P_HOLDING] != M.OFF
    if holds and dt > 0.0 and mem[M.COUNT] == 0.0:
        settle_film(par, point[0], work)
        fill_outputs(par, point[0], slip, point[3], work, out)
        mem[M.CAPACITY + 1] = abs(out[L.O_VISCOUS_TORQUE])
        mem[M.CAPACITY] = out[L.O_CAPACITY] - mem[M.CAPACITY + 1]
    dry, wet = mem[M.CAPACITY], mem[M.CAPACITY + 1]
    if dt > 0.0:
        notice(coupling_of(par), mem, slip, dry + wet)
    if not holds:
        return foreseen
    film = work[np.uintp(L.W_NOW + L.Y_FILM)]
    if linear:
        share_power(par, state[L.S_LOAD], state[L.S_SLIP], state[L.S_DRUM], film, work)
    else:
        share_power(par, point[0], slip, point[3], film, work)
    way = coupling_of(par)
    done, span = work_done(way, mem, slip), state[L.S_DURATION] if linear else dt
    if dt > 0.0:
        torque = hold(way, mem, slip, dt, dry, wet)[0]
        foreseen = work_foreseen(way, mem, slip, dt, torque)
    if span > 0.0:
        power, slope, late = foreseen / (span * par[L.P_FACES]), 0.0, done - mem[M.BOOKED]
        mem[M.BOOKED] = done + foreseen
        if linear:
            acting = mem[np.uintp(M.TORQUE + max(age_of(way, mem), 0))]
            power, slope = 0.0, acting / par[L.P_FACES]
            late -= acting * 0.5 * (mem[M.SLIP] + slip) * span
            mem[M.BOOKED] = done
        work[L.W_GIVEN], work[L.W_GIVEN_POWER], work[L.W_GIVEN_SLOPE] = 1.0, power, slope
        add_heat(par, work, late / par[L.P_FACES])
    return foreseen


@kernel
def answer(par: Array, slip: float, dt: float, work: Array, out: Array) -> int:
    """Put the torque of a pack that holds to ``out``; return 1 where it does, else 0.

    Takes ``slip`` [rad/s] and torque to W_MEMORY if ``dt`` > 0. In a hold it is, at the slip that
    was given last, the torque given then, as far as the capacity now allows.
    """
    mem = work[L.W_MEMORY : L.W_MEMORY + M.N_MEMORY]
    wet = abs(out[L.O_VISCOUS_TORQUE])
    capacity = out[L.O_CAPACITY]
    dry, torque = capacity - wet, out[L.O_TORQUE]
    out[L.O_PLANT_INERTIA] = 0.0
    holds, outside, dips = False, 0.0, -1.0
    if par[L.P_HOLDING] != M.OFF:
        of_dry = of_wet = 0.0
        way, step = coupling_of(par), dt if dt > 0.0 else mem[M.STEP]
        out[L.O_PLANT_INERTIA] = inertia_of(way, mem)
        if dt == 0.0 and mem[M.HELD] > 0.0 and slip == mem[M.SLIP]:
            holds = True
            torque = min(capacity, max(-capacity, mem[M.TORQUE]))
            of_dry = of_wet = torque / capacity if capacity > 0.0 else 0.0
        else:
            torque, holds, _, of_dry, of_wet, outside = hold(way, mem, slip, step, dry, wet)
            if torque != dry * of_dry + wet * of_wet:
                of_dry = of_wet = torque / capacity if capacity > 0.0 else 0.0
            dips = dip_of(way, mem, torque, capacity)
            rest = 1.0 - max(dips, 0.0)
            torque, of_dry, of_wet = rest * torque, rest * of_dry, rest * of_wet
        out[L.O_TORQUE] = torque
        out[L.O_CONTACT_TORQUE], out[L.O_VISCOUS_TORQUE] = dry * of_dry, wet * of_wet
        out[L.O_POWER] = torque * slip
        out[L.O_HEAT_FLUX] = out[L.O_POWER] / (par[L.P_FACES] * par[L.D_AREA])
    if dt > 0.0:
        note(mem, slip, dt, torque, holds, outside, dips >= 0.0)
        mem[M.CAPACITY], mem[M.CAPACITY + 1] = dry, wet
    return 1 if holds else 0


@kernel
def answer_slopes(
    par: Array, inp: Array, work: Array, seed: Array, out: Array, dout: Array
) -> None:
    """Change ``dout`` to that of a pack that holds; ``out``: of one that does not."""
    slip, mem = inp[L.I_SPEED], work[L.W_MEMORY : L.W_MEMORY + M.N_MEMORY]
    capacity, grows = out[L.O_CAPACITY], dout[L.O_CAPACITY]
    wet, dwet = abs(out[L.O_VISCOUS_TORQUE]), sign_of(slip) * dout[L.O_VISCOUS_TORQUE]
    dry, way = capacity - wet, coupling_of(par)
    torque, _, by_slip, by_dry, by_wet, _ = hold(way, mem, slip, mem[M.STEP], dry, wet)
    rest = 1.0 - max(dip_of(way, mem, torque, capacity), 0.0)
    by_dry, by_wet, by_slip = rest * by_dry, rest * by_wet, rest * by_slip * seed[L.I_SPEED]
    ddry, oil = grows - dwet, dout[L.O_VISCOUS_TORQUE]
    dout[L.O_TORQUE] = by_slip + by_dry * ddry + by_wet * dwet
    if slip == 0.0 and not knows(way, mem, mem[M.STEP]):
        dout[L.O_TORQUE] += oil
    dout[L.O_CONTACT_TORQUE] = by_slip + by_dry * ddry
    dout[L.O_VISCOUS_TORQUE] = dout[L.O_TORQUE] - dout[L.O_CONTACT_TORQUE]
    if rest * torque != dry * by_dry + wet * by_wet and capacity > 0.0:
        share = rest * torque / capacity
        more = (dout[L.O_TORQUE] - share * grows) / capacity
        dout[L.O_CONTACT_TORQUE] = ddry * share + dry * more
        dout[L.O_VISCOUS_TORQUE] = dwet * share + wet * more
    torque *= rest
    dout[L.O_POWER] = dout[L.O_TORQUE] * slip + torque * seed[L.I_SPEED]
    dout[L.O_HEAT_FLUX] = dout[L.O_POWER] / (par[L.P_FACES] * par[L.D_AREA])
