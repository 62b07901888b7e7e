"""The lumped body's temperature: closed form against its own differential equation and limits."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from thrustwasher.tribology.lumped_body import exponential_weights


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
