"""Thin annuli that are heated: unevenly around the circumference, or in a stack of three."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import iv, ivp, kv, kvp


def annulus_rise(
    radius: NDArray[np.float64],
    heat: float,
    harmonic: int,
    conductivity: float,
    thickness: float,
    inner_radius: float,
    outer_radius: float,
) -> NDArray[np.float64]:
    """Return the amplitude [K] over ``radius`` [m] of T = amplitude cos(n theta).

    K t lap T - (K/t) T + q_0 (r/r_o)^n cos(n theta) = 0 with no flux through either rim: heat
    ``heat`` = q_0 [W/m2] on one face, the other face held at zero. Since lap(r^n cos n theta) = 0,
    T = c r^n + a I_n(r/t) + b K_n(r/t), c = q_0 t/(K r_o^n).
    """
    n, t = harmonic, thickness
    c = heat * t / (conductivity * outer_radius**n)
    rims = np.array([inner_radius, outer_radius])
    slopes = np.column_stack((ivp(n, rims / t) / t, kvp(n, rims / t) / t))
    a, b = np.linalg.solve(slopes, -c * n * rims ** (n - 1))
    return np.asarray(c * radius**n + a * iv(n, radius / t) + b * kv(n, radius / t))


class StackRise(NamedTuple):
    """Temperature rises [K] above the oil."""

    carrier: float
    washer: float
    gear: float


def stack_rise(
    heat: float,
    share: float,
    between_carrier_washer: float,
    between_washer_gear: float,
    behind_carrier: float,
    behind_gear: float,
) -> StackRise:
    """Return the rises for a heat flow [W/m2] made between carrier and washer.

    ``share`` of it enters the carrier, the rest the washer; resistances in m2 K/W. The heat that
    leaves through the carrier follows from the two parallel ways out.
    """
    by_gear = between_washer_gear + behind_gear
    loop = behind_carrier + between_carrier_washer + by_gear
    out_carrier = heat * (by_gear + share * between_carrier_washer) / loop
    out_gear = heat - out_carrier
    return StackRise(out_carrier * behind_carrier, out_gear * by_gear, out_gear * behind_gear)
