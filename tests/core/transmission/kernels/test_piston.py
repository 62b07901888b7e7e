"""Pistons: profiles of pressure, filling, lag and centrifugal head, exact inside a step."""

import math

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.transmission.parameters import TransmissionParams, profile_fields

from test_transmission_step import Gearbox  # isort: skip
from kernel_part import Part

from thrustwasher.transmission.parameters import SPEC

AREA, SPRING = 8e-3, 3e4
CLUTCH = ((0.1, 0.0), (0.11, 4e4), (0.2, 4e4), (0.4, 3.2e5))
BRAKE = ((0.0, 7.6e5), (0.2, 7.6e5), (0.4, 0.0))


def pressed(**more):
    return Gearbox(
        actuation="pressure",
        load_torque=0.0,
        **(
            profile_fields("clutch_pressure", CLUTCH)
            | profile_fields("brake_pressure", BRAKE)
            | more
        ),
    )


def after(box, *durations):
    for dt in durations:
        assert box.step(dt, clutch=1.0, brake=1e4) == 0
    return box


def test_without_fill_and_lag_the_force_is_that_of_the_points():
    box = pressed()
    assert box.step(0.0, brake=1e4) == 0
    assert box["brake_load"] == (7.6e5 - SPRING) * AREA and box["clutch_load"] == 0.0
    after(box, 0.3)
    assert box["clutch_load"] == pytest.approx((1.8e5 - SPRING) * AREA, rel=1e-14)
    assert box["brake_load"] == pytest.approx((3.8e5 - SPRING) * AREA, rel=1e-14)
    assert box["clutch_filled_time"] == box["clutch_kiss_time"] == pytest.approx(0.1075, rel=1e-14)


@pytest.mark.parametrize("steps", [(0.3,), (0.07, 0.23), (0.003,) * 100, (0.1075, 0.1925)])
def test_events_do_not_depend_on_the_steps(steps):
    box = after(pressed(clutch_fill_volume=3e-6, clutch_pressure_lag=0.02), *steps)
    assert box["clutch_filled_time"] == pytest.approx(0.1375, rel=1e-12)  # 30 ms at 0.1 l/s
    # Meanwhile the lag would have brought it beyond the spring's pressure, where it waits.
    assert box["clutch_kiss_time"] == pytest.approx(0.1375, rel=1e-12)
    x, k, slope = math.exp(-0.0625 / 0.02), 0.1 / 0.02, 1.4e6
    start = 4e4 + (SPRING - 4e4) * x  # at 0.2 s; then behind a ramp for 0.1 s
    exact = 4e4 + slope * (0.1 - 0.02) + (start - 4e4 + slope * 0.02) * math.exp(-k)
    assert box["clutch_piston_pressure"] == pytest.approx(exact, rel=1e-12)
    assert box["clutch_load"] == pytest.approx((exact - SPRING) * AREA, rel=1e-12)


def test_nothing_presses_before_the_piston_is_full():
    box = after(pressed(clutch_fill_volume=3e-6), 0.13)
    assert box["clutch_load"] == box["clutch_filled"] == 0.0 and box["clutch_kiss_time"] == -1.0
    after(box, 0.01)
    assert box["clutch_filled"] == 1.0
    assert box["clutch_load"] == pytest.approx((4e4 - SPRING) * AREA, rel=1e-12)


def test_a_slow_pressure_kisses_after_the_piston_is_full():
    """Behind a constant command p = p_1 (1 - exp(-t/lag)): the spring is passed at lag ln(...)."""
    points = profile_fields("clutch_pressure", ((0.0, 0.0), (1e-9, 6e4)))
    box = after(pressed(**points, clutch_pressure_lag=0.05), 0.01, 0.2)
    assert box["clutch_kiss_time"] == pytest.approx(0.05 * math.log(2.0), rel=1e-6)
    assert box["clutch_filled_time"] < 1e-9


