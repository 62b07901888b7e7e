"""The calibrate command on recordings over time: what is read, said, written and refused."""

import json
from pathlib import Path

import numpy as np
import pytest

from tests.needed import package
from thrustwasher import ClutchParams, calibrate_traces, engage_clutch, load_part
from thrustwasher.cli import main

EXAMPLES = Path(__file__).parents[3] / "examples"
TRACE = str(EXAMPLES / "ex17_engagement.csv")
TRUTH = {"friction_scale": 0.92, "permeability": 3e-13, "fill_time": 0.012, "kiss_pressure": 6e4}
AREA = ("--piston-area", "60 cm2")
HEAD = "time [ms], load [kN], speed [rpm], oil_temperature [degC], friction_torque [N.m]"


def write(path, head=HEAD, *, scale=0.92, load=5000.0, cut=slice(None)):
    """Write a recording of one engagement."""
    time = np.linspace(0.0, 0.5, 151)
    way = {"load": load * np.clip(time / 0.1, 0.0, 1.0), "speed": 300.0 * (1.0 - time / 0.5)}
    pack = ClutchParams(friction_scale=scale)
    torque = engage_clutch(pack, time=time, **way, oil_temperature=353.15).friction_torque
    columns = (1e3 * time, way["load"] / 1e3, way["speed"] * 30 / np.pi, 80.0 + 0 * time, torque)
    rows = [", ".join(f"{x:.9g}" for x in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([head, *rows[cut]]) + "\n", "utf-8")
    return str(path)


def run(capsys, *words):
    assert main(["calibrate", *words]) == 0
    return capsys.readouterr()


def refused(capsys, *words):
    assert main(["calibrate", *words]) == 2
    out, err = capsys.readouterr()
    assert out == "" and len(err.splitlines()) == 1
    return err


@pytest.mark.slow
def test_the_shipped_recording_tells_what_it_was_made_from(capsys):
    words = ("clutch", TRACE, *AREA, "--fit", ",".join(TRUTH))
    out, err = run(capsys, *words)
    record = json.loads(run(capsys, *words, "--json").out)
    assert err == "" and "2 engagements in 1 recording; 1100 rows" in out
    assert "Torque: of the faces (pack)." in out
    for estimate in record["estimates"]:
        low, high = estimate["interval"]
        assert low <= TRUTH[estimate["name"]] <= high and estimate["identifiable"]
    assert record["engagements"] == 2 and len(record["time"]) == len(record["computed"])
    last = out.splitlines()[-1]
    assert last.startswith("Use it: thrustwasher clutch --set friction_scale=")
    assert "fill_time" not in last  # a rig's, not the part's


def test_numbers_are_those_of_the_api(tmp_path, capsys):
    path = write(tmp_path / "a.csv")
    record = json.loads(run(capsys, "clutch", path, "--fit", "friction_scale", "--json").out)
    found = calibrate_traces("clutch", path, fit=["friction_scale"])
    assert record["fitted"]["friction_scale"] == found.params.friction_scale
    assert record["parameters"]["friction_scale"] == pytest.approx(0.92, rel=1e-5)


def test_several_files_are_fitted_at_once_into_a_part_with_a_picture(tmp_path, capsys):
    paths = [write(tmp_path / "a.csv"), write(tmp_path / "b.csv", load=2500.0)]
    part, picture = tmp_path / "mine.toml", tmp_path / "fit.png"
    words = ("--fit", "friction_scale", "--out", str(part), "--plot", str(picture))
    out, err = run(capsys, "clutch", *paths, *words)
    assert "2 engagements in 2 recordings" in out and "wrote" in err
    assert load_part(str(part)).params.friction_scale == pytest.approx(0.92, rel=1e-5)
    assert "calibrated on a.csv, b.csv" in part.read_text("utf-8")
    assert picture.stat().st_size > 10_000
    again = run(capsys, str(part), paths[0], "--fit", "friction_scale").out
    assert "friction_scale     0.92" in again


def test_slip_comes_out_where_the_inertia_is_given(tmp_path, capsys):
    """The slip of the recording falls evenly, as under a torque that grows with the load."""
    path = write(tmp_path / "a.csv")
    out, _ = run(capsys, "clutch", path, "--inertia", "0.3 kg.m2", "--drag-torque", "1 N.m",
                 "--fit", "friction_scale")  # fmt: skip
    assert "Slip: from the balance of torques at 0.3 kg·m² and a drag of 1 N·m" in out
    assert "slip" in out


def test_channels_of_a_logger_are_named_and_others_passed_over(tmp_path, capsys):
    head = "time [ms], load [kN], N_SLIP [rpm], oil_temperature [degC], friction_torque [N.m]"
    path = write(tmp_path / "a.csv", head)
    more = Path(path).read_text("utf-8").splitlines()
    more = [more[0] + ", gear", *(line + ", 2" for line in more[1:])]
    Path(path).write_text("\n".join(more), "utf-8")
    words = ("--fit", "friction_scale", "--column", "speed=N_SLIP")
    out, err = run(capsys, "clutch", path, *words)
    assert "passed over, as no column that counts: gear" in err and "0.92" in out


def test_a_measuring_file_is_fitted_by_its_valid_samples_of_the_chosen_group(tmp_path, capsys):
    """One torque in ten is marked and wrong, slip is of integers at other times and there twice."""
    mdf = package("asammdf")
    time = np.linspace(0.0, 0.5, 201)
    load, slip = 5000.0 * np.clip(time / 0.1, 0.0, 1.0), 300.0 * (1.0 - time / 0.5)
    pack = ClutchParams(friction_scale=0.92)
    way = {"time": time, "load": load, "speed": slip, "oil_temperature": 353.15}
    torque, marked = engage_clutch(pack, **way).friction_torque, np.arange(201) % 10 == 5
    rare, path = time[::20], tmp_path / "rig.mf4"
    with mdf.MDF() as file:
        recorded = {"load": load, "friction_torque": np.where(marked, 1e4, torque)}
        marks = {"friction_torque": marked}
        file.append(
            [
                mdf.Signal(x, time, name=n, invalidation_bits=marks.get(n))
                for n, x in recorded.items()
            ],
            acq_name="rig",
        )
        counts = np.round(300.0 * (1.0 - rare / 0.5)).astype("u2")
        file.append([mdf.Signal(counts, rare, name="speed")], acq_name="counter")
        file.append([mdf.Signal(0.5 * slip, time, name="speed")], acq_name="model")
        file.save(path)
    words = ("clutch", str(path), "--fit", "friction_scale", "--set", "oil_temperature=353.15")
    assert "channel speed is in the groups 'counter', 'model'" in refused(capsys, *words)
    out, err = run(capsys, *words, "--column", "speed=counter:speed", "--json")
    assert "20 of 201 samples of friction_torque left out: invalid" in err
    assert json.loads(out)["parameters"]["friction_scale"] == pytest.approx(0.92, rel=1e-5)


def test_time_by_another_name_is_refused_with_the_cure(tmp_path, capsys):
    path = write(tmp_path / "a.csv", HEAD.replace("time", "timestamps"))
    words = ("clutch", path, "--fit", "friction_scale")
    assert '--column "time=timestamps"' in refused(capsys, *words)
    out, _ = run(capsys, *words, "--column", "time=timestamps")
    assert "friction_scale     0.92" in out


def test_a_matlab_file_over_time_by_another_name_is_not_taken_for_settled_points(tmp_path, capsys):
    rows = {"timestamps": [0.0, 1.0], "load": [1e3, 2e3], "speed": [9.0, 5.0]}
    path = tmp_path / "rig.mat"
    package("scipy.io").savemat(path, {**rows, "friction_torque": [30.0, 60.0]})
    said = refused(capsys, "clutch", str(path), "--fit", "friction_scale")
    assert '--column "time=timestamps"' in said


@pytest.mark.parametrize("value", [0.0, 12.0])
def test_an_output_that_is_one_number_in_all_rows_is_doubted(value, tmp_path, capsys):
    path = Path(write(tmp_path / "a.csv"))
    head, *rows = path.read_text("utf-8").splitlines()
    path.write_text("\n".join([head, *(r.rpartition(",")[0] + f", {value}" for r in rows)]))
    out, err = run(capsys, "clutch", str(path), "--fit", "friction_scale")
    assert "The recorded friction_torque is one number in all rows" in err
    assert "Do not use these values" in out


def test_a_recording_and_settled_points_are_not_mixed(tmp_path, capsys):
    trace, points = write(tmp_path / "a.csv"), tmp_path / "b.csv"
    points.write_text("load, speed, friction_torque\n1000, 20, 30\n2000, 20, 60\n", "utf-8")
    err = refused(capsys, "clutch", trace, str(points), "--fit", "friction_scale")
    assert "cannot be fitted together" in err and "b.csv has none" in err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("clutch", "{a}", "{a}"), "given twice"),
        (("{a}",), "has a column time, so it is a recording; allowed: with clutch"),
        (("washer", "{a}", "--fit", "roughness"), "thrustwasher calibrate clutch"),
        (("clutch", "{a}", "washer"), "one part, named first"),
        (("washer", "{a}", "{b}"), "one file; several with clutch"),
        (("clutch", "{p}", "{p}"), "have no column time"),
        (("clutch", "{p}", "--inertia", "1", "--fit", "roughness"), "--inertia: allowed: with rec"),
        (("clutch", "{a}", "--torque-at", "hub"), "inertia_between = 0"),
        (("clutch", "{a}", "--torque-at", "rim"), "pack or hub"),
        (("clutch", "{a}", "--inertia", "1 N"), "inertia"),
        (("clutch", "{a}", "--fit", "kiss_pressure"), "allowed: with piston_area"),
        (("clutch", "{a}", "--bounds", "permeability=1"), "NAME=LOW:HIGH"),
        (("clutch", "{a}", "--bounds", "permeabilty=1:2"), "did you mean permeability"),
        (("clutch", "{a}", "--set", "load=3"), "load: allowed: as a column"),
        (("clutch", "{a}", "--error", "temperature=2 K"), "allowed: of friction_torque"),
        (("clutch", "{c}"), "time goes back by"),
        (("clutch", "{d}"), "3 rows"),
        (("clutch", "{e}"), "line 5: load"),
        (("clutch", "{f}"), "line 4: speed is missing"),
        (("clutch", "{none}"), "none.csv"),
    ],
)
def test_what_cannot_be_used_is_refused_in_one_line(tmp_path, capsys, words, said):
    paths = {name: tmp_path / f"{name}.csv" for name in ("a", "b", "c", "d", "e", "f", "p", "none")}
    for name in "abcef":
        write(paths[name])
    write(paths["d"], cut=slice(0, 3))
    paths["p"].write_text("load, speed, friction_torque\n1000, 20, 30\n", "utf-8")
    lines = paths["a"].read_text("utf-8").splitlines()
    paths["c"].write_text("\n".join([*lines[:20], lines[21], lines[20], *lines[22:]]), "utf-8")
    bad = [cell.strip() for cell in lines[4].split(",")]
    spoiled = ", ".join([bad[0], "full", *bad[2:]])
    paths["e"].write_text("\n".join([*lines[:4], spoiled, *lines[5:]]), "utf-8")
    cut = [cell.strip() for cell in lines[3].split(",")]
    hole = ", ".join([*cut[:2], "", *cut[3:]])
    paths["f"].write_text("\n".join([*lines[:3], hole, *lines[4:]]), "utf-8")
    err = refused(capsys, *(word.format(**paths) for word in words))
    assert said in err and "Traceback" not in err
