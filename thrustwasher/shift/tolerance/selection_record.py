"""What was chosen for a run at a tolerance and why, and what its check found: plain data."""

from itertools import pairwise
from math import inf, isnan
from typing import Any, NamedTuple

Box = dict[str, tuple[float, float]]


class Scale(NamedTuple):
    """How far apart two values of an output are.

    Their difference over ``floor`` or, if ``relative``, over the value of the level above if that
    is larger.
    """

    output: str
    floor: float
    relative: bool = True

    def between(self, served: float, above: float) -> float:
        """Return the difference as a share; infinite if it is no number."""
        share = abs(served - above) / max(self.floor, abs(above) if self.relative else 0.0)
        return inf if isnan(share) else share


class Selected(NamedTuple):
    """The levels of one part that may serve, cheapest first, and why."""

    part: str
    levels: tuple[str, ...]
    tolerance: float  # the level's share of the tolerance requested
    verified: bool  # a table of measured errors speaks of the first one
    words: tuple[str, ...]
    box: Box  # the inputs that the first run has recorded
    scales: tuple[Scale, ...]

    @property
    def fidelity(self) -> str:
        """The level that was chosen."""
        return self.levels[0]

    def after(self, fidelity: str) -> str | None:
        """Return the next level after one of them; None: it is the last."""
        return dict(pairwise(self.levels)).get(fidelity)


class Selection(NamedTuple):
    """What was chosen for a run, and why."""

    parts: list[Selected]

    def words(self) -> list[str]:
        """Return the reasons, line by line."""
        return [line for part in self.parts for line in part.words]

    def as_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        parts = [
            {
                "part": p.part,
                "fidelity": p.fidelity,
                "above": p.after(p.fidelity),
                "tolerance": p.tolerance,
                "verified": p.verified,
                "box": p.box,
            }
            for p in self.parts
        ]
        return {"parts": parts, "reasons": self.words()}


class Difference(NamedTuple):
    """An output of a part in the level that served and in the one above, and its time [s]."""

    share: float
    output: str = ""
    time: float = 0.0
    served: float = 0.0
    above: float = 0.0


class Check(NamedTuple):
    """What the check of one part after a run found."""

    run: int  # which run: 1 is the first
    part: str
    fidelity: str  # the level that served
    above: str  # the level that it was compared with
    tolerance: float
    points: int  # recorded points at which the two were compared
    failed: tuple[str, ...]  # points at which the level above gave no solution, with its message
    worst: Difference
    outside: str  # how the run left what the level is verified for; empty if it did not
    seconds: float

    @property
    def holds(self) -> bool:
        """True if the level keeps its promise in this run, as far as it was checked."""
        return not self.outside and self.worst.share <= self.tolerance

    def words(self) -> str:
        """Return it as a sentence."""
        points = "1 point" if self.points == 1 else f"{self.points} points"
        text = (
            f"{self.part}: {self.fidelity}, compared with {self.above} at {points}, worst "
            f"difference {100.0 * self.worst.share:.2g} % ({100.0 * self.tolerance:.2g} % allowed)"
        )
        if self.failed:
            text += f"; {len(self.failed)} without a solution, first {self.failed[0]}"
        return f"{text}; {self.outside}" if self.outside else text


class CheckRecord(NamedTuple):
    """What was checked after a run, and what was run again."""

    checks: list[Check]  # in the order they were made: those of every run
    again: list[str]  # what every further run changed, in words
    earlier_seconds: float  # wall time of the runs that did not count in the end [s]
    stopped: str = ""  # why a run a level higher came to nothing; then the one before it counts

    @property
    def seconds(self) -> float:
        """Spent on checks [s]."""
        return sum(check.seconds for check in self.checks)

    def as_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        checks = [
            {**c._asdict(), "worst": c.worst._asdict(), "holds": c.holds} for c in self.checks
        ]
        return {
            "checks": checks,
            "run_again": self.again,
            "stopped": self.stopped or None,
            "time": self.seconds,
            "earlier_time": self.earlier_seconds,
            "closing": self.closing(),
        }

    def closing(self) -> str:
        """Return what happened in one line."""
        texts = []
        for run, after in enumerate([*self.again, self.stopped], 1):
            texts += [*(c.words() for c in self.checks if c.run == run), after]
        return "; ".join(filter(None, texts))
