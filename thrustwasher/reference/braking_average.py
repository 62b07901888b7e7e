"""Average friction of a braking, as a test rig computes it from the braking time."""

import math


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
