"""A friction plate: heated by a constant flux on its face; average friction of a braking."""

import math


def semi_infinite_rise(
    flux: float, time: float, conductivity: float, density: float, heat_capacity: float
) -> float:
    """Return the rise [K] of the face of a very thick body: 2 q sqrt(t/(pi k rho c)).

    flux [W/m2] constant since time 0. Source: Carslaw & Jaeger 1959, section 2.9.
    """
    return 2.0 * flux * math.sqrt(time / (math.pi * conductivity * density * heat_capacity))


def insulated_plate_rise(
    flux: float,
    time: float,
    thickness: float,
    conductivity: float,
    density: float,
    heat_capacity: float,
) -> float:
    """Return the rise [K] of the heated face of a plate whose other side is insulated.

    q t/(rho c l) + (q l/k) (1/3 - 2/pi^2 sum exp(-n^2 pi^2 a t/l^2)/n^2), ``thickness`` l [m].
    Source: Carslaw & Jaeger 1959, section 3.8.
    """
    pace = math.pi**2 * conductivity * time / (density * heat_capacity * thickness**2)
    total = sum(math.exp(-n * n * pace) / (n * n) for n in range(1, 4000) if n * n * pace < 700.0)
    mean = flux * time / (density * heat_capacity * thickness)
    return mean + flux * thickness / conductivity * (1.0 / 3.0 - 2.0 / math.pi**2 * total)


def braking_average(
    at_rest: float, at_speed: float, stick_speed: float, decay_speed: float, fastest: float
) -> float:
    """Return the average coefficient [-] of a mass braked from ``fastest`` [m/s] to rest.

    A rig divides J w0/t, the mean torque over time, by force, radius and number of faces. With a
    constant force dt = -J dw/(mu F r n), so that this is the harmonic mean of mu over speed.

    Parameters
    ----------
    at_rest, at_speed : coefficient up to ``stick_speed`` and at very high slip, above 0
    stick_speed, decay_speed : the coefficient falls as exp(-(v - stick_speed)/decay_speed) [m/s]
    fastest : speed at the start [m/s], above 0

    Notes
    -----
    Derived here: int dv/(a + b exp(-v/s)) = (v + s ln(a + b exp(-v/s)))/a.
    """
    if fastest <= stick_speed:
        return at_rest
    beyond = fastest - stick_speed
    end = at_speed + (at_rest - at_speed) * math.exp(-beyond / decay_speed)
    falling = (beyond + decay_speed * math.log(end / at_rest)) / at_speed
    return fastest / (stick_speed / at_rest + falling)