def test_a_pressed_piston_goes_back_when_the_pressure_has_fallen_to_the_springs():
    """Behind a command of 0 p = p_0 exp(-t/lag); what was let out has to be filled again."""
    points = ((0.0, 1.2e5), (0.1, 1.2e5), (0.1 + 1e-9, 0.0), (0.3, 0.0), (0.3 + 1e-9, 1.2e5))
    box = pressed(
        **profile_fields("brake_pressure", points), brake_pressure_lag=0.05, brake_fill_volume=1e-5
    )
    after(box, 0.15)
    assert box["brake_filled"] == 1.0
    assert box["brake_load"] == pytest.approx((1.2e5 / math.e - SPRING) * AREA, rel=1e-6)
    after(box, 0.1)  # at 0.1 + 0.05 ln 4 = 0.169 s it begins to empty
    assert box["brake_filled"] == box["brake_load"] == 0.0
    after(box, 0.2)
    away = 0.3 - 0.1 - 0.05 * math.log(4.0)
    assert box["brake_filled_time"] == pytest.approx(0.3 + min(away, 0.1), abs=1e-8)


def test_oil_that_turns_with_the_drum_presses_by_its_head():
    """Pressure rho w^2 (r^2 - r_s^2)/2, integrated over the piston's rings."""
    radii = {"piston_inner_radius": 0.04, "piston_outer_radius": 0.07, "piston_supply_radius": 0.03}
    n, force = 20000, 0.0
    for i in range(n):
        r = 0.04 + 0.03 * (i + 0.5) / n
        force += 0.5 * 850.0 * 200.0**2 * (r * r - 9e-4) * 2.0 * math.pi * r * 0.03 / n
    points = profile_fields("clutch_pressure", ((0.0, 1e5),))
    for share in (0.0, 0.9):
        box = pressed(**points, **radii, balance_share=share, initial_drum_speed=200.0)
        box.step(0.0)
        head = box["clutch_load"] - (1e5 - SPRING) * AREA
        assert head == pytest.approx(force * (1.0 - share), rel=1e-8)


def test_pressure_inputs_are_straight_over_a_step_and_stand_beside_the_points():
    box = Gearbox(actuation="pressure", clutch_fill_volume=2e-6)
    box.step(0.01, clutch_pressure=0.0)
    box.step(0.1, clutch_pressure=1e5)
    assert box["clutch_filled_time"] == pytest.approx(0.01 + 0.03 + 0.02, rel=1e-12)
    assert box["clutch_load"] == pytest.approx((1e5 - SPRING) * AREA, rel=1e-12)


def test_a_negative_pressure_is_refused_and_so_is_a_profile_without_points():
    for points, said in ((((0.1, -1.0),), "clutch_pressure_1"), ((), "0 points")):
        with pytest.raises(ParameterError, match=said):
            TransmissionParams(**profile_fields("clutch_pressure", points))
    assert Gearbox(actuation="pressure").step(0.01, clutch_pressure=-1.0) != 0


def test_the_engine_follows_its_points_inside_a_step():
    """Momentum is the integral of the torque, whatever the steps."""
    points = profile_fields("engine_torque", ((0.0, 100.0), (0.03, 40.0), (0.05, 0.0)))
    for steps in ((0.1,), (0.017,) * 6):
        box = Gearbox(load_torque=0.0, initial_engine_speed=0.0, washers=0, **points)
        for dt in steps:
            assert box.step(dt, brake=1e4) == 0
        gained = 0.03 * 70.0 + 0.02 * 20.0
        assert box["engine_speed"] == pytest.approx(gained / (0.25 + 8.0 / 3.2**2), rel=1e-12)


def test_torques_from_outside_stand_beside_the_set_s_own():
    box = Gearbox(load_torque=0.0, washers=0)
    box.step(0.0, brake=1e4, engine_torque_input=50.0, load_torque_input=64.0)
    inertia = 0.25 + 8.0 / 3.2**2
    assert box["drive_torque"] == 200.0 and box["resistance_torque"] == 64.0
    assert 3.2 * box["output_acceleration"] == pytest.approx((200.0 - 20.0) / inertia, rel=1e-12)
    assert box["output_torque"] == pytest.approx(64.0 + 8.0 * box["output_acceleration"])


def test_rolling_resistance_turns_its_sign_and_a_slope_does_not():
    for speed in (300.0, -300.0):
        box = Gearbox(
            load_torque=0.0, rolling_torque=20.0, grade_torque=5.0, initial_engine_speed=speed
        )
        box.step(0.0)
        assert box["resistance_torque"] == pytest.approx(math.copysign(20.0, speed) + 5.0, abs=1e-4)
    rest = Gearbox(load_torque=0.0, rolling_torque=20.0, initial_engine_speed=0.0)
    rest.step(0.0)
    assert rest["resistance_torque"] == 0.0


