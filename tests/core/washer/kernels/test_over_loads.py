"""A washer at rising loads, on both ways of the load: the solutions that single solves find."""

import numpy as np
import pytest

from thrustwasher import BranchError, WasherParams, load_curve, solve_washer
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.whole_curve import over_loads
from thrustwasher.washer.kernels.workspace import size_of_state, size_of_work
from thrustwasher.washer.solve import GRIDS

POINT = {"speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15}
LOADS = np.geomspace(100.0, 3000.0, 8)
NAMES = {L.FILM_BRANCH: "film", L.CONTACT_BRANCH: "contact"}
SAME = 1e-5  # a load is solved to 2e-6


def solved(loads, point=POINT):
    """Return the solutions (2, n, ROW) for loads up, loads down."""
    grid, n = GRIDS["field"], len(loads)
    inp = np.array([0.0, *point.values(), 0.0])
    walk = np.zeros(over_loads.size_of_walk(*grid, n))
    rows = np.zeros(2 * n * over_loads.ROW)
    work = np.zeros(L.N_HEAD + size_of_work(*grid))
    memory, out, iout = np.zeros(size_of_state(*grid)), np.zeros(L.NOUT), np.zeros(L.NIOUT, "i4")
    while not walk[over_loads.ENDED]:
        status = over_loads.follow_loads(
            constants(WasherParams(), grid), inp, work, loads, memory, out, iout, walk, rows
        )
        assert status == 0
    return rows.reshape(2, n, -1)


@pytest.fixture(scope="module")
def both():
    return solved(LOADS)


def test_loads_up_the_solutions_are_those_of_single_solves(both):
    for load, (branch, reached, *out) in zip(LOADS, both[0], strict=True):
        wanted = solve_washer(WasherParams(), load=load, **POINT)
        assert (NAMES[branch], reached) == (wanted.branch, pytest.approx(load, rel=SAME))
        assert out[L.O_TORQUE] == pytest.approx(wanted.friction_torque, rel=SAME)
        assert out[L.O_RATIO] == pytest.approx(wanted.film_ratio, rel=SAME)


def test_loads_down_there_is_another_solution_between_the_folds_alone(both):
    lost, regained = (fold.load for fold in load_curve(WasherParams(), **POINT).folds)
    there = both[1][:, 0] == L.CONTACT_BRANCH
    assert there.tolist() == ((LOADS < lost) & (LOADS > regained)).tolist() and there.any()
    for load, row in zip(LOADS[there], both[1][there], strict=True):
        wanted = solve_washer(WasherParams(), load=load, **POINT, branch="contact")
        assert row[2 + L.O_TORQUE] == pytest.approx(wanted.friction_torque, rel=SAME)
    with pytest.raises(BranchError):
        solve_washer(WasherParams(), load=LOADS[~there][0], **POINT, branch="contact")


def test_loads_close_to_a_fold_are_told_apart():
    lost, regained = (fold.load for fold in load_curve(WasherParams(), **POINT).folds)
    loads = np.array([0.999 * regained, 1.001 * regained, 0.999 * lost, 1.001 * lost])
    up, down = solved(loads)
    assert [NAMES[b] for b in up[:, 0]] == ["film", "film", "film", "contact"]
    assert (down[:, 0] != 0.0).tolist() == [False, True, True, False]


def test_a_film_that_stays_clear_has_no_second_way():
    up, down = solved(np.array([20.0, 40.0]), POINT | {"speed": 1400.0})
    assert (up[:, 0] == L.FILM_BRANCH).all() and not down[:, 0].any()
