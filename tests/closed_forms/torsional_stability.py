"""A clutch that slips before an elastic shaft: where falling friction feeds the torsional mode.

Slip and twist of the driveline are the two motions; the mobilities say how their accelerations
follow the torques X (clutch) and T = k twist + d twist' (shaft):

    slip' = -(A_ss X + A_st T)        twist'' = -(A_st X + A_tt T)        D = A_ss A_tt - A_st^2

With X = c slip the characteristic polynomial is

    s^3 + (A_ss c + A_tt d) s^2 + (A_tt k + D c d) s + D c k
"""

import math
from typing import NamedTuple

from thrustwasher.transmission.mobility import Mobility


class Limit(NamedTuple):
    """Where the torsional mode neither grows nor decays."""

    damping: float  # [N m s/rad] of the shaft
    frequency: float  # [rad/s]


def characteristic(
    m: Mobility, slope: float, stiffness: float, damping: float
) -> tuple[float, float, float, float]:
    """Return the coefficients of the characteristic polynomial, highest power first.

    ``slope`` [N m s/rad] is the change of the clutch's torque over its slip.
    """
    return (
        1.0,
        m.slip * slope + m.twist * damping,
        m.twist * stiffness + m.determinant * slope * damping,
        m.determinant * slope * stiffness,
    )


def damping_limit(m: Mobility, slope: float, stiffness: float) -> Limit:
    """Return the damping of the shaft [N m s/rad] below which judder grows, and its frequency.

    A pair of roots on the imaginary axis needs a_2 a_1 = a_0, a square equation for the damping:

        A_tt D c d^2 + (A_tt^2 k + A_ss D c^2) d + A_st^2 c k = 0

    Its smaller root is the limit, about |c| (A_st/A_tt)^2 where friction changes little within a
    period. Friction that does not fall has none: 0.
    """
    free = math.sqrt(m.twist * stiffness)
    if slope >= 0.0:
        return Limit(0.0, free)
    c, rest = -slope, m.determinant
    middle = m.twist**2 * stiffness + m.slip * rest * c * c
    inner = middle**2 - 4.0 * m.twist * rest * m.cross**2 * stiffness * c * c
    damping = 2.0 * c * stiffness * m.cross**2 / (middle + math.sqrt(max(inner, 0.0)))
    square = m.twist * stiffness - rest * c * damping
    return Limit(damping, math.sqrt(max(square, 0.0)))
