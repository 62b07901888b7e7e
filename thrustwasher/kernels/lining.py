"""Contact of a rough lining: Greenwood & Tripp's integrals over the heights, by quadrature.

F_n(u) = integral over s > u of (s - u)^n pdf(s) ds, pdf the standard normal density.
"""

import math

import numpy as np

from ._jit import kernel

N_NODES = 48
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(N_NODES)
NODES = 0.5 * (_NODES + 1.0)
WEIGHTS = 0.5 * _WEIGHTS
REACH = 9.0  # the density is cut where it has fallen by exp(-REACH^2/2) = 3e-18


@kernel
def height_integrals(u: float) -> tuple[float, float]:
    """Return F_5/2(u) and F_3/2(u) [-]; dF_5/2/du = -5/2 F_3/2.

    With s - u = w^2 the integrand is smooth, and Gauss-Legendre on the part of w that counts
    gives both to about 1e-12, for u from -1000 to 30.
    """
    low = math.sqrt(max(0.0, -u - REACH))
    high = math.sqrt(
        REACH - u if u < 0.0 else REACH * REACH / (math.sqrt(u * u + REACH * REACH) + u)
    )
    five = 0.0
    three = 0.0
    for i in range(N_NODES):
        w = low + (high - low) * NODES[np.uintp(i)]
        t = w * w
        density = math.exp(-0.5 * (u + t) * (u + t)) / math.sqrt(2.0 * math.pi)
        term = WEIGHTS[np.uintp(i)] * 2.0 * w * w * w * w * density
        three += term
        five += term * t
    return five * (high - low), three * (high - low)


@kernel
def pressure_scale(roughness: float, modulus: float, density: float, radius: float) -> float:
    """Return the factor [Pa] of F_5/2 in Greenwood & Tripp's pressure."""
    group = density * radius * roughness
    return 16.0 * math.sqrt(2.0) * math.pi / 15.0 * group * group * math.sqrt(
        roughness / radius
    ) * modulus  # fmt: skip
