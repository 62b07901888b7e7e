# mypy: disable-error-code="no-any-return"
"""The driveline losses for model exchange: on each shaft a bristle, whose capacity are its losses.

``speed_smoothing`` has no part in where torques pass through zero: that is the bristle's.
"""

import math

import numpy as np

from ...numerics.arrays import are_finite, clear
from ...numerics.jit import Array, Ints, kernel
from ...numerics.status import BAD_INPUT, NOT_FINITE, OK, OUTSIDE_VERIFIED
from ...tribology.bristle import (
    Bristle,
    bristle,
    bristle_changes,
    bristle_heat,
    bristle_of,
    first_bend,
)
from .loss_laws import CRITICAL_RE, GAMMA, GAMMA_WIDTH
from .step import (
    A_IMMERSION,
    COLDEST,
    D_AREA,
    D_CUBE,
    HOTTEST,
    I_FORCE,
    I_OIL,
    O_BEARING,
    O_CHURNING,
    O_ENERGY,
    O_HEAT,
    O_PUMP,
    O_SEAL,
    P_PLANETS,
    P_SHAFT,
    PLANET,
    ROW,
    SHAFTS,
    SOURCES,
    SPEEDS,
    W_BY_FORCE,
    W_BY_OIL,
    W_BY_SPEED,
    W_TORQUE,
    classed,
    oil_viscosity,
    resist,
)
from .step import NINP as NINP
from .step import NIOUT as NIOUT
from .step import NOUT as NOUT
from .step import NPAR as NPAR
from .step import NWORK as NWORK

X_ENERGY, NCONT = SPEEDS, SPEEDS + 1  # behind the bendings
A_ANGLE, A_DAMPING, A_SPEED, NOWN = range(4)
# behind the time of the next event: the largest capacity of each speed [N m], inputs it is of
D_LARGEST, D_USUAL = 1, 1 + SPEEDS
NMODE, NSIGN = D_USUAL + NINP, SHAFTS + 1
NEVER = 1.7976931348623157e308  # s, the time of an event that does not come
USUAL_SPEED, USUAL_FORCE, USUAL_OIL = 100.0, 2000.0, 313.15  # rad/s, N, K: of the largest capacity
LEAST = 1e-3  # N m, the least that counts as largest


@kernel
def of_speed(own: Array, discrete: Array, i: int) -> Bristle:
    """Return the bristle of a speed."""
    largest = discrete[np.uintp(D_LARGEST + i)]
    return bristle_of(largest, own[A_ANGLE], own[A_SPEED], own[A_DAMPING])


@kernel
def capacity_of(work: Array, i: int) -> float:
    """Return the torque of all sources at a speed [N m], of ``resist`` with sizes."""
    total = 0.0
    for k in range(SOURCES):
        total += work[np.uintp(W_TORQUE + i * SOURCES + k)]
    return max(total, 0.0)


@kernel
def share_of(work: Array, i: int, k: int, capacity: float) -> float:
    """Return the share of a source in the capacity of a speed."""
    if capacity > 0.0:
        return work[np.uintp(W_TORQUE + i * SOURCES + k)] / capacity
    return 1.0 if k == 0 else 0.0


