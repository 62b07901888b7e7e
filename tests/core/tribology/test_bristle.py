"""The bristle of friction at rest: passive, limited, exact slopes, no creep, the right lock-up.

Why the heat T v - k z z' is never negative (symbols: docs/theory/bristle.md):

1. Leaks. The last two terms of z' have the sign of -z: in -k z z' they give heat. Left is T v - k
   z r.
2. Without the cut. Let rho = (1 - alpha x)/(1 + alpha abs(v)/v_c) <= 1, so that r = n v rho. Then
   T v - k z r = n k z v (1 - rho) + d n v^2 rho. For v z <= 0 rho is 1, and d n v^2 is left. For
   v z > 0 only the second term can be negative, for x > 1. There d abs(v) <= b <= k abs(z)/2: it
   is at most half of n k abs(z) abs(v) abs(rho), less than the first.
3. Cut at C, v > 0. n k abs(z) <= C by the choice of n, and rho <= 1: for z > 0 k z r <= C v; for
   z <= 0 k z r <= 0. So C v - k z r >= 0.
4. Cut at C, v < 0 does not occur: for z > 0 r < 0 and n k z + d r < C; for z <= 0 r > 0 only with
   rho < 0, and then d r <= C/2 - C abs(n k z)/C < C.
"""

import numpy as np
import pytest
from sampling import sizes
from scipy.integrate import solve_ivp

from thrustwasher.tribology import bristle as B

ANGLE, SPEED, DAMPING, LARGEST = np.radians(0.02), 5.0, 2e-3, 210.0
ONE = B.Bristle(LARGEST / ANGLE, LARGEST, SPEED, DAMPING)


def states(n, seed=0):
    """Random capacities, slips and bendings over many decades, 0 among them."""
    rng = np.random.default_rng(seed)
    for k in range(n):
        capacity = 0.0 if k % 50 == 0 else LARGEST * 10 ** rng.uniform(-6, 0.3)
        slip = 0.0 if k % 70 == 0 else rng.choice([-1, 1]) * 10 ** rng.uniform(-8, 3)
        bend = rng.normal() * 10 ** rng.uniform(-3, 0.5) * max(capacity, 1e-3) / ONE.stiffness
        yield capacity, slip, bend


@sizes(10_000, 200_000)
def test_heat_never_falls_and_the_torque_stays_below_the_capacity(n):
    least = over = 0.0
    for capacity, slip, bend in states(n):
        torque, rate = B.bristle(ONE, capacity, slip, bend)
        power, stored = torque * slip, ONE.stiffness * bend * rate
        least = min(least, (power - stored) / (abs(power) + abs(stored) + 1e-300))
        over = max(over, abs(torque) - capacity)
    assert least > -1e-12
    assert over <= 0.0


def test_slopes_are_those_of_the_values():
    tried = 0
    for capacity, slip, bend in states(3000, seed=4):
        point = np.array([capacity, slip, bend])
        size = np.array([max(capacity, 1e-2), max(abs(slip), 1e-3), max(abs(bend), 1e-7)])
        found = np.array(B.bristle_slopes(ONE, *point)).reshape(2, 3)
        expected, sides = np.zeros((2, 3)), np.zeros((2, 3))
        for k in range(3):
            h = np.eye(3)[k] * 1e-5 * size
            if point[0] - h[0] < 0.0:
                h[0] = 0.0
            up, here, down = (np.array(B.bristle(ONE, *(point + s * h))) for s in (1, 0, -1))
            step = h[k] or np.nan
            expected[:, k], sides[:, k] = (up - down) / (2 * step), (up - 2 * here + down) / step
        smooth = np.abs(sides) <= 1e-3 * np.abs(expected) + 1e-12
        bad = smooth & (np.abs(found - expected) > 1e-3 * np.abs(expected) + 1e-9)
        assert not bad[~np.isnan(expected)].any(), (point, found, expected)
        tried += int(smooth.sum())
    assert tried > 6000


