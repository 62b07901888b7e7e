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
def rise_after(
    capacity: float, above: float, power: float, cooling: float, dt: float
) -> tuple[float, float]:
    """Return the rise [K] of a body over its coolant after ``dt`` [s], mean heat to the latter [W].

    ``above`` [K] before, ``capacity`` C [J/K]; ``power`` P [W] and ``cooling`` G [W/K] hold: C T' =
    P - G T. At dt = 0 the heat is that of the moment.
    """
    decay, first, second = exponential_weights(cooling * dt / capacity)
    rise = power * dt / capacity
    return above * decay + rise * first, cooling * (above * first + rise * second)


@kernel
def rise_changes(
    capacity: float,
    above: float,
    power: float,
    cooling: float,
    dt: float,
    change: tuple[float, float, float],
) -> tuple[float, float]:
    """Return the changes of what ``rise_after`` returns; ``change`` of above, power, cooling."""
    z = cooling * dt / capacity
    decay, first, second = exponential_weights(z)
    if z < 0.02:
        bend = -1.0 / 2.0 + z * (1.0 / 3.0 - z * (1.0 / 8.0 - z / 30.0))
        turn = -1.0 / 6.0 + z * (1.0 / 12.0 - z * (1.0 / 40.0 - z / 180.0))
    else:
        bend = (decay - first) / z
        turn = (-bend - second) / z
    more, warmer, cooler = change[0], change[1] * dt / capacity, change[2]
    rise, dz = power * dt / capacity, cooler * dt / capacity
    to = more * decay - above * decay * dz + warmer * first + rise * bend * dz
    flow = more * first + warmer * second + (above * bend + rise * turn) * dz
    return to, cooler * (above * first + rise * second) + cooling * flow
