"""What the parameters of a gear mesh come to before any speed or torque is known.

The pair is involute and spur, the pinion drives. Positions on the line of action are counted from
the pinion's base tangent point (0) to the gear's (1); the pitch point lies at 1/(1 + ratio).
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.status import NOT_FINITE, OK
from . import layout as L
from .contact import compliance
from .line_of_action import line_of_action

SIGMA_ROUGH, SIGMA_FINE = 2.26e-6, 0.566e-6  # m, composite RMS of two ground flanks
ROUGHNESS_ROUGH, ROUGHNESS_FINE = 4.5e-5, 1.5e-5  # S of Li & Seireg
MEAN_OVER_RMS = 1.0 / math.sqrt(2.0)  # Ra of a flank, 1.6 and 0.4 um, over the composite RMS

LEAST_EFFECTIVE = 2.143e-5 / 2.873  # the film's term of Li & Seireg's law changes sign there
LARGEST_EFFECTIVE = 0.0864 / 1372.0  # the film has no effect from there on
LEAST_SLIDE_ROLL = 0.27


@kernel
def effective_roughness(par: Array) -> float:
    """Return Li & Seireg's S [-]: as given, or that of the surface."""
    given = par[L.P_EFFECTIVE_ROUGHNESS]
    if given > 0.0:
        return float(given)
    return ROUGHNESS_ROUGH if par[L.P_SURFACE] == L.ROUGH else ROUGHNESS_FINE


@kernel
def derive(par: Array) -> int:
    """Fill the constants behind the parameters; return 0, or NOT_FINITE."""
    ratio, teeth = par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH]
    angle, addendum = par[L.P_PRESSURE_ANGLE], par[L.P_ADDENDUM]
    start = start_of_contact(ratio, teeth, angle, addendum)
    approach, recess = path_lengths(ratio, teeth, angle, addendum, start)
    line = par[L.P_CENTRE_DISTANCE] * math.sin(angle)
    pitch = par[L.P_CENTRE_DISTANCE] / (1.0 + ratio)
    par[L.D_START] = start
    par[L.D_SLIDE_ROLL] = slide_roll(ratio, start)
    par[L.D_CONTACT_RATIO] = approach + recess
    par[L.D_RADIUS] = start * (1.0 - start) * line
    par[L.D_LINE] = par[L.P_LOAD_SHARE] / (par[L.P_FACE_WIDTH] * pitch * math.cos(angle))
    par[L.D_V1] = start * line
    par[L.D_V2] = (1.0 - start) * line / ratio
    par[L.D_SLIDING] = line * (1.0 - (1.0 + ratio) * start) / ratio
    par[L.D_ROLLING] = 2.0 * pitch * math.sin(angle)
    par[L.D_PITCH_RADIUS] = line * ratio / ((1.0 + ratio) * (1.0 + ratio))
    par[L.D_LOSS] = loss_factor(ratio, teeth, approach, recess)
    par[L.D_THETA] = compliance(par[L.P_YOUNGS_MODULUS], par[L.P_POISSON_RATIO])
    par[L.D_CAPACITY] = par[L.P_DENSITY] * par[L.P_HEAT_CAPACITY]
    par[L.D_OIL_CAPACITY] = par[L.P_OIL_DENSITY] * par[L.P_OIL_HEAT_CAPACITY]
    par[L.D_EFFUSIVITY] = math.sqrt(par[L.P_CONDUCTIVITY] * par[L.D_CAPACITY])
    rough = par[L.P_SURFACE] == L.ROUGH
    sigma = SIGMA_ROUGH if rough else SIGMA_FINE
    par[L.D_SIGMA] = par[L.P_SIGMA_RMS] if par[L.P_SIGMA_RMS] > 0.0 else sigma
    par[L.D_ROUGHNESS] = effective_roughness(par)
    mean = MEAN_OVER_RMS * par[L.D_SIGMA]
    par[L.D_MEAN] = par[L.P_MEAN_ROUGHNESS] if par[L.P_MEAN_ROUGHNESS] > 0.0 else mean
    by_speed = math.sqrt(par[L.D_V1]) / (math.sqrt(par[L.D_V1]) + math.sqrt(par[L.D_V2]))
    constant = par[L.P_HEAT_PARTITION] == L.CONSTANT_SHARE and par[L.P_FIDELITY] != L.CLOSED
    par[L.D_SHARE] = par[L.P_PARTITION_SHARE] if constant else by_speed
    par[L.D_PLACES] = 0.0
    if par[L.P_FIDELITY] == L.FINE:
        line_of_action(par, approach, recess)
    for i in range(L.N_PARAM, L.D_POSITION):
        if not math.isfinite(par[np.uintp(i)]):
            return NOT_FINITE
    return OK


