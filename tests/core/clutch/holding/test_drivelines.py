"""The drivelines are right: closed forms, balances, and event integration by other means."""

import math
from dataclasses import replace

import numpy as np
import pytest
from drivelines import (
    SHAPES,
    KnownPlant,
    exact,
    long_hold,
    outside_steps,
    released,
    relock,
    run,
    two_inertias,
)
from linear_drivelines import Linear, coulomb, elastic, handover, propagator, run_linear
from runs import (
    Run,
    energy_error,
    late_errors,
    max_late_slip,
    reversals,
    steps_to_lock,
    work_error,
)
from scipy.integrate import solve_ivp
from scipy.linalg import expm

TIGHT = {"method": "DOP853", "rtol": 3e-14, "atol": 1e-12}


class FullCapacity:
    """A unit which always gives its capacity, against the first slip."""

    locked, energy, warned, sign = False, 0.0, False, 0.0

    def __init__(self, gain=0.04):
        self.gain = gain

    def step(self, slip, h, load):
        self.sign = self.sign or math.copysign(1.0, slip)
        self.capacity = self.gain * load
        return self.sign * self.capacity


class Given(FullCapacity):
    """A unit which gives the torques of a list."""

    def __init__(self, torques):
        self.torques, self.capacity = iter(torques), 1.0

    def step(self, slip, h, load):
        return next(self.torques)


def known(case):
    return KnownPlant(case.inertia, case.delay, case.gain, case.steps)


def speeds(case, slips):
    """Both speeds at the step starts and the end, from momentum, without swing."""
    whole = case.inertia1 + case.inertia2
    pushes = (np.array(case.torque1) + np.array(case.torque2)) * case.steps
    mean = case.speed + np.concatenate([[0.0], np.cumsum(pushes)]) / whole
    slip = np.concatenate([[case.slip], slips])
    return mean + case.inertia / case.inertia1 * slip, mean - case.inertia / case.inertia2 * slip


def equations(case, torque, step=None):
    """Rates of both speeds, of the work on the pack and of that of the outside torques."""

    def rates(t, y):
        n = step
        if n is None:
            n = min(int(np.searchsorted(case.times, t, "right")) - 1, len(case.steps) - 1)
        engine = case.torque1[n] + case.swing * math.sin(case.rate * t + case.phase)
        pack, load = torque(t), case.torque2[n]
        powers = pack * (y[0] - y[1]), engine * y[0] + load * y[1]
        return [(engine - pack) / case.inertia1, (load + pack) / case.inertia2, *powers]

    return rates


def beginning(case):
    """The start with a mean speed of zero, which would only add rounding."""
    share = case.inertia * case.slip
    return np.array([share / case.inertia1, -share / case.inertia2, 0.0, 0.0])


def full(case):
    """The capacity of the case against its slip."""
    return lambda t: math.copysign(case.profile.at(t), case.slip)


def constant(torque):
    return lambda t: torque


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("swing", [0.0, 1.0 / 3.0])
def test_exact_lock_is_that_of_event_integration(shape, swing):
    def crossing(t, y):
        return y[0] - y[1]

    crossing.terminal, crossing.direction = True, 0
    for seed in range(8):
        case = two_inertias(seed, shape, swing=swing, felt=seed % 2 == 1)
        answer, end = exact(case), case.times[-1]
        done = solve_ivp(
            equations(case, full(case)),
            (0.0, end),
            beginning(case),
            events=crossing,
            max_step=end / 20.0,
            **TIGHT,
        )
        assert math.isclose(done.t_events[0][0], answer.instant, rel_tol=1e-9)
        assert math.isclose(done.y_events[0][0][2], answer.work, rel_tol=1e-8)