def test_rates_are_bounded_whatever_the_slip():
    """At rest and in reversal |v| n, in sliding v_c n: no stiffness grows with the slip."""
    for slip in (1e-3, 1.0, 30.0, 1e3):
        slopes = B.bristle_slopes(ONE, LARGEST, slip, ANGLE)
        assert abs(slopes[5]) <= 1.05 * (1.0 + np.pi * 5.0) * SPEED / ANGLE
        assert abs(B.bristle(ONE, LARGEST, slip, -0.5 * ANGLE)[1]) == pytest.approx(slip)


def test_steady_sliding_gives_the_capacity_exactly():
    for capacity in (1e-3, 5.0, 21.0, 210.0):
        bend = B.sliding_angle(ONE, capacity)
        torque, rate = B.bristle(ONE, capacity, 50.0, bend)
        assert torque == pytest.approx(capacity, rel=1e-14)
        assert rate == pytest.approx(0.0, abs=1e-9) or capacity < B.GONE * LARGEST
        assert B.first_bend(ONE, capacity, -50.0) == -bend


def body(inertia, load, capacity):
    """Return the right-hand side of a body held by a bristle: speed, bending, heat, work, angle."""

    def rates(t, y):
        speed, bend = y[:2]
        torque, rate = B.bristle(ONE, capacity(t), speed, bend)
        heat = B.bristle_heat(ONE, torque, speed, bend, rate)
        return [(load(t) - torque) / inertia, rate, heat, torque * speed, speed]

    return rates


def solved(rates, start, end, **more):
    given = {"method": "LSODA", "rtol": 1e-8, "atol": [1e-9, 1e-13, 1e-6, 1e-6, 1e-12], **more}
    return solve_ivp(rates, (0.0, end), start, **given)


@pytest.mark.parametrize("part", [0.3, 0.65, 0.89])
def test_nothing_creeps_below_nine_tenths_of_the_capacity(part):
    """Vibration at 20 Hz with peaks at this part of the capacity: all slip stays elastic."""

    def load(t):
        return part * LARGEST * np.sin(2.0 * np.pi * 20.0 * t)

    run = solved(body(0.13, load, lambda t: LARGEST), [0.0] * 5, 1.0, max_step=2e-3)
    assert run.success
    assert abs(run.y[4] - run.y[1]).max() < 1e-9  # rad of slip that is not bending


def test_two_inertias_lock_when_the_slip_is_used_up():
    """At constant capacity C the slip ends at v0/(C (1/J1 + 1/J2) - T1/J1 + T2/J2)."""
    first, second, capacity = 0.15, 1.0, 150.0
    drive, load, slip = 100.0, -20.0, 60.0

    def rates(t, y):
        v = y[0] - y[1]
        torque, rate = B.bristle(ONE, capacity, v, y[2])
        heat = B.bristle_heat(ONE, torque, v, y[2], rate)
        return [(drive - torque) / first, (load + torque) / second, rate, heat]

    z0 = B.first_bend(ONE, capacity, slip)
    run = solve_ivp(
        rates, (0.0, 0.4), [slip, 0.0, z0, 0.0], method="Radau", rtol=1e-8, atol=1e-9, max_step=0.01
    )
    falls = capacity * (1 / first + 1 / second) - drive / first + load / second
    left = run.y[0] - run.y[1]
    at = np.interp(-0.01 * slip, -left, run.t)
    assert at == pytest.approx(0.99 * slip / falls, rel=1e-3)
    assert run.y[3, -1] == pytest.approx(0.5 * capacity * slip**2 / falls, rel=2e-3)
    held = (drive / first - load / second) / (1 / first + 1 / second)
    assert B.bristle(ONE, capacity, left[-1], run.y[2, -1])[0] == pytest.approx(held, rel=1e-4)


def test_a_capacity_that_falls_under_a_load_lets_go_and_gives_back_no_more_than_is_stored():
    def capacity(t):
        return LARGEST * max(0.0, 1.0 - t / 0.05)

    run = solved(body(0.13, lambda t: 50.0, capacity), [0.0, 50.0 / ONE.stiffness, 0, 0, 0], 0.1)
    work = run.y[3]
    assert (np.maximum.accumulate(work) - work).max() <= 0.5 * ONE.stiffness * run.y[1].max() ** 2
    assert run.y[0, -1] == pytest.approx(50.0 / 0.13 * 0.06, rel=0.3)  # free again
    assert abs(run.y[1, -1]) < 1e-9 and np.diff(run.y[2]).min() > -1e-9


