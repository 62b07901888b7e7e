"""Slopes over the macro step: what the coupling of packs and driveline is worth."""

import math

import pytest

from lab import macro_steps
from lab.macro_steps import Way, complaint, figures, run

NAMES = ("lock_time", "slip_energy", "peak_temperature")


@pytest.fixture(scope="module")
def limit():
    return macro_steps.small_step_limit(quick=True)


def errors(way, step, limit):
    found = figures(run(way, step))
    return [abs(found[name] - limit[0][name]) for name in NAMES]


def slopes(way, steps, limit):
    coarse, fine = (errors(way, step, limit) for step in steps)
    ratio = math.log(steps[0] / steps[1])
    return [math.log(a / b) / ratio for a, b in zip(coarse, fine, strict=True)]


def test_both_masters_tend_to_one_limit(limit):
    truth, apart = limit
    assert apart["lock_time"] < 1e-5 * truth["lock_time"]
    assert apart["slip_energy"] < 5e-5 * truth["slip_energy"]


@pytest.mark.parametrize("master", ["gauss-seidel", "jacobi"])
def test_held_capacities_couple_with_order_one(master, limit):
    lock, _, peak = slopes(Way(master, extrapolation=False), (8e-3, 2e-3), limit)
    assert lock == pytest.approx(1.0, abs=0.15) and peak == pytest.approx(1.0, abs=0.15)


def test_extrapolated_capacities_couple_with_order_two_nearly(limit):
    """Lock-up and the release are corners: each run meets them elsewhere in its steps."""
    found = slopes(Way("jacobi"), (2e-3, 1e-3), limit)
    assert all(1.6 < slope < 2.4 for slope in found)


def test_a_handed_friction_torque_chatters_after_lock_up():
    result = run(Way("gauss-seidel", "torque"), 1e-3)
    assert "turns round" in complaint(result, figures(result))
    located = run(Way("gauss-seidel"), 1e-3)
    assert complaint(located, figures(located)) == ""


@pytest.mark.slow
def test_torques_that_look_ahead_hand_over_without_chatter(limit):
    """An eighth of the step, less than a twentieth of the error in lock-up."""
    way = Way("linearly-implicit", "torque")
    result = run(way, 2e-3)
    assert complaint(result, figures(result)) == ""
    found = [abs(errors(way, step, limit)[0]) for step in (8e-3, 1e-3)]
    assert found[1] < 0.05 * found[0] < 0.002
