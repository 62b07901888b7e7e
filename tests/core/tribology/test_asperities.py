"""Contact of the lining against parabolic cylinder functions, and the separation root."""

import itertools
import math

import mpmath
import mpmath as mp
import numpy as np
import pytest
from closed_forms.greenwood import elastic_pressure
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from thrustwasher.numerics import smoothing
from thrustwasher.tribology import greenwood_williamson as gw
from thrustwasher.tribology.asperities import (
    D_MIN,
    N_CONTACT_WORK,
    N_TABLE,
    asperity_args,
    asperity_force,
    contact_pressure,
    contact_table,
)
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


# Asperity contact against adaptive quadrature, the elastic closed form and published numbers.

E, NU, SY, RADIUS, DENSITY = 201e9, 0.296, 0.993e9, 1e-5, 6.865114e9
BOTH = E / (2.0 * (1.0 - NU**2))  # E' of two such bodies
SIGMA = math.sqrt(2.0) * 5.15e-7
BASE = asperity_args(BOTH, E, NU, SY, False, RADIUS)
SUMMIT = 0.045944 / (DENSITY * RADIUS * SIGMA)


def table_of(args=BASE, density=DENSITY, sigma=SIGMA):
    table = np.empty(N_TABLE)
    assert contact_table(args, density, sigma, table, np.full(N_CONTACT_WORK, np.nan))
    return table


ASPERITIES_TABLE = table_of()


def published_force(x):
    """Return P_F/P_c of the fit, written out again."""
    c, e_y = 1.295 * math.exp(0.736 * NU), SY / E
    if x <= 1.9:
        return x**1.5
    b = 0.14 * math.exp(23.0 * e_y)
    strain = math.pi * c * e_y / 2.0 * math.sqrt(x) * (x / 1.9) ** (b / 2.0)
    hardness = 2.84 * (1.0 - math.exp(-0.82 * strain**-0.7))
    plastic = 4.0 * hardness / c * (1.0 - math.exp(-(x ** (5 / 9)) / 25.0)) * x
    return math.exp(-(x ** (5 / 12)) / 4.0) * x**1.5 + plastic


def pressure_by_quadrature(d):
    """Return P(d) [Pa] at d [sigma], adaptive in two pieces that end at w* = 1.9."""
    w_c = BASE.critical_interference / SIGMA
    split = 1.9 * w_c

    def share(w):
        # relative to the Gaussian at max(d, 0)
        return published_force(w / w_c) * math.exp(-0.5 * (w + d) ** 2 + 0.5 * max(d, 0.0) ** 2)

    low = quad(lambda v: 2.0 * v * share(v * v), 0.0, math.sqrt(split), epsabs=0, epsrel=1e-12)[0]
    edges = [split, 0.2, 1.0, 3.0, 6.0, 9.0, 18.0]
    high = sum(
        quad(share, a, b, epsabs=0, epsrel=1e-12, limit=200)[0]
        for a, b in itertools.pairwise(edges)
        if a < 9.0 - min(d, 0.0)
    )
    front = DENSITY * BASE.critical_force / math.sqrt(2.0 * math.pi)
    return front * (low + high) * math.exp(-0.5 * max(d, 0.0) ** 2)


def test_asperity_constants_have_their_known_values():
    assert BASE.critical_interference == pytest.approx(5.199102e-9, rel=2e-7)
    assert BASE.critical_force == pytest.approx(1.741083e-4, rel=3e-7)
    assert BASE.c == pytest.approx(1.610213, abs=5e-7)
    assert BASE.b == pytest.approx(0.156847, abs=5e-7)
    assert asperity_args(BOTH, E, NU, SY, True, RADIUS).yield_strain == SY / BOTH


