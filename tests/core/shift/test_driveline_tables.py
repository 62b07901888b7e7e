"""Engine, vehicle and profiles of pressure in a scene file."""

import pytest
from scene_runs import changed

from thrustwasher.shift import load_scene
from thrustwasher.transmission.parameters import profile_points
from thrustwasher.transmission.vehicle import Vehicle

CAR = {"mass": 1650.0, "wheel_radius": 0.32, "final_drive": 3.2, "wheel_inertia": 4.8}


def test_a_vehicle_gives_inertia_and_load():
    car = Vehicle(**CAR, rolling=0.011, drag_area=0.68)
    assert car.inertia == pytest.approx(16.96875, rel=1e-12)
    given = car.driveline(elastic=False)
    assert given["carrier_inertia"] == car.inertia and "vehicle_inertia" not in given
    assert given["rolling_torque"] == pytest.approx(0.011 * 1650 * 9.80665 * 0.1, rel=1e-12)
    speed = 238.0 * 0.1  # m/s at 238 rad/s of the output
    torque = given["load_torque"] * (238.0 / given["load_speed"]) ** 2
    assert torque == pytest.approx(0.6 * 0.68 * speed**2 * 0.1, rel=1e-12)
    uphill = Vehicle(**CAR, rolling=0.0, grade=0.75).driveline(elastic=True)
    assert uphill["grade_torque"] == pytest.approx(1650 * 9.80665 * 0.6 * 0.1, rel=1e-12)
    assert uphill["vehicle_inertia"] == car.inertia


def test_the_ring_driven_scene_is_read():
    scene = load_scene("planetary")
    gearbox = scene.parts["transmission"].params
    assert gearbox.ratio == pytest.approx(38.0 / 74.0) and gearbox.actuation == "pressure"
    assert gearbox.carrier_inertia == pytest.approx(16.96875)
    assert profile_points(gearbox, "clutch_pressure")[1] == (0.11, 4e4)
    assert profile_points(gearbox, "engine_torque")[-1] == (1.08, 253.0)
    assert (scene.engaging, scene.shift_start, scene.kiss_end) == ("clutch", 0.1, 0.2)
    assert not scene.alone


def test_a_boost_before_the_kiss_point_does_not_end_it(tmp_path):
    boost = (
        "points = [[0.1, 0], [0.105, 3e5], [0.14, 3e5], [0.145, 4e4], [0.21, 4e4], [0.4, 3.2e5]]"
    )
    assert changed(tmp_path, f"[pressure.clutch]\n{boost}").kiss_end == 0.21


def test_a_downshift_presses_the_brake(tmp_path):
    text = """
[pressure.clutch]
points = [[0.1, 7e5], [0.3, 0.0]]
[pressure.brake]
points = [[0.12, 0.0], [0.2, 5e4], [0.5, 7e5]]
"""
    scene = changed(tmp_path, text)
    assert (scene.engaging, scene.shift_start, scene.kiss_end) == ("brake", 0.12, 0.2)


def test_an_inertia_answers_to_both_names_in_a_scene(tmp_path):
    scene = changed(tmp_path, "[transmission]\nsun_inertia = 0.3", "planetary-sun")
    assert scene.parts["transmission"].params.input_inertia == 0.3
