"""Exponential and logarithm without a branch: against 50 digits, and a viscosity of them."""

import math

import mpmath as mp
import numpy as np
import pytest

from thrustwasher.numerics.elementary import LARGEST, straight_exp, straight_log
from thrustwasher.tribology.viscosities import straight_viscosity
from thrustwasher.tribology.viscosity import viscosity

DRAW = np.random.default_rng(1)


def ulps(found, exact):
    """Return the error in units of the last place."""
    return float(abs(mp.mpf(found) - exact)) / math.ulp(found)


@pytest.mark.parametrize("reach", [1e-9, 0.4, 30.0, 700.0])
def test_the_exponential_is_good_to_one_unit_in_the_last_place(reach):
    with mp.workdps(50):
        points = [*DRAW.uniform(-reach, reach, 3000).tolist(), 0.0, reach, -reach]
        assert max(ulps(straight_exp(x), mp.exp(x)) for x in points) < 1.0
    assert straight_exp(0.0) == 1.0


def test_the_exponential_holds_beyond_its_range():
    assert straight_exp(1e4) == straight_exp(LARGEST) < math.inf
    assert straight_exp(-1e4) == straight_exp(-LARGEST) > 0.0


@pytest.mark.parametrize("reach", [1e-9, 0.5, 7.0, 700.0])
def test_the_logarithm_is_good_to_one_unit_in_the_last_place(reach):
    with mp.workdps(50):
        points = [math.exp(x) for x in DRAW.uniform(-reach, reach, 3000)]
        assert max(ulps(straight_log(x), mp.log(x)) for x in points if x != 1.0) < 1.0
    assert straight_log(1.0) == 0.0


@pytest.mark.parametrize("temperature", [0.0, 139.0, 200.0, 233.15, 297.15, 373.15, 900.0])
def test_the_viscosity_of_several_temperatures_is_that_of_each(temperature):
    """Below 138 K x counts 1e-3 and the power 12, as for one."""
    given = temperature, 5.9e-5, 4.2, 1.3
    assert straight_viscosity(*given) == pytest.approx(viscosity(*given), rel=1e-14, abs=0.0)
