"""Linear drivelines with one pack or two, stepped exactly, and with ideal Coulomb packs.

x' = system x + packs T + outside, slips = slips x.  Outside torques are constant; the host is that
of the two inertias.  SI units.
"""

import math
from array import array
from collections import deque
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from drivelines import SHAPES, Profile, log_uniform, make_profile, root
from runs import Run, as_run


def exponential(a):
    """The matrix exponential: scaled, a Taylor series, squared."""
    squarings = max(0, math.ceil(math.log2(max(np.abs(a).sum(axis=1).max(), 1e-30) / 0.25)))
    a = a / 2.0**squarings
    term = total = np.eye(len(a))
    for k in range(1, 16):
        term = term @ a / k
        total = total + term
    for _ in range(squarings):
        total = total @ total
    return total


def propagator(system, inputs, tau):
    """The matrix from (x, u) to x after tau, and to the integral of x, for constant u."""
    n, m = inputs.shape
    a = np.zeros((2 * n + m, 2 * n + m))
    a[:n, :n], a[:n, 2 * n :] = system * tau, inputs * tau
    a[n : 2 * n, :n] = np.eye(n)
    whole = exponential(a)
    keep = [*range(n), *range(2 * n, 2 * n + m)]
    return whole[:n, keep], whole[n : 2 * n, keep] * tau


@dataclass(frozen=True)
class Linear:
    """A driveline; `profiles`, `slips` and the columns of `packs` are one for each pack."""

    system: np.ndarray
    packs: np.ndarray
    outside: np.ndarray
    slips: np.ndarray
    start: np.ndarray
    profiles: tuple[Profile, ...]
    host: float
    count: int
    delay: int
    inertias: np.ndarray  # slip_i' = ... - T_j / inertias[i, j]
    stuck: int | None = None  # the pack which holds at the start
    gain: float = 0.04
    facts: dict[str, float] = field(default_factory=dict)

    @cached_property
    def inputs(self):
        return np.column_stack([self.packs, self.outside])

    @cached_property
    def first(self):
        return float(np.abs(self.slips @ self.start).max())


def run_linear(case: Linear, units) -> list[Run]:
    """The driveline with its units: one run for each pack, with the states."""
    step, swept = propagator(case.system, case.inputs, case.host)
    waiting = deque([[0.0] * len(units)] * case.delay)
    x, works, rows, states = case.start, [0.0] * len(units), [array("d") for _ in units], []
    for n in range(case.count):
        seen, t = (case.slips @ x).tolist(), n * case.host
        loads = [profile.at(t) / case.gain for profile in case.profiles]
        given = [float(u.step(s, case.host, f)) for u, s, f in zip(units, seen, loads, strict=True)]
        waiting.append(given)
        acting = waiting.popleft()
        both = np.concatenate([x, acting, [1.0]])
        x, area = step @ both, (case.slips @ (swept @ both)).tolist()
        states.append(x)
        for i, (unit, slip) in enumerate(zip(units, (case.slips @ x).tolist(), strict=True)):
            works[i] += acting[i] * area[i]
            state = (unit.capacity, works[i], unit.locked, unit.energy, unit.warned)
            rows[i].extend((t + case.host, slip, acting[i], given[i], *state))
    return [as_run(case.first, row, np.array(states)) for row in rows]


