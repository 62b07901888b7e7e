# mypy: disable-error-code="no-any-return"
"""One co-simulation step of the shift transmission: received torques in, speeds and loads out.

With rates of the inputs behind them capacities, engine torque and pressures run straight over the
step from the values at its start; the other inputs count with their value at the middle. What is
shown belongs to the inputs at the end.
"""

import math

import numpy as np

from ...numerics.arrays import are_finite, clear, copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.profiles import rate_of, value_at
from ...numerics.status import BAD_INPUT, NOT_FINITE, OK, STALLED
from ...numerics.step_size import advised_step
from . import dynamics, piston
from . import layout as L
from .directional_derivative import LEAST_WASHER_LOAD, directional_derivative
from .integrate_step import is_at_rest, run
from .planet_bearing import loads_of, settle, washer_share
from .shaft_losses import loss_power
from .thrust_bearings import bearing_power, bearing_torque

N_PARAM, NPAR, NINP, NSTATE = L.N_PARAM, L.NPAR, L.NINP, L.NSTATE
NWORK, NOUT, NIOUT = L.NWORK, L.NOUT, L.NIOUT
NRATES, RUN_START = NINP, L.D_RUN_START
ADVISED_SHARE = 0.01  # of the largest torque: what that of a slipping pack may be off by
derive, broken_rule, sens = dynamics.derive, dynamics.broken_rule, directional_derivative

SHORT = 1e-3  # last steps: a step shorter than this takes changed inputs in part
AHEAD = 50.0  # last steps that capacities go on changing for, at most


@kernel
def start_speeds(par: Array) -> tuple[float, float]:
    """Return the speeds of driven gear and carrier at the start [rad/s].

    With the drum at rest, or as fast as the driven gear, the slip of brake or clutch is zero to the
    last bit, or nothing could stick.
    """
    driven, drum, r = par[L.P_INITIAL_ENGINE_SPEED], par[L.P_INITIAL_DRUM_SPEED], par[L.D_RATIO]
    if drum == driven:
        return driven, driven
    carrier = (driven + r * drum) / (1.0 + r)
    return (1.0 + r) * carrier if drum == 0.0 else driven, carrier


@kernel
def begin(par: Array, inp: Array, state: Array, work: Array) -> None:
    """Copy the memory, or the start values, to where the step works."""
    if state[L.S_STARTED] != 0.0:
        copy(state[L.S_Y :], work[L.W_Y : L.W_NEW])
        work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE] = state[L.S_CLUTCH_MODE], state[L.S_BRAKE_MODE]
        copy(state[L.S_LOCK_TIME :], work[L.W_EVENTS : L.W_EVENTS + 4])
        copy(state[L.S_PISTON :], work[L.W_PISTON : L.W_Y])
        return
    clear(work[L.W_Y : L.W_NEW])
    driven, carrier = start_speeds(par)
    work[L.W_Y + L.Y_INPUT], work[L.W_Y + L.Y_CARRIER] = driven, carrier
    work[L.W_Y + L.Y_VEHICLE], work[L.W_Y + L.Y_TWIST] = carrier, par[L.P_INITIAL_TWIST]
    work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE] = 1.0, 1.0
    work[L.W_EVENTS], work[L.W_EVENTS + 1], work[L.W_EVENTS + 2] = -1.0, 0.0, -1.0
    work[L.W_EVENTS + 3] = 0.0


@kernel
def take(inp: Array, state: Array, taken: Array, dt: float) -> None:
    """Fill the inputs as the step takes them: as given, or on the way there in a short step.

    A step of at least a thousandth of the last one takes the inputs as given. Shorter ones go the
    same way in that time, each a part in proportion to its length: what changes in a step then
    vanishes with the step, as a master that estimates its error expects. Without a step an input
    that is still as the last step was given it is what that had reached. One with a rate is as
    given; the rates lie behind.
    """
    share, started = 1.0, state[L.S_STARTED] != 0.0
    if started and 0.0 < dt < SHORT * state[L.S_SPREAD]:
        share = dt / (SHORT * state[L.S_SPREAD])
    for i in range(L.NINP):
        value, reached = inp[np.uintp(i)], state[np.uintp(L.S_REACHED + i)]
        if started and dt == 0.0 and value == state[np.uintp(L.S_GIVEN + i)]:
            value = reached
        rate = rate_of(inp, L.NINP, i) if dt > 0.0 else 0.0
        if share < 1.0 and rate == 0.0:
            value = reached + share * (value - reached)
        taken[np.uintp(i)], taken[np.uintp(L.NINP + i)] = value, rate


