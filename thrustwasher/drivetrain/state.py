"""Instances that can go back: those that save their state, and slopes of those that give them.

Such an instance has methods beside those of ``Stepping``; both kinds of instances of this package
have them, and ``saves_state`` and ``gives_derivatives`` tell if an FMU can do what they ask for.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, cast

from ..errors import ParameterError
from .system import ConnectedPart


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


def saves_state(part: ConnectedPart) -> bool:
    """Tell if the part's present instance can go back."""
    return bool(getattr(part.instance, "saves_state", False))


def gives_derivatives(part: ConnectedPart) -> bool:
    """Tell if the part's present instance has directional derivatives."""
    return bool(getattr(part.instance, "gives_derivatives", False))


def with_state(part: ConnectedPart, master: str) -> WithState:
    """Return the part's instance as one that saves its state; ParameterError if it cannot."""
    if not saves_state(part):
        raise ParameterError(
            f"master = {master!r}: {part.name} cannot save its state, allowed: with parts that can "
            "(canGetAndSetFMUstate); 'gauss-seidel' and 'jacobi' need no state"
        )
    return cast(WithState, part.instance)


def with_derivatives(part: ConnectedPart) -> WithDerivatives:
    """Return the part's instance as one that gives directional derivatives."""
    return cast(WithDerivatives, part.instance)
