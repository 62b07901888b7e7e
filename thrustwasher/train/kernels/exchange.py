# mypy: disable-error-code="no-any-return"
"""The gear train for model exchange: heat in its meshes, and one bristle at the input for rest.

The bristle says which share of the friction acts everywhere at once, from -1 to 1 in sliding. Its
capacity C is that of the shares' own forces; its bending in sliding follows from an estimate C_0
that no share acts on: torque, rate and heat are those of a bristle of C_0, times C/C_0. The chain
is solved from nothing each time: what was tried before leaves no trace.
"""

import math

import numpy as np

from ...gearmesh.kernels import layout as G
from ...gearmesh.kernels.exchange import USUAL_SAFETY, stores_heat
from ...gearmesh.kernels.mesh_point import HOT_FILM
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
from .chain import fill_loads, fill_losses, march, shaft_loss, solve_chain
from .step import efficiency, fill_advice, fill_told, ratio_of

NPAR, NINP, NWORK, NOUT, NIOUT = L.NPAR, L.NINP, L.NWORK, L.NOUT, L.NIOUT
X_BODY, X_BEND, X_ENERGY, NCONT = 0, L.MESHES, L.MESHES + 1, L.MESHES + 2
A_ANGLE, A_DAMPING, A_SPEED, A_LARGEST, NOWN = range(5)
D_NEXT, D_LARGEST, NMODE = range(3)  # time of the next event [s], largest capacity [N m]
Z_MIXED, Z_BOUNDARY, Z_HOT, Z_OUTSIDE, Z_ROW = range(5)  # of each mesh
NSIGN = L.MESHES * Z_ROW
NEVER = 1.7976931348623157e308
LEAST = 1e-3  # N m, the least that counts as largest
MIXED_FROM, BOUNDARY_FROM = 3.0, 1.0  # film ratios of the regimes
LEAST_SHARE = 1e-9  # of the friction that the chain is solved with
# What is told: the outputs, with shares of the friction in place of losses; capacity, heat from the
# bodies of each mesh to the oil.
T_CAPACITY, T_COOLED = NOUT, NOUT + 1
DIFFERENCE = 1e-3  # of the sizes, of a difference of fourth order
SIZE_TORQUE, SIZE_SPEED, SIZE_HEAT = 1e-2, 1e-3, 10.0  # N m, rad/s, K


@kernel
def way_of(speed: float) -> float:
    """Return the sign of a speed, 1 at rest."""
    return -1.0 if speed < 0.0 else 1.0


@kernel
def memory_of(par: Array, point: Array, work: Array) -> Array:
    """Return the pairs' own memory with bodies as at a point, inputs and temperatures; 0: first."""
    state = work[L.W_STATE : L.W_STATE + L.MESHES * G.NSTATE]
    clear(state)
    for i in range(int(par[L.P_MESHES])):
        if point[np.uintp(NINP + i)] > 0.0:
            state[np.uintp(i * G.NSTATE + G.S_STARTED)] = 1.0
            state[np.uintp(i * G.NSTATE + G.S_BULK)] = point[np.uintp(NINP + i)]
    return state


@kernel
def friction_of(par: Array, work: Array) -> float:
    """Return the sum of the sizes of all friction in ``work``, at the input [N m]."""
    total, turn, meshes = 0.0, 1.0, int(par[L.P_MESHES])
    for i in range(meshes + 1):
        size = abs(shaft_loss(work, i))
        if i < meshes:
            size += abs(work[np.uintp(L.W_FRICTION + i)])
        total += size * turn
        if i < meshes:
            turn /= par[np.uintp(L.D_MESH + i * L.E_ROW + L.E_RATIO)]
    return total


