"""Elastic contact of rough surfaces with Gaussian summits."""

import math

from scipy.special import pbdv


def height_integral(separation: float) -> float:
    """Return F_3/2(t), the mean of (s - t)^1.5 over Gaussian heights s > t.

    F_3/2(t) = Gamma(5/2)/sqrt(2 pi) exp(-t^2/4) D_-5/2(t), D the parabolic cylinder function.
    """
    front = math.gamma(2.5) / math.sqrt(2.0 * math.pi)
    return float(front * math.exp(-0.25 * separation**2) * pbdv(-2.5, separation)[0])


def elastic_pressure(
    separation: float, contact_modulus: float, radius: float, density: float, scatter: float
) -> float:
    """Return the pressure [Pa] at ``separation`` [scatter] of the summits' mean from the flat.

    P = density (4/3) E' sqrt(radius) scatter^1.5 F_3/2(separation), ``scatter`` [m] the standard
    deviation of the summits. Source: Greenwood & Williamson 1966.
    """
    stiffness = 4.0 / 3.0 * contact_modulus * math.sqrt(radius)
    return density * stiffness * scatter * math.sqrt(scatter) * height_integral(separation)
