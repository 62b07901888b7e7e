"""Simple planetary set with helical gears: kinematics and tooth forces in closed form.

Sun, ring and carrier carry torques as 1 : r : -(1 + r) with r = z_ring/z_sun. On a planet the
axial forces of sun mesh and ring mesh cancel; what remains is a couple that tilts it.
"""

import math
from typing import NamedTuple


class PlanetForces(NamedTuple):
    """Forces on one planet and thrust on the central gears."""

    tangential: float  # [N] in one mesh
    axial: float  # [N] in one mesh
    couple: float  # [N m] tilting the planet
    pin_load: float  # [N] radial load on the planet's pin
    sun_thrust: float  # [N] axial force on the sun; that on the ring is the opposite
    planet_torque: float  # [N m] of one mesh about the planet's axis


def pitch_radius(teeth: float, normal_module: float, helix_angle: float) -> float:
    """Return the pitch radius [m] of a helical gear."""
    return 0.5 * teeth * normal_module / math.cos(helix_angle)


def ring_speed(ratio: float, sun: float, carrier: float) -> float:
    """Return the speed of the ring [rad/s] from w_s + r w_r = (1 + r) w_c."""
    return ((1.0 + ratio) * carrier - sun) / ratio


def planet_forces(
    sun_torque: float, sun_radius: float, planet_radius: float, helix_angle: float, planets: int
) -> PlanetForces:
    """Return the forces that a torque [N m] in the sun's teeth puts on one of ``planets``."""
    tangential = abs(sun_torque) / (planets * sun_radius)
    axial = tangential * math.tan(helix_angle)
    return PlanetForces(
        tangential=tangential,
        axial=axial,
        couple=2.0 * planet_radius * axial,
        pin_load=2.0 * tangential,
        sun_thrust=planets * axial,
        planet_torque=tangential * planet_radius,
    )
