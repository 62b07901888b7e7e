"""What was chosen for a run at a tolerance and why, and what its check found: plain data."""

from math import inf, isnan
from typing import Any, NamedTuple

from ...units import format_quantity as say

STEP_SHARE = 0.3  # of the tolerance asked for is the communication step's
Box = dict[str, tuple[float, float]]


class Scale(NamedTuple):
    """How far apart two values of an output are.

    Their difference over ``floor`` or, if ``relative``, over the value of the rung above if that is
    larger.
    """

    output: str
    floor: float
    relative: bool = True

    def between(self, served: float, above: float) -> float:
        """Return the difference as a share; infinite if it is no number."""
        share = abs(served - above) / max(self.floor, abs(above) if self.relative else 0.0)
        return inf if isnan(share) else share


class Selected(NamedTuple):
    """The rung of one part and why."""

    part: str
    model: str
    rung: str
    above: str | None
    """The rung that the check compares with; None: there is none, or no card chose."""
    tolerance: float  # the rung's share of the tolerance asked for
    verified: bool  # False: no card speaks for these parameters, and the model's default serves
    words: tuple[str, ...]
    box: Box
    scales: tuple[Scale, ...]


class StepShare(NamedTuple):
    """The largest error that the step makes in a figure, estimated, and the figure."""

    step: float
    tolerance: float
    error: float
    figure: str

    @property
    def suffices(self) -> bool:
        """True if the error stays within the step's share of the tolerance."""
        return self.error <= STEP_SHARE * self.tolerance

    def words(self) -> str:
        """Return it as a sentence."""
        share = 100.0 * STEP_SHARE * self.tolerance
        text = (
            f"communication step {say(self.step, 's')}: about {100.0 * self.error:.2g} % in "
            f"{self.figure.replace('_', ' ')}"
        )
        if self.suffices:
            return f"{text}, within its share of {share:.2g} %"
        wanted = self.step * STEP_SHARE * self.tolerance / self.error
        return f"{text}, more than its share of {share:.2g} %; {wanted:.2g} s would do"


class Selection(NamedTuple):
    """What was chosen for a run, why, and what finding it took."""

    parts: list[Selected]
    step: StepShare
    trial_seconds: float

    def words(self) -> list[str]:
        """Return the reasons, line by line."""
        return [line for part in self.parts for line in part.words] + [self.step.words()]

    def as_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        parts = [
            {"part": p.part, "rung": p.rung, "above": p.above, "tolerance": p.tolerance,
             "verified": p.verified, "box": p.box} for p in self.parts
        ]  # fmt: skip
        return {"parts": parts, "step_error": self.step.error, "step_figure": self.step.figure,
                "scout_time": self.trial_seconds, "reasons": self.words()}  # fmt: skip


class Difference(NamedTuple):
    """An output of a part in the rung that served and in the one above, and its time [s]."""

    share: float
    output: str = ""
    time: float = 0.0
    served: float = 0.0
    above: float = 0.0


class Check(NamedTuple):
    """What the check of one part after a run found."""

    run: int  # which run: 1 is the first
    part: str
    rung: str  # the rung that served
    above: str  # the rung that it was compared with
    tolerance: float
    points: int  # recorded points at which the two were compared
    failed: tuple[str, ...]  # points at which the rung above gave no solution, with its message
    worst: Difference
    outside: str  # how the run left what the rung is verified for; empty if it did not
    seconds: float

    @property
    def holds(self) -> bool:
        """True if the rung keeps its promise in this run, as far as it was checked."""
        return not self.outside and self.worst.share <= self.tolerance

    def words(self) -> str:
        """Return it as a sentence."""
        points = "1 point" if self.points == 1 else f"{self.points} points"
        text = (
            f"{self.part}: {self.rung}, compared with {self.above} at {points}, worst difference "
            f"{100.0 * self.worst.share:.2g} % ({100.0 * self.tolerance:.2g} % allowed)"
        )
        if self.failed:
            text += f"; {len(self.failed)} without a solution, first {self.failed[0]}"
        return f"{text}; {self.outside}" if self.outside else text


class CheckRecord(NamedTuple):
    """What was checked after a run, and what was run again."""

    checks: list[Check]  # in the order they were made: those of every run
    again: list[str]  # what every further run changed, in words
    earlier_seconds: float  # wall time of the runs that did not count in the end [s]
    stopped: str = ""  # why a run a rung higher came to nothing; then the one before it counts

    @property
    def seconds(self) -> float:
        """Spent on checks [s]."""
        return sum(check.seconds for check in self.checks)

    def as_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        checks = [
            {**c._asdict(), "worst": c.worst._asdict(), "holds": c.holds} for c in self.checks
        ]
        return {"checks": checks, "run_again": self.again, "stopped": self.stopped or None,
                "time": self.seconds, "earlier_time": self.earlier_seconds,
                "closing": self.closing()}  # fmt: skip

    def closing(self) -> str:
        """Return what happened in one line."""
        texts = []
        for run, after in enumerate([*self.again, self.stopped], 1):
            texts += [*(c.words() for c in self.checks if c.run == run), after]
        return "; ".join(filter(None, texts))
