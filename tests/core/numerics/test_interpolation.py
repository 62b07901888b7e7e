"""Charts: piecewise Chebyshev interpolants over three axes, polynomials over a fourth."""

import numpy as np
import pytest
from numpy.polynomial import chebyshev

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
