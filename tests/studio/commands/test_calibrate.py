"""The calibrate command: tables as people write them, one line for what is wrong in them."""

import json
import shlex
from pathlib import Path

import numpy as np
import pytest

from thrustwasher import GearMeshParams, calibrate, load_part, run_sweep
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
        ("speed,load\n1,2\n", "column friction is missing"),
        ("speed,load,friction\n1,2\n", "line 2: friction is missing"),
        ("speed,load,friction\n1,2,0.1\n\n1,x,0.1\n", "line 4: load = 'x'"),
        ("speed,load,friction\n1,2,nan\n", "finite"),
        ("speed,load,friction\n1,2,0,1\n", "line 2: has 4 cells, the head names 3"),
        ("a,speed,load,friction,,\n\n0,1,2,0,1\n", "line 3: has 5 cells, the head names 4"),
        ("speed [kg],load,friction\n1,2,0.1\n", "kg"),
        ("speed,load,friction,speed\n1,2,0.1,1\n", "two columns speed"),
        ("speed,load,friction\n1,0,0.1\n", "load: point 1 is 0"),
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
