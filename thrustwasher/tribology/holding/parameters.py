"""Parameters of units that hold between two shafts of a driveline they do not know."""

from typing import Any

from ...model.parameters import choice, count, quantity
from ...model.spec import Signal

HOLDING = {
    "identified": "a pack asks for inertia and delay of the driveline, then holds; others come to "
    "rest without chatter",
    "given": "the same with coupling_inertia and coupling_age",
    "off": "nothing is held: friction passes through zero as it does without a driveline",
}
OF_GIVEN = (("holding", "given"),)


def holding_choice(unit: str) -> Any:
    """Return the field that says how ``unit`` ("the pack") holds."""
    text = f"how friction_torque holds {unit} where the two shafts of the host could stand still"
    return choice("identified", HOLDING, "Holding", text, of_a_run=True)


def coupling_inertia() -> Any:
    """Return the field of the inertia that the slip sees [kg m2]."""
    text = (
        "inertia that the slip sees: J1 J2/(J1 + J2) of two shafts, J of one; the hub's, not that "
        "of a vehicle behind a shaft"
    )
    more = {"tunable": True, "read_by": OF_GIVEN, "of_a_run": True}
    return quantity(0.1, "kg.m2", 1e-6, 1e6, text, **more)


def coupling_age() -> Any:
    """Return the field of the delay of the torque, in steps of the host."""
    text = "steps after which the torque acts: 0 at once, 1 where values are a step old"
    return count(0, 0, 2, text, read_by=OF_GIVEN, of_a_run=True)


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


def largest_capacity(usual: str, nominal: float) -> Signal:
    """Return the torque [N m] that bends a bristle by its angle; ``usual``: what 0 stands for."""
    text = f"torque that bends the bristle by rest_angle (0: {usual})"
    more: dict[str, Any] = {"low": 0.0, "high": 1e9, "nominal": nominal, "start": 0.0}
    return Signal(name="largest_capacity", unit="N.m", help=text, **more)


def bend_state(name: str, of: str) -> Signal:
    """Return the bending of a bristle, a tenth of whose largest bending is usual."""
    return Signal(
        name=name, unit="rad", help=f"bending {of}; 0 in co-simulation", nominal=0.1 * ANGLE
    )
