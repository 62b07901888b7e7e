"""The check after a run: washers that lie at chosen times, and what the guard makes of them."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import PetroffWasher

from thrustwasher.errors import SolveError, Status
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import load_scene, run_auto, with_fidelities
from thrustwasher.shift.tolerance import level_check, run_to_tolerance, selection
from thrustwasher.washer.parameters import SPEC

STOP = 0.3
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
def run(monkeypatch):
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
        scene = load_scene("planetary-sun").with_options(stop_time=STOP)
        scene = replace(scene, parts={n: p for n, p in scene.parts.items() if n != "mesh"})
        found = run_auto(with_fidelities(scene, ["washer=auto:0.01"]), make, **options)
        return found, [i for level, i in made if level == "field"]

    return given


def test_an_honest_level_is_confirmed_at_thirty_points_spread_over_the_run(run):
    r, (above,) = run({})
    (check,) = r.guard.checks
    assert check.holds and check.worst.share == 0.0 and r.guard.again == []
    assert 25 <= check.points == above.calls + 1 <= 35
    times = [t for t, *_ in above.log]
    assert times[0] == 0.0 and np.diff(times).max() < 2.0 * STOP / 25
    assert r.scene.parts["washer"].fidelity == "map"


def test_a_lie_is_found_and_the_part_runs_again_a_level_higher(run):
    r, _ = run({"map": {"factor": 1.1, "lies": [(0.12, 1.0)]}})
    first, second = r.guard.checks
    assert (first.fidelity, first.above, first.holds) == ("map", "field", False)
    assert first.worst.share == pytest.approx(0.1) and first.worst.time >= 0.12
    assert first.worst.served == pytest.approx(1.1 * first.worst.above)
    assert (second.fidelity, second.above, second.holds) == ("field", "fine", True)
    assert r.guard.again == ["run again with washer field"]
    assert r.signals[f"washer.{TORQUE}"] == pytest.approx(7.5e-5 * r.signals["washer.speed"])


def test_it_goes_on_to_the_last_level_and_stops_there(run):
    lies = {"factor": 1.1, "lies": [(0.0, 1.0)]}
    r, _ = run({"map": {"factor": 1.3, "lies": [(0.0, 1.0)]}, "field": lies})
    assert [c.above for c in r.guard.checks] == ["field", "fine"]
    assert len(r.guard.again) == 2 and r.scene.parts["washer"].fidelity == "fine"
    assert r.guard.earlier_seconds > 0.0


def test_a_lie_as_short_as_a_regime_is_found_where_the_regime_changes(run):
    short = [(0.1505, 0.1625)]
    r, _ = run({"map": {"factor": 1.1, "lies": short, "regime": short}})
    assert not r.guard.checks[0].holds


def test_a_level_that_says_it_is_outside_does_not_hold(run):
    r, _ = run({"map": {"outside": [(0.2, 0.21)]}})
    assert "from t = 0.2 s" in r.guard.checks[0].outside
    assert r.scene.parts["washer"].fidelity == "field"


def test_a_standstill_is_not_compared():
    """Without speed there is no torque in any level, and solving there is dear."""
    inputs = np.array([[1.0, 2.0], [1.0, 0.0], [1.0, 3.0], [1.0, 0.0]])
    assert level_check._moving(["load", "speed"], inputs).tolist() == [0, 2]
    assert level_check._moving(["load", "tilt"], inputs).tolist() == [0, 1, 2, 3]


def test_a_point_without_solution_is_named_and_the_others_count(run):
    r, _ = run({"field": {"fails": [(0.0, 0.0), (0.1, 0.12)]}})
    (check,) = r.guard.checks
    assert check.holds and check.points >= 20
    assert check.failed[0] == "at t = 0 s: not converged"
    assert any(text.startswith("at t = 0.1") for text in check.failed)
    assert f"{len(check.failed)} without a solution, first at t = 0 s" in r.guard.closing()


def test_a_higher_run_that_fails_loses_nothing(run):
    lies = {"factor": 1.1, "lies": [(0.0, 1.0)]}
    r, _ = run({"map": lies, "field": {"fails": [(0.1, 0.1)]}})
    assert r.scene.parts["washer"].fidelity == "map" and len(r.time) == 301
    assert r.guard.again == []
    assert "washer field: it failed" in r.guard.stopped and "t = 0.099" in r.guard.stopped
    assert r.guard.stopped in r.guard.closing()


def test_the_record_goes_into_json_and_into_one_line(run):
    record = run({"map": {"factor": 1.1, "lies": [(0.0, 1.0)]}})[0].guard
    told = record.as_dict()
    assert [c["holds"] for c in told["checks"]] == [False, True]
    assert told["checks"][0]["worst"]["output"] == TORQUE
    assert told["run_again"] == ["run again with washer field"] and told["stopped"] is None
    assert "worst difference 10 % (1 % allowed)" in told["closing"] and "\n" not in told["closing"]


def test_a_jump_that_comes_a_step_later_in_the_other_level_is_no_difference(run):
    lies = {"factor": 3.0, "lies": [(0.1505, 1.0)], "regime": [(0.1505, 1.0)]}
    later = {"factor": 3.0, "lies": [(0.1525, 1.0)], "regime": [(0.1525, 1.0)]}
    assert run({"map": lies, "field": later})[0].guard.checks[0].holds
