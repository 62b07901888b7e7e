"""Loaded beyond the fold and let go again: two ways between the same two ends.

Hazard: a solver that keeps nothing of its past jumps back at the fold it came over; one that
    keeps too much never comes back, or comes back to another film than it left.
Formula: between the folds (659 N and 956 N at 545 rad/s, 2 mrad) one load has two stable films;
    the path goes along the film up to film_lost, along the contact down to film_regained. The
    area of the loop, integral of torque over load there and back, is a property of the washer.
Cure: the branch is memory: it is part of the state, and changes at the folds only.
"""

from itertools import pairwise

import numpy as np
import pytest
from curves import traced

from washer_runs import followed, is_sound, solve, stepped  # isort: skip

LOW, HIGH = 550.0, 1150.0


def path(n):
    up = np.linspace(LOW, HIGH, n)
    return np.concatenate((up, up[-2::-1]))


def loop(n):
    """Return loads, torques and results of a loop in ``n`` steps each way."""
    loads = path(n)
    results = followed([{"load": float(w)} for w in loads])
    assert all(is_sound(r) for r in results)
    return loads, np.array([r.friction_torque for r in results]), results


def area(loads, torques):
    return float(np.sum(0.5 * (torques[1:] + torques[:-1]) * np.diff(loads)))


@pytest.fixture(scope="module")
def fine():
    return loop(121)


def test_the_loop_closes(fine):
    _, torques, results = fine
    assert results[0].branch == results[-1].branch == "film"
    assert torques[-1] == pytest.approx(torques[0], rel=1e-6)
    assert results[-1].film_ratio == pytest.approx(results[0].film_ratio, rel=1e-6)
    assert results[-1].temperature == pytest.approx(results[0].temperature, abs=1e-4)


def test_the_film_goes_and_comes_back_at_the_two_folds(fine):
    loads, _, results = fine
    lost, regained = (f.load for f in traced().folds)
    steps = [
        (a, b, r.branch)
        for (a, r0), (b, r) in pairwise(zip(loads, results, strict=True))
        if r.branch != r0.branch
    ]
    (a, b, gone), (c, d, back) = steps
    assert (gone, back) == ("contact", "film")
    assert a < lost < b and d < regained < c


def test_between_the_folds_there_and_back_differ_and_outside_they_do_not(fine):
    loads, torques, _ = fine
    there, back = torques[:121], torques[:119:-1]
    inside = (loads[:121] > 661.0) & (loads[:121] < 954.0)
    assert (back[inside] > 2.0 * there[inside]).all()
    outside = (loads[:121] < 656.0) | (loads[:121] > 959.0)
    assert back[outside] == pytest.approx(there[outside], rel=2e-5)


def test_the_area_of_the_loop_is_the_same_whenever_and_however_finely_it_is_run(fine):
    loads, torques, _ = fine
    again = loop(121)
    assert area(*again[:2]) == pytest.approx(area(loads, torques), rel=1e-5)
    coarse = area(*loop(61)[:2])
    assert area(loads, torques) < -10.0  # the way back takes more torque
    assert coarse == pytest.approx(area(loads, torques), rel=0.05)


def test_an_fmu_goes_round_the_same_loop_twice():
    """In one instance's memory, step after step: the second round is the first."""
    found = stepped([*path(41)] * 2)
    assert all(status < 10 for status, _ in found)
    torques = [torque for _, torque in found]
    assert torques[81:] == pytest.approx(torques[:81], rel=1e-5)


def test_one_jump_there_and_one_back_end_where_they_began():
    start = solve(load=LOW)
    back = solve(load=LOW, start=solve(load=1e4, start=start))
    assert is_sound(back) and back.branch == "film"
    assert back.friction_torque == pytest.approx(start.friction_torque, rel=2e-5)
