"""Events of the part that moves: what changes between two points, and where in a step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from .parts import SPEED
from .state import with_state
from .system import System

CLOSE = 1e-9  # of a step: how closely an event is located
HALVINGS = 60
TURN = 10.0  # of the error of a slip: less is no change of sign


class Seen(NamedTuple):
    """What an event changes."""

    whole: list[float]
    """Counts and flags of the moving part, such as its number of lock-ups."""
    slips: list[float]
    """Speeds it sends to parts that rub."""


class Events:
    """Finds events in steps of a system.

    A slip that changes its sign is one if it changes by more than ten times ``tolerance`` of its
    nominal value: what rattles about zero within the error is left alone.
    """

    def __init__(
        self, system: System, command: Callable[[float], float], master: str, tolerance: float
    ) -> None:
        self.system, self._command = system, command
        self.hub = hub = system.transmission
        self._keeper = with_state(hub, master)
        kinds = [signal.kind for signal in hub.spec.outputs]
        self._whole = [i for i, kind in enumerate(kinds) if kind in ("integer", "boolean")]
        self._slips = sorted({
            output for part in system.friction_parts for slot, source, output in part.sources
            if source is hub and part.input_names[slot] == SPEED
        })  # fmt: skip
        self._least = [TURN * tolerance * (hub.spec.outputs[i].nominal or 1.0) for i in self._slips]

    def seen(self) -> Seen:
        """Return what there is to be seen at the present point."""
        out = self.hub.outputs
        return Seen([out[i] for i in self._whole], [out[i] for i in self._slips])

    def between(self, a: Seen, b: Seen) -> bool:
        """Tell if there was an event between two points: a count or flag, or a slip turned."""
        turned = any(
            x * y < 0.0 and abs(x - y) > least
            for x, y, least in zip(a.slips, b.slips, self._least, strict=True)
        )
        return turned or a.whole != b.whole

    def locate(self, t: float, h: float, before: Seen, state: Any) -> float:
        """Return the time from ``t`` to the first event in a step of length ``h`` that has one.

        The torques of that step are the hub's present inputs, ``state`` is its state at ``t``;
        after it the hub is somewhere in the step. A step of the length returned has the event.
        """
        hub, low, high = self.hub, 0.0, h
        for _ in range(HALVINGS):
            if high - low <= CLOSE * h:
                break
            middle = 0.5 * (low + high)
            self._keeper.set_state(state)
            self.system.set_command(self._command(t + middle))
            hub.step(t, middle)
            if self.between(before, self.seen()):
                high = middle
            else:
                low = middle
        return high
