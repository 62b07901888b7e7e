"""A vehicle as a small FMU: what it asks of the transmission's output at a speed."""

from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Vehicle(Fmi2Slave):
    """Load [N m] of rolling, air and slope at a speed [rad/s] of the transmission's output."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.mass, self.reach = 1650.0, 0.32 / 3.2  # kg, wheel radius over final drive [m]
        self.rolling, self.drag_area, self.grade = 0.011, 0.68, 0.0
        self.speed, self.load, self.distance = 0.0, 0.0, 0.0
        self.register_variable(Real("speed", causality=Fmi2Causality.input))
        for name in ("load", "distance"):
            self.register_variable(Real(name, causality=Fmi2Causality.output))
        for name in ("mass", "reach", "rolling", "drag_area", "grade"):
            self.register_variable(
                Real(name, causality=Fmi2Causality.parameter, variability="tunable")
            )

    def do_step(self, current_time, step_size):
        weight, v = 9.80665 * self.mass, self.speed * self.reach
        force = weight * (self.rolling + self.grade) + 0.6 * self.drag_area * v * abs(v)
        self.load, self.distance = force * self.reach, self.distance + v * step_size
        return True
