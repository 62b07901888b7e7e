"""The elastic output shaft: closed forms of a two-mass oscillator, energy, and the rigid limit."""

import math

import pytest

from test_transmission_step import FREE, Gearbox  # isort: skip

SHAFT = {
    "carrier_inertia": 0.4,
    "vehicle_inertia": 8.0,
    "shaft_stiffness": 2000.0,
    "shaft_damping": 1.5,
}


def free_twist(inertia, t, start=0.02):
    """Return twist, its rate and the frequency of two inertias on the shaft, released at rest."""
    per = 1.0 / inertia + 1.0 / SHAFT["vehicle_inertia"]
    decay = 0.5 * SHAFT["shaft_damping"] * per
    frequency = math.sqrt(SHAFT["shaft_stiffness"] * per - decay**2)
    fade, angle = start * math.exp(-decay * t), frequency * t
    twist = fade * (math.cos(angle) + decay / frequency * math.sin(angle))
    rate = -fade * (frequency + decay**2 / frequency) * math.sin(angle)
    return twist, rate, frequency, decay


CASES = {  # packs that hold, and the inertia before the shaft (ring inertia 0.05, ratio 2.2)
    "brake holds": ({"brake": 1e4}, 0.4 + 3.2**2 * 0.25),
    "clutch holds": ({"clutch": 1e4}, 0.4 + 0.25 + 0.05),
    "both hold": ({"clutch": 1e4, "brake": 1e4}, math.inf),
    "both open": ({}, 0.4 + 3.2**2 / (2.2**2 / 0.05 + 1 / 0.25)),
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("step", [1e-3, 0.05])
def test_two_inertias_on_the_shaft_swing_as_the_closed_form_says(case, step):
    held, inertia = CASES[case]
    box = Gearbox(**FREE | SHAFT, drum_inertia=0.05, initial_engine_speed=0.0, initial_twist=0.02)
    while box.time < 0.3:
        assert box.step(step, **held) == 0
        twist, rate, *_ = free_twist(inertia, box.time)
        assert box["shaft_twist"] == pytest.approx(twist, abs=1e-10)
        torque = SHAFT["shaft_stiffness"] * twist + SHAFT["shaft_damping"] * rate
        assert box["shaft_torque"] == pytest.approx(torque, abs=1e-6)
        assert box["output_speed"] - box["vehicle_speed"] == pytest.approx(rate, abs=1e-8)


def test_what_the_spring_loses_the_damper_and_the_motion_take():
    box = Gearbox(**FREE | SHAFT, drum_inertia=0.01, initial_engine_speed=0.0, initial_twist=0.1)
    spring = 0.5 * SHAFT["shaft_stiffness"] * 0.1**2
    last = 0.0
    for _ in range(1200):
        box.step(0.01, brake=1e4)
        assert box["shaft_heat"] > last
        last = box["shaft_heat"]
        left = 0.5 * SHAFT["shaft_stiffness"] * box["shaft_twist"] ** 2
        assert box["shaft_energy"] == pytest.approx(left - spring, abs=1e-12)
        assert abs(box["energy_residual"]) < 1e-8 * spring
    assert box["shaft_heat"] == pytest.approx(spring, rel=1e-3)


def shift(**params):
    """Return a gearbox after a shift: brake open, clutch locking, load on the vehicle."""
    box = Gearbox(drum_inertia=0.01, washers=8, **params)
    for i in range(300):
        assert (
            box.step(
                5e-3,
                clutch=350.0 if i > 20 else 0.0,
                brake=380.0 if i <= 20 else 0.0,
                washer=0.03,
                mesh=0.2,
            )
            == 0
        )
    return box


def test_a_very_stiff_shaft_is_a_rigid_one():
    rigid = shift(carrier_inertia=8.4)
    known = ("lock_time", "lock_speed", "clutch_heat", "engine_work", "vehicle_speed")
    errors = []
    for stiffness in (2e4, 2e6):
        box = shift(**SHAFT | {"shaft_stiffness": stiffness, "shaft_damping": stiffness * 1e-3})
        errors.append(max(abs(box[n] / rigid[n] - 1.0) for n in known))
    assert errors[0] < 0.02 and errors[1] < errors[0] / 50.0


def test_a_rigid_shaft_hands_the_load_on_and_takes_nothing():
    box = shift()
    assert box["vehicle_speed"] == box["output_speed"] > 0.0
    assert box["shaft_torque"] == box["resistance_torque"] > 0.0
    assert box["shaft_twist"] == box["shaft_heat"] == box["shaft_energy"] == 0.0


def test_the_vehicle_meets_the_load():
    box = shift(**SHAFT)
    assert box["vehicle_speed"] != box["output_speed"]
    load = 250.0 * (box["vehicle_speed"] / 100.0) ** 2
    assert box["resistance_torque"] == pytest.approx(load, rel=1e-13)


def test_a_winding_shaft_breaks_a_stuck_clutch_away_and_lets_it_lock_again():
    """The twist swings the torque in the locked clutch above its capacity and back, each period."""
    box = Gearbox(
        **FREE | SHAFT | {"shaft_damping": 0.0},
        drum_inertia=0.0,
        initial_engine_speed=100.0,
        initial_drum_speed=100.0,
        initial_twist=0.15,
    )
    for _ in range(4000):
        assert box.step(1e-3, clutch=75.0) == 0
    assert box["events"] >= 4.0
    assert box["clutch_heat"] > 0.0
    assert abs(box["energy_residual"]) < 1e-6 * box["clutch_heat"]
    # It ends where the swing needs no more than the clutch holds.
    share = 0.25 / (0.25 + 0.4) * 2.2 / 3.2
    assert abs(box["shaft_torque"]) * share < 75.0 and box["clutch_locked"] == 1.0


def test_events_on_the_shaft_do_not_depend_on_the_communication_step():
    ends = []
    for n in (40, 400):
        box = Gearbox(
            **FREE | SHAFT,
            drum_inertia=0.01,
            initial_engine_speed=101.0,
            initial_drum_speed=100.0,
            initial_twist=0.15,
        )
        for _ in range(n):
            assert box.step(0.4 / n, clutch=60.0) == 0
        ends.append([box[name] for name in ("lock_time", "events", "shaft_twist", "clutch_heat")])
    assert ends[0] == pytest.approx(ends[1], rel=1e-8) and ends[0][1] >= 2.0
