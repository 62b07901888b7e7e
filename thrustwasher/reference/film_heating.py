"""Heat that shear makes in a thin oil film between rolling and sliding cylinders.

The formulas of Rashid & Seireg (1987) as Atan (2005) uses them, Eq 6 and 7.
"""

import math


def sheared_heat(viscosity: float, sliding: float, width: float, film: float) -> float:
    """Return q = V_s b tau [W/m] with tau = mu V_s/h of a full width b [m] and film h [m]."""
    return viscosity * sliding**2 * width / film


def surface_rise(
    heat: float, speed: float, width: float, conductivity: float, density: float,
    heat_capacity: float,
) -> float:  # fmt: skip
    """Return the rise of the flank's surface above its bulk [K], Eq 7.

    ``heat`` [W/m] is the share that enters the flank, which moves at ``speed`` [m/s] through a
    band of full ``width`` [m].
    """
    peclet = density * heat_capacity * speed * width / conductivity
    return 1.03 * heat / (conductivity * math.sqrt(peclet))


def film_rise(
    heat: float, speed: float, width: float, film: float, conductivity: float,
    heat_content: float, oil_conductivity: float, oil_heat_content: float,
) -> float:  # fmt: skip
    """Return how much hotter the middle of the film is than the surface [K], Eq 6.

    Heat contents are density times heat capacity [J/(m3 K)]. As printed: the first group holds
    the steel's heat content, the exponential the oil's.
    """
    half = speed * film / (2.0 * oil_conductivity)
    powers = (heat_content * half) ** -0.013 * (2.0 * width / film) ** -1.003
    powers *= (conductivity / oil_conductivity) ** 0.013
    decay = math.exp(-9e-4 * oil_heat_content * half)
    return float(1.14 * heat / oil_conductivity * powers * decay)
