"""``thrustwasher sweep``: tables, files and messages."""

import csv
import io
import json

import pytest

from thrustwasher.cli import main


def test_without_a_file_the_table_goes_to_standard_output(capsys):
    words = ["sweep", "gearmesh", "--over", "speed=100:300:100", "--power", "5 kW"]
    assert main(words) == 0
    said = capsys.readouterr()
    head, *rows = csv.reader(io.StringIO(said.out))
    assert head[0] == "power [W]" and [row[0] for row in rows] == ["5000.0"] * 3
    assert [float(row[2]) for row in rows] == [100.0, 200.0, 300.0]
    assert "3 points in" in said.err


def test_a_file_of_points_is_read_with_its_units(tmp_path, capsys):
    points = tmp_path / "points.csv"
    points.write_text("speed [rpm], load [kN], note\n100, 2.0, a\n400, 2.0, b\n")
    out = tmp_path / "new" / "table.csv"
    assert main(["sweep", "clutch", "--points", str(points), "--out", str(out)]) == 0
    with out.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["load [N]"]) for row in rows] == [2000.0, 2000.0]
    assert float(rows[0]["speed [rad/s]"]) == pytest.approx(10.471975511965978)
    assert "wrote" in capsys.readouterr().err


def test_failed_points_are_counted_and_a_table_of_them_alone_is_no_success(tmp_path, capsys):
    words = ["sweep", "gearmesh", "--power", "5000", "--over"]
    assert main([*words, "speed=0,100", "--out", str(tmp_path / "a.csv")]) == 0
    assert "failed: 1 BAD_INPUT" in capsys.readouterr().err
    assert main([*words, "speed=0", "--out", str(tmp_path / "b.csv")]) == 3
    assert "no point has a solution" in capsys.readouterr().err
    assert (tmp_path / "b.csv").exists()


def test_an_input_that_is_not_given_is_where_the_model_s_command_has_it(capsys):
    """Of a pack without a drum's speed: at rest."""
    assert main(["sweep", "clutch", "--over", "load=1000,2000"]) == 0
    row = next(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert float(row["drum_speed [rad/s]"]) == 0.0
    assert main(["clutch", "--load", "1000", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert float(row["temperature [K]"]) == pytest.approx(told["temperature"], rel=1e-9)


def test_a_file_without_a_known_column_is_refused(tmp_path, capsys):
    points = tmp_path / "points.csv"
    points.write_text("force [N]\n100\n")
    assert main(["sweep", "clutch", "--points", str(points)]) == 2
    assert "required: load, speed, oil_temperature" in capsys.readouterr().err
