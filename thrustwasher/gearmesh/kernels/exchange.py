# mypy: disable-error-code="no-any-return"
"""The gear mesh for model exchange: heat in the bodies, and a bristle whose capacity is the loss.

``speed_smoothing`` has no part: how the torque passes through zero is the bristle's.
"""

import math

from ...numerics.arrays import are_finite, clear, copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.status import BAD_INPUT, NOT_FINITE, OK
from ...tribology.bristle import (
    Bristle,
    bristle,
    bristle_changes,
    bristle_heat,
    bristle_of,
    first_bend,
)
from . import layout as L
from .load_sharing import shared
from .mesh_point import COLDEST, HOT_FILM, HOTTEST_ASPERITY, ULTIMATE, WARMEST
from .step import changes_along, regime_of, solve_risen

NPAR, NINP, NWORK, NOUT, NIOUT = L.NPAR, L.NINP, L.NWORK, L.NOUT, L.NIOUT
X_BODY, X_BEND, X_ENERGY, NCONT = range(4)
A_ANGLE, A_DAMPING, A_SPEED, A_LARGEST, NOWN = range(5)
# What is discrete: time of the next event [s], largest capacity [N m], bodies at the start [K].
D_NEXT, D_LARGEST, D_FIRST, NMODE = range(4)
Z_MIXED, Z_BOUNDARY, Z_HOT, Z_OUTSIDE, NSIGN = range(5)
NEVER = 1.7976931348623157e308
LEAST = 1e-3  # N m, the least that counts as largest
USUAL_SAFETY = 3.0  # against pitting: of the largest capacity
MIXED_FROM, BOUNDARY_FROM = 3.0, 1.0  # film ratios of the regimes


@kernel
def stores_heat(par: Array) -> bool:
    """Tell if the temperature of the bodies is a state."""
    return par[L.P_FILM_HEAT] == L.LOSS and par[L.P_THERMAL_MODE] != L.QUASI_STEADY


@kernel
def way_of(speed: float) -> float:
    """Return the sign of a speed, 1 at rest."""
    return -1.0 if speed < 0.0 else 1.0


@kernel
def solved(par: Array, inp: Array, body: float, work: Array) -> int:
    """Fill ``work`` with the sliding mesh, bodies at ``body`` [K], 0: as at the start."""
    load, speed = inp[L.I_LOAD], inp[L.I_SPEED]
    if not (are_finite(inp) and inp[L.I_OIL] > 0.0 and math.isfinite(body) and body >= 0.0):
        return BAD_INPUT
    state = work[L.W_STATE : L.W_STATE + L.NSTATE]
    clear(state)
    if body > 0.0:
        state[L.S_STARTED], state[L.S_BULK] = 1.0, body
    here = shared(par, load, work)
    work[L.W_WIDTH] = 1.0  # all friction has risen: no slope over it
    return solve_risen(here, load, speed, inp[L.I_OIL], way_of(speed), state, 0.0, work)


@kernel
def capacity_of(work: Array) -> float:
    """Return the torque of sliding [N m >= 0] of ``solved``."""
    return max(work[L.F_TORQUE] * work[L.F_SMOOTH_SIGN], 0.0)


@kernel
def bristle_of_mesh(own: Array, discrete: Array) -> Bristle:
    """Return the bristle."""
    return bristle_of(discrete[D_LARGEST], own[A_ANGLE], own[A_SPEED], own[A_DAMPING])


@kernel
def largest_of(par: Array, oil: float, work: Array) -> float:
    """Return the friction [N m] at rest under the load of USUAL_SAFETY."""
    usual = work[L.W_STATE + L.NSTATE : L.W_STATE + L.NSTATE + NINP]
    used = USUAL_SAFETY * par[L.D_PITTING_USED]
    usual[L.I_LOAD], usual[L.I_SPEED], usual[L.I_OIL] = (
        1.0 / (used * used * par[L.D_LOAD]),
        0.0,
        oil,
    )
    status = solved(par, usual, 0.0, work)
    return max(capacity_of(work), LEAST) if status < 10 else LEAST


