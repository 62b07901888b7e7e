"""Elastic contact of rough surfaces: Greenwood & Williamson."""

import math

from scipy.special import pbdv


def height_moment(order: float, separation: float) -> float:
    """Return F_n(t), the mean of (s - t)^n over standard Gaussian heights s > t.

    F_n(t) = Gamma(n + 1)/sqrt(2 pi) exp(-t^2/4) D_(-n-1)(t), D the parabolic cylinder function;
    for any order above -1, relative error below 1e-11.
    """
    front = math.gamma(order + 1.0) / math.sqrt(2.0 * math.pi)
    return float(front * math.exp(-0.25 * separation**2) * pbdv(-order - 1.0, separation)[0])


def height_integral(separation: float) -> float:
    """Return F_3/2(t), the moment that gives the elastic pressure."""
    return height_moment(1.5, separation)


def real_area_share(separation: float, group: float) -> float:
    """Return A_c/A_0 [-] = pi (eta beta sigma) F_1, ``group`` the product in brackets.

    Density, tip radius and scatter of the summits. Source: Greenwood & Williamson 1966; Atan
    2005, Eq 5, prints a stray factor and a wrong limit in its integral.
    """
    return math.pi * group * height_moment(1.0, separation)


def elastic_pressure(
    separation: float, contact_modulus: float, radius: float, density: float, scatter: float
) -> float:
    """Return the pressure [Pa] at ``separation`` [scatter] of the summits' mean from the flat.

    P = density (4/3) E' sqrt(radius) scatter^1.5 F_3/2(separation), ``scatter`` [m] the standard
    deviation of the summits. Source: Greenwood & Williamson 1966.
    """
    stiffness = 4.0 / 3.0 * contact_modulus * math.sqrt(radius)
    return density * stiffness * scatter * math.sqrt(scatter) * height_integral(separation)
