"""``thrustwasher part`` and what takes a part file: the commands, sweeps and scenes."""

import json
import re
import shutil
import zipfile
from pathlib import Path

import pytest

from thrustwasher import WasherParams, load_part, solve_washer
from thrustwasher.cli import main
from thrustwasher.ladder.own_tables import serves
from thrustwasher.shift.scene.scene_file import load_scene
from thrustwasher.washer.map.look_up import WasherMap
from thrustwasher.washer.map.map_build import make_map
from thrustwasher.washer.map.map_file import plain, read_map
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


# The command map: build, list, check; wrong input in one line.

MINE = (
    'model = "washer"\nname = "Mine"\n[parameters]\nroughness = "0.5 um"\n[box]\n'
    'load = ["200 N", "400 N"]\nspeed = 530\ntilt = 0.002\noil_temperature = "50 degC"\n'
)
BOX = "--load 200:400 --speed 5000rpm:5200rpm --tilt 0.002 --oil-temperature 24degC"
BUILD = f"map build {BOX} --fidelity field --workers 1 --points 4".split()


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    path = tmp_path_factory.mktemp("map") / "small.twm"
    assert main([*BUILD, "--out", str(path)]) == 0
    return path


def test_a_built_map_serves_and_lies_alone_in_its_folder(built):
    washer = WasherMap(WasherParams(), built)
    assert washer.box["speed"] == pytest.approx((523.598776, 544.542727))
    mesh = solve_washer(WasherParams(), load=300.0, speed=530.0, tilt=0.002)
    assert washer.torque(300.0, 530.0, 0.002, 297.15) == pytest.approx(
        mesh.friction_torque, rel=1e-4
    )
    assert [p.name for p in built.parent.iterdir()] == ["small.twm"]


def test_check_measures_it_again(built, capsys):
    assert main(["map", "check", str(built), "--points", "4", "--json"]) == 0
    metadata = json.loads(capsys.readouterr().out)
    assert metadata["held_out"]["torque"] < 1e-3 and metadata["built_from"] == "field"


def test_list_names_maps_with_box_and_errors(built, capsys, monkeypatch):
    monkeypatch.setenv("THRUSTWASHER_MAPS", str(built.parent))
    assert main(["map", "list"]) == 0
    said = capsys.readouterr().out
    assert "small.twm" in said and "200 N .. 400 N" in said and "torque within" in said


@pytest.mark.slow
def test_a_part_files_box_is_the_maps_and_options_override_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(MINE)
    options = ["--tol", "0.02", "--workers", "1", "--points", "4", "--oil-temperature", "24 degC"]
    assert main(["map", "build", "mine.toml", *options]) == 0
    washer = WasherMap(WasherParams(roughness=5e-7), tmp_path / "mine.twm")
    assert washer.box["load"] == (200.0, 400.0)
    assert washer.box["oil_temperature"] == pytest.approx((297.15, 297.15))


@pytest.mark.slow
def test_build_makes_the_map_of_a_part_once_and_puts_it_inside(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    (tmp_path / "mine.toml").write_text(MINE)
    monkeypatch.setitem(make_map.__kwdefaults__, "points", 4)  # held out
    words = ["build", "mine.toml", "--platforms", "linux64", "--tol", "0.02"]
    assert main(words) == 0
    with zipfile.ZipFile("dist/native-fmi2/Mine.fmu") as fmu:
        assert "resources/map-0.bin" in fmu.namelist()
        assert "map, when built" in fmu.read("documentation/index.html").decode()
    monkeypatch.setattr("thrustwasher.washer.map.map_tables.make_map", None)
    assert main(words) == 0
    assert "no map" not in capsys.readouterr().err


@pytest.mark.slow
def test_build_takes_the_map_that_was_built_for_the_part_file(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr("thrustwasher.washer.map.map_tables.make_map", None)
    (tmp_path / "mine.toml").write_text(MINE)
    few = ["--tol", "0.02", "--workers", "1", "--points", "4"]
    assert main(["map", "build", "mine.toml", *few]) == 0
    assert main(["build", "mine.toml", "--platforms", "linux64", "--tol", "0.02"]) == 0
    assert "builds a map" not in capsys.readouterr().err
    with zipfile.ZipFile("dist/native-fmi2/Mine.fmu") as fmu:
        assert fmu.read("resources/map-0.bin") == plain(read_map("mine.twm"))


# The files that the pages of the commands name are there, and the commands work on them.

ROOT = Path(__file__).parents[3]
OWN = ROOT / "examples" / "own"
PAGES = ("calibrate", "sweep", "efficiency", "shift", "part")
MADE = {"map", "calibrated", "shift", "solved", "washer", "front", "fit", "pack", "usual"}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A copy of the files, as the working folder."""
    shutil.copytree(OWN, tmp_path / "own")
    monkeypatch.chdir(tmp_path / "own")
    return tmp_path / "own"


def test_every_file_that_these_pages_read_is_there():
    for page in PAGES:
        text = (ROOT / "docs" / "command-line" / f"{page}.md").read_text("utf-8")
        made = MADE | set(re.findall(r"(?:--out|```\w+\n#) +([\w-]+)\.(?:csv|toml)", text))
        for block in re.findall(r"```(?:sh|toml|python)\n(.*?)```", text, re.DOTALL):
            for path in re.findall(r"[\w./-]+\.(?:csv|toml)", block):
                name = Path(path)
                if name.stem not in made and not path.startswith("examples/"):
                    assert (OWN / name.name).is_file(), f"{page}: {path}"


def test_the_part_of_the_page_is_the_file():
    text = (ROOT / "docs" / "command-line" / "part.md").read_text("utf-8")
    block = re.search(r"```toml\n# mine.toml\n(model = .*?)```", text, re.DOTALL)
    assert block and block[1] == (OWN / "mine.toml").read_text("utf-8")
    assert load_part(OWN / "mine.toml").limits["face_pressure"] == 7e6


def test_the_scene_takes_its_profiles_from_its_files():
    found = load_scene(OWN / "my-scene.toml")
    assert sum("of trace.csv" in text for text in found.notes) == 3
    assert found.vehicle.drag_area == pytest.approx(2.0 * 0.41 / 1.2, rel=0.05)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            "calibrate mine.toml rig.csv --fit roughness --error friction_torque=2% --error "
            "temperature=2K --error film_loss_load=3% --bounds roughness=0.2um:2um",
            "--set roughness=6.0",
        ),
        ("calibrate friction.csv", "decay_speed"),
        (
            "calibrate clutch stop.csv --inertia 0.25kg.m2 --drag-torque 2N.m "
            "--fit friction_scale,permeability",
            "friction_scale     0.92001",
        ),
        (
            "calibrate clutch monday.csv tuesday.csv --fit friction_scale,permeability "
            "--error friction_torque=1.5N.m",
            "2 engagements in 2 recordings",
        ),
        ("part check mine.toml", "MyWasher"),
        ("sweep washer --points measured.csv", "far_face_temperature"),
    ],
)
@pytest.mark.slow
def test_the_commands_of_the_pages_work_on_them(folder, capsys, words, said):
    assert main(words.split()) == 0
    assert said in capsys.readouterr().out


def test_what_a_train_has_of_its_own_is_named_as_in_its_file(tmp_path, capsys):
    text = Path("examples/ev-reducer.toml").read_text("utf-8")
    (tmp_path / "mine.toml").write_text(text.replace("section = 0.67", "section = 0.6"), "utf-8")
    assert main(["part", "check", str(tmp_path / "mine.toml")]) == 0
    said = capsys.readouterr().out
    assert "rotor.bearing_1_section" in said and "shaft_1" not in said
