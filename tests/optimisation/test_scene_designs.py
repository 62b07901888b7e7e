"""Designs of a gear shift: searched on the quick loop, shown as the shift runs them."""

import pytest

from thrustwasher import optimise
from thrustwasher.optimisation import scene_designs
from thrustwasher.optimisation.designs import Effort
from thrustwasher.shift import load_scene
from thrustwasher.shift.scene.variation import varied_scene

VARY = {"shift.duration": "0.05 s:0.6 s", "clutch.friction_scale": "0.8:1.2"}


@pytest.fixture
def quick(monkeypatch):
    effort = Effort(sample=8, starts=2, rounds=1, tries=12)
    monkeypatch.setattr(scene_designs.SceneDesigns, "effort", lambda *_: effort)


def test_the_file_of_the_best_shift_is_that_scene(quick, tmp_path):
    found = optimise("msl", vary=VARY, least="slip_energy", out=tmp_path, workers=1)
    read = load_scene(tmp_path / "best.toml")
    wanted = varied_scene(load_scene("msl"), found.best.values)
    assert (read.parts, read.shift_duration) == (wanted.parts, wanted.shift_duration)
    assert (tmp_path / "best.toml").read_text().startswith("# A design of scene 'msl'")


def test_the_least_slip_energy_takes_the_shortest_ramp(quick):
    found = optimise("msl", vary=VARY, least="slip_energy", workers=1)
    assert found.best.values["shift.duration"] == pytest.approx(0.05, abs=0.01)
    assert found.best.figures["slip_energy"] < found.start["slip_energy"]
    assert {"lock_time", "slip_energy"} <= found.best.figures.keys()


@pytest.mark.slow
def test_what_is_shown_is_what_the_shift_gives(quick, tmp_path):
    """With washers: the search plays their torque, the end solves them in every step."""
    import json
    import subprocess
    import sys

    vary = {"clutch.friction_scale": "0.9:1.1", "pressure.clutch.points.3": "300 kPa:340 kPa"}
    found = optimise("planetary", vary=vary, least="slip_energy", out=tmp_path, workers=1)
    words = ["shift", "--scene", tmp_path / "best.toml", "--json", "--out", tmp_path / "r"]
    done = subprocess.run(
        [sys.executable, "-m", "thrustwasher", *map(str, words)], capture_output=True, text=True
    )
    shown = json.loads(done.stdout)
    for name in ("slip_energy", "peak_jerk", "lock_time"):
        assert found.best.figures[name] == pytest.approx(shown[name], rel=1e-6)
