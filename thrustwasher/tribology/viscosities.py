"""Viscosity of the oil at several temperatures side by side, with its slopes."""

from ..numerics.elementary import straight_exp, straight_log
from ..numerics.jit import inlined
from .viscosity import LN10


@inlined
def straight_viscosity(
    temperature: float, scale: float, constant: float, exponent: float
) -> tuple[float, float]:
    """Return ``viscosity`` to rounding without a branch: for several temperatures side by side."""
    x = 1.0 + (temperature - 273.15) / 135.0
    x = x if x > 1e-3 else 1e-3
    power = constant * straight_exp(-exponent * straight_log(x))
    within = power if power < 12.0 else 12.0
    mu = scale * straight_exp(LN10 * within)
    slope = -mu * LN10 * within * exponent / (135.0 * x)
    return mu, slope if power <= 12.0 else 0.0