@kernel
def take_torques(par: Array, taken: Array, work: Array, s: float) -> None:
    """Take the torques that hold over a step as they are ``s`` seconds into it."""
    r = par[L.D_RATIO]
    work[L.W_LOAD_GIVEN] = value_at(taken, L.NINP, L.I_LOAD, s)
    work[L.W_WASHERS] = par[L.P_WASHERS] * abs(value_at(taken, L.NINP, L.I_WASHER, s))
    ring = par[L.D_RING_MESHES] * abs(value_at(taken, L.NINP, L.I_RING_MESH, s))
    work[L.W_MESHES] = par[L.D_MESHES] * abs(value_at(taken, L.NINP, L.I_MESH, s)) + ring
    for k in range(4):
        size = abs(value_at(taken, L.NINP, L.I_INPUT_LOSS + k, s))
        work[np.uintp(L.W_INPUT_LOSS + k)] = size
    work[L.W_PLANET_LOSS] *= par[L.P_PLANETS]
    drag = (work[L.W_WASHERS] + work[L.W_MESHES]) * par[L.D_SPIN]
    work[L.W_DRAG] = drag * r / (1.0 + r)
    for k in range(2):
        given = value_at(taken, L.NINP, L.I_CLUTCH + k, s)
        as_given = par[L.P_COUPLING] == L.TORQUE_COUPLING
        work[np.uintp(L.W_CLUTCH_GIVEN + k)] = given if as_given else 0.0


@kernel
def receive(par: Array, inp: Array, taken: Array, state: Array, work: Array, dt: float) -> None:
    """Turn the received torques into capacities over the step, or torques taken as they are.

    Capacities arrive once per step and would be up to a step old at its end. They go on changing
    as they did in the last step, from the instant they belong to (``torque_age`` steps ago): the
    error then falls with the square of the step. Where the friction law has a kink the capacity
    overshoots for one step (a few percent just before lock-up at 1 ms). After a step much shorter
    than this one they go on no further than ``AHEAD`` of its lengths. A capacity with a rate goes
    on with that rate, from the start of the step.
    """
    take_torques(par, taken, work, 0.5 * dt)
    work[L.W_ENGINE_GIVEN] = taken[L.I_ENGINE]
    for k in range(2):
        start, slope = 0.0, 0.0
        rate = rate_of(taken, L.NINP, L.I_CLUTCH + k)
        if par[L.P_COUPLING] != L.TORQUE_COUPLING and rate != 0.0:
            start, slope = taken[np.uintp(L.I_CLUTCH + k)], rate
        elif par[L.P_COUPLING] != L.TORQUE_COUPLING:
            sent = max(0.0, inp[np.uintp(L.I_CLUTCH + k)])
            last = max(0.0, state[np.uintp(L.S_LAST_CLUTCH + k)])
            start = max(0.0, taken[np.uintp(L.I_CLUTCH + k)])
            if dt == 0.0 and state[L.S_STARTED] != 0.0 and sent == last:
                start = state[np.uintp(L.S_CLUTCH_NOW + k)]
            elif par[L.P_CAPACITY_EXTRAPOLATION] != 0.0 and state[L.S_STARTED] != 0.0:
                slope = (sent - last) / state[L.S_SPREAD]
                if dt > AHEAD * state[L.S_LAST_DURATION]:
                    slope *= AHEAD * state[L.S_LAST_DURATION] / dt
                ahead = dt if dt > 0.0 else state[L.S_LAST_DURATION]
                start += slope * par[L.P_TORQUE_AGE] * ahead
        work[np.uintp(L.W_CLUTCH_START + 2 * k)] = start
        work[np.uintp(L.W_CLUTCH_SLOPE + 2 * k)] = slope if dt > 0.0 else 0.0