def test_both_absolute_speeds_of_a_pack_make_its_slip():
    box = Gearbox(initial_drum_speed=30.0)
    box.step(1e-3)
    for pack in ("clutch", "brake"):
        assert box[f"{pack}_hub_speed"] - box[f"{pack}_drum_speed"] == pytest.approx(
            box[f"{pack}_speed"], rel=1e-13
        )


# Steps much shorter than the last one: what changes in them vanishes with their length.

H = 1e-3
NAMES = [s.name for s in SPEC.inputs]
BEFORE = {"clutch_torque": 100.0, "brake_torque": 300.0, "mesh_torque": 0.1, "shift_command": 0.2}
AFTER = {"clutch_torque": 120.0, "brake_torque": 280.0, "mesh_torque": 0.2, "shift_command": 0.3}
FORCE = TransmissionParams().clutch_force
SHOWN = ("clutch_load", "brake_load", "mesh_load", "washer_load", "clutch_reaction")


def box(*steps, **params):
    """Return a transmission after steps of these lengths with the inputs before."""
    part = Part("transmission", "rigid", **params)
    for dt in steps:
        assert move(part, BEFORE, dt) == 0
    return part


def move(part, inputs, dt):
    return part.step([inputs.get(n, 0.0) for n in NAMES], dt)


def changes(part, *steps):
    """Return how the outputs change over steps with the inputs after."""
    start = [part[n] for n in SHOWN]
    for dt in steps:
        assert move(part, AFTER, dt) == 0
    return [part[n] - x for n, x in zip(SHOWN, start, strict=True)]


def test_a_change_of_inputs_arrives_in_proportion_to_a_short_step():
    long, short = (changes(box(H, H), h) for h in (1e-7, 1e-9))
    assert min(abs(x) for x in long) > 1e-3
    assert short == pytest.approx([1e-2 * x for x in long], rel=2e-3)


def test_two_halves_of_a_short_step_go_as_far_as_the_whole():
    """What a master compares that doubles its steps."""
    whole, halves = (
        changes(box(H, H, capacity_extrapolation=False), *steps)
        for steps in ((1e-7,), (5e-8, 5e-8))
    )
    assert halves == pytest.approx(whole, rel=2e-3)


@pytest.mark.parametrize("steps", [(H,), (1e-3 * H,), (2.0 * H,), (2e-4 * H,) * 5])
def test_a_change_of_inputs_has_arrived_after_a_thousandth_of_the_last_step(steps):
    part = box(H, H)
    changes(part, *steps)
    assert part["clutch_load"] == pytest.approx(0.3 * FORCE, rel=1e-12)


def test_without_a_step_an_output_follows_a_changed_input_at_once():
    part = box(H, H)
    changes(part, 1e-7)
    reached = part["clutch_load"]
    move(part, AFTER, 0.0)
    assert part["clutch_load"] == reached  # nothing was changed
    move(part, {**AFTER, "shift_command": 0.4}, 0.0)
    assert part["clutch_load"] == pytest.approx(0.4 * FORCE, rel=1e-15)


def test_a_tiny_last_step_does_not_carry_the_capacity_away():
    """A change of 0.1 N m in 1 ns goes on for 50 ns at most, over whatever step."""
    part = box(1e-9, 1e-9)
    move(part, BEFORE | {"clutch_torque": 100.1}, H)
    assert part["clutch_locked"] == 0.0
    assert part["clutch_reaction"] == pytest.approx(100.1 + 50 * 0.1, rel=1e-9)


def test_a_pack_answers_its_load_without_a_step_as_in_a_vanishing_one():
    """Command, force and capacity belong together after one exchange in this order."""
    inputs = [3000.0, 100.0, 320.0, 0.0]
    part = Part("clutch", "field")
    for _ in range(3):
        assert part.step(inputs, H) == 0
    before = part["torque_capacity"]
    loaded = [4000.0, *inputs[1:]]
    part.step(loaded, 0.0)
    now = part["torque_capacity"]
    part.step(loaded, 1e-12)
    assert part["torque_capacity"] == pytest.approx(now, rel=1e-9)
    assert now == pytest.approx(before, rel=1e-9) or now > before