@kernel
def estimate(par: Array, point: Array, work: Array) -> tuple[float, int]:
    """Return the friction [N m] under forces without losses of shafts, and a status."""
    for k in range(L.SHAFTS * L.LOSSES):
        work[np.uintp(L.W_LOSS + k)] = 0.0
    state, rise = memory_of(par, point, work), (0.0, 1.0)
    status = march(par, point, rise, state, work, 0.0)
    if status >= 10:
        return 0.0, status
    fill_loads(par, work)
    fill_losses(par, point[L.I_OIL], rise, work, 1.0)
    return friction_of(par, work), OK


@kernel
def tell(par: Array, point: Array, share: float, work: Array, told: Array) -> int:
    """Solve the chain with a share of the friction and fill ``told``; return OK or a failure."""
    acts = share if abs(share) > LEAST_SHARE else math.copysign(LEAST_SHARE, share)
    status = solve_chain(par, point, (0.0, acts), memory_of(par, point, work), work, 0.0)
    if status >= 10:
        return status
    clear(told)
    fill_told(par, work, told[:NOUT])
    total, turn, meshes = friction_of(par, work), 1.0, int(par[L.P_MESHES])
    told[T_CAPACITY] = total / abs(acts)
    each = turn / total if total > 0.0 else 0.0
    for i in range(meshes + 1):
        if i < meshes:
            own = each * abs(work[np.uintp(L.W_FRICTION + i)])
            if not total > 0.0 and i == 0:
                own = 1.0
            told[np.uintp(L.O_MESH + i * L.M_ROW + L.M_LOSS)] = own
            pair = L.W_OUT + i * G.NOUT
            told[np.uintp(T_COOLED + i)] = work[np.uintp(pair + G.F_OIL_HEAT)]
        loss = L.W_LOSS + i * L.LOSSES
        for k in range(L.ENDS):
            row = L.O_BEARING + (i * L.ENDS + k) * L.R_ROW
            told[np.uintp(row + L.R_LOSS)] = each * abs(work[np.uintp(loss + k)])
        if i == 0:
            told[L.O_SEAL_LOSS] = told[L.O_CHURNING_LOSS] = 0.0
        told[L.O_SEAL_LOSS] += each * abs(work[np.uintp(loss + L.ENDS)])
        told[L.O_CHURNING_LOSS] += each * abs(work[np.uintp(loss + L.ENDS + 1)])
        if i < meshes:
            each /= par[np.uintp(L.D_MESH + i * L.E_ROW + L.E_RATIO)]
    return OK


@kernel
def pair_of(par: Array, mesh: int) -> Array:
    """Return the parameters of a pair."""
    return par[L.D_PAIR + mesh * G.NPAR : L.D_PAIR + (mesh + 1) * G.NPAR]


@kernel
def fill_powers(
    par: Array,
    told: Array,
    change: Array,
    heat: float,
    heats: float,
    out: Array,
    der: Array,
) -> None:
    """Fill losses and rates of the bodies: the change of told x heat, x heats for the other factor.

    With ``change`` = ``told`` and ``heats`` = 0 these are the values themselves.
    """
    meshes = int(par[L.P_MESHES])
    out[L.O_MESH_LOSS] = out[L.O_BEARING_LOSS] = out[L.O_HEAT] = 0.0
    for i in range(meshes + 1):
        if i < meshes:
            row, pair = L.O_MESH + i * L.M_ROW + L.M_LOSS, pair_of(par, i)
            own = change[np.uintp(row)] * heat + told[np.uintp(row)] * heats
            out[np.uintp(row)] = own
            out[L.O_MESH_LOSS] += own
            if stores_heat(pair):
                cooled = change[np.uintp(T_COOLED + i)]
                der[np.uintp(X_BODY + i)] = (own - cooled) / pair[G.D_BULK_CAPACITY]
                out[L.O_HEAT] += cooled
            else:
                out[L.O_HEAT] += own
        for k in range(L.ENDS):
            row = L.O_BEARING + (i * L.ENDS + k) * L.R_ROW + L.R_LOSS
            own = change[np.uintp(row)] * heat + told[np.uintp(row)] * heats
            out[np.uintp(row)] = own
            out[L.O_BEARING_LOSS] += own
    for k in range(L.O_SEAL_LOSS, L.O_CHURNING_LOSS + 1):
        out[np.uintp(k)] = change[np.uintp(k)] * heat + told[np.uintp(k)] * heats
    rest = out[L.O_BEARING_LOSS] + out[L.O_SEAL_LOSS] + out[L.O_CHURNING_LOSS]
    out[L.O_HEAT] += rest
    der[X_ENERGY] = out[L.O_HEAT]


