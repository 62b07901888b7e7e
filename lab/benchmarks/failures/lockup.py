"""A clutch that locks: the minimum problem in which co-simulation goes wrong.

Slip w of a reduced inertia J: J dw/dt = T_d - T_f sign(w), sticking while |T_d| <= T_f. The drive
is constant; friction is too, unless a film has to be squeezed out first. It is smoothed over a slip
of w_s where a method needs it. Methods step between communication points, or are general solvers.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from lab.macro_steps import turns_of

Row = np.ndarray[tuple[int], np.dtype[np.float64]]
FINE = 400_001  # times at which slip and heat are summed up where there is no closed form
LEAST_SHARE = 1e-6  # of a macro step, the smallest step of step doubling
TOLERANCE = 1e-4  # of step doubling, of the slip at the start
SOLVERS = 1e-8  # tolerance of the general solvers


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


Advance = Callable[[Clutch, Now, float], Now]


def begin(clutch: Clutch) -> Now:
    """Return the start."""
    film = 0.0 if clutch.lag else 1.0
    return Now(0.0, clutch.slip, 0.0, film, clutch.smooth(clutch.slip, film), 0)


def walk(advance: Advance, clutch: Clutch, step: float, rewind: Rewind | None = None) -> Run:
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


def _moved(c: Clutch, now: Now, h: float, torque: float, own: float) -> Now:
    """Return what follows from a torque that is held over a step."""
    slip = now.slip + h * (c.drive - torque) / c.inertia
    heat = now.heat + h * torque * 0.5 * (now.slip + slip)
    return Now(now.time + h, slip, heat, c.film_after(now.film, h), own, now.work + 1)


def _held(c: Clutch, now: Now, h: float) -> Now:
    """Friction torque handed over, fresh in each step, held while the driveline steps."""
    return _moved(c, now, h, c.smooth(now.slip, now.film), now.own)


def _late(c: Clutch, now: Now, h: float) -> Now:
    """Friction torque handed over, one step old."""
    return _moved(c, now, h, now.own, c.smooth(now.slip, now.film))


def _stages(c: Clutch, now: Now, h: float) -> Now:
    """Classical Runge-Kutta steps of fixed length on smoothed friction."""
    w = now.slip
    half, end = c.film_after(now.film, 0.5 * h), c.film_after(now.film, h)

    def rate(slip: float, film: float) -> float:
        return (c.drive - c.smooth(slip, film)) / c.inertia

    k1 = rate(w, now.film)
    k2 = rate(w + 0.5 * h * k1, half)
    k3 = rate(w + 0.5 * h * k2, half)
    k4 = rate(w + h * k3, end)
    new = w + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    middle = 0.5 * (w + new)
    power = c.smooth(w, now.film) * w + 4.0 * c.smooth(middle, half) * middle
    power += c.smooth(new, end) * new
    return Now(now.time + h, new, now.heat + h / 6.0 * power, end, now.own, now.work + 4)


def _stick_slip(c: Clutch, now: Now, h: float) -> Now:
    """Stick and slip as modes, lock-up located inside the step, as the package's driveline does."""
    film, end = c.film_after(now.film, 0.5 * h), c.film_after(now.film, h)
    level = c.friction * film
    stuck = abs(c.drive) <= level
    after = now._replace(time=now.time + h, film=end, work=now.work + 1)
    if now.slip == 0.0 and stuck:
        return after
    torque = math.copysign(level, now.slip)
    rate = (c.drive - torque) / c.inertia
    new = now.slip + h * rate
    if new * now.slip <= 0.0 and stuck:
        until = -now.slip / rate
        return after._replace(slip=0.0, heat=now.heat + 0.5 * torque * now.slip * until)
    return after._replace(slip=new, heat=now.heat + h * torque * 0.5 * (now.slip + new))


def _sloped(c: Clutch, now: Now, h: float) -> Now:
    """Friction torque with its slope over the slip, both handed over."""
    level = c.friction * now.film
    torque = c.smooth(now.slip, now.film)
    slope = (level - torque * torque / level) / c.width if level else 0.0
    change = h * (c.drive - torque) / (c.inertia + h * slope)
    heat = now.heat + h * (torque + 0.5 * slope * change) * (now.slip + 0.5 * change)
    film = c.film_after(now.film, h)
    return Now(now.time + h, now.slip + change, heat, film, now.own, now.work + 1)


def _doubled(c: Clutch, now: Now, h: float) -> Now:
    """Held torque, a step against two half ones; given back and halved where they disagree."""
    end, least = now.time + h, LEAST_SHARE * h
    known = now.time > 0.0 and now.own > 0.0  # what `lockup.begin` keeps is a torque, no step
    size = min(h, now.own) if known else h
    while end - now.time > 1e-9 * h:
        size = min(size, end - now.time)
        once = _held(c, now, size)
        half = _held(c, now, 0.5 * size)
        twice = _held(c, half, 0.5 * size)
        error = abs(twice.slip - once.slip) / (TOLERANCE * c.slip)
        work = now.work + 3
        if error <= 1.0 or size <= least:
            now = twice._replace(work=work)
            size *= 2.0 if error < 0.2 else 1.0
        else:
            now = now._replace(work=work)
            size *= 0.5
    return now._replace(time=end, own=size)


runge_kutta, located = partial(walk, _stages), partial(walk, _stick_slip)
gauss_seidel, jacobi = partial(walk, _held), partial(walk, _late)
linearly_implicit, step_doubling = partial(walk, _sloped), partial(walk, _doubled)


def _stretch(clutch: Clutch, method: str, y: Row, times: Row) -> tuple[Row, Row, int]:
    """Integrate from the first time to the last; return slips, the state there and the work."""
    from scipy.integrate import solve_ivp

    def rate(t: float, y: Row) -> list[float]:
        torque = clutch.smooth(y[0], y[2])
        film = (1.0 - y[2]) / clutch.lag if clutch.lag else 0.0
        return [(clutch.drive - torque) / clutch.inertia, torque * y[0], film]

    found = solve_ivp(
        rate,
        (times[0], times[-1]),
        y,
        method=method,
        t_eval=times,
        rtol=SOLVERS,
        atol=SOLVERS,
    )
    return found.y[0], found.y[:, -1], int(found.nfev)


def adaptive(
    clutch: Clutch, step: float, rewind: Rewind | None = None, method: str = "LSODA"
) -> Run:
    """Integrate with error control, friction smoothed; the slip is looked at every ``step``.

    After going back the solver begins anew: what it knows of the past is no state of the problem.
    """
    now, n = begin(clutch), round(clutch.span / step)
    times = np.linspace(0.0, clutch.span, n + 1)
    slip, work = np.empty(n + 1), 0
    y = np.array([now.slip, 0.0, now.film])
    stops = [*range(0, n, rewind.every), n] if rewind else [0, n]
    for first, last in pairwise(stops):
        if rewind and first:
            stop = min(first + rewind.ahead, n)
            _, ahead, spent = _stretch(clutch, method, y, times[first : stop + 1])
            work += spent
            if rewind.forgets:
                y[2] = ahead[2]
        part, y, spent = _stretch(clutch, method, y, times[first : last + 1])
        slip[first : last + 1] = part
        work += spent
    return Run(slip, float(y[1]), work)


lsoda: Callable[..., Run] = partial(adaptive, method="LSODA")
bdf: Callable[..., Run] = partial(adaptive, method="BDF")