@kernel
def advise(par: Array, inp: Array, state: Array, work: Array, dt: float) -> float:
    """Return the step [s] at which the torques of slipping packs are off by as much as they may be.

    By the last step: what a torque was carried on to, or held at, and what arrived in its place.
    What a pack that sticks could hold moves nothing.
    """
    if state[L.S_STARTED] == 0.0:
        return dt
    worst, largest, order = 0.0, abs(work[L.W_ENGINE]), 1.0
    taken = par[L.P_COUPLING] == L.TORQUE_COUPLING
    if par[L.P_CAPACITY_EXTRAPOLATION] != 0.0 and not taken:
        order = 2.0
    for k in range(2):
        arrived = inp[np.uintp(L.I_CLUTCH + k)]
        if not taken:
            arrived = work[np.uintp(L.W_CLUTCH_START + 2 * k)]
        if rate_of(inp, L.NINP, L.I_CLUTCH + k) != 0.0:
            order = 2.0
        largest = max(largest, abs(arrived))
        if state[np.uintp(L.S_CLUTCH_MODE + k)] != L.STUCK:
            worst = max(worst, abs(arrived - state[np.uintp(L.S_CLUTCH_NOW + k)]))
    return advised_step(state[L.S_LAST_DURATION], worst, ADVISED_SHARE * largest, order)


@kernel
def press(par: Array, taken: Array, state: Array, work: Array, t: float, dt: float) -> int:
    """Carry both pistons over the step; return a status."""
    status = OK
    if par[L.P_ACTUATION] == L.PRESSURE:
        for k in range(2):
            after = value_at(taken, L.NINP, L.I_PRESSURE + k, dt)
            before = state[np.uintp(L.S_LAST_PRESSURE + k)]
            if state[L.S_STARTED] == 0.0 or rate_of(taken, L.NINP, L.I_PRESSURE + k) != 0.0:
                before = taken[np.uintp(L.I_PRESSURE + k)]
            if state[L.S_STARTED] == 0.0:
                piston.rest(par, work, k, piston.commanded(par, k, t, t, dt, before, after))
            if dt == 0.0:
                piston.show_now(par, work, k, piston.commanded(par, k, t, t, dt, before, after))
            else:
                status = max(status, piston.advance(par, work, k, t, dt, before, after))
        return status
    clear(work[L.W_PISTON : L.W_Y])
    return status


@kernel
def kinetic_start(par: Array, state: Array, dt: float) -> float:
    """Return the kinetic energy at the start [J]; -1 before any step: that of now."""
    if state[L.S_STARTED] != 0.0:
        return float(state[L.S_KINETIC_START])
    if dt == 0.0:
        return -1.0
    driven, carrier = start_speeds(par)
    return float(dynamics.kinetic_energy(par, driven, carrier, carrier))


@kernel
def keep(
    par: Array,
    inp: Array,
    state: Array,
    work: Array,
    start: float,
    dt: float,
    power: float,
    lost: float,
) -> None:
    """Take the result of a step over into the memory."""
    state[L.S_KINETIC_START] = start
    state[L.S_BEARING_POWER], state[L.S_LOSS_POWER] = power, lost
    state[L.S_STARTED] = 1.0
    copy(work[L.W_Y :], state[L.S_Y : L.S_KINETIC_START])
    state[L.S_LAST_DURATION] = dt
    state[L.S_SPREAD] = max(dt, state[L.S_SPREAD] - dt / SHORT)
    for i in range(L.NINP):  # as they are at the end
        state[np.uintp(L.S_GIVEN + i)] = value_at(inp, L.NINP, i, dt)
        state[np.uintp(L.S_REACHED + i)] = value_at(work[L.W_TAKEN :], L.NINP, i, dt)
    if par[L.P_COUPLING] != L.TORQUE_COUPLING:
        for k in range(2):
            state[np.uintp(L.S_CLUTCH_NOW + k)] = dynamics.capacity(work, k, dt)
    state[L.S_CLUTCH_MODE], state[L.S_BRAKE_MODE] = work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE]
    copy(work[L.W_EVENTS :], state[L.S_LOCK_TIME : L.S_BEARING_POWER])
    copy(work[L.W_PISTON :], state[L.S_PISTON : L.S_GIVEN])


