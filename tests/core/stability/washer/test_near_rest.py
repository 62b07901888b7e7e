"""A washer near rest, whose curve of solutions has no folds to be looked for.

Hazard: which of several solutions a washer is on is found by a descent from light load, dozens of
    Newton iterations; near rest speeds change by their own size, and each step asked anew.
Formula: without folds the load has one solution; friction must thin the oil for a fold to be.
Cure: where a bound on how much it can says no, a solution that Newton's method finds is the one.
"""

import numpy as np
import pytest

from thrustwasher import WasherParams, load_curve, solve_washer
from thrustwasher.washer.follow import Follower
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.branch import is_cool
from thrustwasher.washer.kernels.workspace import Point, size_of_work, workspace_of

GRID = (10, 32)
PARTS = {
    "default": WasherParams(),
    "smooth": WasherParams(roughness=2e-7),
    "insulated": WasherParams(gear_far_face="insulated", conductivity=15.0),
    "high friction": WasherParams(friction_law="constant", dry_friction=0.3),
}


def is_cool_at(part, speed, tilt, oil):
    work = np.zeros(L.N_HEAD + size_of_work(*GRID))
    return is_cool(workspace_of(constants(part, GRID), work), Point(1.0, speed, tilt, oil, oil))


def fastest_cool(part, tilt, oil):
    """Return the highest speed [rad/s] up to 2000 that counts as cool."""
    low, high = 0.0, 2000.0
    for _ in range(20):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_cool_at(part, middle, tilt, oil) else (low, middle)
    return low


@pytest.mark.parametrize("tilt", [0.001, pytest.param(0.004, marks=pytest.mark.slow)])
@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_where_a_washer_counts_as_cool_its_curve_has_no_folds(part, tilt):
    for oil in (280.0, 360.0):
        speed = fastest_cool(part, tilt, oil)
        assert speed > 10.0
        assert not load_curve(part, speed=speed, tilt=tilt, oil_temperature=oil).folds


def test_near_rest_a_step_takes_no_descent():
    run = Follower(WasherParams(), GRID)
    for k, speed in enumerate(np.geomspace(50.0, 5.0, 20)):
        assert run._step(np.array([500.0, speed, 0.002, 297.15, 0.0]), 0.01) == 0
        if k > 0:
            assert run.work[L.ITERATIONS] <= 12
            assert not run.iout[L.IO_DISTRESS]


def test_near_rest_a_step_arrives_where_a_solve_from_nothing_does():
    run = Follower(WasherParams(), GRID)
    for speed in (40.0, 22.0, 9.0, 4.0, -6.0, -30.0):
        assert run._step(np.array([500.0, speed, 0.002, 297.15, 0.0]), 0.01) == 0
        one = solve_washer(WasherParams(), load=500.0, speed=speed, tilt=0.002)
        assert run.out[L.O_TORQUE] == pytest.approx(one.friction_torque, rel=1e-5)
        assert run.out[L.O_RATIO] == pytest.approx(one.film_ratio, rel=1e-4)
