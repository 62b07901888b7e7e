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


@kernel
def temperature_after(
    start: float, ambient: float, capacity: float, cooling: float,
    power_start: float, power_end: float, duration: float,
) -> float:  # fmt: skip
    """Return the temperature [K] after ``duration`` [s] under a power [W] that changes linearly.

    Solves capacity dT/dt = power - cooling (T - ambient) in closed form; capacity [J/K] > 0,
    cooling [W/K] >= 0.
    """
    decay, first, second = exponential_weights(cooling * duration / capacity)
    gain = power_start * first + (power_end - power_start) * second
    return ambient + (start - ambient) * decay + gain * duration / capacity
