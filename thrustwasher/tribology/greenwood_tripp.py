"""Contact of a rough lining: Greenwood & Tripp's integrals over the heights.

F_n(u) = integral over s > u of (s - u)^n pdf(s) ds, pdf the standard normal density: F_5/2 and
F_3/2 by quadrature, F_5/2 from a table, F_1 and F_2 closed, the separation of a pressure.
"""

import math

import numpy as np

from ..numerics.jit import kernel
from ..numerics.spline import quintic
from ..numerics.status import MAX_ITERATIONS
from .contact_table import TABLE
from .flow_factors import INV_SQRT2, INV_SQRT2PI

N_NODES = 48
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(N_NODES)
NODES = 0.5 * (_NODES + 1.0)
WEIGHTS = 0.5 * _WEIGHTS
REACH = 9.0  # the density is cut where it has fallen by exp(-REACH^2/2) = 3e-18

U_MIN, U_MAX = -8.0, 14.0
N_KNOTS = 353
FAR_BELOW = -30.0
STEP = (U_MAX - U_MIN) / (N_KNOTS - 1)
N_TRIES = 60


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
    return (
        16.0
        * math.sqrt(2.0)
        * math.pi
        / 15.0
        * group
        * group
        * math.sqrt(roughness / radius)
        * modulus
    )


@kernel
def contact_integral(u: float) -> tuple[float, float]:
    """Return F_5/2(u) and dF_5/2/du [-], to about 1e-10; nothing beyond u = 14.

    Quintic Hermite interpolation of ln F_5/2; below the table the quadrature, far below the series
    in 1/u^2 of the mean of (s - u)^2.5 over normal heights.
    """
    if not u < U_MAX:
        return (u if math.isnan(u) else 0.0), 0.0
    if u < FAR_BELOW:
        a, square = -u, 1.0 / (u * u)
        low = a * math.sqrt(a)
        return (
            a * low * (1.0 + square * (1.875 - square * (0.1171875 + square * 0.0732421875))),
            -2.5 * low * (1.0 + square * (0.375 + square * (0.0703125 + square * 0.1025390625))),
        )
    if u < U_MIN:
        five, three = height_integrals(u)
        return five, -2.5 * three
    x = (u - U_MIN) / STEP
    i = np.uintp(min(int(x), N_KNOTS - 2))
    j = np.uintp(i + np.uintp(1))
    t = x - float(i)
    one, two = (TABLE[0, i], TABLE[1, i], TABLE[2, i]), (TABLE[0, j], TABLE[1, j], TABLE[2, j])
    log, slope = quintic(one, two, t)
    value = math.exp(log)
    return value, value * slope / STEP


@kernel
def separation_and_slope(pressure_ratio: float, guess: float) -> tuple[float, float, int, int]:
    """Return u with F_5/2(u) = ``pressure_ratio`` [-], and its slope over that ratio's logarithm.

    With them status and number of iterations. Newton on ln F_5/2, which is concave and falling:
    from any start the second iterate lies on the far side of the root and the rest approach it
    from there, so no bracket is needed.
    """
    if not pressure_ratio > 1e-30:
        return 11.0, 0.0, 0, 0
    goal = math.log(pressure_ratio)
    u, per = min(guess, 8.0), 0.0
    for n in range(N_TRIES):
        five, slope = contact_integral(u)
        per = five / slope
        step = (goal - math.log(five)) * per
        u += step
        if abs(step) < 1e-12 * (1.0 + abs(u)):
            return u, per, 0, n + 1
        u = min(u, 13.0)
    return u, per, MAX_ITERATIONS, N_TRIES


@kernel
def normal_heights(u: float) -> tuple[float, float, float]:
    """Return the standard normal density at ``u``, and the shares of heights below and above.

    The smaller share is good to its rounding; that below holds from u = -30 down.
    """
    pdf = INV_SQRT2PI * math.exp(-0.5 * u * u)
    less = 0.5 * math.erfc(min(abs(u), 30.0) * INV_SQRT2)
    return (pdf, 1.0 - less, less) if u >= 0.0 else (pdf, less, 1.0 - less)


@kernel
def area_integrals(u: float) -> tuple[float, float]:
    """Return F_2(u) and F_1(u) [-]; dF_2/du = -2 F_1.

    F_1 = pdf - u Q and F_2 = (1 + u^2) Q - u pdf with Q(u) = erfc(u/sqrt 2)/2. Above u = 5, where
    the differences cancel, both come from a continued fraction of Q/pdf; to 1e-13.
    """
    pdf, _, above = normal_heights(u)
    return areas_of(u, pdf, above)


@kernel
def areas_of(u: float, pdf: float, above: float) -> tuple[float, float]:
    """Return ``area_integrals``; ``pdf``, ``above``: those of ``normal_heights``."""
    if not u < 38.0:
        return (u if math.isnan(u) else 0.0), 0.0
    if u <= 5.0:
        return (1.0 + u * u) * above - u * pdf, pdf - u * above
    # Q/pdf = 1/(u + 1/(u + 2/(u + 3/(u + ...)))); k_n is the fraction from n on
    k = u
    for n in range(12 + int(600.0 / (u * u)), 2, -1):
        k = u + n / k
    k2 = u + 2.0 / k
    k1 = u + 1.0 / k2
    # 1 - u/k1 = (1/k2)/k1; F_2 = (Q - u F_1) = pdf (k2 - u)/(k1 k2)
    return pdf * (2.0 / k) / (k1 * k2), pdf / (k1 * k2)
