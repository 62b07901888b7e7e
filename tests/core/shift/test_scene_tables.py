"""Engine, vehicle and profiles of pressure in a scene file."""

import math

import numpy as np
import pytest
from scene_runs import changed, instances, real_shift, shift, slow_without_jit, with_all_parts

from thrustwasher.errors import ParameterError
from thrustwasher.model.oil_laws import roelands, vogel
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.run import remarks
from thrustwasher.shift.steady_points import efficiency_map
from thrustwasher.transmission.parameters import profile_points
from thrustwasher.transmission.vehicle import Vehicle
from thrustwasher.tribology.viscosity import viscosity

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


# The tables [sun_bearing] and [ring_bearing], and the bearings' place in the balance.


def test_a_table_is_a_needle_bearing_unless_it_says_otherwise(tmp_path):
    given = '[sun_bearing]\n[ring_bearing]\nbetween = ["carrier", "case"]\nmean_radius = "40 mm"'
    p = changed(tmp_path, given, "planetary-sun").parts["transmission"].params
    assert (p.sun_bearing_shaft_1, p.sun_bearing_shaft_2) == ("sun", "carrier")
    assert (p.ring_bearing_shaft_1, p.ring_bearing_shaft_2) == ("carrier", "case")
    assert p.sun_bearing_coefficient == p.ring_bearing_coefficient == 0.004
    assert p.ring_bearing_mean_radius == 0.04


def test_bearings_are_in_the_book_which_closes():
    run = real_shift("planetary")
    loss = run.figures["bearing_loss"]
    assert loss == run.energy["bearings"] == run.signals["transmission.bearing_heat"][-1]
    assert 60.0 < loss < 100.0 and 80.0 < run.figures["peak_bearing_power"] < 130.0
    assert run.energy["residual_share"] < 1e-12
    assert not any("rests on no bearing" in line for line in run.messages)


def test_a_thrust_without_a_bearing_is_said():
    run = shift("planetary-sun", stop_time=0.02, parts={"mesh": None, "washer": None})
    assert "bearing_loss" not in run.figures and run.energy["bearings"] == 0.0
    for words in ("the sun's and the ring's thrust", "gear mesh", "without drag"):
        assert any(words in line for line in run.messages)
    assert not any("thrust" in line for line in shift("msl", stop_time=0.02).messages)


# One oil for all parts of a scene: its viscosity at two or three temperatures, and the rest.

FLUID = ((297.15, 60.8e-3), (313.15, 31.4e-3), (373.15, 5.99e-3))


def test_both_laws_go_through_three_points():
    scale, constant, exponent = roelands(FLUID)
    factor, b, c = vogel(FLUID)
    for t, thick in FLUID:
        assert viscosity(t, scale, constant, exponent)[0] == pytest.approx(thick, rel=1e-12)
        assert factor * math.exp(b / (t - 273.15 + c)) == pytest.approx(thick, rel=1e-12)
    # The fluid of Jackson & Green has 9.37 mPa s at 80 degC.
    assert viscosity(353.15, scale, constant, exponent)[0] == pytest.approx(9.37e-3, rel=2e-3)


def test_every_part_has_the_scenes_oil(tmp_path):
    scene = changed(tmp_path, "[sump]\n")
    washer, mesh = scene.parts["washer"].params, scene.parts["ring_mesh"].params
    for part in ("clutch", "brake"):
        assert scene.parts[part].params.viscosity_scale == washer.viscosity_scale
    for name in ("clutch", "brake", "washer", "mesh", "ring_mesh", "sump"):
        assert scene.parts[name].params.oil_heat_capacity == 2050.0
    assert scene.parts["transmission"].params.oil_density == 850.0
    assert mesh.pressure_viscosity == 1.7e-8
    for t in (313.15, 358.15):
        thick = mesh.viscosity_scale * math.exp(mesh.viscosity_b / (t - 273.15 + mesh.viscosity_c))
        law = (washer.viscosity_scale, washer.viscosity_constant, washer.viscosity_exponent)
        assert thick == pytest.approx(viscosity(t, *law)[0], rel=2e-3)
    assert scene.notes == ()


