# mypy: disable-error-code="no-any-return"
"""What every level of the washer makes of parameters and inputs, and what it says of its result."""

import math

import numpy as np

from ...numerics.jit import Array, Ints, kernel
from ...numerics.status import DISTRESS, HOT, OK, OUTSIDE_MAP, OUTSIDE_VERIFIED
from . import layout as L
from .constants import combined_roughness, contact_pair, summits
from .workspace import Point

FILM, MIXED, BOUNDARY = 1, 2, 3  # regimes
LEAST_TILT = 1e-9  # [rad]; less counts as none: a wedge of 0.02 nm has lift of no account
LEAST_LOAD = 1.0  # [N]; an unloaded washer counts as loaded so much
LEAST_SPEED = 1e-100  # [rad/s]; a washer that turns turns so fast: pressures stay in range
LARGEST_SPREAD = 20.0  # outer over inner radius
LEAST_ROUGHNESS = 1.5e-7  # [m]
LEAST_MODULUS, LEAST_STRENGTH = 1e9, 1e7  # [Pa] of a body, as in its parameters
LEAST_CONDUCTIVITY, LEAST_DENSITY, LEAST_SPECIFIC_HEAT = 0.1, 500.0, 50.0
LEAST_TEMPERATURE = 233.15  # [K] of the oil that is supplied
LARGEST_VERIFIED = (3000.0, 1500.0, 0.004)  # load [N], speed [rad/s], tilt [rad]
VERIFIED_OIL = (260.0, 420.0)  # [K]
LARGEST_RISE = 200.0  # [K] mean rise that counts as distress


@kernel
def _too_small(par: Array, place: int, least: float) -> bool:
    """Tell if a value that may be 0, for the common one, is given and below its range."""
    return bool(0.0 < par[np.uintp(place)] < least)


@kernel
def broken_rule(par: Array) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    if not par[L.P_INNER_RADIUS] < par[L.P_GEAR_INNER_RADIUS] < par[L.P_OUTER_RADIUS]:
        return 1
    if not par[L.P_OUTER_RADIUS] <= LARGEST_SPREAD * par[L.P_INNER_RADIUS]:
        return 2
    for k in range(3):
        if _too_small(par, L.P_ROUGHNESS + 1 + k, LEAST_ROUGHNESS):
            return 3 + k
    if not par[L.P_FRICTION_PRESSURE_MIN] < par[L.P_FRICTION_PRESSURE_MAX]:
        return 6
    sigma1, sigma2, _ = combined_roughness(par)
    _, _, first = summits(par, sigma1)
    _, _, second = summits(par, sigma2)
    if not (first and second):
        return 7
    for k in range(3):
        if _too_small(par, L.P_YOUNGS_MODULUS + 1 + k, LEAST_MODULUS):
            return 8 + k
        if _too_small(par, L.P_YIELD_STRENGTH + 1 + k, LEAST_STRENGTH):
            return 11 + k
        if _too_small(par, L.P_CONDUCTIVITY + 1 + k, LEAST_CONDUCTIVITY):
            return 14 + k
        if _too_small(par, L.P_DENSITY + 1 + k, LEAST_DENSITY):
            return 17 + k
        if _too_small(par, L.P_SPECIFIC_HEAT + 1 + k, LEAST_SPECIFIC_HEAT):
            return 20 + k
    for k in range(2):
        pair = contact_pair(par, L.OF_CARRIER + 2 * k)
        if not pair.yield_strength <= pair.contact_modulus:
            return 23 + k
    if _too_small(par, L.P_OIL_SUPPLY_TEMPERATURE, LEAST_TEMPERATURE):
        return 25
    cooled = par[L.P_OIL_COOLING] != 0.0
    if cooled and par[L.P_FILM_HEAT_FRACTION] != 1.0:
        return 26
    if not cooled and par[L.P_CAVITY_SHEAR] == L.ONLY_LIQUID:
        return 27
    # the fidelity may be unknown yet
    if par.size >= L.N_PARAM and not par[L.P_FIDELITY] > L.MAP:
        if par[L.P_THERMAL_MODE] == L.TRANSIENT:
            return 28
        if par[L.P_GEAR_FAR_FACE] == L.BULK:
            return 29
    return 0


