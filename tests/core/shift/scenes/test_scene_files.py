"""Scene files: what is taken of them."""

import math
import re
import tomllib
from dataclasses import fields

import numpy as np
import pytest
from scene_runs import changed

from tests.needed import package
from thrustwasher import ParameterError
from thrustwasher.shift import builtin_scenes, load_scene
from thrustwasher.shift.scene.polyline import few_points
from thrustwasher.shift.scene.variation import scene_text, varied_scene
from thrustwasher.transmission.parameters import POINTS, profile_points


@pytest.mark.parametrize("name", builtin_scenes())
def test_every_builtin_scene_loads_and_explains_itself(name):
    scene = load_scene(name)
    assert scene.name == name and scene.title and len(scene.description) > 20
    assert {"transmission", "clutch", "brake"} <= set(scene.parts)
    parameters = scene.parts["clutch"].parameters()
    known = [f.name for f in fields(scene.parts["clutch"].params)]
    assert list(parameters) == [*known, "fidelity"]


def test_units_and_a_base_are_understood(tmp_path):
    text = """oil_temperature = "90 degC"
[clutch]
roughness = "10 um"
faces = 6
film_dynamics = false"""
    scene = changed(tmp_path, text, "planetary-sun")
    assert scene.name == "mine" and scene.oil_temperature == pytest.approx(363.15)
    assert scene.parts["transmission"].params.oil_temperature == scene.oil_temperature
    clutch = scene.parts["clutch"].params
    assert clutch.roughness == pytest.approx(1e-5, rel=1e-15)
    assert (clutch.faces, clutch.film_dynamics) == (6, False)
    assert scene.parts["transmission"].params.helix_angle == math.radians(20.0)


def test_the_command_is_a_ramp():
    scene = load_scene("planetary-sun")
    assert [scene.command(t) for t in (0.0, 0.1, 0.4, 9.0)] == [0.0, 0.0, 1.0, 1.0]
    assert scene.command(0.25) == pytest.approx(0.5)


def test_the_command_may_run_the_other_way(tmp_path):
    scene = changed(tmp_path, "[shift]\nfrom = 1\nto = 0.5", "planetary-sun")
    assert [scene.command(t) for t in (0.0, 0.25, 9.0)] == [1.0, 0.75, 0.5]
    assert (scene.engaging, scene.releasing) == ("brake", "clutch")
    upshift = load_scene("planetary-sun")
    assert upshift.engaging == "clutch" and not upshift.alone
    assert load_scene("brake-test").alone


# Profiles of a scene in files: numbers as recorded, what is simplified said, errors by line.

CORNERS = np.array([[0.1, 0], [0.11, 0.4], [0.2, 0.4], [0.4, 3.4], [0.8, 3.6], [0.97, 7.2]])
HEAD = 'base = "planetary"\n'
CLUTCH = '[pressure.clutch]\npoints = "trace.csv"\ncolumns = { pressure = "P_K1" }\n'
SHORT = "time [ms],P_K1 [bar],engine_torque [N.m]\n100,0.0,250\n200,0.5,240\n900,7.25,250\n"


def trace(n=1300, noise=0.01):
    """Return the text of a logger's file: pressure of the clutch and engine torque over time."""
    time = np.linspace(-0.1, 2.5, n)
    pressure = np.interp(time, *CORNERS.T) + noise * np.random.default_rng(1).standard_normal(n)
    torque = np.interp(time, [0.42, 0.46, 0.79, 0.83], [253.0, 188.0, 188.0, 250.0])
    rows = (
        f"{1e3 * t:.2f};{p:.4f};{x:.3f}" for t, p, x in zip(time, pressure, torque, strict=True)
    )
    text = "\n".join(["time;P_K1;engine_torque", "ms;bar;N.m", *rows])
    return text.replace(".", ",").replace("N,m", "N.m") + "\n"


def scene(folder, text=CLUTCH, data=None):
    """Write a scene and its file; return the scene's path."""
    (folder / "trace.csv").write_text(trace() if data is None else data, "utf-8")
    (folder / "mine.toml").write_text(HEAD + text, "utf-8")
    return str(folder / "mine.toml")


def points(found, name="clutch_pressure"):
    return np.array(profile_points(found.parts["transmission"].params, name))


