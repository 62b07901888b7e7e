"""The four balances: speed of convergence, exact limits, failures."""

import numpy as np
import pytest

from thrustwasher.model.part_file import preset_part
from thrustwasher.numerics.status import MAX_ITERATIONS, NOT_FINITE, OK, OVER_BUDGET, SINGULAR
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.continuation import cold_start
from thrustwasher.washer.kernels.newton import LOAD, NO_FLOOR, _balance, newton
from thrustwasher.washer.kernels.solve import end_of_budget
from thrustwasher.washer.kernels.workspace import Point, forget_factor, vector
from thrustwasher.washer.parameters import SPEC

from washer_setup import BASE, bench, full_gear, settle, tilted  # isort: skip

GRID = (5, 12)  # what is tested holds on any mesh; these kernels run as plain Python


def balances(b, pt, q):
    settle(b.m, pt, q, b.f)
    _balance(b.m, b.f)
    return vector(b.f.small, L.BALANCE).copy()


def converged(target, b, pt, ratio=6.0, tolerance=1e-9, limit=60.0):
    b.w.info[:] = 0.0
    cold_start(b.w, pt, ratio)
    settle(b.m, pt, b.w.q, b.f)
    status = newton(b.w, pt, LOAD, target, NO_FLOOR, tolerance, limit)
    return b.w.q.copy(), b.w.info, status


def residuals_from_near_by(**changes):
    """Return the residuals after 1, 2, ... full steps, each with a factor made there."""
    b = bench(GRID, **changes)
    pt = Point(300.0, 953.0, 0.002, 297.15, 297.15)
    q, info, status = converged(300.0, b, pt, ratio=15.0)
    assert status == OK
    b.w.q[:], residuals = q * np.array([1.03, 1.03, 1.0, 1.0]), []
    for _ in range(5):
        forget_factor(b.w)
        newton(b.w, pt, LOAD, 300.0, NO_FLOOR, 1e-16, 1.0)
        residuals.append(info[L.RESIDUAL])
    return np.array(residuals)


def test_convergence_is_quadratic_with_a_fresh_factor():
    residuals = residuals_from_near_by(**preset_part(SPEC, "paper").parameters)
    logs = np.log(residuals[:4])
    assert residuals[3] < 1e-9
    assert (logs[2] - logs[1]) / (logs[1] - logs[0]) > 1.5


def test_each_iteration_gains_a_digit_where_oil_carries_heat():
    residuals = residuals_from_near_by()
    assert np.all(residuals[1:] < 0.1 * residuals[:-1]), residuals


def test_solution_is_the_same_from_thin_and_thick_starts():
    b = bench(GRID)
    found = [converged(300.0, b, BASE, ratio=r) for r in (4.0, 8.0, 20.0)]
    assert [status for _, _, status in found] == [OK] * 3
    for q, _, _ in found[1:]:
        np.testing.assert_allclose(q, found[0][0], rtol=1e-7, atol=1e-11)


def test_equal_annuli_at_rest_share_the_tilt():
    """Without film and with equal faces the washer stands half way: gy/gt = 0.5, gx = 0.

    Contact is summed from nodes in gap 2, integrated between them in film 1: a tilt of a few
    roughnesses, on which both agree.
    """
    b = full_gear((10, 32))
    pt = Point(2000.0, 0.0, 2e-4, 297.15, 297.15)
    q, info, status = converged(2000.0, b, pt, ratio=1.0)
    assert status == OK, info
    assert q[3] / pt.tilt == pytest.approx(0.5, abs=5e-4)
    assert abs(q[2]) < 1e-9 * pt.tilt


def test_isothermal_film_scales_with_viscosity_times_speed():
    """At given gaps, all heat left out: pressure forces go with mu omega."""
    loads = []
    for speed, scale in ((200.0, 6.31e-5), (800.0, 6.31e-5), (200.0, 2 * 6.31e-5)):
        b = bench(GRID, film_heat_fraction=0.0, oil_cooling=False, viscosity_scale=scale)
        pt = BASE._replace(speed=speed)
        q = tilted(b.m, 12.0, second=9.0)
        loads.append(balances(b, pt, q)[0] - b.f.small[L.FORCES])
        assert b.f.small[L.CONTACT] < 1e-9 * loads[0]
    assert loads[1] == pytest.approx(4.0 * loads[0], rel=1e-9)
    assert loads[2] == pytest.approx(2.0 * loads[0], rel=1e-9)


@pytest.mark.parametrize("name", ["q", "temp"])
def test_a_start_that_is_no_number_is_a_failure(name):
    b = bench(GRID)
    converged(300.0, b, BASE)
    {"q": b.w.q, "temp": b.f.temp}[name][1] = np.nan
    status = newton(b.w, BASE, LOAD, 300.0, NO_FLOOR, 1e-9, 10.0)
    assert status in (NOT_FINITE, SINGULAR, MAX_ITERATIONS)


def test_a_pressure_that_is_no_number_is_solved_for_again():
    b = bench(GRID)
    q, _, _ = converged(300.0, b, BASE)
    b.f.p[1:-1] = np.nan
    assert newton(b.w, BASE, LOAD, 300.0, NO_FLOOR, 1e-9, 10.0) == OK
    np.testing.assert_allclose(b.w.q, q, rtol=1e-8, atol=1e-11)


def test_iterations_end_at_their_limit():
    b = bench(GRID)
    _, info, status = converged(300.0, b, BASE, limit=2.0)
    assert status == MAX_ITERATIONS and info[L.ITERATIONS] == 2.0 and info[L.FACTORED] >= 1.0


def test_newton_starts_from_a_thick_film():
    """Thicker than 8.3 sigma everywhere it has no stiffness unless it starts with a pressure."""
    b = bench(GRID)
    pt = Point(300.0, 953.0, 0.002, 297.15, 297.15)
    cold_start(b.w, pt, 15.0)
    assert newton(b.w, pt, LOAD, 300.0, NO_FLOOR, 1e-9, 40.0) == OK


def test_iterations_end_with_the_budget_and_the_status_says_so():
    b, pt = bench(GRID), Point(300.0, 953.0, 0.002, 297.15, 297.15)
    b.w.info[:] = 0.0
    b.w.info[L.BUDGET] = 3.0
    cold_start(b.w, pt, 6.0)
    settle(b.m, pt, b.w.q, b.f)
    for _ in range(2):  # a second try begins none
        status = newton(b.w, pt, LOAD, 300.0, NO_FLOOR, 1e-9, 60.0)
        assert status == MAX_ITERATIONS and b.w.info[L.ITERATIONS] == 3.0
    assert end_of_budget(b.w, status) == OVER_BUDGET
    assert newton(b.w, pt, LOAD, 300.0, NO_FLOOR, 1e-9, 60.0) == OK, "what follows has no budget"


def test_a_solution_found_with_the_last_iteration_counts():
    b = bench(GRID)
    b.w.info[L.ITERATIONS] = b.w.info[L.BUDGET] = 3.0
    assert end_of_budget(b.w, OK) == OK