@pytest.mark.parametrize("swing", [0.0, 1.0 / 3.0])
@pytest.mark.parametrize("delay", [0, 1, 2])
def test_steps_are_those_of_the_equations(delay, swing):
    """Slip and work step by step, and the energy of the two inertias."""
    for seed in range(4):
        case = two_inertias(seed, delay=delay, vary=seed > 1, swing=swing, felt=True, tail=10)
        case = replace(case, speed=0.0)
        rng = np.random.default_rng(seed)
        scale = case.profile.top
        given = (scale * rng.uniform(-1.0, 1.0, len(case.steps))).tolist()
        done = run(case, Given(given))
        assert np.array_equal(done.acting, [0.0] * delay + given[: len(given) - delay])
        y = beginning(case)
        j1, j2 = case.inertia1, case.inertia2
        start = 0.5 * (j1 * y[0] ** 2 + j2 * y[1] ** 2)
        for n, (t, h) in enumerate(zip(case.times, case.steps, strict=False)):
            rates = equations(case, constant(float(done.acting[n])), n)
            y = solve_ivp(rates, (t, t + h), y, **TIGHT).y[:, -1]
            assert abs(y[0] - y[1] - done.slip[n]) < 1e-9 * (done.first + abs(y[0]))
            work = abs(done.acting[: n + 1]) @ abs(done.slip[: n + 1] * case.steps[: n + 1])
            assert abs(y[2] - done.work[n]) < 1e-9 * (work + start)
        energy = 0.5 * (j1 * y[0] ** 2 + j2 * y[1] ** 2)
        size = start + abs(y[3]) + abs(done.work[-1])
        assert abs(done.work[-1] + energy - start - y[3]) < 1e-9 * size


@pytest.mark.parametrize("make", [two_inertias, outside_steps, released])
def test_energy_balance_to_rounding(make):
    """Work on the pack and change of kinetic energy are the work of the outside torques."""
    for seed in range(60):
        case = make(seed) if make is not two_inertias else make(seed, vary=seed % 2 == 1)
        done = run(case, known(case))
        one, two = speeds(case, done.slip)
        steps = np.array(case.steps)
        works = [
            np.array(torque) * 0.5 * (speed[1:] + speed[:-1]) * steps
            for torque, speed in ((case.torque1, one), (case.torque2, two))
        ]
        kinetic = 0.5 * (case.inertia1 * one**2 + case.inertia2 * two**2)
        gap = done.work[-1] + kinetic[-1] - kinetic[0] - np.sum(works)
        assert abs(gap) < 1e-13 * (np.max(kinetic) + np.sum(np.abs(works)))
        # Momentum of each inertia alone.
        pack = np.cumsum(done.acting * steps)
        push = np.cumsum(np.array(case.torque1) * steps)
        gap = case.inertia1 * (one[1:] - one[0]) - push + pack
        size = case.inertia1 * np.max(np.abs(one)) + np.max(np.abs(pack)) + np.max(np.abs(push))
        assert np.max(np.abs(gap)) < 1e-12 * size


@pytest.mark.slow
def test_cases_are_those_asked_for():
    cases = [two_inertias(seed) for seed in range(500)]
    answers = [exact(case) for case in cases]
    counts = np.array([a.instant / c.host for a, c in zip(answers, cases, strict=True)])
    assert 12.0 - 1e-9 < counts.min() < 14.0 and 350.0 < counts.max() < 400.0 + 1e-6
    ratios = [case.inertia1 / case.inertia2 for case in cases]
    assert 1e-2 <= min(ratios) < 0.05 and 20.0 < max(ratios) <= 1e2
    shares = np.array(
        [
            a.holding / c.profile.at(a.instant) * math.copysign(1.0, c.slip)
            for a, c in zip(answers, cases, strict=True)
        ]
    )
    assert -0.8 - 1e-9 <= shares.min() < -0.7 and 0.5 < shares.max() <= 0.8 + 1e-9
    assert all(3.0 <= abs(case.slip) <= 400.0 for case in cases)
    assert {case.delay for case in cases} == {0, 1, 2}
    assert {case.slip > 0.0 for case in cases} == {True, False}
    for case, answer in zip(cases, answers, strict=True):
        assert answer.sampled < case.times[-1] - 30.0 * case.host
    assert two_inertias(7) == two_inertias(7)


