"""The washer's closed forms against numbers worked out apart and against their own equations."""

import math

import numpy as np
import pytest
from closed_forms.greenwood import elastic_pressure, height_integral
from closed_forms.heated_ring import annulus_rise, stack_rise
from closed_forms.thin_film import (
    couette_torque,
    wedge_moment,
    wedge_pressure,
)
from failures.narrow_ring import narrow_ring_load
from scipy.integrate import quad

RI, RO, K = 0.0111, 0.0227, 60.5


def test_couette_torque_is_the_integral_of_shear():
    integral = quad(lambda r: 0.06 * 500.0 * r**2 / 1e-5 * 2.0 * math.pi * r, RI, RO)[0]
    assert couette_torque(0.06, 500.0, 1e-5, RI, RO) == pytest.approx(integral, rel=1e-12)


def test_height_integral_has_its_tabled_values():
    assert height_integral(0.0) == pytest.approx(0.43001999, abs=5e-9)
    assert height_integral(1.0) == pytest.approx(0.07566818, abs=5e-9)
    assert height_integral(3.0) == pytest.approx(2.6397e-4, abs=5e-9)


@pytest.mark.parametrize("t", [-3.0, 0.4, 2.5])
def test_elastic_pressure_is_the_sum_over_heights(t):
    """E' = 1 Pa, R = 1 m, one asperity per area, scatter 1 m: 4/3 of the mean of (s - t)^1.5."""

    def share(v):
        s = t + v * v  # smooth at the lower end
        return 2.0 * v * v**3 * math.exp(-0.5 * s * s) / math.sqrt(2.0 * math.pi)

    integral = quad(share, 0.0, 4.5, epsabs=1e-14)[0]
    assert elastic_pressure(t, 1.0, 1.0, 1.0, 1.0) == pytest.approx(4 / 3 * integral, rel=1e-9)


def test_stack_has_its_tabled_temperatures():
    """0.1 MW/m2, gaps of 10 and 5 um of oil, base bodies, oil at 24 degC."""
    half = 6.35e-4 / (2.0 * K)
    found = stack_rise(1e5, 0.5, 1e-5 / 0.145 + half, 5e-6 / 0.145 + half, 0.01 / K, 0.01 / K)
    expected = (33.00312669, 33.33478041, 31.52579893)
    assert [24.0 + x for x in found] == pytest.approx(expected, abs=1e-8)


def test_all_heat_of_the_stack_leaves():
    rise = stack_rise(1e5, 0.3, 7e-5, 4e-5, 1.6e-4, 2.0e-4)
    assert rise.carrier / 1.6e-4 + rise.gear / 2.0e-4 == pytest.approx(1e5, rel=1e-14)


def test_annulus_has_its_tabled_temperatures():
    found = annulus_rise(np.array([RI, 0.0169, RO]), 1e5, 2, K, 0.01, RI, RO)
    assert found == pytest.approx([3.28897, 4.20461, 5.04514], abs=6e-6)


def test_wedge_pressure_satisfies_reynolds_equation():
    """r d/dr(r dp/dr) + d2p/dtheta2 = C r^3 sin(theta), checked by differences."""
    args = (0.06, 500.0, 1e-5, 1e-5, RI, RO)
    r, a, h = 0.0169, 4.0, 1e-6

    def p(radius):
        return wedge_pressure(radius, a, *args)

    radial = r * r * (p(r + h) - 2 * p(r) + p(r - h)) / h**2 + r * (p(r + h) - p(r - h)) / (2 * h)
    right = 6.0 * 0.06 * 500.0 * 1e-5 / 1e-15 * r**3 * math.sin(a)
    assert radial - p(r) == pytest.approx(right, rel=1e-5)
    assert p(RI) == 0.0 and p(RO) == 0.0


def test_wedge_moment_is_the_moment_of_the_pressure():
    args = (0.06, 500.0, 1e-5, 1e-5, RI, RO)
    per_radius = quad(lambda r: wedge_pressure(r, math.pi / 2, *args) * r**2, RI, RO)[0]
    assert wedge_moment(*args) == pytest.approx(math.pi * per_radius, rel=1e-10)


def test_narrow_ring_load_is_the_integral_over_the_closing_half():
    """Across the ring p = 3 mu omega (dh/dtheta)/h^3 y (y - L), positive where the film closes."""
    mu, omega, ri, ro, h0, e = 0.05, 300.0, 0.0199, 0.0201, 1e-5, 4e-6
    length, mean = ro - ri, 0.5 * (ri + ro)
    integral = quad(
        lambda a: 3.0 * mu * omega * e * math.sin(a) / (h0 + e * math.cos(a)) ** 3
        * length**3 / 6.0 * mean, 0.0, math.pi,
    )[0]  # fmt: skip
    found = narrow_ring_load(mu, omega, ri, ro, h0 - e, h0 + e)
    assert found == pytest.approx(integral, rel=1e-10)
