"""What a scene file cannot mean is refused, what is hardly meant is a warning: one line each."""

import re

import pytest
from scene_runs import changed

from thrustwasher.errors import ParameterError
from thrustwasher.shift import builtin_scenes, load_scene

OIL = "[oil]\nviscosity = [[313.15, 0.03], [373.15, 0.005]]\n"
SEQUENCE = '[sequence]\nwindow = 1.3\nshifts = [[0.0, "up"], [6.0, "down"]]\n'

# Base, what is changed in it, the beginning of what is said after the place.
WRONG = [
    ("planetary-sun", "stop_tim = 2.0", "there is no 'stop_tim' here; did you mean 'stop_time'"),
    ("planetary-sun", "[clutch]\nfaces = 0", "[clutch]: faces = 0, allowed: 1 .. 100"),
    ("planetary-sun", "[clutch]\nfaces = 2.5", "[clutch]: faces = 2.5, allowed: 1 .. 100"),
    ("planetary-sun", "[clutch]\nroughness = true", "roughness = True, a number in m"),
    ("planetary-sun", '[clutch]\nroughness = "1 kg"', "roughness = '1 kg'"),
    ("planetary-sun", "[clutch]\ninner_radius = 0.2", "inner_radius = 0.2 m, allowed: below"),
    ("planetary-sun", '[clutch]\nfidelity = "best"', "fidelity = 'best', allowed: 'closed' or"),
    ("planetary-sun", '[clutch]\nfriction_law = "dry"', "friction_law = 'dry', allowed: 'wang'"),
    ("planetary-sun", '[transmission]\npreset = "paper"', "allowed: none"),
    ("planetary-sun", '[washer]\npreset = "peper"', "'peper', allowed: 'bronze' or 'paper'"),
    ("planetary-sun", "[transmission]\noil_temperature = 300", "oil_temperature cannot be set"),
    ("planetary-sun", "[transmission]\ntorque_age = 1", "torque_age cannot be set here"),
    ("planetary-sun", "[shift]\nduration = -1", "[shift]: duration = -1.0 s, allowed: 0 .."),
    ("planetary-sun", "[shift]\nto = 1.5", "[shift]: to = 1.5, allowed: 0 .. 1"),
    ("planetary-sun", "step = 0", "step = 0.0 s, allowed: 1e-06 .. 1 s"),
    ("planetary-sun", "stop_time = 0", "stop_time = 0.0 s, allowed: start_time + 1"),
    ("planetary-sun", "step = 1e-6\nstop_time = 9", "stop_time = 9.0 s, allowed: start_time"),
    ("planetary-sun", 'master = "euler"', "'euler', allowed: 'gauss-seidel' or 'jacobi'"),
    ("planetary-sun", 'master = "step-doubling"', "; there is no step-doubling any more"),
    ("planetary-sun", "master_tolerance = 1e-4", "master_tolerance: there is no step-doubling"),
    ("planetary-sun", "oil_temperature = 24", "oil_temperature = 24.0 K, allowed: 233.15"),
    ("planetary-sun", "title = 3", "title = 3, allowed: a text"),
    ("planetary-sun", "shift = 3", "shift = 3, allowed: a table [shift]"),
    ("planetary-sun", '[published]\nsource = "s"\nlock_tim = 1', "'lock_tim' here; did you mean"),
    ("planetary-sun", "[published]\nlock_time = 1", "source = None, allowed: a text"),
    ("planetary-sun", '[published]\nsource = "s"\nlock_time = "1 m"', "lock_time = '1 m'"),
    ("planetary-sun", "[transmission]\nsun_inertia = 1\ninput_inertia = 1", "another name of"),
    ("planetary", "[transmission]\nload_torque = 8.0", "load_torque = 8.0 together with a table"),
    ("planetary", "[transmission]\nengine_torque = 8.0", "together with [engine]"),
    ("planetary", "[transmission]\nengine_start_time = 0.2", "together with [engine]"),
    ("planetary", "[transmission]\nclutch_force = 900.0", "together with [pressure]"),
    ("planetary", "[transmission]\nsun_inertia = 0.2", "input_inertia = 0.2 together with a table"),
    ("planetary", "[transmission]\nsun_bearing_coefficient = 0.01", "allowed: one of them"),
    ("planetary", "[pressure.clutch]\npoints = [0.2, 1.0]", "pairs [time, pressure]"),
    ("planetary", "[pressure.drum]\npoints = []", "there is no 'drum' here"),
    ("planetary", '[sun_bearing]\nbetween = ["sun", "housing"]', "sun, carrier, ring, case"),
    ("planetary", '[sun_bearing]\nbetween = ["sun", "sun"]', "two different shafts"),
    ("planetary", '[ring_bearing]\nbetween = "ring"', "two different shafts"),
    ("planetary", "[ring_bearing]\nradius = 0.03", "mean_radius"),
    ("planetary", "[ring_bearing]\ncoefficient = 2.0", "ring_bearing_coefficient"),
    ("planetary", "[transmission]\nsun_teeth = 72\nplanet_teeth = 1\nplanets = 1", "from 5"),
    ("planetary", "[sump]\ninitial_temperature = 290", "initial_temperature cannot be set"),
    ("planetary", "[oil]\nviscosity = [[313, 0.03], [373, 0.04]]", "0.04 Pa.s at 99.85 degC"),
    ("planetary", "[oil]\nviscosity = [[313.15, 0.03]]", "[oil]: viscosity: 1 points, allowed"),
    ("planetary", "[oil]\nviscosity = [[300, 0.06], [340, 0.05], [380, 0.001]]", "more slowly"),
    ("planetary", "[oil]\nviscosity = 3", "[oil]: viscosity = 3, allowed: pairs"),
    ("planetary", f"{OIL}kinematic_viscosity = [[313, 3e-5], [373, 5e-6]]", "together with"),
    ("planetary", "[oil]\nviscositi = 3", "did you mean 'viscosity'"),
    ("planetary", "[oil]\ndensity = 8.5", "density = 8.5 kg/m3, allowed: 500 .. 1500"),
    ("duty-cycle", '[sequence]\nwindow = "0.7 s"', "window = 0.7 s, allowed: from 0.977 s"),
    ("duty-cycle", "[sequence]\nwindow = 0.0", "window = 0.0 s, allowed"),
    ("duty-cycle", "[sequence]\nshifts = []", "allowed: pairs"),
    ("duty-cycle", '[sequence]\nshifts = [[0.0, "side"]]', "allowed: pairs"),
    ("duty-cycle", '[sequence]\nshifts = [[0, "up"], [6, "up"]]', "'up' at 6 s after 'up' at 0 s"),
    ("duty-cycle", '[sequence]\nshifts = [[6, "up"], [0, "down"]]', "a shift at 0 s, allowed"),
    ("duty-cycle", '[sequence]\nshifts = [[0, "up"], [1, "down"]]', "a shift at 1 s, allowed"),
    ("duty-cycle", '[sequence]\nrepeat = 1\nshifts = [[9e3, "up"]]', "a shift at 9000 s, allowed"),
    ("duty-cycle", "[sequence.up]", "there is no 'up' here"),
    ("planetary", f"stop_time = 9\n{SEQUENCE}", "[sequence.down] is missing"),
    ("planetary", "[transmission]\nplanets = 14", "allowed: so many that their tips do not meet"),
    (
        "planetary",
        "[pressure.clutch]\npoints = [[0.2, 0.0], [0.1, 1e5]]",
        "time_2 = 0.1 s, allowed",
    ),
    ("planetary", "[pressure.clutch]\npoints = [[0.2, -1.0]]", "pressure_1 = -1.0 Pa, allowed: 0"),
    (
        "planetary",
        "[shift]\nstart = 0.1",
        "[shift] together with [pressure], allowed: a ramp or profiles",
    ),
    (
        "planetary",
        "[transmission]\ncarrier_inertia = 8.0",
        "carrier_inertia = 8.0 together with a table",
    ),
    ("planetary", '[clutch]\ngroove_width = "30 mm"', "groove_width = 0.03 m, allowed: below"),
    ("planetary", '[transmission]\nhelix_angle = "45.5 deg"', "rad, allowed: 0 .. 0.785398 rad"),
    ("planetary", '[mesh]\nhelix_angle = "45.5 deg"', "rad, allowed: 0 .. 0.785398 rad"),
    ("planetary", "[mesh]\naddendum = 0.3\nhelix_angle = 0", "allowed: 1 and more"),
]


