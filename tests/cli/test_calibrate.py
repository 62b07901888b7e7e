"""The calibrate command: tables as people write them, one line for what is wrong in them."""

import json
import shlex
from pathlib import Path

import numpy as np
import pytest

from thrustwasher import GearMeshParams, calibrate, load_part, run_sweep
from thrustwasher.cli import main
from thrustwasher.clutch.calibration.friction_law import (
    friction_over,
    law_values,
)
from thrustwasher.clutch.parameters import ClutchParams

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
    other = write(
        tmp_path / "other.csv",
        "# rig 3\nTime [s];Load [kN];Speed [rpm];friction [%]",
        SLIP,
        SLIP * 0 + 1,
        SLIP * 30 / np.pi,
        FRICTION * 100,
        separator=";",
    )
    record = json.loads(run(capsys, other, "--json").out)
    assert record["fitted"] == pytest.approx(plain["fitted"], rel=1e-6)
    assert record["speed"] == pytest.approx(plain["speed"], rel=1e-14)


def test_options_reach_the_fit(table, capsys):
    words = ["--fit", "decay_speed, stick_speed", "--confidence", "90 %", "--set"]
    record = json.loads(run(capsys, table, *words, "plough_weight=0.2", "--json").out)
    assert list(record["fitted"]) == ["decay_speed", "stick_speed"]
    assert (record["confidence"], record["parameters"]["plough_weight"]) == (0.9, 0.2)


@pytest.mark.parametrize("part", [[], ["clutch"]])
def test_the_constant_law_is_fitted_by_its_one_constant(part, table, capsys):
    words = [*part, table, "--set", "friction_law=constant", "--json"]
    record = json.loads(run(capsys, *words).out)
    assert record["fitted"] == {"constant_friction": pytest.approx(FRICTION.mean())}


def test_sentences_end_with_the_command_that_uses_them(table, capsys):
    out, _ = run(capsys, table)
    last = out.splitlines()[-1]
    assert "4 constants fitted to 30 points" in out
    words = last.removeprefix("Use it: thrustwasher ").split()
    assert main([*words, "--load", "1000", "--speed", "60"]) == 0


def test_empty_cells_at_the_end_of_a_line_do_not_matter(table, tmp_path, capsys):
    plain = json.loads(run(capsys, table, "--json").out)
    other = write(tmp_path / "other.csv", "speed,load,friction,", SLIP, SLIP * 0 + 1e3, FRICTION)
    padded = [line + ",," for line in (tmp_path / "other.csv").read_text().splitlines()]
    (tmp_path / "other.csv").write_text("\n".join(padded))
    assert json.loads(run(capsys, other, "--json").out)["fitted"] == plain["fitted"]


@pytest.mark.parametrize("words", [[], ["--json"]])
def test_points_out_of_reach_are_a_warning_and_no_error(words, tmp_path, capsys):
    data = write(tmp_path / "rig.csv", "speed,load,friction", SLIP, SLIP * 0 + 1e3, FRICTION + 0.3)
    out, err = run(capsys, data, *words)
    assert err.startswith("warning: The law cannot reach any of these points")
    sentences = json.loads(out)["warnings"][0] if words else out.splitlines()[0]
    assert "plough_weight is stopped by its upper bound 1" in sentences
    assert 'friction_law = "table"' in sentences


def test_what_was_given_beside_the_fit_is_in_the_command_that_uses_it(table, capsys):
    out, _ = run(capsys, table, "--set", "hardness_ratio=7", "--set", "faces=6")
    last = out.splitlines()[-1]
    assert "--set hardness_ratio=7.0" in last and "--set faces=6" in last


