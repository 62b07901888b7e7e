"""``thrustwasher part`` and what takes a part file: the commands, sweeps and scenes."""

import json

import pytest

from thrustwasher import WasherParams, load_part, solve_washer
from thrustwasher.cli import main
from thrustwasher.ladder.own_tables import serves
from thrustwasher.shift.scene.scene_file import load_scene
from thrustwasher.washer.map.map_tables import TABLES


@pytest.fixture
def mine(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["part", "new", "washer", "--set", "roughness=0.4 um", "--name", "Mine"]) == 0
    return tmp_path / "washer.toml"


def test_a_new_part_has_every_parameter_on_a_line_and_is_sound(mine, capsys):
    given, _, scatter = mine.read_text().partition("[scatter]")
    for text, start in ((given, 'roughness = "0.4 um"'), (scatter, "roughness = { normal = ")):
        lines = [line for line in text.splitlines() if line.startswith("roughness =")]
        assert len(lines) == 1 and lines[0].startswith(start)
    assert load_part(mine).params == WasherParams(roughness=0.4e-6)
    capsys.readouterr()
    assert main(["part", "check", str(mine), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["name"], told["box"]["load"]) == ("Mine", [0.0, 1850.0])
    assert told["scatter"]["tilt"] == {"law": "lognormal, factor 1.6", "source": "estimate"}


def test_a_command_solves_the_part(mine, capsys):
    words = ["washer", "--part", str(mine), "--load", "300 N", "--speed", "953", "--json"]
    capsys.readouterr()
    assert main(words) == 0
    told = json.loads(capsys.readouterr().out)
    expected = solve_washer(WasherParams(roughness=0.4e-6), load=300.0, speed=953.0, tilt=0.002)
    assert told["friction_torque"] == expected.friction_torque


def test_a_command_and_a_sweep_take_the_part_s_level_unless_another_is_asked_for(mine, capsys):
    mine.write_text(mine.read_text().replace('fidelity = "field"', 'fidelity = "fine"'))
    torques = []
    for words in ([], ["--fidelity", "fine"], ["--fidelity", "field"]):
        capsys.readouterr()
        assert main(["washer", "--part", str(mine), "--speed", "953", *words, "--json"]) == 0
        torques.append(json.loads(capsys.readouterr().out)["friction_torque"])
    assert torques[0] == torques[1] != torques[2]
    assert main(["sweep", str(mine), "--over", "load=300,400", "--speed", "953"]) == 0
    head, first, _ = capsys.readouterr().out.splitlines()
    row = dict(zip(head.split(","), first.split(","), strict=True))
    assert float(row["friction_torque [N.m]"]) == pytest.approx(torques[0], rel=1e-6)


def test_a_scene_takes_a_part_that_lies_beside_it(mine):
    scene = mine.parent / "mine_too.toml"
    scene.write_text('base = "planetary"\n[washer]\npart = "washer.toml"\nheat_split = 0.4\n')
    params = load_scene(scene).parts["washer"].params
    assert (params.roughness, params.heat_split) == (0.4e-6, 0.4)


def test_a_part_in_a_scene_is_the_whole_part_of_its_base(mine):
    """The base has washers of 5.55 .. 11.35 mm and a brake that starts pressed."""
    scene = mine.parent / "mine_too.toml"
    assert main(["part", "new", "clutch", "--set", "faces=6"]) == 0
    scene.write_text(
        'base = "planetary"\n[washer]\npart = "washer.toml"\n[brake]\npart = "clutch.toml"'
    )
    parts = load_scene(scene).parts
    assert parts["washer"].params.outer_radius == load_part(mine).params.outer_radius == 0.0227
    assert (parts["brake"].params.faces, parts["brake"].params.starts_pressed) == (6, True)
    top = mine.parent / "top.toml"
    top.write_text('base = "mine_too.toml"\n[washer]\npreset = "paper"\n')
    assert load_scene(top).parts["washer"].params.roughness == WasherParams().roughness


def test_a_scene_s_oil_is_that_of_a_part_file_too_and_that_is_said(mine):
    text = mine.read_text().replace('viscosity_scale = "0.0631 mPa.s"', "viscosity_scale = 7e-5")
    mine.write_text(text)
    scene = mine.parent / "mine_too.toml"
    scene.write_text('base = "planetary"\n[washer]\npart = "washer.toml"\n')
    oil = load_scene("planetary").parts["washer"].params.viscosity_scale
    found = load_scene(scene)
    assert found.parts["washer"].params.viscosity_scale == oil
    assert [note for note in found.notes if "washer: viscosity_scale of its part" in note]
    scene.write_text(scene.read_text() + "viscosity_scale = 7e-5\n")
    assert load_scene(scene).parts["washer"].params.viscosity_scale == 7e-5


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('part = "nowhere.toml"', "cannot be read"),
        ('part = "washer.toml"\npreset = "paper"', "one of them"),
    ],
)
def test_a_scene_says_what_is_wrong_with_its_part(mine, text, said, capsys):
    scene = mine.parent / "mine_too.toml"
    scene.write_text(f'base = "planetary"\n[washer]\n{text}\n')
    assert main(["shift", "--scene", str(scene), "--out", str(mine.parent / "report")]) == 2
    assert said in capsys.readouterr().err
    assert not (mine.parent / "report").exists()


def test_build_writes_the_fmu_of_the_part(mine, tmp_path, capsys):
    capsys.readouterr()
    words = f"build {mine} CommandSource --no-maps --platforms local --out {tmp_path}"
    assert main(words.split()) == 0
    made = [str(tmp_path / "native-fmi2" / f"{name}.fmu") for name in ("Mine", "CommandSource")]
    assert capsys.readouterr().out.splitlines() == made


@pytest.mark.parametrize("name", ["2nd", "my part", "M\u00e4rz", "", "../up", "a" * 61])
def test_a_part_is_built_under_no_other_than_a_plain_name(name, tmp_path, capsys):
    file = tmp_path / "bad.toml"
    file.write_text(f'model = "washer"\nname = "{name}"\n', "utf-8")
    assert main(["build", str(file), "--out", str(tmp_path / "dist")]) == 2
    assert f"name = {name!r}, allowed: letters, digits and _" in capsys.readouterr().err
    assert not (tmp_path / "dist").exists()


@pytest.mark.parametrize(
    ("words", "load", "speed"),
    [
        (("clutch",), (0.0, 1e4), (-450.0, 450.0)),
        (("gearmesh",), (-200.0, 200.0), (-700.0, 700.0)),
        (("washer",), (0.0, 1850.0), (-1400.0, 1400.0)),
        (("washer", "--preset", "paper"), (0.0, 1850.0), (-1400.0, 1400.0)),
    ],
)
def test_a_new_parts_box_holds_rest_and_both_senses(words, load, speed, tmp_path):
    assert main(["part", "new", *words, "--out", str(tmp_path / "new.toml")]) == 0
    box = load_part(tmp_path / "new.toml").box
    assert (box["load"], box["speed"]) == (load, speed)


def test_a_new_washer_is_served_by_the_shipped_map_from_rest_on():
    box = {"load": (0.0, 1850.0), "speed": (-1400.0, 1400.0)}
    assert serves(TABLES, WasherParams(), box, 5e-3)
    assert not serves(TABLES, WasherParams(), box | {"load": (5.0, 1850.0)}, 5e-3)
