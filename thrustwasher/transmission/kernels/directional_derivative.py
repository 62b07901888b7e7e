# mypy: disable-error-code="no-any-return"
"""How the outputs of the shift transmission change with its inputs: exact, modes as they are.

Speeds and energies are states; torques follow the inputs at once, loads the torques.
"""

import math

import numpy as np

from ...numerics.arrays import are_finite, clear
from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of, soft_size_slope
from ...numerics.status import NOT_FINITE, OK
from . import dynamics
from . import layout as L
from .dynamics import drum_speed
from .piston import force
from .planet_bearing import washer_changes, washer_share
from .shaft_losses import spread_losses
from .thrust_bearings import bearing_torque

LEAST_WASHER_LOAD = 1.0  # N


@kernel
def pack_change(
    par: Array, inp: Array, state: Array, pack: int, capacity: float, change: float
) -> tuple[float, float]:
    """Return changes of the torque given and of the capacity of clutch (0) or brake (1).

    Right after a step the capacity is the one extrapolated to its end; another input counts from
    there as it does from any other.
    """
    if par[L.P_COUPLING] == L.TORQUE_COUPLING:
        return change, 0.0
    if not (inp[np.uintp(L.I_CLUTCH + pack)] > 0.0 and capacity > 0.0):
        return 0.0, 0.0
    if par[L.P_CAPACITY_EXTRAPOLATION] != 0.0 and state[L.S_STARTED] != 0.0:
        return 0.0, change * (1.0 + par[L.P_TORQUE_AGE])
    return 0.0, change


@kernel
def torque_changes(
    par: Array,
    work: Array,
    clutch: tuple[float, float],
    brake: tuple[float, float],
    drag: float,
    engine: float,
    load: float,
) -> tuple[float, float]:
    """Return changes of X and T_brake for the modes in ``work``, as ``solve_torques`` finds them.

    ``clutch``, ``brake``: changes of torque given and capacity; ``drag``, ``engine`` and ``load``
    those of these torques, the load at the carrier.
    """
    c, b = (1.0 + par[L.D_RATIO]) / par[L.D_RATIO], 1.0 / par[L.D_RATIO]
    driven = par[L.D_INV_SS] * engine - par[L.D_INV_SC] * load
    carrier = par[L.D_INV_SC] * engine - par[L.D_INV_CC] * load
    free_clutch, free_brake = c * (driven - carrier), c * carrier - b * driven
    s_cc, s_cb, s_bb = par[L.D_SLIP_CC], par[L.D_SLIP_CB], par[L.D_SLIP_BB]
    clutch_mode, brake_mode = work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE]
    if clutch_mode == L.STUCK and brake_mode == L.STUCK:
        det = s_cc * s_bb - s_cb * s_cb
        return (
            (s_bb * free_clutch - s_cb * free_brake) / det,
            (s_cc * free_brake - s_cb * free_clutch) / det,
        )
    x = clutch[0] + clutch_mode * (clutch[1] + drag)
    held = brake[0] + brake_mode * brake[1]
    if clutch_mode == L.STUCK:
        x = (free_clutch - s_cb * held) / s_cc
    elif brake_mode == L.STUCK:
        held = (free_brake - s_cb * x) / s_bb
    return x, held


@kernel
def share_change(
    work: Array, given: float, capacity: float, x: float, capacity_now: float
) -> float:
    """Return the change of the clutch's own part of X, as ``clutch_share`` divides it."""
    if work[L.W_CLUTCH_MODE] != L.STUCK:
        return given + work[L.W_CLUTCH_MODE] * capacity
    if work[L.W_DRAG] == 0.0:
        return x
    carried = work[L.W_CLUTCH] - work[L.W_CLUTCH_GIVEN]
    if abs(carried) <= capacity_now:
        return x
    return given + math.copysign(capacity, carried)


