"""One step of the driveline losses: torques against four speeds, powers, heat.

A torque is the size of a law at w = hypot(speed, s), times tanh(speed/s): odd and smooth in the
speed; s is the parameter ``speed_smoothing``.
"""

import math

import numpy as np

from ...numerics.arrays import are_finite, clear, copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.smoothing import soft_size, soft_size_slope
from ...numerics.status import BAD_INPUT, CHATTER, NOT_FINITE, OK, OUTSIDE_VERIFIED
from ...tribology.holding import memory as M
from ...tribology.holding.drag import keep, width_at
from ...tribology.holding.figures import fill_figures
from ...tribology.holding.reversals import chatters
from ...tribology.viscosity import viscosity
from .loss_laws import bearing_drag as bearing_drag
from .loss_laws import (
    churning_constants,
    churning_drag,
    churning_is_outside,
    churning_regime,
    seal_drag,
    starved,
)
from .skf_friction import SKF, fill_series, skf_drag
from .skf_series import RADIAL_NUMBERS
from .skf_series import ROW as SERIES_ROW

# places: P_ of parameters
P_PLANETS, P_PLANET_BEARING_COUNT, P_PLANET_BEARING_DIAMETER, P_PLANET_VISCOUS_FACTOR = range(0, 4)
P_PLANET_LOAD_FACTOR, P_BEARING_VISCOUS_FACTOR, P_BEARING_LOAD_FACTOR = range(4, 7)
P_PUMP_DISPLACEMENT, P_LINE_PRESSURE, P_PUMP_EFFICIENCY, P_OIL_VOLUME, P_OIL_DENSITY = range(7, 12)
P_VISCOSITY_CONSTANT, P_VISCOSITY_EXPONENT, P_VISCOSITY_SCALE, P_SPEED_SMOOTHING = range(12, 16)
P_INPUT_BEARING_COUNT, P_INPUT_BEARING_DIAMETER, P_INPUT_BEARING_LOAD = range(16, 19)
P_INPUT_GEAR_DIAMETER, P_INPUT_GEAR_WIDTH, P_INPUT_IMMERSION, P_INPUT_SEAL_DIAMETER = range(19, 23)
P_OUTPUT_BEARING_COUNT, P_OUTPUT_BEARING_DIAMETER, P_OUTPUT_BEARING_LOAD = range(23, 26)
P_OUTPUT_GEAR_DIAMETER, P_OUTPUT_GEAR_WIDTH, P_OUTPUT_IMMERSION = range(26, 29)
P_OUTPUT_SEAL_DIAMETER, P_DRUM_BEARING_COUNT, P_DRUM_BEARING_DIAMETER = range(29, 32)
P_DRUM_BEARING_LOAD, P_DRUM_GEAR_DIAMETER, P_DRUM_GEAR_WIDTH, P_DRUM_IMMERSION = range(32, 36)
P_DRUM_SEAL_DIAMETER, P_STARVATION_CONSTANT, P_BEARING_SECTION = range(36, 39)
P_BEARING_TYPE_CONSTANT, P_PLANET_BEARING_SECTION, P_PLANET_BEARING_TYPE_CONSTANT = range(39, 42)
P_BEARING_LAW, P_BEARING_SERIES, P_BEARING_SLIDING_FRICTION, P_FIDELITY, N_PARAM = range(42, 47)
# end of places
P_SHAFT = P_INPUT_BEARING_COUNT
# of each shaft, input, output, drum; places behind P_SHAFT + ROW times its number
A_COUNT, A_DIAMETER, A_LOAD, A_GEAR, A_WIDTH, A_IMMERSION, A_SEAL, ROW = range(8)
SHAFTS, PLANET, SPEEDS = 3, 3, 4  # the planet's speed comes behind those of the shafts
# of each shaft: churning by both sets, radius times width of the gear, cube root of that times the
# radius; of each speed: starvation of its bearings
D_SLOW, D_FAST, D_AREA, D_CUBE = (N_PARAM + i * SHAFTS for i in range(4))
D_STARVING = N_PARAM + 4 * SHAFTS
D_PUMP = D_STARVING + SPEEDS
D_NU_40 = D_PUMP + 1
D_SERIES = D_NU_40 + 1  # type and constants of the main bearings' series
NPAR = D_SERIES + SERIES_ROW
I_FORCE, I_OIL, NINP = SPEEDS, SPEEDS + 1, SPEEDS + 2
S_MEMORY = 1  # behind the heat since the start [J]: of each speed what its drag remembers
NSTATE = S_MEMORY + SPEEDS * M.N_MEMORY
(
    O_INPUT,
    O_OUTPUT,
    O_DRUM,
    O_PLANET,
    O_BEARING,
    O_CHURNING,
    O_PUMP,
    O_SEAL,
    O_HEAT,
    O_ENERGY,
    NOUT,
) = range(11)
NIOUT = SHAFTS + 1  # the regime of each shaft's gear, the status
SOURCES = 4  # of torque: bearing, churning, pump, seal; the order of their powers in the outputs
# `work`: torques by speed and source, then their slopes over speed and over temperature; that of
# the planet's torque over the tooth force; speeds over which the torques rise
W_TORQUE, W_BY_SPEED, W_BY_OIL = 0, SPEEDS * SOURCES, 2 * SPEEDS * SOURCES
W_BY_FORCE = 3 * SPEEDS * SOURCES
W_WIDTH = W_BY_FORCE + 1
W_MEMORY = W_WIDTH + SPEEDS  # of the driveline, while a step is made
W_TOLD = W_MEMORY + SPEEDS * M.N_MEMORY  # numbers in what is said of a speed
NWORK = W_TOLD + M.N_FIGURES
LIGHT = 1.0  # N, tooth force over which the corner at none is rounded
COLDEST, HOTTEST = 253.15, 423.15  # K, between which the laws are meant


