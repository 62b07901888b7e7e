"""Speeds that come anew only every few steps: the pack steps with them, and holds.

A master repeats each of its steps, or a sensor is read at its own rate. Two shafts; the torque
that is given in a step acts some steps later.
"""

import numpy as np
import pytest
from drivelines import two_inertias
from test_asking import LOAD, prescribed
from unit import Unit

from thrustwasher.clutch.kernels import layout as L
from thrustwasher.errors import Status

H, J, CAPACITY, FIRST, HELD = 1e-3, 0.13, 150.0, 50.0, 40.0  # s, kg m2, N m, rad/s, N m


class Rising:
    """What scales the unit: N m per load."""

    gain, loads = CAPACITY, (1.0,)


def repeated(times, age, steps=160):
    """Return slips, heat over work, and the unit, of a master that makes each step so often."""
    unit, slip, slips, work = Unit(Rising()), FIRST, [], 0.0
    waiting = [0.1 * CAPACITY] * age  # as at the initialization
    for n in range(steps):
        load = min(1.0, 0.1 + 0.02 * n)
        for _ in range(times):
            torque = unit.step(slip, H / times, load)
        waiting.append(torque)
        acting, before = waiting.pop(0), slip
        slip += H * (HELD - acting) / J
        work += acting * H * 0.5 * (slip + before)
        slips.append(slip)
    return np.array(slips), unit.energy / work, torque, unit


@pytest.mark.parametrize("times", [2, 3, 5])
@pytest.mark.parametrize("age", [0, 1, 2])
def test_a_master_that_repeats_its_steps_gets_a_lock(age, times):
    slips, heat, torque, unit = repeated(times, age)
    assert np.abs(slips[-60:]).max() < 1e-6 and unit.locked
    assert torque == pytest.approx(HELD, rel=1e-6)
    assert unit.inertia == pytest.approx(J, rel=1e-6) and unit.age == age
    assert heat == pytest.approx(1.0, rel=0.01)
    assert unit.status == Status.OK


@pytest.mark.parametrize("every", [2, 4, 10])
@pytest.mark.parametrize("age", [0, 1, 2])
def test_a_sensor_with_a_rate_of_its_own_gets_a_lock(age, every):
    """The torque acts in each step; its age is a part of the sensor's period."""
    unit, slip = Unit(Rising()), 4.0 * FIRST
    waiting = [0.0] * age
    for n in range(800):
        if n % every == 0:
            seen = slip
        waiting.append(unit.step(seen, H, 1.0))
        slip += H * (HELD - waiting.pop(0)) / J
    assert abs(slip) < 1e-3 and unit.locked
    assert unit.inertia == pytest.approx(J, rel=0.02)


@pytest.mark.parametrize("kind", ["sine", "chirp", "noise", "walk", "controlled"])
@pytest.mark.parametrize("every", [2, 5])
def test_a_prescribed_slip_that_is_held_is_not_believed(kind, every):
    """It asks twice: of each step, then of those in which the slip is new."""
    for seed in range(3):
        slips, h = prescribed(kind, seed)
        unit, sums = Unit(two_inertias(1)), [0.0, 0.0]
        for slip in np.repeat(slips, every):
            torque = unit.step(slip, h, LOAD)
            sums[0] += torque * slip * h
            sums[1] += unit.capacity * abs(slip) * h
            assert torque * slip >= 0.0 and unit.inertia == 0.0 and not unit.locked
        assert sums[0] == pytest.approx(sums[1], rel=0.015)
        assert unit.energy == pytest.approx(sums[1], rel=0.02)


def test_a_held_slip_that_is_held_no_more_is_taken_step_by_step():
    unit, slip = Unit(Rising()), 120.0
    for n in range(300):
        if n % 3 == 0 or n > 60:
            seen = slip
        slip += H * (HELD - unit.step(seen, H, 1.0)) / J
        if n == 50:
            assert unit.out[L.O_ADVISED] == pytest.approx(3.0 * H)
    slip += 10.0  # a jump, as of another torque
    for _ in range(80):
        slip += H * (HELD - unit.step(slip, H, 1.0)) / J
    assert abs(slip) < 1e-6 and unit.locked


def test_a_state_from_the_middle_of_a_held_slip_goes_on_to_the_same_bits():
    one, other = Unit(Rising(), fidelity="field"), Unit(Rising(), fidelity="field")
    slip = FIRST
    for n in range(90):
        if n % 3 == 0:
            seen = slip
        if n == 31:
            other.state[:] = one.state
        torque = one.step(seen, H, 1.0)
        if n >= 31:
            assert other.step(seen, H, 1.0) == torque
            assert other.state.tobytes() == one.state.tobytes()
        slip += H * (HELD - torque) / J
