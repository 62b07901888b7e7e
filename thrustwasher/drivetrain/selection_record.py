"""What was chosen for a run at a tolerance, and why: plain data."""

from __future__ import annotations

from typing import Any, NamedTuple

from ..units import format_quantity as say
from .guard_plan import Scale

STEP_SHARE = 0.3  # of the tolerance asked for is the communication step's
Box = dict[str, tuple[float, float]]


class Selected(NamedTuple):
    """The rung of one part and why."""

    part: str
    model: str
    rung: str
    above: str | None
    """The rung that a guard compares with; None: this is the last."""
    tolerance: float
    """The rung's share of the tolerance asked for."""
    verified: bool
    """False: no card speaks for these parameters, and the model's default serves."""
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
    scout_seconds: float

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
                "scout_time": self.scout_seconds, "reasons": self.words()}  # fmt: skip
