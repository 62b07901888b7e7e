"""A driveline that was proved may be another one by now, or none: what a held pack does then."""

import math

import numpy as np
import pytest
from unit import Unit

from thrustwasher.clutch.kernels import layout as L
from thrustwasher.errors import Status
from thrustwasher.tribology.holding import memory as M

INERTIA = 0.13  # kg m2, that the slip sees


class Constant:
    gain, loads = 205.0, (1.0,)  # capacity in N m


class Shafts:
    """Two shafts and a pack whose torque acts ``age`` steps late; from a slip to a hold."""

    def __init__(self, age, h, first=100.0, outside=(40.0, 20.0), inertias=(0.15, 1.0)):
        self.unit, self.h, self.inertias = Unit(Constant()), h, inertias
        self.outside, self.slip = outside, first
        self.waiting = [0.0] * age
        self.rows = []

    @property
    def inertia(self):
        return math.prod(self.inertias) / sum(self.inertias)

    def run(self, steps):
        """Return slip at the start, torque given, work, locked and bound of each step."""
        rows = []
        for _ in range(steps):
            torque = self.unit.step(self.slip, self.h, 1.0)
            self.waiting.append(torque)
            acting, before = self.waiting.pop(0), self.slip
            (one, two), (j1, j2) = self.outside, self.inertias
            self.slip += self.h * ((one - acting) / j1 - (acting - two) / j2)
            work = 0.5 * acting * (before + self.slip) * self.h
            rows.append((before, torque, work, self.unit.locked, self.unit.bound))
        return np.array(rows, float).T


def held(age, h=1e-3, **more):
    """Return shafts that the pack has held for a while."""
    shafts = Shafts(age, h, **more)
    shafts.run(400)
    assert shafts.unit.locked and shafts.unit.age == age
    assert shafts.unit.inertia == pytest.approx(shafts.inertia, rel=1e-3)
    return shafts


@pytest.mark.parametrize("age", [0, 1, 2])
@pytest.mark.parametrize("size", [0.5, 1.6, 20.0])
@pytest.mark.parametrize("period", [11.0, 20.4, 54.0, 150.0])
def test_a_host_that_prescribes_the_slip_after_a_lock_finds_friction(age, size, period):
    """Sines of so many times the slip that the capacity makes in a step; 1000 steps."""
    shafts = held(age)
    unit, h = shafts.unit, shafts.h
    slips = size * 205.0 * h / INERTIA * np.sin(2.0 * np.pi * np.arange(1000) / period)
    torques, heats = [], [unit.energy]
    for slip in slips:
        torques.append(unit.step(slip, h, 1.0))
        heats.append(unit.energy)
        assert not unit.locked or abs(slip) <= unit.bound
    power, slid = np.array(torques) * slips, 205.0 * np.abs(slips)
    assert np.count_nonzero(power < 0.0) <= 2 * (1 + age) + 2
    assert -power[power < 0.0].sum() < 0.005 * slid.sum()
    assert power.sum() == pytest.approx(slid.sum(), rel=0.05)
    assert (np.diff(heats) >= 0.0).all()
    assert unit.inertia == 0.0 and unit.told & {Status.UNANSWERED, Status.CHATTER}


@pytest.mark.parametrize("age", [0, 1, 2])
@pytest.mark.parametrize("h", [1e-3, 5e-3])
@pytest.mark.parametrize("jump", [0.0, 40.0, 110.0])
@pytest.mark.parametrize("light", [0.002, 0.02])
def test_a_shaft_that_grows_heavier_in_the_hold_is_found(age, h, jump, light):
    """From 2 or 20 g m2 to 2 kg m2, the outside torque jumps in the same step or does not."""
    shafts = held(age, h, inertias=(0.15, light), first=0.2)
    shafts.inertias, shafts.outside = (0.15, 2.0), (40.0 + jump, 20.0)
    slip, _, work, locked, bound = shafts.run(200)
    made, small = 205.0 * h / shafts.inertia, 1e-3 * shafts.unit.state[L.S_MEMORY + M.MOST_SLIP]
    assert np.abs(slip[-60:]).max() < 1e-9 and locked[-60:].all()
    assert shafts.unit.inertia == pytest.approx(shafts.inertia, rel=1e-3)
    assert (np.abs(slip) <= bound)[locked > 0.0].all()
    assert (bound[6 + 3 * age :] < max(0.06 * made, small) + 1e-3).all()
    assert -work[work < 0.0].sum() < (1 + age) * made * h * 205.0


@pytest.mark.parametrize("age", [0, 1, 2])
def test_a_jump_of_outside_torque_asks_nothing_of_a_driveline_that_is_right(age):
    """Some steps later the torque is right to the last digit."""
    shafts = held(age)
    for torque in (150.0, 40.0, -90.0, 160.0):
        shafts.outside = (torque, 20.0)
        slip, torques, _, _, _ = shafts.run(60)
        holding = shafts.inertia * (torque / 0.15 + 20.0 / 1.0)
        assert torques[8 + 3 * age :] == pytest.approx(holding, rel=1e-9)
        assert np.abs(slip[9 + 3 * age :]).max() < 1e-9


@pytest.mark.parametrize("age", [0, 1, 2])
@pytest.mark.parametrize("period", [30.0, 100.0])
def test_a_ripple_that_sets_in_asks_once_and_is_held(age, period):
    """Of 0.3 times the capacity; by less than 2 % of it the torque is another one."""
    shafts, slips = held(age), []
    n = np.arange(600)
    known = shafts.unit.inertia
    for wave in 60.0 * np.sin(2.0 * np.pi * n / period):
        shafts.outside = (40.0 + wave, 20.0)
        slips.append(float(np.abs(shafts.run(1)[0]).max()))
        assert shafts.unit.inertia == pytest.approx(known, rel=0.05)
    most = (age + 1) * (age + 2) / 2 * (60.0 / 0.15) * 2.0 * math.pi / period * shafts.h
    coded = 0.06 * 205.0 * shafts.h / INERTIA
    assert max(slips) < 1.1 * most + coded
    assert shafts.unit.bound >= 0.0499 * 205.0 * shafts.h / INERTIA  # sure again
    assert shafts.unit.told == {Status.OK}
