"""What a master asks of an instance: ``Stepping``, and what only some instances can do beside it.

An instance is anything with the methods of ``Stepping``: an FMU that is kept alive, or the kernels
called in this process. Both kinds save their state and give slopes; ``saves_state`` and
``gives_derivatives`` tell if an FMU can. An FMU also gives the addresses of its C functions, for
the compiled loop.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol, cast


class Stepping(Protocol):
    """What a master needs from an instance."""

    input_names: list[str]
    output_names: list[str]
    calls: int
    wall_time: float
    instantiate_time: float
    initialize_time: float

    def initialize(self, start_time: float, inputs: Mapping[str, float]) -> None:
        """Set the inputs at the start and solve there."""

    def set_inputs(self, values: Sequence[float]) -> None:
        """Set all inputs, in the order of ``input_names``."""

    def step(self, t: float, h: float) -> None:
        """Advance from ``t`` to ``t + h``."""

    def outputs(self) -> list[float]:
        """Return all outputs, in the order of ``output_names``."""


class CCall(Protocol):
    """A C function that sets or gets the values of one type."""

    function: int
    """Its address."""
    references: int
    """Address of the value references."""
    places: list[int]
    """Where the values stand among all inputs or all outputs."""
    kind: str
    """C type of a value: "real", "int32", "int64" or "byte"."""


class CAddresses(Protocol):
    """The addresses of an instance."""

    third: bool
    """True for the calls of FMI 3, False for those of FMI 2."""
    component: int
    """The instance, the first argument of every call."""
    step: int
    """The function that steps."""
    setters: Sequence[CCall]
    """Calls that set all inputs."""
    getters: Sequence[CCall]
    """Calls that get all outputs."""
    said: int
    """A 64-bit number that is not 0 once the instance has logged something."""


class Capable(Stepping, Protocol):
    """All that an instance may be able to do; ask before: ``saves_state`` and the like."""

    def get_state(self) -> Any:
        """Return a handle of the complete state."""

    def set_state(self, state: Any) -> None:
        """Go back to a state."""

    def free_state(self, state: Any) -> None:
        """Give a state back."""

    def directional_derivative(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> list[float]:
        """Return how outputs change along a direction of the inputs, memory held."""

    def get(self, names: Sequence[str]) -> list[float]:
        """Return variables by name, parameters among them."""

    def machine(self) -> CAddresses:
        """Return the addresses of the C functions, valid until the instance is closed."""

    def judge(self, stage: str, status: int) -> None:
        """Raise what a call with this status means; ``stage``: "set", "step" or "get"."""


def saves_state(instance: Stepping) -> bool:
    """Tell if an instance can go back."""
    return bool(getattr(instance, "saves_state", False))


def gives_derivatives(instance: Stepping) -> bool:
    """Tell if an instance has directional derivatives."""
    return bool(getattr(instance, "gives_derivatives", False))


def tells_values(instance: Stepping) -> bool:
    """Tell if an instance returns variables by name."""
    return hasattr(instance, "get")


def has_c_addresses(instance: Stepping) -> bool:
    """Tell if an instance gives the addresses of its C functions."""
    return hasattr(instance, "machine") and hasattr(instance, "judge")


def capable(instance: Stepping) -> Capable:
    """Return the same instance as one that can do all of it."""
    return cast(Capable, instance)