def test_swing_stays_within_capacity():
    for seed in range(200):
        case = two_inertias(seed, swing=1.0 / 3.0, felt=seed % 2 == 1)
        answer = exact(case)
        after = np.array(case.times[:-1]) > answer.instant
        lock = case.profile.at(answer.instant)
        assert np.max(np.abs(case.holding[after])) <= 0.8 * lock * (1.0 + 1e-9)
        assert case.rate * case.host <= 1.0 / 20.0
        if seed % 2 == 1:
            amplitude = case.swing * case.inertia / case.inertia1
            assert math.isclose(abs(amplitude), lock / 3.0, rel_tol=1e-9)
        else:
            assert math.isclose(abs(case.swing), lock / 3.0, rel_tol=1e-9)
        t = np.linspace(0.0, 2.0 * math.pi / case.rate, 1000)
        largest = np.max(np.abs(np.gradient(case.swing * np.sin(case.rate * t), t)))
        assert math.isclose(largest / case.inertia1, case.max_outside_rate, rel_tol=1e-4)


@pytest.mark.parametrize("delay", [0, 1, 2])
@pytest.mark.parametrize("vary", [False, True])
def test_sampled_lock_is_that_of_full_capacity(delay, vary):
    for seed in range(60):
        case = two_inertias(seed, delay=delay, vary=vary)
        done, answer = run(case, FullCapacity()), exact(case)
        slips = np.concatenate([[case.slip], done.slip])
        n = int(np.flatnonzero(slips * case.slip <= 0.0)[0]) - 1
        share = slips[n] / (slips[n] - slips[n + 1])
        assert math.isclose(case.times[n] + share * case.steps[n], answer.sampled, rel_tol=1e-12)
        # Constant torque: the work until zero is that of the mean slip over the last part.
        rest = 0.5 * done.acting[n] * slips[n] * share * case.steps[n]
        work = (done.work[n - 1] if n else 0.0) + rest
        assert math.isclose(work, answer.sampled_work, rel_tol=1e-11)
        if case.profile.low and not vary and not delay:
            assert math.isclose(answer.sampled, answer.instant, rel_tol=1e-11)
            assert math.isclose(answer.sampled_work, answer.work, rel_tol=1e-11)


@pytest.mark.parametrize("vary", [False, True])
@pytest.mark.slow
def test_known_plant_locks_at_the_exact_step(vary):
    for seed in range(300):
        case = two_inertias(seed, vary=vary)
        unit = known(case)
        done, answer = run(case, unit), exact(case)
        assert reversals(done) == 0
        assert steps_to_lock(done, answer.sampled) == 1
        torque, slip = late_errors(done, answer.sampled, answer.holding)
        assert torque < 1e-9 and slip < 1e-11
        assert max_late_slip(done, answer.sampled) < 1e-10
        assert work_error(done, answer.sampled_work) < 0.3 / len(case.steps[:-120])
        assert energy_error(done) < 1e-9 and unit.locked


def test_swing_and_noise_with_the_known_plant():
    """What is left is the change of the outside torque over the delay, or the noise."""
    for seed in range(60):
        case = two_inertias(seed, swing=1.0 / 3.0, felt=True)
        done, answer = run(case, known(case)), exact(case)
        bound = case.max_outside_rate * case.host**2 * (case.delay + 2) ** 2 / done.first
        assert reversals(done, level=max(1e-3, bound)) == 0
        assert max_late_slip(done, answer.sampled) < bound
        noisy = two_inertias(seed, sigma=1e-4)
        assert 0.8e-4 < np.std(noisy.noise) / abs(noisy.slip) < 1.2e-4
        assert max_late_slip(run(noisy, known(noisy)), exact(noisy).sampled) < 1e-2