@kernel
def balance_change(
    par: Array,
    work: Array,
    clutch: tuple[float, float],
    brake: tuple[float, float],
    drag: float,
    engine: float,
    load: float,
    capacity: float,
    teeth: float,
    lost: tuple[float, float, float],
) -> tuple[float, float, float, float, float]:
    """Return changes of tooth torque, clutch, brake, drag and the carrier's acceleration.

    ``teeth``: the change of the tooth torque's size as the bearings feel it; ``capacity``: that of
    the clutch now; ``lost``: that of ``spread_losses``; the others as for ``torque_changes``.
    """
    r = par[L.D_RATIO]
    drives = engine - lost[0] - teeth * work[L.W_BEARING_DRIVEN]
    resists = load + lost[1] + teeth * work[L.W_BEARING_CARRIER]
    x, held = torque_changes(par, work, clutch, brake, drag, drives, resists)
    carried = share_change(work, clutch[0], clutch[1], x, capacity)
    c, b = (1.0 + r) / r, 1.0 / r
    on_driven, on_carrier = drives + b * held - c * x, c * (x - held) - resists
    rate = par[L.D_INV_SS] * on_driven + par[L.D_INV_SC] * on_carrier
    carrier_rate = par[L.D_INV_SC] * on_driven + par[L.D_INV_CC] * on_carrier
    dragged = (x - carried) * c
    tau = engine - carried - dragged - par[L.P_INPUT_INERTIA] * rate
    tau -= lost[2] + teeth * work[L.W_BEARING_OWN]
    return tau, carried, held, dragged, carrier_rate


@kernel
def loss_change(par: Array, inp: Array, work: Array, seed: Array) -> tuple[float, float, float]:
    """Return how what losses take changes: as ``spread_losses``, at the present speeds."""
    sizes = (
        sign_of(inp[L.I_INPUT_LOSS]) * seed[L.I_INPUT_LOSS],
        sign_of(inp[L.I_DRUM_LOSS]) * seed[L.I_DRUM_LOSS],
        sign_of(inp[L.I_OUTPUT_LOSS]) * seed[L.I_OUTPUT_LOSS],
        sign_of(inp[L.I_PLANET_LOSS]) * seed[L.I_PLANET_LOSS] * par[L.P_PLANETS],
    )
    return spread_losses(par, work, L.W_Y, sizes)


@kernel
def pressed_change(par: Array, state: Array, work: Array, seed: Array, dout: Array) -> None:
    """Fill the changes of loads and pressures; a pressure that lags follows no input at once."""
    if par[L.P_ACTUATION] != L.PRESSURE:
        dout[L.O_CLUTCH_LOAD] = par[L.P_CLUTCH_FORCE] * seed[L.I_COMMAND]
        dout[L.O_BRAKE_LOAD] = -par[L.P_BRAKE_FORCE] * seed[L.I_COMMAND]
        return
    driven, carrier = work[L.W_Y + L.Y_INPUT], work[L.W_Y + L.Y_CARRIER]
    drum = drum_speed(par[L.D_RATIO], driven, carrier)
    for k in range(2):
        at, own = L.W_PISTON + k * L.N_PISTON, L.P_CLUTCH_PISTON_AREA + k * L.N_OWN
        p, spring = work[np.uintp(at)], par[np.uintp(own + L.OWN_SPRING)]
        full = work[np.uintp(at + L.PISTON_FULL)] != 0.0
        if par[np.uintp(own + L.OWN_LAG)] > 0.0 and state[L.S_STARTED] != 0.0:
            continue
        change = seed[np.uintp(L.I_PRESSURE + k)] if full or p < spring else 0.0
        dout[np.uintp(L.O_CLUTCH_PISTON_PRESSURE + k)] = change
        if force(par, work, k, drum) > 0.0:
            dout[np.uintp(L.O_CLUTCH_LOAD + 2 * k)] = par[np.uintp(own)] * change