@kernel
def derive(par: Array) -> int:
    """Fill in what does not depend on speed or temperature; return 0, or NOT_FINITE."""
    density = par[P_OIL_DENSITY]
    for i in range(SHAFTS):
        row = P_SHAFT + i * ROW
        gear, width = par[np.uintp(row + A_GEAR)], par[np.uintp(row + A_WIDTH)]
        par[np.uintp(D_SLOW + i)], par[np.uintp(D_FAST + i)] = churning_constants(
            gear, width, par[np.uintp(row + A_IMMERSION)], par[P_OIL_VOLUME], density
        )
        par[np.uintp(D_AREA + i)] = 0.5 * gear * width
        par[np.uintp(D_CUBE + i)] = (0.25 * gear * gear * width) ** (1.0 / 3.0)
        par[np.uintp(D_STARVING + i)] = starved(
            par[P_STARVATION_CONSTANT],
            par[P_BEARING_TYPE_CONSTANT],
            par[np.uintp(row + A_DIAMETER)],
            par[P_BEARING_SECTION],
        )
    par[D_STARVING + PLANET] = starved(
        par[P_STARVATION_CONSTANT],
        par[P_PLANET_BEARING_TYPE_CONSTANT],
        par[P_PLANET_BEARING_DIAMETER],
        par[P_PLANET_BEARING_SECTION],
    )
    work = par[P_PUMP_DISPLACEMENT] * par[P_LINE_PRESSURE]
    par[D_PUMP] = work / (2.0 * math.pi * par[P_PUMP_EFFICIENCY])
    thick, _ = oil_viscosity(par, 313.15)
    par[D_NU_40] = thick
    fill_series(RADIAL_NUMBERS, int(par[P_BEARING_SERIES]), par[D_SERIES : D_SERIES + SERIES_ROW])
    return OK if are_finite(par[N_PARAM:]) else NOT_FINITE


@kernel
def broken_rule(par: Array) -> int:
    """Return 1 where SKF's model has no constants for the main bearings, else 0."""
    return 1 if int(par[P_BEARING_LAW]) == SKF and int(par[P_BEARING_SERIES]) <= 1 else 0


@kernel
def oil_viscosity(par: Array, oil: float) -> tuple[float, float]:
    """Return the kinematic viscosity [m2/s] and its slope over temperature."""
    mu, slope = viscosity(
        oil, par[P_VISCOSITY_SCALE], par[P_VISCOSITY_CONSTANT], par[P_VISCOSITY_EXPONENT]
    )
    return mu / par[P_OIL_DENSITY], slope / par[P_OIL_DENSITY]