class Coulomb:
    """The driveline with ideal packs, which stick exactly; at most one of them sticks at a time."""

    def __init__(self, case, substeps):
        fastest = float(np.abs(np.linalg.eigvals(case.system)).max())
        self.pieces = max(1, math.ceil(case.host / substeps * fastest / 0.2))
        self.case, self.tau, self.known = case, case.host / substeps / self.pieces, {}
        self.x, self.stuck, self.time, self.events = case.start, case.stuck, 0.0, []
        self.signs = np.sign(case.slips @ case.start)
        self.signs[self.signs == 0.0] = 1.0
        self.works, self.impulses = np.zeros(len(self.signs)), np.zeros(len(self.signs))

    @cached_property
    def holds(self):
        """For each pack the row from (x, u) to the torque which holds it."""
        whole = np.column_stack([self.case.system, self.case.inputs])
        rows = []
        for i, slip in enumerate(self.case.slips):
            row = -(slip @ whole) / (slip @ self.case.packs[:, i])
            row[len(self.x) + i] = 0.0
            rows.append(row)
        return rows

    def matrices(self, tau):
        if (key := (self.stuck, tau)) not in self.known:
            whole, n = np.column_stack([self.case.system, self.case.inputs]), len(self.x)
            if self.stuck is not None:
                whole[:, n + self.stuck] = 0.0
                whole = whole + np.outer(self.case.packs[:, self.stuck], self.holds[self.stuck])
            made = propagator(whole[:, :n], whole[:, n:], tau)
            if tau not in (self.tau, 0.5 * self.tau):
                return made
            self.known[key] = made
        return self.known[key]

    def excess(self, capacities, tau):
        """Above zero where, after tau, the pack holds no longer, or the slip has gone past zero."""
        both = self.both(capacities)
        x = self.matrices(tau)[0] @ both
        if self.stuck is not None:
            torque = self.holds[self.stuck] @ np.concatenate([x, both[len(x) :]])
            return np.array([abs(torque) - capacities[self.stuck] - 1e-12 * self.scale])
        return -self.signs * (self.case.slips @ x) - 1e-12 * self.case.first

    @cached_property
    def scale(self):
        return max(max(profile.top, profile.low) for profile in self.case.profiles)

    def both(self, capacities):
        return np.concatenate([self.x, self.signs * capacities, [1.0]])

    def move(self, capacities, tau):
        both, (step, swept) = self.both(capacities), self.matrices(tau)
        sums = np.concatenate([swept @ both, both[len(self.x) :] * tau])
        sliding = self.signs * capacities
        torques = sliding * tau
        if self.stuck is not None:
            sliding[self.stuck], torques[self.stuck] = 0.0, self.holds[self.stuck] @ sums
        self.works += sliding * (self.case.slips @ sums[: len(self.x)])
        self.impulses += torques
        self.x, self.time = step @ both, self.time + tau

    def stick(self, i, capacities):
        """The slip of pack i is zero: it holds where it can."""
        column, row = self.case.packs[:, i], self.case.slips[i]
        self.x = self.x - column * (row @ self.x) / (row @ column)
        torque = self.holds[i] @ self.both(capacities)
        if abs(torque) > capacities[i]:
            self.signs[i], self.stuck = math.copysign(1.0, torque), None
        else:
            self.stuck = i
        self.events.append((self.time, i, self.stuck == i))

    def next_event(self, capacities, left):
        """The first time at which the excess is above zero, and the pack, or None."""
        times, found = (0.0, 0.5 * left, left), []
        for i, (a, m, e) in enumerate(np.array([self.excess(capacities, t) for t in times]).T):
            high, slope, bend = left, 4.0 * m - 3.0 * a - e, 2.0 * (a - 2.0 * m + e)
            if e <= 0.0 and bend < 0.0 < slope < -2.0 * bend:
                # It may have been above zero in between.
                high = -0.5 * slope / bend * left
                e = self.excess(capacities, high)[i]
            if e > 0.0:
                found.append((root(lambda t, i=i: self.excess(capacities, t)[i], 0.0, high), i))
        return min(found, default=None)

    def advance(self, capacities):
        """One piece of a substep, with its events."""
        left = self.tau
        while left > 0.0:
            if self.stuck is not None and self.excess(capacities, 0.0)[0] > 0.0:
                self.stick(self.stuck, capacities)
            event = self.next_event(capacities, left)
            if event is None:
                return self.move(capacities, left)
            tau, i = event
            self.move(capacities, tau)
            left -= tau
            self.stick(i if self.stuck is None else self.stuck, capacities)
        return None


def coulomb(case: Linear, substeps=1) -> tuple[list[Run], list]:
    """Runs with ideal packs (no delay), and the events (time, pack, whether it sticks then).

    With one substep the capacity is held over each step, as a sampled load is; with more, it is
    that at the middle of each substep.  `acting` is the mean over the step.
    """
    ideal, rows, states = Coulomb(case, substeps), [array("d") for _ in case.profiles], []
    for n in range(case.count):
        before = ideal.impulses.copy()
        for k in range(substeps):
            t = (n + (k + 0.5 if substeps > 1 else 0.0) / substeps) * case.host
            capacities = np.array([profile.at(t) for profile in case.profiles])
            for _ in range(ideal.pieces):
                ideal.advance(capacities)
        means, slips = (ideal.impulses - before) / case.host, case.slips @ ideal.x
        states.append(ideal.x)
        for i, row in enumerate(rows):
            work, stuck = ideal.works[i], ideal.stuck == i
            time, mean = (n + 1) * case.host, means[i]
            row.extend((time, slips[i], mean, mean, capacities[i], work, stuck, work, 0.0))
    return [as_run(case.first, row, np.array(states)) for row in rows], ideal.events