@pytest.mark.parametrize(("base", "text", "words"), WRONG)
def test_what_cannot_be_is_refused_in_one_line(tmp_path, base, text, words):
    with pytest.raises(ParameterError, match=re.escape(words)) as refused:
        changed(tmp_path, text, base)
    assert "\n" not in str(refused.value) and "mine" in str(refused.value)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("planetry", "scene = 'planetry', allowed: .* did you mean 'planetary'"),
        ("planetary-slow", r"'planetary-slow' is gone: .* \[shift\] duration = \"0.5 s\""),
        ("nowhere.toml", r"scene = 'nowhere.toml': cannot be read \(No such file"),
        ("", "scene = '', allowed: brake-test, "),
    ],
)
def test_a_missing_scene_is_named(name, message):
    with pytest.raises(ParameterError, match=message):
        load_scene(name)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"stop_time = = 1", "not valid TOML"),
        (b"\xff\xfe\x00", "cannot be read"),
        (b"stop_time = 1.0", "'transmission' is missing"),
        (b'base = "loop.toml"', "go round in a circle"),
        (b"base = 3", "base = 3, allowed: a scene's name"),
    ],
)
def test_a_broken_file_is_named(tmp_path, content, message):
    path = tmp_path / "loop.toml"
    path.write_bytes(content)
    with pytest.raises(ParameterError, match=message):
        load_scene(path)


