"""Going back to a point: the states of all instances, and what the master itself holds of them."""

from __future__ import annotations

from typing import Any, NamedTuple

from .state import with_state
from .system import System


class Held(NamedTuple):
    """A point of a run, in the order of the system's parts."""

    states: list[Any]
    inputs: list[list[float]]
    outputs: list[list[float]]


class Rollback:
    """Holds points of a run and gives them back; ParameterError if a part has no state to save."""

    def __init__(self, system: System, master: str) -> None:
        self.parts = list(system.parts.values())
        self._instances = [with_state(part, master) for part in self.parts]

    def hold(self) -> Held:
        """Return the present point; let go of it with ``drop``."""
        return Held(
            [instance.get_state() for instance in self._instances],
            [list(part.inputs) for part in self.parts],
            [list(part.outputs) for part in self.parts],
        )

    def give_back(self, held: Held) -> None:
        """Go back to a point, which stays held."""
        for part, instance, state, inputs, outputs in zip(
            self.parts, self._instances, *held, strict=True
        ):
            instance.set_state(state)
            part.inputs, part.outputs = list(inputs), list(outputs)

    def drop(self, *points: Held) -> None:
        """Let go of points."""
        for held in points:
            for instance, state in zip(self._instances, held.states, strict=True):
                instance.free_state(state)
