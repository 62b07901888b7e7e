"""Several units on shafts, and noise: model exchange against co-simulation at 0.1 ms."""

import numpy as np
import pytest
from cases import CASES, HANDING, HELD, NOISE, SLIDING
from coupled import exchanged, lock_up, slip_of, stepped

QUICK = ("noise on the load of a pack that locks",)
SEVERAL = [n for n in CASES if n.startswith(("two packs", "washer next"))]
each = pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=[pytest.mark.slow] * (n not in QUICK)) for n in (*SEVERAL, *NOISE)],
)


@each
@pytest.mark.parametrize("tolerance", [1e-4, pytest.param(1e-3, marks=pytest.mark.slow)])
def test_torque_heat_and_lock_up_are_those_of_co_simulation(name, tolerance):
    """Within 0.2 %; at 1e-3 within 5 %, the torque within 0.5 N m."""
    line = CASES[name]
    one, two = exchanged(line, tolerance), stepped(line)
    part, near = (2e-3, 0.05) if tolerance < 1e-3 else (5e-2, 0.5)
    assert one["heat"] == pytest.approx(two["heat"], rel=part)
    torques = [run["torques"][-1].sum() for run in (one, two)]
    assert torques[0] == pytest.approx(torques[1], rel=2e-3, abs=near)
    if line.inertias:
        assert lock_up(line, one) == pytest.approx(lock_up(line, two), rel=part)


def test_a_pack_that_hands_over_lets_go_and_nothing_slips():
    run = exchanged(HANDING, 1e-4)
    assert [(k, locked) for _, k, locked in run["locks"]] == [(0, True), (1, True), (0, False)]
    late = run["time"] > run["locks"][0][0] + 0.05
    assert np.abs(slip_of(HANDING, run)[late]).max() < 1e-2
    assert run["torques"][-1][0] == 0.0


def test_a_load_with_noise_neither_unlocks_nor_moves_a_pack():
    """Its capacity stays above the torque: what moves is the bending alone."""
    run = exchanged(HELD, 1e-4)
    assert [locked for _, _, locked in run["locks"]] == [True]
    late = run["time"] > 0.3
    slip, turned = slip_of(HELD, run)[late], 0.0
    turned = np.trapezoid(slip, run["time"][late])
    assert np.abs(slip).max() < 0.02 and abs(turned) < 1e-4


@pytest.mark.slow
def test_noise_in_sliding_makes_no_event():
    run = exchanged(SLIDING, 1e-4)
    assert run["events"] == 1 and run["steps"] < 600
