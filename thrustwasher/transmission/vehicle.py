"""What a vehicle is to a transmission's output: an inertia and a load."""

import math
from dataclasses import dataclass

from ..model.parameters import check_ranges, quantity

GRAVITY = 9.80665  # m/s2
LOAD_SPEED = 100.0  # rad/s that the drag of the air is given at


@dataclass(frozen=True, slots=True, kw_only=True)
class Vehicle:
    """A vehicle on its road; the defaults are estimates of a mid-size car."""

    mass: float = quantity(1650.0, "kg", 1.0, 1e6, "mass of the vehicle")
    wheel_radius: float = quantity(0.32, "m", 0.01, 5.0, "rolling radius of the driven wheels")
    final_drive: float = quantity(3.2, "1", 0.1, 100.0, "output speed over wheel speed")
    rolling: float = quantity(0.011, "1", 0.0, 1.0, "rolling resistance over weight")
    drag_area: float = quantity(0.68, "m2", 0.0, 100.0, "drag coefficient times frontal area")
    grade: float = quantity(0.0, "1", -1.0, 1.0, "slope of the road, rise over run")
    wheel_inertia: float = quantity(4.8, "kg.m2", 0.0, 1e5, "inertia of all wheels")
    air_density: float = quantity(1.2, "kg/m3", 0.1, 10.0, "density of the air")

    def __post_init__(self) -> None:
        check_ranges(self)

    @property
    def reach(self) -> float:
        """Way of the vehicle per angle of the output [m/rad]."""
        return self.wheel_radius / self.final_drive

    @property
    def inertia(self) -> float:
        """Inertia of vehicle and wheels at the output [kg m2]."""
        return (self.mass * self.wheel_radius**2 + self.wheel_inertia) / self.final_drive**2

    def driveline(self, elastic: bool) -> dict[str, float]:
        """Return the transmission's parameters; an ``elastic`` shaft has its inertia behind it."""
        weight = self.mass * GRAVITY * self.reach / math.hypot(1.0, self.grade)
        drag = 0.5 * self.air_density * self.drag_area * (LOAD_SPEED * self.reach) ** 2 * self.reach
        return {
            "vehicle_inertia" if elastic else "carrier_inertia": self.inertia,
            "load_torque": drag,
            "load_speed": LOAD_SPEED,
            "rolling_torque": self.rolling * weight,
            "grade_torque": self.grade * weight,
        }
