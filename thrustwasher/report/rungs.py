"""Which rung of which part ran when, why, and what its guard saw."""

from __future__ import annotations

from typing import Any, NamedTuple


class Stretch(NamedTuple):
    """One rung of one part, from one time to another [s]."""

    part: str
    rung: str
    start: float
    end: float


class Watched(NamedTuple):
    """What the guard of one part saw; tolerance and worst are shares, seconds its own cost."""

    part: str
    base: str
    above: str
    tolerance: float
    checks: int
    worst: float
    seconds: float


class Change(NamedTuple):
    """A change of rung, with the output that was looked at in both rungs."""

    time: float
    part: str
    before: str
    after: str
    reason: str
    output: str
    served: float
    other: float


class Rungs(NamedTuple):
    """The choice of rungs of a run, and its guard."""

    reasons: list[str]
    scout_seconds: float
    watched: list[Watched]
    stretches: list[Stretch]
    changes: list[Change]
    closing: str


def rungs_of(result: Any) -> Rungs | None:
    """Return what a shift result of the drivetrain says of its rungs; None if nothing."""
    chosen, guard = result.selection, result.guard
    if chosen is None and guard is None:
        return None
    posts = guard.posts if guard else []
    return Rungs(
        reasons=chosen.words() if chosen else [],
        scout_seconds=chosen.scout_seconds if chosen else 0.0,
        watched=[Watched(p.part, p.base, p.above, p.tolerance, p.checks, p.worst, p.seconds)
                 for p in posts],
        stretches=[Stretch(p.part, c.rung, c.start, c.end) for p in posts for c in p.courses],
        changes=[Change(*switch) for switch in guard.switches] if guard else [],
        closing=guard.closing() if guard else "",
    )  # fmt: skip