@kernel
def show_motion(par: Array, taken: Array, work: Array, out: Array, s: float) -> None:
    """Fill speeds, torques and loads at ``s`` seconds into the step."""
    r = par[L.D_RATIO]
    driven, carrier = work[L.W_Y + L.Y_INPUT], work[L.W_Y + L.Y_CARRIER]
    resists = dynamics.output_torque(par, work, L.W_Y)
    dynamics.solve_torques(par, work, s, L.W_Y)
    clutch = dynamics.clutch_share(par, work, s)
    drag = (work[L.W_CLUTCH] - clutch) * (1.0 + r) / r
    tau = work[L.W_TEETH]
    force = abs(tau) / (par[L.P_PLANETS] * par[L.D_INPUT_RADIUS])
    couple = 2.0 * par[L.D_PLANET_RADIUS] * force * par[L.D_TAN_HELIX]
    drum = dynamics.drum_speed(r, driven, carrier)
    if par[L.P_ACTUATION] == L.PRESSURE:
        out[L.O_CLUTCH_LOAD] = piston.force(par, work, 0, drum)
        out[L.O_BRAKE_LOAD] = piston.force(par, work, 1, drum)
    else:
        command = value_at(taken, L.NINP, L.I_COMMAND, s)
        out[L.O_CLUTCH_LOAD] = command * par[L.P_CLUTCH_FORCE]
        out[L.O_BRAKE_LOAD] = (1.0 - command) * par[L.P_BRAKE_FORCE]
    spin = par[L.D_SPIN] * (driven - carrier)
    out[L.O_CLUTCH_SPEED] = dynamics.clutch_slip(r, driven, carrier)
    out[L.O_BRAKE_SPEED] = drum
    out[L.O_CLUTCH_HUB_SPEED], out[L.O_CLUTCH_DRUM_SPEED] = driven, drum
    out[L.O_BRAKE_HUB_SPEED], out[L.O_BRAKE_DRUM_SPEED] = drum, 0.0
    load = par[L.P_THRUST_SHARE] * couple / (2.0 * par[L.P_WASHER_RADIUS])
    out[L.O_WASHER_TILT] = par[L.P_PLANET_TILT]
    if par[L.P_NEEDLE_COUNT] > 0.0:
        loads = work[L.W_PLANET_LOADS :]
        loads_of(par, force, carrier, couple, loads)
        settled = settle(par, loads, work[L.W_SETTLED :])
        load, out[L.O_WASHER_TILT] = washer_share(par, work[L.W_SETTLED :])
        if not settled:
            load = math.nan  # its status is NOT_FINITE
    out[L.O_WASHER_LOAD] = max(load, LEAST_WASHER_LOAD)
    out[L.O_WASHER_SPEED] = spin
    out[L.O_MESH_LOAD] = force * par[L.D_PLANET_RADIUS]
    out[L.O_MESH_SPEED] = spin
    out[L.O_ENGINE_SPEED], out[L.O_OUTPUT_SPEED] = driven, carrier
    out[L.O_DRUM_SPEED] = drum
    out[L.O_DRIVE_TORQUE] = work[L.W_ENGINE]
    vehicle = dynamics.vehicle_speed(par, work, L.W_Y)
    load = dynamics.load_torque(par, work, vehicle)
    out[L.O_RESISTANCE_TORQUE] = load
    out[L.O_OUTPUT_TORQUE] = resists + par[L.P_CARRIER_INERTIA] * work[L.W_CARRIER_RATE]
    out[L.O_OUTPUT_ACCELERATION] = work[L.W_CARRIER_RATE]
    if par[L.P_SHAFT_STIFFNESS] > 0.0:
        out[L.O_OUTPUT_ACCELERATION] = (resists - load) / par[L.P_VEHICLE_INERTIA]
    for k in range(2):
        own = L.W_PISTON + k * L.N_PISTON
        out[np.uintp(L.O_CLUTCH_PISTON_PRESSURE + k)] = work[np.uintp(own)]
        out[np.uintp(L.O_CLUTCH_FILLED_TIME + k)] = work[np.uintp(own + L.PISTON_FILLED_TIME)]
        out[np.uintp(L.O_CLUTCH_KISS_TIME + k)] = work[np.uintp(own + L.PISTON_KISS_TIME)]
    out[L.O_VEHICLE_SPEED], out[L.O_SHAFT_TORQUE] = vehicle, resists
    out[L.O_SHAFT_TWIST] = work[L.W_Y + L.Y_TWIST]
    out[L.O_CLUTCH_REACTION], out[L.O_BRAKE_REACTION] = clutch, work[L.W_BRAKE]
    out[L.O_INPUT_TOOTH_TORQUE], out[L.O_DRAG_TORQUE] = tau, drag
    out[L.O_TOOTH_FORCE], out[L.O_TILTING_COUPLE] = force, couple
    out[L.O_SUN_THRUST] = abs(tau) * par[L.D_TAN_HELIX] / par[L.D_INPUT_RADIUS]
    for k in range(2):
        rubbing = bearing_torque(par, work, k, L.W_Y)
        out[np.uintp(L.O_SUN_BEARING_TORQUE + k)] = work[L.W_BEARING_TEETH] * rubbing
    out[L.O_OIL_SUPPLY_TEMPERATURE] = par[L.P_OIL_TEMPERATURE]


