"""Who is on the front: ties, the reference's uncertainty, failures, and a second run."""

import random

import pytest

from lab.benchmarks.charts import disagreements
from lab.charts.chart_text import beats, front


def sample(label, cost, error, *, spread=0.0, floor=1e-6, failed=0):
    return {
        "label": label,
        "call_median": cost,
        "call_iqr": spread,
        "errors": {"torque": {"worst": error, "rms": None if error is None else 0.5 * error}},
        "ref_uncertainty": {"torque": floor},
        "n_failed": failed,
    }


def labels(samples):
    return [samples[i]["label"] for i in front(samples, "torque")]


def test_dearer_and_coarser_is_beaten():
    samples = [sample("a", 1.0, 1e-2), sample("b", 2.0, 1e-3), sample("c", 3.0, 2e-3)]
    assert labels(samples) == ["a", "b"]


def test_faster_by_less_than_both_spreads_beats_nothing():
    quick, slow = sample("a", 1.0, 1e-3, spread=0.06), sample("b", 1.1, 1e-3, spread=0.06)
    assert not beats(quick, slow, "torque")
    assert labels([quick, slow]) == ["a", "b"]
    assert beats(sample("a", 1.0, 1e-3, spread=0.04), slow | {"call_iqr": 0.04}, "torque")


def test_errors_below_the_references_uncertainty_are_equal():
    samples = [sample("a", 1.0, 9e-5, floor=1e-4), sample("b", 2.0, 1e-5, floor=1e-4)]
    assert labels(samples) == ["a"]


def test_who_fails_beats_nobody_who_does_not():
    samples = [sample("a", 1.0, 1e-5, failed=1), sample("b", 2.0, 1e-2), sample("c", 3.0, 1e-3)]
    assert labels(samples) == ["a", "b", "c"]
    assert beats(samples[0], sample("d", 9.0, 1e-2, failed=2), "torque")


def test_who_never_fails_but_errs_more_does_not_beat_a_map_with_an_edge():
    assert labels([sample("closed", 1.0, 0.5), sample("map", 2.0, 1e-4, failed=1)])[-1] == "map"


def test_what_has_no_answer_is_on_no_front():
    assert labels([sample("a", 1.0, None), sample("b", 2.0, 1e-2)]) == ["b"]


@pytest.fixture
def measured():
    """Return a function that measures the same twelve ways with noise of a clock."""
    source = random.Random(3)
    ways = [(10.0 ** source.uniform(-6, -2), 10.0 ** source.uniform(-5, -1)) for _ in range(12)]

    def once(seed):
        noise = random.Random(seed)
        return [
            sample(f"way {i}", cost * (1.0 + noise.uniform(-0.02, 0.02)), error, spread=0.02 * cost)
            for i, (cost, error) in enumerate(ways)
        ]

    return once


def test_two_runs_agree_on_every_member_outside_the_spread(measured):
    for seed in range(20):
        assert disagreements(measured(seed), measured(100 + seed), "torque") == []


def test_a_way_on_one_front_alone_is_a_disagreement(measured):
    one, two = measured(0), measured(1)
    assert disagreements([*one, sample("new", 1e-9, 1e-9)], two, "torque")


def test_a_tie_that_falls_the_other_way_is_none():
    one = [sample("a", 1.00, 1e-3, spread=0.05), sample("b", 1.09, 1e-3, spread=0.05)]
    two = [sample("a", 1.00, 1e-3, spread=0.05), sample("b", 1.12, 1e-3, spread=0.05)]
    assert labels(one) != labels(two)
    assert disagreements(one, two, "torque") == []
