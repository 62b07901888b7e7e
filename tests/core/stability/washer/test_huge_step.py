"""From one end of the range to the other in one step.

Hazard: a warm start is a bad start: its active set, temperatures and branch belong elsewhere, and
    Newton's method from there diverges or lands on the wrong branch.
Formula: quadratic convergence inside a basin of some 0.3 of the film; the ends are 20 films
    apart.
Cure: steps are limited; what does not converge warm is solved cold, then along the film
    thickness.
"""

import itertools

import pytest

from thrustwasher import WasherParams, solve_washer

from washer_runs import is_sound  # isort: skip

ENDS = [
    {"load": 5.0, "speed": 1500.0, "tilt": 0.004, "oil_temperature": 260.0},
    {"load": 3000.0, "speed": -1500.0, "tilt": 0.0, "oil_temperature": 420.0},
    {"load": 3000.0, "speed": 1.0, "tilt": 0.004, "oil_temperature": 300.0},
    {"load": 50.0, "speed": -136.0, "tilt": 0.001, "oil_temperature": 350.0},
    {"load": 1100.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15},
]


@pytest.mark.parametrize(
    ("one", "two"),
    [
        pytest.param(*pair, marks=[pytest.mark.slow] * (sum(pair) % 2))
        for pair in itertools.permutations(range(len(ENDS)), 2)
    ],
)
def test_any_point_is_reached_from_any_other(one, two):
    """The branch may be the one of the start where both exist; otherwise the numbers agree."""
    start = solve_washer(WasherParams(), **ENDS[one])
    r = solve_washer(WasherParams(), **ENDS[two], start=start)
    assert is_sound(r)
    cold = solve_washer(WasherParams(), **ENDS[two], branch=r.branch)
    assert r.friction_torque == pytest.approx(cold.friction_torque, rel=2e-5)
    assert r.film_ratio == pytest.approx(cold.film_ratio, abs=1e-3, rel=1e-4)


def test_a_start_of_another_grid_gives_its_branch_only():
    coarse = solve_washer(
        WasherParams(), load=750.0, speed=545.0, tilt=0.002, branch="contact", grid=(7, 24)
    )
    r = solve_washer(WasherParams(), load=750.0, speed=545.0, tilt=0.002, start=coarse)
    assert r.branch == "contact" and r.grid == (10, 32)


def test_a_start_with_other_parameters_gives_its_branch_only():
    other = solve_washer(WasherParams(heat_split=0.3), load=600.0, speed=545.0, tilt=0.002)
    r = solve_washer(WasherParams(), load=600.0, speed=545.0, tilt=0.002, start=other)
    cold = solve_washer(WasherParams(), load=600.0, speed=545.0, tilt=0.002)
    assert r.friction_torque == pytest.approx(cold.friction_torque, rel=1e-6)
