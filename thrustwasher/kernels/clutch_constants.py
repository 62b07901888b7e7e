"""Constants of a pack behind its parameters: areas, friction, film, heat."""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .boundary import ploughing
from .clutch_layout import (
    D_ADHESION,
    D_AREA,
    D_CAPACITY,
    D_CLOSING,
    D_CONTACT_AREA,
    D_COOLING,
    D_DECAY,
    D_DEMAND,
    D_GAIN,
    D_MODES,
    D_OPEN_RATIO,
    D_PLOUGH,
    D_PRESSURE,
    D_RADIUS,
    D_SEEPAGE,
    D_SUPPLY,
    D_VISCOUS,
    N_MODES,
    N_PARAM,
    NOT_FINITE,
    NPAR,
    OK,
    P_ADHESION_FACTOR,
    P_ASPERITY_DENSITY,
    P_ASPERITY_RADIUS,
    P_CONTACT_MODULUS,
    P_CONTACT_RISE,
    P_EFFECTIVE_RADIUS,
    P_FACES,
    P_GROOVE_FACTOR,
    P_HARDNESS_RATIO,
    P_HEAT_TRANSFER,
    P_INDENTATION,
    P_INITIAL_FILM,
    P_INNER_RADIUS,
    P_LINING_THICKNESS,
    P_OIL_DENSITY,
    P_OIL_FLOW,
    P_OUTER_RADIUS,
    P_PERMEABILITY,
    P_PLOUGH_WEIGHT,
    P_ROUGHNESS,
    P_STEEL_CONDUCTIVITY,
    P_STEEL_DENSITY,
    P_STEEL_HEAT_CAPACITY,
    P_STEEL_THICKNESS,
)  # fmt: skip
from .lining import pressure_scale
from .squeeze import squeeze_group

Array = NDArray[np.float64]


@kernel
def derive_friction(par: Array) -> None:
    """Fill area, mean radius and the two shares of boundary friction."""
    ri, ro = par[P_INNER_RADIUS], par[P_OUTER_RADIUS]
    par[D_AREA] = math.pi * (ro - ri) * (ro + ri)
    mean = 2.0 * (ro * ro + ro * ri + ri * ri) / (3.0 * (ro + ri))
    par[D_RADIUS] = par[P_EFFECTIVE_RADIUS] if par[P_EFFECTIVE_RADIUS] > 0.0 else mean
    x = par[P_INDENTATION]
    root = math.sqrt((1.0 - x) * (1.0 + x))
    par[D_PLOUGH] = par[P_PLOUGH_WEIGHT] * ploughing(x)
    par[D_ADHESION] = (
        par[P_ADHESION_FACTOR] * 4.0 / (math.pi * par[P_HARDNESS_RATIO]) / (1.0 + root)
    )


@kernel
def derive_film(par: Array) -> None:
    """Fill what the asperities' pressure, the closing film and its shear need."""
    ri, ro, sigma = par[P_INNER_RADIUS], par[P_OUTER_RADIUS], par[P_ROUGHNESS]
    group = par[P_ASPERITY_DENSITY] * par[P_ASPERITY_RADIUS] * sigma
    par[D_PRESSURE] = pressure_scale(
        sigma, par[P_CONTACT_MODULUS], par[P_ASPERITY_DENSITY], par[P_ASPERITY_RADIUS]
    )
    par[D_CONTACT_AREA] = math.pi * math.pi * group * group
    par[D_CLOSING] = (
        2.0 * par[D_AREA] * sigma * sigma
        / (3.0 * math.pi * squeeze_group(ri, ro) * par[P_GROOVE_FACTOR])
    )  # fmt: skip
    cube = sigma * sigma * sigma
    par[D_SEEPAGE] = 12.0 * par[P_PERMEABILITY] * par[P_LINING_THICKNESS] / cube
    square = (ro - ri) * (ro + ri)
    lever = square * (ro * ro + ri * ri)
    par[D_VISCOUS] = par[P_FACES] * 0.5 * math.pi * lever / sigma
    # What centrifugal force pumps through a full gap, one side at rest; docs/theory/clutch.md.
    par[D_DEMAND] = math.pi * par[P_OIL_DENSITY] * cube * square / (40.0 * math.log(ro / ri))
    par[D_SUPPLY] = par[P_OIL_FLOW] / par[P_FACES]
    par[D_OPEN_RATIO] = par[P_INITIAL_FILM] / sigma


@kernel
def derive_heat(par: Array) -> None:
    """Fill the lumped heat of half a plate and, where asked for, its conduction modes.

    Half a plate, heated at the face, insulated in its middle: surface minus mean temperature is
    the sum of modes d theta_n/dt = 2 P/C - (n pi/l)^2 a theta_n. The last one stands for all that
    follow, with the sum of their steady rises.
    """
    half = 0.5 * par[P_STEEL_THICKNESS]
    volume_heat = par[P_STEEL_DENSITY] * par[P_STEEL_HEAT_CAPACITY]
    capacity = volume_heat * par[D_AREA] * half
    par[D_CAPACITY] = capacity
    par[D_COOLING] = par[P_HEAT_TRANSFER] * par[D_AREA]
    par[D_DECAY] = par[D_COOLING] / capacity
    par[D_GAIN] = 1.0 / capacity
    par[D_MODES] = float(N_MODES) if par[P_CONTACT_RISE] != 0.0 else 0.0
    first = math.pi * math.pi * par[P_STEEL_CONDUCTIVITY] / (volume_heat * half * half)
    rest = math.pi * math.pi / 6.0
    for n in range(1, N_MODES + 1):
        square = float(n) * float(n)
        par[np.uintp(D_DECAY + n)] = first * square
        par[np.uintp(D_GAIN + n)] = 2.0 / capacity
        rest -= 1.0 / square
    last = float(N_MODES) * float(N_MODES)
    par[np.uintp(D_GAIN + N_MODES)] = 2.0 / capacity * (1.0 + last * rest)


@kernel
def derive(par: Array) -> int:
    """Fill the constants behind the parameters; return 0, or NOT_FINITE."""
    derive_friction(par)
    derive_film(par)
    derive_heat(par)
    for i in range(N_PARAM, NPAR):
        if not math.isfinite(par[np.uintp(i)]):
            return NOT_FINITE
    return OK