@kernel
def start(
    par: Array, own: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Fill the states at the start, bodies as ``thermal_start`` says; return a status."""
    clear(cont)
    discrete[D_NEXT], discrete[D_LARGEST] = NEVER, own[A_LARGEST]
    if not (are_finite(inp) and inp[L.I_OIL] > 0.0):
        return BAD_INPUT
    if own[A_LARGEST] == 0.0:
        discrete[D_LARGEST] = largest_of(par, inp[L.I_OIL], work)
    status = solved(par, inp, 0.0, work)
    if status >= 10:
        return status
    cont[X_BODY] = discrete[D_FIRST] = work[L.F_BULK]
    b = bristle_of_mesh(own, discrete)
    cont[X_BEND] = first_bend(b, capacity_of(work), inp[L.I_SPEED])
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
    """Fill outputs, rates of the states, event indicators; return 0 or the status of a failure."""
    clear(der)
    status = solved(par, inp, cont[X_BODY], work)
    if status >= 10:
        return status
    slip, bend, b = inp[L.I_SPEED], cont[X_BEND], bristle_of_mesh(own, discrete)
    copy(work, out)
    torque, der[X_BEND] = bristle(b, capacity_of(work), slip, bend)
    heat = bristle_heat(b, torque, slip, bend, der[X_BEND])
    out[L.F_TORQUE], out[L.F_POWER] = torque, heat
    out[L.F_OIL_ENERGY], out[L.F_STORED] = cont[X_ENERGY], 0.0
    if stores_heat(par):
        der[X_BODY] = (heat - out[L.F_OIL_HEAT]) / par[L.D_BULK_CAPACITY]
        out[L.F_STORED] = par[L.D_BULK_CAPACITY] * (cont[X_BODY] - discrete[D_FIRST])
    else:
        out[L.F_OIL_HEAT] = heat
    der[X_ENERGY] = out[L.F_OIL_HEAT]
    sign[Z_MIXED], sign[Z_BOUNDARY] = out[L.F_RATIO] - MIXED_FROM, out[L.F_RATIO] - BOUNDARY_FROM
    sign[Z_HOT] = (HOT_FILM - out[L.F_FILM_TEMPERATURE]) / HOT_FILM
    sign[Z_OUTSIDE] = room_of(par, inp[L.I_OIL], work)
    return OK if are_finite(out) and are_finite(der) else NOT_FINITE


@kernel
def room_of(par: Array, oil: float, work: Array) -> float:
    """Return how far the point is from where the laws are stretched; negative there."""
    hard = par[L.P_HARDNESS_FACTOR]
    hard *= ULTIMATE[0] if par[L.P_STEEL] == L.AISI1020 else ULTIMATE[1]
    room = min(oil - COLDEST, WARMEST - oil) / WARMEST
    room = min(room, (HOTTEST_ASPERITY - work[L.F_ASPERITY]) / HOTTEST_ASPERITY)
    return min(room, (hard - work[L.F_PRESSURE]) / hard)


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
    """Fill what is discrete, regime and status; return 0 or the status of a failure."""
    status = solved(par, inp, cont[X_BODY], work)
    if status >= 10:
        return status
    discrete[D_NEXT] = NEVER
    iout[L.IO_REGIME], iout[L.IO_STATUS] = regime_of(work[L.F_RATIO]), status
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
    status = solved(par, inp, cont[X_BODY], work)
    if status >= 10:
        return status
    slip, bend, warms = inp[L.I_SPEED], cont[X_BEND], along[NINP + X_BODY]
    changes_along(par, inp, work, along[:NINP], warms, found[:NOUT])
    b, capacity = bristle_of_mesh(own, discrete), capacity_of(work)
    change = (
        found[L.F_TORQUE] * work[L.F_SMOOTH_SIGN],
        along[L.I_SPEED],
        along[NINP + X_BEND],
    )
    _, torques, turns, heats = bristle_changes(b, capacity, slip, bend, change, (0.0, 0.0))
    found[L.F_TORQUE], found[L.F_POWER], found[NOUT + X_BEND] = torques, heats, turns
    found[L.F_OIL_ENERGY], found[L.F_STORED] = along[NINP + X_ENERGY], 0.0
    if stores_heat(par):
        stored = par[L.D_BULK_CAPACITY]
        found[NOUT + X_BODY] = (heats - found[L.F_OIL_HEAT]) / stored
        found[L.F_STORED] = stored * warms
    else:
        found[L.F_OIL_HEAT] = heats
    found[NOUT + X_ENERGY] = found[L.F_OIL_HEAT]
    return OK if are_finite(found) else NOT_FINITE
