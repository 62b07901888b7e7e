# mypy: disable-error-code="no-any-return"
"""One co-simulation step of the wet clutch: film, heat and friction of the pack.

``input_profile`` says what the inputs do inside a step. Held: they stay, the step ends with all
outputs at its end. Linear: they run straight from one communication point to the next. Then a step
first brings film and heat from the last point to the present one, whose inputs are known now, gives
the friction there, and books heat in advance with the present power; the next step replaces that
advance. This couples with second order to a partner that looks ahead by itself.

With rates behind the inputs a step with held ones follows them: they run straight from their values
to those at the step's end, which the outputs belong to. A linear profile takes no rates.

A pack that holds (``holding``) answers the slip given at a step's start with the torque to apply
over the step in which it will act. Its heat is the work of the torques that acted (``coupling``).
"""

import math

import numpy as np

from ...numerics.arrays import are_finite, copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.profiles import value_at
from ...numerics.status import (
    BAD_INPUT,
    CHATTER,
    EXTRAPOLATED,
    HOT,
    NOT_FINITE,
    OK,
    OUTSIDE_VERIFIED,
)
from ...numerics.step_size import advised_step
from ...tribology.holding import memory as M
from ...tribology.holding.figures import fill_figures
from ...tribology.holding.reversals import chatters
from ...tribology.holding.sampling import held_over
from ...tribology.holding.torque import told_of
from . import layout as L
from .advance import (
    advance,
    is_held,
    load_memory,
    settle_film,
    settled_power,
    store_memory,
    warm_up,
)
from .constants import broken_rule as broken_rule
from .constants import derive as derive
from .coupling import answer, coupling_of, remember
from .directional_derivative import directional_derivative
from .pack_friction import regime_of
from .pack_outputs import fill_outputs, mean_surface, stored_heat
from .rates import given_power, n_unknowns, pack_rates, surfaces

N_PARAM, NPAR, NINP, NSTATE, NWORK = L.N_PARAM, L.NPAR, L.NINP, L.NSTATE, L.NWORK
NOUT, NIOUT, sens = L.NOUT, L.NIOUT, directional_derivative
NRATES, W_TOLD, W_STATES = NINP, L.W_TOLD, L.W_STATES
# What a partner may be off by over a step: a share of the capacity, or of that of a pack pressed a
# little [Pa] whose coefficient is low.
ADVISED_SHARE, LEAST_PRESSURE, LEAST_COEFFICIENT = 0.01, 1e5, 0.1
LESS = 0.2  # of the step that was taken: the advice where the slip chatters


