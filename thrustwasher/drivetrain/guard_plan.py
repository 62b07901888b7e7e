"""What a guard has to know about a part, and what it leaves behind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from .system import Stepping


class Scale(NamedTuple):
    """How far apart two values of an output are.

    Their difference over ``floor`` or, if ``relative``, over the value of the rung above if that is
    larger.
    """

    output: str
    floor: float
    relative: bool = True

    def between(self, served: float, above: float) -> float:
        """Return the difference as a share."""
        return abs(served - above) / max(self.floor, abs(above) if self.relative else 0.0)


@dataclass(frozen=True, kw_only=True)
class Plan:
    """The guard of one part: two rungs, how they are compared, and how often."""

    base: str
    """The rung that serves."""
    above: str
    """The rung that it is compared with, and that takes over."""
    instance: Stepping
    """Of the rung above; the scene's own instance is of the base."""
    scales: Sequence[Scale]
    tolerance: float
    box: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Inputs [SI] that the base was chosen for: low, high."""
    every: tuple[int, int] = (100, 10)
    """Steps between two looks while the base serves, and while the rung above does."""
    first: int | None = None
    """Point of the first look; default: one stride after the start."""


class Switch(NamedTuple):
    """A change of rung: when [s], why, and the output that differed most in both rungs."""

    time: float
    part: str
    before: str
    after: str
    reason: str
    output: str
    served: float
    other: float


class Course(NamedTuple):
    """A stretch of time [s] in which one rung served."""

    start: float
    end: float
    rung: str


class Post(NamedTuple):
    """What the guard of one part found."""

    part: str
    base: str
    above: str
    tolerance: float
    checks: int
    failed: int
    """Looks at which the rung above gave no solution."""
    worst: float
    """Largest difference seen while the base served."""
    seconds: float
    """Spent on looks [s]."""
    courses: list[Course]

    @property
    def shares(self) -> dict[str, float]:
        """Share of simulated time that each rung served."""
        whole = sum(c.end - c.start for c in self.courses) or 1.0
        found = {self.base: 0.0, self.above: 0.0}
        for c in self.courses:
            found[c.rung] += (c.end - c.start) / whole
        return found


class GuardLog(NamedTuple):
    """What all guards of a run did."""

    posts: list[Post]
    switches: list[Switch]

    @property
    def seconds(self) -> float:
        """Spent on looks [s]."""
        return sum(p.seconds for p in self.posts)

    def as_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        posts = [
            {**p._asdict(), "courses": [c._asdict() for c in p.courses], "shares": p.shares}
            for p in self.posts
        ]
        return {"parts": posts, "switches": [s._asdict() for s in self.switches],
                "time": self.seconds, "closing": self.closing()}  # fmt: skip

    def closing(self) -> str:
        """Return what happened in one line."""
        texts = []
        for p in self.posts:
            served = ", ".join(f"{r} {s:.3g} %" for r, s in percent(p.shares).items() if s)
            looks = "1 look" if p.checks == 1 else f"{p.checks} looks"
            texts.append(
                f"{p.part}: {served} of the time; {looks} at {p.above}, worst "
                f"difference {100.0 * p.worst:.2g} % ({100.0 * p.tolerance:.2g} % allowed)"
            )
        return "; ".join(texts)


def percent(shares: Mapping[str, float]) -> dict[str, float]:
    """Return shares in percent."""
    return {name: 100.0 * share for name, share in shares.items()}
