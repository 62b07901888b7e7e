"""Step doubling: error control, rollback that leaves no trace, events as communication points."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scene_runs import NO_DRAG, PetroffWasher, instances, shift

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.report.shift.shift_record import record_of
from thrustwasher.report.shift.shift_report import shift_page
from thrustwasher.shift import load_scene, run_auto, run_shift, with_fidelities
from thrustwasher.shift.masters.step_doubling import Doubling
from thrustwasher.shift.run import connected, run_adaptive

MASTER = "step-doubling"


@cache
def doubled(tolerance=1e-4, **options):
    given = {"master": MASTER, "master_tolerance": tolerance, **options}
    return shift("planetary-sun", parts=NO_DRAG, **given)


@cache
def exact():
    """Return figures that err a twentieth of what is asked for here."""
    return shift("planetary-sun", parts=NO_DRAG, step=1e-3).figures


def test_a_smaller_tolerance_buys_a_smaller_error_with_more_steps():
    runs = [doubled(tolerance) for tolerance in (1e-3, 1e-4, 1e-5)]
    errors = [abs(run.figures["lock_time"] - exact()["lock_time"]) for run in runs]
    assert errors[0] > 2.0 * errors[1] > 4.0 * errors[2]
    assert errors[2] < 2e-4
    counts = [run.steps.accepted for run in runs]
    assert counts[0] < counts[1] < counts[2] < 1500


def test_steps_are_long_where_nothing_happens_and_short_where_torques_turn():
    run = doubled()
    lengths, after = np.diff(run.time), run.time[:-1] > run.figures["lock_time"] + 0.1
    assert run.time[0] == run.scene.start_time and run.time[-1] == run.scene.stop_time
    assert (lengths > 0.0).all() and lengths[after].min() > 10.0 * lengths.min()


def test_the_corners_of_the_ramp_are_communication_points():
    run = doubled()
    start = run.scene.shift_start
    assert start in run.time and start + run.scene.shift_duration in run.time


@pytest.mark.parametrize("start", [0.1 + 0.2, 1.0 / 3.0, 0.7 - 1e-17])
def test_a_run_ends_at_its_stop_time_to_the_bit(start):
    """Lengths that are summed up miss it; no step of rounding's size may follow."""
    scene = replace(doubled().scene, start_time=start, stop_time=start + 0.1 / 3.0)
    run = run_shift(scene, instances(scene))
    assert run.time[-1] == scene.stop_time
    assert run.steps.shortest > 1e-5


def test_lock_up_becomes_a_communication_point():
    run = doubled()
    lock = run.figures["lock_time"]
    i = int(np.argmin(np.abs(run.time - lock)))
    assert abs(run.time[i] - lock) < 1e-9
    assert run.signals["transmission.clutch_speed"][i] == 0.0
    assert run.signals["transmission.clutch_locked"][i] == 1.0
    assert run.signals["transmission.clutch_locked"][i - 1] == 0.0
    assert run.steps.located >= 1


def test_a_slip_that_turns_becomes_a_communication_point():
    """Also where the transmission does not know what a lock-up is."""
    lock = shift("brake-test-sample").figures["lock_time"]
    run = shift(
        "brake-test-sample", master=MASTER, master_tolerance=1e-4, stop_time=lock + 4e-3,
        parts={"transmission": {"coupling": "torque"}, "brake": {"speed_smoothing": 1e-3}},
    )  # fmt: skip
    slip = run.signals["transmission.brake_speed"]
    i = int(np.argmax(slip < 0.0))
    assert run.steps.located >= 1
    assert -1e-3 < slip[i] < 0.0 and slip[i - 1] > 1.0
    assert run.time[i] == pytest.approx(lock, abs=3e-3)


class Hesitant(Doubling):
    """Makes every attempt twice."""

    def _attempt(self, t, goal, start):
        points, located = len(self.time), self._located
        super()._attempt(t, goal, start)
        del self.time[points:]
        self._located = located
        self._back.give_back(start)
        return super()._attempt(t, goal, start)


