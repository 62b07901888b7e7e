"""First gear of the Modelica Standard Library's SimpleGearShift example in closed form."""

import math


def speed_against_quadratic_load(
    time: float, torque: float, load_torque: float, load_speed: float,
    inertia: float, output_inertia: float, ratio: float,
) -> float:  # fmt: skip
    """Return the input speed [rad/s] ``time`` s after a constant torque is applied at rest.

    A gear of the given ratio drives the output with inertia and a load that grows with the square
    of its speed: (J + J_out/i^2) w' = T - load_torque/i (w/(i load_speed))^2, so w is a tanh.
    """
    total = inertia + output_inertia / ratio**2
    drag = load_torque / ratio / (ratio * load_speed) ** 2
    return math.sqrt(torque / drag) * math.tanh(time * math.sqrt(torque * drag) / total)
