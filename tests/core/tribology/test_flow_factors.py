"""Film functions against integrals over the heights, their published values and differences."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from thrustwasher.tribology.flow_factors import flow_conductance, mean_gap, shear_flow

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
