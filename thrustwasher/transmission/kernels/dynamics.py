# mypy: disable-error-code="no-any-return"
"""Dynamics of the planetary set: torques and accelerations for given modes of clutch and brake.

The driven gear is the sun or the ring (``arrangement``), the other one has the drum that the brake
holds; r is its teeth over those of the driven gear. Unknowns are the speeds of driven gear and
carrier; the drum follows from the teeth, so that a drum without inertia is an ordinary case. Clutch
and drag act on the same slip: the drag is carried along as the clutch torque that does the same
work, X = T_clutch + T_drag r/(1 + r).

Thrust bearings of sun and ring rub with a part of the tooth torque, which follows from the
accelerations they take part in: an implicit relation, solved to rounding. The bearings take the
same torque from the motion as they turn into heat, and so do losses that come from outside.

With a stiffness the shaft behind the carrier is a spring and a damper to the vehicle, which then
has a speed of its own and meets the load. Without, the carrier is the vehicle.
"""

import math

import numpy as np

from ...numerics.arrays import are_finite
from ...numerics.jit import Array, kernel
from ...numerics.smoothing import soft_size
from ...numerics.status import NOT_FINITE, OK
from . import layout as L
from .planet_bearing import derive_needles
from .shaft_losses import loss_power, turn_losses
from .thrust_bearings import bearing_power, broken_bearing, derive_bearings, turn_bearings