@kernel
def start(
    par: Array, own: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Fill the states at the start and the largest capacities; return 0 or BAD_INPUT."""
    if not (are_finite(inp) and inp[I_OIL] > 0.0):
        return BAD_INPUT
    clear(cont)
    discrete[0] = NEVER
    usual = discrete[D_USUAL : D_USUAL + NINP]
    for i in range(SPEEDS):
        usual[np.uintp(i)] = USUAL_SPEED
    usual[I_FORCE], usual[I_OIL] = USUAL_FORCE, USUAL_OIL
    resist(par, usual, work, True)
    for i in range(SPEEDS):
        discrete[np.uintp(D_LARGEST + i)] = max(capacity_of(work, i), LEAST)
    resist(par, inp, work, True)
    for i in range(SPEEDS):
        b = of_speed(own, discrete, i)
        cont[np.uintp(i)] = first_bend(b, capacity_of(work, i), inp[np.uintp(i)])
    return OK if are_finite(discrete) and are_finite(cont) else NOT_FINITE


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
    """Fill outputs, rates of the states, the event indicator; return 0, BAD_INPUT or NOT_FINITE.

    A source's power is the heat of its share in the bristle: work that is not stored.
    """
    if not (are_finite(inp) and are_finite(cont) and inp[I_OIL] > 0.0):
        return BAD_INPUT
    resist(par, inp, work, True)
    clear(out)
    for i in range(SPEEDS):
        slip, bend, b = inp[np.uintp(i)], cont[np.uintp(i)], of_speed(own, discrete, i)
        capacity = capacity_of(work, i)
        torque, rate = bristle(b, capacity, slip, bend)
        heat = bristle_heat(b, torque, slip, bend, rate)
        if i == PLANET:
            heat *= par[P_PLANETS]
        out[np.uintp(i)], der[np.uintp(i)] = torque, rate
        for k in range(SOURCES):
            out[np.uintp(O_BEARING + k)] += heat * share_of(work, i, k, capacity)
    out[O_HEAT] = out[O_BEARING] + out[O_CHURNING] + out[O_PUMP] + out[O_SEAL]
    out[O_ENERGY], der[X_ENERGY] = cont[X_ENERGY], out[O_HEAT]
    nu, _ = oil_viscosity(par, inp[I_OIL])
    for i in range(SHAFTS):
        sign[np.uintp(i)] = regime_sign(par, inp[np.uintp(i)], nu, i)
    sign[SHAFTS] = (inp[I_OIL] - COLDEST) * (HOTTEST - inp[I_OIL]) / (HOTTEST - COLDEST) ** 2
    return OK if are_finite(out) and are_finite(der) else NOT_FINITE


@kernel
def regime_sign(par: Array, speed: float, nu: float, i: int) -> float:
    """Return a number that passes zero where the gear of a shaft gets into another regime."""
    if par[np.uintp(P_SHAFT + i * ROW + A_IMMERSION)] <= 0.0:
        return 1.0
    reynolds = abs(speed) * par[np.uintp(D_AREA + i)] / nu / CRITICAL_RE
    gamma = speed * speed * par[np.uintp(D_CUBE + i)] / GAMMA
    parts = (reynolds - 1.0) / (reynolds + 1.0) * (gamma - 1.0) / (gamma + 1.0)
    return parts * (gamma - 1.0 - GAMMA_WIDTH / GAMMA) / (gamma + 1.0)


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
    """Fill what is discrete, regimes and status; return 0 or BAD_INPUT."""
    if not (are_finite(inp) and inp[I_OIL] > 0.0 and math.isfinite(t)):
        return BAD_INPUT
    discrete[0] = NEVER
    outside = classed(par, inp, iout)
    inside = COLDEST <= inp[I_OIL] <= HOTTEST and not outside
    iout[SHAFTS] = OK if inside else OUTSIDE_VERIFIED
    return OK


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
    resist(par, inp, work, True)
    for i in range(SPEEDS):
        slip, bend, b = inp[np.uintp(i)], cont[np.uintp(i)], of_speed(own, discrete, i)
        faster, bends = along[np.uintp(i)], along[np.uintp(NINP + i)]
        capacity, grows = capacity_of(work, i), 0.0
        for k in range(SOURCES):
            grows += _grown(work, along, i, k)
        heat, torques, turns, heats = bristle_changes(
            b, capacity, slip, bend, (grows, faster, bends), (0.0, 0.0)
        )
        if i == PLANET:
            heat, heats = heat * par[P_PLANETS], heats * par[P_PLANETS]
        found[np.uintp(i)], found[np.uintp(NOUT + i)] = torques, turns
        for k in range(SOURCES):
            share = share_of(work, i, k, capacity)
            found[np.uintp(O_BEARING + k)] += heats * share
            if capacity > 0.0:
                shares = (_grown(work, along, i, k) - share * grows) / capacity
                found[np.uintp(O_BEARING + k)] += heat * shares
    found[O_HEAT] = found[O_BEARING] + found[O_CHURNING] + found[O_PUMP] + found[O_SEAL]
    found[O_ENERGY], found[NOUT + X_ENERGY] = along[NINP + X_ENERGY], found[O_HEAT]
    return OK if are_finite(found) else NOT_FINITE


@kernel
def _grown(work: Array, along: Array, i: int, k: int) -> float:
    """Return how the torque of a source grows with changes of the inputs."""
    at = i * SOURCES + k
    change = work[np.uintp(W_BY_SPEED + at)] * along[np.uintp(i)]
    change += work[np.uintp(W_BY_OIL + at)] * along[I_OIL]
    if i == PLANET and k == 0:
        change += work[W_BY_FORCE] * along[I_FORCE]
    return change
