"""Fronts: what no other design beats, evenly along."""

import numpy as np

from thrustwasher.studio.optimisation.front import apart, knee, levels, spread, unbeaten

COSTS = np.array([[3.0, 1.0], [1.0, 3.0], [2.0, 2.0], [2.0, 2.5], [3.0, 3.0], [1.0, 4.0]])


def test_unbeaten_designs_by_rising_first_cost():
    assert unbeaten(COSTS).tolist() == [1, 2, 0]
    assert unbeaten(COSTS[:, :1]).tolist() in ([1], [5])


def test_no_unbeaten_design_is_beaten_and_all_others_are():
    costs = np.random.default_rng(1).random((300, 2))
    front = set(unbeaten(costs).tolist())
    for i, own in enumerate(costs):
        beaten = ((costs <= own).all(1) & (costs < own).any(1)).any()
        assert beaten == (i not in front)


def test_a_few_are_taken_evenly_with_both_ends():
    x = np.linspace(0.0, 1.0, 101) ** 2
    chosen = spread(np.column_stack((x, 1.0 - x)), 5)
    assert np.allclose(x[chosen], [0.0, 0.25, 0.5, 0.75, 1.0], atol=0.02)


def test_levels_go_from_end_to_end_of_the_front():
    found = levels(COSTS, 5)
    assert found.tolist() == [3.0, 2.5, 2.0, 1.5, 1.0]


def test_the_knee_is_nearest_to_the_best_of_both():
    assert knee(np.array([[0.0, 10.0], [1.0, 2.0], [10.0, 0.0]])) == 1


def test_starts_of_a_round_are_not_near_one_another():
    points = np.array([[0.5], [0.52], [0.9], [0.1]])
    assert apart(points, np.arange(4), 3) == [0, 2, 3]