@kernel
def put_point(inp: Array, cont: Array, point: Array) -> bool:
    """Fill a point from inputs and temperatures of the bodies; tell if it is one."""
    for k in range(NINP):
        point[np.uintp(k)] = inp[np.uintp(k)]
    for i in range(L.MESHES):
        point[np.uintp(NINP + i)] = cont[np.uintp(X_BODY + i)]
    return are_finite(point) and inp[L.I_OIL] > 0.0


@kernel
def bristle_of_train(own: Array, discrete: Array) -> Bristle:
    """Return the bristle."""
    return bristle_of(discrete[D_LARGEST], own[A_ANGLE], own[A_SPEED], own[A_DAMPING])


@kernel
def largest_of(par: Array, point: Array, work: Array) -> float:
    """Return the friction [N m] at rest, the worst mesh under the load of USUAL_SAFETY."""
    torque, factor = 1e300, 1.0
    for i in range(int(par[L.P_MESHES])):
        pair, row = pair_of(par, i), L.D_MESH + i * L.E_ROW + L.E_RATIO
        used = USUAL_SAFETY * pair[G.D_PITTING_USED]
        ratio = par[np.uintp(row)]
        drives = par[np.uintp(L.P_MESH + i * L.MESH_ROW + L.A_DRIVER)] == L.PINION
        pinion = factor if drives else factor * ratio
        torque = min(torque, 1.0 / (used * used * pair[G.D_LOAD] * pinion))
        factor *= ratio
    given, speed = point[L.I_TORQUE], point[L.I_SPEED]
    point[L.I_TORQUE], point[L.I_SPEED] = torque, 0.0
    found, status = estimate(par, point, work)
    point[L.I_TORQUE], point[L.I_SPEED] = given, speed
    return max(found, LEAST) if status < 10 else LEAST


