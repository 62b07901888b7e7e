"""Which rung every part had, why, and what the check of the choice found."""

from __future__ import annotations

from typing import Any, NamedTuple


class Check(NamedTuple):
    """A part's rung compared with the one above; tolerance and worst are shares, seconds cost."""

    part: str
    rung: str
    above: str
    points: int
    worst: float
    tolerance: float
    seconds: float
    holds: bool
    outside: str
    failed: tuple[str, ...]


class Rungs(NamedTuple):
    """The choice of rungs of a run, its checks, and what was run again."""

    reasons: list[str]
    trial_seconds: float
    checks: list[Check]
    again: list[str]
    earlier_seconds: float
    closing: str


def rungs_of(result: Any) -> Rungs | None:
    """Return what a shift result of the drivetrain says of its rungs; None if nothing."""
    chosen, guard = result.selection, result.guard
    if chosen is None:
        return None
    checks = guard.checks if guard else []
    return Rungs(
        reasons=chosen.words(),
        trial_seconds=chosen.trial_seconds,
        checks=[
            Check(c.part, c.rung, c.above, c.points, c.worst.share, c.tolerance, c.seconds, c.holds,
                  c.outside, c.failed)
            for c in checks
        ],
        again=[*guard.again, *filter(None, [guard.stopped])] if guard else [],
        earlier_seconds=guard.earlier_seconds if guard else 0.0,
        closing=guard.closing() if guard else "",
    )  # fmt: skip