@pytest.mark.parametrize("name", builtin_scenes())
def test_built_in_scenes_are_in_no_doubt(name):
    assert load_scene(name).warnings == ()


LARGE = "[washer]\ninner_radius = 0.006\ngear_inner_radius = 0.009\nouter_radius = 0.014"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[transmission]\nwashers = 6", "washers = 6 with planets = 4"),
        ("[transmission]\nwasher_radius = 0.02", "washer_radius = 0.02 m"),
        ("[transmission]\nhelix_angle = 0.0", "has no effect: read by helix_angle > 0 only"),
        ("[transmission]\nhelix_angle = 0.0", "[mesh] helix_angle = 0.349066 rad, but"),
        ('[sun_bearing]\nbetween = ["ring", "case"]', "not at the sun"),
        ("stop_time = 0.9", "cut off"),
        ("[mesh]\npinion_teeth = 20", "[mesh] pinion_teeth = 20, gear_ratio = 2.11111 (42.22"),
        ("[ring_mesh]\ngear_ratio = 4.0", "[ring_mesh] pinion_teeth = 18, gear_ratio = 4"),
        ("[ring_mesh]\ninternal = false\naddendum_gear = 1.0", "[ring_mesh] internal = False"),
        ('[mesh]\nnormal_module = "1.6 mm"', "[mesh] centre distance = 0.0476"),
        ('[mesh]\nhelix_angle = "10 deg"', "[mesh] centre distance"),
        ("[mesh]\nload_share = 0.5", "[mesh] load_share = 0.5 has no effect"),
        ('[mesh]\nmean_roughness = "2 um"', "[mesh] mean_roughness = 2e-06 m against"),
        (LARGE, "root radius"),
    ],
)
def test_what_is_doubtful_is_a_warning(tmp_path, text, words):
    found = changed(tmp_path, text).warnings
    assert any(words in line for line in found) and not any("\n" in line for line in found), found