def test_a_parts_own_oil_overrides_and_is_said(tmp_path):
    scene = changed(tmp_path, "[mesh]\noil_density = 900.0")
    assert scene.parts["mesh"].params.oil_density == 900.0
    assert scene.parts["ring_mesh"].params.oil_density == 850.0
    assert remarks(scene) == ["mesh: oil_density of its own, not of the scene's oil"]


@pytest.mark.parametrize("base", ["planetary-sun", "planetary"])  # without and with an oil
def test_an_oil_is_known_by_its_kinematic_viscosity_too(tmp_path, base):
    found = []
    for key, unit, factor in (("viscosity", "mPa.s", 0.8), ("kinematic_viscosity", "cSt", 1.0)):
        points = f"[[313.15, '{40 * factor} {unit}'], [373.15, '{7 * factor} {unit}']]"
        scene = changed(tmp_path, f"[oil]\ndensity = 800.0\n{key} = {points}", base)
        found.append(scene.parts["clutch"].params.viscosity_scale)
    assert found[0] == pytest.approx(found[1], rel=1e-9)


# Oil pump, churning, bearings and seals in a scene: wired, in the balance, or left out.

BARE = "stop_time = 0.9\n"
NO_WASHERS = "[transmission]\nwashers = 0\n"
NOTHING = """[losses]
pump_displacement = 0.0
input_bearing_count = 0
output_bearing_count = 0
drum_bearing_count = 0
planet_viscous_factor = 0.0
planet_load_factor = 0.0
output_immersion = 0.0
input_seal_diameter = 0.0
output_seal_diameter = 0.0
"""


def run(tmp_path, text, base="planetary"):
    scene = changed(tmp_path, text, base)
    return cosimulate(scene, instances(scene))


@slow_without_jit
def test_without_losses_all_is_as_with_none_to_lose(tmp_path):
    out = run(tmp_path, f"losses = false\n{BARE}{NO_WASHERS}")
    none = run(tmp_path, f"{BARE}{NO_WASHERS}{NOTHING}")
    assert "losses" not in out.scene.parts and "losses" in none.scene.parts
    for name, series in out.signals.items():
        assert np.array_equal(series, none.signals[name], equal_nan=True), name
    assert out.energy == none.energy and "pump_loss" not in out.figures


def test_the_heat_of_the_book_is_divided_by_source():
    r = real_shift("planetary")
    parts = [r.figures[f"{n}_loss"] for n in ("pump", "churning", "rolling", "seal")]
    assert sum(parts) == pytest.approx(r.figures["loss_heat"], rel=1e-12)
    assert min(parts) > 50.0 and parts[0] == max(parts)
    sent = np.sum(r.signals["losses.oil_heat"][1:] * np.diff(r.time))
    assert r.figures["loss_heat"] == pytest.approx(sent, rel=5e-3)
    assert r.energy["residual_share"] < 1e-12


@slow_without_jit
def test_any_scene_can_have_losses_and_its_planets_count(tmp_path):
    r = run(tmp_path, "stop_time = 0.05\n[losses]\n", "planetary-sun")
    losses = r.scene.parts["losses"].params
    assert losses.planets == r.scene.parts["transmission"].params.planets
    s = r.signals
    assert (s["losses.planet_speed"][1:] == s["transmission.mesh_speed"][:-1]).all()
    assert r.figures["loss_heat"] > 10.0


def test_losses_are_a_table_or_false(tmp_path):
    with pytest.raises(
        ParameterError, match=r"losses = True, allowed: a table \[losses\] or false"
    ):
        changed(tmp_path, "losses = true\n")
    assert "losses" not in load_scene("planetary-sun").parts


# A sump in a shift: the parts' oil has its temperature, and it gets their heat.


