"""Drivelines in which a clutch unit is stepped by a host, with their exact answers.

The unit is called once a host step: `torque = unit.step(slip, h, load)`; slip and load are those
at the start of the step.  The torque given in step n acts over the whole of step n + delay; before
the first one acts, the torque is zero.  Outside torques are held over a step (or swing as a sine),
so every plant is integrated exactly.  Capacity = gain * load.  SI units.
"""

import math
from array import array
from collections import deque
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from runs import Run, as_run

SHAPES = ("constant", "ramp", "short ramp", "soft")
# Rise time as a share of the slip time.
RISES = {"constant": (1.0, 1.0), "ramp": (1.1, 2.0), "short ramp": (0.1, 0.6), "soft": (0.3, 1.3)}


@dataclass(frozen=True)
class Profile:
    """Capacity over time: `low` until `start`, then to `top` within `rise`, straight or soft."""

    top: float
    low: float = 0.0
    start: float = 0.0
    rise: float = 1.0
    soft: bool = False

    def at(self, t):
        x = min(max((t - self.start) / self.rise, 0.0), 1.0)
        return self.low + (self.top - self.low) * (
            0.5 - 0.5 * math.cos(math.pi * x) if self.soft else x
        )

    def filled(self, t):
        """The integral of the capacity from zero to t."""
        x = max((t - self.start) / self.rise, 0.0)
        inner = min(x, 1.0)
        part = inner - math.sin(math.pi * inner) / math.pi if self.soft else inner * inner
        return self.low * t + (self.top - self.low) * self.rise * (0.5 * part + x - inner)


@dataclass(frozen=True)
class Case:
    """Two inertias: slip' = torque1 / inertia1 - torque2 / inertia2 - torque / inertia."""

    inertia1: float
    inertia2: float
    slip: float  # at the start
    speed: float  # at the start: momentum / sum of the inertias
    host: float  # the nominal step
    steps: list[float]
    profile: Profile
    torque1: list[float]  # outside torques over each step
    torque2: list[float]
    loads: list[float]
    delay: int = 0
    gain: float = 0.04
    swing: float = 0.0  # torque1 has also swing * sin(rate * t + phase)
    rate: float = 1.0
    phase: float = 0.0
    noise: list[float] = field(default_factory=list)  # added to the slip seen
    marks: tuple[int, ...] = ()  # steps at which the outside torque or the load changes

    @cached_property
    def inertia(self):
        return self.inertia1 * self.inertia2 / (self.inertia1 + self.inertia2)

    @cached_property
    def times(self):
        """Starts of the steps, and the end of the last."""
        return [0.0, *np.cumsum(self.steps).tolist()]

    @cached_property
    def max_outside_rate(self):
        """The largest rate of the outside slip acceleration [rad/s^3]."""
        return abs(self.swing * self.rate / self.inertia1)

    def outside(self, n, tau):
        """Slip change, and its integral, by the outside torques until tau into step n."""
        a = self.torque1[n] / self.inertia1 - self.torque2[n] / self.inertia2
        change, area = a * tau, 0.5 * a * tau * tau
        if self.swing:
            scale, half = self.swing / self.inertia1 / self.rate, 0.5 * self.rate * tau
            begin = self.rate * self.times[n] + self.phase
            change += scale * 2.0 * math.sin(begin + half) * math.sin(half)
            mean = math.cos(begin + half) * math.sin(half) / half if half else math.cos(begin)
            area += scale * tau * (math.cos(begin) - mean)
        return change, area

    @cached_property
    def holding(self):
        """The torque which holds the slip, averaged over each step."""
        return np.array(
            [self.inertia * self.outside(n, h)[0] / h for n, h in enumerate(self.steps)]
        )


@dataclass(frozen=True)
class Exact:
    """`instant`: the continuous plant's; `sampled`: with torque held, and acting `delay` late."""

    instant: float
    sampled: float
    holding: float
    work: float
    sampled_work: float


def run(case: Case, unit) -> Run:
    """The two inertias with the unit."""
    rows, waiting, noise = array("d"), deque([0.0] * case.delay), case.noise or None
    slip, work, inertia, times = case.slip, 0.0, case.inertia, case.times
    for n, h in enumerate(case.steps):
        given = float(unit.step(slip + noise[n] if noise else slip, h, case.loads[n]))
        waiting.append(given)
        acting = waiting.popleft()
        change, area = case.outside(n, h)
        work += acting * (slip * h + area - 0.5 * acting * h * h / inertia)
        slip += change - acting * h / inertia
        state = (unit.capacity, work, unit.locked, unit.energy, unit.warned)
        rows.extend((times[n + 1], slip, acting, given, *state))
    return as_run(case.slip, rows)


