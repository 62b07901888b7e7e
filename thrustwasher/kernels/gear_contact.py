"""Line contact of two cylinders: Hertz's width and pressure, Dowson & Higginson's oil film."""

import math

from ._jit import kernel


@kernel
def compliance(modulus: float, poisson: float) -> float:
    """Return theta = 2 (1 - nu^2)/E [1/Pa] of two bodies of the same material."""
    return 2.0 * (1.0 - poisson * poisson) / modulus


@kernel
def hertz_width(line_load: float, radius: float, theta: float) -> float:
    """Return the full width b [m] of a line contact under ``line_load`` [N/m].

    b = sqrt(16 w R theta/pi), ``radius`` R [m] combined; mean pressure w/b, maximum 4/pi of it.
    """
    return math.sqrt(16.0 / math.pi * line_load * radius * theta)


@kernel
def surface_stress(line_load: float, radius: float, modulus: float) -> float:
    """Return sigma_m [Pa] = 0.591 sqrt(w E_eq/R), E_eq = E/2 for equal materials: Atan Eq 9.

    0.591 is the rounded factor of the maximum pressure for a Poisson ratio of 0.3 (0.59136).
    """
    return 0.591 * math.sqrt(line_load * 0.5 * modulus / radius)


@kernel
def film_thickness(
    viscosity: float, entrainment: float, line_load: float, radius: float, theta: float,
    pressure_viscosity: float,
) -> float:  # fmt: skip
    """Return the least film h [m] of Dowson & Higginson: 2.65 U^0.7 G^0.54 W^-0.13 R.

    ``entrainment`` (V1 + V2)/2 [m/s], ``viscosity`` [Pa s], E' = 2/theta, U = mu V/(E' R),
    G = alpha_p E', W = w/(E' R). All arguments are above 0.
    """
    stiff = 2.0 / theta
    u = viscosity * entrainment / (stiff * radius)
    g = pressure_viscosity * stiff
    w = line_load / (stiff * radius)
    return 2.65 * radius * math.exp(0.7 * math.log(u) + 0.54 * math.log(g) - 0.13 * math.log(w))
