"""``thrustwasher efficiency``: table, file, picture, JSON, and what is wrong in a line."""

import csv
import json
from pathlib import Path

import pytest
from scene_runs import slow_without_jit

from thrustwasher.cli import main

EXAMPLES = Path(__file__).parents[3] / "examples"
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


def test_bearings_with_names_of_their_own_are_told(tmp_path, capsys):
    text = (EXAMPLES / "ev-reducer.toml").read_text("utf-8")
    first = text.index("bearings = [")
    last = text.index("]\n", first) + 2
    end = "bearings.{} = {{ type = 'ball', position = '{} mm', diameter = '60 mm', C = '9 kN' }}\n"
    ends = end.format("left", 0) + end.format("right", 90)
    mine = tmp_path / "mine.toml"
    mine.write_text(text[:first] + ends + text[last:], "utf-8")
    over = ["--over", "torque=100", "--over", "speed=3000rpm"]
    assert main(["efficiency", str(mine), *over]) == 0
    assert "h: rotor.left, at 100" in capsys.readouterr().out
    assert main(["train", str(mine)]) == 2
    assert f"did you mean --part {mine}?" in capsys.readouterr().err


@slow_without_jit
def test_a_loss_map_of_vecto_has_what_the_table_has_and_is_read_again(tmp_path, capsys):
    from thrustwasher.storage.tables.table import numbers
    from thrustwasher.storage.tables.table_file import read_table

    over = ["--over", "torque=-50:150:100", "--over", "speed=1000rpm,1500rpm"]
    for name in ("map.csv", "map.vtlm"):
        assert main(["efficiency", "ev-reducer", *over, "--out", str(tmp_path / name)]) == 0
    table, whole = read_table(tmp_path / "map.vtlm"), read_table(tmp_path / "map.csv")
    assert [c.name for c in table.columns] == ["Input Speed", "Input Torque", "Torque Loss"]
    rows = sorted(
        zip(
            *(
                numbers(next(c for c in whole.columns if c.name == n), whole, u)
                for n, u in (("speed", "rad/s"), ("torque", "N.m"), ("loss", "W"))
            ),
            strict=True,
        )
    )
    units = ("rad/s", "N.m", "N.m")
    found = [numbers(c, table, u) for c, u in zip(table.columns, units, strict=True)]
    for (speed, torque, loss), *row in zip(rows, *found, strict=True):
        assert row == pytest.approx([speed, torque, loss / speed], rel=1e-8)
    capsys.readouterr()
    rest = ["--over", "speed=0,100", "--out", str(tmp_path / "rest.vtlm")]
    assert main(["efficiency", "ev-reducer", "--over", "torque=50", *rest]) == 2
    assert "speeds above 0 rad/s" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--over", "torqe=3"], "--over torqe: allowed: torque and speed"),
        (["--over", "torque=-2e5"], "torque = -200000.0 N.m, allowed: -100000 .. 100000 N.m"),
        (["--over", "speed=6000"], "speed = 6000.0 rad/s, allowed: -5000 .. 5000 rad/s"),
        (["--gear", "third"], "--gear third: allowed: first or second"),
        (["nothing"], "scene = 'nothing', allowed: "),
    ],
)
def test_wrong_input_is_said_in_a_line(words, said, capsys):
    assert main(["efficiency", *words]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1


@slow_without_jit
def test_coasting_says_which_way_power_runs(tmp_path, capsys):
    """Refused before; -1 N m brakes less than the gearbox does: no efficiency, but a word."""
    out, plot = tmp_path / "map.csv", tmp_path / "map.png"
    over = ["--over", "torque=-100,-1,0,100", "--over", "speed=-200,0,200"]
    assert main(["efficiency", *over, "--out", str(out), "--plot", str(plot), "--json"]) == 0
    found = {(p["torque"], p["speed"]): p for p in json.loads(capsys.readouterr().out)["points"]}
    assert found[-100.0, 200.0]["flow"] == "output to input"
    assert found[100.0, -200.0]["flow"] == "output to input"
    assert found[-100.0, -200.0]["flow"] == "input to output"
    assert found[-1.0, 200.0]["flow"] == "output to input"
    assert found[-1.0, -200.0]["flow"] == "both shafts feed in"
    assert found[0.0, 200.0]["flow"] == "no power comes out"
    assert found[100.0, 0.0]["flow"] == "at rest"
    for point in found.values():
        alone = point["flow"] in ("input to output", "output to input")
        assert (point["efficiency"] is not None) == alone
    with out.open(encoding="utf-8") as stream:
        assert [row["flow"] for row in csv.DictReader(stream)] == [
            p["flow"] for p in found.values()
        ]
    assert plot.stat().st_size > 10_000


def test_the_largest_power_is_told_also_when_coasting(capsys):
    assert main(["efficiency", "--over", "torque=-100", "--over", "speed=200"]) == 0
    said = capsys.readouterr().out
    assert "output to input, efficiency 9" in said and "Power in is power out" in said