def root(f, low, high):
    """The point of a change of sign of f between low and high, to the last digit."""
    sign = f(high) > 0.0
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (low, middle) if (f(middle) > 0.0) == sign else (middle, high)
    return high


def slide(case, torques, n=0, slip=0.0):
    """When the slip comes to zero under the acting torque `torques(n)`, and the work until then."""
    work = 0.0
    while n < len(case.steps):
        h, a = case.steps[n], torques(n) / case.inertia
        end = slip + case.outside(n, h)[0] - a * h
        ends = slip != 0.0 and end * slip <= 0.0
        if ends:
            h = root(lambda t, n=n, a=a, s=slip: s + case.outside(n, t)[0] - a * t, 0.0, h)
        work += torques(n) * (slip * h + case.outside(n, h)[1] - 0.5 * a * h * h)
        if ends:
            return case.times[n] + h, work
        slip, n = end, n + 1
    return math.inf, work


def exact(case: Case) -> Exact:
    """The first lock, by the case's profile of capacity (loads: its values at step starts)."""
    sign, d, edges = math.copysign(1.0, case.slip), case.delay, case.times
    before = np.concatenate([[0.0], np.cumsum(case.holding * case.steps)]) / case.inertia

    def slip(t, n):
        change = float(before[n]) + case.outside(n, t - edges[n])[0]
        return case.slip + change - sign * case.profile.filled(t) / case.inertia

    n = next(n for n in range(len(case.steps)) if sign * slip(edges[n + 1], n) <= 0.0)
    instant = root(lambda t: slip(t, n), edges[n], edges[n + 1])
    kinks = [case.profile.start, case.profile.start + case.profile.rise]
    cuts = sorted({*edges[: n + 1], instant, *(t for t in kinks if 0.0 < t < instant)})
    nodes, weights = (part.tolist() for part in np.polynomial.legendre.leggauss(5))
    work, k = 0.0, 0
    for begin, end in pairwise(cuts):
        k += begin >= edges[k + 1]
        for x, w in zip(nodes, weights, strict=True):
            t = begin + 0.5 * (end - begin) * (1.0 + x)
            work += 0.5 * (end - begin) * w * sign * case.profile.at(t) * slip(t, k)
    capacity = [sign * case.gain * load for load in case.loads]
    late = slide(case, lambda m: capacity[m - d] if m >= d else 0.0, 0, case.slip)
    return Exact(instant, late[0], float(case.holding[n]), work, late[1])


def relock(case: Case) -> tuple[float, float]:
    """Lock instants after the last hold was lost: at once at capacity, and as a unit can do it.

    It is lost at step marks[-2].  A unit sees a lost hold a step later (a lost load at once), and
    its torque acts `delay` later still.
    """
    lost = case.marks[-2]
    sign, held = math.copysign(1.0, case.holding[lost]), float(case.holding[lost - 1])
    capacity = [sign * case.gain * load for load in case.loads]
    slips = case.loads[lost] > 0.0  # at once, whatever the unit gives
    late = lost + case.delay + slips
    begin = lost if slips else late
    at_once = slide(case, capacity.__getitem__, lost)[0]
    acting = [capacity[m - case.delay] if m >= late else held for m in range(len(case.steps))]
    return at_once, slide(case, acting.__getitem__, begin)[0]


def log_uniform(rng, low, high):
    return float(math.exp(rng.uniform(math.log(low), math.log(high))))


def make_profile(rng, shape, slip_time):
    """A profile with top 1 whose rise suits the time the slip lasts."""
    rise = slip_time * float(rng.uniform(*RISES[shape]))
    return Profile(1.0, float(shape == "constant"), 0.0, rise, shape == "soft")


def make_steps(rng, host, time, tail, vary):
    """Steps over the time, and `tail` more."""
    if not vary:
        return [host] * (math.ceil(time / host) + tail)
    drawn = host * rng.choice([0.5, 1.0, 2.0], 2 * math.ceil(time / host) + tail)
    return drawn[: int(np.searchsorted(np.cumsum(drawn), time)) + 1 + tail].tolist()


