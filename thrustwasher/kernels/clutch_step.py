# mypy: disable-error-code="no-any-return"
"""One co-simulation step of the wet clutch: friction now, heat and energy since the last step.

Friction follows load and slip at once (the film is settled); memory is the heat. Power is taken as
piecewise linear between the points at which inputs arrive: a step that begins knows the power now
and the power one step ago, so the step before is booked by the trapezium rule (second order) and
the new step in advance with the power held; the next call replaces that advance.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .boundary import ploughing, shear_ratio
from .heating import temperature_after
from .lining import pressure_scale, separation

Array = NDArray[np.float64]

# Parameters, in the order of ClutchParams.
(
    P_INNER_RADIUS, P_OUTER_RADIUS, P_FACES, P_EFFECTIVE_RADIUS, P_FRICTION_LAW,
    P_CONSTANT_FRICTION, P_INDENTATION, P_PLOUGH_WEIGHT, P_HARDNESS_RATIO, P_SHEAR_FLOOR,
    P_STICK_SPEED, P_DECAY_SPEED, P_KINK_WIDTH, P_ROUGHNESS, P_CONTACT_MODULUS,
    P_ASPERITY_DENSITY, P_ASPERITY_RADIUS, P_LINING_THICKNESS, P_PERMEABILITY, P_GROOVE_FACTOR,
    P_INITIAL_FILM, P_FILM_DYNAMICS, P_VISCOSITY_CONSTANT, P_VISCOSITY_EXPONENT,
    P_VISCOSITY_SCALE, P_STEEL_THICKNESS, P_STEEL_DENSITY, P_STEEL_HEAT_CAPACITY,
    P_HEAT_TRANSFER, P_SPEED_SMOOTHING, P_FIDELITY,
) = range(31)  # fmt: skip
N_PARAM = 31
# Constants that derive() adds.
D_AREA, D_RADIUS, D_PLOUGH, D_ADHESION, D_PRESSURE, D_CAPACITY, D_COOLING = range(31, 38)
NPAR = 38
I_LOAD, I_SPEED, I_OIL = range(3)
NINP = 3
# State: S_FILM is the film ratio (start of the next search, a state proper once the film moves).
S_STARTED, S_FILM, S_TEMPERATURE, S_ENERGY = range(4)  # ... at the last point of known power
S_SHOWN_TEMPERATURE, S_SHOWN_ENERGY, S_POWER, S_OIL, S_DURATION = range(4, 9)
NSTATE = 9
NWORK = 1
(
    O_TORQUE, O_TEMPERATURE, O_FILM, O_CAPACITY, O_COEFFICIENT, O_RATIO, O_POWER, O_ENERGY,
) = range(8)  # fmt: skip
NOUT = 8
IO_REGIME, IO_STATUS = range(2)
NIOUT = 2

CLOSED = 1  # fidelity
CONSTANT_LAW = 2  # friction_law
FILM, MIXED, BOUNDARY, ADHESIVE = range(1, 5)  # regimes
OK, HOT, NOT_FINITE, BAD_INPUT = 0, 2, 14, 15
HOT_LIMIT = 523.0  # K
OPEN_PRESSURE = 1e3  # Pa; a pack pressed less than this is open


@kernel
def derive(par: Array) -> int:
    """Fill the constants behind the parameters; return 0, or NOT_FINITE."""
    ri, ro = par[P_INNER_RADIUS], par[P_OUTER_RADIUS]
    par[D_AREA] = math.pi * (ro * ro - ri * ri)
    mean = 2.0 * (ro * ro * ro - ri * ri * ri) / (3.0 * (ro * ro - ri * ri))
    par[D_RADIUS] = par[P_EFFECTIVE_RADIUS] if par[P_EFFECTIVE_RADIUS] > 0.0 else mean
    x = par[P_INDENTATION]
    root = math.sqrt((1.0 - x) * (1.0 + x))
    par[D_PLOUGH] = par[P_PLOUGH_WEIGHT] * ploughing(x)
    par[D_ADHESION] = 4.0 / (math.pi * par[P_HARDNESS_RATIO]) / (1.0 + root)
    par[D_PRESSURE] = pressure_scale(
        par[P_ROUGHNESS], par[P_CONTACT_MODULUS], par[P_ASPERITY_DENSITY], par[P_ASPERITY_RADIUS]
    )
    half = 0.5 * par[P_STEEL_THICKNESS] * par[D_AREA]
    par[D_CAPACITY] = half * par[P_STEEL_DENSITY] * par[P_STEEL_HEAT_CAPACITY]
    par[D_COOLING] = par[P_HEAT_TRANSFER] * par[D_AREA]
    for i in range(N_PARAM, NPAR):
        if not math.isfinite(par[np.uintp(i)]):
            return NOT_FINITE
    return OK


@kernel
def shear_of(par: Array, slip: float) -> float:
    """Return the shear ratio s/s_m [-] at a slip [rad/s]."""
    return shear_ratio(
        slip * par[D_RADIUS], par[P_SHEAR_FLOOR], par[P_STICK_SPEED], par[P_DECAY_SPEED],
        par[P_KINK_WIDTH],
    )  # fmt: skip


@kernel
def coefficient_of(par: Array, slip: float) -> float:
    """Return the coefficient of friction [-] at a slip [rad/s]."""
    if par[P_FIDELITY] == CLOSED or par[P_FRICTION_LAW] == CONSTANT_LAW:
        return par[P_CONSTANT_FRICTION]
    return par[D_PLOUGH] + par[D_ADHESION] * shear_of(par, slip)


@kernel
def film_ratio_of(par: Array, load: float, guess: float) -> tuple[float, int, int]:
    """Return (settled film thickness over roughness [-], status, iterations) at a load [N]."""
    pressure = load / par[D_AREA]
    if pressure < OPEN_PRESSURE:
        return par[P_INITIAL_FILM] / par[P_ROUGHNESS], OK, 0
    u, status, n = separation(pressure / par[D_PRESSURE], guess)
    return min(u, par[P_INITIAL_FILM] / par[P_ROUGHNESS]), status, n


@kernel
def regime_of(par: Array, ratio: float, slip: float) -> int:
    """Return the stage of engagement: the film ratio names it, a full shear ratio is adhesion."""
    if ratio > 3.0:
        return FILM
    if ratio >= 1.0:
        return MIXED
    return ADHESIVE if abs(slip) * par[D_RADIUS] <= par[P_STICK_SPEED] else BOUNDARY


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
    """Advance the heat from t to t + dt with the present load and slip, then fill the outputs.

    Returns 0 or the status of a failure; HOT is advice and stands in ``iout`` only.
    """
    load, slip, oil = inp[I_LOAD], inp[I_SPEED], inp[I_OIL]
    if not (
        math.isfinite(load) and load >= 0.0 and math.isfinite(slip) and math.isfinite(oil)
        and dt >= 0.0 and oil > 0.0
    ):  # fmt: skip
        iout[IO_STATUS] = BAD_INPUT
        return BAD_INPUT
    started = state[S_STARTED] != 0.0
    ratio, status, _ = film_ratio_of(par, load, state[S_FILM] if started else 1.0)
    coefficient = coefficient_of(par, slip)
    capacity = par[P_FACES] * coefficient * load * par[D_RADIUS]
    torque = capacity * math.tanh(slip / par[P_SPEED_SMOOTHING])
    power = torque * slip

    temperature = state[S_SHOWN_TEMPERATURE] if started else oil
    energy = state[S_SHOWN_ENERGY]
    if dt > 0.0:
        exact_temperature, exact_energy = oil, 0.0
        if started:
            last = state[S_DURATION]
            exact_temperature = temperature_after(
                state[S_TEMPERATURE], state[S_OIL], par[D_CAPACITY], par[D_COOLING],
                state[S_POWER] / par[P_FACES], power / par[P_FACES], last,
            )  # fmt: skip
            exact_energy = state[S_ENERGY] + 0.5 * (state[S_POWER] + power) * last
        temperature = temperature_after(
            exact_temperature, oil, par[D_CAPACITY], par[D_COOLING],
            power / par[P_FACES], power / par[P_FACES], dt,
        )  # fmt: skip
        # Heat does not come back: where the advance was too large the output waits.
        energy = max(state[S_SHOWN_ENERGY], exact_energy + power * dt)
        if status == OK and math.isfinite(temperature) and math.isfinite(energy):
            state[S_STARTED] = 1.0
            state[S_FILM] = ratio
            state[S_TEMPERATURE], state[S_ENERGY] = exact_temperature, exact_energy
            state[S_SHOWN_TEMPERATURE], state[S_SHOWN_ENERGY] = temperature, energy
            state[S_POWER], state[S_OIL], state[S_DURATION] = power, oil, dt

    out[O_TORQUE], out[O_TEMPERATURE] = torque, temperature
    out[O_FILM], out[O_CAPACITY] = ratio * par[P_ROUGHNESS], capacity
    out[O_COEFFICIENT], out[O_RATIO] = coefficient, ratio
    out[O_POWER], out[O_ENERGY] = power, energy
    iout[IO_REGIME] = regime_of(par, ratio, slip)
    if status == OK:
        for i in range(NOUT):
            if not math.isfinite(out[np.uintp(i)]):
                status = NOT_FINITE
    iout[IO_STATUS] = HOT if status == OK and temperature > HOT_LIMIT else status
    return status
