"""Sequential master: friction parts first, then the transmission with their fresh torques."""

from .moves import Move, Pull, Step
from .system import System


def schedule(system: System) -> list[Move]:
    """Return the moves of one communication step."""
    return [
        move for part in (*system.friction_parts, system.transmission)
        for move in (Pull(part), Step(part))
    ]  # fmt: skip
