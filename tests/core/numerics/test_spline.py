"""Spline weights against SciPy's not-a-knot spline, cubics and the order of the error."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from thrustwasher.numerics.spline import spline_weights

from washer_setup import bench, order  # isort: skip

RI, RO = 0.0111, 0.0227


def weights_of(x):
    n = len(x)
    weights = np.full(n, np.nan)
    assert spline_weights(x, weights, n, np.full(n * n + n, np.nan))
    return weights


def graded(n, power=1.6):
    return RI + (RO - RI) * (1.0 - (1.0 - np.linspace(0.0, 1.0, n)) ** power)


@pytest.mark.parametrize("n", [4, 5, 8, 19])
def test_weights_integrate_the_spline_itself(n):
    x = graded(n)
    splines = CubicSpline(x, np.eye(n), bc_type="not-a-knot")
    np.testing.assert_allclose(weights_of(x), splines.integrate(RI, RO), rtol=1e-9, atol=1e-16)


def test_error_falls_with_the_fourth_power_at_least():
    """At least: the ends make an error of order 5 that rules on coarse meshes."""
    errors = []
    for n in (17, 33, 65, 129):
        x = np.linspace(0.0, 1.0, n)
        errors.append(abs(weights_of(x) @ np.sin(7.0 * x) - (1.0 - np.cos(7.0)) / 7.0))
    assert np.all(order(errors) > 3.9)


def test_weights_of_a_repeated_node_are_refused():
    x = np.array([0.0, 0.0, 0.0, 1.0, 2.0])
    assert not spline_weights(x, np.empty(5), 5, np.empty(30))


@pytest.mark.parametrize("grid", [(5, 8), (10, 32), (19, 64)])
def test_the_mesh_knows_both_areas_and_the_full_turn(grid):
    m = bench(grid).m
    assert m.i_g == max(1, (grid[0] - 1) // 4) and m.r[m.i_g] == 0.0156
    assert (m.r[0], m.r[-1]) == (RI, RO)
    assert m.weight1.sum() == pytest.approx((RO**2 - RI**2) / 2.0, rel=1e-13)
    assert m.weight2.sum() == pytest.approx((RO**2 - 0.0156**2) / 2.0, rel=1e-13)
    assert np.all(m.weight2[: m.i_g] == 0.0)
    for around in (m.weight_t, m.width_t, m.step_t):
        assert around.sum() == pytest.approx(2.0 * np.pi, rel=1e-14)
    assert m.log_width.sum() == pytest.approx(np.log(RO / RI), rel=1e-13)


@pytest.mark.parametrize("gear", [0.0112, 0.0125, 0.0156, 0.0170, 0.0200, 0.0225])
def test_no_node_counts_negative(gear):
    """A negative weight makes a heat source a sink and the heat matrix indefinite."""
    m = bench((10, 32), gear_inner_radius=gear).m
    assert m.weight1.min() > 0.0
    assert m.weight2[m.i_g :].min() > 0.0
