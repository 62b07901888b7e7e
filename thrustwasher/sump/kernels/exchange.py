"""The oil sump for model exchange: rates of its temperature and of the heats since the start.

Heat comes as a power alone: what an energy has grown by would be its rate, which nobody gives.
"""

import math

import numpy as np

from ...numerics.arrays import are_finite, clear
from ...numerics.jit import Array, Ints, kernel
from ...numerics.status import BAD_INPUT, OK
from .step import (
    D_CAPACITY,
    D_HEAT,
    I_AMBIENT,
    I_COOLER,
    I_ENERGY,
    I_FLOW,
    O_AMBIENT,
    O_COOLER,
    O_RECEIVED,
    O_STORED,
    O_TEMPERATURE,
    P_CONDUCTANCE,
    P_FACTOR,
    P_INITIAL_TEMPERATURE,
    PORTS,
)
from .step import NINP as NINP
from .step import NIOUT as NIOUT
from .step import NOUT as NOUT
from .step import NPAR as NPAR
from .step import NWORK as NWORK

X_TEMPERATURE, X_RECEIVED, X_AMBIENT, X_COOLER, NCONT = range(5)
NEVER = 1.7976931348623157e308  # s, the time of an event that does not come
NOWN, NMODE, NSIGN = 0, 1, 1


@kernel
def start(
    par: Array, own: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Fill the states at the start; return 0."""
    clear(cont)
    cont[X_TEMPERATURE] = par[P_INITIAL_TEMPERATURE]
    discrete[0] = NEVER
    return OK


@kernel
def flows(par: Array, inp: Array, cont: Array) -> tuple[float, float, float]:
    """Return the heat flows [W] from the parts, to the surroundings, to the cooler."""
    received = 0.0
    for i in range(PORTS):
        received += par[np.uintp(P_FACTOR + i)] * inp[np.uintp(i)]
    ambient = par[P_CONDUCTANCE] * (cont[X_TEMPERATURE] - inp[I_AMBIENT])
    cooler = par[D_HEAT] * inp[I_FLOW] * (cont[X_TEMPERATURE] - inp[I_COOLER])
    return received, ambient, cooler


@kernel
def rates(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    out: Array,
    der: Array,
    sign: Array,
) -> int:
    """Fill outputs, rates of the states, the event indicator; return 0 or BAD_INPUT."""
    good = are_finite(inp) and are_finite(cont) and inp[I_FLOW] >= 0.0
    for i in range(PORTS):
        good = good and inp[np.uintp(I_ENERGY + i)] == 0.0
    if not good:
        return BAD_INPUT
    received, ambient, cooler = flows(par, inp, cont)
    der[X_TEMPERATURE] = (received - ambient - cooler) / par[D_CAPACITY]
    der[X_RECEIVED], der[X_AMBIENT], der[X_COOLER] = received, ambient, cooler
    out[O_TEMPERATURE], out[O_RECEIVED] = cont[X_TEMPERATURE], cont[X_RECEIVED]
    out[O_AMBIENT], out[O_COOLER] = cont[X_AMBIENT], cont[X_COOLER]
    out[O_STORED] = par[D_CAPACITY] * (cont[X_TEMPERATURE] - par[P_INITIAL_TEMPERATURE])
    sign[0] = 1.0
    return OK


@kernel
def update(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    out: Array,
    iout: Ints,
    t: float,
) -> int:
    """Fill what is discrete; return 0, or NOT_FINITE."""
    discrete[0] = NEVER
    iout[0] = OK
    return OK if math.isfinite(t) else BAD_INPUT


@kernel
def slopes(
    par: Array,
    own: Array,
    inp: Array,
    cont: Array,
    discrete: Array,
    work: Array,
    along: Array,
    found: Array,
) -> int:
    """Fill ``found``, changes of outputs and rates, with changes of inputs and states ``along``."""
    clear(found)
    warmer, received = along[NINP + X_TEMPERATURE], 0.0
    for i in range(PORTS):
        received += par[np.uintp(P_FACTOR + i)] * along[np.uintp(i)]
    cooling = par[D_HEAT] * inp[I_FLOW]
    ambient = par[P_CONDUCTANCE] * (warmer - along[I_AMBIENT])
    cooler = cooling * (warmer - along[I_COOLER])
    cooler += par[D_HEAT] * along[I_FLOW] * (cont[X_TEMPERATURE] - inp[I_COOLER])
    found[O_TEMPERATURE], found[O_STORED] = warmer, par[D_CAPACITY] * warmer
    found[O_RECEIVED] = along[NINP + X_RECEIVED]
    found[O_AMBIENT], found[O_COOLER] = along[NINP + X_AMBIENT], along[NINP + X_COOLER]
    found[NOUT + X_TEMPERATURE] = (received - ambient - cooler) / par[D_CAPACITY]
    found[NOUT + X_RECEIVED], found[NOUT + X_AMBIENT] = received, ambient
    found[NOUT + X_COOLER] = cooler
    return OK
