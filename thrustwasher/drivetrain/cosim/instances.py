"""What a master asks of an instance: ``Stepping``, and what only some instances can do beside it.

An instance is anything with the methods of ``Stepping``: an FMU that is kept alive, or the kernels
called in this process. Both kinds save their state and give slopes; ``saves_state`` and
``gives_derivatives`` tell if an FMU can. An FMU also gives the addresses of its C functions, for
the compiled loop.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol, cast, runtime_checkable


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


class WithState(Protocol):
    """What an instance that saves its state has beside the methods of ``Stepping``."""

    def get_state(self) -> Any:
        """Return a handle of the complete state."""

    def set_state(self, state: Any) -> None:
        """Go back to a state."""

    def free_state(self, state: Any) -> None:
        """Give a state back."""


class WithDerivatives(Protocol):
    """What an instance with directional derivatives has beside the methods of ``Stepping``."""

    def directional_derivative(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> list[float]:
        """Return how outputs change along a direction of the inputs, memory held."""


@runtime_checkable
class WithParameters(Protocol):
    """An instance that tells the values of its variables."""

    def get(self, names: Sequence[str]) -> list[float]:
        """Return variables by name."""


class CCall(Protocol):
    """A C function that sets or gets the values of one type."""

    @property
    def function(self) -> int:
        """Address of the function."""

    @property
    def references(self) -> int:
        """Address of the value references."""

    @property
    def places(self) -> list[int]:
        """Where the values stand among all inputs or all outputs."""

    @property
    def kind(self) -> str:
        """C type of a value: "real", "int32", "int64" or "byte"."""


class CAddresses(Protocol):
    """The addresses of an instance."""

    @property
    def third(self) -> bool:
        """True for the calls of FMI 3, False for those of FMI 2."""

    @property
    def component(self) -> int:
        """Address of the instance, the first argument of every call."""

    @property
    def step(self) -> int:
        """Address of the function that steps."""

    @property
    def setters(self) -> Sequence[CCall]:
        """Calls that set all inputs."""

    @property
    def getters(self) -> Sequence[CCall]:
        """Calls that get all outputs."""

    @property
    def said(self) -> int:
        """Address of a 64-bit number that is not 0 once the instance has logged something."""


class WithCAddresses(Protocol):
    """What an instance that the compiled loop can step has beside the methods of ``Stepping``."""

    def machine(self) -> CAddresses:
        """Return the addresses, valid until the instance is closed."""

    def judge(self, stage: str, status: int) -> None:
        """Raise what a call with this status means; ``stage``: "set", "step" or "get"."""


def saves_state(instance: Stepping) -> bool:
    """Tell if an instance can go back."""
    return bool(getattr(instance, "saves_state", False))


def gives_derivatives(instance: Stepping) -> bool:
    """Tell if an instance has directional derivatives."""
    return bool(getattr(instance, "gives_derivatives", False))


def has_c_addresses(instance: Stepping) -> bool:
    """Tell if an instance gives the addresses of its C functions."""
    return hasattr(instance, "machine") and hasattr(instance, "judge")


def with_derivatives(instance: Stepping) -> WithDerivatives:
    """Return the same instance as one that gives directional derivatives."""
    return cast(WithDerivatives, instance)


def with_c_addresses(instance: Stepping) -> WithCAddresses:
    """Return the same instance as one that gives the addresses of its C functions."""
    return cast(WithCAddresses, instance)
