"""Draws of washers: contact tables over the roughness, guesses, the order of a batch."""

from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import WasherParams
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.draw_constants import MANY, Constants
from thrustwasher.washer.draws import solve_draws
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.neighbours import Family, chain, spread

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
