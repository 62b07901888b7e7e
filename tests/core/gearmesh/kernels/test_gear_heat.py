"""Temperature rises of the gear mesh: laws of scale, Atan's printed forms, the viscosity root."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from thrustwasher.gearmesh.kernels import flank_temperature as h

B, C = 755.0, 70.0
NO_CAP = 1e300


def root(bulk, rise, exponent, cap=NO_CAP):
    """Solve with a rise of ``rise`` [K] at the bulk's viscosity."""
    t, stress, _, status, n = h.heated_flank(bulk, rise, 1.0, cap, exponent, B, C)
    return t, stress, status, n


def test_viscosity_of_the_papers_oil():
    assert h.oil_viscosity(333.15, 9.7e-5, B, C) == pytest.approx(0.03228646, rel=1e-6)
    assert h.oil_viscosity(299.85, 9.7e-5, B, C) == pytest.approx(0.2386, abs=5e-5)
    assert h.oil_viscosity(200.0, 9.7e-5, B, C) == h.oil_viscosity(h.LOWEST_OIL, 9.7e-5, B, C)


def test_bloks_factor_is_the_peak_under_an_elliptic_heat_source():
    """A band -1..1 passing a deep body: temperature 2/pi^1.5 int sqrt(1 - u^2)/sqrt(s - u) du."""

    def warmth(s):
        v, weight = np.polynomial.legendre.leggauss(400)
        top = math.sqrt(s + 1.0)
        v, weight = 0.5 * top * (v + 1.0), 0.5 * top * weight  # s - u = v^2
        return 2.0 / math.pi**1.5 * (2.0 * weight * np.sqrt(1.0 - (s - v**2) ** 2)).sum()

    best = minimize_scalar(lambda s: -warmth(s), bounds=(-0.5, 0.99), method="bounded")
    assert -best.fun == pytest.approx(h.ELLIPTIC, abs=2e-7)


def test_blok_makes_both_flanks_equally_hot():
    """Even heat: Blok's with factor sqrt(2/pi) is the flash rise of either flank with its share."""
    v1, v2, f, w, width, b = 1.36, 7.14, 0.09, 9e3, 5.7e-5, 13681.0
    share = math.sqrt(v1) / (math.sqrt(v1) + math.sqrt(v2))
    heat = f * w * (v2 - v1)
    pinion = h.flash_rise(share * heat, width, v1, b)
    gear = h.flash_rise((1.0 - share) * heat, width, v2, b)
    assert pinion == pytest.approx(gear, rel=1e-14)
    even = h.blok_rise(f, w, v1, v2, width, b, b) * math.sqrt(2.0 / math.pi) / h.ELLIPTIC
    assert even == pytest.approx(pinion, rel=1e-14)


@given(
    st.floats(233.15, 473.15),
    st.floats(-12.0, 8.0),
    st.sampled_from([0.0, 0.3, 1.0]),
    st.floats(-6.0, 12.0),
)
def test_the_root_is_bracketed_and_exact_from_freezing_to_absurd(bulk, decades, exponent, cap):
    rise, cap = 10.0**decades, 10.0**cap
    t, stress, status, n = root(bulk, rise, exponent, cap)
    assert status == 0 and n <= 60
    assert bulk <= t <= bulk + rise * min(1.0, cap) * (1 + 1e-12) + 1e-9
    assert t - bulk == pytest.approx(rise * stress, rel=1e-9, abs=1e-9)
    shear = math.exp(exponent * B * (1 / (t - 273.15 + C) - 1 / (bulk - 273.15 + C)))
    limited = h.shear_stress(shear, cap)[0]
    assert stress == pytest.approx(limited, rel=1e-9)


def test_a_limited_stress_never_passes_its_limit_and_is_untouched_far_below():
    assert h.shear_stress(1e6, 1e7) == (1e6, 1.0)
    assert h.shear_stress(1e9, 1e7) == (1e7, 0.0)
    assert max(h.shear_stress(s, 1e7)[0] for s in np.linspace(8e6, 1.2e7, 50)) <= 1e7
