"""Oil squeezed from between smooth annular faces under a constant load, in closed form."""

import math


def squeeze_group(inner: float, outer: float) -> float:
    """Return G [m4] = Ro^4 - Ri^4 - (Ro^2 - Ri^2)^2/ln(Ro/Ri).

    Integrating the parabola-and-logarithm pressure of Reynolds' equation over the annulus gives
    the force 3 pi eta G |dh/dt|/(2 h^3).
    """
    square = outer**2 - inner**2
    return outer**4 - inner**4 - square**2 / math.log(outer / inner)


def squeeze_time(
    load: float, viscosity: float, inner: float, outer: float, start: float, end: float
) -> float:
    """Return the time [s] in which the film falls from ``start`` to ``end`` [m].

    t = 3 pi eta G/(4 F) (1/h^2 - 1/h0^2) for a constant load F [N] and viscosity [Pa s].
    """
    group = squeeze_group(inner, outer)
    return 3.0 * math.pi * viscosity * group / (4.0 * load) * (1.0 / end**2 - 1.0 / start**2)


def pumped_flow(
    density: float, viscosity: float, speed: float, gap: float, inner: float, outer: float
) -> float:
    """Return the flow [m3/s] that centrifugal force drives through a full gap, one side at rest.

    The oil turns with v = omega r z/h; radial momentum at low Reynolds number between two rims at
    ambient pressure gives Q = pi rho omega^2 h^3 (Ro^2 - Ri^2)/(40 eta ln(Ro/Ri)).
    """
    square = outer**2 - inner**2
    return math.pi * density * speed**2 * gap**3 * square / (
        40.0 * viscosity * math.log(outer / inner)
    )  # fmt: skip
