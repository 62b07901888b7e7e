"""Charts: piecewise Chebyshev interpolants over three axes, polynomials over a fourth."""

import numpy as np
import pytest
from numpy.polynomial import chebyshev

from thrustwasher.numerics.chebyshev import (
    N_AXIS,
    N_CELL,
    N_TERMS,
    SLOPE,
    WEIGHT,
    contract,
    enter_cell,
    nodes_of,
    polynomial,
    polynomial_slope,
)  # fmt: skip

AXES = ((0.0, 3.0, 2), (-1.0, 1.0, 1), (2.0, 8.0, 3))
WIDTH = 5


def places(low, high, patches):
    """Return the nodes of an axis."""
    width = (high - low) / patches
    return [low + width * (p + x) for p in range(patches) for x in (0.0, 0.25, 0.75)] + [high]


def filled(function, axes=AXES):
    """Return lines of a function at all nodes, and the steps between nodes."""
    grids = [places(*axis) if axis[2] else [axis[0]] for axis in axes]
    lines = np.array([[[function(x, y, z) for z in grids[2]] for y in grids[1]] for x in grids[0]])
    shape = lines.shape
    assert shape[:3] == tuple(nodes_of(axis[2]) for axis in axes)
    steps = (shape[1] * shape[2] * WIDTH, shape[2] * WIDTH, WIDTH)
    return lines.ravel(), [s if axis[2] else 0 for s, axis in zip(steps, axes, strict=True)]


def read(data, steps, at, axes=AXES, slope_of=-1):
    cell, out = np.full(N_CELL, np.nan), np.full(WIDTH, np.nan)
    for k, (x, axis) in enumerate(zip(at, axes, strict=True)):
        enter_cell(cell, k, x, float(axis[0]), float(axis[1]), axis[2])
    contract(data, 0, *steps, cell, slope_of, WIDTH, out, 0)
    return out


def cubic(x, y, z):
    return [1.0, x**3 - y, x * y**2 * z, z**3 - x * z, x**2 + y**3 * z**2]


def slope_of_cubic(axis, x, y, z):
    table = (
        [0.0, 3 * x**2, y**2 * z, -z, 2 * x],
        [0.0, -1.0, 2 * x * y * z, 0.0, 3 * y**2 * z**2],
        [0.0, 0.0, x * y**2, 3 * z**2 - x, 2 * y**3 * z],
    )
    return table[axis]


INSIDE = [(0.3, 0.2, 2.5), (1.5, -1.0, 4.0), (2.999, 0.99, 7.9), (0.0, 1.0, 8.0), (1.51, 0.0, 6.1)]


@pytest.mark.parametrize("at", INSIDE)
def test_cubics_come_out_exactly(at):
    data, steps = filled(cubic)
    assert read(data, steps, at) == pytest.approx(cubic(*at), rel=1e-12, abs=1e-11)


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("at", INSIDE)
def test_slopes_of_cubics_come_out_exactly(at, axis):
    data, steps = filled(cubic)
    found = read(data, steps, at, slope_of=axis)
    assert found == pytest.approx(slope_of_cubic(axis, *at), rel=1e-11, abs=1e-9)


def test_neighbouring_patches_meet():
    data, steps = filled(lambda x, y, z: [np.exp(x - z / 4.0) * np.cos(y)] * WIDTH)
    for border in (4.0, 6.0):
        left, right = (read(data, steps, (1.1, 0.3, border + d)) for d in (-1e-12, 1e-12))
        assert left == pytest.approx(right, rel=1e-10)


def test_the_error_falls_with_the_fourth_power_of_the_patch():
    errors = []
    for patches in (1, 2, 4, 8):
        axes = ((0.0, 2.0, patches), (0.0, 0.0, 0), (0.0, 0.0, 0))
        data, steps = filled(lambda x, _y, _z: [x**4] * WIDTH, axes)
        xs = np.linspace(0.0, 2.0, 401)
        errors.append(max(abs(read(data, steps, (x, 0.0, 0.0), axes)[0] - x**4)
                          for x in xs))  # fmt: skip
    orders = np.log2(np.array(errors[1:-1]) / errors[2:])
    assert orders == pytest.approx([4.0, 4.0], abs=0.02)


def test_a_fixed_axis_has_one_node():
    axes = ((0.0, 3.0, 2), (0.7, 0.7, 0), (2.0, 8.0, 1))
    data, steps = filled(cubic, axes)
    found = read(data, steps, (1.2, 0.7, 5.0), axes)
    assert found == pytest.approx(cubic(1.2, 0.7, 5.0), rel=1e-12)
    assert np.all(read(data, steps, (1.2, 0.7, 5.0), axes, slope_of=1) == 0.0)


def test_weights_add_up_to_one_and_their_slopes_to_none():
    cell = np.zeros(N_CELL)
    for x in np.linspace(0.0, 3.0, 31):
        enter_cell(cell, 0, x, 0.0, 3.0, 2)
        assert np.sum(cell[WEIGHT : WEIGHT + 4]) == pytest.approx(1.0, abs=1e-14)
        assert np.sum(cell[SLOPE:N_AXIS]) == pytest.approx(0.0, abs=1e-12)


def test_chebyshev_sums_are_those_of_numpy():
    c = np.random.default_rng(4).normal(size=N_TERMS)
    for u in (-1.0, -0.3, 0.0, 0.71, 1.0):
        value, slope = polynomial_slope(c, 0, u)
        assert polynomial(c, 0, u) == pytest.approx(chebyshev.chebval(u, c), rel=1e-13, abs=1e-13)
        assert value == pytest.approx(chebyshev.chebval(u, c), rel=1e-13, abs=1e-13)
        assert slope == pytest.approx(chebyshev.chebval(u, chebyshev.chebder(c)), rel=1e-12)
