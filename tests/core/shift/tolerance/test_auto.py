"""Levels requested by tolerance: words, a first run, the choice, and the run it leads to."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import PetroffWasher
from synthetic import WHOLE, level

from thrustwasher.errors import SolveError, Status
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.ladder.error_table import Axis
from thrustwasher.shift import load_scene, run_auto, with_fidelities
from thrustwasher.shift.checks.step_estimate import StepError
from thrustwasher.shift.tolerance import level_check, run_to_tolerance, selection
from thrustwasher.washer.parameters import SPEC

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


@pytest.mark.slow
def test_a_part_that_follows_heat_in_time_keeps_its_default_and_says_so():
    scene = load_scene("planetary-transient").with_options(stop_time=0.02)
    r = run_auto(with_fidelities(scene, ["washer=auto:0.01"]), made([]))
    assert any("errors are measured in steady states" in m for m in r.messages)


# The check after a run: washers that lie at chosen times, and what the guard makes of them.

GUARD_STOP = 0.3
TORQUE = SPEC.outputs[0].name


class Liar(PetroffWasher):
    """A Petroff washer whose torque, status or regime is false in spans of time [s]."""

    def __init__(self, factor=1.0, lies=(), outside=(), regime=(), fails=()):
        super().__init__(SPEC)
        self.factor, self.lies = factor, lies
        self.outside, self.regime, self.fails = outside, regime, fails
        self.now = 0.0

    def initialize(self, start_time, inputs):
        super().initialize(start_time, inputs)
        self.now = start_time
        if self._in(self.fails):
            raise SolveError("not converged")

    def step(self, t, h):
        self.now = t + h
        if self._in(self.fails):
            raise SolveError("not converged")
        super().step(t, h)

    def outputs(self):
        found = dict(zip(self.output_names, super().outputs(), strict=True))
        if self._in(self.lies):
            found[TORQUE] *= self.factor
        if self._in(self.outside):
            found["solver_status"] = float(Status.OUTSIDE_VERIFIED)
        if self._in(self.regime):
            found["regime"] = 2.0
        return list(found.values())

    def _in(self, spans):
        return any(a - 1e-9 <= self.now <= b + 1e-9 for a, b in spans)


@pytest.fixture
def guard_run(monkeypatch):
    """Run the start of a shift with washers of these kinds, ``map`` the first of its levels."""
    monkeypatch.setattr(selection, "levels_of", lambda *_: ["map", "field", "fine"])
    monkeypatch.setattr(run_to_tolerance, "guarded", lambda result, *_: result)

    def given(levels, **options):
        def make(name, part):
            if name != "washer":
                return DirectInstance(part.spec, parameters=part.parameters())
            kind = levels.get(part.fidelity, {})
            made.append((part.fidelity, Liar(**kind)))
            return made[-1][1]

        made = []
        known = {"map": object()} if options.get("guard") is False else {}
        monkeypatch.setattr(selection, "fresh_levels", lambda *_: known)
        monkeypatch.setattr(selection, "_errors", lambda *_: dict.fromkeys(known, 1e-3))
        scene = load_scene("planetary-sun").with_options(stop_time=GUARD_STOP)
        scene = replace(scene, parts={n: p for n, p in scene.parts.items() if n != "mesh"})
        found = run_auto(with_fidelities(scene, ["washer=auto:0.01"]), make, **options)
        return found, [i for level, i in made if level == "field"]

    return given


def test_an_honest_level_is_confirmed_at_thirty_points_spread_over_the_run(guard_run):
    r, (above,) = guard_run({})
    (check,) = r.guard.checks
    assert check.holds and check.worst.share == 0.0 and r.guard.again == []
    assert 25 <= check.points == above.calls + 1 <= 35
    times = [t for t, *_ in above.log]
    assert times[0] == 0.0 and np.diff(times).max() < 2.0 * GUARD_STOP / 25
    assert r.scene.parts["washer"].fidelity == "map"


def test_a_lie_is_found_and_the_part_runs_again_a_level_higher(guard_run):
    r, _ = guard_run({"map": {"factor": 1.1, "lies": [(0.12, 1.0)]}})
    first, second = r.guard.checks
    assert (first.fidelity, first.above, first.holds) == ("map", "field", False)
    assert first.worst.share == pytest.approx(0.1) and first.worst.time >= 0.12
    assert first.worst.served == pytest.approx(1.1 * first.worst.above)
    assert (second.fidelity, second.above, second.holds) == ("field", "fine", True)
    assert r.guard.again == ["run again with washer field"]
    assert r.signals[f"washer.{TORQUE}"] == pytest.approx(7.5e-5 * r.signals["washer.speed"])


def test_it_goes_on_to_the_last_level_and_stops_there(guard_run):
    lies = {"factor": 1.1, "lies": [(0.0, 1.0)]}
    r, _ = guard_run({"map": {"factor": 1.3, "lies": [(0.0, 1.0)]}, "field": lies})
    assert [c.above for c in r.guard.checks] == ["field", "fine"]
    assert len(r.guard.again) == 2 and r.scene.parts["washer"].fidelity == "fine"
    assert r.guard.earlier_seconds > 0.0


def test_a_lie_as_short_as_a_regime_is_found_where_the_regime_changes(guard_run):
    short = [(0.1505, 0.1625)]
    r, _ = guard_run({"map": {"factor": 1.1, "lies": short, "regime": short}})
    assert not r.guard.checks[0].holds


def test_a_level_that_says_it_is_outside_does_not_hold(guard_run):
    r, _ = guard_run({"map": {"outside": [(0.2, 0.21)]}})
    assert "from t = 0.2 s" in r.guard.checks[0].outside
    assert r.scene.parts["washer"].fidelity == "field"


def test_a_standstill_is_not_compared():
    """Without speed there is no torque in any level, and solving there is dear."""
    inputs = np.array([[1.0, 2.0], [1.0, 0.0], [1.0, 3.0], [1.0, 0.0]])
    assert level_check._moving(["load", "speed"], inputs).tolist() == [0, 2]
    assert level_check._moving(["load", "tilt"], inputs).tolist() == [0, 1, 2, 3]


def test_a_point_without_solution_is_named_and_the_others_count(guard_run):
    r, _ = guard_run({"field": {"fails": [(0.0, 0.0), (0.1, 0.12)]}})
    (check,) = r.guard.checks
    assert check.holds and check.points >= 20
    assert check.failed[0] == "at t = 0 s: not converged"
    assert any(text.startswith("at t = 0.1") for text in check.failed)
    assert f"{len(check.failed)} without a solution, first at t = 0 s" in r.guard.closing()


def test_a_higher_run_that_fails_loses_nothing(guard_run):
    lies = {"factor": 1.1, "lies": [(0.0, 1.0)]}
    r, _ = guard_run({"map": lies, "field": {"fails": [(0.1, 0.1)]}})
    assert r.scene.parts["washer"].fidelity == "map" and len(r.time) == 301
    assert r.guard.again == []
    assert "washer field: it failed" in r.guard.stopped and "t = 0.099" in r.guard.stopped
    assert r.guard.stopped in r.guard.closing()


def test_the_record_goes_into_json_and_into_one_line(guard_run):
    record = guard_run({"map": {"factor": 1.1, "lies": [(0.0, 1.0)]}})[0].guard
    told = record.as_dict()
    assert [c["holds"] for c in told["checks"]] == [False, True]
    assert told["checks"][0]["worst"]["output"] == TORQUE
    assert told["run_again"] == ["run again with washer field"] and told["stopped"] is None
    assert "worst difference 10 % (1 % allowed)" in told["closing"] and "\n" not in told["closing"]


def test_a_jump_that_comes_a_step_later_in_the_other_level_is_no_difference(guard_run):
    lies = {"factor": 3.0, "lies": [(0.1505, 1.0)], "regime": [(0.1505, 1.0)]}
    later = {"factor": 3.0, "lies": [(0.1525, 1.0)], "regime": [(0.1525, 1.0)]}
    assert guard_run({"map": lies, "field": later})[0].guard.checks[0].holds
