# mypy: disable-error-code="no-any-return"
"""Torques from shaft to shaft, until the losses and the forces that make them agree."""

import math

import numpy as np

from ...gearmesh.kernels import layout as G
from ...gearmesh.kernels.exchange import room_of
from ...gearmesh.kernels.mesh_point import viscosity_at
from ...gearmesh.kernels.step import step_risen
from ...losses.kernels.loss_laws import bearing_drag, churning_drag, seal_drag
from ...losses.kernels.skf_friction import SKF, skf_drag
from ...numerics.jit import Array, kernel
from ...numerics.status import MAX_ITERATIONS, OK
from . import layout as L
from .bearing_life import equivalent_load
from .tooth_forces import bear, fill_force

SWEEPS, PLAIN, EASED, SETTLED = 600, 12, 0.3, 1e-14  # PLAIN: sweeps before they are eased


@kernel
def shaft_loss(work: Array, shaft: int) -> float:
    """Return the torque against a shaft [N m], sign of its speed."""
    total = 0.0
    for k in range(L.LOSSES):
        total += work[np.uintp(L.W_LOSS + shaft * L.LOSSES + k)]
    return total


@kernel
def risen_at(rise: tuple[float, float], speed: float, turn: float) -> float:
    """Return the part of the friction that acts at a speed [rad/s], with its sign.

    ``rise``: the speed [rad/s] over which it rises; 0: the part that acts, with the sign of the
    input's, is the second number. ``turn``: a speed for one of the input.
    """
    if rise[0] > 0.0:
        return math.tanh(speed / rise[0])
    return rise[1] if turn > 0.0 else -rise[1]


@kernel
def march(
    par: Array, inp: Array, rise: tuple[float, float], state: Array, work: Array, dt: float
) -> int:
    """Fill torques, speeds and the pairs' outputs from input to output; return OK or a failure.

    The losses of the shafts are as in ``work``, friction as ``risen_at`` says.
    """
    torque, speed, worst, along = inp[L.I_TORQUE], inp[L.I_SPEED], OK, 1.0
    meshes, own = int(par[L.P_MESHES]), work[L.W_PAIR : L.W_PAIR + G.NWORK]
    given = work[L.W_INP : L.W_INP + G.NINP]
    for i in range(meshes):
        work[np.uintp(L.W_SPEED + i)] = speed
        torque -= shaft_loss(work, i)
        work[np.uintp(L.W_TORQUE + i)] = torque
        ratio = par[np.uintp(L.D_MESH + i * L.E_ROW + L.E_RATIO)]
        driver = par[np.uintp(L.P_MESH + i * L.MESH_ROW + L.A_DRIVER)]
        slower = -1.0 if driver == L.PINION else ratio  # driver's torque over the pinion's
        turn = 1.0 if driver == L.PINION else -1.0 / ratio  # pinion's speed over the driver's
        given[G.I_LOAD] = torque if driver == L.PINION else -torque * slower
        given[G.I_SPEED], given[G.I_OIL] = speed * turn, inp[L.I_OIL]
        out = work[L.W_OUT + i * G.NOUT : L.W_OUT + (i + 1) * G.NOUT]
        pair = par[L.D_PAIR + i * G.NPAR : L.D_PAIR + (i + 1) * G.NPAR]
        memory = state[i * G.NSTATE : (i + 1) * G.NSTATE]
        risen = risen_at(rise, given[G.I_SPEED], along * turn)
        status = step_risen(pair, given, risen, memory, own, out, dt)
        work[np.uintp(L.W_ADVICE + i)] = float(status)
        worst = max(worst, status if status >= 10 else OK)
        if rise[0] == 0.0:
            work[np.uintp(L.W_ROOM + i)] = room_of(pair, inp[L.I_OIL], own)
        rubbing = out[G.F_TORQUE] * turn
        work[np.uintp(L.W_FRICTION + i)] = rubbing
        torque, speed, along = -(torque - rubbing) * ratio, -speed / ratio, -along / ratio
    work[np.uintp(L.W_SPEED + meshes)] = speed
    work[L.W_END] = torque - shaft_loss(work, meshes)
    return worst


@kernel
def fill_loads(par: Array, work: Array) -> None:
    """Fill tooth forces and the forces of all bearings."""
    meshes = int(par[L.P_MESHES])
    for i in range(meshes):
        force = work[L.W_FORCE + 3 * i : L.W_FORCE + 3 * i + 3]
        fill_force(par, i, work[np.uintp(L.W_TORQUE + i)], force)
    for i in range(meshes + 1):
        bear(par, meshes, i, work)


