"""Hard points: solved within the budget of iterations, or given up by name."""

import numpy as np
import pytest

from thrustwasher import SolveError, Status, WasherParams, solve_washer
from thrustwasher.washer.kernels.continuation import BUDGET
from thrustwasher.washer.kernels.workspace import size_of_state
from thrustwasher.washer.solve import GRIDS, _Prepared

# load [N], speed [rad/s], tilt [rad], oil [K]: contact so hot that it turns the washer
TURNED = [
    (6297.878, 213.261, 4.3456e-3, 268.970),
    (4736.0, 1350.1, 7.3527e-3, 235.97),
    (2608.4, -1915.4, 5.5458e-3, 249.63),
    (6237.2, 428.94, 6.4123e-3, 287.29),
]

# a large washer with soft asperities, hot far beyond any steel: no solution is found
LARGE = {
    "inner_radius": 0.02,
    "outer_radius": 0.04,
    "gear_inner_radius": 0.03,
    "roughness": 2e-7,
    "yield_strength": 4e8,
    "asperity_density": 5e10,
}
BEYOND = (9000.0, 1000.0, 0.008, 260.0)


def solved(params, load, speed, tilt, oil, **how):
    at = {"load": load, "speed": speed, "tilt": tilt, "oil_temperature": oil}
    return solve_washer(params, **at, throw=False, **how)


@pytest.mark.parametrize("point", TURNED)
def test_contact_that_turns_the_washer_is_solved(point):
    r = solved(WasherParams(), *point)
    assert not r.status.is_failure and r.iterations < BUDGET
    assert r.fluid_load + r.contact_load == pytest.approx(r.load, rel=1e-6)
    assert r.oil_heat == pytest.approx(r.friction_power, rel=1e-6)


@pytest.mark.slow
def test_it_is_solved_on_a_finer_mesh_too():
    r = solved(WasherParams(), 7076.0, -1945.9, 4.73e-3, 473.15, fidelity="fine")
    assert not r.status.is_failure and r.iterations < BUDGET


def test_a_tilt_of_a_thousand_roughnesses_is_solved():
    """The gear begins where it can touch the washer, however far the tilt lifts its middle."""
    r = solved(WasherParams(roughness=1.5e-7), 100.0, 1000.0, 0.009, 360.0)
    assert not r.status.is_failure and r.iterations < 200
    assert r.fluid_load + r.contact_load == pytest.approx(100.0, rel=1e-6)


@pytest.mark.slow
def test_a_search_beyond_the_budget_is_given_up_by_name():
    at = dict(zip(("load", "speed", "tilt", "oil_temperature"), BEYOND, strict=True))
    with pytest.raises(SolveError, match=r"1500 Newton iterations, at most 1500") as raised:
        solve_washer(WasherParams(**LARGE), **at)
    assert Status.OVER_BUDGET.advice in str(raised.value)


@pytest.mark.slow
def test_a_step_beyond_the_budget_leaves_the_memory_as_it_was():
    """As an FMU steps: the next step goes on from the last good one, to the bit."""
    ready, state = _Prepared(WasherParams(**LARGE), GRIDS["field"]), np.zeros(size_of_state(10, 32))

    def step(*inputs):
        ready.inp[:] = (*inputs, 0.0, 0.0)
        return ready.step(state, 0.0, 1e-3), state.copy()

    code, before = step(300.0, 953.0, 0.002, 297.15)
    assert code == Status.OK
    code, after = step(*BEYOND)
    assert code == Status.OVER_BUDGET
    np.testing.assert_array_equal(after, before)
    assert step(303.0, 953.0, 0.002, 297.15)[0] == Status.OK