def test_a_bristle_is_held_below_its_capacity_and_free_without_one():
    assert B.margin(ONE, 100.0, 0.5 * 100.0 / ONE.stiffness, B.HELD) > 0.0
    assert B.margin(ONE, 100.0, 0.97 * 100.0 / ONE.stiffness, B.HELD) < 0.0
    assert B.margin(ONE, 100.0, 0.97 * 100.0 / ONE.stiffness, B.FREE) > 0.0
    assert B.margin(ONE, 0.0, 0.0, B.FREE) < 0.0


def beside(first, second, end, start=(60.0, 0.0), **more):
    """Return a run of two bristles in parallel between two inertias, and both end torques."""
    inertias, drive, load = (0.15, 1.0), 100.0, -20.0

    def torques(t, y):
        v = y[0] - y[1]
        return [B.bristle(ONE, c(t), v, z) for c, z in zip((first, second), y[2:], strict=True)]

    def rates(t, y):
        (one, bend), (two, other) = torques(t, y)
        both = one + two
        return [(drive - both) / inertias[0], (load + both) / inertias[1], bend, other]

    given = {"method": "LSODA", "rtol": 1e-7, "atol": [1e-6, 1e-6, 1e-11, 1e-11], **more}
    run = solve_ivp(rates, (0.0, end), [*start, 0.0, 0.0], **given)
    assert run.success
    return run, [torque for torque, _ in torques(end, run.y[:, -1])]


HELD = (100.0 / 0.15 + 20.0) / (1.0 / 0.15 + 1.0)


def test_two_packs_in_parallel_share_the_torque_that_holds():
    run, torques = beside(lambda t: 150.0, lambda t: 100.0, 1.0)
    assert sum(torques) == pytest.approx(HELD, rel=1e-4)
    assert abs(run.y[0, -1] - run.y[1, -1]) < 1e-4
    assert 0.0 < torques[1] <= 100.0 and 0.0 < torques[0] <= 150.0


def test_a_pack_hands_over_to_another_at_rest():
    """The first lets go while the second takes hold: nothing slips but what the bristles bend."""
    run, torques = beside(
        lambda t: 200.0 * min(1.0, max(0.0, (1.0 - t) / 0.5)),
        lambda t: 200.0 * min(1.0, t / 0.5),
        1.5,
        start=(50.0, 50.0),
        max_step=5e-3,
    )
    assert torques[0] == pytest.approx(0.0, abs=1e-6)
    assert torques[1] == pytest.approx(HELD, rel=1e-3)
    late = run.t > 1.1
    assert abs(run.y[0] - run.y[1])[late].max() < 1e-3


def test_a_weak_washer_next_to_a_locked_pack_does_no_harm():
    _, torques = beside(lambda t: 200.0, lambda t: 0.05, 1.0)
    assert sum(torques) == pytest.approx(HELD, rel=1e-4) and abs(torques[1]) <= 0.05


def test_a_capacity_from_nothing_and_through_nothing_stays_within_it():
    """Prescribed slip, the capacity 0 at the start and once more: |T| <= C, no energy made."""

    def capacity(t):
        return 200.0 * abs(np.sin(2.0 * np.pi * t))

    def rates(t, y):
        slip = 5.0 * np.sin(31.4 * t)
        torque, rate = B.bristle(ONE, capacity(t), slip, y[0])
        return [rate, torque * slip]

    run = solve_ivp(
        rates, (0.0, 1.0), [0.0, 0.0], method="LSODA", rtol=1e-7, atol=[1e-11, 1e-4], max_step=1e-3
    )
    work, store = run.y[1], 0.5 * ONE.stiffness * run.y[0] ** 2
    assert run.success
    assert (np.maximum.accumulate(work) - work).max() <= store.max() * (1.0 + 1e-6) + 1e-6
    for t, bend in zip(run.t, run.y[0], strict=True):
        assert abs(B.bristle(ONE, capacity(t), 5.0 * np.sin(31.4 * t), bend)[0]) <= capacity(t)
