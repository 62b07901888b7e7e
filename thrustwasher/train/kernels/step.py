# mypy: disable-error-code="no-any-return"
"""One co-simulation step of the gear train: it remembers the bodies of the meshes."""

import math

import numpy as np

from ...gearmesh.kernels import layout as G
from ...gearmesh.kernels.constants import derive_efficiency
from ...gearmesh.kernels.mesh_point import viscosity_at
from ...gearmesh.kernels.step import broken_rule as broken_pair
from ...gearmesh.kernels.step import derive as derive_pair
from ...gearmesh.kernels.step import regime_of
from ...gearmesh.kernels.working_pair import section
from ...losses.kernels.loss_laws import churning_constants, starved
from ...losses.kernels.skf_friction import SKF, fill_series
from ...losses.kernels.skf_series import NUMBERS
from ...numerics.arrays import are_finite, copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.status import BAD_INPUT, CHATTER, NOT_FINITE, OK, OUTSIDE_VERIFIED
from ...tribology.holding import memory as M
from ...tribology.holding.drag import keep, width_at
from ...tribology.holding.figures import fill_figures
from ...tribology.holding.reversals import chatters
from . import layout as L
from .bearing_life import equivalent_load, rating_life
from .chain import shaft_loss, solve_chain
from .tooth_forces import centres, induced_of

N_PARAM, NPAR, NINP, NSTATE, NWORK = L.N_PARAM, L.NPAR, L.NINP, L.NSTATE, L.NWORK
NOUT, NIOUT, W_TOLD, W_STATES = L.NOUT, L.NIOUT, L.W_TOLD, L.W_STATES
HOLDS_NOT = 3.0  # the number of `holding = off`
K_Z = (3.1, 4.4, 5.1, 6.0)  # of the types of bearings: SKF's constant of starvation
COLDEST, HOTTEST = 253.15, 423.15  # K, between which the laws are meant
AT_40 = 313.15  # K


@kernel
def fill_pair(par: Array, mesh: int) -> None:
    """Fill the parameters of a pair's own array."""
    own, at = L.P_MESH + mesh * L.MESH_ROW + L.A_PAIR, L.D_PAIR + mesh * G.NPAR
    for k in range(L.N_OWN):
        par[np.uintp(at + L.OWN[k])] = par[np.uintp(own + k)]
    for k in range(L.N_SHARED):
        par[np.uintp(at + L.SHARED[k])] = par[np.uintp(L.P_SHARED + k)]
    for k in range(L.N_FIXED):
        par[np.uintp(at + L.FIXED[k])] = 0.0
    par[np.uintp(at + G.P_HOLDING)] = HOLDS_NOT
    par[np.uintp(at + G.P_FIDELITY)] = float(G.FIELD)


@kernel
def derive_mesh(par: Array, mesh: int) -> None:
    """Fill radii, forces per torque and churning of a mesh, after its pair."""
    own, at = L.P_MESH + mesh * L.MESH_ROW, L.D_MESH + mesh * L.E_ROW
    pair = par[L.D_PAIR + mesh * G.NPAR : L.D_PAIR + (mesh + 1) * G.NPAR]
    ratio, distance = pair[G.P_GEAR_RATIO], pair[G.D_CENTRE]
    pinion = distance / (ratio + 1.0)
    drives = par[np.uintp(own + L.A_DRIVER)] == L.PINION
    derive_efficiency(pair, drives)  # of the driver's power, as the chain gives it
    par[np.uintp(at + L.E_RATIO)] = ratio if drives else 1.0 / ratio
    par[np.uintp(at + L.E_DRIVER)] = pinion if drives else distance - pinion
    par[np.uintp(at + L.E_DRIVEN)] = distance - pinion if drives else pinion
    par[np.uintp(at + L.E_RADIAL)] = math.tan(pair[G.D_ANGLE])
    # base circles share a helix: tan b at the working circle is tan b of it times r_w/r
    reference = section(pair)[1] / (ratio + 1.0)
    slope = math.tan(pair[G.P_HELIX_ANGLE]) * pinion / reference
    right = (par[np.uintp(own + L.A_HAND)] == L.RIGHT) == drives
    par[np.uintp(at + L.E_AXIAL)] = slope if right else -slope
    for gear in range(2):
        radius = pinion if gear == 0 else distance - pinion
        width, row = pair[G.P_FACE_WIDTH], at + L.E_GEARS + gear * L.GEAR_ROW
        depth = par[np.uintp(own + L.A_PINION_IMMERSION + gear)]
        par[np.uintp(row)], par[np.uintp(row + 1)] = churning_constants(
            2.0 * radius, width, depth, par[L.P_OIL_VOLUME], pair[G.P_OIL_DENSITY]
        )
        par[np.uintp(row + 2)] = radius * width
        par[np.uintp(row + 3)] = (radius * radius * width) ** (1.0 / 3.0)


