"""``thrustwasher part`` and what takes a part file: the commands, sweeps and scenes."""

import json

import pytest

from thrustwasher import WasherParams, load_part, solve_washer
from thrustwasher.cli import main
from thrustwasher.shift.scene.scene_file import load_scene


@pytest.fixture
def mine(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["part", "new", "washer", "--set", "roughness=0.4 um", "--name", "Mine"]) == 0
    return tmp_path / "washer.toml"


def test_a_new_part_has_every_parameter_on_a_line_and_is_sound(mine, capsys):
    lines = [line for line in mine.read_text().splitlines() if line.startswith("roughness =")]
    assert len(lines) == 1 and lines[0].startswith('roughness = "0.4 um"')
    assert load_part(mine).params == WasherParams(roughness=0.4e-6)
    capsys.readouterr()
    assert main(["part", "check", str(mine), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["name"], told["box"]["load"]) == ("Mine", [20.0, 1850.0])


def test_a_part_file_is_never_overwritten(mine, capsys):
    before = mine.read_bytes()
    assert main(["part", "new", "washer"]) == 2
    assert "washer.toml: exists" in capsys.readouterr().err
    assert mine.read_bytes() == before


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["new"], "a model, e.g. washer is required"),
        (["new", "whasher"], "model = 'whasher'"),
        (["new", "washer", "--name", "2nd"], "name = '2nd'"),
        (["new", "washer", "--preset", "rosy"], "'bronze' or 'paper'"),
        (["new", "washer", "--set", "roughness=1 m"], "roughness = 1.0 m"),
        (["new", "washer", "--out", "part.txt"], ".toml"),
        (["check", "nowhere.toml"], "cannot be read"),
    ],
)
def test_a_wrong_word_is_one_line_and_leaves_no_file(words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["part", *words]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_a_command_solves_the_part(mine, capsys):
    words = ["washer", "--part", str(mine), "--load", "300 N", "--speed", "953", "--json"]
    capsys.readouterr()
    assert main(words) == 0
    told = json.loads(capsys.readouterr().out)
    expected = solve_washer(WasherParams(roughness=0.4e-6), load=300.0, speed=953.0, tilt=0.002)
    assert told["friction_torque"] == expected.friction_torque
    assert main(["clutch", "--part", str(mine)]) == 2
    assert "ThrustWasher, allowed: WetClutch" in capsys.readouterr().err


def test_a_command_solves_it_with_the_part_s_rung_unless_another_is_asked_for(mine, capsys):
    mine.write_text(mine.read_text().replace('fidelity = "field"', 'fidelity = "fine"'))
    for words, rung in (([], "fine"), (["--fidelity", "field"], "field")):
        capsys.readouterr()
        assert main(["washer", "--part", str(mine), *words, "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["fidelity"] == rung


def test_a_sweep_takes_the_part_and_its_rung(mine, capsys):
    mine.write_text(mine.read_text().replace('fidelity = "field"', 'fidelity = "fine"'))
    capsys.readouterr()
    assert main(["sweep", str(mine), "--over", "load=300,400", "--speed", "953"]) == 0
    head, first, _ = capsys.readouterr().out.splitlines()
    row = dict(zip(head.split(","), first.split(","), strict=True))
    expected = solve_washer(
        load_part(mine).params, load=300.0, speed=953.0, tilt=0.002, fidelity="fine"
    )
    assert float(row["friction_torque [N.m]"]) == pytest.approx(expected.friction_torque, rel=1e-6)


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
    words = [
        "build",
        str(mine),
        "CommandSource",
        "--no-maps",
        "--platforms",
        "local",
        "--out",
        str(tmp_path),
    ]
    assert main(words) == 0
    folder = tmp_path / "native-fmi2"
    assert capsys.readouterr().out.splitlines() == [
        str(folder / "Mine.fmu"),
        str(folder / "CommandSource.fmu"),
    ]


@pytest.mark.parametrize(
    ("name", "line", "words", "said"),
    [
        ("Bad", '[parameters]\nroughness = "1 N"\n', [], "roughness = '1 N'"),
        ("Bad", "[parameters]\nroughness = nan\n", [], "roughness = nan, allowed: a finite number"),
        ("Bad", '[parameters]\nroughnes = "1 um"\n', [], "did you mean 'roughness'?"),
        ("Bad", 'colour = "red"\n', [], "there is no 'colour' here"),
        ("Bad", '[box]\nload = ["1 N", "9 MN"]\n', [], "load = 9000000.0 N, allowed: 0 .."),
        *(
            (name, "", [], f"name = {name!r}, allowed: letters, digits and _")
            for name in ("2nd", "my part", "M\u00e4rz", "", "../up", "a" * 61)
        ),
        ("Bad", "", ["--target", "python"], "for native FMUs only"),
    ],
)
def test_build_refuses_a_bad_part_in_one_line(name, line, words, said, tmp_path, capsys):
    file = tmp_path / "bad.toml"
    file.write_text(f'model = "washer"\nname = "{name}"\n{line}', "utf-8")
    assert main(["build", str(file), *words, "--out", str(tmp_path / "dist")]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1
    assert not (tmp_path / "dist").exists()
