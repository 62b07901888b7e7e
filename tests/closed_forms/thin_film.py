"""Films between a disc and a plate: parallel, slightly tilted."""

import math


def couette_torque(
    viscosity: float, speed: float, gap: float, inner_radius: float, outer_radius: float
) -> float:
    """Return the torque [N m] of an annular film of constant gap [m] and viscosity [Pa s].

    Petroff: integral of mu omega r^2/h over the area, pi mu omega (r_o^4 - r_i^4)/(2 h).
    """
    return math.pi * viscosity * speed * (outer_radius**4 - inner_radius**4) / (2.0 * gap)


def _strength(viscosity: float, speed: float, tilt: float, gap: float) -> float:
    """Return C [Pa/m^3] in laplacian(p) = C r sin(theta)."""
    return 6.0 * viscosity * speed * tilt / gap**3


def wedge_pressure(
    radius: float,
    angle: float,
    viscosity: float,
    speed: float,
    tilt: float,
    gap: float,
    inner_radius: float,
    outer_radius: float,
) -> float:
    """Return the pressure [Pa] of the film h = gap - tilt r cos(theta), without cavitation.

    First order in the tilt: p = C/8 (r^2 - r_i^2)(r^2 - r_o^2)/r sin(theta) with
    C = 6 mu omega tilt/gap^3. Smooth surfaces, constant viscosity; error of relative order
    tilt r_o/gap.
    """
    shape = (radius**2 - inner_radius**2) * (radius**2 - outer_radius**2) / radius
    return _strength(viscosity, speed, tilt, gap) / 8.0 * shape * math.sin(angle)


def wedge_moment(
    viscosity: float,
    speed: float,
    tilt: float,
    gap: float,
    inner_radius: float,
    outer_radius: float,
) -> float:
    """Return the moment [N m] of `wedge_pressure` about x, -pi C/96 (r_o^2 - r_i^2)^3."""
    width = (outer_radius**2 - inner_radius**2) ** 3
    return -math.pi / 96.0 * _strength(viscosity, speed, tilt, gap) * width
