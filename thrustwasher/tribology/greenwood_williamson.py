"""Real contact area of rough surfaces: Greenwood & Williamson's F_1 and the area ratio."""

import math

from ..numerics.jit import kernel
from ..numerics.smoothing import soft_least, soft_most
from .flow_factors import INV_SQRT2, INV_SQRT2PI

DIRECT_LIMIT = 3.0  # above it pdf - u Q cancels and the continued fraction has converged
N_TERMS = 60
LARGEST_RATIO = 1e6  # surfaces that hardly touch: the law has left its meaning long before
WINDOW = 0.1  # relative width of the rounded corners


@kernel
def normal_density(u: float) -> float:
    """Return exp(-u^2/2)/sqrt(2 pi) to rounding: the square is split so that it is exact."""
    coarse = math.floor(u * 16.0 + 0.5) / 16.0
    rest = (u - coarse) * (u + coarse)
    return INV_SQRT2PI * math.exp(-0.5 * coarse * coarse) * math.exp(-0.5 * rest)


@kernel
def reach_and_mills(u: float) -> tuple[float, float]:
    """Return F_1(u)/pdf(u) and Q(u)/pdf(u) [-] for u >= 3 by Laplace's continued fraction.

    No cancellation: the Mills ratio is 1/(u + k), k = 1/(u + 2/(u + 3/(u + ...))), and
    1 - u/(u + k) = k/(u + k).
    """
    tail = u
    for i in range(N_TERMS):
        tail = u + (N_TERMS - i + 1.0) / tail
    k = 1.0 / tail
    return k / (u + k), 1.0 / (u + k)


@kernel
def overlap_and_tail(u: float) -> tuple[float, float]:
    """Return F_1(u) = integral over s > u of (s - u) pdf(s) ds = pdf(u) - u Q(u) [-], and Q(u).

    dF_1/du = -Q. Good to 1e-13 relative; 0 above u = 38, where both are smaller than any number
    here.
    """
    if u > 38.0:
        return 0.0, 0.0
    if u > DIRECT_LIMIT:
        density = normal_density(u)
        reach, mills = reach_and_mills(u)
        return density * reach, density * mills
    tail = 0.5 * math.erfc(u * INV_SQRT2)
    return normal_density(max(u, -38.0)) - u * tail, tail


@kernel
def area_and_slope(film_ratio: float, asperity_group: float) -> tuple[float, float]:
    """Return nominal over real area A_0/A_c [-], 1 .. 1e6, corners rounded; slope over film ratio.

    A_c/A_0 = pi (density x radius x scatter) F_1(film_ratio), Greenwood & Williamson 1966 (Atan
    Eq 5, its integral from the separation on). ``asperity_group`` is the bracket.
    """
    overlap, tail = overlap_and_tail(film_ratio)
    share = math.pi * asperity_group * overlap
    if share * LARGEST_RATIO < 0.5:
        return LARGEST_RATIO, 0.0
    ratio, slope = soft_least(1.0 / share, LARGEST_RATIO, WINDOW * LARGEST_RATIO)
    bounded, rest = soft_most(ratio, 1.0, WINDOW)
    slope *= rest
    return bounded, slope * tail / (overlap * share)


@kernel
def bounded_slopes(ratio: float, hardness: float, pressure: float) -> tuple[float, float, float]:
    """Return the area ratio that leaves no asperity above ``hardness`` [Pa], and at least 1.

    With its slopes over the ratio and over the logarithm of pressure. On the real area the mean
    ``pressure`` [Pa] is ratio times as large.
    """
    bound = hardness / pressure
    bounded, slope = soft_least(ratio, bound, WINDOW * bound)
    most, rest = soft_most(bounded, 1.0, WINDOW)
    # the rounded minimum grows in proportion with ratio and bound together
    return most, rest * slope, -rest * (bounded - slope * ratio)