def elastic(seed, frequency, host=None, shape=None, delay=None, damping=0.02, tail=200) -> Linear:
    """Inertia 1, the pack, inertia n, a shaft, inertia 2; states: speeds 1, n, 2, shaft twist.

    The frequency [Hz] and the damping ratio are those with the pack stuck; the twist is times
    the angular frequency.
    """
    rng = np.random.default_rng(seed)
    j1 = log_uniform(rng, 1e-2, 10.0)
    jn = j1 * log_uniform(rng, 0.2, 1.0)
    j2 = (j1 + jn) * log_uniform(rng, 0.5, 20.0)
    free, omega = 1.0 / (j1 + jn) + 1.0 / j2, 2.0 * math.pi * frequency
    k, c = omega * omega / free, 2.0 * damping * omega / free
    host = host or log_uniform(rng, 1e-4, min(1e-2, 0.05 / frequency))
    time = host * log_uniform(rng, 40.0, 400.0)
    unit = make_profile(rng, shape or str(rng.choice(SHAPES)), time)
    filled, lock = unit.filled(time), unit.at(time)
    need, split = float(rng.uniform(-0.5, 0.5 * filled / lock / time)), rng.uniform(-0.5, 1.5)
    reduced = 1.0 / (1.0 / j1 + 1.0 / (jn + j2))
    slip = float(rng.choice([-1.0, 1.0])) * log_uniform(rng, 3.0, 400.0)
    top = slip * reduced / (filled - need * lock * time)
    a = need * top * lock / reduced
    torque1, torque2 = a * split * j1, a * (split - 1.0) * (jn + j2)
    system = np.array(
        [
            [0.0, 0.0, 0.0, 0.0],
            [0.0, -c / jn, c / jn, -k / jn / omega],
            [0.0, c / j2, -c / j2, k / j2 / omega],
            [0.0, omega, -omega, 0.0],
        ]
    )
    speed, twist = float(rng.uniform(-300.0, 300.0)), -torque2 / j2 / (1.0 / jn + 1.0 / j2) / k
    return Linear(
        system,
        np.array([[-1.0 / j1], [1.0 / jn], [0.0], [0.0]]),
        np.array([torque1 / j1, 0.0, torque2 / j2, 0.0]),
        np.array([[1.0, -1.0, 0.0, 0.0]]),
        np.array([speed + slip, speed, speed, twist * omega]),
        (replace(unit, top=abs(top), low=unit.low * abs(top)),),
        host,
        math.ceil(time / host) + tail,
        int(rng.integers(3)) if delay is None else delay,
        np.array([[1.0 / (1.0 / j1 + 1.0 / jn)]]),
        facts={
            "j1": j1,
            "jn": jn,
            "j2": j2,
            "k": k,
            "c": c,
            "rigid": reduced,
            "need": need * abs(top) * lock,
        },
    )


def handover(seed, delay=None, ratios=(3.0, 1.8), tail=200) -> Linear:
    """Engine and output, slips engine - ratio * output: pack A holds, B takes over, A is released.

    States: speeds of engine and output.
    """
    rng = np.random.default_rng(seed)
    a, b = ratios
    while True:
        je = log_uniform(rng, 0.05, 0.5)
        jo = a * a * je * log_uniform(rng, 5.0, 100.0)
        torque, speed = log_uniform(rng, 50.0, 300.0), float(rng.uniform(100.0, 400.0))
        outside = np.array([torque / je, -float(rng.uniform(0.0, 0.8)) * a * torque / jo])
        packs = np.array([[-1.0 / je, -1.0 / je], [a / jo, b / jo]])
        slips = np.array([[1.0, -a], [1.0, -b]])
        inertias = -1.0 / (slips @ packs)
        drive = slips @ outside
        held, taken = float(drive[0] * inertias[0, 0]), float(drive[0] * inertias[0, 1])
        wanted = float(drive[1] * inertias[1, 1])
        top = float(rng.uniform(1.3, 2.0)) * max(taken, wanted / 0.8)
        slowing = (top - wanted) / inertias[1, 1]
        slipping = (1.0 - b / a) * speed / slowing
        host = float(slipping / log_uniform(rng, 50.0, 400.0))
        if held > 0.0 and 1e-4 <= host <= 1e-2:
            break
    rise = host * float(rng.uniform(30.0, 150.0))
    filling = Profile(top, 0.0, 20.0 * host, rise)
    begin = 20.0 * host + rise * float(rng.uniform(0.7, 1.0)) * taken / top
    freed = Profile(0.0, held * float(rng.uniform(1.3, 2.0)), begin, host * rng.uniform(5.0, 20.0))
    return Linear(
        np.zeros((2, 2)),
        packs,
        outside,
        slips,
        np.array([speed, speed / a]),
        (freed, filling),
        host,
        math.ceil((20.0 * host + rise + 1.5 * slipping) / host) + tail,
        int(rng.integers(3)) if delay is None else delay,
        inertias,
        stuck=0,
        facts={"je": je, "jo": jo, "held": held, "taken": taken, "wanted": wanted},
    )
