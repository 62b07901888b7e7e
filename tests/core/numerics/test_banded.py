"""Band and dense solvers against LAPACK, and what they say about matrices without a solution."""

import numpy as np
import pytest

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
from thrustwasher.numerics.dense import dense_solve

SHAPES = [(1, 1), (2, 1), (5, 1), (6, 2), (7, 3), (12, 5), (13, 6), (40, 17), (4, 6), (9, 8)]


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
