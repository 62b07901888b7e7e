"""The commands washer and curve: same numbers as the library, in JSON, CSV and pictures."""

import csv
import json

import pytest
from curves import traced

from thrustwasher.cli import main
from thrustwasher.models.washer import solve_washer
from thrustwasher.models.washer_params import WasherParams

POINT = ["--load", "300", "--speed", "953", "--tilt", "0.002"]
FIELDS = {"friction_torque", "temperature", "temperature_max", "film_thickness", "film_ratio",
          "fluid_load", "contact_load", "friction_coefficient", "washer_tilt_x", "washer_tilt_y",
          "branch", "distress", "status", "iterations", "fidelity", "grid", "error_estimate",
          "load", "speed", "tilt", "oil_temperature", "wall_time"}  # fmt: skip


def run_json(words, capsys):
    assert main([*words, "--json"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    return json.loads(out)


def test_json_has_every_field_and_input_in_full_precision(capsys):
    record = run_json(["washer", *POINT], capsys)
    assert set(record) >= FIELDS
    result = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)
    assert record["friction_torque"] == result.friction_torque
    assert record["film_thickness"] == result.film_thickness
    assert (record["status"], record["branch"]) == ("OK", "film")


def test_units_and_settings_reach_the_model(capsys):
    words = ["washer", "--load", "0.3 kN", "--speed", "9100.479 rpm", "--tilt", "2 mrad",
             "--oil-temperature", "40 degC", "--set", "roughness=0.4 um",
             "--grid", "9x24"]  # fmt: skip
    record = run_json(words, capsys)
    assert record["speed"] == pytest.approx(953.0, abs=1e-3)
    assert record["oil_temperature"] == pytest.approx(313.15)
    assert record["parameters"]["roughness"] == pytest.approx(4e-7)
    assert record["grid"] == [9, 24]


def test_table_shows_what_a_person_wants(capsys):
    assert main(["washer", *POINT]) == 0
    out, err = capsys.readouterr()
    assert err == "" and "friction_torque" in out and "N·m" in out and "°C" in out


def test_bare_call_answers(capsys):
    assert main(["washer"]) == 0
    assert "friction_torque" in capsys.readouterr().out


def test_a_branch_that_does_not_exist_is_wrong_input(capsys):
    assert main(["washer", *POINT, "--branch", "contact"]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and "contact" in err


def test_field_plot_is_written(tmp_path, capsys):
    target = tmp_path / "washer.svg"
    assert main(["washer", *POINT, "--plot", str(target)]) == 0
    assert "<svg" in target.read_text("utf-8")
    assert str(target) in capsys.readouterr().err


def test_curve_json_names_branches_and_folds(capsys):
    record = run_json(["curve", "--speed", "545", "--tilt", "0.002"], capsys)
    assert [fold["kind"] for fold in record["folds"]] == ["film_lost", "film_regained"]
    assert {point["branch"] for point in record["points"]} == {"film", "unstable", "contact"}
    curve = traced()
    assert record["folds"][0]["load"] == curve.folds[0].load
    assert len(record["points"]) == len(curve.points)


def test_curve_table_and_picture(tmp_path, capsys):
    table, picture = tmp_path / "curve.csv", tmp_path / "curve.png"
    words = ["curve", "--speed", "545", "--out", str(table), "--plot", str(picture)]
    assert main(words) == 0
    assert "film lost at" in capsys.readouterr().out
    with table.open(encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    assert rows[0][0] == "load [N]"
    thickness = [float(row[2]) for row in rows[1:]]
    assert thickness == sorted(thickness, reverse=True)
    assert picture.read_bytes()[:4] == b"\x89PNG"


def test_a_curve_without_fold_says_so(capsys):
    assert main(["curve", "--speed", "136", "--tilt", "0.002"]) == 0
    assert "no fold" in capsys.readouterr().out
