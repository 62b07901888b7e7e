"""What a master does in a communication step: a list of moves, the same in every step."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from .system import ConnectedPart


class Pull(NamedTuple):
    """A part takes its inputs over from the last outputs of the other parts."""

    part: ConnectedPart


class Change(Protocol):
    """Changes the present inputs of a part before it steps."""

    def __call__(self, t: float, h: float) -> None:
        """Change them for the step from ``t`` to ``t + h``."""

    def words(self) -> list[str]:
        """Say what a reader of the run has to know."""


class Correct(NamedTuple):
    """The inputs of a part are changed before it steps."""

    part: ConnectedPart
    change: Change


class Step(NamedTuple):
    """A part advances with its present inputs."""

    part: ConnectedPart


Move = Pull | Correct | Step