@kernel
def start(
    par: Array, own: Array, inp: Array, cont: Array, discrete: Array, work: Array, t: float
) -> int:
    """Fill the states at the start, bodies as ``thermal_start`` says; return a status."""
    clear(cont)
    discrete[D_NEXT], discrete[D_LARGEST] = NEVER, own[A_LARGEST]
    point = work[L.W_POINT : L.W_POINT + NINP + L.MESHES]
    if not put_point(inp, cont, point):
        return BAD_INPUT
    if own[A_LARGEST] == 0.0:
        discrete[D_LARGEST] = largest_of(par, point, work)
    told = work[L.W_HERE : L.W_HERE + L.N_TOLD]
    status = tell(par, point, way_of(inp[L.I_SPEED]), work, told)
    if status >= 10:
        return status
    for i in range(L.MESHES):
        cont[np.uintp(X_BODY + i)] = inp[L.I_OIL]
        if i < int(par[L.P_MESHES]):
            cont[np.uintp(X_BODY + i)] = told[np.uintp(L.O_MESH + i * L.M_ROW + L.M_BULK)]
    put_point(inp, cont, point)
    capacity, status = estimate(par, point, work)
    cont[X_BEND] = first_bend(bristle_of_train(own, discrete), capacity, inp[L.I_SPEED])
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
    point = work[L.W_POINT : L.W_POINT + NINP + L.MESHES]
    if not (put_point(inp, cont, point) and are_finite(cont)):
        return BAD_INPUT
    first, status = estimate(par, point, work)
    if status >= 10:
        return status
    slip, bend, b = inp[L.I_SPEED], cont[X_BEND], bristle_of_train(own, discrete)
    torque, rate = bristle(b, first, slip, bend)
    told = work[L.W_HERE : L.W_HERE + L.N_TOLD]
    status = tell(par, point, torque / first if first > 0.0 else 0.0, work, told)
    if status >= 10:
        return status
    factor = told[T_CAPACITY] / first if first > 0.0 else 1.0
    heat = factor * bristle_heat(b, torque, slip, bend, rate)
    torque *= factor
    copy(told, out)
    der[X_BEND] = factor * rate
    fill_powers(par, told, told, heat, 0.0, out, der)
    ratio, left = ratio_of(par), inp[L.I_TORQUE] - torque
    out[L.O_LOSS_TORQUE], out[L.O_LOSS], out[L.O_ENERGY] = torque, heat, cont[X_ENERGY]
    out[L.O_OUTPUT_TORQUE], out[L.O_OUTPUT_SPEED] = left * ratio, slip / ratio
    out[L.O_EFFICIENCY] = efficiency(inp[L.I_TORQUE] * slip, left * slip)
    for i in range(L.MESHES):
        at = i * Z_ROW
        for k in range(Z_ROW):
            sign[np.uintp(at + k)] = 1.0
        if i < int(par[L.P_MESHES]):
            pair = L.W_OUT + i * G.NOUT
            ratio = work[np.uintp(pair + G.F_RATIO)]
            sign[np.uintp(at + Z_MIXED)] = ratio - MIXED_FROM
            sign[np.uintp(at + Z_BOUNDARY)] = ratio - BOUNDARY_FROM
            hot = work[np.uintp(pair + G.F_FILM_TEMPERATURE)]
            sign[np.uintp(at + Z_HOT)] = (HOT_FILM - hot) / HOT_FILM
            sign[np.uintp(at + Z_OUTSIDE)] = work[np.uintp(L.W_ROOM + i)]
    return OK if are_finite(out) and are_finite(der) else NOT_FINITE


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
    """Fill what is discrete, regimes and status; return 0 or the status of a failure."""
    point = work[L.W_POINT : L.W_POINT + NINP + L.MESHES]
    if not (put_point(inp, cont, point) and are_finite(cont) and math.isfinite(t)):
        return BAD_INPUT
    first, status = estimate(par, point, work)
    if status >= 10:
        return status
    torque, _ = bristle(bristle_of_train(own, discrete), first, inp[L.I_SPEED], cont[X_BEND])
    told = work[L.W_HERE : L.W_HERE + L.N_TOLD]
    status = tell(par, point, torque / first if first > 0.0 else 0.0, work, told)
    if status >= 10:
        return status
    discrete[D_NEXT] = NEVER
    iout[L.IO_STATUS] = fill_advice(par, inp[L.I_OIL], work, iout)
    return OK


@kernel
def size_of(inp: Array, along: Array) -> float:
    """Return how large a change of inputs and temperatures is, over their own sizes."""
    size = abs(along[L.I_TORQUE]) / max(abs(inp[L.I_TORQUE]), SIZE_TORQUE)
    size = max(size, abs(along[L.I_SPEED]) / max(abs(inp[L.I_SPEED]), SIZE_SPEED))
    size = max(size, abs(along[L.I_OIL]) / SIZE_HEAT)
    for i in range(L.MESHES):
        size = max(size, abs(along[np.uintp(NINP + X_BODY + i)]) / SIZE_HEAT)
    return size


@kernel
def move_point(inp: Array, cont: Array, along: Array, h: float, point: Array) -> None:
    """Fill a point that lies ``h`` times ``along`` from that of inputs and states."""
    put_point(inp, cont, point)
    for k in range(NINP + L.MESHES):  # the temperatures of the bodies are the first states
        point[np.uintp(k)] += h * along[np.uintp(k)]


