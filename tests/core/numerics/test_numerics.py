"""Band and dense solvers against LAPACK, and what they say about matrices without a solution."""

import numpy as np
import pytest
from numpy.polynomial import chebyshev
from scipy.interpolate import CubicSpline

from thrustwasher.numerics.banded import (
    N_SIDES,
    band_solve,
    cholesky,
    cholesky_solve_many,
    factor_solve,
    factor_solve_many,
    halve,
    lu,
    mirror,
)
from thrustwasher.numerics.chebyshev import (
    CHANGES,
    N_CELL,
    SHARES,
    contract,
    enter_cell,
    lines_of,
    polynomial,
    polynomial_slope,
    share_out,
    share_out_change,
)
from thrustwasher.numerics.dense import dense_solve
from thrustwasher.numerics.spline import spline_weights

from washer_setup import bench, order  # isort: skip


SHAPES = [(1, 1), (2, 1), (5, 1), (6, 2), (7, 3), (12, 5), (13, 6), (40, 17), (4, 6), (9, 8)]
SHAPES += [(30, 7), (64, 20)]  # all remainders of groups of four


def random_band(n, band, symmetric):
    rng = np.random.default_rng(100 * n + band)
    a = rng.normal(size=(n, n))
    i, j = np.indices((n, n))
    a[abs(i - j) > band] = 0.0
    if symmetric:
        a = a + a.T
    a[np.diag_indices(n)] = 1.0 + np.abs(a).sum(axis=1)
    return a, rng.normal(size=(n, N_SIDES))


def lower(a, band):
    n = len(a)
    store = np.zeros(n * (band + 1))
    for j in range(n):
        for k in range(min(band, n - 1 - j) + 1):
            store[j * (band + 1) + k] = a[j + k, j]
    return store


def rows(a, band):
    n = len(a)
    store = np.zeros(n * (2 * band + 1))
    for i in range(n):
        for k in range(-min(band, i), min(band, n - 1 - i) + 1):
            store[i * (2 * band + 1) + band + k] = a[i, i + k]
    return store


