"""Profiles of a scene in files: numbers as recorded, what is simplified said, errors by line."""

import tomllib

import numpy as np
import pytest

from tests.needed import package
from thrustwasher import ParameterError, load_scene
from thrustwasher.shift.scene.polyline import few_points
from thrustwasher.shift.scene.variation import scene_text, varied_scene
from thrustwasher.transmission.parameters import POINTS, profile_points

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
