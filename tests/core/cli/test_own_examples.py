"""The files that the pages of the commands name are there, and the commands work on them."""

import re
import shutil
from pathlib import Path

import pytest

from thrustwasher import load_part, load_scene
from thrustwasher.cli import main

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
