"""Viscosity law against the other published form, known values and differences."""

import math

import pytest

from thrustwasher.tribology.viscosity import viscosity

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
