"""The calibrate command: tables as people write them, one line for what is wrong in them."""

import json
import shlex
from pathlib import Path

import numpy as np
import pytest

from tests.needed import package
from thrustwasher import (
    GearMeshParams,
    calibrate,
    calibrate_traces,
    engage_clutch,
    load_part,
    run_sweep,
)
from thrustwasher.cli import main
from thrustwasher.clutch.parameters import ClutchParams
from thrustwasher.studio.calibration.friction.friction_law import friction_over, law_values

TRUTH = ClutchParams(plough_weight=0.2, shear_floor=0.4, stick_speed=1.5, decay_speed=2.0)
SLIP = np.linspace(2.0, 160.0, 30)
FRICTION = friction_over(law_values(TRUTH), SLIP * TRUTH.friction_radius)
FRICTION = FRICTION + 1e-3 * np.random.default_rng(1).standard_normal(30)


def write(path, head, *columns, separator=","):
    rows = [separator.join(repr(float(x)) for x in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    return str(path)


@pytest.fixture
def table(tmp_path):
    return write(tmp_path / "rig.csv", "speed,load,friction", SLIP, SLIP * 0 + 1e3, FRICTION)


def run(capsys, *words):
    assert main(["calibrate", *words]) == 0
    return capsys.readouterr()


def test_numbers_are_those_of_the_api(table, capsys):
    out, err = run(capsys, table, "--json")
    record = json.loads(out)
    found = calibrate(ClutchParams(), speed=SLIP, load=1e3, friction=FRICTION)
    assert err == ""
    assert record["fitted"]["decay_speed"] == found.params.decay_speed
    assert record["parameters"]["decay_speed"] == found.params.decay_speed
    assert record["estimates"][0]["interval"] == list(found.estimates[0].interval)
    assert record["load"] == [1000.0] * 30 and "wall_time" in record


def test_units_in_the_head_are_read_and_other_columns_passed_over(table, tmp_path, capsys):
    plain = json.loads(run(capsys, table, "--json").out)
    head = "# rig 3\nTime [s];Load [kN];Speed [rpm];friction [%]"
    columns = (SLIP, SLIP * 0 + 1, SLIP * 30 / np.pi, FRICTION * 100)
    other = write(tmp_path / "other.csv", head, *columns, separator=";")
    text = Path(other).read_text("utf-8")
    Path(other).write_text(text.replace("\n", ";;\n"), "utf-8")  # empty cells at the ends of lines
    record = json.loads(run(capsys, other, "--json").out)
    assert record["fitted"] == pytest.approx(plain["fitted"], rel=1e-6)
    assert record["speed"] == pytest.approx(plain["speed"], rel=1e-14)


def test_options_reach_the_fit(table, capsys):
    words = ["--fit", "decay_speed, stick_speed", "--confidence", "90 %", "--set"]
    record = json.loads(run(capsys, table, *words, "plough_weight=0.2", "--json").out)
    assert list(record["fitted"]) == ["decay_speed", "stick_speed"]
    assert (record["confidence"], record["parameters"]["plough_weight"]) == (0.9, 0.2)


def test_the_constant_law_is_fitted_by_its_one_constant(table, capsys):
    record = json.loads(run(capsys, table, "--set", "friction_law=constant", "--json").out)
    assert record["fitted"] == {"constant_friction": pytest.approx(FRICTION.mean())}


def test_sentences_end_with_the_command_that_uses_them(table, capsys):
    out, _ = run(capsys, table, "--set", "hardness_ratio=7", "--set", "faces=6")
    last = out.splitlines()[-1]
    assert "4 constants fitted to 30 points" in out
    assert "--set hardness_ratio=7.0" in last and "--set faces=6" in last
    words = last.removeprefix("Use it: thrustwasher ").split()
    assert main([*words, "--load", "1000", "--speed", "60"]) == 0


@pytest.mark.parametrize("words", [[], ["--json"]])
def test_points_out_of_reach_are_a_warning_and_no_error(words, tmp_path, capsys):
    data = write(tmp_path / "rig.csv", "speed,load,friction", SLIP, SLIP * 0 + 1e3, FRICTION + 0.3)
    out, err = run(capsys, data, *words)
    assert err.startswith("warning: The law cannot reach any of these points")
    sentences = json.loads(out)["warnings"][0] if words else out.splitlines()[0]
    assert "plough_weight is stopped by its upper bound 1" in sentences
    assert 'friction_law = "table"' in sentences


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is empty"),
        ("speed,load,friction\n", "no line of numbers"),
        ("speed,load,friction\n1,2,0.1\n\n1,x,0.1\n", "line 4: load = 'x'"),
        ("speed,load,friction\n1,2,nan\n", "line 2: friction is missing"),
        ("speed,load,friction\n1,2,0,1\n", "line 2: has 4 cells, the head names 3"),
        ("a,speed,load,friction,,\n\n0,1,2,0,1\n", "line 3: has 5 cells, the head names 4"),
        ("speed,load,friction\n1,2,\0\n", "not text"),
        ("\xff\xfes", "begins as UTF-16 text and is none"),
    ],
)
def test_a_wrong_table_is_one_line_that_names_the_place(text, words, tmp_path, capsys):
    data = tmp_path / "rig.csv"
    data.write_bytes(text.encode("latin-1"))
    assert main(["calibrate", str(data)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and words in err


# Any model

POWER, SPEED = np.array([2e3, 5e3, 9e3, 4e3]), np.array([180.0, 180.0, 180.0, 90.0])
MESH = GearMeshParams(friction_law="constant", constant_friction=0.06)
SWEPT = run_sweep("gearmesh", points={"power": POWER, "speed": SPEED}, params=MESH)
LOSS = SWEPT["friction_torque"]
WORDS = ["gearmesh", "{}", "--fit", "constant_friction", "--set", "friction_law=constant"]


@pytest.fixture
def mesh(tmp_path):
    head = "power,speed [rad/s],friction_torque,_time [s]"
    return write(tmp_path / "mesh.csv", head, POWER, SPEED, LOSS, SPEED)


def of(mesh, *more):
    return [word.format(mesh) for word in (*WORDS, *more)]


def test_a_model_s_parameters_are_fitted_as_by_the_api(mesh, capsys):
    record = json.loads(run(capsys, *of(mesh, "--error", "friction_torque=2%", "--json")).out)
    data = {"power": POWER, "speed": SPEED, "friction_torque": LOSS}
    start, errors = GearMeshParams(friction_law="constant"), {"friction_torque": "2 %"}
    found = calibrate(start, data, fit="constant_friction", errors=errors)
    assert record["fitted"] == {"constant_friction": found.params.constant_friction}
    assert record["error"] == pytest.approx(0.02 * LOSS)
    assert record["estimates"][0]["interval"] == list(found.estimates[0].interval)


def test_the_fitted_part_is_a_part_file(mesh, tmp_path, capsys):
    out = tmp_path / "fitted.toml"
    _, err = run(capsys, *of(mesh, "--out", str(out), "--plot", str(tmp_path / "fit.png")))
    part = load_part(out)
    assert part.params.constant_friction == pytest.approx(0.06, rel=1e-9)
    assert "mesh.csv, 95 %: constant_friction 0.06 (0.0" in part.notes and f"wrote {out}" in err
    assert (tmp_path / "fit.png").read_bytes()[:4] == b"\x89PNG"
    assert f"--part {out}" in run(capsys, str(out), mesh, "--fit", "constant_friction").out
    again = json.loads(run(capsys, str(out), mesh, "--fit", "constant_friction", "--json").out)
    assert again["fitted"]["constant_friction"] == pytest.approx(0.06, rel=1e-9)


def test_an_empty_cell_was_not_measured(mesh, tmp_path, capsys):
    text = Path(mesh).read_text("utf-8").splitlines()
    cells = text[1].split(",")
    (tmp_path / "less.csv").write_text(
        "\n".join([text[0], ",".join([*cells[:2], "", ""]), *text[2:]])
    )
    record = json.loads(run(capsys, *of(str(tmp_path / "less.csv"), "--json")).out)
    assert record["point"] == [2, 3, 4] and len(record["residuals"]) == 3


def test_a_failed_fit_leaves_no_file(tmp_path, capsys):
    data = write(tmp_path / "slow.csv", "speed,tilt,film_loss_load", [136.0], [2e-3], [900.0])
    out = tmp_path / "out.toml"
    words = ["washer", data, "--fit", "heat_split", "--out", str(out)]
    assert main(["calibrate", *words]) == 3
    assert "point 1" in capsys.readouterr().err and not out.exists()


@pytest.mark.parametrize(
    "words",
    [
        ["washer", "--fit", "viscosity_scale"],
        ["washer", "--fit", "viscosity_scale", "--oil", "ISO VG 46"],
        ["washer", "--fit", "roughness", "--oil", "ISO VG 46", "--fidelity", "fine"],
        ["washer", "--fit", "viscosity_scale", "--preset", "bronze"],
        ["my part.toml", "--fit", "viscosity_scale"],
        ["my part.toml", "--fit", "viscosity_scale", "--out", "the fit.toml"],
    ],
)
@pytest.mark.slow
def test_the_command_printed_as_the_next_step_runs(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    text = 'model = "washer"\nname = "Mine"\noil = "Dexron VI"\n[parameters]\nroughness = 4e-7\n'
    Path("my part.toml").write_text(text, "utf-8")
    options = [*words[1:], "--error", "friction_torque=20%"]
    assert main(["sweep", "washer", "--over", "load=100:400:50", "--out", "all.csv"]) == 0
    rows = [line.split(",") for line in Path("all.csv").read_text("utf-8").splitlines()]
    kept = [rows[0].index(n) for n in ("load [N]", "friction_torque [N.m]")]
    lines = [",".join(row[i] for i in kept) for row in rows]
    Path("rig.csv").write_text("\n".join(lines) + "\n", "utf-8")
    capsys.readouterr()
    assert main(["calibrate", words[0], "rig.csv", *options]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    if last.startswith("Do not use"):
        assert "--out" not in words or not Path("the fit.toml").exists()
        return
    command = shlex.split(last.removeprefix("Use it: "))
    assert command[0] == "thrustwasher"
    assert main(command[1:]) == 0, command


@pytest.mark.slow
def test_values_that_are_not_to_be_used_are_not_written(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    lines = ["load,friction_torque", *(f"{load},{1000.0 + load}" for load in range(100, 400, 50))]
    Path("rig.csv").write_text("\n".join(lines) + "\n", "utf-8")
    out, err = run(capsys, "washer", "rig.csv", "--fit", "viscosity_scale", "--out", "fit.toml")
    assert out.splitlines()[-1].startswith("Do not use") and "fit.toml is not written" in err
    assert not Path("fit.toml").exists()


# The calibrate command on recordings over time: what is read, said, written and refused.

EXAMPLES = Path(__file__).parents[3] / "examples"
TRACE = str(EXAMPLES / "ex17_engagement.csv")
TRACES_TRUTH = {
    "friction_scale": 0.92,
    "permeability": 3e-13,
    "fill_time": 0.012,
    "kiss_pressure": 6e4,
}
AREA = ("--piston-area", "60 cm2")
HEAD = "time [ms], load [kN], speed [rpm], oil_temperature [degC], friction_torque [N.m]"


def traces_write(path, head=HEAD, *, scale=0.92, load=5000.0):
    """Write a recording of one engagement."""
    time = np.linspace(0.0, 0.5, 151)
    way = {"load": load * np.clip(time / 0.1, 0.0, 1.0), "speed": 300.0 * (1.0 - time / 0.5)}
    pack = ClutchParams(friction_scale=scale)
    torque = engage_clutch(pack, time=time, **way, oil_temperature=353.15).friction_torque
    columns = (1e3 * time, way["load"] / 1e3, way["speed"] * 30 / np.pi, 80.0 + 0 * time, torque)
    rows = [", ".join(f"{x:.9g}" for x in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([head, *rows]) + "\n", "utf-8")
    return str(path)


def refused(capsys, *words):
    assert main(["calibrate", *words]) == 2
    out, err = capsys.readouterr()
    assert out == "" and len(err.splitlines()) == 1
    return err


@pytest.mark.slow
def test_the_shipped_recording_tells_what_it_was_made_from(capsys):
    words = ("clutch", TRACE, *AREA, "--fit", ",".join(TRACES_TRUTH))
    out, err = run(capsys, *words)
    record = json.loads(run(capsys, *words, "--json").out)
    assert err == "" and "2 engagements in 1 recording; 1100 rows" in out
    assert "Torque: of the faces (pack)." in out
    for estimate in record["estimates"]:
        low, high = estimate["interval"]
        assert low <= TRACES_TRUTH[estimate["name"]] <= high and estimate["identifiable"]
    assert record["engagements"] == 2 and len(record["time"]) == len(record["computed"])
    last = out.splitlines()[-1]
    assert last.startswith("Use it: thrustwasher clutch --set friction_scale=")
    assert "fill_time" not in last  # a rig's, not the part's


def test_numbers_of_recordings_are_those_of_the_api(tmp_path, capsys):
    path = traces_write(tmp_path / "a.csv")
    record = json.loads(run(capsys, "clutch", path, "--fit", "friction_scale", "--json").out)
    found = calibrate_traces("clutch", path, fit=["friction_scale"])
    assert record["fitted"]["friction_scale"] == found.params.friction_scale
    assert record["parameters"]["friction_scale"] == pytest.approx(0.92, rel=1e-5)


def test_several_files_are_fitted_at_once_into_a_part_with_a_picture(tmp_path, capsys):
    paths = [traces_write(tmp_path / "a.csv"), traces_write(tmp_path / "b.csv", load=2500.0)]
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
    path = traces_write(tmp_path / "a.csv")
    out, _ = run(capsys, "clutch", path, "--inertia", "0.3 kg.m2", "--drag-torque", "1 N.m",
                 "--fit", "friction_scale")  # fmt: skip
    assert "Slip: from the balance of torques at 0.3 kg·m² and a drag of 1 N·m" in out
    assert "slip" in out


def test_channels_of_a_logger_are_named_and_others_passed_over(tmp_path, capsys):
    head = "time [ms], load [kN], N_SLIP [rpm], oil_temperature [degC], friction_torque [N.m]"
    path = traces_write(tmp_path / "a.csv", head)
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
    path = traces_write(tmp_path / "a.csv", HEAD.replace("time", "timestamps"))
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
    path = Path(traces_write(tmp_path / "a.csv"))
    head, *rows = path.read_text("utf-8").splitlines()
    path.write_text("\n".join([head, *(r.rpartition(",")[0] + f", {value}" for r in rows)]))
    out, err = run(capsys, "clutch", str(path), "--fit", "friction_scale")
    assert "The recorded friction_torque is one number in all rows" in err
    assert "Do not use these values" in out


def test_a_recording_and_settled_points_are_not_mixed(tmp_path, capsys):
    trace, points = traces_write(tmp_path / "a.csv"), tmp_path / "b.csv"
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
        (("clutch", "{a}", "--inertia", "1 N"), "inertia"),
        (("clutch", "{a}", "--bounds", "permeability=1"), "NAME=LOW:HIGH"),
        (("clutch", "{a}", "--bounds", "permeabilty=1:2"), "did you mean permeability"),
        (("clutch", "{a}", "--set", "load=3"), "load: allowed: as a column"),
        (("clutch", "{a}", "--error", "temperature=2 K"), "allowed: of friction_torque"),
        (("clutch", "{c}"), "time goes back by"),
        (("clutch", "{e}"), "line 5: load"),
        (("clutch", "{f}"), "line 4: speed is missing"),
        (("clutch", "{none}"), "none.csv"),
    ],
)
def test_what_cannot_be_used_is_refused_in_one_line(tmp_path, capsys, words, said):
    paths = {name: tmp_path / f"{name}.csv" for name in ("a", "b", "c", "e", "f", "p", "none")}
    for name in "abcef":
        traces_write(paths[name])
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