def test_what_the_box_decided_is_said_and_the_command_solves_the_same_part(tmp_path, capsys):
    part, box = tmp_path / "mine.toml", 'tilt = "1.5 mrad"\noil_temperature = "80 degC"'
    part.write_text(f'model = "washer"\nname = "Mine"\n[box]\n{box}\n', "utf-8")
    data = write(
        tmp_path / "rig.csv",
        "load,speed,friction_torque",
        *np.array([(150.0, 200.0, 0.070), (200.0, 200.0, 0.25), (250.0, 200.0, 0.487)]).T,
    )
    out, _ = run(capsys, str(part), data, "--fit", "roughness")
    assert "Taken from the part's box: tilt = 1.5 mrad, oil_temperature = 80 °C." in out
    words = shlex.split(out.splitlines()[-1].removeprefix("Use it: thrustwasher "))
    assert main([*words, "--load", "250", "--speed", "200", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["friction_torque"] == pytest.approx(0.487, rel=0.01)


@pytest.mark.parametrize("fastest", [20.0, 160.0])
def test_a_plot_is_drawn_whatever_the_points_tell(fastest, tmp_path, capsys):
    kept = fastest >= SLIP
    load = np.linspace(1e3, 5e3, 30)[kept]
    data = write(
        tmp_path / "rig.csv",
        "speed,load,friction,friction_error",
        SLIP[kept],
        load,
        FRICTION[kept],
        load * 0 + 1e-3,
    )
    run(capsys, data, "--plot", str(tmp_path / "fit.png"))
    assert (tmp_path / "fit.png").read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("", ["is empty"]),
        ("speed,load,friction\n", ["no line of numbers"]),
        ("speed,load\n1,2\n", ["column friction is missing", "found: speed, load"]),
        ("speed,load,friction\n1,2\n", ["line 2", "friction is missing"]),
        ("speed,load,friction\n1,2,0.1\n\n1,x,0.1\n", ["line 4", "load = 'x'", "a number"]),
        ("speed;load;friction\n1;2;0,1\n", ["line 2", "'0,1'", "decimal sign is a point"]),
        ("speed,load,friction\n1,2,nan\n", ["line 2", "friction", "finite"]),
        (
            "speed,load,friction\n1,2,0,1\n",
            ["line 2", "4 cells, the head names 3", "decimal commas"],
        ),
        ("a,speed,load,friction,,\n\n0,1,2,0,1\n", ["line 3", "5 cells, the head names 4"]),
        ("speed;load;friction\n1;2;0.1;7\n", ["line 2", "4 cells, the head names 3\n"]),
        ("speed [kg],load,friction\n1,2,0.1\n", ["speed", "kg", "rpm"]),
        ("speed,load,friction,speed\n1,2,0.1,1\n", ["two columns speed"]),
        ("speed,load,friction\n1,0,0.1\n", ["load: point 1 is 0", "above 0"]),
        ("speed,load,friction\n1,2,\0\n", ["line 2", "not text"]),
    ],
)
def test_a_wrong_table_is_one_line_that_names_the_place(text, named, tmp_path, capsys):
    data = tmp_path / "rig.csv"
    data.write_text(text, encoding="utf-8")
    assert main(["calibrate", str(data)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    assert [words for words in named if words not in err] == []


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ([], "DATA.csv"),
        (["nowhere.csv"], "nowhere.csv"),
        (["."], "is a folder"),
        (["{}", "--fit", "load"], "does not depend on load"),
        (["{}", "--fit", ","], "fit names nothing"),
        (["{}", "--confidence", "95"], "confidence = 95.0"),
    ],
)
def test_wrong_options_are_one_line(words, named, table, capsys):
    assert main(["calibrate", *(word.format(table) for word in words)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and named in err


def test_a_file_that_is_no_text_is_named(tmp_path, capsys):
    (tmp_path / "rig.csv").write_bytes(b"\xff\xfe\x00speed")
    assert main(["calibrate", str(tmp_path / "rig.csv")]) == 2
    assert "not UTF-8" in capsys.readouterr().err


# Any model

POWER, SPEED = np.array([2e3, 5e3, 9e3, 4e3]), np.array([180.0, 180.0, 180.0, 90.0])
MESH = GearMeshParams(friction_law="constant", constant_friction=0.06)
LOSS = run_sweep("gearmesh", points={"power": POWER, "speed": SPEED}, params=MESH)[
    "friction_torque"
]
WORDS = ["gearmesh", "{}", "--fit", "constant_friction", "--set", "friction_law=constant"]


@pytest.fixture
def mesh(tmp_path):
    return write(
        tmp_path / "mesh.csv",
        "power,speed [rad/s],friction_torque,_time [s]",
        POWER,
        SPEED,
        LOSS,
        SPEED,
    )


def of(mesh, *more):
    return [word.format(mesh) for word in (*WORDS, *more)]


def test_a_model_s_parameters_are_fitted_as_by_the_api(mesh, capsys):
    record = json.loads(run(capsys, *of(mesh, "--error", "friction_torque=2%", "--json")).out)
    data = {"power": POWER, "speed": SPEED, "friction_torque": LOSS}
    found = calibrate(
        GearMeshParams(friction_law="constant"),
        data,
        fit="constant_friction",
        errors={"friction_torque": "2 %"},
    )
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


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["gearmesh"], "DATA.csv"),
        (["mesh.toml", "{}", "--fit", "f0"], "mesh.toml"),
        (["nothing", "{}", "--fit", "f0"], "model = 'nothing'"),
        (["gearmesh", "{}"], "fit names nothing"),
        ([*WORDS, "--error", "friction_torque"], "--error friction_torque: allowed: NAME="),
        ([*WORDS, "--bounds", "constant_friction=0.1"], "allowed: NAME=LOW:HIGH"),
        ([*WORDS, "--bounds", "constant_friction"], "allowed: NAME=LOW:HIGH"),
        ([*WORDS, "--error", "friction_torque=1", "--error", "friction_torque=2"], "given twice"),
        (["gearmesh", "{}", "more.csv"], "more.csv: allowed: [PART] DATA.csv"),
        ([*WORDS, "--bounds", "constant_friction=0.1:2"], "constant_friction = 2.0"),
        ([*WORDS, "--set", "speed=1", "--json"], "speed: is given twice"),
        (["{}", "--error", "friction=1"], "beside PART"),
        (["clutch", "{}", "--fit", "steel_density"], "column 'power' is not known"),
        ([*WORDS, "--out", "there.toml"], "exists, and a part file is never overwritten"),
    ],
)
def test_wrong_words_for_a_model_are_one_line(words, named, mesh, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there.toml").write_text("kept")
    before = set(tmp_path.iterdir())
    assert main(["calibrate", *(word.format(mesh) for word in words)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and named in err
    assert (tmp_path / "there.toml").read_text() == "kept" and set(tmp_path.iterdir()) == before


def test_a_failed_fit_leaves_no_file(tmp_path, capsys):
    data = write(tmp_path / "slow.csv", "speed,tilt,film_loss_load", [136.0], [2e-3], [900.0])
    out = tmp_path / "out.toml"
    words = ["washer", data, "--fit", "heat_split", "--out", str(out)]
    assert main(["calibrate", *words]) == 3
    assert "point 1" in capsys.readouterr().err and not out.exists()
