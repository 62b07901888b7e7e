"""Hertz's line contact from its integral equation; the heights of rough surfaces by summing."""

import math

import mpmath as mp
import pytest
from closed_forms.greenwood import (
    elastic_pressure,
    first_moment,
    height_moment,
    real_area_share,
    second_moment,
    tail_share,
    two_sided_area_share,
    two_sided_pressure,
)
from closed_forms.line_contact import (
    compliance,
    dowson_higginson,
    full_width,
    peak_pressure,
    vogel_viscosity,
)
from scipy.integrate import quad

THETA = 2.0 * compliance(205e9, 0.3)


def test_the_pressure_carries_the_load():
    load, radius = 2.5e4, 0.008
    half, top = 0.5 * full_width(load, radius, THETA), peak_pressure(load, radius, THETA)
    carried = quad(lambda x: top * math.sqrt(1.0 - (x / half) ** 2), -half, half)[0]
    assert carried == pytest.approx(load, rel=1e-9)
    assert top == pytest.approx(math.sqrt(load / (math.pi * radius * THETA)), rel=1e-13)


@pytest.mark.parametrize("place", [-0.7, 0.2, 0.9])
def test_the_pressure_flattens_the_gap(place):
    """Slope of two half spaces: -(2 theta/pi) times the principal value of p(s)/(x - s)."""
    load, radius = 2.5e4, 0.008
    half, top = 0.5 * full_width(load, radius, THETA), peak_pressure(load, radius, THETA)
    value = quad(lambda u: -math.sqrt(1.0 - u * u), -1.0, 1.0, weight="cauchy", wvar=place)[0]
    assert -2.0 * THETA / math.pi * top * value == pytest.approx(-place * half / radius, rel=1e-6)


def test_film_thickness_has_the_powers_of_its_groups():
    usual = dowson_higginson(2.5e4, 0.008, THETA, 0.2, 5.0, 2.2e-8)
    assert dowson_higginson(2.5e4, 0.008, THETA, 0.4, 5.0, 2.2e-8) / usual == pytest.approx(2**0.7)
    assert dowson_higginson(2.5e4, 0.008, THETA, 0.2, 10.0, 2.2e-8) / usual == pytest.approx(2**0.7)
    assert dowson_higginson(5e4, 0.008, THETA, 0.2, 5.0, 2.2e-8) / usual == pytest.approx(2**-0.13)
    assert dowson_higginson(2.5e4, 0.016, THETA, 0.2, 5.0, 2.2e-8) / usual == pytest.approx(2**0.43)


def test_viscosity_of_the_oil_at_60_degrees_and_at_the_inlet():
    assert vogel_viscosity(60.0, 9.7e-5, 755.0, 70.0) == pytest.approx(0.03228646, abs=5e-9)
    assert vogel_viscosity(26.7, 9.7e-5, 755.0, 70.0) == pytest.approx(0.2386, abs=1e-4)


def exact_moment(order, separation):
    mp.mp.dps = 40
    n, t = mp.mpf(order), mp.mpf(separation)
    front = mp.gamma(n + 1) / mp.sqrt(2 * mp.pi)
    return front * mp.e ** (-t * t / 4) * mp.pcfd(-n - 1, t)


@pytest.mark.parametrize("order", [0, 1, 1.5, 2, 2.5, 3])
@pytest.mark.parametrize("t", [-5.0, -0.5, 0.0, 1.4, 4.0, 8.0, 30.0])
def test_moments_of_the_heights_are_good_to_eleven_digits(order, t):
    assert height_moment(order, t) == pytest.approx(
        float(exact_moment(order, t)), rel=1e-11, abs=0.0
    )


@pytest.mark.parametrize("t", [-5.0, -1.0, 0.0, 0.5, 1.4, 2.0, 3.0])
def test_whole_orders_are_elementary(t):
    for closed, order in ((tail_share, 0), (first_moment, 1), (second_moment, 2)):
        assert closed(t) == pytest.approx(float(exact_moment(order, t)), rel=1e-13, abs=0.0)


def test_first_moments_have_their_tabled_values():
    found = [height_moment(1.0, t) for t in (0.0, 1.4, 2.0)]
    assert found == pytest.approx([0.39894228, 0.03666814, 8.4907026e-3], abs=5e-9)
    # with the factor u and the lower limit 0 that are printed the integral is another function
    printed = [t * quad(lambda s, t=t: (s - t) * math.exp(-0.5 * s * s), 0.0, 40.0)[0]
               / math.sqrt(2.0 * math.pi) for t in (1.4, 2.0)]  # fmt: skip
    assert min(printed) < 0.0


@pytest.mark.parametrize("order", [0.5, 1.5, 2.5])
def test_each_moment_is_the_slope_of_the_next(order):
    """dF_(n+1)/dt = -(n + 1) F_n, by differences."""
    step = 1e-4
    ends = [height_moment(order + 1.0, 1.0 + d) for d in (-step, step)]
    slope = (ends[1] - ends[0]) / (2.0 * step)
    assert slope == pytest.approx(-(order + 1.0) * height_moment(order, 1.0), rel=1e-7)


def test_area_without_film_is_the_area_at_film_ratio_0():
    assert real_area_share(0.0, 0.05) == pytest.approx(0.05 * math.sqrt(math.pi / 2.0), rel=1e-13)
    ratios = [1.0 / real_area_share(t, 0.05) for t in (0.5, 1.0, 1.4, 2.0, 3.0)]
    assert ratios == pytest.approx([32.2, 76.4, 173.6, 749.8, 1.665e4], rel=2e-3)


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

    group = density * tip * scatter
    force = pair_sum(lambda w: 4.0 / 3.0 * stiff * math.sqrt(0.5 * tip) * w**1.5)
    area = pair_sum(lambda w: math.pi * 0.5 * tip * w)
    assert two_sided_pressure(t, group, scatter / tip, stiff) == pytest.approx(force, rel=1e-8)
    assert two_sided_area_share(t, group) == pytest.approx(area, rel=1e-8)


def test_the_mean_pressure_on_the_summits_hardly_falls_while_their_area_vanishes():
    group, slope, stiff = 0.05, 0.01, 1.1e11
    areas = [real_area_share(t, group) for t in (0.5, 3.0)]
    loads = [elastic_pressure(t, stiff, 1.0, group / slope, slope) for t in (0.5, 3.0)]
    assert areas[0] / areas[1] > 500.0
    assert 0.69 < loads[1] / areas[1] / (loads[0] / areas[0]) < 0.71
