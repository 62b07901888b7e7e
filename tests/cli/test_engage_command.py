"""The engage command: a table, one JSON object, a file; wrong input is one line."""

import csv
import json

import numpy as np
import pytest

from thrustwasher.cli import main
from thrustwasher.cli.engage import COLUMNS

PACK = ["engage", "--load", "5898", "--speed", "350", "--duration", "60 ms", "--ramp", "20 ms"]


def test_json_holds_every_point_and_the_inputs(capsys):
    assert main([*PACK, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert len(found["time"]) == 61 and found["time"][-1] == pytest.approx(0.06)
    assert found["load"][0] == 0.0 and found["load"][20] == pytest.approx(5898.0)
    assert found["speed"][-1] == 0.0 == found["friction_torque"][-1]
    assert found["status"] == "OK" and found["oil_temperature"] == 297.15
    assert set(COLUMNS) <= set(found) and found["wall_time"] > 0.0


def test_the_table_and_its_summary_are_readable(capsys):
    assert main(PACK) == 0
    text = capsys.readouterr().out
    assert "largest torque" in text and "N·m" in text and "mixed" in text


def test_csv_and_picture_are_written_whole(tmp_path, capsys):
    table, picture = tmp_path / "e.csv", tmp_path / "e.png"
    assert main([*PACK, "--out", str(table), "--plot", str(picture)]) == 0
    rows = list(csv.reader(table.read_text("utf-8").splitlines()))
    assert rows[0][:3] == ["time [s]", "load [N]", "speed [rad/s]"] and len(rows) == 62
    assert np.isfinite([float(v) for v in rows[-1][:-1]]).all()
    assert picture.stat().st_size > 10_000
    assert sorted(p.name for p in tmp_path.iterdir()) == ["e.csv", "e.png"]


@pytest.mark.parametrize(
    ("extra", "named"),
    [
        (["--ramp", "-1"], ["ramp", "-1", "s"]),
        (["--duration", "0"], ["duration", "0", "s"]),
        (["--step", "1 h"], ["step", "'1 h'"]),
        (["--step", "1"], ["step", "1.0 s", "duration"]),
        (["--fidelity", "map"], ["fidelity", "map", "field"]),
        (["--set", "permeability=1"], ["permeability", "1", "m2"]),
    ],
)
def test_wrong_input_is_one_line_that_names_it(extra, named, capsys):
    assert main([*PACK, *extra]) == 2
    said = capsys.readouterr().err.strip()
    assert "\n" not in said and [text for text in named if text not in said] == []
