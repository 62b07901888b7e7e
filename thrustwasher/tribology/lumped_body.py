"""A lumped body that is heated and cooled: its temperature after a time, exactly."""

import math

from ..numerics.jit import kernel


@kernel
def exponential_weights(z: float) -> tuple[float, float, float]:
    """Return (exp(-z), (1 - exp(-z))/z, (1 - second)/z) [-] for z >= 0, without cancellation."""
    decay = math.exp(-min(z, 700.0))
    if z < 0.02:
        tail = 1.0 / 24.0 - z * (1.0 / 120.0 - z * (1.0 / 720.0 - z / 5040.0))
        second = 1.0 / 2.0 - z * (1.0 / 6.0 - z * tail)
        return decay, 1.0 - z * second, second
    first = -math.expm1(-min(z, 700.0)) / z
    return decay, first, (1.0 - first) / z