def test_a_short_file_is_taken_to_the_bit(tmp_path):
    found = load_scene(scene(tmp_path, CLUTCH, SHORT))
    np.testing.assert_array_equal(points(found), [[0.1, 0.0], [0.2, 5e4], [0.9, 7.25e5]])
    assert "[pressure.clutch]: 3 rows of trace.csv" in found.notes


def test_a_long_recording_becomes_the_corners_it_has_and_the_rest_is_said(tmp_path):
    found = load_scene(scene(tmp_path, CLUTCH + '[engine]\npoints = "trace.csv"\n'))
    clutch = points(found)
    assert len(clutch) <= POINTS
    time = np.linspace(0.0, 1.3, 400)
    exact = 1e5 * np.interp(time, *CORNERS.T)
    assert np.abs(np.interp(time, *clutch.T) - exact).max() < 4e3
    note = next(text for text in found.notes if text.startswith("[pressure.clutch]"))
    assert "1300 rows of trace.csv, simplified, off by" in note and "0.14 % of their span" in note
    assert any(text.startswith("[engine]: 1300 rows") for text in found.notes)
    assert not any("trace.csv" in text for text in found.warnings)


def test_files_lie_beside_their_scene_wherever_it_is_called_from(tmp_path, monkeypatch):
    path = scene(tmp_path, CLUTCH, SHORT)
    (tmp_path / "inner").mkdir()
    upper = tmp_path / "inner" / "upper.toml"
    upper.write_text('base = "../mine.toml"\ntitle = "above"\n', "utf-8")
    monkeypatch.chdir(tmp_path / "inner")
    np.testing.assert_array_equal(points(load_scene(str(upper))), points(load_scene(path)))


def test_numbers_of_a_scene_replace_the_file_of_its_base(tmp_path):
    scene(tmp_path, CLUTCH, SHORT)
    upper = tmp_path / "upper.toml"
    upper.write_text('base = "mine.toml"\n[pressure.clutch]\npoints = [[0.1, 0], [0.9, 7e5]]\n')
    found = load_scene(str(upper))
    assert len(points(found)) == 2 and not any("trace.csv" in text for text in found.notes)


def test_what_is_made_of_a_scene_carries_the_numbers(tmp_path):
    """A varied scene, its text and the tables that processes and pages get need no file."""
    found = load_scene(scene(tmp_path, CLUTCH, SHORT))
    values = {"pressure.clutch.points.1": 6e4}
    text = scene_text(found, values)
    whole = found.table
    (tmp_path / "trace.csv").unlink()
    changed = varied_scene(found, values)
    assert points(changed)[1, 1] == 6e4 and points(found)[1, 1] == 5e4
    assert tomllib.loads(text)["pressure"]["clutch"]["points"][1] == [0.2, 6e4]
    assert whole["pressure"]["clutch"]["points"][2] == [0.9, 7.25e5]
    assert whole["pressure"]["clutch"]["points_from"]["file"] == "trace.csv"


def test_a_profile_that_few_points_cannot_follow_is_doubted(tmp_path):
    time = np.linspace(0.0, 1.2, 600)
    shaking = 3.0 + 2.0 * np.sin(60.0 * time)
    rows = (f"{t:.4f},{p:.4f}" for t, p in zip(time, shaking, strict=True))
    data = "\n".join(["time,P_K1 [bar]", *rows])
    found = load_scene(scene(tmp_path, CLUTCH, data))
    assert any("[pressure.clutch]: 600 rows of trace.csv, simplified" in w for w in found.warnings)


def test_road_load_over_speed_gives_rolling_and_drag(tmp_path):
    speed = np.linspace(10.0, 130.0, 25)
    force = 180.0 + 0.42 * (speed / 3.6) ** 2
    rows = (f"{v:.1f},{x:.4f}" for v, x in zip(speed, force, strict=True))
    data = "\n".join(["speed [km/h],force [N]", *rows])
    found = load_scene(scene(tmp_path, '[vehicle]\npoints = "trace.csv"\nmass = 1500.0\n', data))
    assert found.vehicle.rolling == pytest.approx(180.0 / (1500.0 * 9.80665), rel=1e-4)
    assert found.vehicle.drag_area == pytest.approx(2.0 * 0.42 / 1.2, rel=1e-4)
    assert any("25 rows of trace.csv, fitted, off by" in text for text in found.notes)


