"""Where two involute spur gears touch first, how their flanks move there, what sliding costs.

Everything lies on the line of action, the common tangent of the two base circles. Its length
between the base tangent points is C sin(phi); positions count from the pinion's.
"""

import math
from typing import NamedTuple


class Mesh(NamedTuple):
    """A gear pair seen along its line of action; ``addendum`` is in modules."""

    ratio: float  # [-] teeth of the gear over teeth of the pinion
    pinion_teeth: float
    centre_distance: float  # [m]
    pressure_angle: float  # [rad]
    addendum: float = 1.0


class Flanks(NamedTuple):
    """The two flanks where they touch."""

    radius_pinion: float  # [m] of curvature
    radius_gear: float  # [m]
    radius: float  # [m] of the cylinder on a plane with the same gap
    speed_pinion: float  # [m/s] of the contact along the flank
    speed_gear: float
    sliding: float  # [m/s] gear against pinion; above 0 before the pitch point


def pinion_radius(mesh: Mesh) -> float:
    """Return the pitch radius of the pinion [m]."""
    return mesh.centre_distance / (1.0 + mesh.ratio)


def tooth_module(mesh: Mesh) -> float:
    """Return the module [m], pitch diameter over teeth."""
    return 2.0 * pinion_radius(mesh) / mesh.pinion_teeth


def _reach(pitch_radius: float, mesh: Mesh) -> float:
    """Return how far from its base tangent point a tooth tip reaches along the line [m].

    Tip circle, base circle and line of action enclose a right angle at the base tangent point.
    """
    tip = pitch_radius + mesh.addendum * tooth_module(mesh)
    base = pitch_radius * math.cos(mesh.pressure_angle)
    return math.sqrt(tip * tip - base * base)


def start_of_contact(mesh: Mesh) -> float:
    """Return x_s [-], the start of contact over the length of the line between base circles.

    There the tip of the driven gear meets the flank of the driving pinion. At or below 0 the tip
    passes the pinion's base tangent point: the teeth interfere.
    """
    line = mesh.centre_distance * math.sin(mesh.pressure_angle)
    return 1.0 - _reach(mesh.ratio * pinion_radius(mesh), mesh) / line


def end_of_contact(mesh: Mesh) -> float:
    """Return where the tip of the pinion leaves the gear [-]; at or above 1 they interfere."""
    line = mesh.centre_distance * math.sin(mesh.pressure_angle)
    return _reach(pinion_radius(mesh), mesh) / line


def least_pinion_teeth(ratio: float, pressure_angle: float, addendum: float = 1.0) -> float:
    """Return the number of pinion teeth [-] at which contact starts on the base circle, x_s = 0.

    Then the tip radius of the gear squared is its base radius squared plus the line's length
    squared: (M + 2a/N)^2 = M^2 cos^2(phi) + (1 + M)^2 sin^2(phi) = M^2 + (1 + 2M) sin^2(phi).
    """
    tip = math.sqrt(ratio**2 + (1.0 + 2.0 * ratio) * math.sin(pressure_angle) ** 2)
    return 2.0 * addendum / (tip - ratio)


def flanks_at(position: float, mesh: Mesh, speed: float) -> Flanks:
    """Return curvature and motion at a position x [-], the pinion turning at ``speed`` [rad/s]."""
    line = mesh.centre_distance * math.sin(mesh.pressure_angle)
    first, second = position * line, (1.0 - position) * line
    return Flanks(
        radius_pinion=first,
        radius_gear=second,
        radius=first * second / (first + second),
        speed_pinion=speed * first,
        speed_gear=speed / mesh.ratio * second,
        sliding=speed / mesh.ratio * second - speed * first,
    )


def line_load(torque: float, mesh: Mesh, face_width: float) -> float:
    """Return the normal load per face width [N/m] of a pinion torque [N m] on one tooth pair."""
    base = pinion_radius(mesh) * math.cos(mesh.pressure_angle)
    return torque / (base * face_width)


class PathOfContact(NamedTuple):
    """Lengths along the line of action, in base pitches."""

    approach: float  # from the start of contact to the pitch point
    recess: float  # from the pitch point to the end of contact

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
