"""The washer on a mesh of 5 x 8 nodes: small enough to run as plain Python, whole all the same."""

import math

import numpy as np
import pytest

from thrustwasher.errors import Status
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels import step as kernel
from thrustwasher.washer.kernels.layout import N_HEAD
from thrustwasher.washer.kernels.workspace import size_of_state, size_of_work
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import solve_washer

GRID = (5, 8)
PARAMS = WasherParams()
FILM = {"load": 300.0, "speed": 545.0, "tilt": 2e-3}
CONTACT = {"load": 1500.0, "speed": 545.0, "tilt": 2e-3}


def solve(**changes):
    return solve_washer(PARAMS, grid=GRID, **{**FILM, **changes})


@pytest.mark.parametrize(("point", "branch"), [(FILM, "film"), (CONTACT, "contact")])
def test_both_branches_carry_their_load(point, branch):
    r = solve(**point)
    said = Status.DISTRESS if branch == "contact" else Status.OK
    assert (r.status, r.branch) == (said, branch)
    assert r.fluid_load + r.contact_load == pytest.approx(r.load, rel=1e-6)
    assert r.temperature_max > r.temperature > r.oil_temperature


def test_a_warm_start_ends_where_a_cold_one_does():
    """Both stop where the load is balanced to some 1e-6."""
    warm = solve(load=330.0, start=solve())
    assert warm.friction_torque == pytest.approx(solve(load=330.0).friction_torque, rel=1e-5)


@pytest.mark.parametrize(
    "law",
    [
        {"conduction": "all"},
        {"conduction": "rotating"},
        {"oil_cooling": False},
        {"cavity_shear": "liquid"},
        {"friction_law": "constant"},
        {"asperity_height_law": "summit"},
    ],
)
def test_other_laws_balance_too(law):
    r = solve_washer(WasherParams(**law), grid=GRID, **CONTACT)
    assert r.fluid_load + r.contact_load == pytest.approx(r.load, rel=1e-6)


def test_steps_go_on_from_their_memory_and_fail_without_harming_it():
    par = constants(PARAMS, GRID)
    state, work = np.zeros(size_of_state(*GRID)), np.zeros(N_HEAD + size_of_work(*GRID))
    out, iout = np.zeros(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
    loads = []
    for load in (300.0, 320.0):
        inp = np.array([load, 545.0, 2e-3, 297.15, 0.0, 0.0])
        assert kernel.step(par, inp, state, work, out, iout, 0.0, 1e-3) == Status.OK
        loads.append(out[0])
    assert loads[0] != loads[1]
    before = state.copy()
    inp[0] = math.nan
    assert kernel.step(par, inp, state, work, out, iout, 0.0, 1e-3) >= Status.MAX_ITERATIONS
    assert np.array_equal(state, before)


def test_the_curve_has_its_folds():
    from thrustwasher.washer.load_curve import load_curve

    curve = load_curve(PARAMS, speed=545.0, tilt=2e-3, grid=GRID)
    assert [f.kind for f in curve.folds] == ["film_lost", "film_regained"]
