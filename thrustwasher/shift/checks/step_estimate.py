"""What the communication step of a run errs by, estimated: plain data."""

from collections.abc import Mapping
from typing import NamedTuple

from ...units import format_quantity as say

LIMITS = {"lock_time": 0.01, "heat": 0.01, "peak_jerk": 0.05}  # relative; above it is a warning
WORDS = {"lock_time": "lock-up time", "heat": "heat", "peak_jerk": "peak jerk"}


class StepError(NamedTuple):
    """Estimated errors that the communication step makes, relative; None: no such figure.

    ``lock_time`` is relative to the time from the shift's start to lock-up, 1 where only one of
    both runs locks; ``heat`` is that of the engaging pack; ``advice`` is a step [s] that would do,
    the scene's own if it does.
    """

    step: float
    compared_with: float
    advice: float
    heat: float
    lock_time: float | None = None
    peak_jerk: float | None = None

    @property
    def relative(self) -> float:
        """The larger error of lock-up time and heat."""
        return max(self.lock_time or 0.0, self.heat)

    @property
    def suffices(self) -> bool:
        """Whether all errors are below their limits."""
        return excess(self.errors()) <= 1.0

    def errors(self) -> dict[str, float]:
        """Return the errors there are."""
        return {n: x for n in LIMITS if (x := getattr(self, n)) is not None}

    def words(self) -> str:
        """Return the errors as part of a sentence."""
        return ", ".join(f"{100.0 * x:.2g} % in {WORDS[n]}" for n, x in self.errors().items())

    def warnings(self) -> list[str]:
        """Return what must not be missed."""
        if self.suffices:
            return []
        step, advice = (say(x, "s", digits=4) for x in (self.step, self.advice))
        return [
            f"The communication step of {step} is too long: it errs by about {self.words()}; "
            f"{advice} would do (--step)"
        ]


def excess(errors: Mapping[str, float]) -> float:
    """Return the largest error over its limit."""
    return max(x / LIMITS[name] for name, x in errors.items())
