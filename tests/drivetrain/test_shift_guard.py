"""A guarded run: washers that lie at chosen times, and what the guard makes of them."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import PetroffWasher, instances

from thrustwasher.drivetrain import load_scene, run_shift
from thrustwasher.drivetrain.blend import Blend
from thrustwasher.drivetrain.guard import Guard
from thrustwasher.drivetrain.guard_plan import Plan, Scale
from thrustwasher.drivetrain.loop import PythonLoop
from thrustwasher.drivetrain.shift import _laid_out, connected
from thrustwasher.errors import SolveError, Status
from thrustwasher.models.washer_params import SPEC

H, STOP, EVERY = 1e-3, 0.12, (10, 2)
TORQUE = SPEC.outputs[0].name


class Liar(PetroffWasher):
    """A Petroff washer whose torque, status and regime are false in spans of time [s]."""

    def __init__(self, factor=1.0, lies=(), outside=(), regime=(), fails=()):
        super().__init__(SPEC)
        self.factor, self.lies = factor, lies
        self.outside, self.regime, self.fails = outside, regime, fails
        self.now = 0.0

    def step(self, t, h):
        if self._in(self.fails, t + h):
            raise SolveError("not converged")
        super().step(t, h)
        self.now = t + h

    def outputs(self):
        found = dict(zip(self.output_names, super().outputs(), strict=True))
        if self._in(self.lies, self.now):
            found[TORQUE] *= self.factor
        if self._in(self.outside, self.now):
            found["solver_status"] = float(Status.OUTSIDE_VERIFIED)
        if self._in(self.regime, self.now):
            found["regime"] = 2.0
        return list(found.values())

    @staticmethod
    def _in(spans, t):
        return any(a - 1e-9 <= t <= b + 1e-9 for a, b in spans)


def scene(stop=STOP):
    """Return the first steps of the default shift without meshes."""
    found = load_scene("planetary").with_options(stop_time=stop)
    return replace(found, parts={n: p for n, p in found.parts.items() if n != "mesh"})


def plan(above, **options):
    return Plan(**{
        "base": "map", "above": "field", "instance": above, "tolerance": 0.006, "every": EVERY,
        "scales": [Scale(TORQUE, 1e-3)], **options,
    })  # fmt: skip


def guarded(base, above=None, stop=STOP, **options):
    """Run with one washer serving and another above it."""
    parts = instances(scene(stop)) | {"washer": base}
    return run_shift(scene(stop), parts, guards={"washer": plan(above or Liar(), **options)})


def test_an_honest_rung_serves_throughout_and_looks_are_rare():
    base, above = Liar(), Liar()
    r = guarded(base, above)
    (post,) = r.guard.posts
    assert r.guard.switches == [] and post.worst == 0.0
    assert post.shares == {"map": 1.0, "field": 0.0}
    assert post.checks == above.calls == 11, "every tenth of 120 steps, the last point apart"
    assert base.calls == 120


def test_looks_change_no_number():
    watched, plain = guarded(Liar()), run_shift(scene(), instances(scene()))
    assert all(np.array_equal(watched.signals[k], v) for k, v in plain.signals.items())


def test_a_lie_is_found_at_the_next_look_and_the_rung_above_takes_over():
    r = guarded(Liar(1.1, lies=[(0.035, 1.0)]))
    (switch,) = r.guard.switches
    assert switch.time == pytest.approx(0.040)
    assert (switch.part, switch.before, switch.after) == ("washer", "map", "field")
    assert (switch.reason, switch.output) == ("difference", TORQUE)
    assert switch.served == pytest.approx(1.1 * switch.other)
    torque, speed = (r.signals[f"washer.{n}"] for n in (TORQUE, "speed"))
    honest = 7.5e-5 * speed
    assert torque[40] == pytest.approx(1.1 * honest[40])
    assert torque[41] == pytest.approx(1.05 * honest[41]), "one step with the mean of both"
    assert torque[42:] == pytest.approx(honest[42:])


def test_it_comes_back_once_the_lie_is_over():
    base, above = Liar(1.1, lies=[(0.025, 0.05)]), Liar()
    r = guarded(base, above)
    first, second = r.guard.switches
    assert first.time == pytest.approx(0.030) and second.reason == "calm"
    # Looks every second step from 0.031 on; the tenth calm one after 0.05 is at 0.069.
    assert second.time == pytest.approx(0.069)
    (post,) = r.guard.posts
    assert [c.rung for c in post.courses] == ["map", "field", "map"]
    assert post.courses[0].end == post.courses[1].start == pytest.approx(0.031)
    assert sum(post.shares.values()) == pytest.approx(1.0)


def test_a_lie_that_comes_and_goes_does_not_make_it_chatter():
    lies = [(a, a + 0.003) for a in np.arange(0.02, 0.12, 0.015)]
    assert [s.reason for s in guarded(Liar(1.1, lies=lies)).guard.switches] == ["difference"]


def test_a_rung_that_says_it_is_outside_is_replaced_at_that_point():
    (switch,) = guarded(Liar(outside=[(0.033, 1.0)])).guard.switches
    assert (switch.time, switch.reason) == (pytest.approx(0.033), "outside")


def test_no_step_is_made_alone_with_inputs_outside_the_box():
    """The washer slows down as the clutch closes; below 400 rad/s it was not verified."""
    stop = 0.2
    r = guarded(Liar(2.0, lies=[(0.0, 9.0)]), stop=stop, tolerance=10.0,
                box={"speed": (400.0, 500.0)})  # fmt: skip
    (switch,) = r.guard.switches
    assert switch.reason == "outside"
    torque, speed = (r.signals[f"washer.{n}"] for n in (TORQUE, "speed"))
    alone = torque == 2.0 * 7.5e-5 * speed
    assert speed.min() < 400.0
    assert (speed[alone] >= 400.0).all()


def test_a_change_of_regime_is_looked_at_before_the_stride_is_over():
    above = Liar()
    guarded(Liar(regime=[(0.0455, 0.0535)]), above, every=(40, 2))
    assert [round(t + h, 6) for t, h, *_ in above.log] == [0.04, 0.05, 0.06, 0.1]
    # 0.046: brought forward to a quarter of the stride after the last look; 0.054 likewise.


def test_the_first_look_may_come_before_its_stride_is_over():
    above = Liar()
    guarded(Liar(), above, every=(100, 2), first=30)
    assert [round((t + h) / H) for t, h, *_ in above.log] == [30]


def test_a_standstill_is_not_looked_at():
    """Without speed there is no torque in any rung, and solving there is dear."""
    above, stop = Liar(), 0.75
    r = guarded(Liar(), above, stop=stop)
    speed = r.signals["washer.speed"]
    looked = [round((t + h) / H) for t, h, *_ in above.log]
    assert (speed == 0.0).sum() > 50
    assert looked and all(speed[i] != 0.0 for i in looked)
    assert (speed[max(looked) + 10 :] == 0.0).all(), "to the end of motion"


def test_the_rung_above_follows_in_strides_with_the_inputs_of_the_last_step():
    above = Liar()
    r = guarded(Liar(), above)
    for k, (t, h, load, *_) in enumerate(above.log):
        assert (t, h) == (pytest.approx(0.01 * k), pytest.approx(0.01))
        assert load == r.signals["washer.load"][10 * (k + 1)]


def test_a_look_without_solution_is_counted_and_the_run_goes_on():
    r = guarded(Liar(1.1, lies=[(0.0, 1.0)]), Liar(fails=[(0.0, 0.045)]))
    (post,) = r.guard.posts
    assert post.failed == 4
    (switch,) = r.guard.switches
    assert switch.time == pytest.approx(0.050)


def test_cost_is_told_for_each_rung_and_without_looks():
    r = guarded(Liar(1.1, lies=[(0.035, 1.0)]))
    found = {c.fidelity: c.steps for c in r.cost if c.part == "washer"}
    assert found == {"map": 41, "field": 80}, "both in the step in which they are mixed"
    assert sum(c.wall_time for c in r.cost) + r.guard.seconds + r.overhead == pytest.approx(
        r.wall_time
    )


def test_the_log_goes_into_json_and_into_one_line():
    log = guarded(Liar(1.1, lies=[(0.035, 1.0)])).guard
    told = log.as_dict()
    assert told["switches"][0]["reason"] == "difference"
    assert told["parts"][0]["checks"] == log.posts[0].checks
    assert "washer: map" in log.closing() and "looks at field" in log.closing()
    assert "\n" not in log.closing()


def test_a_blend_of_passive_torques_is_passive_and_between_both():
    old, new = Liar(), Liar(1.5, lies=[(0.0, 9.0)], regime=[(0.0, 9.0)])
    both = Blend(SPEC, old, new)
    for speed in (-300.0, -1.0, 0.0, 2.0, 400.0):
        both.set_inputs([100.0, speed, 1.6e-3, 300.0])
        both.step(0.0, H)
        mixed = dict(zip(both.output_names, both.outputs(), strict=True))
        torques = [dict(zip(i.output_names, i.outputs(), strict=True))[TORQUE] for i in (old, new)]
        assert mixed[TORQUE] * speed >= 0.0
        assert min(torques) <= mixed[TORQUE] <= max(torques)
        assert mixed["regime"] == 2.0, "what is no number comes from the new one"


def test_a_master_that_comes_back_to_a_point_finds_the_guard_as_it_was():
    made = instances(scene()) | {"washer": Liar(1.1, lies=[(0.035, 0.05)])}
    system = connected(scene(), made)
    run = _laid_out(scene(), system, [])
    system.initialize(0.0)
    run.recorder.keep(0)
    guard = Guard(run, {"washer": plan(Liar())}, PythonLoop)

    def states():
        return {n: i.get_state() for n, i in made.items() if hasattr(i, "get_state")}

    def go(i, stop):
        while i < stop:
            i = guard.advance(i, stop)
        return i

    point = go(0, 38)
    held, kept = guard.hold(), states()
    go(point, 110)
    first, rows = list(guard.switches), run.recorder.rows.copy()
    assert [s.reason for s in first] == ["difference", "calm"]
    guard.give_back(held)
    for name, state in kept.items():
        made[name].set_state(state)
    run.recorder.give_back(run.recorder.rows[point])
    assert guard.switches == []
    go(point, 110)
    assert guard.switches == first
    assert np.array_equal(run.recorder.rows[:110], rows[:110])