@pytest.mark.parametrize("make", [outside_steps, released])
@pytest.mark.slow
def test_holds_lost_and_found(make):
    for seed in range(60):
        case = make(seed)
        done, first = run(case, known(case)), exact(case)
        lost, back = case.marks[-2:]
        at_once, late = relock(case)
        step = case.host
        assert at_once <= late < case.times[-1] - 100 * step
        assert steps_to_lock(done, first.sampled, end=case.marks[0]) == 1
        if make is outside_steps:
            # Within the capacity it holds; beyond, it slips at capacity.
            settled = slice(case.marks[0] + 30, lost)
            assert np.max(np.abs(done.slip[settled])) < 1e-9 * done.first
            assert np.allclose(done.acting[settled], case.holding[settled], rtol=1e-9)
            beyond = slice(lost + 8, back)
            assert np.allclose(np.abs(done.acting[beyond]), done.capacity[beyond])
            j, top = case.inertia, case.profile.top
            need, after = abs(case.holding[lost]), case.holding[back]
            after *= math.copysign(1.0, case.holding[lost])
            closed = (need - top) * (back - lost) * step / (top - after)
            assert math.isclose(at_once, case.times[back] + closed, rel_tol=1e-9)
            peak = (need - top) / j * (back - lost) * step
            assert np.max(np.abs(done.slip[lost:])) >= peak * (1.0 - 1e-9)
        else:
            d = case.delay
            assert np.all(done.acting[lost + d : back + d] == 0.0)
            slipped = abs(case.holding[0]) / case.inertia * (back - lost) * step
            assert math.isclose(abs(done.slip[back + d - 1]), slipped, rel_tol=1e-6)
            top, held = case.profile.top, abs(case.holding[0])
            closed = case.times[back] + held * (back - lost) * step / (top - held)
            assert math.isclose(at_once, closed, rel_tol=1e-9)
            assert math.isclose(late, closed + d * step, rel_tol=1e-9)
        assert abs(done.slip[-1]) < 1e-9 * done.first
        if make is released:
            assert steps_to_lock(done, late) == 1
        else:
            assert steps_to_lock(done, late) <= 10


def test_judges():
    """Ten steps of 1 s: slip 3 2 1 -0.5 0.5 0 1e-3 0 0 0, capacity 2, torque 1, work 8."""
    slip = np.array([3.0, 2.0, 1.0, -0.5, 0.5, 0.0, 1e-3, 0.0, 0.0, 0.0])
    ones, zeros = np.ones(10), np.zeros(10)
    done = Run(
        4.0, np.arange(1.0, 11.0), slip, ones, ones, 2 * ones, 8 * ones, zeros, 6 * ones, zeros
    )
    assert reversals(done) == 2 and reversals(done, level=0.2) == 0 and reversals(done, 4) == 0
    assert steps_to_lock(done, 3.5) == 5 and steps_to_lock(done, 3.5, level=1e-3) == 3
    assert steps_to_lock(done, 3.5, end=5) == math.inf and steps_to_lock(done, 8.0) == 1
    assert late_errors(done, 3.5, 0.5, after=1) == (0.25, 0.125)
    assert max_late_slip(done, 3.5, after=2) == 1e-3 / 4.0
    assert work_error(done, 10.0) == 0.2 and energy_error(done) == 0.25


def test_long_hold():
    case = long_hold(3, 20_000)
    done, answer = run(case, known(case)), exact(case)
    assert len(done.time) > 20_000 and max_late_slip(done, answer.sampled) < 1e-11


def test_propagator_is_the_matrix_exponential():
    for seed in range(10):
        case = elastic(seed, 100.0)
        step, swept = propagator(case.system, case.inputs, case.host)
        n, m = case.inputs.shape
        whole = np.zeros((2 * n + m, 2 * n + m))
        whole[:n, :n], whole[:n, 2 * n :] = case.system, case.inputs
        whole[n : 2 * n, :n] = np.eye(n)
        right = expm(whole * case.host)
        scale = np.abs(right).max()
        assert np.allclose(step[:, :n], right[:n, :n], rtol=0.0, atol=1e-12 * scale)
        assert np.allclose(step[:, n:], right[:n, 2 * n :], rtol=0.0, atol=1e-12 * scale)
        assert np.allclose(swept[:, n:], right[n : 2 * n, 2 * n :], rtol=0.0, atol=1e-12 * scale)


@pytest.mark.parametrize("frequency", [10.0, 30.0, 100.0])
@pytest.mark.slow
def test_elastic_frequency_and_damping_with_the_pack_stuck(frequency):
    for seed in range(5):
        case = elastic(seed, frequency)
        f = case.facts
        stuck, c, k = f["j1"] + f["jn"], f["c"], f["k"]
        a = np.array(
            [[-c / stuck, c / stuck, -k / stuck], [c / f["j2"], -c / f["j2"], k / f["j2"]]]
        )
        values = np.linalg.eigvals(np.vstack([a, [1.0, -1.0, 0.0]]))
        pole = values[np.argmax(values.imag)]
        assert math.isclose(abs(pole), 2.0 * math.pi * frequency, rel_tol=1e-9)
        assert math.isclose(-pole.real / abs(pole), 0.02, rel_tol=1e-6)
        # The held plant of the reference rings so too.
        runs, events = coulomb(case, 4)
        assert events and runs[0].locked[-1] == 1.0
        shaft = runs[0].states[:, 3]
        assert np.all(np.isfinite(shaft))