@kernel
def mean_power(state: Array, work: Array, heat: int, last: int, now: float, dt: float) -> float:
    """Return a power [W]: the step's mean, before any step that of ``now``.

    ``heat``: its place among the integrated quantities; ``last``: that of the last step's mean.
    """
    if dt > 0.0:
        before = state[np.uintp(L.S_Y + heat)] if state[L.S_STARTED] != 0.0 else 0.0
        return float((work[np.uintp(L.W_Y + heat)] - before) / dt)
    if state[L.S_STARTED] != 0.0:
        return float(state[np.uintp(last)])
    return now


@kernel
def show_energy(par: Array, start: float, work: Array, out: Array) -> None:
    """Fill the energy book, kinetic energy at the ``start`` [J] given; negative: that of now.

    The residual is what the entries leave unexplained.
    """
    driven, carrier = work[L.W_Y + L.Y_INPUT], work[L.W_Y + L.Y_CARRIER]
    vehicle = dynamics.vehicle_speed(par, work, L.W_Y)
    kinetic = dynamics.kinetic_energy(par, driven, carrier, vehicle)
    if start < 0.0:
        start = kinetic
    out[L.O_ENGINE_WORK] = work[L.W_Y + L.Y_ENGINE]
    out[L.O_LOAD_WORK] = work[L.W_Y + L.Y_LOAD]
    out[L.O_KINETIC_ENERGY], out[L.O_KINETIC_CHANGE] = kinetic, kinetic - start
    out[L.O_CLUTCH_HEAT] = work[L.W_Y + L.Y_CLUTCH]
    out[L.O_BRAKE_HEAT] = work[L.W_Y + L.Y_BRAKE]
    out[L.O_WASHER_HEAT] = work[L.W_Y + L.Y_WASHER]
    out[L.O_MESH_HEAT] = work[L.W_Y + L.Y_MESH]
    out[L.O_BEARING_HEAT] = work[L.W_Y + L.Y_BEARING]
    out[L.O_LOSS_HEAT] = work[L.W_Y + L.Y_LOSS]
    out[L.O_SHAFT_HEAT] = work[L.W_Y + L.Y_SHAFT]
    out[L.O_SHAFT_ENERGY] = dynamics.spring_energy(par, work[L.W_Y + L.Y_TWIST])
    spent = out[L.O_KINETIC_CHANGE] + out[L.O_LOAD_WORK] + out[L.O_CLUTCH_HEAT]
    spent += out[L.O_BRAKE_HEAT] + out[L.O_WASHER_HEAT] + out[L.O_MESH_HEAT]
    spent += out[L.O_SHAFT_HEAT] + out[L.O_SHAFT_ENERGY] + out[L.O_BEARING_HEAT]
    spent += out[L.O_LOSS_HEAT]
    out[L.O_ENERGY_RESIDUAL] = out[L.O_ENGINE_WORK] - spent
    out[L.O_LOCK_TIME], out[L.O_LOCK_SPEED] = work[L.W_EVENTS], work[L.W_EVENTS + 1]
    out[L.O_RELEASE_TIME] = work[L.W_EVENTS + 2]


