"""Designs of a gear shift: searched on the quick loop, shown as the shift runs them."""

import pytest
from scene_runs import NOMINAL, changed

from thrustwasher import optimise
from thrustwasher.shift import load_scene
from thrustwasher.shift.scene.variation import varied_scene
from thrustwasher.studio.evaluators.scene import scene_evaluator
from thrustwasher.studio.optimisation import whole_search
from thrustwasher.studio.optimisation.designs import Budget

VARY = {"shift.duration": "0.05 s:0.6 s", "clutch.friction_scale": "0.8:1.2"}


@pytest.fixture
def quick(monkeypatch):
    budget = Budget(sample=8, starts=2, rounds=1, tries=12)
    monkeypatch.setattr(whole_search, "budget_of", lambda *_: budget)


@pytest.mark.slow
def test_the_file_of_the_best_shift_is_that_scene(quick, tmp_path):
    found = optimise("msl", vary=VARY, minimise="slip_energy", out=tmp_path, workers=1)
    read = load_scene(tmp_path / "best.toml")
    wanted = varied_scene(load_scene("msl"), found.best.values)
    assert (read.parts, read.shift_duration) == (wanted.parts, wanted.shift_duration)
    assert (tmp_path / "best.toml").read_text().startswith("# A design of scene 'msl'")


@pytest.mark.slow
def test_the_least_slip_energy_takes_the_shortest_ramp(quick):
    found = optimise("msl", vary=VARY, minimise="slip_energy", workers=1)
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
    found = optimise("planetary", vary=vary, minimise="slip_energy", out=tmp_path, workers=1)
    words = ["shift", "--scene", tmp_path / "best.toml", "--json", "--out", tmp_path / "r"]
    done = subprocess.run(
        [sys.executable, "-m", "thrustwasher", *map(str, words)], capture_output=True, text=True
    )
    shown = json.loads(done.stdout)
    for name in ("slip_energy", "peak_jerk", "lock_time"):
        assert found.best.figures[name] == pytest.approx(shown[name], rel=1e-6)


@pytest.mark.slow
def test_the_step_is_shortened_where_its_error_is_as_large_as_the_gain(tmp_path):
    """At 1 ms the jerk of this design errs by about 1 %."""
    designs = scene_evaluator(changed(tmp_path, NOMINAL))
    row = {"pressure.clutch.points.3": 395e3, "pressure.clutch.times.3": 0.53}
    errs = designs._step_error(row).peak_jerk
    step, error = designs.shorter_step([row], ["peak_jerk"], errs)
    assert step == 0.5e-3 and "step = 0.0005" in designs.with_step(step).file(row)
    assert "with communication steps of 1 ms the best design errs by about" in error
    assert designs.shorter_step([row], ["peak_jerk"], 0.2)[0] is None
    step, error = designs.shorter_step([row], ["slip_energy"], 0.01)
    assert step is None and "in heat" in error and "jerk" not in error