def elastic_equations(case, frequency, sign):
    """Rates (stuck for sign 0) and the event which ends them, from the parts of the driveline."""
    f, top, omega = case.facts, case.profiles[0].top, 2.0 * math.pi * frequency
    j1, jn, j2 = f["j1"], f["jn"], f["j2"]
    engine, load = case.outside[0] * j1, case.outside[2] * j2

    def pack(y):
        twist = f["k"] * y[3] / omega + f["c"] * (y[1] - y[2])
        held = (engine * jn + twist * j1) / (j1 + jn)
        return twist, sign * top if sign else held

    def rates(t, y):
        twist, torque = pack(y)
        turn, slip = y[1] - y[2], y[0] - y[1]
        powers = [torque * slip, engine * y[0] + load * y[2], f["c"] * turn**2]
        speeds = [(engine - torque) / j1, (torque - twist) / jn, (twist + load) / j2]
        return [*speeds, omega * turn, *powers]

    def event(t, y):
        return y[0] - y[1] if sign else abs(pack(y)[1]) - top

    event.terminal, event.direction = True, -sign or 1
    return rates, event, lambda y: pack(y)[1]


@pytest.mark.parametrize("frequency", [10.0, 30.0, 100.0])
@pytest.mark.slow
def test_elastic_reference_is_that_of_event_integration(frequency):
    """Each instant of sticking and slipping, the last state, the work, and the energy."""
    again = 0
    for seed in range(6):
        case = elastic(seed, frequency, shape="constant", tail=100)
        f, top, omega = case.facts, case.profiles[0].top, 2.0 * math.pi * frequency
        y, t, end, times = np.array([*case.start, 0.0, 0.0, 0.0]), 0.0, case.count * case.host, []
        sign = math.copysign(1.0, (case.slips @ case.start)[0])
        while t < end:
            rates, event, _ = elastic_equations(case, frequency, sign)
            done = solve_ivp(rates, (t, end), y, events=event, max_step=case.host / 2.0, **TIGHT)
            t, y = done.t[-1], done.y[:, -1]
            if done.status == 1:
                y[:2] = (f["j1"] * y[0] + f["jn"] * y[1]) / (f["j1"] + f["jn"])
                torque = elastic_equations(case, frequency, 0.0)[2](y)
                holds = sign != 0.0 and abs(torque) <= top
                sign = 0.0 if holds else math.copysign(1.0, torque)
                times.append((t, holds))
        runs, events = coulomb(case)
        assert [sticks for _, _, sticks in events] == [sticks for _, sticks in times]
        assert np.allclose([e[0] for e in events], [t for t, _ in times], rtol=1e-7, atol=0.0)
        again += len(times) > 1
        gap = np.abs(runs[0].states[-1] - y[:4])
        assert np.max(gap) < 1e-7 * np.max(np.abs(case.start))
        assert abs(runs[0].work[-1] - y[4]) < 1e-8 * abs(y[4])
        # Kinetic, elastic, the pack, the shaft's damping; the work of the outside torques.
        masses = np.array([f["j1"], f["jn"], f["j2"]])
        first, last = (
            0.5 * masses @ s[:3] ** 2 + 0.5 * f["k"] * (s[3] / omega) ** 2 for s in (case.start, y)
        )
        assert abs(last - first + y[4] + y[6] - y[5]) < 1e-9 * (first + last + abs(y[5]))
    assert again or frequency == 10.0


@pytest.mark.slow
def test_elastic_steps_keep_energy_and_refine():
    """A unit's run is the reference's while it slips at capacity, and refined steps agree."""
    for seed in range(3):
        case = elastic(seed, 30.0, delay=0)
        ideal, events = coulomb(case)
        unit = FullCapacity()
        (done,) = run_linear(case, [unit])
        n = int(events[0][0] / case.host) - 1
        assert np.allclose(done.slip[:n], ideal[0].slip[:n], rtol=0.0, atol=1e-10 * done.first)
        assert np.allclose(done.work[:n], ideal[0].work[:n], rtol=1e-9, atol=0.0)
        fine = [coulomb(case, k) for k in (4, 12)]
        gap = abs(fine[0][1][0][0] - fine[1][1][0][0])
        assert gap < 1e-2 * case.host


