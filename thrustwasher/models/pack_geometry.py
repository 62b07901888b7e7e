"""What follows from a friction pack's radii alone."""

import math


def lining_area(inner_radius: float, outer_radius: float, faces: int) -> float:
    """Return the area of all friction faces of a pack [m2]."""
    return faces * math.pi * (outer_radius**2 - inner_radius**2)


def mean_radius(inner_radius: float, outer_radius: float) -> float:
    """Return the radius friction acts at under even pressure [m]."""
    outer, inner = outer_radius, inner_radius
    return 2.0 * (outer**3 - inner**3) / (3.0 * (outer**2 - inner**2))
