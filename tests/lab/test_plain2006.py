"""The method of 2006 solves the paper's equations: refined it goes to the converged values.

So what it is off by on its own mesh is its mesh and its method, not a mistake in writing it down.
"""

import pytest

from lab.benchmarks.failures.plain2006 import Plain2006
from thrustwasher import load_curve, solve_washer
from thrustwasher.errors import Status
from thrustwasher.washer.parameters import WasherParams

pytestmark = pytest.mark.slow  # a minute of compiling, which no user ever waits for
PAPER = WasherParams.preset("paper")
FULL_FILM = (300.0, 953.0, 0.002, 297.15)
CONVERGED = {FULL_FILM: 0.2320718, (1361.0, 136.0, 0.002, 297.15): 3.50150}


def torque(grid, point, **settings):
    washer = Plain2006(grid=grid, **settings)
    assert washer.solve(*point) is Status.OK
    return washer.found.friction_torque


@pytest.mark.parametrize("point", CONVERGED)
def test_refined_it_goes_to_the_converged_torque(point):
    errors = [abs(torque(grid, point) / CONVERGED[point] - 1.0) for grid in ((9, 67), (17, 67))]
    assert errors[1] < 0.6 * errors[0] < 0.02


def test_on_its_own_mesh_it_is_far_off_where_contact_begins():
    """The trapezoid rule over nine uniform nodes: +46 % in the literature of this package."""
    assert torque((9, 67), (320.0, 136.0, 0.002, 297.15)) > 1.4 * 0.112283


def test_its_film_is_lost_fifteen_per_cent_too_early():
    washer, loads = Plain2006(tolerance=1e-5), [500.0, 600.0, 640.0, 660.0, 680.0]
    for load in loads:
        assert washer.solve(load, 545.0, 0.002, 297.15) is Status.OK
        if washer.found.film_ratio < 2.0:
            break
    fold = load_curve(PAPER, speed=545.0, tilt=0.002).folds[0].load
    assert 0.83 * fold < load < 0.9 * fold


def test_temperatures_substituted_whole_find_distress_where_there_is_none():
    """Below its own fold, on its own mesh: relaxed it keeps the film, unrelaxed it loses it."""
    point = (600.0, 545.0, 0.002, 297.15)
    careful, whole = Plain2006(share=0.3), Plain2006(share=1.0)
    careful.solve(*point)
    whole.solve(*point)
    assert careful.found.film_ratio > 4.0
    assert whole.found.film_ratio < 2.0
    ours = solve_washer(PAPER, load=600.0, speed=545.0, tilt=0.002)
    assert ours.branch == "film"
