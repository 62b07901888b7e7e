"""Viscosity of the oil over temperature, with its slope."""

import math

from ..numerics.jit import kernel

LN10 = 2.302585092994046


@kernel
def viscosity(
    temperature: float, scale: float, constant: float, exponent: float
) -> tuple[float, float]:
    """Return the dynamic viscosity [Pa s] and its slope [Pa s/K] at ``temperature`` [K].

    Source: Roelands 1966 in the form of Jackson & Green Eq 17, mu = scale 10^(G_o x^-S_o) with
    x = 1 + T/135, T in degC. x counts at least 1e-3 and the power of ten at most 12, so that an
    iterate far below any real oil temperature stays finite (slope 0 there).
    """
    x = 1.0 + (temperature - 273.15) / 135.0
    if x < 1e-3:
        x = 1e-3
    power = constant * math.exp(-exponent * math.log(x))
    if power > 12.0:
        return scale * 1e12, 0.0
    mu = scale * math.exp(LN10 * power)
    return mu, -mu * LN10 * power * exponent / (135.0 * x)
