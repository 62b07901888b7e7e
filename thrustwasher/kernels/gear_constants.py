"""What the parameters of a gear mesh come to before any speed or torque is known."""

import math

import numpy as np
from numpy.typing import NDArray

from . import gear_layout as L
from ._jit import kernel
from .gear_contact import compliance
from .gear_geometry import loss_factor, path_lengths, slide_roll, start_of_contact
from .gear_path import line_of_action

Array = NDArray[np.float64]

SIGMA_ROUGH, SIGMA_FINE = 2.26e-6, 0.566e-6  # m, composite RMS of two ground flanks
ROUGHNESS_ROUGH, ROUGHNESS_FINE = 4.5e-5, 1.5e-5  # S of Li & Seireg
MEAN_OVER_RMS = 1.0 / math.sqrt(2.0)  # Ra of a flank, 1.6 and 0.4 um, over the composite RMS


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
            return L.NOT_FINITE
    return L.OK
