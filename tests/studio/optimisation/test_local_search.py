"""Both local searches end at the known minimum, at a limit where there is one."""

import numpy as np
import pytest
from bowls import FIGURES, LEAST, PLACES, Bowl

from thrustwasher.studio.optimisation.design_problem import read_problem
from thrustwasher.studio.optimisation.local_search import VIOLATION, LocalSearch

both = pytest.mark.parametrize("sloped", [True, False], ids=["SLSQP", "COBYQA"])


def searched(bowl, limits=(), aim=0, **more):
    """Return the problem and all designs that were tried, in its values."""
    problem = read_problem(
        PLACES, FIGURES, vary={"x": "-1:1", "y": "-1:1"}, minimise=["bowl"], limits=limits
    )
    given = {"start": (0.9, 0.9), "radius": 0.2, "tries": 120, **more}
    margins = (0.0,) * len(limits)
    scales = (1.0,) * len(problem.figures)
    search = LocalSearch(aim=aim, margins=margins, scales=scales, **given)
    return problem, search.run(bowl, problem)


@both
def test_the_least_is_found(sloped):
    problem, tried = searched(Bowl(sloped))
    best = problem.row(tried[tried[:, 2].argmin(), :2])
    assert (best["x"], best["y"]) == pytest.approx(LEAST, abs=2e-3)


@both
def test_a_limit_binds_from_the_inside(sloped):
    """x + y >= 0.8: the minimum lies on that line where the slopes of bowl and sum are parallel."""
    problem, tried = searched(Bowl(sloped), ["sum>=0.8"])
    inside = tried[tried[:, 3] >= 0.8]
    best = inside[inside[:, 2].argmin()]
    row = problem.row(best[:2])
    assert 2.0 * (row["x"] - LEAST[0]) == pytest.approx(4.0 * (row["y"] - LEAST[1]), abs=0.02)
    assert 0.8 <= best[3] < 0.801


@both
def test_a_start_outside_the_limits_is_led_inside(sloped):
    _, tried = searched(Bowl(sloped), ["sum<=-1.5", "other<=0.2"], VIOLATION)
    assert (np.maximum(tried[:, 3] + 1.5, tried[:, 4] - 0.2) <= 0.0).any()


@both
def test_designs_without_figures_are_walked_around(sloped):
    problem, tried = searched(Bowl(sloped, gone=0.2), start=(0.3, 0.9))
    sound = tried[np.isfinite(tried[:, 2])]
    best = problem.row(sound[sound[:, 2].argmin(), :2])
    assert (best["x"], best["y"]) == pytest.approx((0.2, LEAST[1]), abs=0.1)


@both
def test_no_more_designs_are_tried_than_allowed_and_none_twice(sloped):
    _, tried = searched(Bowl(sloped), tries=7)
    assert len(tried) <= 7
    assert len({row.tobytes() for row in tried}) == len(tried)


def test_slopes_save_most_of_the_tries():
    n = [len(searched(Bowl(sloped))[1]) for sloped in (True, False)]
    assert n[0] < 0.5 * n[1]
