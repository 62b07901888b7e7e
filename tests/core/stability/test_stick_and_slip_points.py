"""A pack that locks, or breaks away, exactly at a communication point.

Hazard: the event falls between two steps. One step ends with a slip of some 1e-14 rad/s, which is
    neither zero nor motion; the next one finds a pack that slips in no direction, and chatters.
    Or zero slip meets a capacity equal to the reaction: both modes are right, and a solver that
    asks for both in turn never ends.
Formula: lock at t = dw J/(T_k (1 + 1/r) - T_e); break-away where the capacity has fallen to the
    reaction T_r = r tau.
Cure: modes are state and events are located on the solution; sticking is tried first, and a tie
    within 1e-12 of the capacity holds.
"""

import math

import pytest
from closed_forms.lock_up import engagement

from thrustwasher.errors import Status

from gearbox import FREE, Gearbox  # isort: skip

LOCKING = FREE | {"drum_inertia": 0.0, "engine_torque": 40.0, "initial_drum_speed": 9.0}
EXACT = engagement(300.0 * (1 + 1 / 2.2), 40.0, 0.0, 0.25, 8.0, 350.0, (350.0 + 2.2 * 9.0) / 3.2)
HELD = {"load_torque": 0.0, "drum_inertia": 0.0, "washers": 0}
REACTION = 250.0  # 2.2 (150 - 0.25 x 150/J), J = 0.25 + 8/3.2^2: brake's torque in first gear


@pytest.mark.parametrize("nudge", [0.0, 1e-16, -1e-16, 1e-13, -1e-13, 1e-9, -1e-9])
@pytest.mark.parametrize("steps", [1, 2, 7, 16])
def test_a_lock_up_at_a_point_is_one_lock_up(steps, nudge):
    box, dt = Gearbox(**LOCKING), EXACT.lock_time / steps * (1.0 + nudge)
    for _ in range(steps):
        box.step(dt, clutch=300.0)
    assert abs(box["clutch_speed"]) < 1e-6
    box.step(dt, clutch=300.0)
    assert box["clutch_locked"] == 1.0 and box["events"] == 1.0
    assert box["clutch_speed"] == 0.0
    assert box["lock_time"] == pytest.approx(EXACT.lock_time, rel=1e-14)
    assert box["clutch_heat"] == pytest.approx(EXACT.heat, rel=1e-14)


@pytest.mark.parametrize("steps", [4, 5, 10])
def test_a_break_away_at_a_point_is_one_break_away(steps):
    box = Gearbox(**HELD)
    for i in range(2 * steps):
        box.step(0.01, brake=REACTION + 100.0 * (steps - i) / steps)
        assert box["brake_locked"] == (1.0 if i < steps else 0.0)
    assert box["release_time"] == pytest.approx(0.01 * steps, rel=1e-11)
    assert box["events"] == 1.0 and box["brake_speed"] < 0.0


@pytest.mark.parametrize("nudge", [0.0, -1e-16, 1e-16, -1e-13, 1e-9])
def test_a_tie_of_capacity_and_reaction_holds_and_does_not_chatter(nudge):
    box = Gearbox(**HELD)
    for _ in range(50):
        box.step(0.01, brake=REACTION * (1.0 + nudge))
        assert box["brake_locked"] == 1.0 and box["brake_speed"] == 0.0
    assert box["events"] == 0.0


def test_less_than_a_tie_slips_at_the_rate_of_what_is_missing():
    box = Gearbox(**HELD)
    for _ in range(20):
        box.step(0.01, brake=REACTION * (1.0 - 1e-9))
    assert box["brake_locked"] == 0.0 and -1e-7 < box["brake_speed"] < 0.0


@pytest.mark.parametrize(
    "capacity", [math.nextafter(150.0, 0.0), 150.0, math.nextafter(150.0, 200)]
)
def test_both_packs_at_rest_with_exactly_what_the_engine_gives_hold(capacity):
    box = Gearbox(engine_torque=150.0, load_torque=0.0, washers=0, initial_engine_speed=0.0)
    for _ in range(5):
        box.step(0.01, clutch=capacity, brake=1000.0)
    assert box["clutch_locked"] == box["brake_locked"] == 1.0
    assert box["engine_speed"] == 0.0
    assert box["solver_status"] == Status.STALLED


def test_no_capacity_holds_nothing_and_the_least_number_holds_what_is_at_rest():
    box = Gearbox(**FREE | {"initial_engine_speed": 0.0})
    box.step(0.01)
    assert box["clutch_locked"] == box["brake_locked"] == 0.0
    for capacity in (5e-324, 1e-300, 1e-12):
        box.step(0.01, clutch=capacity, brake=capacity)
        assert box["clutch_locked"] == box["brake_locked"] == 1.0
        assert box["clutch_speed"] == box["brake_speed"] == 0.0


def test_capacity_that_comes_and_goes_every_step_costs_one_event_each():
    box = Gearbox(**FREE | {"engine_torque": 150.0, "initial_drum_speed": 350.0})
    for i in range(100):
        box.step(1e-3, clutch=300.0 if i % 2 else 0.0)
    assert box["events"] <= 100.0
    assert abs(box["energy_residual"]) < 1e-10 * box["engine_work"]