@kernel
def put(work: Array, at: int, sign: float, drag: tuple[float, float, float], steep: float) -> None:
    """Add a torque and its slopes at a place of ``work``.

    ``drag``: its size, its slopes over speed and temperature; ``sign`` of the motion, smooth, and
    ``steep``, how it changes with the speed.
    """
    size, by_speed, by_oil = drag
    work[np.uintp(W_TORQUE + at)] += size * sign
    work[np.uintp(W_BY_SPEED + at)] += size * steep + by_speed * sign
    work[np.uintp(W_BY_OIL + at)] += by_oil * sign


@kernel
def resist(par: Array, inp: Array, work: Array, sizes: bool) -> None:
    """Fill ``work`` with the torques at these inputs and their slopes; ``sizes``: with their sizes.

    A size does not pass through zero with the speed; else the widths in which a torque does so are
    in ``work``.
    """
    clear(work[:W_WIDTH])
    oil, force, smooth = inp[I_OIL], inp[I_FORCE], par[P_SPEED_SMOOTHING]
    nu, nu_slope = oil_viscosity(par, oil)
    for i in range(SPEEDS):
        speed, at = inp[np.uintp(i)], i * SOURCES
        turning = math.sqrt(speed * speed + smooth * smooth)
        more, sign, steep = speed / turning, 1.0, 0.0
        starving = par[np.uintp(D_STARVING + i)]
        if not sizes:
            width = work[np.uintp(W_WIDTH + i)]
            sign = math.tanh(speed / width)
            steep = (1.0 - sign) * (1.0 + sign) / width
        if i == PLANET:
            load = 2.0 * soft_size(force, LIGHT)
            n, diameter = par[P_PLANET_BEARING_COUNT], par[P_PLANET_BEARING_DIAMETER]
            f0, f1 = par[P_PLANET_VISCOUS_FACTOR], par[P_PLANET_LOAD_FACTOR]
            drag, a, b = bearing_drag(turning, nu, load / n, diameter, f0, f1, starving)
            put(work, at, sign, (n * drag, n * a * more, n * b * nu_slope), steep)
            slope = 2.0 * soft_size_slope(force, LIGHT)
            work[W_BY_FORCE] = slope * f1 * diameter * sign
            continue
        row = P_SHAFT + i * ROW
        n, diameter = par[np.uintp(row + A_COUNT)], par[np.uintp(row + A_DIAMETER)]
        f0, f1 = par[P_BEARING_VISCOUS_FACTOR], par[P_BEARING_LOAD_FACTOR]
        load = par[np.uintp(row + A_LOAD)]
        if int(par[P_BEARING_LAW]) == SKF:
            row_of_series = par[D_SERIES : D_SERIES + SERIES_ROW]
            film = par[P_BEARING_SLIDING_FRICTION]
            drag, a, b = skf_drag(
                turning, nu, (load, 0.0), diameter, starving, row_of_series, (0.0, 1.0), film
            )
        else:
            drag, a, b = bearing_drag(turning, nu, load, diameter, f0, f1, starving)
        put(work, at, sign, (n * drag, n * a * more, n * b * nu_slope), steep)
        slow, fast = par[np.uintp(D_SLOW + i)], par[np.uintp(D_FAST + i)]
        area, cube = par[np.uintp(D_AREA + i)], par[np.uintp(D_CUBE + i)]
        drag, a, b = churning_drag(turning, nu, slow, fast, area, cube)
        put(work, at + 1, sign, (drag, a * more, b * nu_slope), steep)
        if i == O_INPUT:
            put(work, at + 2, sign, (par[D_PUMP], 0.0, 0.0), steep)
        drag, b = seal_drag(oil, par[D_NU_40], par[np.uintp(row + A_SEAL)])
        put(work, at + 3, sign, (drag, 0.0, b), steep)


@kernel
def memory_of(work: Array, i: int) -> Array:
    """Return what is remembered of a speed."""
    place = W_MEMORY + i * M.N_MEMORY
    return work[place : place + M.N_MEMORY]


@kernel
def keep_torques(par: Array, inp: Array, work: Array, dt: float) -> bool:
    """Remember the torques that were given; tell if one of the speeds chatters."""
    way, told = (M.IDENTIFIED, 0.0, 0, par[P_SPEED_SMOOTHING], False), False
    for i in range(SPEEDS):
        speed, torque, mem = inp[np.uintp(i)], 0.0, memory_of(work, i)
        for k in range(SOURCES):
            torque += work[np.uintp(W_TORQUE + i * SOURCES + k)]
        risen = math.tanh(abs(speed) / work[np.uintp(W_WIDTH + i)])
        capacity = abs(torque) / risen if risen > 0.0 else 0.0
        if dt > 0.0:
            keep(way, mem, speed, dt, torque, capacity)
        if chatters(mem) and not told:
            fill_figures(way, mem, work[W_TOLD : W_TOLD + M.N_FIGURES])
        told = told or chatters(mem)
    return told