def two_inertias(
    seed, shape=None, delay=None, sigma=0.0, vary=False, swing=0.0, felt=False, tail=120
) -> Case:
    """A random case: slip until `tail` steps before the end, then a hold within capacity.

    sigma: noise as a share of the first slip; swing: the engine torque's as a share of capacity at
    lock (felt: the holding torque's instead).
    """
    rng = np.random.default_rng(seed)
    while True:
        j1, j2 = log_uniform(rng, 1e-3, 1e2), log_uniform(rng, 1e-3, 1e2)
        host, count = log_uniform(rng, 1e-4, 1e-2), log_uniform(rng, 12.0, 400.0)
        first, time, j = log_uniform(rng, 3.0, 400.0), host * count, j1 * j2 / (j1 + j2)
        unit = make_profile(rng, shape or str(rng.choice(SHAPES)), time)
        rate, phase = 1.0 / (host * log_uniform(rng, 20.0, 400.0)), float(rng.uniform(0.0, 6.3))
        share = swing if felt else swing * j2 / (j1 + j2)
        need = float(rng.uniform(share - 0.8, 0.8 - share))
        t = np.linspace(0.0, time, 400)
        swept = share * (math.cos(phase) - np.cos(rate * t + phase)) / rate
        filled = np.array([unit.filled(x) for x in t.tolist()])
        # What slows the slip, for a top capacity of 1.
        slowed = filled - unit.at(time) * (need * t + swept)
        if 1e-2 <= j2 / j1 <= 1e2 and slowed[-1] > 0.25 * filled[-1]:
            if np.all(slowed[:-1] < slowed[-1]):
                break
    sign = float(rng.choice([-1.0, 1.0]))
    profile = replace(
        unit, top=first * j / float(slowed[-1]), low=unit.low * first * j / float(slowed[-1])
    )
    lock, split = profile.at(time), float(rng.uniform(-0.5, 1.5))
    steps = make_steps(rng, host, time, tail, vary)
    starts = [0.0, *np.cumsum(steps[:-1]).tolist()]
    return Case(
        j1,
        j2,
        sign * first,
        float(rng.uniform(-300.0, 300.0)),
        host,
        steps,
        profile,
        [sign * need * lock / j * split * j1] * len(steps),
        [sign * need * lock / j * (split - 1.0) * j2] * len(steps),
        [profile.at(x) / 0.04 for x in starts],
        int(rng.integers(3)) if delay is None else delay,
        swing=sign * share * lock / j * j1,
        rate=rate,
        phase=phase,
        noise=(sigma * first * rng.standard_normal(len(steps))).tolist() if sigma else [],
    )


def long_hold(seed: int, count=1_000_000, delay=None) -> Case:
    """Slip, then a hold of `count` steps."""
    return two_inertias(seed, delay=delay, tail=count)


def outside_steps(seed: int, delay=None) -> Case:
    """Lock, then at the marks: another torque within capacity, one beyond it, one within it."""
    case, rng = two_inertias(seed, "constant", delay, tail=900), np.random.default_rng([seed, 1])
    first = len(case.steps) - 840
    marks = (first, first + 100, first + 100 + int(rng.integers(10, 60)))
    side, top = rng.choice([-1.0, 1.0]), case.profile.top
    levels = rng.uniform(-0.8, 0.8), side * rng.uniform(1.3, 2.0), rng.uniform(-0.8, 0.8)
    torque1, now = list(case.torque1), case.holding[0]
    for mark, end, level in zip(marks, (*marks[1:], len(torque1)), levels, strict=True):
        more = float(level * top - now) * case.inertia1 / case.inertia
        torque1[mark:end] = [torque1[0] + more] * (end - mark)
    return replace(case, torque1=torque1, marks=marks)


def released(seed: int, delay=None) -> Case:
    """Lock, then no load between the two marks."""
    case, rng = two_inertias(seed, "constant", delay, tail=900), np.random.default_rng([seed, 2])
    begin = len(case.steps) - 840
    marks, loads = (begin, begin + int(rng.integers(10, 60))), list(case.loads)
    loads[marks[0] : marks[1]] = [0.0] * (marks[1] - marks[0])
    return replace(case, loads=loads, marks=marks)


class KnownPlant:
    """A reference unit told inertia and delay (and the steps): the deadbeat torque."""

    def __init__(self, inertia, delay, gain, steps=None):
        self.inertia, self.delay, self.gain, self.steps = inertia, delay, gain, steps
        self.given, self.count, self.last = deque([0.0] * delay), 0, None
        self.capacity, self.locked, self.energy, self.warned = 0.0, False, 0.0, False

    def step(self, slip: float, h: float, load: float) -> float:
        outside = 0.0
        if self.last:
            old, step = self.last
            acting = self.given.popleft()
            outside = (slip - old) / step + acting / self.inertia
            self.energy += acting * 0.5 * (slip + old) * step
        ahead = self.steps[self.count :] if self.steps and self.delay else []
        ahead = [*ahead[: self.delay + 1], *[h] * (self.delay + 1)][: self.delay + 1]
        coming = slip
        for acting, step in zip(self.given, ahead, strict=False):
            coming += step * (outside - acting / self.inertia)
        wanted = self.inertia * (coming / ahead[self.delay] + outside)
        self.capacity = self.gain * load
        self.locked = abs(wanted) < self.capacity
        self.given.append(min(max(wanted, -self.capacity), self.capacity))
        self.last, self.count = (slip, h), self.count + 1
        return self.given[-1]
