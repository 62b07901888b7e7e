"""Elastic contact of two rough surfaces whose summits meet off their tops."""

import math

from .greenwood_williamson import height_moment


def two_sided_pressure(
    separation: float, group: float, slope: float, contact_modulus: float
) -> float:
    """Return the pressure [Pa] at ``separation`` in units of the combined scatter of summits.

    16 sqrt(2) pi/15 (eta beta sigma)^2 sqrt(sigma/beta) E' F_5/2. ``group`` is eta beta sigma
    (density, tip radius, combined scatter), ``slope`` is sigma/beta, ``contact_modulus`` is
    1/theta [Pa]. Source: Greenwood & Tripp 1970.
    """
    front = 16.0 * math.sqrt(2.0) * math.pi / 15.0 * group**2 * math.sqrt(slope)
    return front * contact_modulus * height_moment(2.5, separation)


def two_sided_area_share(separation: float, group: float) -> float:
    """Return A_c/A_0 [-] = pi^2 (eta beta sigma)^2 F_2. Source: Greenwood & Tripp 1970."""
    return (math.pi * group) ** 2 * height_moment(2.0, separation)
