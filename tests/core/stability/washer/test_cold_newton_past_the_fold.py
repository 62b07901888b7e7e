"""Solved from nothing beyond the fold, where only the contact branch is left.

Hazard: Newton's method for a given load starts on a thick film and walks down to where the film
    was lost: there is no root, the residual has a minimum value above zero, and the method stops
    with the washer neither floating nor lying. "Not converged" is then read as distress.
Formula: at the ghost of the fold the residual is load - load_lost > 0 and its slope over the film
    thickness is 0: the step is infinite, and a limited one goes nowhere.
Cure: a solution exists at every load; the path goes on in film thickness through the fold and the
    unstable branch to the contact branch.
"""

import numpy as np
import pytest
from curves import traced

from thrustwasher import Status, WasherParams, solve_washer

from washer_runs import is_sound, solve  # isort: skip


@pytest.mark.parametrize("tilt", [1e-3, pytest.param(2e-3, marks=pytest.mark.slow), 3e-3])
@pytest.mark.parametrize("speed", [50.0, 300.0, 545.0, 953.0, 1367.0])
def test_there_is_an_answer_at_every_load(speed, tilt):
    for load in np.geomspace(50.0, 10_000.0, 9):
        r = solve(load=float(load), speed=speed, tilt=tilt)
        assert is_sound(r), (load, speed, tilt)


@pytest.mark.parametrize("share", [1.0 + 1e-6, 1.0001, 1.01, 1.2, 2.0])
def test_just_past_the_fold_the_answer_is_that_of_the_curve(share):
    curve = traced()
    load = share * curve.folds[0].load
    r = solve(load=load)
    assert is_sound(r) and r.branch == "contact"
    contact = [p for p in curve.points if p.branch == "contact"]
    near = min(contact, key=lambda p: abs(p.load - load))
    point = {"load": near.load, "speed": 545.0, "tilt": 0.002}
    there = solve_washer(WasherParams(), **point, start=r)
    assert there.friction_torque == pytest.approx(near.friction_torque, rel=1e-5)


def test_not_converged_is_never_the_word_for_distress():
    """Statuses below 10 are solutions; none of these solves needs another."""
    for load in (960.0, 970.0, 1100.0, 1500.0, 9000.0):
        r = solve(load=load, throw=False)
        assert r.status is Status.DISTRESS and r.distress
