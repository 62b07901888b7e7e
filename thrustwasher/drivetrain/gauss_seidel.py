"""Sequential master: friction parts first, then the transmission with their fresh torques."""

from .system import System


def advance(system: System, t: float, h: float) -> None:
    """Carry all parts from ``t`` to ``t + h``."""
    for part in system.friction_parts:
        part.pull()
        part.step(t, h)
    system.transmission.pull()
    system.transmission.step(t, h)