@kernel
def weight_of(k: int) -> tuple[float, float]:
    """Return place and weight of a difference of fourth order, ``k`` from 0 to 3."""
    place = float(k - 2 if k < 2 else k - 1)
    return place, (1.0 if k == 0 else -8.0 if k == 1 else 8.0 if k == 2 else -1.0) / 12.0


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
    """Fill ``found``, changes of outputs and rates, with changes of inputs and states ``along``.

    The bristle's are exact; those of the chain are differences of fourth order.
    """
    clear(found)
    point = work[L.W_POINT : L.W_POINT + NINP + L.MESHES]
    here, there = work[L.W_HERE : L.W_HERE + L.N_TOLD], work[L.W_THERE : L.W_THERE + L.N_TOLD]
    move_point(inp, cont, along, 0.0, point)
    first, status = estimate(par, point, work)
    size, grows = size_of(inp, along), 0.0
    for k in range(4):
        place, weight = weight_of(k)
        if size > 0.0 and status < 10:
            h = DIFFERENCE / size
            move_point(inp, cont, along, place * h, point)
            other, status = estimate(par, point, work)
            grows += weight / h * other
    if status >= 10:
        return status
    slip, bend, b = inp[L.I_SPEED], cont[X_BEND], bristle_of_train(own, discrete)
    torque, rate = bristle(b, first, slip, bend)
    change = (grows, along[L.I_SPEED], along[NINP + X_BEND])
    heat, torques, turns, heats = bristle_changes(b, first, slip, bend, change, (0.0, 0.0))
    share, shares = 0.0, 0.0
    if first > 0.0:
        share, shares = torque / first, (torques - torque / first * grows) / first
    size, changed = max(size, abs(shares)), found[:NOUT]
    move_point(inp, cont, along, 0.0, point)
    status = tell(par, point, share, work, there)
    copy(there, here)
    clear(there)
    moved = work[L.W_TRIED : L.W_TRIED + L.N_TOLD]
    for k in range(4):
        place, weight = weight_of(k)
        if size > 0.0 and status < 10:
            h = DIFFERENCE / size
            move_point(inp, cont, along, place * h, point)
            status = tell(par, point, share + place * h * shares, work, moved)
            for j in range(L.N_TOLD):
                there[np.uintp(j)] += weight / h * moved[np.uintp(j)]
    if status >= 10:
        return status
    factor, factors = 1.0, 0.0
    if first > 0.0:
        factor = here[T_CAPACITY] / first
        factors = (there[T_CAPACITY] - factor * grows) / first
    heats, heat = factors * heat + factor * heats, factor * heat
    torques, torque = factors * torque + factor * torques, factor * torque
    copy(there, changed)
    fill_powers(par, here, there, heat, heats, changed, found[NOUT:])
    found[NOUT + X_BEND] = factors * rate + factor * turns
    ratio, left = ratio_of(par), inp[L.I_TORQUE] - torque
    lefts = along[L.I_TORQUE] - torques
    changed[L.O_LOSS_TORQUE], changed[L.O_LOSS] = torques, heats
    changed[L.O_ENERGY] = along[NINP + X_ENERGY]
    changed[L.O_OUTPUT_TORQUE], changed[L.O_OUTPUT_SPEED] = (
        lefts * ratio,
        along[L.I_SPEED] / ratio,
    )
    given, gives = inp[L.I_TORQUE], along[L.I_TORQUE]
    changed[L.O_EFFICIENCY] = 0.0
    if efficiency(given * slip, left * slip) != L.NONE:
        changed[L.O_EFFICIENCY] = (lefts * given - left * gives) / (given * given)
        if given * slip < 0.0:
            changed[L.O_EFFICIENCY] = (gives * left - given * lefts) / (left * left)
    return OK if are_finite(found) else NOT_FINITE