def solves(a, b, one, many):
    """Check solutions for one and for many right sides against LAPACK's."""
    expected = np.linalg.solve(a, b)
    np.testing.assert_allclose(one, expected[:, 0], rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(many.reshape(b.shape), expected, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize(("n", "band"), SHAPES)
def test_cholesky_solves_as_lapack_does(n, band):
    """With the factor alone, and with the factor mirrored for the way back."""
    a, b = random_band(n, band, symmetric=True)
    store = lower(a, band)
    assert cholesky(store, n, band)
    one, many = b[:, 0].copy(), b.ravel().copy()
    band_solve(store, one, n, band)
    cholesky_solve_many(store, many, n, band)
    solves(a, b, one, many)
    mirrored = np.zeros(store.size)
    mirror(store, mirrored, n, band)
    one, many = b[:, 0].copy(), b.ravel().copy()
    factor_solve(store, mirrored, one, n, band)
    factor_solve_many(store, mirrored, many, n, band)
    solves(a, b, one, many)


@pytest.mark.parametrize(("n", "band"), SHAPES)
def test_lu_solves_as_lapack_does(n, band):
    a, b = random_band(n, band, symmetric=False)
    store = rows(a, band)
    assert lu(store, n, band)
    halves = np.zeros((2, n * (band + 1)))
    halve(store, *halves, n, band)
    one, many = b[:, 0].copy(), b.ravel().copy()
    factor_solve(*halves, one, n, band)
    factor_solve_many(*halves, many, n, band)
    solves(a, b, one, many)


@pytest.mark.parametrize("row", range(6))
@pytest.mark.parametrize("value", [-1.0, 0.0, np.nan, np.inf])
def test_a_bad_pivot_is_said(row, value):
    a, _ = random_band(6, 2, symmetric=True)
    a[row, :], a[:, row] = 0.0, 0.0
    a[row, row] = value
    assert not cholesky(lower(a, 2), 6, 2)
    if value != -1.0:
        assert not lu(rows(a, 2), 6, 2)


@pytest.mark.parametrize("n", [1, 2, 4, 9])
def test_dense_solve_exchanges_rows(n):
    rng = np.random.default_rng(n)
    a, b = rng.normal(size=(n, n)), rng.normal(size=n)
    if n > 1:
        a[0, 0] = 0.0
    x = b.copy()
    assert dense_solve(a.ravel().copy(), x, n)
    np.testing.assert_allclose(x, np.linalg.solve(a, b), rtol=1e-10)


def test_dense_solve_says_singular():
    assert not dense_solve(np.array([1.0, 2.0, 2.0, 4.0]), np.ones(2), 2)
    assert not dense_solve(np.array([np.nan, 2.0, 2.0, 4.0]), np.ones(2), 2)


# Charts: piecewise Chebyshev interpolants over three axes, polynomials over a fourth.

AXES = ((0.0, 3.0, 2), (-1.0, 1.0, 1), (2.0, 8.0, 3))
WIDTH = 5


def places(low, high, patches):
    """Return the nodes of an axis."""
    width = (high - low) / patches
    return [low + width * (p + x) for p in range(patches) for x in (0.0, 0.25, 0.75)] + [high]


def filled(function, axes=AXES):
    """Return lines of a function at all nodes."""
    xs, ys, zs = (places(*axis) if axis[2] else [axis[0]] for axis in axes)
    assert [len(nodes) for nodes in (xs, ys, zs)] == [3 * axis[2] + 1 for axis in axes]
    lines = [function(x, y, z) for x in xs for z in zs for y in ys[::3]]
    inner = [y for k, y in enumerate(ys) if k % 3]
    lines += [function(x, y, z) for y in inner for x in xs[::3] for z in zs[::3]]
    assert len(lines) == lines_of(*(axis[2] for axis in axes))
    return np.array(lines).ravel()


def read(data, at, axes=AXES, along=None):
    """Return the interpolated numbers, or their change along a direction."""
    cell, out = np.full(N_CELL, np.nan), np.full(WIDTH, np.nan)
    for k, (x, axis) in enumerate(zip(at, axes, strict=True)):
        enter_cell(cell, k, x, float(axis[0]), float(axis[1]), axis[2])
    share_out(cell)
    if along is not None:
        share_out_change(cell, *along)
    shares = SHARES if along is None else CHANGES
    contract(data, 0, WIDTH, *(axis[2] for axis in axes), cell, shares, WIDTH, out, 0)
    return out


def cubic(x, y, z):
    """Return what comes out exactly: cubic in y only where x and z come linearly."""
    return [1.0, x**3 - y, x * y**3 * z, x**3 * z**2 * y - x * z, x**2 + y**2 * z]


INSIDE = [(0.3, 0.2, 2.5), (1.5, -1.0, 4.0), (2.999, 0.99, 7.9), (0.0, 1.0, 8.0), (1.51, 0.0, 6.1)]


@pytest.mark.parametrize("at", INSIDE)
def test_cubics_come_out_exactly(at):
    assert read(filled(cubic), at) == pytest.approx(cubic(*at), rel=1e-12, abs=1e-11)


def test_neighbouring_patches_meet():
    axes = ((0.0, 3.0, 2), (-1.0, 1.0, 2), (2.0, 8.0, 3))
    data = filled(lambda x, y, z: [np.exp(x - z / 4.0) * np.cos(y)] * WIDTH, axes)
    for axis, border in ((0, 1.5), (1, 0.0), (2, 4.0), (2, 6.0)):
        at = np.array([1.1, 0.3, 4.5])
        at[axis] = border
        step = 1e-12 * np.eye(3)[axis]
        assert read(data, at - step, axes) == pytest.approx(read(data, at + step, axes), rel=1e-10)


def test_the_error_falls_with_the_fourth_power_of_the_patch():
    errors = []
    for patches in (1, 2, 4, 8):
        axes = ((0.0, 2.0, patches), (0.0, 0.0, 0), (0.0, 0.0, 0))
        data = filled(lambda x, _y, _z: [x**4] * WIDTH, axes)
        xs = np.linspace(0.0, 2.0, 401)
        errors.append(max(abs(read(data, (x, 0.0, 0.0), axes)[0] - x**4) for x in xs))
    orders = np.log2(np.array(errors[1:-1]) / errors[2:])
    assert orders == pytest.approx([4.0, 4.0], abs=0.02)


def test_a_fixed_axis_has_one_node():
    axes = ((0.0, 3.0, 2), (0.7, 0.7, 0), (2.0, 8.0, 1))
    data = filled(cubic, axes)
    found = read(data, (1.2, 0.7, 5.0), axes)
    assert found == pytest.approx(cubic(1.2, 0.7, 5.0), rel=1e-12)
    assert np.all(read(data, (1.2, 0.7, 5.0), axes, along=(0.0, 1.0, 0.0)) == 0.0)


@pytest.mark.parametrize("n", [2, 5, 12])
def test_chebyshev_sums_are_those_of_numpy(n):
    c = np.random.default_rng(4).normal(size=n)
    for u in (-1.0, -0.3, 0.0, 0.71, 1.0):
        value, slope = polynomial_slope(c, 0, n, u)
        assert polynomial(c, 0, n, u) == pytest.approx(
            chebyshev.chebval(u, c), rel=1e-13, abs=1e-13
        )
        assert value == pytest.approx(chebyshev.chebval(u, c), rel=1e-13, abs=1e-13)
        assert slope == pytest.approx(chebyshev.chebval(u, chebyshev.chebder(c)), rel=1e-12)


# Spline weights against SciPy's not-a-knot spline, cubics and the order of the error.

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
