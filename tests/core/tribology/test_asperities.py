"""Asperity contact against adaptive quadrature, the elastic closed form and published numbers."""

import itertools
import math

import numpy as np
import pytest
from closed_forms.greenwood import elastic_pressure
from scipy.integrate import quad

from thrustwasher.tribology.asperities import (
    D_MIN,
    N_CONTACT_WORK,
    N_TABLE,
    asperity_args,
    asperity_force,
    contact_pressure,
    contact_table,
)

E, NU, SY, RADIUS, DENSITY = 201e9, 0.296, 0.993e9, 1e-5, 6.865114e9
BOTH = E / (2.0 * (1.0 - NU**2))  # E' of two such bodies
SIGMA = math.sqrt(2.0) * 5.15e-7
BASE = asperity_args(BOTH, E, NU, SY, False, RADIUS)
SUMMIT = 0.045944 / (DENSITY * RADIUS * SIGMA)


def table_of(args=BASE, density=DENSITY, sigma=SIGMA):
    table = np.empty(N_TABLE)
    assert contact_table(args, density, sigma, table, np.full(N_CONTACT_WORK, np.nan))
    return table


TABLE = table_of()


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
    assert contact_pressure(h - SUMMIT, TABLE)[0] == pytest.approx(expected, rel=1.5e-6)


@pytest.mark.parametrize("d", [-7.99, -5.531, -2.02, -0.47, 0.033, 1.2345, 2.71, 4.4, 7.77, 12.9])
def test_table_agrees_with_quadrature(d):
    assert contact_pressure(d, TABLE)[0] == pytest.approx(pressure_by_quadrature(d), rel=1e-10)


@pytest.mark.parametrize("t", [0.0, 1.0, 3.0, -2.0, 5.5])
def test_without_yield_it_is_greenwood_and_williamson(t):
    table = table_of(asperity_args(BOTH, E, NU, 1e13, False, RADIUS))
    expected = elastic_pressure(t, BOTH, RADIUS, DENSITY, SIGMA)
    assert contact_pressure(t, table)[0] == pytest.approx(expected, rel=1e-10)


def test_pressure_ends_beyond_fourteen_and_goes_on_straight_below_minus_eight():
    assert contact_pressure(14.0, TABLE) == (0.0, 0.0)
    assert contact_pressure(1e9, TABLE) == (0.0, 0.0)
    p, dp = contact_pressure(D_MIN, TABLE)
    assert contact_pressure(D_MIN - 100.0, TABLE)[0] == pytest.approx(p - 100.0 * dp, rel=1e-12)


def test_pressure_falls_with_separation():
    p = [contact_pressure(d, TABLE)[0] for d in np.linspace(-12.0, 13.99, 400)]
    assert np.all(np.diff(p) < 0.0)


def test_contact_that_cannot_be_tabulated_is_said():
    bad = asperity_args(BOTH, E, NU, math.nan, False, RADIUS)
    assert not contact_table(bad, DENSITY, SIGMA, np.empty(N_TABLE), np.empty(N_CONTACT_WORK))


def test_no_number_in_no_number_out():
    plain = getattr(contact_pressure, "py_func", contact_pressure)
    assert math.isnan(plain(math.nan, TABLE)[0])
