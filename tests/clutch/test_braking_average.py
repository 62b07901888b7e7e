"""The closed form of a braking's average friction against quadrature and limits."""

import math

import pytest
from closed_forms.heated_plate import braking_average
from scipy.integrate import quad


@pytest.mark.parametrize(("stick", "decay"), [(1.185, 2.872), (0.0, 1.0), (5.0, 0.05)])
def test_it_is_the_harmonic_mean_over_speed(stick, decay):
    rest, floor, fastest = 0.11, 0.03, 12.0

    def slowness(v):
        return 1.0 / (floor + (rest - floor) * math.exp(-max(v - stick, 0.0) / decay))

    area = quad(slowness, 0.0, stick)[0] + quad(slowness, stick, fastest, limit=200)[0]
    wanted = fastest / area
    assert braking_average(rest, floor, stick, decay, fastest) == pytest.approx(wanted, rel=1e-9)


def test_a_braking_below_stick_speed_has_the_friction_at_rest():
    assert braking_average(0.11, 0.03, 1.2, 2.0, 1.0) == 0.11


def test_constant_friction_is_its_own_average():
    assert braking_average(0.1, 0.1, 1.0, 2.0, 12.0) == pytest.approx(0.1, rel=1e-14)
