"""``thrustwasher efficiency``: table, file, picture, JSON, and what is wrong in a line."""

import csv
import json

import pytest
from scene_runs import slow_without_jit

from thrustwasher.cli import main

SCENE = 'base = "planetary"\n[transmission]\nwashers = 0\n'


@slow_without_jit
def test_the_map_goes_to_a_file_a_picture_and_json(tmp_path, capsys):
    scene, out, plot = (tmp_path / n for n in ("mine.toml", "map.csv", "map.png"))
    scene.write_text(SCENE, "utf-8")
    over = ["--over", "torque=50:150:50", "--over", "speed=1000rpm:2000rpm:n2"]
    files = ["--out", str(out), "--plot", str(plot), "--json"]
    assert main(["efficiency", str(scene), *over, *files]) == 0
    told = json.loads(capsys.readouterr().out)
    with out.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(told["points"]) == 6 and told["balance"] < 1e-12
    for row, point in zip(rows, told["points"], strict=True):
        assert float(row["efficiency [1]"]) == point["efficiency"] and 0.8 < point["efficiency"] < 1
    assert plot.stat().st_size > 10_000


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--over", "torqe=3"], "--over torqe: allowed: torque and speed"),
        (["--over", "torque=-3"], "torque = -3.0 N.m, allowed: 0 .. 100000 N.m"),
        (["--over", "speed=0"], "speed = 0.0 rad/s, allowed: 1 .. 5000 rad/s"),
        (["--gear", "third"], "--gear third: allowed: first or second"),
        (["nothing"], "scene = 'nothing', allowed: "),
    ],
)
def test_wrong_input_is_said_in_a_line(words, said, capsys):
    assert main(["efficiency", *words]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1
