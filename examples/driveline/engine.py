"""An engine as a small FMU: what is demanded of it, up to its full load at its speed."""

from bisect import bisect_right

from pythonfmu import Fmi2Causality, Fmi2Slave, Real

FULL_LOAD = ((100.0, 180.0), (200.0, 260.0), (400.0, 270.0), (600.0, 220.0))  # rad/s, N m
DEMAND = ((0.0, 253.0), (0.42, 253.0), (0.46, 155.0), (0.73, 170.0), (0.83, 200.0), (1.08, 253.0))


def along(points, x):
    """Return the value of a profile of points at ``x``, held beyond its ends."""
    i = min(max(bisect_right(points, (x, float("inf"))), 1), len(points) - 1)
    (a, ya), (b, yb) = points[i - 1], points[i]
    return ya + (yb - ya) * min(max((x - a) / (b - a), 0.0), 1.0)


class Engine(Fmi2Slave):
    """Torque [N m] at a speed [rad/s]; the demand is cut while a gear is changed."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.speed, self.torque = 361.3, DEMAND[0][1]
        self.register_variable(Real("speed", causality=Fmi2Causality.input))
        self.register_variable(Real("torque", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        # The torque in the middle of the step that follows, since it is held there.
        demand = along(DEMAND, current_time + 1.5 * step_size)
        self.torque = min(demand, along(FULL_LOAD, self.speed))
        return True
