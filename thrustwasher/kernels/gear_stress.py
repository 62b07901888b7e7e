"""Thermal stress beside contact stress: Atan's modification factor and endurance."""

import math

from ._jit import kernel


@kernel
def thermal_stress(rise: float, modulus: float, poisson: float, expansion: float) -> float:
    """Return sigma_t [Pa] = E alpha dT/(3 (1 - nu)) of a rise [K]: Atan Eq 8."""
    return modulus * expansion * rise / (3.0 * (1.0 - poisson))


@kernel
def modification(
    thermal: float, mechanical: float, thermal_limit: float, mechanical_limit: float
) -> tuple[float, float]:
    """Return (K, 1/sqrt(1 + K)) [-]: Atan Eq 11, K = (K_m sigma_t/(K_t sigma_m))^2.

    The limits are K_t and K_m, endurance limits over ultimate strength.
    """
    root = mechanical_limit * thermal / (thermal_limit * mechanical)
    return root * root, 1.0 / math.sqrt(1.0 + root * root)


@kernel
def utilization(
    thermal: float, mechanical: float, thermal_limit: float, mechanical_limit: float,
    ultimate: float,
) -> float:  # fmt: skip
    """Return the root of the right side of Atan Eq 10 [-]: at 1 the endurance limit is used up."""
    m = mechanical / (mechanical_limit * ultimate)
    t = thermal / (thermal_limit * ultimate)
    return math.sqrt(m * m + t * t)