def test_linear_steps_are_those_of_the_two_inertias():
    for seed in range(10):
        two = two_inertias(seed, delay=seed % 3)
        j1, j2 = two.inertia1, two.inertia2
        share1, share2 = two.inertia / j1, two.inertia / j2
        case = Linear(
            np.zeros((2, 2)),
            np.array([[-1.0 / j1], [1.0 / j2]]),
            np.array([two.torque1[0] / j1, two.torque2[0] / j2]),
            np.array([[1.0, -1.0]]),
            np.array([share1 * two.slip, -share2 * two.slip]),
            (two.profile,),
            two.host,
            len(two.steps),
            two.delay,
            np.array([[two.inertia]]),
        )
        one, (other,) = run(two, known(two)), run_linear(case, [known(two)])
        assert np.allclose(one.slip, other.slip, rtol=0.0, atol=1e-9 * one.first)
        assert math.isclose(one.work[-1], other.work[-1], rel_tol=1e-9)
        ideal, events = coulomb(case, 1)
        late = exact(replace(two, delay=0))
        assert len(events) == 1 and events[0][2]
        assert math.isclose(events[0][0], late.sampled, rel_tol=1e-9)
        assert math.isclose(ideal[0].work[-1], late.sampled_work, rel_tol=1e-9)
        assert np.allclose(ideal[0].acting[-20:], late.holding, rtol=1e-9)


def handover_energy(case, runs):
    """The gap of the energy balance, as a share."""
    masses = np.array([case.facts["je"], case.facts["jo"]])
    states = np.vstack([case.start, runs[0].states])
    kinetic = 0.5 * states**2 @ masses
    return masses, states, kinetic, sum(done.work[-1] for done in runs)


@pytest.mark.slow
def test_handover():
    for seed in range(24):
        case = handover(seed, delay=seed % 3)
        je, jo, a, b = case.facts["je"], case.facts["jo"], 3.0, 1.8
        closed = [
            [1 / je + a * a / jo, 1 / je + a * b / jo],
            [1 / je + a * b / jo, 1 / je + b * b / jo],
        ]
        assert np.allclose(1.0 / case.inertias, closed)
        runs, events = coulomb(case)
        released_at, taken = [e for e in events if e[1] == 0], [e for e in events if e[1] == 1]
        # A lets go once, B locks for good.
        assert not released_at[0][2] and taken[-1][2] and runs[1].locked[-1] == 1.0
        begin = runs[1].time < case.profiles[1].start
        assert np.allclose(runs[0].acting[begin], case.facts["held"])
        share = case.inertias[0, 0] / case.inertias[0, 1]
        holding = runs[0].time < released_at[0][0]
        wanted = case.facts["held"] - share * runs[1].acting
        assert np.allclose(runs[0].acting[holding], wanted[holding], atol=1e-9 * case.facts["held"])
        assert np.allclose(runs[1].acting[-20:], case.facts["wanted"], rtol=1e-8)
        # Each inertia's momentum by the torques; energy.
        units = [KnownPlant(case.inertias[i, i], case.delay, case.gain) for i in range(2)]
        for done in (runs, run_linear(case, units)):
            masses, states, kinetic, work = handover_energy(case, done)
            packs = np.column_stack([done[0].acting, done[1].acting]) @ case.packs.T
            sums = np.cumsum(packs + case.outside, axis=0) * case.host
            assert np.allclose(states[1:] - case.start, sums, rtol=0.0, atol=1e-9 * states.max())
            if done is not runs:
                means = 0.5 * (states[1:] + states[:-1])
                outer = np.sum(means @ (case.outside * masses)) * case.host
                gap = kinetic[-1] - kinetic[0] + work - outer
                assert abs(gap) < 1e-12 * (kinetic.max() + abs(outer))
            assert abs(done[1].slip[-1]) < 1e-6 * done[1].first