def test_a_softer_pair_is_pressed_in_further_before_it_yields():
    """w_c goes as 1/E'^2, P_c as 1/E'^2; the constants of the softer body stay its own."""
    half = asperity_args(0.5 * BOTH, E, NU, SY, False, RADIUS)
    assert half.critical_interference == pytest.approx(4.0 * BASE.critical_interference, rel=1e-14)
    assert half.critical_force == pytest.approx(4.0 * BASE.critical_force, rel=1e-14)
    assert (half.c, half.b, half.yield_strain) == (BASE.c, BASE.b, BASE.yield_strain)


@pytest.mark.parametrize(
    ("x", "expected"), [(1.0, 1.0), (1.9, 2.618969), (1.9 + 1e-9, 2.633579), (100.0, 449.9199)]
)
def test_force_of_one_asperity_has_its_published_values(x, expected):
    found = asperity_force(x * BASE.critical_interference, BASE) / BASE.critical_force
    assert found == pytest.approx(expected, rel=3e-7)


@pytest.mark.parametrize("x", [1e-6, 0.3, 1.89, 1.91, 8.0, 300.0, 2e4])
def test_force_of_one_asperity_is_the_published_fit(x):
    found = asperity_force(x * BASE.critical_interference, BASE) / BASE.critical_force
    assert found == pytest.approx(published_force(x), rel=1e-12)


def test_no_interference_no_force():
    assert asperity_force(0.0, BASE) == 0.0
    assert asperity_force(-1e-9, BASE) == 0.0


@pytest.mark.parametrize(("h", "expected"), [(0.0, 798.871e6), (1.0, 275.464e6), (3.0, 4.82362e6)])
def test_base_pressure_has_its_known_values(h, expected):
    assert contact_pressure(h - SUMMIT, ASPERITIES_TABLE)[0] == pytest.approx(expected, rel=1.5e-6)


@pytest.mark.parametrize("d", [-7.99, -5.531, -2.02, -0.47, 0.033, 1.2345, 2.71, 4.4, 7.77, 12.9])
def test_table_agrees_with_quadrature(d):
    assert contact_pressure(d, ASPERITIES_TABLE)[0] == pytest.approx(
        pressure_by_quadrature(d), rel=1e-10
    )


@pytest.mark.parametrize(
    "t", [0.0, -2.0, 5.5, *(pytest.param(x, marks=pytest.mark.slow) for x in (1.0, 3.0))]
)
def test_without_yield_it_is_greenwood_and_williamson(t):
    table = table_of(asperity_args(BOTH, E, NU, 1e13, False, RADIUS))
    expected = elastic_pressure(t, BOTH, RADIUS, DENSITY, SIGMA)
    assert contact_pressure(t, table)[0] == pytest.approx(expected, rel=1e-10)


def test_pressure_ends_beyond_fourteen_and_goes_on_straight_below_minus_eight():
    assert contact_pressure(14.0, ASPERITIES_TABLE) == (0.0, 0.0)
    assert contact_pressure(1e9, ASPERITIES_TABLE) == (0.0, 0.0)
    p, dp = contact_pressure(D_MIN, ASPERITIES_TABLE)
    assert contact_pressure(D_MIN - 100.0, ASPERITIES_TABLE)[0] == pytest.approx(
        p - 100.0 * dp, rel=1e-12
    )


def test_pressure_falls_with_separation():
    p = [contact_pressure(d, ASPERITIES_TABLE)[0] for d in np.linspace(-12.0, 13.99, 400)]
    assert np.all(np.diff(p) < 0.0)


def test_contact_that_cannot_be_tabulated_is_said():
    bad = asperity_args(BOTH, E, NU, math.nan, False, RADIUS)
    assert not contact_table(bad, DENSITY, SIGMA, np.empty(N_TABLE), np.empty(N_CONTACT_WORK))


def test_no_number_in_no_number_out():
    plain = getattr(contact_pressure, "py_func", contact_pressure)
    assert math.isnan(plain(math.nan, ASPERITIES_TABLE)[0])


# Real contact area: the overlap integral to rounding, the area ratio and its two bounds.


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
