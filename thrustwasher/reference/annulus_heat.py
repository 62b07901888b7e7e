"""Temperature of a thin annulus that is heated unevenly around its circumference."""

import numpy as np
from numpy.typing import NDArray
from scipy.special import iv, ivp, kv, kvp


def annulus_rise(
    radius: NDArray[np.float64], heat: float, harmonic: int, conductivity: float, thickness: float,
    inner_radius: float, outer_radius: float,
) -> NDArray[np.float64]:  # fmt: skip
    """Return the amplitude [K] over ``radius`` [m] of T = amplitude cos(n theta).

    K t lap T - (K/t) T + q_0 (r/r_o)^n cos(n theta) = 0 with no flux through either rim: heat
    ``heat`` = q_0 [W/m2] on one face, the other face held at zero. Since lap(r^n cos n theta) = 0,
    T = c r^n + a I_n(r/t) + b K_n(r/t), c = q_0 t/(K r_o^n).
    """
    n, t = harmonic, thickness
    c = heat * t / (conductivity * outer_radius**n)
    rims = np.array([inner_radius, outer_radius])
    slopes = np.column_stack((ivp(n, rims / t) / t, kvp(n, rims / t) / t))
    a, b = np.linalg.solve(slopes, -c * n * rims ** (n - 1))
    return np.asarray(c * radius**n + a * iv(n, radius / t) + b * kv(n, radius / t))
