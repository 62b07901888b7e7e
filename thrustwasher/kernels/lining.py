"""Contact of a rough lining: Greenwood & Tripp's pressure and the separation that carries a load.

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
MAX_ITERATIONS = 60


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


@kernel
def separation(pressure_ratio: float, guess: float) -> tuple[float, int, int]:
    """Return (u, status, iterations) with F_5/2(u) = ``pressure_ratio`` [-].

    Newton on ln F_5/2, which is concave and falling: from any start the second iterate lies on
    the far side of the root and the rest approach it from there, so no bracket is needed.
    """
    if not pressure_ratio > 1e-30:
        return 11.0, 0, 0
    goal = math.log(pressure_ratio)
    u = min(max(guess, -1000.0), 8.0)
    for n in range(MAX_ITERATIONS):
        five, three = height_integrals(u)
        step = (math.log(five) - goal) * five / (2.5 * three)
        u += step
        if u < -1000.0:
            return -1000.0, 0, n + 1
        if abs(step) < 1e-12 * (1.0 + abs(u)):
            return u, 0, n + 1
        u = min(u, 30.0)
    return u, 10, MAX_ITERATIONS