def test_the_oil_of_all_parts_is_the_sumps_and_every_washer_heats_it(tmp_path):
    text = "stop_time = 0.02\n[sump]\nvolume = 1e-4\nhousing_capacity = 0.0\nconductance = 0.0"
    s = cosimulate(*with_all_parts(changed(tmp_path, text))).signals
    oil = s["sump.temperature"]
    assert oil[0] == 358.15 and oil[-1] > oil[0]
    for part in ("clutch", "brake", "washer", "mesh", "ring_mesh", "losses"):
        assert (s[f"{part}.oil_temperature"][1:] == oil[:-1]).all()
    received = np.sum(8.0 * s["sump.heat_3"][1:]) * 1e-3
    factors = {1: 1.0, 2: 1.0, 4: 4.0, 5: 4.0, 6: 1.0, 7: 1.0}
    others = sum(f * np.sum(s[f"sump.heat_{i}"][1:]) * 1e-3 for i, f in factors.items())
    assert s["sump.received_heat"][-1] == pytest.approx(received + others, rel=1e-12)
    for port, power in ((6, "bearing_power"), (7, "loss_power")):
        assert (s[f"sump.heat_{port}"][1:] == s[f"transmission.{power}"][1:]).all()
    assert received > 0.0 and (s["sump.heat_3"][1:] == s["washer.oil_heat"][1:]).all()


def test_work_is_motion_load_heat_in_the_parts_and_heat_in_the_sump(tmp_path):
    """Driveline and parts count heat each over their own step: that difference is known."""
    r = cosimulate(*with_all_parts(changed(tmp_path, "stop_time = 0.5\n[sump]")))
    s, h, book = r.signals, np.diff(r.time), r.energy
    count = {"clutch": 1, "brake": 1, "washer": 8, "mesh": 4, "ring_mesh": 4}
    made = sum(n * s[f"{p}.energy"][-1] for p, n in count.items() if f"{p}.energy" in s)
    rest = [p for p in count if f"{p}.energy" not in s]
    made += sum(count[p] * np.sum(s[f"{p}.friction_power"][1:] * h) for p in rest)
    stored = sum(n * s[f"{p}.stored_heat"][-1] for p, n in count.items())
    coupling = sum(book[name] for name in ("clutch", "brake", "washers", "meshes")) - made
    sump = sum(s[f"sump.{name}"][-1] for name in ("stored_heat", "ambient_heat", "cooler_heat"))
    work = book["engine_work"]
    left = work - book["load_work"] - book["kinetic"] - stored - sump - coupling
    assert abs(left) < 1e-12 * work and abs(coupling) < 1e-5 * work


# The mesh of the default scene is that of its teeth: sun and planet in the transverse section.

HELIX = math.radians(20.0)
TRANSVERSE = 1.5e-3 / math.cos(HELIX)  # module


def test_the_mesh_is_the_transverse_section_of_the_teeth():
    """20 degrees and one normal module, both in the normal section of the tooth."""
    scene = load_scene("planetary-sun")
    gearbox, mesh = scene.parts["transmission"].params, scene.parts["mesh"].params
    assert (gearbox.normal_module, gearbox.helix_angle) == (1.5e-3, pytest.approx(HELIX))
    distance = 0.5 * TRANSVERSE * (gearbox.sun_teeth + gearbox.planet_teeth)
    assert mesh.centre_distance == pytest.approx(distance, abs=0.5e-6)
    angle = math.atan(math.tan(math.radians(20.0)) / math.cos(HELIX))
    assert mesh.pressure_angle == pytest.approx(angle, abs=math.radians(5e-4))
    assert mesh.addendum == pytest.approx(1.5e-3 / TRANSVERSE, abs=5e-5)


def test_a_set_whose_planets_are_larger_than_the_sun_runs(tmp_path):
    """24/30/84 teeth, first gear with the ring driven; the planet's teeth bend both ways."""
    path = tmp_path / "large.toml"
    path.write_text(
        'base = "planetary"\n[transmission]\nsun_teeth = 24\nplanet_teeth = 30\n'
        "ring_teeth = 84\nplanets = 3\n[mesh]\ngear_ratio = 0.8\npinion_teeth = 30\n"
        "[ring_mesh]\ngear_ratio = 2.8\npinion_teeth = 30\n"
    )
    scene = load_scene(path)
    mesh = scene.parts["mesh"].params
    assert (mesh.reversed_bending, mesh.mates_pinion, mesh.mates_gear) == (0.7, 2, 3)
    assert not any("teeth" in line for line in scene.warnings)
    found = efficiency_map(scene, [247.0], [209.44], gear="first").columns
    assert 0.96 < found["efficiency"][0] < 0.99 and 50.0 < found["mesh_loss"][0] < 200.0