@kernel
def step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float
) -> int:
    """Advance the pack from t to t + dt, then fill the outputs.

    Returns 0 or the status of a failure; advice stands in ``iout`` only. In rings ``temperature``
    is their area mean; HOT and EXTRAPOLATED go by the hottest one.
    """
    linear = par[L.P_INPUT_PROFILE] == L.LINEAR_PROFILE
    before, ahead = point_at(inp, 0.0), 0.0 if linear else dt
    load, slip, oil, drum = point_at(inp, ahead)
    good = are_finite(inp) and math.isfinite(dt) and dt >= 0.0
    if not (good and min(before[0], load) >= 0.0 and min(before[2], oil) > 0.0):
        iout[L.IO_STATUS] = BAD_INPUT
        return BAD_INPUT
    started = state[L.S_STARTED] != 0.0
    work[L.W_SUBSTEPS] = work[L.W_REFUSED] = 0.0
    work[L.W_PROPOSED], work[L.W_DURATION] = state[L.S_SUBSTEP], dt
    status = load_memory(par, before[0], before[2], state, work)
    holds = par[L.P_HOLDING] != M.OFF
    work[L.W_GIVEN] = foreseen = 0.0
    if status == OK:
        foreseen = remember(par, state, before, linear, dt, work, out)
    if linear:
        if started and status == OK:
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
            power = given_power(work, state[L.S_SLIP]) if holds else state[L.S_POWER]
            status = advance(par, ramp, state[L.S_DURATION], power, state[L.S_SUBSTEP], work)
    elif dt > 0.0 and status == OK:
        ramp = (before[0], before[1], before[2], load, slip, oil, before[3], drum)
        power = 0.0 if is_held(ramp) else settled_power(par, before[0], before[1], work)
        status = advance(par, ramp, dt, power, state[L.S_SUBSTEP], work)
    if status == OK:
        status = settle_film(par, load, work)
    fill_outputs(par, load, slip, drum, work, out)
    answer(par, state, before[1], dt, work, out, iout)
    power = out[L.O_POWER] / par[L.P_FACES]
    if holds and dt > 0.0:
        power = foreseen / (dt * par[L.P_FACES])
    temperature, hottest = mean_surface(par, work)
    energy = par[L.P_FACES] * work[np.uintp(L.W_NOW + L.Y_ENERGY)]
    unknowns = L.W_NOW
    if linear and dt > 0.0:
        unknowns = L.W_TRIAL  # the memory is that of now; what is shown looks ahead
        copy(work[L.W_NOW :], work[L.W_TRIAL : L.W_TRIAL + n_unknowns(par)])
        look_ahead(par, inp, dt, power, work)
        temperature, hottest = mean_surface(par, work)
        energy = par[L.P_FACES] * work[np.uintp(L.W_NOW + L.Y_ENERGY)]
    elif linear and started:
        energy, temperature = state[L.S_SHOWN_ENERGY], state[L.S_SHOWN_TEMPERATURE]
        if par[L.P_FIDELITY] != L.FINE:
            hottest = temperature
    if energy < state[L.S_SHOWN_ENERGY]:
        energy = state[L.S_SHOWN_ENERGY]  # heat does not come back: a too large advance waits
    out[L.O_TEMPERATURE], out[L.O_ENERGY] = temperature, energy
    first = state[L.S_FIRST] if started else before[2]
    out[L.O_OIL_HEAT], out[L.O_STORED_HEAT] = state[L.S_SHOWN_OIL_HEAT], state[L.S_SHOWN_STORED]
    if dt > 0.0:  # what was made and is not stored went into the oil
        out[L.O_STORED_HEAT] = stored_heat(par, work, first)
        more = out[L.O_STORED_HEAT] - state[L.S_SHOWN_STORED]
        out[L.O_OIL_HEAT] = (energy - state[L.S_SHOWN_ENERGY] - more) / dt
    out[L.O_ADVISED] = state[L.S_ADVISED]
    span, straight = dt, linear or before != (load, slip, oil, drum)
    if dt > 0.0:
        span = state[L.S_DURATION] if linear and started else dt
        out[L.O_ADVISED] = advise(par, state, span, straight, out[L.O_CAPACITY])
        if held_over(work[L.W_MEMORY :]) > 0.0:
            out[L.O_ADVISED] = held_over(work[L.W_MEMORY :]) * dt
        elif chatters(work[L.W_MEMORY :]):
            out[L.O_ADVISED] = min(out[L.O_ADVISED], LESS * dt)
        elif work[L.W_MEMORY + M.REVERSES] != 0.0 and state[L.S_ADVISED] > 0.0:
            out[L.O_ADVISED] = min(out[L.O_ADVISED], state[L.S_ADVISED])
    out[L.O_OIL_ENERGY] = energy - out[L.O_STORED_HEAT]
    if status == OK and not _is_finite(par, work, unknowns, out):
        status = NOT_FINITE
    if dt > 0.0 and status == OK:
        store_memory(par, work, unknowns, state)
        state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL] = load, slip, oil
        state[L.S_DRUM], state[L.S_FIRST] = drum, first
        state[L.S_POWER], state[L.S_DURATION], state[L.S_SUBSTEP] = power, dt, work[L.W_PROPOSED]
        state[L.S_SHOWN_TEMPERATURE], state[L.S_SHOWN_ENERGY] = temperature, energy
        state[L.S_SHOWN_OIL_HEAT] = out[L.O_OIL_HEAT]
        state[L.S_SHOWN_STORED] = out[L.O_STORED_HEAT]
        note_capacity(state, span if started else 0.0, out)
        copy(work[L.W_MEMORY :], state[L.S_MEMORY : L.S_MEMORY + M.N_MEMORY])
    show_states(par, first, work, out)
    iout[L.IO_REGIME] = regime_of(par, out[L.O_RATIO], slip)
    advice = OK
    if out[L.O_RATIO] < L.LEAST_RATIO:
        advice = OUTSIDE_VERIFIED
    if hottest > L.HOT_LIMIT:
        advice = HOT
    if holds:
        advice = told_of(coupling_of(par), work[L.W_MEMORY :], advice)
    elif chatters(work[L.W_MEMORY :]):
        advice = CHATTER
    if hottest > L.EXTRAPOLATED_LIMIT:
        advice = EXTRAPOLATED
    if advice != OK:
        fill_figures(coupling_of(par), work[L.W_MEMORY :], work[L.W_TOLD : L.W_TOLD + M.N_FIGURES])
    iout[L.IO_STATUS] = advice if status == OK else status
    return status


