"""Contact stress that a flank bears while thermal shocks strain it too (Atan 2005, Eq 8-12)."""

import math
from typing import NamedTuple

from closed_forms.involute_mesh import Mesh, start_of_contact

CONTACT = 0.591
"""[-] of Eq 9; exactly sqrt(1/(pi (1 - nu^2))), 0.5914 for nu = 0.3."""


class Endurance(NamedTuple):
    """Fatigue limits of a steel over its ultimate strength."""

    mechanical: float  # K_m [-]
    thermal: float  # K_t [-]


def thermal_stress(
    rise: float, youngs_modulus: float, poisson_ratio: float, expansion: float
) -> float:
    """Return sigma_t = E alpha dT/(3 (1 - nu)) [Pa], Eq 8."""
    return youngs_modulus * expansion * rise / (3.0 * (1.0 - poisson_ratio))


def contact_stress(load: float, radius: float, youngs_modulus: float) -> float:
    """Return 0.591 sqrt(w E_eq/R) [Pa] for two bodies of one modulus, E_eq = E/2, Eq 9."""
    return CONTACT * math.sqrt(0.5 * load * youngs_modulus / radius)


def modification_factor(thermal: float, contact: float, steel: Endurance) -> float:
    """Return K = (K_m sigma_t/(K_t sigma_m))^2 [-], Eq 11."""
    return float((steel.mechanical * thermal / (steel.thermal * contact)) ** 2)


def allowable_ratio(factor: float) -> float:
    """Return 1/sqrt(1 + K), the share of the endurance limit left for the contact stress."""
    return 1.0 / math.sqrt(1.0 + factor)


def grouped_factor(
    mesh: Mesh,
    power: float,
    speed: float,
    face_width: float,
    heat: float,
    steel: Endurance,
    youngs_modulus: float,
    poisson_ratio: float,
    expansion: float,
    effusivity: float,
) -> float:
    """Return K [-] as one product, Eq 12 with power per face width and E_eq = E/2.

    ``heat`` is psi f A_0/A_c. The printed 2.36 is 3 pi^(1/4) 0.591, rounded.
    """
    m, phi, x = mesh.ratio, mesh.pressure_angle, start_of_contact(mesh)
    theta = 2.0 * (1.0 - poisson_ratio**2) / youngs_modulus
    shape = math.sqrt((1.0 - x) * (1.0 + m) / x) * (1.0 - (m + 1.0) * x) ** 2 / m**2
    angle = (math.sin(phi) ** 0.75 / (2.36 * math.cos(phi) ** 0.25)) ** 2
    strain = youngs_modulus * expansion / (1.0 - poisson_ratio)
    strain *= steel.mechanical / steel.thermal
    material = strain**2 / (0.5 * youngs_modulus * math.sqrt(theta) * effusivity**2)
    duty = math.sqrt(power / face_width * speed) * mesh.centre_distance
    return float(shape * angle * heat**2 * material * duty)
