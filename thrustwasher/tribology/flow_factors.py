"""Film functions of rough surfaces: mean gap, flow, shear flow factor, squeezing; with slopes."""

import math

from ..numerics.jit import kernel

INV_SQRT2 = 0.7071067811865476
INV_SQRT2PI = 0.3989422804014327
H30 = 0.039974329086230886  # flow conductance / sigma^3 at h = 0.5 sigma
G0 = 7.191123823716943  # its logarithmic slope x sigma there

FLOW_FROM = 0.1  # film ratio below which Patir & Cheng's fit is left
_LOST = 0.9 * math.exp(-0.56 * FLOW_FROM)
_FLOW = (1.0 - _LOST) * FLOW_FROM**3
_STEEPNESS = 3.0 / FLOW_FROM + 0.56 * _LOST / (1.0 - _LOST)


@kernel
def mean_gap(h: float, sigma: float) -> tuple[float, float]:
    """Return the mean gap h_T [m] and dh_T/dh of surfaces whose mean planes are h [m] apart.

    Source: Jackson & Green Eq 6 for Gaussian heights, h_T = h cdf(h/sigma) + sigma pdf(h/sigma),
    hence dh_T/dh = cdf(h/sigma). Positive for every h; h/sigma below -30 counts as -30.
    """
    u = h / sigma
    if u > 8.3:  # 1 - cdf is below the rounding of 1
        return h, 1.0
    if u < -30.0:
        u = -30.0
    cdf = 0.5 * math.erfc(-u * INV_SQRT2)
    return sigma * (u * cdf + INV_SQRT2PI * math.exp(-0.5 * u * u)), cdf


@kernel
def flow_conductance(h: float, sigma: float) -> tuple[float, float]:
    """Return phi h^3 [m^3] and its slope [m^2]; phi is the pressure flow factor.

    Source: Patir & Cheng 1978, phi = 1 - 0.9 exp(-0.56 h/sigma) (Jackson & Green Eq 2) above
    h = 0.5 sigma; chosen here below it: the exponential that continues value and slope.
    """
    u = h / sigma
    if u >= 0.5:
        if u > 80.0:  # 1 - phi is below the rounding of 1
            return h * h * h, 3.0 * h * h
        lost = 0.9 * math.exp(-0.56 * u)
        return (1.0 - lost) * h * h * h, h * h * (3.0 * (1.0 - lost) + 0.56 * u * lost)
    value = H30 * sigma * sigma * sigma * math.exp(G0 * (max(u, -90.0) - 0.5))
    return value, G0 / sigma * value


@kernel
def shear_flow(h: float, sigma: float) -> tuple[float, float]:
    """Return Patir & Cheng's shear flow factor Phi_s [-] of one surface and its slope [1/m].

    Source: Jackson & Green Eq 4 (its last exponent is 0.05 (h/sigma)^2, which makes it meet Eq 5
    at h = 5 sigma) and Eq 5; 0 for h <= 0.
    """
    u = h / sigma
    if u <= 0.0:
        return 0.0, 0.0
    if u > 5.0:
        value = 1.126 * math.exp(-0.25 * u)
        return value, -0.25 * value / sigma
    value = 1.899 * math.exp(0.98 * math.log(u) - 0.92 * u + 0.05 * u * u)
    return value, value * (0.98 / u - 0.92 + 0.1 * u) / sigma


@kernel
def gap_flow(u: float) -> tuple[float, float]:
    """Return phi u^3 [-], the flow through a rough gap over that of a gap sigma, and its slope.

    Source: Patir & Cheng 1978, phi = 1 - 0.9 exp(-0.56 u), u = h/sigma. The product would turn
    negative below u = 0: under 0.1 the exponential that continues value and slope is used
    (chosen here), so that a film always closes and never sticks.
    """
    if u < FLOW_FROM:
        value = _FLOW * math.exp(_STEEPNESS * (max(u, -20.0) - FLOW_FROM))
        return value, _STEEPNESS * value
    if u > 80.0:  # 1 - phi is below the rounding of 1
        return u * u * u, 3.0 * u * u
    lost = 0.9 * math.exp(-0.56 * u)
    return (1.0 - lost) * u * u * u, u * u * (3.0 * (1.0 - lost) + 0.56 * u * lost)


@kernel
def squeeze_group(inner: float, outer: float) -> float:
    """Return G [m^4] of an annulus: closing at dh/dt the film carries 3 pi eta G |dh/dt|/(2 h^3).

    G = Ro^4 - Ri^4 - (Ro^2 - Ri^2)^2/ln(Ro/Ri); the difference cancels for a narrow ring, where
    G -> (4/3) R (Ro - Ri)^3. Derived in docs/theory/clutch.md from Reynolds' equation.
    """
    a, b = inner * inner, outer * outer
    z = (b - a) / (b + a)  # ln(Ro/Ri) = atanh z
    if z > 0.3:
        return b * b - a * a - (b - a) * (b - a) / (0.5 * math.log(b / a))
    # (b^2 - a^2)(1 - z/atanh z), the bracket from the series of atanh
    z2 = z * z
    series = 0.0
    for n in range(24, 0, -1):
        series = z2 * (1.0 / (2.0 * n + 1.0) + series)
    return (b - a) * (b + a) * series / (1.0 + series)