@kernel
def start_of_contact(ratio: float, teeth: float, angle: float, addendum: float) -> float:
    """Return the position x_s [-] where contact starts: the gear's addendum circle cuts the line.

    ``ratio`` gear over pinion teeth, ``teeth`` of the pinion, pressure ``angle`` [rad],
    ``addendum`` over module. Not above 0: the tip of the gear meets no involute (interference).
    """
    base = ratio * math.cos(angle)
    tip = ratio + 2.0 * addendum / teeth
    return 1.0 - math.sqrt(tip * tip - base * base) / ((1.0 + ratio) * math.sin(angle))


@kernel
def least_teeth(ratio: float, angle: float, addendum: float) -> float:
    """Return the (real) number of pinion teeth at which x_s = 0."""
    s = math.sin(angle) * math.sin(angle) * (1.0 + 2.0 * ratio)
    return 2.0 * addendum * (ratio + math.sqrt(ratio * ratio + s)) / s


@kernel
def slide_roll(ratio: float, start: float) -> float:
    """Return sliding speed over mean rolling speed [-], 2 |V2 - V1|/(V1 + V2), at ``start``."""
    slide = abs(1.0 - (1.0 + ratio) * start)
    return 2.0 * slide / (1.0 + (ratio - 1.0) * start)


@kernel
def path_lengths(
    ratio: float, teeth: float, angle: float, addendum: float, start: float
) -> tuple[float, float]:
    """Return (approach, recess): the path before and after the pitch point, in base pitches."""
    line = 0.5 * teeth * (1.0 + ratio) * math.sin(angle)  # C sin(angle) over module
    pitch = math.pi * math.cos(angle)
    approach = (1.0 / (1.0 + ratio) - start) * line / pitch
    tip, base = 0.5 * teeth + addendum, 0.5 * teeth * math.cos(angle)
    recess = (math.sqrt(tip * tip - base * base) - 0.5 * teeth * math.sin(angle)) / pitch
    return approach, recess


@kernel
def _moment(low: float, high: float) -> float:
    """Return the integral of |s| from ``low`` to ``high``."""
    return 0.5 * (high * abs(high) - low * abs(low))


@kernel
def loss_factor(ratio: float, teeth: float, approach: float, recess: float) -> float:
    """Return H_v [-]: the power lost over the power transmitted, for a friction coefficient of 1.

    Mean over the path of contact when the pairs in contact share the load equally, at any time as
    many as there are: for a contact ratio e from 1 to 2, with the pitch point where one pair is
    alone, it is Ohlendorf's pi (M + 1)/(N M) (1 - e + e1^2 + e2^2).
    """
    whole = math.floor(approach + recess)
    more = approach + recess - whole  # stretch of a pitch with one pair more than `whole`
    total = 0.0
    for k in range(int(min(whole, 100.0)) + 1):
        low = -approach + k
        total += _moment(low, low + more) / (whole + 1.0)
        if k < whole:
            total += _moment(low + more, low + 1.0) / max(whole, 1.0)
    return 2.0 * math.pi * (ratio + 1.0) / (teeth * ratio) * total


@kernel
def broken_rule(par: Array) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    ratio, teeth = par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH]
    angle, addendum = par[L.P_PRESSURE_ANGLE], par[L.P_ADDENDUM]
    start = start_of_contact(ratio, teeth, angle, addendum)
    if not start > 0.0:
        return 1
    approach, recess = path_lengths(ratio, teeth, angle, addendum, start)
    if not approach + recess >= 1.0:
        return 2
    if par[L.P_FRICTION_LAW] == L.LI_SEIREG:
        s = effective_roughness(par)
        if not LEAST_EFFECTIVE < s < LARGEST_EFFECTIVE:
            return 3
        if not par[L.P_F0] >= 0.0864 - 1372.0 * s:
            return 4
        if not slide_roll(ratio, start) > LEAST_SLIDE_ROLL:
            return 5
    return 0
