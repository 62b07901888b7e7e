"""Contact of the lining against parabolic cylinder functions, and the separation root."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from thrustwasher.tribology.contact_table import TABLE
from thrustwasher.tribology.greenwood_tripp import (
    N_KNOTS,
    NODES,
    REACH,
    STEP,
    U_MIN,
    WEIGHTS,
    area_integrals,
    contact_integral,
    height_integrals,
    pressure_scale,
    separation_and_slope,
)


@pytest.mark.parametrize(
    "u", [-300.0, -50.0, -9.5, -8.5, -5.0, -1.0, 0.0, 0.25, 1.5, 3.0, 8.0, 10.0]
)
def test_height_integrals_agree_with_cylinder_functions(u):
    """F_n(u) = Gamma(n + 1)/sqrt(2 pi) exp(-u^2/4) D_{-n-1}(u)."""
    mp.mp.dps = 30
    big = mp.mpf(u)
    for n, found in zip((2.5, 1.5), height_integrals(u), strict=True):
        front = mp.gamma(n + 1) / mp.sqrt(2 * mp.pi) * mp.exp(-big * big / 4)
        assert found == pytest.approx(float(front * mp.pcfd(-n - 1, big)), rel=1e-11)


def test_default_lining_settles_at_the_known_separation():
    scale = pressure_scale(8.41e-6, 2.7e7, 7e7, 8e-4)
    assert separation_and_slope(0.6e6 / scale, 1.0)[0] == pytest.approx(0.5749, abs=2e-4)


@given(st.floats(-20.0, 7.5), st.floats(-30.0, 8.0))
def test_separation_is_found_from_every_start(u, guess):
    found, _, status, iterations = separation_and_slope(height_integrals(u)[0], guess)
    assert status == 0 and iterations < 20
    assert found == pytest.approx(u, abs=1e-9)


def test_no_pressure_and_absurd_pressure_have_an_answer():
    assert separation_and_slope(0.0, 1.0) == (11.0, 0.0, 0, 0)
    crushed, _, status, _ = separation_and_slope(1e30, 1.0)
    assert status == 0 and crushed == pytest.approx(-1e12, rel=1e-12)
    assert math.isfinite(separation_and_slope(1e-29, -900.0)[0])


def test_the_table_in_its_file_is_what_quadrature_gives():
    """Knots of ln F_5/2, slope and curvature; relative to the density, so that none underflows."""
    u = (U_MIN + STEP * np.arange(N_KNOTS))[:, None]
    low = np.sqrt(np.maximum(0.0, -u - REACH))
    high = np.sqrt(np.where(u < 0.0, REACH - u, REACH**2 / (np.hypot(u, REACH) + np.abs(u))))
    s = (low + (high - low) * NODES) ** 2
    weight = 2.0 * (high - low) * WEIGHTS * np.exp(-0.5 * s * (s + 2.0 * u))
    five, three, one = ((weight * s ** (n + 0.5)).sum(1) for n in (2.5, 1.5, 0.5))
    slope = -2.5 * three / five
    value = np.log(five / math.sqrt(2.0 * math.pi)) - 0.5 * u[:, 0] ** 2
    wanted = [value, STEP * slope, STEP**2 * (3.75 * one / five - slope**2)]
    np.testing.assert_allclose(TABLE, wanted, rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize("u", [-2e3, -30.1, -29.9, -7.99, -2.51, -0.04, 0.5749, 4.9, 5.1, 13.97])
def test_the_table_gives_the_integral_and_its_slope(u):
    mp.mp.dps = 30
    big = mp.mpf(u)

    def exact(n):
        return mp.gamma(n + 1) / mp.sqrt(2 * mp.pi) * mp.exp(-big * big / 4) * mp.pcfd(-n - 1, big)

    value, slope = contact_integral(u)
    assert value == pytest.approx(float(exact(2.5)), rel=1e-10)
    assert slope == pytest.approx(float(-2.5 * exact(1.5)), rel=1e-8)


def test_the_table_ends_in_the_quadrature_below_and_in_nothing_above():
    assert contact_integral(-8.0 - 1e-12)[0] == pytest.approx(contact_integral(-8.0)[0], rel=1e-10)
    assert contact_integral(14.0) == (0.0, 0.0) and math.isnan(contact_integral(math.nan)[0])


@pytest.mark.parametrize("u", [-30.0, -3.0, 0.0, 0.5749, 1.5, 4.99, 5.01, 8.0, 20.0, 36.0])
def test_the_area_integrals_are_exact_to_13_digits(u):
    """F_2 and F_1 from the error function, in arithmetic of 60 digits."""
    mp.mp.dps = 60
    big = mp.mpf(u)
    tail, pdf = mp.erfc(big / mp.sqrt(2)) / 2, mp.npdf(big)
    second, first = area_integrals(u)
    assert second == pytest.approx(float((1 + big**2) * tail - big * pdf), rel=2e-13)
    assert first == pytest.approx(float(pdf - big * tail), rel=1e-13)


def test_two_rough_surfaces_are_every_pair_of_their_summits():
    """Pairs r apart overlap by w - r^2/(4 beta) and touch as spheres of half the tip radius."""
    density, tip, scatter, stiff, t = 3e9, 2e-5, 4e-7, 1.1e11, 1.3

    def pair_sum(law):
        def over_offsets(w):
            return quad(lambda v: 2.0 * math.pi * 2.0 * tip * law(v), 0.0, w)[0]

        def weighted(s):
            return over_offsets(scatter * (s - t)) * math.exp(-0.5 * s * s)

        total = quad(weighted, t, t + 9.0, epsabs=0.0, epsrel=1e-10)[0]
        return density**2 * total / math.sqrt(2.0 * math.pi)

    scale, group = pressure_scale(scatter, stiff, density, tip), density * tip * scatter
    force = pair_sum(lambda w: 4.0 / 3.0 * stiff * math.sqrt(0.5 * tip) * w**1.5)
    area = pair_sum(lambda w: math.pi * 0.5 * tip * w)
    assert scale * height_integrals(t)[0] == pytest.approx(force, rel=1e-8)
    assert (math.pi * group) ** 2 * area_integrals(t)[0] == pytest.approx(area, rel=1e-8)
