"""Boundary friction: published values, limits, and all digits against multiple precision."""

import mpmath as mp
import numpy as np
import pytest

from thrustwasher.clutch.kernels.pack_friction import friction, shear_and_slope


@pytest.mark.parametrize(
    ("x", "shear", "weight", "expected"),
    [(0.1, 0.5, 0.5, 0.07446961), (0.3, 0.5, 0.5, 0.11977114), (0.5, 1.0, 0.1, 0.13678872)],
)
def test_hand_computed_values_come_back(x, shear, weight, expected):
    assert friction(x, shear, weight, 6.0) == pytest.approx(expected, abs=1e-8)


def test_no_digit_is_lost_from_1e_12_to_1():
    """The printed form has no correct digit left at x = 1e-8."""
    mp.mp.dps = 50
    for x in [*np.logspace(-12, 0, 121), 0.4999999, 0.5, 1.0 - 1e-15]:
        big = mp.mpf(float(x))
        root = mp.sqrt(1 - big * big)
        bracket = mp.mpf("0.3") * (mp.asin(big) - big * root) + mp.mpf("1.4") / 6 * (1 - root)
        exact = 2 / (mp.pi * big**2) * bracket
        assert friction(float(x), 0.7, 0.3, 6.0) == pytest.approx(float(exact), rel=1e-13)


def shear_ratio(speed, *law):
    return shear_and_slope(abs(speed), *law)[0]


def test_shear_ratio_is_full_up_to_stick_speed_and_falls_to_the_floor():
    law = (0.30, 1.185, 2.872, 0.0)
    assert shear_ratio(0.0, *law) == shear_ratio(-1.185, *law) == 1.0
    assert shear_ratio(1.185 + 2.872, *law) == pytest.approx(0.3 + 0.7 / np.e, rel=1e-14)
    assert shear_ratio(1e6, *law) == 0.30
    assert shear_ratio(-4.0, *law) == shear_ratio(4.0, *law)


def test_a_rounded_kink_has_no_corner_and_ends_on_the_same_law():
    sharp, round_ = (0.30, 1.185, 2.872, 0.0), (0.30, 1.185, 2.872, 0.1)
    step = 1e-6
    slope = [
        (shear_ratio(1.185 + s + step, *round_) - shear_ratio(1.185 + s, *round_)) / step
        for s in (-step, 0.0)
    ]
    assert slope[0] == pytest.approx(slope[1], rel=1e-3)
    assert shear_ratio(9.0, *round_) == pytest.approx(shear_ratio(9.0, *sharp), rel=1e-14)
