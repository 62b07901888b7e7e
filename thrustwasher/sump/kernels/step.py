"""One step of the oil sump: the exact solution for constant heat.

C T' = sum n_i Q_i - G (T - T_ambient) - rho c V_c (T - T_cooler), inputs held over the step.

A kind of part sends its heat Q_i as a power [W], or as an energy [J] since the start: then what the
energy has grown by since the last step flows in evenly over this one.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ...numerics.jit import Array, kernel
from ...numerics.status import BAD_INPUT, NOT_FINITE, OK

PORTS = 7
# places: P_ of parameters
P_VOLUME, P_OIL_DENSITY, P_OIL_HEAT_CAPACITY, P_HOUSING_CAPACITY, P_CONDUCTANCE = range(0, 5)
P_INITIAL_TEMPERATURE, P_FACTOR_1 = range(5, 7)
P_FIDELITY, N_PARAM = range(13, 15)
# end of places
P_FACTOR = P_FACTOR_1  # as many as ports
D_HEAT, D_CAPACITY = N_PARAM, N_PARAM + 1  # of a volume of oil [J/(m3 K)]; of the sump [J/K]
NPAR = N_PARAM + 2
I_AMBIENT, I_FLOW, I_COOLER, I_ENERGY = range(PORTS, PORTS + 4)
NINP = I_ENERGY + PORTS
S_STARTED, S_WARMED, S_RECEIVED, S_AMBIENT, S_COOLER, S_ENERGY = range(6)  # the last: taken in [J]
NSTATE = S_ENERGY + PORTS
NWORK = 1
O_TEMPERATURE, O_RECEIVED, O_STORED, O_AMBIENT, O_COOLER, NOUT = range(6)
NIOUT = 1


@kernel
def derive(par: Array) -> int:
    """Fill in both heat capacities; return 0, or NOT_FINITE."""
    par[D_HEAT] = par[P_OIL_DENSITY] * par[P_OIL_HEAT_CAPACITY]
    par[D_CAPACITY] = par[D_HEAT] * par[P_VOLUME] + par[P_HOUSING_CAPACITY]
    return OK if math.isfinite(par[D_CAPACITY]) else NOT_FINITE


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` with zeros: no output follows an input at once."""
    for i in range(NOUT):
        dout[np.uintp(i)] = 0.0
    return OK


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
    """Advance the sump by ``dt`` and fill the outputs; return 0 or the status of a failure."""
    good = math.isfinite(dt) and dt >= 0.0 and inp[I_FLOW] >= 0.0
    for i in range(NINP):
        good = good and math.isfinite(inp[np.uintp(i)])
    for i in range(PORTS):  # the same heat must not count twice
        good = good and (inp[np.uintp(i)] == 0.0 or inp[np.uintp(I_ENERGY + i)] == 0.0)
    if not good:
        iout[0] = BAD_INPUT
        return BAD_INPUT
    heat, sent = 0.0, 0.0  # held [W]; grown by since the last step [J]
    for i in range(PORTS):
        heat += par[np.uintp(P_FACTOR + i)] * inp[np.uintp(i)]
        more = inp[np.uintp(I_ENERGY + i)] - state[np.uintp(S_ENERGY + i)]
        sent += par[np.uintp(P_FACTOR + i)] * more
    received = heat * dt
    if dt > 0.0:
        received += sent
        heat += sent / dt
    start, warmed = par[P_INITIAL_TEMPERATURE], state[S_WARMED]
    ambient, cooler = par[P_CONDUCTANCE], par[D_HEAT] * inp[I_FLOW]
    above, over = start + warmed - inp[I_AMBIENT], start + warmed - inp[I_COOLER]
    rate = (heat - ambient * above - cooler * over) / par[D_CAPACITY]
    decay = (ambient + cooler) / par[D_CAPACITY]
    reach, mean = dt, 0.0  # the rise is rate * reach; its integral rate * mean
    if decay > 0.0:
        reach = -math.expm1(-decay * dt) / decay
        mean = (dt - reach) / decay
    out[O_TEMPERATURE] = start + (warmed + rate * reach)
    out[O_RECEIVED] = state[S_RECEIVED] + received
    out[O_STORED] = par[D_CAPACITY] * (warmed + rate * reach)
    out[O_AMBIENT] = state[S_AMBIENT] + ambient * (above * dt + rate * mean)
    out[O_COOLER] = state[S_COOLER] + cooler * (over * dt + rate * mean)
    status = OK
    for i in range(NOUT):
        if not math.isfinite(out[np.uintp(i)]):
            status = NOT_FINITE
    if status == OK and dt > 0.0:
        state[S_STARTED], state[S_WARMED] = 1.0, warmed + rate * reach
        state[S_RECEIVED], state[S_AMBIENT] = out[O_RECEIVED], out[O_AMBIENT]
        state[S_COOLER] = out[O_COOLER]
        for i in range(PORTS):
            state[np.uintp(S_ENERGY + i)] = inp[np.uintp(I_ENERGY + i)]
    iout[0] = status
    return status
