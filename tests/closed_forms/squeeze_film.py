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
    density: float,
    viscosity: float,
    speeds: tuple[float, float],
    gap: float,
    inner: float,
    outer: float,
) -> float:
    """Return the flow [m3/s] that centrifugal force drives through a full gap between two discs.

    The oil turns with the discs at its sides, linearly in between; radial momentum at low Reynolds
    number between two rims at ambient pressure gives, with the mean speed m and the slip s,
    Q = pi rho (m^2 + s^2/20) h^3 (Ro^2 - Ri^2)/(12 eta ln(Ro/Ri)): 1/40 if one side is at rest.
    """
    square = outer**2 - inner**2
    mean, slip = 0.5 * (speeds[0] + speeds[1]), speeds[0] - speeds[1]
    return (
        math.pi
        * density
        * (mean**2 + slip**2 / 20.0)
        * gap**3
        * square
        / (12.0 * viscosity * math.log(outer / inner))
    )


def parting_time(force: float, drag: float, clear: float, start: float, end: float) -> float:
    """Return the time [s] in which a spring parts two smooth faces from ``start`` to ``end`` [m].

    The spring's force falls from ``force`` [N] to 0 at the clearance ``clear`` [m]; the film draws
    oil in against drag v/h^3, v the speed [m/s] and ``drag`` [N m2 s]. The integral of
    drag/(force h^3 (1 - h/c)) is drag/force (-1/(2 h^2) - 1/(c h) + ln(h/(c - h))/c^2).
    """

    def gone(h: float) -> float:
        return -0.5 / h**2 - 1.0 / (clear * h) + math.log(h / (clear - h)) / clear**2

    return drag / force * (gone(end) - gone(start))
