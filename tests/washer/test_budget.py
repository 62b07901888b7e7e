"""Hard points: solved within the budget of iterations."""

import pytest

from thrustwasher import WasherParams, solve_washer
from thrustwasher.washer.kernels.solve import BUDGET

# load [N], speed [rad/s], tilt [rad], oil [K]: contact so hot that it turns the washer
TURNED = [
    (6297.878, 213.261, 4.3456e-3, 268.970),
    (4736.0, 1350.1, 7.3527e-3, 235.97),
    (2608.4, -1915.4, 5.5458e-3, 249.63),
    (6237.2, 428.94, 6.4123e-3, 287.29),
]


def solved(params, load, speed, tilt, oil, **how):
    at = {"load": load, "speed": speed, "tilt": tilt, "oil_temperature": oil}
    return solve_washer(params, **at, throw=False, **how)


@pytest.mark.parametrize("point", TURNED)
def test_contact_that_turns_the_washer_is_solved(point):
    r = solved(WasherParams(), *point)
    assert not r.status.is_failure and r.iterations < BUDGET
    assert r.fluid_load + r.contact_load == pytest.approx(r.load, rel=1e-6)
    assert r.oil_heat == pytest.approx(r.friction_power, rel=1e-6)


def test_a_tilt_of_a_thousand_roughnesses_is_solved():
    """The gear begins where it can touch the washer, however far the tilt lifts its middle."""
    r = solved(WasherParams(roughness=1.5e-7), 100.0, 1000.0, 0.009, 360.0)
    assert not r.status.is_failure and r.iterations < 200
    assert r.fluid_load + r.contact_load == pytest.approx(100.0, rel=1e-6)