@kernel
def derive(par: Array) -> int:
    """Fill the constants behind the parameters; return 0, or the status of a failure."""
    for i in range(int(par[L.P_MESHES])):
        fill_pair(par, i)
        pair = par[L.D_PAIR + i * G.NPAR : L.D_PAIR + (i + 1) * G.NPAR]
        if broken_pair(pair) > 0:
            return BAD_INPUT
        status = derive_pair(pair)
        if status >= 10:
            return status
        derive_mesh(par, i)
    pair = par[L.D_PAIR : L.D_PAIR + G.NPAR]
    par[L.D_NU_40] = viscosity_at(pair, AT_40) / pair[G.P_OIL_DENSITY]
    for i in range(L.SHAFTS * L.ENDS):
        row = L.P_SHAFT + i // L.ENDS * L.SHAFT_ROW + L.B_BEARING + i % L.ENDS * L.BEARING_ROW
        par[np.uintp(L.D_STARVED + i)] = starved(
            par[L.P_STARVATION],
            K_Z[int(par[np.uintp(row + L.C_KIND)]) - 1],
            par[np.uintp(row + L.C_DIAMETER)],
            par[np.uintp(row + L.C_SECTION)],
        )
        series = L.D_SERIES + i * L.SERIES_ROW
        fill_series(
            NUMBERS, int(par[np.uintp(row + L.C_SERIES)]), par[series : series + L.SERIES_ROW]
        )
    return OK if are_finite(par[L.N_PARAM : L.D_PAIR]) else NOT_FINITE


@kernel
def broken_rule(par: Array) -> int:
    """Return the number of the first broken rule between parameters, from 1, or 0.

    ``layout.RULES`` of each shaft, see ``RULES`` of the parameters.
    """
    for i in range(int(par[L.P_MESHES]) + 1):
        own, number = L.P_SHAFT + i * L.SHAFT_ROW, i * L.RULES
        row = own + L.B_BEARING + L.C_POSITION
        if not abs(par[np.uintp(row)] - par[np.uintp(row + L.BEARING_ROW)]) >= 1e-4:
            return number + 1
        first, second = centres(par, i)
        if not abs(first - second) >= 1e-4:
            return number + 2
        alone = par[np.uintp(own + L.B_AXIAL)] <= L.PUSHED
        for end in range(L.ENDS):
            row = own + L.B_BEARING + end * L.BEARING_ROW
            kind = int(par[np.uintp(row + L.C_KIND)])
            by_kind = par[np.uintp(row + L.C_INDUCED)] < 0.0
            by_y = kind == L.TAPER or (kind == L.ANGULAR and par[np.uintp(row + L.C_E)] <= 0.0)
            if by_kind and by_y and not par[np.uintp(row + L.C_Y)] >= 1e-3:
                return number + 3
            if alone and (kind == L.TAPER or kind == L.ANGULAR) and induced_of(par, i, end) > 0.0:
                return number + 4
            if int(par[L.P_LAW]) != SKF:
                continue
            series = int(par[np.uintp(row + L.C_SERIES)])
            if series <= 1 or int(NUMBERS[L.SERIES_ROW * (series - 2)]) != kind:
                return number + 5
            if kind == L.BALL and not par[np.uintp(row + L.C_STATIC)] > 0.0:
                return number + 6
    return 0


