# mypy: disable-error-code="no-any-return"
"""What the thrust bearings of sun and ring take from the shafts they lie between.

A bearing rubs with coefficient x thrust x mean radius, and the thrust is a part of the tooth
torque: all torques here are per size of the torque in the driven gear's teeth.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import layout as L

SLOW = 1.0  # rad/s: a bearing's torque passes through zero over it
MOST = 0.1  # of the sun's pitch radius: coefficient x mean radius x tan(helix) of a bearing
FIRST_RULE = 12


@kernel
def derive_bearings(par: Array) -> None:
    """Fill the constants of both thrust bearings.

    The sun's thrust is tan(helix)/r_A for every N m in the teeth of the driven gear A, and so is
    the ring's, against it.
    """
    r, thrust = par[L.D_RATIO], par[L.D_TAN_HELIX] / par[L.D_INPUT_RADIUS]
    driven = L.RING if par[L.P_ARRANGEMENT] == L.RING_INPUT else L.SUN
    for k in range(2):
        own, at = L.P_SUN_BEARING_SHAFT_1 + k * L.N_BEARING, L.D_BEARINGS + k * L.N_TURNING
        slip_driven, slip_carrier, direct = 0.0, 0.0, 0.0
        for end in range(2):
            shaft, sign = par[np.uintp(own + end)], 1.0 - 2.0 * end
            if shaft == driven:
                slip_driven += sign
                direct += sign
            elif shaft == L.CARRIER:
                slip_carrier += sign
            elif shaft != L.CASE:  # the drum, from the teeth
                slip_driven -= sign / r
                slip_carrier += sign * (1.0 + r) / r
        rubbing = par[np.uintp(own + 2)] * par[np.uintp(own + 3)]
        par[np.uintp(at + L.BEARING_TORQUE)] = rubbing * thrust
        par[np.uintp(at + L.BEARING_DRIVEN)] = slip_driven
        par[np.uintp(at + L.BEARING_CARRIER)] = slip_carrier
        par[np.uintp(at + L.BEARING_OWN)] = direct


@kernel
def bearing_slip(par: Array, work: Array, bearing: int, y: int) -> float:
    """Return the speed of a bearing's first shaft against its second [rad/s] for ``work[y:]``."""
    at = L.D_BEARINGS + bearing * L.N_TURNING
    of_driven = par[np.uintp(at + L.BEARING_DRIVEN)] * work[np.uintp(y + L.Y_INPUT)]
    return float(
        of_driven + par[np.uintp(at + L.BEARING_CARRIER)] * work[np.uintp(y + L.Y_CARRIER)]
    )


@kernel
def bearing_torque(par: Array, work: Array, bearing: int, y: int) -> float:
    """Return a bearing's torque against its first shaft per tooth torque, for ``work[y:]``."""
    rubbing = par[np.uintp(L.D_BEARINGS + bearing * L.N_TURNING + L.BEARING_TORQUE)]
    if rubbing == 0.0:
        return 0.0
    return float(rubbing * math.tanh(bearing_slip(par, work, bearing, y) / SLOW))


@kernel
def turn_bearings(par: Array, work: Array, y: int) -> None:
    """Fill what both bearings take from driven gear and carrier, per size of the tooth torque."""
    driven, carrier, direct = 0.0, 0.0, 0.0
    for k in range(2):
        torque, at = bearing_torque(par, work, k, y), L.D_BEARINGS + k * L.N_TURNING
        driven += torque * par[np.uintp(at + L.BEARING_DRIVEN)]
        carrier += torque * par[np.uintp(at + L.BEARING_CARRIER)]
        direct += torque * par[np.uintp(at + L.BEARING_OWN)]
    work[L.W_BEARING_DRIVEN], work[L.W_BEARING_CARRIER] = driven, carrier
    work[L.W_BEARING_OWN] = direct


@kernel
def bearing_power(par: Array, work: Array, y: int) -> float:
    """Return the heat of both bearings [W], after ``solve_torques`` for ``work[y:]``."""
    driven, carrier = work[np.uintp(y + L.Y_INPUT)], work[np.uintp(y + L.Y_CARRIER)]
    slips = work[L.W_BEARING_DRIVEN] * driven + work[L.W_BEARING_CARRIER] * carrier
    return float(work[L.W_BEARING_TEETH] * slips)


@kernel
def broken_bearing(par: Array) -> int:
    """Return the number of the first rule that a bearing breaks, or 0: ends, then friction."""
    helix = par[L.P_HELIX_ANGLE]
    pitch = 0.5 * par[L.P_NORMAL_MODULE] / math.cos(helix) * par[L.P_SUN_TEETH]
    for k in range(2):
        own = L.P_SUN_BEARING_SHAFT_1 + k * L.N_BEARING
        if par[np.uintp(own)] == par[np.uintp(own + 1)]:
            return FIRST_RULE + k
    for k in range(2):
        own = L.P_SUN_BEARING_SHAFT_1 + k * L.N_BEARING
        if par[np.uintp(own + 2)] * par[np.uintp(own + 3)] * math.tan(helix) > MOST * pitch:
            return FIRST_RULE + 2 + k
    return 0