@kernel
def classed(par: Array, inp: Array, iout: Ints) -> bool:
    """Fill in the regime of each shaft's gear; tell if one churns outside the range of the laws."""
    nu, _ = oil_viscosity(par, inp[I_OIL])
    outside = False
    for i in range(SHAFTS):
        speed, depth = inp[np.uintp(i)], par[np.uintp(P_SHAFT + i * ROW + A_IMMERSION)]
        area, cube = par[np.uintp(D_AREA + i)], par[np.uintp(D_CUBE + i)]
        radius = 0.5 * par[np.uintp(P_SHAFT + i * ROW + A_GEAR)]
        iout[np.uintp(i)] = churning_regime(speed, nu, depth, area, cube)
        outside = outside or churning_is_outside(speed, nu, depth, radius, area)
    return outside


@kernel
def step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float
) -> int:
    """Fill the outputs at the present inputs, held from t to t + dt.

    Returns 0 or the status of a failure; advice stands in ``iout`` only.
    """
    oil = inp[I_OIL]
    if not (are_finite(inp) and oil > 0.0 and math.isfinite(dt) and dt >= 0.0):
        iout[SHAFTS] = BAD_INPUT
        return BAD_INPUT
    way = (M.IDENTIFIED, 0.0, 0, par[P_SPEED_SMOOTHING], False)
    copy(state[S_MEMORY:NSTATE], work[W_MEMORY:W_TOLD])
    for i in range(SPEEDS):
        speed = inp[np.uintp(i)]
        work[np.uintp(W_WIDTH + i)] = width_at(way, memory_of(work, i), speed, dt)
    resist(par, inp, work, False)
    clear(out)
    for i in range(SPEEDS):
        speed = inp[np.uintp(i)]
        if i == PLANET:
            speed *= par[P_PLANETS]
        for k in range(SOURCES):
            torque = work[np.uintp(W_TORQUE + i * SOURCES + k)]
            out[np.uintp(i)] += torque
            out[np.uintp(O_BEARING + k)] += torque * speed
    out[O_HEAT] = out[O_BEARING] + out[O_CHURNING] + out[O_PUMP] + out[O_SEAL]
    out[O_ENERGY] = state[0] + out[O_HEAT] * dt
    status = OK if COLDEST <= oil <= HOTTEST else OUTSIDE_VERIFIED
    if classed(par, inp, iout):
        status = OUTSIDE_VERIFIED
    if not are_finite(out):
        status = NOT_FINITE
    elif keep_torques(par, inp, work, dt):
        status = CHATTER
    if dt > 0.0 and status < 10:
        state[0] = out[O_ENERGY]
        copy(work[W_MEMORY:W_TOLD], state[S_MEMORY:NSTATE])
    iout[SHAFTS] = status
    return status if status >= 10 else 0


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` with the change of the real outputs when the inputs change by ``seed``.

    ``work`` is as the last successful step with these inputs left it. Returns 0, or NOT_FINITE.
    """
    clear(dout)
    for i in range(SPEEDS):
        speed, faster = inp[np.uintp(i)], seed[np.uintp(i)]
        count = par[P_PLANETS] if i == PLANET else 1.0
        for k in range(SOURCES):
            at = i * SOURCES + k
            change = work[np.uintp(W_BY_SPEED + at)] * faster
            change += work[np.uintp(W_BY_OIL + at)] * seed[I_OIL]
            if i == PLANET and k == 0:
                change += work[W_BY_FORCE] * seed[I_FORCE]
            dout[np.uintp(i)] += change
            power = change * speed + work[np.uintp(W_TORQUE + at)] * faster
            dout[np.uintp(O_BEARING + k)] += count * power
    dout[O_HEAT] = dout[O_BEARING] + dout[O_CHURNING] + dout[O_PUMP] + dout[O_SEAL]
    return OK if are_finite(dout) else NOT_FINITE