# Dormand & Prince (1980): stage times, stage weights row by row, and fifth minus fourth order.
C = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
A = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
    [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
    [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
    [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
    [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
])  # fmt: skip
B_ERROR = np.array([
    71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40,
])  # fmt: skip
SPEED_SCALE = 1.0  # rad/s: smaller speeds are kept to an absolute error
TWIST_SCALE = 0.01  # rad
ENERGY_SCALE = 100.0  # J
SLOW = 0.1  # rad/s: rolling resistance passes through zero over it
LIGHT = 0.1  # N m of the teeth, within which the thrust bearings' friction is rounded at none
MAX_SECANTS = 12
SAME = 1e-14  # of the tooth torque: rounding
LOOSE = 1e-9  # of it: what a secant that has not ended may leave


@kernel
def derive(par: Array) -> int:
    """Fill the constants behind the parameters; return 0, or NOT_FINITE."""
    sun, ring = par[L.P_SUN_TEETH], par[L.P_RING_TEETH]
    planet = par[L.P_PLANET_TEETH]
    if planet == 0.0:
        planet = 0.5 * (ring - sun)
    driven, drum = (ring, sun) if par[L.P_ARRANGEMENT] == L.RING_INPUT else (sun, ring)
    r = drum / driven
    par[L.D_RATIO] = r
    par[L.D_SPIN] = driven / planet
    pitch = 0.5 * par[L.P_NORMAL_MODULE] / math.cos(par[L.P_HELIX_ANGLE])
    par[L.D_INPUT_RADIUS] = pitch * driven
    par[L.D_PLANET_RADIUS] = pitch * planet
    par[L.D_TAN_HELIX] = math.tan(par[L.P_HELIX_ANGLE])
    ring_share = (1.0 / planet - 1.0 / ring) / (1.0 / planet + 1.0 / sun)
    apart = par[L.P_RING_MESH]
    par[L.D_MESHES] = par[L.P_PLANETS] * (1.0 + (1.0 - apart) * ring_share)
    par[L.D_RING_MESHES] = par[L.P_PLANETS] * apart

    drum_inertia = par[L.P_DRUM_INERTIA] / (r * r)
    m_ss = par[L.P_INPUT_INERTIA] + drum_inertia
    m_sc = -drum_inertia * (1.0 + r)
    m_cc = par[L.P_CARRIER_INERTIA] + drum_inertia * (1.0 + r) * (1.0 + r)
    det = m_ss * m_cc - m_sc * m_sc
    i_ss, i_sc, i_cc = m_cc / det, -m_sc / det, m_ss / det
    par[L.D_INV_SS], par[L.D_INV_SC], par[L.D_INV_CC] = i_ss, i_sc, i_cc
    # Slips from speeds: clutch = c (driven - carrier), brake = c carrier - b driven.
    c, b = (1.0 + r) / r, 1.0 / r
    par[L.D_SLIP_CC] = c * c * (i_ss - 2.0 * i_sc + i_cc)
    par[L.D_SLIP_CB] = c * (c * (i_sc - i_cc) - b * (i_ss - i_sc))
    par[L.D_SLIP_BB] = c * c * i_cc - 2.0 * b * c * i_sc + b * b * i_ss
    inner, outer = par[L.P_PISTON_INNER_RADIUS], par[L.P_PISTON_OUTER_RADIUS]
    supply = 2.0 * par[L.P_PISTON_SUPPLY_RADIUS] ** 2
    moment = outer**4 - inner**4 - supply * (outer**2 - inner**2)
    par[L.D_HEAD] = 0.25 * math.pi * par[L.P_OIL_DENSITY] * moment * (1.0 - par[L.P_BALANCE_SHARE])
    derive_bearings(par)
    derive_needles(par)
    return OK if are_finite(par[L.N_PARAM :]) else NOT_FINITE


@kernel
def drum_speed(r: float, driven: float, carrier: float) -> float:
    """Return the speed of the drum [rad/s]; exactly 0 if driven = (1 + r) carrier."""
    return ((1.0 + r) * carrier - driven) / r


@kernel
def clutch_slip(r: float, driven: float, carrier: float) -> float:
    """Return the slip of the clutch, driven minus drum [rad/s]; exactly 0 if driven = carrier."""
    return (1.0 + r) / r * (driven - carrier)


@kernel
def load_torque(par: Array, work: Array, speed: float) -> float:
    """Return the torque of the load [N m] at a speed of what it acts on [rad/s]."""
    x = speed / par[L.P_LOAD_SPEED]
    load = math.copysign(par[L.P_LOAD_TORQUE] * x * x, speed)
    rolling = par[L.P_ROLLING_TORQUE] * speed / math.hypot(speed, SLOW)
    return load + (rolling + par[L.P_GRADE_TORQUE] + work[L.W_LOAD_GIVEN])


@kernel
def vehicle_speed(par: Array, work: Array, y: int) -> float:
    """Return the speed of the vehicle [rad/s] for the vector at ``work[y:]``."""
    at = L.Y_VEHICLE if par[L.P_SHAFT_STIFFNESS] > 0.0 else L.Y_CARRIER
    return float(work[np.uintp(y + at)])


@kernel
def output_torque(par: Array, work: Array, y: int) -> float:
    """Return the torque against the carrier [N m] for ``work[y:]``: the shaft's, or the load's."""
    stiffness = par[L.P_SHAFT_STIFFNESS]
    carrier = work[np.uintp(y + L.Y_CARRIER)]
    if not stiffness > 0.0:
        return load_torque(par, work, carrier)
    twisting = carrier - work[np.uintp(y + L.Y_VEHICLE)]
    return stiffness * work[np.uintp(y + L.Y_TWIST)] + par[L.P_SHAFT_DAMPING] * twisting


@kernel
def capacity(work: Array, pack: int, s: float) -> float:
    """Return the capacity of clutch (0), without drag, or brake (1) [N m], ``s`` into the step."""
    start, slope = L.W_CLUTCH_START + 2 * pack, L.W_CLUTCH_SLOPE + 2 * pack
    return max(0.0, work[np.uintp(start)] + work[np.uintp(slope)] * s)


@kernel
def clutch_share(par: Array, work: Array, s: float) -> float:
    """Return the part of X that the clutch itself carries [N m]; drag takes the rest.

    A stuck clutch holds what it can; only beyond its capacity does the drag of the planets help.
    """
    given, mode = work[L.W_CLUTCH_GIVEN], work[L.W_CLUTCH_MODE]
    own = capacity(work, 0, s)
    if mode != L.STUCK:
        return given + mode * own
    if work[L.W_DRAG] == 0.0:
        return work[L.W_CLUTCH]
    return given + min(max(work[L.W_CLUTCH] - given, -own), own)


@kernel
def solve_torques(par: Array, work: Array, s: float, y: int) -> None:
    """Fill the torques X and T_brake and the accelerations for the modes in ``work``.

    ``work[y:]`` are speeds and twist. With thrust bearings the size of the tooth torque is found
    for which the balance gives that size; the map has a slope of 0.4 at most (``broken_rule``) and
    no corner but that of the clutch's share, so a secant ends in two or three steps. Should it not
    end the accelerations are NaN.
    """
    load = output_torque(par, work, y)
    turn_bearings(par, work, y)
    turn_losses(par, work, y)
    size = balance(par, work, s, load, 0.0)
    if work[L.W_BEARING_DRIVEN] == 0.0 and work[L.W_BEARING_CARRIER] == 0.0:
        return
    last, last_gap, gap = 0.0, size, size
    for _ in range(MAX_SECANTS):
        gap = balance(par, work, s, load, size) - size
        if abs(gap) <= SAME * size or gap == last_gap:
            return
        size, last, last_gap = size - gap * (size - last) / (gap - last_gap), size, gap
    if not abs(gap) <= LOOSE * abs(size):  # no step is made of it: its status is NOT_FINITE
        work[L.W_INPUT_RATE] = work[L.W_CARRIER_RATE] = math.nan


@kernel
def balance(par: Array, work: Array, s: float, load: float, teeth: float) -> float:
    """Fill torques and accelerations, bearings loaded by ``teeth`` [N m]; return the tooth torque.

    A slipping pack has its capacity with the sign of its mode; a stuck one the torque that keeps
    its slip acceleration at zero (a 2 x 2 system if both stick). ``load`` resists the carrier. What
    is returned is the size of the torque in the driven gear's teeth.
    """
    r = par[L.D_RATIO]
    i_ss, i_sc, i_cc = par[L.D_INV_SS], par[L.D_INV_SC], par[L.D_INV_CC]
    s_cc, s_cb, s_bb = par[L.D_SLIP_CC], par[L.D_SLIP_CB], par[L.D_SLIP_BB]
    c, b = (1.0 + r) / r, 1.0 / r
    engine = work[L.W_ENGINE_START] + work[L.W_ENGINE_SLOPE] * s
    work[L.W_ENGINE] = engine
    drives = engine - work[L.W_LOSS_DRIVEN] - teeth * work[L.W_BEARING_DRIVEN]
    resists = load + work[L.W_LOSS_CARRIER] + teeth * work[L.W_BEARING_CARRIER]
    free_driven = i_ss * drives - i_sc * resists
    free_carrier = i_sc * drives - i_cc * resists
    free_clutch = c * (free_driven - free_carrier)
    free_brake = c * free_carrier - b * free_driven

    clutch_mode, brake_mode = work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE]
    x = work[L.W_CLUTCH_GIVEN] + clutch_mode * (capacity(work, 0, s) + work[L.W_DRAG])
    brake = work[L.W_BRAKE_GIVEN] + brake_mode * capacity(work, 1, s)
    if clutch_mode == L.STUCK and brake_mode == L.STUCK:
        det = s_cc * s_bb - s_cb * s_cb
        x = (s_bb * free_clutch - s_cb * free_brake) / det
        brake = (s_cc * free_brake - s_cb * free_clutch) / det
    elif clutch_mode == L.STUCK:
        x = (free_clutch - s_cb * brake) / s_cc
    elif brake_mode == L.STUCK:
        brake = (free_brake - s_cb * x) / s_bb

    driven_side = drives - c * x + b * brake
    carrier_side = c * x - c * brake - resists
    work[L.W_CLUTCH], work[L.W_BRAKE] = x, brake
    work[L.W_INPUT_RATE] = i_ss * driven_side + i_sc * carrier_side
    work[L.W_CARRIER_RATE] = i_sc * driven_side + i_cc * carrier_side
    own = clutch_share(par, work, s)
    drag = (x - own) * (1.0 + r) / r
    tau = engine - own - drag - par[L.P_INPUT_INERTIA] * work[L.W_INPUT_RATE]
    tau -= work[L.W_LOSS_OWN]
    work[L.W_BEARING_TEETH] = teeth
    work[L.W_TEETH] = tau - teeth * work[L.W_BEARING_OWN]
    return soft_size(work[L.W_TEETH], LIGHT)


@kernel
def rates(par: Array, work: Array, s: float, y: int, slopes: int) -> None:
    """Write the time derivatives of the vector at ``work[y:]`` to ``work[slopes:]``.

    The heats are integrated with the same solution as the speeds, so that the energy book closes
    to the integrator's tolerance.
    """
    driven, carrier = work[np.uintp(y + L.Y_INPUT)], work[np.uintp(y + L.Y_CARRIER)]
    solve_torques(par, work, s, y)
    work[np.uintp(slopes + L.Y_INPUT)] = work[L.W_INPUT_RATE]
    work[np.uintp(slopes + L.Y_CARRIER)] = work[L.W_CARRIER_RATE]
    work[np.uintp(slopes + L.Y_ENGINE)] = work[L.W_ENGINE] * driven
    vehicle = vehicle_speed(par, work, y)
    load = load_torque(par, work, vehicle)
    work[np.uintp(slopes + L.Y_LOAD)] = load * vehicle
    twisting, acceleration = 0.0, 0.0
    if par[L.P_SHAFT_STIFFNESS] > 0.0:
        twisting = carrier - vehicle
        acceleration = (output_torque(par, work, y) - load) / par[L.P_VEHICLE_INERTIA]
    work[np.uintp(slopes + L.Y_VEHICLE)] = acceleration
    work[np.uintp(slopes + L.Y_TWIST)] = twisting
    work[np.uintp(slopes + L.Y_SHAFT)] = par[L.P_SHAFT_DAMPING] * twisting * twisting
    r = par[L.D_RATIO]
    clutch_heat, washer_heat, mesh_heat, brake_heat = 0.0, 0.0, 0.0, 0.0
    if work[L.W_CLUTCH_MODE] != L.STUCK:
        clutch_heat = clutch_share(par, work, s) * clutch_slip(r, driven, carrier)
        spin = par[L.D_SPIN] * (driven - carrier) * work[L.W_CLUTCH_MODE]
        washer_heat = work[L.W_WASHERS] * spin
        mesh_heat = work[L.W_MESHES] * spin
    if work[L.W_BRAKE_MODE] != L.STUCK:
        brake_heat = work[L.W_BRAKE] * drum_speed(r, driven, carrier)
    work[np.uintp(slopes + L.Y_CLUTCH)] = clutch_heat
    work[np.uintp(slopes + L.Y_BRAKE)] = brake_heat
    work[np.uintp(slopes + L.Y_WASHER)] = washer_heat
    work[np.uintp(slopes + L.Y_MESH)] = mesh_heat
    work[np.uintp(slopes + L.Y_BEARING)] = bearing_power(par, work, y)
    work[np.uintp(slopes + L.Y_LOSS)] = loss_power(work, y)


@kernel
def kinetic_energy(par: Array, driven: float, carrier: float, vehicle: float) -> float:
    """Return the kinetic energy of driven, drum, carrier and vehicle [J]."""
    drum = drum_speed(par[L.D_RATIO], driven, carrier)
    energy = 0.5 * (
        par[L.P_INPUT_INERTIA] * driven * driven
        + par[L.P_DRUM_INERTIA] * drum * drum
        + par[L.P_CARRIER_INERTIA] * carrier * carrier
    )
    if par[L.P_SHAFT_STIFFNESS] > 0.0:
        energy += 0.5 * par[L.P_VEHICLE_INERTIA] * vehicle * vehicle
    return energy


@kernel
def spring_energy(par: Array, twist: float) -> float:
    """Return the energy of the shaft's spring [J] since the start at a twist [rad]."""
    start = par[L.P_INITIAL_TWIST]
    return 0.5 * par[L.P_SHAFT_STIFFNESS] * (twist - start) * (twist + start)


@kernel
def broken_rule(par: Array) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    sun, planet, ring = par[L.P_SUN_TEETH], par[L.P_PLANET_TEETH], par[L.P_RING_TEETH]
    if not ring > sun:
        return 1
    if planet != 0.0 and abs(ring - sun - 2.0 * planet) > 2.0 * par[L.P_PROFILE_SHIFTED]:
        return 2
    if par[L.P_SHAFT_STIFFNESS] == 0.0:
        if par[L.P_SHAFT_DAMPING] != 0.0:
            return 3
        if par[L.P_INITIAL_TWIST] != 0.0:
            return 4
    planets = par[L.P_PLANETS]
    apart = (sun + ring) / planets  # teeth between two planets, on both gears together
    if planet != 0.0 and apart != math.floor(apart):
        return 5
    if planet != 0.0 and planets > 1.0:
        if not (sun + planet) * math.sin(math.pi / planets) > planet + 2.0:
            return 6
    inner, outer = par[L.P_PISTON_INNER_RADIUS], par[L.P_PISTON_OUTER_RADIUS]
    if outer < inner:
        return 7
    if par[L.P_PISTON_SUPPLY_RADIUS] > outer:
        return 8
    for which in range(3):
        first = L.P_CLUTCH_PROFILE + which * L.N_PROFILE
        for i in range(1, int(par[np.uintp(first)])):
            if not par[np.uintp(first + 1 + i)] > par[np.uintp(first + i)]:
                return 9 + which
    return broken_bearing(par)


@kernel
def trial_step(par: Array, work: Array, s: float, h: float) -> float:
    """Fill ``work[W_NEW:]`` with the solution ``h`` seconds after ``s``; return the error ratio.

    The error ratio is the embedded estimate over the tolerance, 1 is just acceptable. The slope at
    the end lies in the last stage.
    """
    for stage in range(L.N_STAGES):
        for i in range(L.N_Y):
            total = 0.0
            for k in range(stage):
                slope = work[np.uintp(L.W_SLOPES + k * L.N_Y + i)]
                total += A[np.uintp(stage), np.uintp(k)] * slope
            work[np.uintp(L.W_STAGE + i)] = work[np.uintp(L.W_Y + i)] + h * total
        rates(par, work, s + C[np.uintp(stage)] * h, L.W_STAGE, L.W_SLOPES + stage * L.N_Y)
    worst = 0.0
    for i in range(L.N_Y):
        error = 0.0
        for k in range(L.N_STAGES):
            error += B_ERROR[np.uintp(k)] * work[np.uintp(L.W_SLOPES + k * L.N_Y + i)]
        new = work[np.uintp(L.W_STAGE + i)]  # the last stage is the fifth-order result
        work[np.uintp(L.W_NEW + i)] = new
        scale = ENERGY_SCALE
        if i == L.Y_TWIST:
            scale = TWIST_SCALE
        elif i <= L.Y_VEHICLE:
            scale = SPEED_SCALE
        worst = max(worst, abs(h * error) / (par[L.P_TOLERANCE] * (scale + abs(new))))
    return worst
