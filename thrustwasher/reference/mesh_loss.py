"""Share of the power that sliding along the line of action costs."""

import math
from typing import NamedTuple

from .involute_mesh import Mesh, end_of_contact, pinion_radius, start_of_contact, tooth_module


class PathOfContact(NamedTuple):
    """Lengths along the line of action, in base pitches."""

    approach: float
    """from the start of contact to the pitch point"""
    recess: float
    """from the pitch point to the end of contact"""

    @property
    def contact_ratio(self) -> float:
        """Mean number of tooth pairs in contact."""
        return self.approach + self.recess


def path_of_contact(mesh: Mesh) -> PathOfContact:
    """Return approach and recess; the pitch point lies at 1/(1 + M) of the line."""
    line = mesh.centre_distance * math.sin(mesh.pressure_angle)
    pitch = math.pi * tooth_module(mesh) * math.cos(mesh.pressure_angle)
    pole = 1.0 / (1.0 + mesh.ratio)
    return PathOfContact(
        approach=(pole - start_of_contact(mesh)) * line / pitch,
        recess=(end_of_contact(mesh) - pole) * line / pitch,
    )


def loss_factor(mesh: Mesh) -> float:
    """Return H_v [-]: power lost = H_v x coefficient of friction x power transmitted.

    Two pairs share the load equally, one alone carries all. Sliding grows in proportion to the
    distance s from the pitch point, so with s in base pitches and the load share X(s)

        H_v = 2 pi (1 + 1/M)/N  x  integral of X(s) |s| over the path.

    X is 1/2 on the whole path and another 1/2 where one pair is alone, from recess - 1 to
    1 - approach. Holds for contact ratios of 1 to 2. With the pitch point where one pair is alone
    it is the usual pi (1 + 1/M)/N (1 - e + e_1^2 + e_2^2) (Ohlendorf 1958).
    """
    approach, recess = path_of_contact(mesh)
    shared = 0.5 * (approach**2 + recess**2)
    alone = _slid(1.0 - approach) - _slid(recess - 1.0)
    front = 2.0 * math.pi * (1.0 + 1.0 / mesh.ratio) / mesh.pinion_teeth
    return front * 0.5 * (shared + alone)


def _slid(end: float) -> float:
    """Return the integral of |s| from 0 to ``end``."""
    return 0.5 * end * abs(end)


def ohlendorf_factor(mesh: Mesh) -> float:
    """Return H_v [-] in the usual form; neither approach nor recess may exceed a base pitch."""
    approach, recess = path_of_contact(mesh)
    shape = 1.0 - approach - recess + approach**2 + recess**2
    return math.pi * (1.0 + 1.0 / mesh.ratio) / mesh.pinion_teeth * shape


def pitch_line_speed(mesh: Mesh, speed: float) -> float:
    """Return the speed of the pitch circles [m/s]."""
    return speed * pinion_radius(mesh)