@kernel
def directional_derivative(
    par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array
) -> int:
    """Fill ``dout`` with the change of the real outputs when the inputs change by ``seed``.

    ``work`` is as the last successful step with these inputs left it; its modes stay. A torque of
    exactly 0 counts as standing in the corner of its size: slope 0. Returns 0, or NOT_FINITE.
    """
    clear(dout)
    r, s = par[L.D_RATIO], state[L.S_LAST_DURATION]  # the instant matters after a step only
    washers = par[L.P_WASHERS] * sign_of(inp[L.I_WASHER]) * seed[L.I_WASHER]
    meshes = par[L.D_MESHES] * sign_of(inp[L.I_MESH]) * seed[L.I_MESH]
    meshes += par[L.D_RING_MESHES] * sign_of(inp[L.I_RING_MESH]) * seed[L.I_RING_MESH]
    resists = (washers + meshes) * par[L.D_SPIN] * r / (1.0 + r)
    capacity = dynamics.capacity(work, 0, s)
    clutch = pack_change(par, inp, state, 0, capacity, seed[L.I_CLUTCH])
    brake = pack_change(par, inp, state, 1, dynamics.capacity(work, 1, s), seed[L.I_BRAKE])
    engine, load = seed[L.I_ENGINE], seed[L.I_LOAD]
    rigid = not par[L.P_SHAFT_STIFFNESS] > 0.0
    shaft = load if rigid else 0.0
    # The bearings feel the size of the tooth torque, which feels the bearings.
    side = soft_size_slope(work[L.W_TEETH], dynamics.LIGHT)
    lost = loss_change(par, inp, work, seed)
    free = balance_change(par, work, clutch, brake, resists, engine, shaft, capacity, 0.0, lost)[0]
    none, nothing = (0.0, 0.0), (0.0, 0.0, 0.0)
    back = balance_change(par, work, none, none, 0.0, 0.0, 0.0, capacity, side, nothing)[0]
    teeth = side * free / (1.0 - back)
    tau, carried, held, drag, carrier_rate = balance_change(
        par, work, clutch, brake, resists, engine, shaft, capacity, teeth, lost
    )
    torque = work[L.W_TEETH]
    per_force = 1.0 / (par[L.P_PLANETS] * par[L.D_INPUT_RADIUS])
    per_couple = 2.0 * par[L.D_PLANET_RADIUS] * par[L.D_TAN_HELIX]
    per_load = par[L.P_THRUST_SHARE] / (2.0 * par[L.P_WASHER_RADIUS])
    force = sign_of(torque) * tau * per_force
    couple = per_couple * force
    if par[L.P_NEEDLE_COUNT] > 0.0:
        loads = work[L.W_PLANET_LOADS :]
        loads[0], loads[1], loads[2] = 2.0 * force, 0.0, 0.0
        loads[3] = couple / (0.5 * par[L.P_NEEDLE_LENGTH])
        bears, tilts = washer_changes(par, loads, work[L.W_SETTLED :])
        dout[L.O_WASHER_TILT] = tilts
        if washer_share(par, work[L.W_SETTLED :])[0] > LEAST_WASHER_LOAD:
            dout[L.O_WASHER_LOAD] = bears
    elif per_load * per_couple * abs(torque) * per_force > LEAST_WASHER_LOAD:
        dout[L.O_WASHER_LOAD] = per_load * couple
    dout[L.O_DRIVE_TORQUE], dout[L.O_RESISTANCE_TORQUE] = engine, load
    dout[L.O_SHAFT_TORQUE] = shaft
    dout[L.O_OUTPUT_TORQUE] = shaft + par[L.P_CARRIER_INERTIA] * carrier_rate
    dout[L.O_OUTPUT_ACCELERATION] = carrier_rate if rigid else -load / par[L.P_VEHICLE_INERTIA]
    pressed_change(par, state, work, seed, dout)
    dout[L.O_MESH_LOAD] = force * par[L.D_PLANET_RADIUS]
    dout[L.O_CLUTCH_REACTION], dout[L.O_BRAKE_REACTION] = carried, held
    dout[L.O_INPUT_TOOTH_TORQUE], dout[L.O_DRAG_TORQUE] = tau, drag
    dout[L.O_TOOTH_FORCE], dout[L.O_TILTING_COUPLE] = force, couple
    for k in range(2):
        rubbing = bearing_torque(par, work, k, L.W_Y)
        dout[np.uintp(L.O_SUN_BEARING_TORQUE + k)] = teeth * rubbing
    if state[L.S_STARTED] == 0.0:
        slips = work[L.W_BEARING_DRIVEN] * work[L.W_Y + L.Y_INPUT]
        slips += work[L.W_BEARING_CARRIER] * work[L.W_Y + L.Y_CARRIER]
        dout[L.O_BEARING_POWER] = teeth * slips
        power = lost[0] * work[L.W_Y + L.Y_INPUT] + lost[1] * work[L.W_Y + L.Y_CARRIER]
        dout[L.O_LOSS_POWER] = power
    dout[L.O_SUN_THRUST] = force * par[L.P_PLANETS] * par[L.D_TAN_HELIX]
    return OK if are_finite(dout) else NOT_FINITE
