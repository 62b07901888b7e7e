"""What a master does in a communication step: a list of moves, the same in every step."""

from __future__ import annotations

from typing import NamedTuple

from .system import ConnectedPart


class Pull(NamedTuple):
    """A part takes its inputs over from the last outputs of the other parts."""

    part: ConnectedPart


class Step(NamedTuple):
    """A part advances with its present inputs."""

    part: ConnectedPart


Move = Pull | Step
