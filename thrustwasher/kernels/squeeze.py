"""Oil squeezed from between two rough annular faces: flow through the gap, with its slope."""

import math

from ._jit import kernel

FLOW_FROM = 0.1  # film ratio below which Patir & Cheng's fit is left
_LOST = 0.9 * math.exp(-0.56 * FLOW_FROM)
_FLOW = (1.0 - _LOST) * FLOW_FROM**3
_STEEPNESS = 3.0 / FLOW_FROM + 0.56 * _LOST / (1.0 - _LOST)


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
