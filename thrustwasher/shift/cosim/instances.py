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

    def machine(self) -> Any:
        """Return the addresses of the C functions, as ``fmu.running.protocol`` lists them."""

    def judge(self, stage: str, status: int) -> None:
        """Raise what a call with this status means; ``stage``: "set", "step" or "get"."""


def can(instance: Stepping, ability: str) -> bool:
    """Tell if an instance has an ability: "saves_state" or "gives_derivatives"."""
    return bool(getattr(instance, ability, False))


def capable(instance: Stepping) -> Capable:
    """Return the same instance as one that can do all of it."""
    return cast(Capable, instance)
