"""Hard points: solved within the budget of iterations, or given up by name."""

from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import SolveError, Status, WasherParams, solve_washer
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.draw_constants import MANY, Constants
from thrustwasher.washer.draws import solve_draws
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.continuation import BUDGET
from thrustwasher.washer.kernels.workspace import size_of_state
from thrustwasher.washer.neighbours import Family, chain, spread
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


# Draws of washers: contact tables over the roughness, guesses, the order of a batch.

NODES = (10, 32)


@pytest.mark.parametrize("law", ["surface", "summit"])
def test_constants_over_the_roughness_are_those_of_each_washer(law):
    rng = np.random.default_rng(3)
    washers = [
        WasherParams(roughness=a, roughness_gear=b, asperity_height_law=law)
        for a, b in rng.uniform(3e-7, 2e-6, (MANY, 2))
    ]
    numbers = np.array([[*as_numbers(p), L.FIELD] for p in washers])
    found = Constants(numbers, NODES)
    for own, params in zip(numbers[:6], washers[:6], strict=True):
        par, expected = found(own), constants(params, NODES)
        assert par[: L.D_TABLE1] == pytest.approx(expected[: L.D_TABLE1], rel=1e-14)
        tables = slice(L.D_TABLE1, L.D_MESH)
        assert np.abs(par[tables] - expected[tables]).max() < 1e-9
        end = L.D_MESH + L.N_RADIAL * NODES[0] + L.N_AROUND * NODES[1]
        assert np.array_equal(par[L.D_MESH : end], expected[L.D_MESH : end])


def test_few_washers_have_their_own_constants():
    params = WasherParams(roughness=6e-7)
    own = np.array([*as_numbers(params), L.FIELD])
    par, expected = Constants(own[None], NODES)(own), constants(params, NODES)
    assert np.array_equal(par[: L.D_MESH], expected[: L.D_MESH])


def test_a_guess_is_exact_on_a_plane():
    rng = np.random.default_rng(4)
    x, slopes = rng.normal(size=(60, 3)), rng.normal(size=(3, 5))
    family = Family()
    assert family.guess(x[0]) is None
    family.add(x[0], x[0] @ slopes)
    assert np.array_equal(family.guess(x[1]), x[0] @ slopes)
    for own in x[1:]:
        family.add(own, own @ slopes)
    at = np.array([0.1, -0.2, 0.3])
    assert family.guess(at) == pytest.approx(at @ slopes, abs=1e-2)


def test_an_order_has_every_draw_once_and_goes_by_small_steps():
    rows = np.column_stack((np.full(80, 7.0), np.random.default_rng(5).uniform(1.0, 2.0, (80, 2))))
    x = spread(rows)
    order = chain(x)
    assert x.shape == (80, 2) and sorted(order) == list(range(80))
    steps = [np.linalg.norm(np.diff(x[list(o)], axis=0), axis=1).mean() for o in (order, range(80))]
    assert steps[0] < 0.5 * steps[1]


def test_draws_that_cannot_be_solved_leave_the_others_alone():
    good = WasherParams(gear_far_face="bulk")
    params = [good, None, replace(good, roughness=6e-7), good]
    inputs = np.tile([300.0, 545.0, 2e-3, 300.0, 310.0], (4, 1))
    inputs[3, L.I_FAR_FACE] = 100.0  # K: too cold
    rows, status, lost = solve_draws(params, inputs, "field", above=False)
    assert status.tolist() == [0, 15, 0, 15] and not lost.any()
    assert np.isfinite(rows[[0, 2]]).all() and np.isnan(rows[[1, 3]]).all()
