"""Slip of an inertia that runs out in a pack: its energy and momentum are those of the inertia."""

import numpy as np
import pytest

from thrustwasher import ClutchParams
from thrustwasher.clutch.kernels import layout as k
from thrustwasher.clutch.run_out import run_out
from thrustwasher.clutch.solve import prepare

INERTIA, SPEED = 0.3, 100.0


def ran(step=1e-3, params=None, **more):
    at = {"load": 4000.0, "ramp": 0.1, "longest": 2.0, "oil_temperature": 353.15} | more
    par = prepare(params or ClutchParams(), "field")
    return run_out(par, speed=SPEED, inertia=INERTIA, step=step, **at)


@pytest.mark.parametrize("ramp", [0.0, 0.1, 0.0333])
def test_the_heat_is_the_energy_of_the_inertia(ramp):
    found = ran(ramp=ramp)
    assert found.locked and found.speed[-1] == 0.0
    assert found.rows[-1, k.O_ENERGY] == pytest.approx(0.5 * INERTIA * SPEED**2, rel=2e-4)


def test_the_torque_over_time_is_the_momentum():
    found = ran()
    torque = found.rows[:, k.O_TORQUE]
    momentum = (0.5 * (torque[1:] + torque[:-1]) * np.diff(found.time)).sum()
    assert momentum == pytest.approx(INERTIA * SPEED, rel=5e-3)


def test_it_converges_with_the_square_of_the_step():
    off = [abs(ran(s).rows[-1, k.O_ENERGY] - 0.5 * INERTIA * SPEED**2) for s in (2e-3, 1e-3, 5e-4)]
    assert off[0] > 3.0 * off[1] > 9.0 * off[2]


def test_a_force_that_is_too_small_leaves_slip():
    found = ran(load=50.0, longest=0.2)
    assert not found.locked and found.speed[-1] > 0.5 * SPEED and found.time[-1] == 0.2
