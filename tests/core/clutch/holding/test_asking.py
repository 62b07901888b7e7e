"""A pack asks before it holds: no slip that is prescribed is believed, and no lock is a lie."""

from itertools import pairwise

import numpy as np
import pytest
from drivelines import run, two_inertias
from sampling import sizes
from unit import PACK, Unit

from thrustwasher.clutch.kernels import layout as L
from thrustwasher.errors import Status

LOAD = 1e5  # N
STEPS = 600


def prescribed(kind, seed):
    """Return a slip [rad/s] over 600 steps that answers nothing."""
    rng = np.random.default_rng([seed, 5])
    n = np.arange(STEPS)
    size, period = 10.0 ** rng.uniform(0.0, 2.0), 10.0 ** rng.uniform(0.78, 2.0)
    phase = 2.0 * np.pi * rng.random()
    white = rng.standard_normal(STEPS)
    sine = np.sin(2.0 * np.pi * n / period + phase)
    made = {
        "sine": sine,
        "chirp": np.sin(np.pi * n**2 / STEPS / rng.uniform(4.0, 12.0) + phase),
        "square": np.where(n % int(period) < period / 2.0, 1.0, -1.0),
        "noise": white,
        "walk": 0.1 * np.cumsum(white),
        "stop": np.maximum(1.0 - n / 300.0, 0.0) + 1e-3 * white,
        "rounded stop": np.round(100.0 * np.maximum(1.0 - n / 300.0, 0.0) + 0.5 * white) / 100.0,
        "controlled": (0.05 + 0.95 * np.exp(-n / 60.0)) * (1.0 + 0.02 * white),
        "about a mean": 1.1 + sine + 1e-3 * white,
    }
    return size * made[kind], 10.0 ** rng.uniform(-3.7, -2.0)


