"""Coefficient of friction at a flank: Li & Seireg's thermal regime, and the mean value of ISO."""

import math

from ._jit import kernel
from .corners import soft_least


@kernel
def li_seireg(film: float, radius: float, f0: float, roughness: float) -> float:
    """Return the coefficient of friction [-] of Li & Seireg (Atan Eq 4).

    symbol     meaning                                              unit
    film       film thickness h                                     m
    radius     combined radius of curvature R_c                     m
    f0         coefficient without a film                           -
    roughness  effective roughness parameter S, 7.459e-6..6.297e-5  -

    f = f0 - a (1 - exp(-(h/R_c)/(2.873 S - 2.143e-5))), a = 0.0864 - 1372 S; between f0 (h = 0)
    and f0 - a. Holds for a slide/roll ratio above 0.27.
    """
    depth = film / radius / (2.873 * roughness - 2.143e-5)
    return f0 - (0.0864 - 1372.0 * roughness) * (1.0 - math.exp(-min(depth, 700.0)))


@kernel
def li_seireg_slope(film: float, radius: float, f0: float, roughness: float) -> float:
    """Return the slope of ``li_seireg`` over the logarithm of the film."""
    depth = min(film / radius / (2.873 * roughness - 2.143e-5), 700.0)
    return -(0.0864 - 1372.0 * roughness) * math.exp(-depth) * depth


@kernel
def iso_mean(
    line_load: float, rolling: float, radius: float, viscosity: float, roughness: float, f0: float
) -> float:
    """Return the mean coefficient of friction [-] of ``iso_and_slope``."""
    friction, _ = iso_and_slope(line_load, rolling, radius, viscosity, roughness, f0)
    return friction


@kernel
def iso_and_slope(
    line_load: float, rolling: float, radius: float, viscosity: float, roughness: float, f0: float
) -> tuple[float, float]:
    """Return the mean coefficient of friction [-] of ISO/TS 6336-20, and no more than ``f0``.

    The second number is its slope over the logarithm of the unbounded value, which goes with the
    power 0.2 of load over speed and -0.05 of the viscosity.

    0.06 (w/(v R))^0.2 eta^-0.05 Ra^0.25 in its own units (N/mm, m/s, mm, mPa s, um); here
    ``line_load`` [N/m], ``rolling`` sum of the speeds at the pitch point [m/s], ``radius`` there
    [m], ``viscosity`` at the oil's temperature [Pa s], ``roughness`` Ra [m]. The bound is chosen
    here: towards standstill the formula grows without limit.
    """
    load = 1e-3 * line_load / (rolling * 1e3 * radius)
    mu = 0.06 * math.exp(
        0.2 * math.log(load) - 0.05 * math.log(1e3 * viscosity) + 0.25 * math.log(1e6 * roughness)
    )
    if f0 <= 0.0:
        return 0.0, 0.0
    bounded, slope = soft_least(mu, f0, 0.1 * f0)
    return bounded, slope * mu
