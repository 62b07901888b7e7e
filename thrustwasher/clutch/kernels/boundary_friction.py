"""Boundary friction of a lining: adhesion and ploughing of asperities, Wang, Wei & Wu (2012)."""

import math

from ...numerics.jit import kernel

SERIES_LIMIT = 0.5  # below it the ploughing term is summed, above it the closed form is safe
N_TERMS = 40  # 0.25^40 < 1e-24


@kernel
def ploughing(x: float) -> float:
    """Return (2/(pi x^2)) [asin x - x sqrt(1 - x^2)] [-], the ploughing term for k = 1.

    The bracket cancels for small x: there its power series is summed instead, so that the result
    is good to rounding for every x in (0, 1].
    """
    if x >= SERIES_LIMIT:
        c = math.sqrt((1.0 - x) * (1.0 + x))
        return 2.0 / math.pi * (math.asin(x) - x * c) / (x * x)
    power = 1.0  # binom(2n, n) / 4^n x^(2n)
    total = 0.0
    for n in range(N_TERMS):
        term = power * 2.0 / (2.0 * n + 3.0)
        total += term
        if term < 1e-18 * total:
            break
        power *= (2.0 * n + 1.0) / (2.0 * n + 2.0) * x * x
    return 2.0 / math.pi * x * total


@kernel
def friction(x: float, shear_ratio: float, plough_weight: float, hardness_ratio: float) -> float:
    """Return the coefficient of boundary friction [-].

    symbol          meaning                                              unit
    x               indentation width over asperity diameter, W/2R       -, (0, 1]
    shear_ratio     shear strength of the film over the material's       -, [0, 1]
    plough_weight   k, weight of ploughing                               -
    hardness_ratio  N, hardness over shear strength                      -

    Source: Wang, Wei & Wu (2012), Eq 12, k on the ploughing bracket only; the adhesive bracket
    1 - sqrt(1 - x^2) is written x^2/(1 + sqrt(1 - x^2)) to keep its digits.
    """
    c = math.sqrt((1.0 - x) * (1.0 + x))
    adhesion = 4.0 * shear_ratio / (math.pi * hardness_ratio) / (1.0 + c)
    return plough_weight * ploughing(x) + adhesion


@kernel
def shear_and_slope(
    speed: float, floor: float, stick_speed: float, decay_speed: float, kink_width: float
) -> tuple[float, float]:
    """Return the shear ratio s/s_m [-] at the slip speed [m/s >= 0] at the mean radius; its slope.

    It is 1 up to ``stick_speed`` and falls exponentially towards ``floor`` above. With
    ``kink_width`` > 0 the corner is rounded by a softplus of that width.

    Notes
    -----
    Source: the prose of Wang, Wei & Wu (2012); the figure is lost and the constants are chosen
    so that the harmonic mean of the friction over 0..3000 rpm is the paper's 0.053.
    """
    beyond, rise = speed - stick_speed, 1.0
    if kink_width > 0.0:
        u = beyond / kink_width
        if u < 30.0:
            growth = math.exp(max(u, -700.0))
            beyond, rise = kink_width * math.log1p(growth), growth / (1.0 + growth)
    elif beyond < 0.0:
        beyond, rise = 0.0, 0.0
    decay = math.exp(-min(beyond / decay_speed, 700.0))
    return floor + (1.0 - floor) * decay, -(1.0 - floor) * decay * rise / decay_speed