def test_a_step_rolled_back_leaves_no_trace(monkeypatch):
    """States of all parts and the master's own values: the same to the bit."""
    scene = load_scene("planetary-sun").with_options(master=MASTER, stop_time=0.7)
    scene = replace(scene, parts={n: p for n, p in scene.parts.items() if n != "washer"})
    found = []
    for kind in (Doubling, Hesitant):
        monkeypatch.setattr("thrustwasher.shift.run.Doubling", kind)
        system = connected(scene, instances(scene))
        system.initialize(scene.start_time)
        run, steps = run_adaptive(scene, system, None)
        found.append((run.time, run.recorder.rows, steps))
    assert np.array_equal(found[0][0], found[1][0])
    assert np.array_equal(found[0][1], found[1][1])
    assert found[0][2] == found[1][2]


def test_accepted_and_rejected_steps_are_told():
    run = doubled()
    told = json.loads(json.dumps(run.as_dict()))
    steps = told["steps"]
    assert steps["accepted"] == len(run.time) - 1 and steps["rejected"] > 0
    assert steps["longest"] == told["step"] == pytest.approx(np.diff(run.time).max())
    assert told["master_tolerance"] == 1e-4
    calls = {c["part"]: c["steps"] for c in told["cost"]}
    assert calls["transmission"] > 1.5 * steps["accepted"]
    fixed = shift("msl", step=0.005).as_dict()
    assert fixed["steps"]["rejected"] == 0 and fixed["steps"]["accepted"] == 1000
    assert fixed["master_tolerance"] is None


def test_the_report_tells_the_steps():
    page = shift_page(record_of(doubled()))
    texts = " ".join(text for section in page.sections for text in section.texts)
    assert "tries rolled back" in texts


def test_the_energy_book_closes():
    assert doubled().energy["residual_share"] < 1e-8
    fine = doubled(1e-5).energy["coupling_difference_share"]
    assert fine < 0.5 * doubled().energy["coupling_difference_share"] < 1e-3


class Delicate(DirectInstance):
    """Fails in steps that are long."""

    def step(self, t, h):
        if h > 1e-3:
            raise SolveError(f"no solution over {h:g} s")
        super().step(t, h)


def test_a_step_that_cannot_be_solved_is_tried_shorter():
    scene = replace(doubled().scene, stop_time=0.05)
    parts = instances(scene)
    brake = scene.parts["brake"]
    parts["brake"] = Delicate(brake.spec, parameters=brake.parameters())
    run = run_shift(scene, parts)
    assert run.steps.longest <= 1e-3 and run.steps.rejected > 0


class Jumping(DirectInstance):
    """Holds 50 N m more in every other step, however short that is."""

    def outputs(self):
        values = super().outputs()
        values[self.output_names.index("torque_capacity")] += 50.0 * (self.calls % 2)
        return values


def test_steps_that_no_length_makes_good_are_counted(monkeypatch):
    monkeypatch.setattr("thrustwasher.shift.masters.step_doubling.SHORTEST", 1.0 / 32.0)
    scene = replace(doubled().scene, stop_time=2e-4, step=1e-4, master_tolerance=1e-9)
    parts = instances(scene)
    clutch = scene.parts["clutch"]
    parts["clutch"] = Jumping(clutch.spec, parameters=clutch.parameters())
    run = run_shift(scene, parts)
    assert run.steps.forced > 0
    assert any("err more than master_tolerance" in message for message in run.warnings)


def test_what_needs_fixed_steps_is_refused_by_name():
    scene = load_scene("planetary-sun").with_options(master=MASTER)
    chosen = with_fidelities(scene, ["auto:0.01"])
    with pytest.raises(ParameterError, match="masters with fixed steps"):
        run_auto(chosen, lambda name, part: None)
    with pytest.raises(ParameterError, match="compiled = True with master = 'step-doubling'"):
        run_shift(doubled().scene, instances(doubled().scene), compiled=True)


@pytest.mark.parametrize("master", [MASTER, "linearly-implicit"])
def test_a_part_that_cannot_go_back_is_named(master):
    """So is one that can give no slope either."""
    scene = load_scene("planetary-sun").with_options(master=master, stop_time=0.01)
    parts = {n: p for n, p in scene.parts.items() if n != "mesh"}
    scene = replace(scene, parts=parts)
    made = instances(scene)
    assert isinstance(made["washer"], PetroffWasher)
    with pytest.raises((ParameterError, SolveError), match=f"{master}.*washer"):
        run_shift(scene, made)
