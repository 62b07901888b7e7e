"""Torque of a parallel film between a disc and a plate."""

import math


def couette_torque(
    viscosity: float, speed: float, gap: float, inner_radius: float, outer_radius: float
) -> float:
    """Return the torque [N m] of an annular film of constant gap [m] and viscosity [Pa s].

    Petroff: integral of mu omega r^2/h over the area, pi mu omega (r_o^4 - r_i^4)/(2 h).
    """
    return math.pi * viscosity * speed * (outer_radius**4 - inner_radius**4) / (2.0 * gap)
