"""A solve on a mesh starts where a map says that the washer is, and ends where it would without."""

import math

import numpy as np
import pytest

from thrustwasher.errors import BranchError
from thrustwasher.washer import solve
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import solve_washer

PARAMS = WasherParams()
POINTS = [
    # load [N], speed [rad/s], tilt [rad], branch: clear film, one curve in contact, both branches
    (300.0, 953.0, 0.002, "film"), (1361.0, 136.0, 0.002, "contact"),
    (600.0, 545.0, 0.002, "film"), (850.0, 545.0, 0.002, "contact"),
]  # fmt: skip


def from_nothing(monkeypatch, **point):
    with monkeypatch.context() as patch:
        patch.setattr(solve, "_map_guess", lambda: lambda *_: None)
        return solve_washer(PARAMS, **point, throw=False)


def agrees(one, other):
    assert (one.branch, one.status, one.distress) == (other.branch, other.status, other.distress)
    assert one.friction_torque == pytest.approx(other.friction_torque, rel=3e-9)
    assert one.temperature_max == pytest.approx(other.temperature_max, rel=3e-9)


@pytest.mark.parametrize(("load", "speed", "tilt", "branch"), POINTS)
def test_the_solution_is_that_from_nothing_in_fewer_iterations(
    monkeypatch, load, speed, tilt, branch
):
    point = {"load": load, "speed": speed, "tilt": tilt, "branch": branch}
    quick, slow = solve_washer(PARAMS, **point), from_nothing(monkeypatch, **point)
    agrees(quick, slow)
    assert quick.iterations < slow.iterations


@pytest.mark.parametrize("n", [40, pytest.param(400, marks=pytest.mark.slow)])
def test_in_the_box_and_around_it_branch_and_solution_are_those_from_nothing(monkeypatch, n):
    draw = np.random.default_rng(n)
    low, high = np.log([10.0, 20.0, 6e-4, 285.0]), np.log([2500.0, 1500.0, 4e-3, 410.0])
    for place in np.exp(draw.uniform(low, high, (n, 4))):
        point = dict(zip(("load", "speed", "tilt", "oil_temperature"), place, strict=True))
        agrees(solve_washer(PARAMS, **point, throw=False), from_nothing(monkeypatch, **point))


@pytest.mark.parametrize("ratio", [0.3, 40.0])
@pytest.mark.parametrize("branch", [L.FILM_BRANCH, L.CONTACT_BRANCH])
def test_a_wrong_guess_is_found_out(monkeypatch, ratio, branch):
    point = {"load": 650.0, "speed": 545.0, "tilt": 0.002}

    def wrong(_params, _point, _required, state):
        state[L.S_VALID], state[L.S_BRANCH] = L.GUESSED, branch
        state[L.S_MULTIPLICITY], state[L.S_RATIO] = L.MULTIPLE, ratio
        state[L.S_FIELDS : L.S_FIELDS + 2] = 500.0

    slow = from_nothing(monkeypatch, **point)
    monkeypatch.setattr(solve, "_map_guess", lambda: wrong)
    agrees(solve_washer(PARAMS, **point, throw=False), slow)


def test_a_branch_that_is_not_there_is_refused_all_the_same():
    with pytest.raises(BranchError, match="branch = 'contact'"):
        solve_washer(PARAMS, load=100.0, speed=953.0, tilt=0.002, branch="contact")


def test_a_solve_that_goes_on_from_there_is_as_quick_as_one_from_nothing(monkeypatch):
    """The heat factor that it goes on with is one made at the solution, not at the guess."""
    point = {"load": 300.0, "speed": 953.0, "tilt": 0.002}
    slow = from_nothing(monkeypatch, **point)
    after = [
        solve_washer(PARAMS, **(point | {"load": 303.0}), start=start)
        for start in (solve_washer(PARAMS, **point), slow)
    ]
    assert math.isclose(after[0].friction_torque, after[1].friction_torque, rel_tol=1e-6)
    assert after[0].iterations <= after[1].iterations + 1
