"""Film functions against integrals over the heights, their published values and differences."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from thrustwasher.tribology.flow_factors import flow_conductance, mean_gap, shear_flow
from thrustwasher.tribology.lumped_body import exponential_weights
from thrustwasher.tribology.viscosity import viscosity

SIGMA = 7.2832e-7


@pytest.mark.parametrize(
    ("u", "expected"), [(0.0, 0.398942280401), (1.0, 1.083315470588), (3.0, 3.000382154317)]
)
def test_mean_gap_has_its_exact_values(u, expected):
    assert mean_gap(u * SIGMA, SIGMA)[0] / SIGMA == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("u", [-3.0, -0.7, 0.2, 1.8, 4.0])
def test_mean_gap_is_the_mean_of_the_open_heights(u):
    integral = quad(
        lambda z: (u - z) * math.exp(-0.5 * z * z) / math.sqrt(2 * math.pi), -14.0, u, epsabs=1e-14
    )[0]
    assert mean_gap(u * SIGMA, SIGMA)[0] == pytest.approx(integral * SIGMA, rel=1e-10)


@settings(derandomize=True, deadline=None, max_examples=60)
@given(st.floats(-60.0, 200.0))
def test_mean_gap_is_positive_and_not_below_the_gap(u):
    value, slope = mean_gap(u * SIGMA, SIGMA)
    assert value > 0.0 and 0.0 <= slope <= 1.0
    assert value >= u * SIGMA * (1.0 - 1e-12)


def test_flow_factor_has_its_published_value():
    assert flow_conductance(3.0 * SIGMA, SIGMA)[0] / (3.0 * SIGMA) ** 3 == pytest.approx(
        0.832263, abs=5e-7
    )


def test_flow_conductance_goes_on_smoothly_below_half_sigma():
    """The continuation H30 exp(g0 (h - h0)) takes over value and slope at h0 = 0.5 sigma."""
    above, below = (flow_conductance(u * SIGMA, SIGMA) for u in (0.5, 0.5 - 1e-12))
    assert above == pytest.approx(below, rel=1e-10)
    assert above[0] / SIGMA**3 == pytest.approx(0.03997433, abs=5e-9)
    assert above[1] / above[0] * SIGMA == pytest.approx(7.191124, abs=5e-7)
    expected = above[0] * math.exp(-7.191123823716943 * 1.3)
    assert flow_conductance(-0.8 * SIGMA, SIGMA)[0] == pytest.approx(expected, rel=1e-12)


def test_published_shear_fits_meet_at_five_sigma():
    """Only with 0.05 (h/sigma)^2 in the exponent do they: 0.322574 against 0.322604."""
    assert shear_flow(5.0 * SIGMA, SIGMA)[0] == pytest.approx(0.322574, abs=5e-7)
    assert shear_flow(5.000001 * SIGMA, SIGMA)[0] == pytest.approx(0.322604, abs=5e-7)


def test_shear_flow_of_a_closed_gap_is_zero():
    assert shear_flow(0.0, SIGMA) == (0.0, 0.0)
    assert shear_flow(-2.0 * SIGMA, SIGMA) == (0.0, 0.0)


def test_film_functions_never_leave_the_range_of_numbers():
    for u in (-1e6, -100.0, -30.0, 80.0, 1e6):
        for function in (mean_gap, flow_conductance, shear_flow):
            assert np.all(np.isfinite(function(u * SIGMA, SIGMA)))


# The lumped body's temperature: closed form against its own differential equation and limits.


def temperature_after(start, ambient, capacity, cooling, power_start, power_end, duration):
    """Return the body's temperature under a power that changes linearly."""
    decay, first, second = exponential_weights(cooling * duration / capacity)
    gain = power_start * first + (power_end - power_start) * second
    return ambient + (start - ambient) * decay + gain * duration / capacity


def test_constant_power_approaches_the_balance_exponentially():
    rise = 1000.0 / 20.0
    found = temperature_after(300.0, 300.0, 50.0, 20.0, 1000.0, 1000.0, 2.5)
    assert found == pytest.approx(300.0 + rise * (1.0 - math.exp(-1.0)), rel=1e-14)


def test_without_cooling_all_heat_stays():
    assert temperature_after(300.0, 300.0, 50.0, 0.0, 0.0, 100.0, 1.0) == pytest.approx(301.0)


@given(st.floats(0.0, 50.0), st.floats(0.0, 1e4), st.floats(0.0, 1e4), st.floats(0.01, 0.99))
def test_two_parts_of_a_step_make_the_whole(cooling, first, last, share):
    """Exactness shows as independence of the step."""
    middle = first + share * (last - first)
    whole = temperature_after(310.0, 295.0, 12.0, cooling, first, last, 2.0)
    half = temperature_after(310.0, 295.0, 12.0, cooling, first, middle, 2.0 * share)
    both = temperature_after(half, 295.0, 12.0, cooling, middle, last, 2.0 * (1.0 - share))
    assert both == pytest.approx(whole, rel=1e-12)


def test_weights_are_continuous_where_the_series_ends():
    for below, above in zip(
        exponential_weights(0.02 - 1e-15), exponential_weights(0.02), strict=True
    ):
        assert below == pytest.approx(above, rel=1e-13)


def test_a_step_of_any_length_is_finite():
    assert temperature_after(900.0, 300.0, 1e-3, 1e5, 0.0, 0.0, 1e6) == pytest.approx(300.0)


# Viscosity law against the other published form, known values and differences.

OIL = (6.31e-5, 3.545, 1.053)


@pytest.mark.parametrize(
    ("celsius", "expected"), [(24.0, 6.080578e-2), (40.0, 3.143313e-2), (100.0, 5.991838e-3)]
)
def test_known_values(celsius, expected):
    assert viscosity(celsius + 273.15, *OIL)[0] == pytest.approx(expected, rel=1.5e-7)


@pytest.mark.parametrize("celsius", [-30.0, 24.0, 77.0, 600.0])
def test_both_published_forms_agree(celsius):
    """The other one has mu in mPa s: log10(log10(mu) + 1.2) falls linearly in log10(1 + T/135)."""
    mu = viscosity(celsius + 273.15, *OIL)[0]
    line = math.log10(3.545) - 1.053 * math.log10(1.0 + celsius / 135.0)
    # 1.2 is rounded: 10^-1.19997 mPa s is 6.31e-5 Pa s
    assert math.log10(1e3 * mu) + 1.2 == pytest.approx(10.0**line, abs=3e-5)


@pytest.mark.parametrize("kelvin", [-1e6, 0.0, 138.15, 1e6])
def test_absurd_temperatures_stay_finite(kelvin):
    mu, slope = viscosity(kelvin, *OIL)
    assert 0.0 < mu <= 6.31e7 and math.isfinite(slope) and slope <= 0.0