KINDS = ("sine", "chirp", "square", "noise", "walk", "stop", "rounded stop", "controlled")
KINDS += ("about a mean",)
LOADS = {
    "constant": lambda slip, n: np.ones(len(slip)),
    "in step with the slip": lambda slip, n: 1.0 + 0.6 * np.roll(slip, n) / np.abs(slip).max(),
    "over the slip's size": lambda slip, n: 0.7 + 0.3 * np.abs(slip) / np.abs(slip).max(),
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("loads", LOADS)
@sizes(1, 4)
def test_no_slip_that_is_prescribed_is_believed(kind, loads, n):
    """Friction brakes in every step; its heat is that of a pack that slides."""
    for seed in range(n):
        slip, h = prescribed(kind, seed)
        load = LOAD * LOADS[loads](slip, seed)
        case = two_inertias(1)
        unit, sums, heats = Unit(case), [0.0, 0.0], [0.0]
        for s, force in zip(slip, load, strict=True):
            torque = unit.step(s, h, force)
            sums[0] += torque * s * h
            sums[1] += unit.capacity * abs(s) * h
            assert torque * s >= 0.0
            assert unit.inertia == 0.0 and unit.age == -1 and not unit.locked
            heats.append(unit.energy)
        assert sums[0] == pytest.approx(sums[1], rel=0.01)
        assert heats[-1] == pytest.approx(sums[1], rel=0.015)  # the ends of a series
        assert all(b >= a for a, b in pairwise(heats))


@pytest.mark.parametrize("kind", KINDS)
def test_a_driveline_that_was_given_and_is_not_there_makes_no_heat_wrong(kind):
    """Capacity would make 3 % of the largest slip in a step; ages 0, 1, 2 in turn."""
    for seed in range(3):
        slip, h = prescribed(kind, seed)
        case = two_inertias(1)
        inertia = case.gain * LOAD * h / (0.03 * np.abs(slip).max())
        unit, work = Unit(case, (inertia, seed)), []
        for s in slip:
            work.append(unit.step(s, h, LOAD) * s * h)
        slid = unit.capacity * np.abs(slip).sum() * h
        assert sum(work) == pytest.approx(slid, rel=0.02)
        assert -sum(w for w in work if w < 0.0) < 0.005 * slid
        assert unit.energy == pytest.approx(slid, rel=0.03)  # at the age that is given


def test_heat_is_booked_as_it_arises():
    """In one step of 10 s, and while the load rises over a hundred short ones."""
    case = two_inertias(1)
    unit = Unit(case)
    unit.step(100.0, 10.0, LOAD)
    assert unit.energy == pytest.approx(unit.capacity * 1e3, rel=1e-6)
    unit, h, slid = Unit(case), 1e-3, 0.0
    for n in range(100):
        slip = 200.0 - 0.2 * n
        unit.step(slip, h, LOAD * n / 100.0)
        slid += unit.capacity * slip * h
    assert unit.energy == pytest.approx(slid, rel=0.01)


class Constant:
    gain, loads = 165.0, (1.0,)


@pytest.mark.parametrize("age", [0, 1, 2])
def test_heat_is_that_of_the_age_also_where_noise_hides_it_until_the_lock(age):
    """Constant load from the first step, noise of 1e-5 of the first slip, 60 steps to the lock."""
    unit, h, inertia, rng = Unit(Constant()), 1e-3, 0.13, np.random.default_rng(3)
    slip, waiting, work, heats = 60.0 * 165.0 * h / inertia, [0.0] * age, 0.0, [0.0]
    noise = 1e-5 * slip * rng.standard_normal(200)
    for n in range(200):
        waiting.append(unit.step(slip + noise[n], h, 1.0))
        before, torque = slip, waiting.pop(0)
        slip -= h * torque / inertia
        work += 0.5 * torque * (before + slip) * h
        heats.append(unit.energy)
    assert unit.locked and unit.age == age
    assert heats[-1] == pytest.approx(work, rel=5e-3)
    assert all(b >= a for a, b in pairwise(heats))


@pytest.mark.parametrize("age", [0, 1, 2])
def test_a_jump_of_outside_torque_does_not_refute_what_was_given(age):
    h, inertia, slip, waiting = 1e-3, 0.13, 50.0, [0.0] * age
    unit = Unit(Constant(), (inertia, age))
    for n in range(300):
        outside = 165.0 * (0.1 if n < 150 else -0.66 if n < 220 else 0.33)
        waiting.append(unit.step(slip, h, 1.0))
        slip += h * (outside - waiting.pop(0)) / inertia
        assert unit.status != Status.REFUTED
    assert abs(slip) < 1e-6 and unit.locked


@pytest.mark.parametrize("share", [0.005, 0.01, 5.4 / 165.0, 0.1, 0.3, 0.6])
@pytest.mark.parametrize("age", [0, 1, 2])
def test_a_pack_that_was_stuck_feels_its_way_to_twice_the_torque_it_holds(age, share):
    unit, slip, torques, h, inertia = Unit(Constant(), starts_pressed=True), 0.0, [], 1e-3, 0.13
    waiting, held = [0.0] * age, -share * 165.0
    for _ in range(200):
        torques.append(unit.step(slip, h, 1.0))
        waiting.append(torques[-1])
        slip += h * (held - waiting.pop(0)) / inertia
    assert np.abs(torques).max() < 2.0 * abs(held)
    assert torques[-1] == pytest.approx(held, rel=1e-9) and unit.locked


def watched(case, unit):
    """Step a case; return its run, with bounds of a lock beside it."""
    bounds, bases = [], []
    real = unit.step

    def step(*now):
        torque = real(*now)
        bounds.append(unit.bound)
        bases.append(int(unit.iout[L.IO_LOCK_BASIS]))
        return torque

    unit.step = step
    return run(case, unit), np.array(bounds), np.array(bases)


@pytest.mark.parametrize("sigma", [0.0, 1e-4, 1e-3])
def test_a_lock_is_within_its_bound_and_heat_never_falls(sigma):
    """The slip seen in the last steps, also of a pack that is told its driveline, noise or not."""
    for seed in range(12):
        case = two_inertias(seed, sigma=sigma)
        for known in (None, (case.inertia, case.delay)):
            made, bounds, bases = watched(case, Unit(case, known))
            noise = np.array(case.noise) if sigma else np.zeros(len(case.steps))
            seen = np.abs(np.r_[case.slip, made.slip[:-1]] + noise)
            for n in np.flatnonzero(made.locked):
                last = slice(max(n - 1 - case.delay, 0), n + 1)
                assert (seen[last] <= bounds[last] * (1.0 + 1e-9)).all()
            assert (bases == made.locked * (2 if known else 1)).all()
            assert (np.diff(made.energy) >= 0.0).all()


def test_a_driveline_that_was_given_and_is_not_there_is_refuted():
    """A slip that stops by itself; the pack asks near zero, is not answered and slides."""
    case = two_inertias(1)
    for delay in (0, 1, 2):
        unit = Unit(case, (1e-4 * LOAD * 0.04, delay))
        for n in range(300):
            unit.step(40.0 * (1.0 - n / 260.0), 1e-3, LOAD)
        assert unit.status == Status.REFUTED and not unit.locked
        unit.step(0.0, 1e-3, 0.0)  # open: believed again
        assert unit.status != Status.REFUTED


def test_what_is_trusted_is_never_asked():
    case = two_inertias(1, "constant", delay=0)
    unit = Unit(case, (case.inertia, 0), probing=False)
    made, _, bases = watched(case, unit)
    sliding = made.locked == 0.0
    lowered = np.abs(made.given) < 0.999 * made.capacity
    assert np.count_nonzero(lowered & sliding) <= 4  # at lock, on the way to the holding torque
    assert set(bases.tolist()) == {0, 3}


def test_a_pack_says_why_it_does_not_hold():
    case = two_inertias(1)
    deaf, held = Unit(case), Unit(case)
    for n in range(400):
        deaf.step(20.0 * np.cos(0.1 * n), 1e-3, LOAD)
        held.step(20.0 * np.cos(0.1 * (n // 10 * 10) ** 1.01) + 30.0, 1e-3, LOAD)
    assert deaf.told == {Status.OK, Status.UNANSWERED} and deaf.status == Status.OK
    assert held.status == Status.CHATTER
    assert held.out[L.O_ADVISED] == pytest.approx(1e-2)


def test_a_pack_that_slips_on_beside_a_locked_one_does_not_dip_for_ever():
    """A slip that a stronger pack keeps: after ten steps the torque is the capacity."""
    case = two_inertias(1)
    unit, plain = Unit(case), Unit(case, holding="off")
    for n in range(300):
        torque, free = (u.step(40.0 + 0.01 * n, 1e-3, LOAD) for u in (unit, plain))
        if n > 12:
            assert torque == pytest.approx(free, rel=1e-12)


def test_a_state_from_the_middle_of_asking_goes_on_to_the_same_bits():
    case = two_inertias(7, "constant", delay=1)
    one, other = Unit(case, params=PACK, fidelity="field"), Unit(case, fidelity="field")
    slip = case.slip
    for n in range(60):
        if n == 6:
            assert one.state[L.S_MEMORY :].any()
            other.state[:] = one.state
        torque = one.step(slip, case.host, case.loads[n])
        if n >= 6:
            assert other.step(slip, case.host, case.loads[n]) == torque
            assert other.state.tobytes() == one.state.tobytes()
        slip -= case.host * torque / case.inertia


@pytest.mark.parametrize("delay", [0, 1, 2])
@pytest.mark.parametrize("passed", [True, False])
def test_the_torque_of_the_initialization_counts_where_it_acted(passed, delay):
    """Two shafts and no outside torque: all that they lose, J s^2/2, is heat."""
    inertia, torque, slip, h = 0.1, 50.0, 200.0, 1e-3

    class Case:
        gain, loads = torque, (1.0,)

    unit = Unit(Case())
    first = torque if passed else 0.0  # what a host has before the first step
    waiting, whole = [first] * delay, 0.5 * inertia * slip**2
    for _ in range(600):
        waiting.append(unit.step(slip, h, 1.0))
        slip -= h * waiting.pop(0) / inertia
    assert abs(slip) < 1e-9 and unit.locked
    assert unit.energy == pytest.approx(whole, rel=1e-12)