@kernel
def fill_losses(
    par: Array, oil: float, rise: tuple[float, float], work: Array, share: float
) -> float:
    """Move the loss torques by ``share`` towards those of the forces; return the largest move."""
    meshes, moved, along = int(par[L.P_MESHES]), 0.0, 1.0
    pair = par[L.D_PAIR : L.D_PAIR + G.NPAR]
    nu, smooth = viscosity_at(pair, oil) / pair[G.P_OIL_DENSITY], pair[G.P_SPEED_SMOOTHING]
    for i in range(meshes + 1):
        speed, own = work[np.uintp(L.W_SPEED + i)], L.P_SHAFT + i * L.SHAFT_ROW
        turning, sign = math.hypot(speed, smooth), risen_at(rise, speed, along)
        if i < meshes:
            along = -along / par[np.uintp(L.D_MESH + i * L.E_ROW + L.E_RATIO)]
        at = L.W_LOSS + i * L.LOSSES
        for k in range(L.LOSSES):
            if k < L.ENDS:
                size = bearing_torque(par, i, k, turning, nu, work)
            elif k == L.ENDS:
                drag, _ = seal_drag(oil, par[L.D_NU_40], par[np.uintp(own + L.B_SEAL_DIAMETER)])
                size = par[np.uintp(own + L.B_SEALS)] * drag
            else:
                size = churning_torque(par, meshes, i, turning, nu)
            change = share * (size * sign - work[np.uintp(at + k)])
            work[np.uintp(at + k)] += change
            moved = max(moved, abs(change))
    return moved


@kernel
def bearing_torque(
    par: Array, shaft: int, end: int, turning: float, nu: float, work: Array
) -> float:
    """Return the size of the torque of a bearing [N m].

    Palmgren's law takes X F_r + Y F_a, at least F_r: its equivalent load without the step that a
    catalogue's e may leave, at which losses and forces might not settle.
    """
    row = L.P_SHAFT + shaft * L.SHAFT_ROW + L.B_BEARING + end * L.BEARING_ROW
    at, number = L.W_BEARING + 2 * (L.ENDS * shaft + end), L.ENDS * shaft + end
    if int(par[L.P_LAW]) == SKF:
        series = L.D_SERIES + number * L.SERIES_ROW
        drag, _, _ = skf_drag(
            turning,
            nu,
            (work[np.uintp(at)], work[np.uintp(at + 1)]),
            par[np.uintp(row + L.C_DIAMETER)],
            par[np.uintp(L.D_STARVED + number)],
            par[series : series + L.SERIES_ROW],
            (par[np.uintp(row + L.C_Y)], par[np.uintp(row + L.C_STATIC)]),
            par[L.P_FILM],
        )
        return drag
    load = equivalent_load(
        work[np.uintp(at)],
        work[np.uintp(at + 1)],
        par[np.uintp(row + L.C_X)],
        par[np.uintp(row + L.C_Y)],
        0.0,
    )
    drag, _, _ = bearing_drag(
        turning,
        nu,
        load,
        par[np.uintp(row + L.C_DIAMETER)],
        par[np.uintp(row + L.C_VISCOUS)],
        par[np.uintp(row + L.C_LOAD)],
        par[np.uintp(L.D_STARVED + number)],
    )
    return drag


@kernel
def churning_torque(par: Array, meshes: int, shaft: int, turning: float, nu: float) -> float:
    """Return the size of the torque of a shaft's gears that dip into the oil [N m]."""
    total = 0.0
    for mesh in range(max(shaft - 1, 0), min(shaft + 1, meshes)):
        drives = mesh == shaft
        gear = 0 if drives == (par[np.uintp(L.P_MESH + mesh * L.MESH_ROW)] == L.PINION) else 1
        at = L.D_MESH + mesh * L.E_ROW + L.E_GEARS + gear * L.GEAR_ROW
        slow, fast = par[np.uintp(at)], par[np.uintp(at + 1)]
        drag, _, _ = churning_drag(
            turning, nu, slow, fast, par[np.uintp(at + 2)], par[np.uintp(at + 3)]
        )
        total += drag
    return total


@kernel
def solve_chain(
    par: Array, inp: Array, rise: tuple[float, float], state: Array, work: Array, dt: float
) -> int:
    """Fill ``work`` with torques, forces and losses that agree; return 0 or a failure.

    The state moves on by ``dt``; friction acts as ``risen_at`` says, over a speed of any shaft.
    Losses grow with a small share of the forces, so that a few sweeps settle them. Where the output
    drives and they grow faster than what it brings, the chain locks itself and nothing settles;
    where the input drives they settle anyway, eased.
    """
    for k in range(L.SHAFTS * L.LOSSES):
        work[np.uintp(L.W_LOSS + k)] = 0.0
    way = inp[L.I_SPEED] if rise[0] > 0.0 else rise[1]
    settled, drives = False, inp[L.I_TORQUE] * way > 0.0
    for n in range(SWEEPS):
        status = march(par, inp, rise, state, work, 0.0)
        if status >= 10:
            return status
        fill_loads(par, work)
        share = EASED if n >= PLAIN and drives else 1.0
        moved = fill_losses(par, inp[L.I_OIL], rise, work, share)
        size = abs(inp[L.I_TORQUE])
        for i in range(int(par[L.P_MESHES])):
            size = max(size, abs(work[np.uintp(L.W_TORQUE + i)]))
        settled = moved <= SETTLED * (1.0 + size)
        if settled:
            break
    if not settled:
        return MAX_ITERATIONS
    status = march(par, inp, rise, state, work, dt)
    fill_loads(par, work)
    return status
