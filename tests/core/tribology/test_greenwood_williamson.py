"""Real contact area: the overlap integral to rounding, the area ratio and its two bounds."""

import mpmath
import numpy as np
import pytest

from thrustwasher.numerics import smoothing
from thrustwasher.tribology import greenwood_williamson as gw


def exact(u):
    """Return (F_1, F_1/pdf) with 50 digits."""
    with mpmath.workdps(50):
        u = mpmath.mpf(u)
        pdf = mpmath.exp(-u * u / 2) / mpmath.sqrt(2 * mpmath.pi)
        value = pdf - u * mpmath.erfc(u / mpmath.sqrt(2)) / 2
        return value, value / pdf


def test_overlap_is_good_to_1e_13():
    for u in [*np.arange(-5.0, 37.5, 0.173).tolist(), 0.0, 3.0, 3.0001]:
        value, _ = exact(u)
        assert float(abs(gw.overlap_and_tail(u)[0] / value - 1)) < 1e-13, u


def test_the_tail_relative_to_the_density_is_good_to_1e_14_up_to_40():
    """Beyond 37.5 the integral itself is smaller than the smallest normal number."""
    for u in np.arange(3.0, 40.0, 0.37).tolist():
        _, scaled = exact(u)
        assert float(abs(gw.reach_and_mills(u)[0] / scaled - 1)) < 1e-14, u


def test_overlap_at_known_points_and_beyond_all_numbers():
    found = [gw.overlap_and_tail(u)[0] for u in (0.0, 1.4, 2.0)]
    assert found == pytest.approx([0.39894228, 0.03666814, 8.4907026e-3], rel=1e-7)
    assert gw.overlap_and_tail(39.0)[0] == 0.0
    assert gw.overlap_and_tail(-1e6)[0] == 1e6


@pytest.mark.parametrize(
    ("film_ratio", "ratio"), [(0.5, 32.2), (1.0, 76.4), (1.4, 173.6), (2.0, 749.8), (3.0, 1.67e4)]
)
def test_without_a_bound_the_area_ratio_explodes_as_the_film_grows(film_ratio, ratio):
    assert gw.area_and_slope(film_ratio, 0.05)[0] == pytest.approx(ratio, rel=3e-3)


def test_area_ratio_stays_between_1_and_a_million():
    assert gw.area_and_slope(-50.0, 1.0)[0] == 1.0
    assert gw.area_and_slope(100.0, 0.05)[0] == gw.area_and_slope(5.0, 0.05)[0] == 1e6


def test_no_asperity_is_pressed_beyond_its_hardness():
    assert gw.bounded_slopes(1000.0, 2e9, 2e8)[0] == 10.0
    assert gw.bounded_slopes(5.0, 2e9, 2e8)[0] == 5.0
    assert gw.bounded_slopes(5.0, 2e9, 4e9)[0] == 1.0


def slopes(f, xs):
    values = np.array([f(float(x)) for x in xs])
    return np.diff(values) / np.diff(xs)


@pytest.mark.parametrize(
    ("f", "low", "high"),
    [
        (lambda x: gw.bounded_slopes(x, 2e9, 2e8)[0], 0.5, 12.0),
        (lambda x: gw.area_and_slope(x, 0.05)[0], 3.5, 5.0),
        (lambda x: smoothing.soft_size(x, 0.5), -1.0, 1.0),
        (lambda x: smoothing.floored(x, 0.25), -1.0, 1.0),
        (lambda x: smoothing.smoothstep(x), -0.5, 1.5),
        (lambda x: smoothing.soft_most(x, 0.0, 0.3)[0], -1.0, 1.0),
    ],
)
def test_corners_have_continuous_slopes(f, low, high):
    """The largest jump between neighbouring slopes shrinks with the distance of the points."""
    jumps = []
    for n in (400, 1600):
        s = slopes(f, np.linspace(low, high, n))
        jumps.append(np.abs(np.diff(s)).max())
    assert jumps[1] < 0.3 * jumps[0]


def test_corners_are_exact_away_from_the_corner():
    assert smoothing.floored(-3.0, 1.0) == 3.0 and smoothing.floored(0.0, 1.0) == 1.0
    assert smoothing.soft_size(-3.0, 1.0) == 3.0 and smoothing.soft_size(0.0, 1.0) == 0.0
    assert smoothing.soft_least(1.0, 3.0, 0.5) == (1.0, 1.0)
    assert smoothing.soft_least(3.0, 1.0, 0.5) == (1.0, 0.0)
    value, slope = smoothing.soft_least(1.0, 1.0, 0.5)
    assert (value, slope) == (1.0 - 0.125, 0.5)
