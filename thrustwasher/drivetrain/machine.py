"""Instances that the compiled loop can step: those that give their addresses.

They have two methods more than ``Stepping``; what they return has these names and types.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, cast

from .system import Stepping


class Group(Protocol):
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


class Machine(Protocol):
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
    def setters(self) -> Sequence[Group]:
        """Calls that set all inputs."""

    @property
    def getters(self) -> Sequence[Group]:
        """Calls that get all outputs."""

    @property
    def said(self) -> int:
        """Address of a 64-bit number that is not 0 once the instance has logged something."""


class WithMachine(Protocol):
    """What such an instance has beside the methods of ``Stepping``."""

    def machine(self) -> Machine:
        """Return the addresses, valid until the instance is closed."""

    def judge(self, stage: str, status: int) -> None:
        """Raise what a call with this status means; ``stage``: "set", "step" or "get"."""


def has_machine(instance: Stepping) -> bool:
    """Tell if an instance gives its addresses."""
    return hasattr(instance, "machine") and hasattr(instance, "judge")


def machine_of(instance: Stepping) -> WithMachine:
    """Return the same instance, seen as one that gives its addresses."""
    return cast(WithMachine, instance)
