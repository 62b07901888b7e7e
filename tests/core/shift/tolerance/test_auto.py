"""Levels requested by tolerance: words, a first run, the choice, and the run it leads to."""

from dataclasses import replace

import pytest
from scene_runs import PetroffWasher
from synthetic import WHOLE, level

from thrustwasher.errors import SolveError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.ladder.error_table import Axis
from thrustwasher.shift import load_scene, run_auto, with_fidelities
from thrustwasher.shift.checks.step_estimate import StepError
from thrustwasher.shift.tolerance import run_to_tolerance, selection

STOP = 0.2
LEVELS = {"washer": ["map", "field", "fine"], "clutch": ["field", "fine"], "gearmesh": ["field"]}
SLOW = {
    **WHOLE,
    "load": Axis(1.0, 2000.0, "N", "log"),
    "speed": Axis(1.0, 1400.0, "rad/s", "log"),
    "oil_temperature": Axis(250.0, 400.0, "K", "linear"),
}


def made(log):
    """Return a maker of instances that writes down what it made; the washer is a stand-in."""

    def make(name, part):
        log.append((name, part.fidelity))
        if name == "washer":
            return PetroffWasher(part.spec)
        return DirectInstance(part.spec, parameters=part.parameters())

    return make


def auto(*wishes, stop=STOP):
    return with_fidelities(load_scene("planetary-sun").with_options(stop_time=stop), wishes)


def test_a_scene_file_asks_for_all_parts_and_for_one(tmp_path):
    file = tmp_path / "s.toml"
    file.write_text('base = "planetary-sun"\nfidelity = "auto:0.02"\n[mesh]\nfidelity = "fine"\n')
    found = {n: (p.fidelity, p.tolerance) for n, p in load_scene(file).parts.items()}
    assert found == {
        "transmission": ("rigid", None),
        "clutch": ("field", 0.02),
        "brake": ("field", 0.02),
        "washer": ("field", 0.02),
        "mesh": ("fine", None),
    }


def test_later_wishes_overrule_earlier_ones_and_auto_alone_is_one_percent():
    assert auto("auto").parts["washer"].tolerance == 0.01
    parts = auto("auto:0.02", "mesh=fine", "clutch=auto:0.1").parts
    assert parts["mesh"].fidelity == "fine" and parts["mesh"].tolerance is None
    assert (parts["brake"].tolerance, parts["clutch"].tolerance) == (0.02, 0.1)
    assert (
        auto("auto", "field").parts
        == load_scene("planetary-sun").with_options(stop_time=STOP).parts
    )


@pytest.fixture
def run(monkeypatch):
    """Run with a made-up table of errors of the washer; return result and what was made."""
    monkeypatch.setattr(selection, "levels_of", lambda spec, _: LEVELS[spec.key])

    def given(errors, wish="auto:0.01", steady=True, **options):
        known = {name: level(name, worst, box=SLOW) for name, worst in errors.items()}
        monkeypatch.setattr(
            selection, "fresh_levels", lambda key, _: known if key == "washer" else {}
        )
        if steady:
            monkeypatch.setattr(run_to_tolerance, "guarded", lambda result, *_: result)
        log = []
        return run_auto(auto(wish), made(log), **options), log

    return given


def levels(result):
    return {n: p.fidelity for n, p in result.scene.parts.items() if n != "transmission"}


USUAL = {"clutch": "field", "brake": "field", "mesh": "field"}


def test_the_first_run_has_the_cheapest_levels_and_counts_if_they_hold(run):
    r, log = run({"map": 8e-3, "field": 2e-3}, "auto:0.02")
    assert levels(r) == USUAL | {"washer": "map"}
    assert [level for name, level in log if name == "washer"] == ["map", "field"], "run, then check"
    assert [(c.part, c.fidelity, c.above) for c in r.guard.checks] == [
        ("clutch", "field", "fine"),
        ("brake", "field", "fine"),
        ("washer", "map", "field"),
    ]


def test_a_level_that_its_table_shows_to_be_too_coarse_is_left_out(run):
    r, _ = run({"map": 0.02, "field": 0.05, "fine": 1e-3})
    assert levels(r)["washer"] == "fine" and "washer" not in [c.part for c in r.guard.checks]
    assert {"  too coarse: map 2 %", "  too coarse: field 5 %"} <= set(r.selection.words())
    assert (
        levels(run({"map": 0.02, "field": 0.05, "fine": 1e-3}, "auto:0.03")[0])["washer"] == "map"
    )


