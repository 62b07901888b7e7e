"""Parallel master: all parts step with the outputs of the last communication point."""

from .moves import Move, Pull, Step
from .system import System


def schedule(system: System) -> list[Move]:
    """Return the moves of one communication step."""
    parts = list(system.parts.values())
    return [*map(Pull, parts), *map(Step, parts)]