def test_a_sequence_takes_files_for_its_shift_down(tmp_path):
    down = '[sequence]\nshifts = [[0.0, "up"], [3.0, "down"]]\nwindow = 1.5\n'
    down += '[sequence.down]\nclutch = "down.csv"\nbrake = [[0.1, 0.0], [0.6, 7e5]]\n'
    down += "engine = [[0.0, 250.0]]\n"
    (tmp_path / "down.csv").write_text("time,pressure\n0,720000\n0.4,0\n", "utf-8")
    text = "stop_time = 6.0\n" + down
    found = load_scene(scene(tmp_path, text, SHORT))
    assert found.sequence.profiles["down"]["clutch_pressure_2"] == 0.0
    assert found.sequence.profiles["down"]["clutch_pressure_1"] == 720000.0


@pytest.mark.parametrize(
    ("text", "data", "words"),
    [
        (CLUTCH, "time,P_K1\n0,0\n0.1,x\n", "line 3: pressure = 'x'"),
        (CLUTCH, "time,P_K1\n0,0\n0.1,\n", "line 3: pressure is missing"),
        (CLUTCH, "time,P_K1\n0,0\n0.2,1\n0.1,2\n", "line 4: time falls"),
        (CLUTCH, "time,P_K1\n0,0\n0.2,-9\n0.3,20\n", "line 3: pressure = -9 Pa"),
        (CLUTCH, "time,P_K1 [K]\n0,0\n0.2,1\n", "unit of column pressure"),
        (CLUTCH, "time,P_B1\n0,0\n0.2,1\n", "there is no column 'P_K1'"),
        (CLUTCH, "time,P_K1\n7,0\n8,1\n", "allowed: times of the scene"),
        ('[engine]\npoints = "trace.csv"\n', "time,x\n0,1\n1,2\n", "column torque is missing"),
        ('[engine]\npoints = "none.csv"\n', SHORT, "none.csv"),
        ("[engine]\npoints = 3\n", SHORT, "pairs [time, torque] or a file"),
        ('[engine]\npoints = "trace.csv"\ncolumns = 3\n', SHORT, "columns = 3"),
        ('[engine]\npoints = [[0, 1.0]]\ncolumns = { a = "b" }\n', SHORT, "no 'columns' here"),
        ('[vehicle]\npoints = "trace.csv"\n', "speed,force\n5,1\n5,2\n", "one speed"),
        (
            '[engine]\npoints = "trace.csv"\n',
            "speed [rpm],torque\n1000,150\n4000,250\n",
            "column time is missing, torque over time is required, not over speed as a full-load",
        ),
        (
            '[vehicle]\npoints = "trace.csv"\n',
            "time,force\n0,100\n1,200\n",
            "column speed is missing, force over speed is required, not over time",
        ),
    ],
)
def test_a_file_that_cannot_be_used_is_refused_with_table_line_and_column(
    tmp_path, text, data, words
):
    with pytest.raises(ParameterError) as problem:
        load_scene(scene(tmp_path, text, data))
    assert words in str(problem.value) and "mine" in str(problem.value)
    assert len(str(problem.value).splitlines()) == 1


def test_what_a_measuring_file_marks_invalid_is_left_out_and_said(tmp_path):
    mdf = package("asammdf")
    time, path = np.linspace(0.0, 1.0, 41), scene(tmp_path, CLUTCH.replace("csv", "mf4"))
    marked = np.arange(41) % 10 == 3
    pressure = np.where(marked, 9e9, 7e5 * time)
    with mdf.MDF() as file:
        file.append(mdf.Signal(pressure, time, name="P_K1", unit="Pa", invalidation_bits=marked))
        file.save(tmp_path / "trace.mf4")
    found = load_scene(path)
    assert points(found)[:, 1].max() == pytest.approx(7e5, rel=1e-6)
    (note,) = [text for text in found.notes if text.startswith("[pressure.clutch]")]
    assert "37 rows of trace.mf4 (4 of 41 samples of pressure left out: invalid)" in note


def test_noise_is_averaged_not_followed():
    """Points of least squares lie nearer to the profile than its rows do."""
    time = np.linspace(0.0, 1.0, 4000)
    rows = np.interp(time, *CORNERS.T) + 0.1 * np.random.default_rng(2).standard_normal(4000)
    found = few_points(time, rows, 10)
    off = np.interp(time, found.time, found.value) - np.interp(time, *CORNERS.T)
    assert float(np.sqrt(np.mean(off**2))) < 0.02 and found.rms == pytest.approx(0.1, rel=0.05)


# What a scene file cannot mean is refused, what is hardly meant is a warning: one line each.

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