@kernel
def fill_meshes(par: Array, work: Array, out: Array) -> None:
    """Fill what is told of each mesh, their losses and least safeties."""
    for i in range(L.MESHES):
        row = L.O_MESH + i * L.M_ROW
        if i >= int(par[L.P_MESHES]):
            for k in range(L.M_ROW):
                out[np.uintp(row + k)] = L.NONE
            continue
        pair, force = L.W_OUT + i * G.NOUT, L.W_FORCE + 3 * i
        loss = work[np.uintp(L.W_FRICTION + i)] * work[np.uintp(L.W_SPEED + i)]
        tangential = abs(work[np.uintp(L.W_TORQUE + i)])
        tangential /= par[np.uintp(L.D_MESH + i * L.E_ROW + L.E_DRIVER)]
        radial = tangential * par[np.uintp(L.D_MESH + i * L.E_ROW + L.E_RADIAL)]
        drives = par[np.uintp(L.P_MESH + i * L.MESH_ROW + L.A_DRIVER)] == L.PINION
        axial = work[np.uintp(force)]
        out[np.uintp(row + L.M_LOSS)] = loss
        out[np.uintp(row + L.M_BULK)] = work[np.uintp(pair + G.F_BULK)]
        out[np.uintp(row + L.M_TANGENTIAL)] = tangential
        out[np.uintp(row + L.M_RADIAL)] = radial
        out[np.uintp(row + L.M_AXIAL)] = axial if drives else -axial
        out[np.uintp(row + L.M_PITTING)] = work[np.uintp(pair + G.F_PITTING_SAFETY)]
        out[np.uintp(row + L.M_ROOT)] = work[np.uintp(pair + G.F_ROOT_SAFETY)]
        out[np.uintp(row + L.M_SCUFFING)] = work[np.uintp(pair + G.F_SCUFFING_SAFETY)]
        out[L.O_MESH_LOSS] += loss
        out[L.O_HEAT] += work[np.uintp(pair + G.F_OIL_HEAT)]
        for k in range(3):
            safety = out[np.uintp(row + L.M_PITTING + k)]
            out[np.uintp(L.O_PITTING + k)] = min(out[np.uintp(L.O_PITTING + k)], safety)


@kernel
def fill_bearings(par: Array, work: Array, out: Array) -> None:
    """Fill what is told of each bearing, and losses of bearings, seals and churning."""
    for i in range(L.SHAFTS * L.ENDS):
        shaft, end, row = i // L.ENDS, i % L.ENDS, L.O_BEARING + i * L.R_ROW
        if shaft > int(par[L.P_MESHES]):
            for k in range(L.R_ROW):
                out[np.uintp(row + k)] = L.NONE
            continue
        given = L.P_SHAFT + shaft * L.SHAFT_ROW + L.B_BEARING + end * L.BEARING_ROW
        speed, at = work[np.uintp(L.W_SPEED + shaft)], L.W_BEARING + 2 * i
        radial, axial = work[np.uintp(at)], work[np.uintp(at + 1)]
        load = equivalent_load(
            radial,
            axial,
            par[np.uintp(given + L.C_X)],
            par[np.uintp(given + L.C_Y)],
            par[np.uintp(given + L.C_E)],
        )
        loss = work[np.uintp(L.W_LOSS + shaft * L.LOSSES + end)] * speed
        kind = int(par[np.uintp(given + L.C_KIND)])
        life = rating_life(par[np.uintp(given + L.C_CAPACITY)], load, speed, kind)
        out[np.uintp(row + L.R_RADIAL)], out[np.uintp(row + L.R_AXIAL)] = radial, axial
        out[np.uintp(row + L.R_LOAD)], out[np.uintp(row + L.R_LOSS)] = load, loss
        out[np.uintp(row + L.R_LIFE)] = life
        out[L.O_LIFE] = min(out[L.O_LIFE], life)
        out[L.O_BEARING_LOSS] += loss
        if end == 0:
            seal = L.W_LOSS + shaft * L.LOSSES + L.ENDS
            out[L.O_SEAL_LOSS] += work[np.uintp(seal)] * speed
            out[L.O_CHURNING_LOSS] += work[np.uintp(seal + 1)] * speed


@kernel
def fill_told(par: Array, work: Array, out: Array) -> None:
    """Fill what is told of meshes and bearings, losses, heat of the meshes."""
    for k in range(L.NOUT):
        out[np.uintp(k)] = 0.0
    out[L.O_PITTING] = out[L.O_ROOT] = out[L.O_SCUFFING] = G.NO_LIMIT
    out[L.O_LIFE] = 1e12
    fill_meshes(par, work, out)
    fill_bearings(par, work, out)


@kernel
def ratio_of(par: Array) -> float:
    """Return the torque at the output over that at the input, without losses, with its sign."""
    ratio = 1.0
    for i in range(int(par[L.P_MESHES])):
        ratio *= -par[np.uintp(L.D_MESH + i * L.E_ROW + L.E_RATIO)]
    return ratio


@kernel
def fill_advice(par: Array, oil: float, work: Array, iout: Ints) -> int:
    """Fill regime and advice of each mesh; return the worst advice."""
    worst = OK if COLDEST <= oil <= HOTTEST else OUTSIDE_VERIFIED
    for i in range(L.MESHES):
        regime, advice = G.FILM, OK
        if i < int(par[L.P_MESHES]):
            regime = regime_of(work[np.uintp(L.W_OUT + i * G.NOUT + G.F_RATIO)])
            advice = int(work[np.uintp(L.W_ADVICE + i)])
        iout[np.uintp(i * G.NIOUT + G.IO_REGIME)] = regime
        iout[np.uintp(i * G.NIOUT + G.IO_STATUS)] = advice
        worst = max(worst, advice)
    return worst


