"""The step writes nothing behind the work of one mesh, which Python hands over without more."""

import numpy as np
import pytest

from thrustwasher import WasherParams
from thrustwasher.washer.follow import Follower
from thrustwasher.washer.solve import GRIDS

FREE = -777.0


@pytest.mark.parametrize("mode", ["quasi_steady", "transient"])
def test_nothing_is_written_behind_the_work(mode):
    washer = Follower(WasherParams(thermal_mode=mode), GRIDS["field"])
    n = len(washer.work)
    room = np.full(n + 100, FREE)
    room[:n] = washer.work
    washer.work = room[:n]
    at = np.array([300.0, 545.0, 2e-3, 297.15, 0.0])
    for duration in (0.0, 0.01):
        assert washer.go(at, at, duration) == 0
    assert (room[n:] == FREE).all()
