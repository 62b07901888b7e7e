"""The command map: build, list, check; wrong input in one line."""

import json
import zipfile

import pytest

from thrustwasher.cli import main
from thrustwasher.washer.map.look_up import WasherMap
from thrustwasher.washer.map.map_build import make_map
from thrustwasher.washer.map.map_file import plain, read_map
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import solve_washer

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