@kernel
def fastest_of(par: Array) -> float:
    """Return the speed of the fastest shaft over that of the input."""
    turn, most = 1.0, 1.0
    for i in range(int(par[L.P_MESHES])):
        turn /= abs(par[np.uintp(L.D_MESH + i * L.E_ROW + L.E_RATIO)])
        most = max(most, turn)
    return most


@kernel
def capacity_of(par: Array, work: Array, width: float) -> float:
    """Return all friction that has risen, at the input [N m]; 0 at rest."""
    first, total = abs(work[L.W_SPEED]), 0.0
    if first == 0.0:
        return 0.0
    for i in range(int(par[L.P_MESHES]) + 1):
        speed, size = abs(work[np.uintp(L.W_SPEED + i)]), abs(shaft_loss(work, i))
        if i < int(par[L.P_MESHES]):
            size += abs(work[np.uintp(L.W_FRICTION + i)])
        risen = math.tanh(speed / width)
        if risen > 0.0:
            total += size * speed / first / risen
    return total


@kernel
def efficiency(given: float, left: float) -> float:
    """Return what comes out over what goes in, of powers [W] in and out; -1 if nothing does."""
    if given > 0.0 and left > 0.0:
        return left / given
    if given < 0.0 and left < 0.0:
        return given / left
    return L.NONE


@kernel
def step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float
) -> int:
    """Fill the outputs at the present torque, speed and oil, held from t to t + dt.

    Returns 0 or the status of a failure; advice stands in ``iout`` only.
    """
    oil, meshes = inp[L.I_OIL], int(par[L.P_MESHES])
    if not (are_finite(inp) and oil > 0.0 and math.isfinite(dt) and dt >= 0.0):
        iout[L.IO_STATUS] = BAD_INPUT
        return BAD_INPUT
    for i in range(L.MESHES):
        iout[np.uintp(i * G.NIOUT + G.IO_REGIME)] = G.FILM
        iout[np.uintp(i * G.NIOUT + G.IO_STATUS)] = OK
    # the fastest shaft comes nearest to chatter, and no shaft's friction rises over less
    fastest, mem = fastest_of(par), work[L.W_MEMORY : L.W_MEMORY + M.N_MEMORY]
    copy(state[L.S_MEMORY : L.S_MEMORY + M.N_MEMORY], mem)
    way = (M.IDENTIFIED, 0.0, 0, par[L.D_PAIR + G.P_SPEED_SMOOTHING] / fastest, False)
    width = fastest * width_at(way, mem, inp[L.I_SPEED], dt)
    status = solve_chain(par, inp, (width, 0.0), state, work, dt)
    fill_told(par, work, out)
    ratio = ratio_of(par)
    left, speed = work[L.W_END], work[np.uintp(L.W_SPEED + meshes)]
    out[L.O_LOSS_TORQUE] = inp[L.I_TORQUE] - left / ratio
    out[L.O_OUTPUT_TORQUE], out[L.O_OUTPUT_SPEED] = left, speed
    rest = out[L.O_BEARING_LOSS] + out[L.O_SEAL_LOSS] + out[L.O_CHURNING_LOSS]
    out[L.O_LOSS] = out[L.O_MESH_LOSS] + rest
    out[L.O_EFFICIENCY] = efficiency(inp[L.I_TORQUE] * inp[L.I_SPEED], left * speed)
    out[L.O_HEAT] += rest
    out[L.O_ENERGY] = state[L.S_ENERGY] + out[L.O_HEAT] * dt
    for i in range(L.MESHES):
        bulk = out[np.uintp(L.O_MESH + i * L.M_ROW + L.M_BULK)]
        work[np.uintp(L.W_STATES + i)] = bulk if i < meshes else oil
    if status == OK:
        status = fill_advice(par, oil, work, iout)
    if not are_finite(out):
        status = NOT_FINITE
    elif dt > 0.0 and status < 10:
        state[L.S_ENERGY] = out[L.O_ENERGY]
        keep(way, mem, inp[L.I_SPEED], dt, out[L.O_LOSS_TORQUE], capacity_of(par, work, width))
        copy(mem, state[L.S_MEMORY : L.S_MEMORY + M.N_MEMORY])
    if status < 10 and chatters(mem):
        fill_figures(way, mem, work[L.W_TOLD : L.W_TOLD + M.N_FIGURES])
        status = CHATTER
    iout[L.IO_STATUS] = status
    return status if status >= 10 else 0
