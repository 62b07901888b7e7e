"""A helical pair, external or internal: path of contact, loss and contact stress. SI units.

The pinion has index 1. ``side`` is 1 for an external gear and -1 for a ring. Positions along the
transverse path of contact are the pinion's radii of curvature.
"""

import math
from typing import NamedTuple


class Pair(NamedTuple):
    """Two gears at their reference centre distance; addenda in normal modules."""

    teeth: float
    teeth_gear: float
    normal_module: float
    normal_angle: float
    helix: float = 0.0
    addendum: float = 1.0
    addendum_gear: float = 1.0
    side: float = 1.0

    @property
    def angle(self) -> float:
        """Transverse pressure angle."""
        return math.atan(math.tan(self.normal_angle) / math.cos(self.helix))

    @property
    def base_helix(self) -> float:
        """Helix angle on the base cylinder."""
        return math.asin(math.sin(self.helix) * math.cos(self.normal_angle))

    @property
    def radius(self) -> float:
        """Pitch radius of the pinion."""
        return 0.5 * self.teeth * self.normal_module / math.cos(self.helix)

    @property
    def radius_gear(self) -> float:
        """Pitch radius of the gear."""
        return self.radius * self.teeth_gear / self.teeth

    @property
    def line(self) -> float:
        """Length between the base tangent points, a sin(angle)."""
        return (self.radius_gear + self.side * self.radius) * math.sin(self.angle)

    @property
    def base_pitch(self) -> float:
        """Transverse base pitch."""
        return 2.0 * math.pi * self.radius / self.teeth * math.cos(self.angle)


def path_of_contact(pair: Pair) -> tuple[float, float, float]:
    """Return the pinion's radius of curvature [m] at start A, pitch point C and end E."""
    tip = pair.radius + pair.addendum * pair.normal_module
    tip_gear = pair.radius_gear + pair.side * pair.addendum_gear * pair.normal_module
    base, base_gear = (r * math.cos(pair.angle) for r in (pair.radius, pair.radius_gear))
    start = pair.side * (pair.line - math.sqrt(tip_gear**2 - base_gear**2))
    return start, pair.radius * math.sin(pair.angle), math.sqrt(tip**2 - base**2)


def contact_ratios(pair: Pair) -> tuple[float, float]:
    """Return approach and recess [-], the path before and after the pitch point in base pitches."""
    start, pole, end = path_of_contact(pair)
    return (pole - start) / pair.base_pitch, (end - pole) / pair.base_pitch


def normal_radius(pair: Pair, rho: float) -> float:
    """Return the combined radius [m] across the contact line where the pinion's is ``rho``."""
    gear = pair.line - pair.side * rho
    return rho * gear / ((gear + pair.side * rho) * math.cos(pair.base_helix))


def rolling(pair: Pair, rho: float, speed: float) -> tuple[float, float]:
    """Return the speeds [m/s] of the contact along both flanks, the pinion turning at ``speed``."""
    return speed * rho, speed * pair.teeth / pair.teeth_gear * (pair.line - pair.side * rho)


def even_part(pair: Pair, width: float) -> float:
    """Return the part of the load [-] that bears evenly on the whole path: at most the overlap."""
    return min(width * math.sin(pair.helix) / (math.pi * pair.normal_module), 1.0)


def share(pair: Pair, width: float, place: float) -> float:
    """Return X [-] at a place of the path, in base pitches from the pitch point."""
    approach, recess = contact_ratios(pair)
    pairs = math.floor(place + approach) + math.floor(recess - place) + 1
    even = even_part(pair, width)
    return (1.0 - even) / pairs + even / (approach + recess)


def loss_factor(pair: Pair, even: float) -> float:
    """Return H_v [-]: power lost = H_v x coefficient of friction x power transmitted.

    ``even`` of the load bears on the whole path at any time; of the rest two pairs bear half each
    and one alone all (Ohlendorf 1958): contact ratios 1 to 2, the pitch point where one is alone.
    """
    approach, recess = contact_ratios(pair)
    squares, whole = approach**2 + recess**2, approach + recess
    shape = even * squares / whole + (1.0 - even) * (1.0 - whole + squares)
    both = 1.0 / pair.teeth + pair.side / pair.teeth_gear
    return math.pi * both / math.cos(pair.base_helix) * shape


def single_contact_factors(pair: Pair, width: float) -> tuple[float, float]:
    """Return Z_B and Z_D [-]: where a pair is alone over the pitch point, none of it from 1 on."""
    start, pole, end = path_of_contact(pair)
    even = even_part(pair, width)
    alone = (end - pair.base_pitch, start + pair.base_pitch)
    found = (math.sqrt(normal_radius(pair, pole) / normal_radius(pair, rho)) for rho in alone)
    first, second = (max(1.0, z) - even * (max(1.0, z) - 1.0) for z in found)
    return first, second


def helical_factor(pair: Pair, width: float) -> float:
    """Return K_Bgamma [-] of ISO/TR 13989-1, over the total contact ratio."""
    overlap = width * math.sin(pair.helix) / (math.pi * pair.normal_module)
    total = min(max(sum(contact_ratios(pair)) + overlap, 2.0), 3.5)
    return 1.0 + 0.2 * math.sqrt((total - 2.0) * (5.0 - total))


def pitting_stress(
    pair: Pair, force: float, width: float, youngs_modulus: float, poisson: float
) -> float:
    """Return sigma_H [Pa] = Z_H Z_E Z_eps Z_beta sqrt(F_t (u + side)/(d_1 b u)), load factors 1.

    ``force`` [N] around the pitch circle. ISO 6336-2 as publicly quoted, Z_beta = 1/sqrt(cos beta).
    """
    angle, contact = pair.angle, sum(contact_ratios(pair))
    zone = 2.0 * math.cos(pair.base_helix) / (math.cos(angle) * math.sin(angle))
    elastic = youngs_modulus / (2.0 * math.pi * (1.0 - poisson**2))
    even = even_part(pair, width)
    shared = (4.0 - contact) / 3.0 * (1.0 - even) + even / contact
    u = pair.teeth_gear / pair.teeth
    load = force / (2.0 * pair.radius * width) * (u + pair.side) / u
    most = max(single_contact_factors(pair, width))
    return most * math.sqrt(zone * elastic * shared / math.cos(pair.helix) * load)
