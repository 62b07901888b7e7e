"""What tables of linings and bushings limit: pressure, sliding, their product, power and energy.

All are of the nominal face, grooves included, and follow from a solution: no kernel knows them.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from .units import format_quantity

FACE_LOADS = {  # name -> unit, meaning
    "face_pressure": ("Pa", "load over the area of a face"),
    "face_pressure_max": ("Pa", "at the bore of a face that has worn evenly, p r = const"),
    "sliding_speed": ("m/s", "sliding speed, at the radius of even pressure or effective_radius"),
    "pressure_velocity": ("W/m2", "face pressure times sliding speed"),
    "power_per_area": ("W/m2", "friction power over the area of all faces"),
}
ENERGY = {"energy_per_area": ("J/m2", "heat since the start over the area of all faces")}
LIMITED = FACE_LOADS | ENERGY  # what a part may limit


class Face(NamedTuple):
    """The friction faces of a part."""

    area: Any  # [m2] of one; a number, or an array for many parts
    count: Any
    radius: Any  # [m] at which they slide
    peak: Any = 1.0
    """Pressure at the bore over the mean, once the face has worn evenly (p r = const)."""


Faces = Callable[[Any], Face]  # of parameters


def even_radius(inner: float, outer: float) -> float:
    """Return the radius [m] that friction under even pressure acts at."""
    return 2.0 * (outer**3 - inner**3) / (3.0 * (outer**2 - inner**2))


def worn_peak(inner: float, outer: float) -> float:
    """Return the pressure at the bore over the mean where wear is even, p r = const.

    Source: classical design of plate clutches by uniform wear, F = 2 pi p_max r_i (r_o - r_i).
    """
    return 0.5 * (outer + inner) / inner


def face_loads(face: Face, load: Any, speed: Any, power: Any) -> dict[str, Any]:
    """Return what of ``FACE_LOADS`` a load [N], speed [rad/s] and friction power [W] make.

    Numbers or arrays.

    Examples
    --------
    >>> face_loads(Face(0.002, 2, 0.05), 4000.0, -10.0, 300.0)["pressure_velocity"]
    1000000.0
    """
    pressure, sliding = load / face.area, abs(speed) * face.radius
    return {
        "face_pressure": pressure,
        "face_pressure_max": pressure * face.peak,
        "sliding_speed": sliding,
        "pressure_velocity": pressure * sliding,
        "power_per_area": power / (face.area * face.count),
    }


class OnFaces:
    """What of ``FACE_LOADS`` a result of a part with friction faces tells."""

    __slots__ = ()
    friction_power: float  # [W]

    def _on_faces(self) -> tuple[Face, float, float]:
        """Return the faces, load [N] and speed [rad/s]."""
        raise NotImplementedError

    def _face_load(self, name: str) -> float:
        return float(face_loads(*self._on_faces(), self.friction_power)[name])

    @property
    def face_pressure(self) -> float:
        """[Pa] load over the area of a face."""
        return self._face_load("face_pressure")

    @property
    def face_pressure_max(self) -> float:
        """[Pa] at the bore of a face that has worn evenly, p r = const; new it has the mean."""
        return self._face_load("face_pressure_max")

    @property
    def sliding_speed(self) -> float:
        """[m/s] of the faces at the radius of even pressure, or the one that is set."""
        return self._face_load("sliding_speed")

    @property
    def pressure_velocity(self) -> float:
        """[W/m2] face pressure times sliding speed."""
        return self._face_load("pressure_velocity")

    @property
    def power_per_area(self) -> float:
        """[W/m2] friction power over the area of all faces."""
        return self._face_load("power_per_area")


def over_limits(limits: Mapping[str, float], values: Mapping[str, float]) -> list[str]:
    """Return a line for each limit that a value passes."""
    return [
        f"{name} = {format_quantity(values[name], LIMITED[name][0])}, above the part's limit "
        f"{format_quantity(limit, LIMITED[name][0])} ([limits])"
        for name, limit in limits.items()
        if name in values and values[name] > limit
    ]
