"""Contact of the lining against parabolic cylinder functions, and the separation root."""

import math

import mpmath as mp
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thrustwasher.kernels.lining import height_integrals, pressure_scale, separation


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


def test_tabled_values_come_back():
    assert height_integrals(0.0)[0] == pytest.approx(0.6166342, abs=5e-8)
    assert height_integrals(0.25)[0] == pytest.approx(0.3919785, abs=5e-8)
    assert height_integrals(1.5)[0] == pytest.approx(0.0228631, abs=5e-8)


def test_default_lining_settles_at_the_known_separation():
    scale = pressure_scale(8.41e-6, 2.7e7, 7e7, 8e-4)
    assert separation(0.6e6 / scale, 1.0)[0] == pytest.approx(0.5749, abs=2e-4)


@given(st.floats(-20.0, 7.5), st.floats(-30.0, 8.0))
def test_separation_is_found_from_every_start(u, guess):
    found, status, iterations = separation(height_integrals(u)[0], guess)
    assert status == 0 and iterations < 20
    assert found == pytest.approx(u, abs=1e-9)


def test_no_pressure_and_absurd_pressure_have_an_answer():
    assert separation(0.0, 1.0) == (11.0, 0, 0)
    assert separation(1e30, 1.0)[:2] == (-1000.0, 0)
    assert math.isfinite(separation(1e-29, -900.0)[0])