@kernel
def are_inside(inp: Array, s: float) -> bool:
    """Tell if command and pressures are in their ranges ``s`` seconds into the step."""
    good = 0.0 <= value_at(inp, L.NINP, L.I_COMMAND, s) <= 1.0
    for k in range(2):
        good = good and value_at(inp, L.NINP, L.I_PRESSURE + k, s) >= 0.0
    return good


@kernel
def step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float
) -> int:
    """Advance the driveline from t to t + dt, then fill the outputs.

    Returns 0 or the status of a failure; STALLED is advice and stands in ``iout`` only.
    """
    good = are_finite(inp) and math.isfinite(t) and math.isfinite(dt) and dt >= 0.0
    if not (good and are_inside(inp, 0.0) and are_inside(inp, dt)):
        iout[L.IO_STATUS] = BAD_INPUT
        return BAD_INPUT
    begin(par, inp, state, work)
    taken = work[L.W_TAKEN :]
    take(inp, state, taken, dt)
    receive(par, inp, taken, state, work, dt)
    pressed = press(par, taken, state, work, t, dt)
    status = run(par, work, t, dt, state[L.S_STARTED] != 0.0 and dt > 0.0)
    start = kinetic_start(par, state, dt)
    take_torques(par, taken, work, dt)
    show_motion(par, taken, work, out, dt)
    show_energy(par, start, work, out)
    now = bearing_power(par, work, L.W_Y)
    power = mean_power(state, work, L.Y_BEARING, L.S_BEARING_POWER, now, dt)
    now = loss_power(work, L.W_Y)
    lost = mean_power(state, work, L.Y_LOSS, L.S_LOSS_POWER, now, dt)
    out[L.O_BEARING_POWER], out[L.O_LOSS_POWER] = power, lost
    out[L.O_ADVISED_STEP] = advise(par, inp, state, work, dt) if dt > 0.0 else state[L.S_ADVISED]
    if status == OK:
        status = pressed
    if status == OK and not _is_finite(work, out, dt):
        status = NOT_FINITE
    if status == OK and dt > 0.0:
        keep(par, inp, state, work, start, dt, power, lost)
        state[L.S_ADVISED] = out[L.O_ADVISED_STEP]
    clutch_holds = dynamics.capacity(work, 0, dt) > 0.0
    iout[L.IO_CLUTCH_LOCKED] = 1 if work[L.W_CLUTCH_MODE] == 0.0 and clutch_holds else 0
    iout[L.IO_BRAKE_LOCKED] = 1 if work[L.W_BRAKE_MODE] == 0.0 else 0
    for k in range(2):
        full = work[np.uintp(L.W_PISTON + k * L.N_PISTON + L.PISTON_FULL)]
        iout[np.uintp(L.IO_CLUTCH_FILLED + k)] = 1 if full != 0.0 else 0
    iout[L.IO_EVENTS] = int(work[L.W_EVENTS + 3])
    iout[L.IO_STATUS] = STALLED if status == OK and is_at_rest(par, work) else status
    return status


@kernel
def _is_finite(work: Array, out: Array, dt: float) -> bool:
    """Tell if what the memory takes over and all outputs are numbers."""
    good = math.isfinite(dt) and are_finite(work[L.W_Y : L.W_NEW]) and are_finite(out)
    good = good and are_finite(work[L.W_EVENTS : L.W_EVENTS + 4])
    good = good and math.isfinite(dynamics.capacity(work, 0, dt))
    return good and math.isfinite(dynamics.capacity(work, 1, dt))