@kernel
def advise(par: Array, state: Array, span: float, straight: bool, capacity: float) -> float:
    """Return the step [s] whose change of the capacity a partner can do without.

    Over the last ``span`` [s] the capacity was held or, with inputs that move ``straight``, carried
    on as it had changed before; it may be off by a share of itself.
    """
    order, expected = 1.0, state[L.S_CAPACITY]
    if straight:
        if state[L.S_CAPACITY_SPAN] == 0.0:
            return span
        order = 2.0
        expected += state[L.S_CAPACITY_CHANGE] / state[L.S_CAPACITY_SPAN] * span
    if state[L.S_STARTED] == 0.0:
        return span
    pressed = LEAST_PRESSURE * LEAST_COEFFICIENT * par[L.D_AREA] * par[L.D_RADIUS] * par[L.P_FACES]
    allowed = ADVISED_SHARE * max(capacity, pressed)
    return advised_step(span, abs(capacity - expected), allowed, order)


@kernel
def note_capacity(state: Array, span: float, out: Array) -> None:
    """Keep the capacity and how it has changed over ``span`` [s], 0 at the start."""
    state[L.S_CAPACITY_CHANGE] = out[L.O_CAPACITY] - state[L.S_CAPACITY]
    state[L.S_CAPACITY], state[L.S_CAPACITY_SPAN] = out[L.O_CAPACITY], span
    state[L.S_ADVISED] = out[L.O_ADVISED]


@kernel
def point_at(inp: Array, s: float) -> tuple[float, float, float, float]:
    """Return load [N], slip [rad/s], oil temperature [K], drum speed [rad/s] ``s`` seconds on."""
    return (
        value_at(inp, L.NINP, L.I_LOAD, s),
        value_at(inp, L.NINP, L.I_SPEED, s),
        value_at(inp, L.NINP, L.I_OIL, s),
        value_at(inp, L.NINP, L.I_DRUM, s),
    )


@kernel
def show_states(par: Array, first: float, work: Array, out: Array) -> None:
    """Leave what model exchange has as states at W_STATES; a ring that is none at ``first`` [K].

    There is no bristle.
    """
    place, rings = L.W_NOW + L.Y_HEAT, int(par[L.D_RINGS])
    work[L.W_STATES + L.X_FILM], work[L.W_STATES + L.X_BEND] = out[L.O_RATIO], 0.0
    work[L.W_STATES + L.X_ENERGY] = out[L.O_ENERGY]
    for k in range(L.N_RINGS):
        of_ring = work[np.uintp(place)] if k < rings else first
        work[np.uintp(L.W_STATES + L.X_HEAT + k)] = of_ring
        place += 1 + int(par[L.D_MODES])


@kernel
def look_ahead(par: Array, inp: Array, dt: float, power: float, work: Array) -> None:
    """Warm the pack in W_NOW for ``dt`` with its present power; the temperatures to W_SURFACE.

    ``power``: of a face of a lumped pack [W].
    """
    oil, cooling = inp[L.I_OIL], work[L.W_COOLING]
    if par[L.P_FIDELITY] == L.FINE:
        film = work[np.uintp(L.W_NOW + L.Y_FILM)]
        if par[L.P_HOLDING] != M.OFF:
            work[L.W_GIVEN], work[L.W_GIVEN_POWER], work[L.W_GIVEN_SLOPE] = 1.0, power, 0.0
        pack_rates(par, inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_DRUM], film, work, L.W_NEIGHBOUR)
        for k in range(int(par[L.D_RINGS])):
            place = L.W_NEIGHBOUR + L.R_RINGS + k * L.N_OF_RING + L.R_POWER
            of_ring = work[np.uintp(place)]
            warm_up(par, k, of_ring, of_ring, oil, cooling, dt, work)
    else:
        warm_up(par, 0, power, power, oil, cooling, dt, work)
    surfaces(par, work, L.W_NOW, L.W_SURFACE)


@kernel
def _is_finite(par: Array, work: Array, unknowns: int, out: Array) -> bool:
    """Tell if what the memory takes over and all outputs are numbers."""
    known = work[unknowns : unknowns + n_unknowns(par)]
    return math.isfinite(work[L.W_PROPOSED]) and are_finite(known) and are_finite(out)
