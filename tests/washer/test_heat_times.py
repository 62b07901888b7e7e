"""Time constants of a stack: against bodies alone, bodies held together, and a simulation."""

import numpy as np
import pytest
from closed_forms.heat_times import stack_times

from thrustwasher.washer.kernels.ladder import SHARES, TIMES

K, C = 60.5, 7850.0 * 475.0
SLAB = tuple(zip(SHARES, TIMES, strict=True))


def stack(thick, one, two, terms=((1.0, 1.0),)):
    carrier, _, gear = thick
    return stack_times((K / carrier, K / gear), tuple(C * t for t in thick), one, two, terms)


def test_bodies_that_exchange_no_heat_settle_alone():
    times = stack((0.01, 1e-3, 0.005), 1e6, 1e6)
    assert times[0] == pytest.approx(C * 0.005**2 / K, rel=1e-4)
    assert times[1] == pytest.approx(C * 0.01**2 / K, rel=1e-4)
    assert times[2] == pytest.approx(C * 1e-3 * 0.5e6, rel=1e-3)


def test_slabs_that_exchange_no_heat_settle_in_their_slowest_mode():
    times = stack((0.01, 1e-3, 0.005), 1e6, 1e6, SLAB)
    assert times[-2] == pytest.approx(4.0 / np.pi**2 * C * 0.01**2 / K, rel=0.02)


def test_bodies_that_touch_settle_as_one():
    thick = 0.01, 1e-3, 0.005
    slowest = stack(thick, 1e-9, 1e-9)[2]
    assert slowest == pytest.approx(C * sum(thick) / (K / 0.01 + K / 0.005), rel=1e-5)


def test_the_slowest_time_is_that_of_what_remains():
    k, c = K, C
    thick, one, two = (0.01, 6.35e-4, 0.01), 2e-5, 3e-5
    slowest = stack(thick, one, two)[2]
    rises, h = np.array([1.0, 0.5, 0.2]), 1e-3
    for step in range(40_000):
        if step == 30_000:
            middle = rises[0]
        across, along = (rises[0] - rises[1]) / one, (rises[1] - rises[2]) / two
        flows = [-across - k / thick[0] * rises[0], across - along, along - k / thick[2] * rises[2]]
        rises = rises + h * np.array(flows) / (c * np.array(thick))
    assert np.log(middle / rises[0]) == pytest.approx(10.0 / slowest, rel=1e-3)
