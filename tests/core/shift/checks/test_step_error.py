"""What a run says of its communication step is what a converged run shows."""

from dataclasses import replace
from functools import cache

import pytest
from scene_runs import instances, shift, slow_without_jit

from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.checks.step_error import errors_between, parts_of_a_step, step_error
from thrustwasher.shift.checks.step_estimate import StepError, excess
from thrustwasher.shift.scene.scene import MAX_STEPS

pytestmark = slow_without_jit


def made(scene, given):
    return {**instances(scene), **given}


@cache
def at(name, step):
    return shift(name, step=step, stop_time=2.3 if name == "msl" else None)


@pytest.mark.parametrize(
    ("name", "step"), [("planetary", 0.01), ("planetary", 0.02), ("msl", 5e-3), ("msl", 2e-3)]
)
@pytest.mark.slow
def test_predicted_errors_are_within_a_factor_of_two_of_the_true_ones(name, step):
    run, true = at(name, step), at(name, 2e-4 if name == "planetary" else 2.5e-4)
    said, known = step_error(run, made, cosimulate).errors(), errors_between(run, true, 1.0)
    for figure in ("lock_time", "heat"):
        least = 0.5 * known[figure] - 1e-5  # of errors that are hardly there
        assert least < said[figure] < 2.0 * known[figure]


@pytest.mark.slow
def test_a_step_that_is_too_long_is_told_with_one_that_does():
    found = step_error(at("planetary", 0.02), made, cosimulate)
    (words,) = found.warnings()
    assert found.relative > 0.01 and f"{1e3 * found.advice:g} ms would do" in words
    again = step_error(at("planetary", found.advice), made, cosimulate)
    assert again.suffices and again.warnings() == [] and again.advice == found.advice


def test_the_longest_step_is_a_twentieth_of_the_shift_or_of_what_follows_its_ramp():
    assert load_scene("planetary").longest_step == pytest.approx(1.1 / 20.0)
    scene = load_scene("brake-test")
    assert scene.longest_step == pytest.approx((1.6 - 0.1) / 20.0)
    jump = replace(load_scene("msl"), shift_duration=0.0)
    assert jump.longest_step == pytest.approx((5.0 - 2.0) / 20.0)


def test_a_run_that_is_locked_in_one_of_both_errs_by_all_of_it():
    run = at("msl", 5e-3)
    open_ = replace(run, key_figures=[f for f in run.key_figures if f.name != "lock_time"])
    assert errors_between(run, open_, 1.0)["lock_time"] == 1.0
    assert "lock_time" not in errors_between(open_, open_, 1.0)


def test_second_runs_stay_within_the_steps_a_run_may_have():
    scene = load_scene("msl")
    assert parts_of_a_step(scene, 1e-3, 5000) == 4.0
    assert parts_of_a_step(scene, 0.1, 50) == 128.0
    assert parts_of_a_step(scene, 1e-3, MAX_STEPS) == 0.5
    assert parts_of_a_step(scene, 1e-6, 100) == 0.5


def test_the_worst_error_beside_its_limit_counts():
    assert excess({"heat": 0.005, "peak_jerk": 0.1}) == pytest.approx(2.0)
    found = StepError(step=1.0, compared_with=0.25, advice=0.1, heat=0.02, lock_time=0.001)
    assert found.relative == 0.02 and "2 % in heat" in found.warnings()[0]