@kernel
def is_bad(inp: Array) -> bool:
    """Tell if an input is not finite, the tilt negative, or the far face too cold."""
    total = inp[L.I_LOAD] + inp[L.I_SPEED] + inp[L.I_TILT] + inp[L.I_OIL] + inp[L.I_FAR_FACE]
    if not math.isfinite(total) or inp[L.I_TILT] < 0.0:
        return True
    return bool(inp[L.I_FAR_FACE] != 0.0 and inp[L.I_FAR_FACE] < LEAST_TEMPERATURE)


@kernel
def _follows_oil(par: Array, inp: Array) -> bool:
    """Tell if the gear's far face counts as warm as the oil."""
    return bool(par[L.P_GEAR_FAR_FACE] != L.BULK or inp[L.I_FAR_FACE] == 0.0)


@kernel
def point_of(par: Array, inp: Array) -> Point:
    """Return the operating point: inputs as they count."""
    tilt = inp[L.I_TILT] if inp[L.I_TILT] > LEAST_TILT else 0.0
    speed = inp[L.I_SPEED]
    if 0.0 < abs(speed) < LEAST_SPEED:
        speed = math.copysign(LEAST_SPEED, speed)
    far_face = inp[L.I_OIL] if _follows_oil(par, inp) else inp[L.I_FAR_FACE]
    return Point(max(inp[L.I_LOAD], LEAST_LOAD), speed, tilt, inp[L.I_OIL], far_face)


@kernel
def change_of(par: Array, inp: Array, seed: Array) -> Point:
    """Return how the operating point changes; an input held at its bound does not."""
    dload = seed[L.I_LOAD] if inp[L.I_LOAD] > LEAST_LOAD else 0.0
    dtilt = seed[L.I_TILT] if inp[L.I_TILT] > LEAST_TILT else 0.0
    dfar_face = seed[L.I_OIL] if _follows_oil(par, inp) else seed[L.I_FAR_FACE]
    return Point(dload, seed[L.I_SPEED], dtilt, seed[L.I_OIL], dfar_face)


@kernel
def is_verified(pt: Point) -> bool:
    """Tell if the operating point is inside the range that the tests cover."""
    return (
        pt.load <= LARGEST_VERIFIED[0]
        and abs(pt.speed) <= LARGEST_VERIFIED[1]
        and pt.tilt <= LARGEST_VERIFIED[2]
        and VERIFIED_OIL[0] <= pt.oil_temperature <= VERIFIED_OIL[1]
    )


@kernel
def regime_of(ratio: float) -> int:
    """Return the regime's number at a film ratio."""
    if ratio > 3.0:
        return FILM
    return MIXED if ratio >= 1.0 else BOUNDARY


@kernel
def tell_outside_map(iout: Ints) -> None:
    """Say that the point is not in the map's box, unless there is worse to say."""
    if iout[L.IO_STATUS] == OK or iout[L.IO_STATUS] == OUTSIDE_VERIFIED:
        iout[L.IO_STATUS] = OUTSIDE_MAP


@kernel
def judge(pt: Point, out: Array, distressed: bool, status: int, iout: Ints) -> None:
    """Fill ``iout`` for ``out``: regime, distress, and the status or the advice in its place."""
    iout[L.IO_REGIME] = regime_of(out[L.O_RATIO])
    iout[L.IO_DISTRESS] = 1 if distressed else 0
    iout[L.IO_STATUS] = status
    if status == OK and distressed:
        iout[L.IO_STATUS] = DISTRESS
    elif status == OK and out[L.O_PEAK] > L.HOT_LIMIT:
        iout[L.IO_STATUS] = HOT
    elif status == OK and not is_verified(pt):
        iout[L.IO_STATUS] = OUTSIDE_VERIFIED
