"""Two inertias locked together by a clutch, and the first gear of Modelica's SimpleGearShift."""

import math
from typing import NamedTuple


class Engagement(NamedTuple):
    """How a clutch locks."""

    lock_time: float  # [s] from the start of slip
    heat: float  # [J] in the clutch
    speed: float  # [rad/s] common speed at lock-up


def engagement(
    capacity: float,
    drive: float,
    resistance: float,
    drive_inertia: float,
    driven_inertia: float,
    drive_speed: float,
    driven_speed: float,
) -> Engagement:
    """Return lock time, heat and speed for constant torques [N m], inertias [kg m2].

    ``drive`` turns the first inertia, ``resistance`` holds the second back, the clutch carries its
    capacity from the faster first to the second. Slip falls linearly:
    t = slip / [(T_k - T_1)/J_1 + (T_k - T_2)/J_2], E = T_k slip t / 2.
    """
    slip = drive_speed - driven_speed
    slowing = (capacity - drive) / drive_inertia + (capacity - resistance) / driven_inertia
    if slowing <= 0.0:
        return Engagement(float("inf"), float("inf"), float("nan"))
    time = slip / slowing
    return Engagement(
        time,
        0.5 * capacity * slip * time,
        driven_speed + (capacity - resistance) / driven_inertia * time,
    )


def reduced_inertia(ratio: float, sun: float, ring: float, carrier: float) -> float:
    """Return the inertia [kg m2] the slip between sun and ring of a planetary set sees.

    The brake is open; ``ratio`` is z_ring/z_sun. For a ring without inertia it is
    1/[(1 + 1/r)^2 (1/J_s + 1/J_c)].
    """
    if ring == 0.0:
        return 1.0 / ((1.0 + 1.0 / ratio) ** 2 * (1.0 / sun + 1.0 / carrier))
    coupling = ratio / ring - 1.0 / sun
    stiff = 1.0 / sun + ratio**2 / ring + (1.0 + ratio) ** 2 / carrier
    return 1.0 / (1.0 / sun + 1.0 / ring - coupling**2 / stiff)


def speed_against_quadratic_load(
    time: float,
    torque: float,
    load_torque: float,
    load_speed: float,
    inertia: float,
    output_inertia: float,
    ratio: float,
) -> float:
    """Return the input speed [rad/s] ``time`` s after a constant torque is applied at rest.

    A gear of the given ratio drives the output with inertia and a load that grows with the square
    of its speed: (J + J_out/i^2) w' = T - load_torque/i (w/(i load_speed))^2, so w is a tanh.
    """
    total = inertia + output_inertia / ratio**2
    drag = load_torque / ratio / (ratio * load_speed) ** 2
    return math.sqrt(torque / drag) * math.tanh(time * math.sqrt(torque * drag) / total)