def test_the_check_stands_in_for_the_factor_of_safety(run):
    errors = {"map": 8e-3, "field": 2e-3}
    assert levels(run(errors)[0])["washer"] == "map"
    assert levels(run(errors, guard=False)[0])["washer"] == "field"


def test_what_no_level_holds_is_an_error_that_names_the_part(run):
    with pytest.raises(
        SolveError, match=r"part 'washer', friction_torque: no fidelity level reaches 1 %"
    ):
        run({"map": 0.02, "field": 0.05, "fine": 0.03})


def test_without_a_table_the_check_decides_and_without_it_the_default_serves(run):
    r, _ = run({})
    assert levels(r)["washer"] == "map" and len(r.guard.checks) == 3
    r, _ = run({}, guard=False)
    assert levels(r)["washer"] == "field" and r.guard is None


def test_a_pack_that_its_finer_level_does_not_confirm_runs_again_with_it(run):
    r, _ = run({"map": 1e-6}, "auto:1e-5")
    assert levels(r)["clutch"] == "fine" and "clutch fine" in r.guard.again[0]
    assert [c.run for c in r.guard.checks if c.part == "washer"] == [1], "it holds: once is enough"


@pytest.mark.slow
def test_a_washer_that_is_not_steady_in_the_run_is_run_again_in_time(run):
    r, _ = run({}, "washer=auto:0.01", steady=False)
    assert r.scene.parts["washer"].params.thermal_mode == "transient"
    assert r.scene.parts["washer"].fidelity == "field" and r.in_time == {}
    assert any("repeated with thermal_mode transient" in m for m in r.messages)
    assert r.step_error is not None and "thermal_mode" not in " ".join(r.warnings)
    r, _ = run({}, "washer=auto:0.01", steady=False, guard=False)
    assert r.scene.parts["washer"].params.thermal_mode == "quasi_steady" and r.step_error is None


def test_every_part_says_why(run):
    words = run({"map": 8e-3})[0].selection.words()
    assert "washer: map, friction_torque within 0.8 % (asked 1 %)" in words
    assert "clutch: field, to be compared with fine (asked 0.6 %)" in words
    assert "mesh: field, its last fidelity level; no table of errors speaks here" in words


def test_the_inputs_are_those_of_the_run_while_the_part_moves(run):
    r, _ = run({"map": 1e-3}, "auto:0.02")
    box = {p.part: p.box for p in r.selection.parts}["washer"]
    speed = r.signals["washer.speed"]
    assert box["speed"] == (speed[speed != 0.0].min(), speed.max())
    assert box["tilt"] == (1.6e-3, 1.6e-3) and box["oil_temperature"] == (297.15, 297.15)


def test_a_step_too_long_for_the_tolerance_is_said_with_one_that_would_do(monkeypatch, run):
    error = StepError(step=1e-3, compared_with=2.5e-4, advice=1e-3, heat=0.006)
    monkeypatch.setattr(
        run_to_tolerance, "guarded", lambda result, *_: replace(result, step_error=error)
    )
    words = "it errs by about 0.6 %, more than its share of 0.3 %; 0.0005 s would do"
    assert any(words in m for m in run({}, steady=False)[0].messages)
    assert not any("share" in m for m in run({}, "auto:0.02", steady=False)[0].messages)


@pytest.mark.slow
def test_a_scene_without_wishes_runs_as_it_stands():
    r = run_auto(auto("field"), made([]))
    assert r.selection is None and r.guard is None


def test_a_tolerance_asked_for_leaves_nothing_open_in_the_result(run):
    r, _ = run({"map": 1e-3})
    assert all(p.tolerance is None for p in r.scene.parts.values())
    told = r.as_dict()["selection"]
    assert told["parts"][0]["part"] == "clutch" and told["reasons"] == r.selection.words()
    assert replace(r, selection=None).as_dict()["selection"] is None


def test_a_part_that_follows_heat_in_time_keeps_its_default_and_says_so():
    scene = load_scene("planetary-transient").with_options(stop_time=0.02)
    r = run_auto(with_fidelities(scene, ["washer=auto:0.01"]), made([]))
    assert any("errors are measured in steady states" in m for m in r.messages)
