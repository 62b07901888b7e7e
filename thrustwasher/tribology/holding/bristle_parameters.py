"""Parameters and states of the bristles by which units rest in model exchange."""

from ...model.spec import Signal

ANGLE = 3.490658503988659e-4  # rad, 0.02 degree


def _quantity(name: str, unit: str, start: float, ends: tuple[float, float], text: str) -> Signal:
    return Signal(
        name=name, unit=unit, help=text, start=start, nominal=start, low=ends[0], high=ends[1]
    )


# In the order of the kernels' places.
BRISTLE = (
    _quantity("rest_angle", "rad", ANGLE, (1e-6, 0.1), "bristle bends so far under its capacity"),
    _quantity(
        "rest_damping_time", "s", 2e-3, (0.0, 1.0), "damping of a bristle at rest over stiffness"
    ),
    _quantity("rest_speed", "rad/s", 5.0, (1e-3, 1e3), "bristle settles in sliding over this slip"),
)


def bend_state(name: str, of: str) -> Signal:
    """Return the bending of a bristle, a tenth of whose largest bending is usual."""
    return Signal(
        name=name, unit="rad", help=f"bending {of}; 0 in co-simulation", nominal=0.1 * ANGLE
    )
