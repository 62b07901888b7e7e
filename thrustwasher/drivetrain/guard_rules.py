"""When the guard of a part goes up a rung and when it comes back: decisions, nothing else."""

from __future__ import annotations

from dataclasses import dataclass

CALM_CHECKS = 10  # running, before the cheap rung may serve again
CALM_SHARE = 1.0 / 3.0  # of the tolerance, that a calm check stays below
OUTSIDE = "outside"  # what the cheap rung was verified for
TOO_FAR = "difference"  # from the rung above


@dataclass(slots=True)
class Memory:
    """All that a decision depends on beside the point itself."""

    up: bool = False
    calm: int = 0
    checks: int = 0
    worst: float = 0.0
    """Largest difference seen while the cheap rung served."""

    def copy(self) -> Memory:
        """Return it as it is now, for a master that may come back to this point."""
        return Memory(self.up, self.calm, self.checks, self.worst)


def decide(memory: Memory, difference: float | None, outside: bool, tolerance: float) -> str | None:
    """Book a look at a part and return why its rung changes, or None.

    Parameters
    ----------
    memory : changed here
    difference : of the two rungs, in the unit of ``tolerance``; None: not compared this time
    outside : the cheap rung says, or its box says, that it was not verified here
    tolerance : largest difference allowed

    Returns
    -------
    OUTSIDE or TOO_FAR to go up, "calm" to come back, None to stay
    """
    if difference is not None:
        memory.checks += 1
        if not memory.up:
            memory.worst = max(memory.worst, difference)
    if not memory.up:
        if outside or (difference is not None and not difference <= tolerance):
            memory.up, memory.calm = True, 0
            return OUTSIDE if outside else TOO_FAR
        return None
    if outside:
        memory.calm = 0
    elif difference is not None:
        memory.calm = memory.calm + 1 if difference < CALM_SHARE * tolerance else 0
        if memory.calm >= CALM_CHECKS:
            memory.up, memory.calm = False, 0
            return "calm"
    return None
