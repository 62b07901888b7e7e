"""A clutch that locks: the least problem in which co-simulation goes wrong.

Slip w of a reduced inertia J: J dw/dt = T_d - T_f sign(w), sticking while |T_d| <= T_f. The drive
is constant; friction is too, unless a film has to be squeezed out first. It is smoothed over a slip
of w_s where a method needs it. The methods are in ``lockup_methods``.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

Row = np.ndarray[tuple[int], np.dtype[np.float64]]
FINE = 400_001  # times at which slip and heat are summed up where there is no closed form


@dataclass(frozen=True)
class Clutch:
    """The problem; SI units."""

    inertia: float = 0.2
    friction: float = 100.0
    drive: float = 40.0
    slip: float = 150.0  # at the start
    width: float = 0.05  # w_s of smoothed friction
    span: float = 1.0
    lag: float = 0.0  # s in which the film goes down to 1/e and friction comes up

    @property
    def lock_time(self) -> float:
        """[s]."""
        if self.lag == 0.0:
            return self.slip * self.inertia / (self.friction - self.drive)
        return self._summed[0]

    @property
    def slip_energy(self) -> float:
        """[J] turned into heat until lock-up."""
        if self.lag == 0.0:
            return 0.5 * self.friction * self.slip * self.lock_time
        return self._summed[1]

    @cached_property
    def _summed(self) -> tuple[float, float]:
        """Time of lock-up and heat until then, summed up in fine steps."""
        time = np.linspace(0.0, self.span, FINE)
        torque = self.friction * (1.0 - np.exp(-time / self.lag))
        slip = self.slip + _sums((self.drive - torque) / self.inertia, time)
        heat = _sums(torque * slip, time)
        k = int(np.argmax(slip <= 0.0))
        part = slip[k - 1] / (slip[k - 1] - slip[k])
        lock = time[k - 1] + part * (time[k] - time[k - 1])
        return float(lock), float(heat[k - 1] + part * (heat[k] - heat[k - 1]))

    def film_after(self, film: float, h: float) -> float:
        """Return how much of the film is gone (0 .. 1) ``h`` later."""
        return 1.0 - (1.0 - film) * math.exp(-h / self.lag) if self.lag else 1.0

    def smooth(self, w: float, film: float = 1.0) -> float:
        """Return the smoothed friction torque [N m]."""
        return self.friction * film * math.tanh(w / self.width)


def _sums(rate: Row, time: Row) -> Row:
    """Integrate by trapezoids from the start on."""
    parts = 0.5 * (rate[1:] + rate[:-1]) * np.diff(time)
    return np.concatenate(([0.0], np.cumsum(parts)))


class Now(NamedTuple):
    """All that a method knows at a communication point."""

    time: float
    slip: float
    heat: float
    film: float  # how much of it is gone
    own: float  # what else the method keeps: a torque of a step ago, a step that went well
    work: int  # torques evaluated


class Rewind(NamedTuple):
    """A master that goes back: ``ahead`` steps every ``every`` steps, then from there again."""

    every: int = 1000
    ahead: int = 100
    forgets: bool = False  # the film and what the method keeps stay where they were


@dataclass(frozen=True)
class Run:
    """Slip over time, the heat at the end and how often a torque was evaluated."""

    slip: Row
    energy: float
    work: int = 0

    def chatter(self, clutch: Clutch) -> int:
        """Return how often the slip turns round after lock-up."""
        n = len(self.slip)
        first = min(n - 1, math.ceil(clutch.lock_time / clutch.span * (n - 1)))
        return turns_of(self.slip[first:], 0.2 * clutch.width)


def turns_of(slip: Row, least: float) -> int:
    """Return how often a slip changes its sign, sizes up to ``least`` left out."""
    return int(np.count_nonzero(np.diff(np.sign(slip[np.abs(slip) > least]))))


Advance = Callable[[Clutch, Now, float], Now]


def begin(clutch: Clutch) -> Now:
    """Return the start."""
    film = 0.0 if clutch.lag else 1.0
    return Now(0.0, clutch.slip, 0.0, film, clutch.smooth(clutch.slip, film), 0)


def walk(clutch: Clutch, step: float, advance: Advance, rewind: Rewind | None = None) -> Run:
    """Step to the end of the span; ``advance`` returns what is known a step later."""
    n = round(clutch.span / step)
    now = begin(clutch)
    slip = np.empty(n + 1)
    slip[0] = now.slip
    for i in range(n):
        if rewind and i and i % rewind.every == 0:
            now = gone_back(clutch, now, step, advance, rewind)
        now = advance(clutch, now, step)
        slip[i + 1] = now.slip
    return Run(slip, now.heat, now.work)


def gone_back(clutch: Clutch, now: Now, step: float, advance: Advance, rewind: Rewind) -> Now:
    """Go some steps ahead and back again; return what is known then."""
    kept = now
    for _ in range(rewind.ahead):
        now = advance(clutch, now, step)
    if rewind.forgets:
        return kept._replace(film=now.film, own=now.own, work=now.work)
    return kept._replace(work=now.work)
