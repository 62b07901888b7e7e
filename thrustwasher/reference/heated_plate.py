"""A steel plate heated by a constant flux on its face, in closed form."""

import math


def semi_infinite_rise(
    flux: float, time: float, conductivity: float, density: float, heat_capacity: float
) -> float:
    """Return the rise [K] of the face of a very thick body: 2 q sqrt(t/(pi k rho c)).

    flux [W/m2] constant since time 0. Source: Carslaw & Jaeger 1959, section 2.9.
    """
    return 2.0 * flux * math.sqrt(time / (math.pi * conductivity * density * heat_capacity))


def insulated_plate_rise(
    flux: float, time: float, thickness: float, conductivity: float, density: float,
    heat_capacity: float,
) -> float:  # fmt: skip
    """Return the rise [K] of the heated face of a plate whose other side is insulated.

    q t/(rho c l) + (q l/k) (1/3 - 2/pi^2 sum exp(-n^2 pi^2 a t/l^2)/n^2), ``thickness`` l [m].
    Source: Carslaw & Jaeger 1959, section 3.8.
    """
    pace = math.pi**2 * conductivity * time / (density * heat_capacity * thickness**2)
    total = sum(math.exp(-n * n * pace) / (n * n) for n in range(1, 4000) if n * n * pace < 700.0)
    mean = flux * time / (density * heat_capacity * thickness)
    return mean + flux * thickness / conductivity * (1.0 / 3.0 - 2.0 / math.pi**2 * total)
