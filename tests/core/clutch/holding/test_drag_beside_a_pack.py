"""Friction that drags beside a pack that ends the slip in a step: it stops to reverse soon."""

import numpy as np
import pytest

from thrustwasher.tribology.holding import drag
from thrustwasher.tribology.holding import memory as M

H, INERTIA, CAPACITY = 1e-3, 0.03, 200.0  # s, kg m2, N m


@pytest.mark.parametrize("first", [1.0, 8.0])
@pytest.mark.parametrize("drags", [1.5, 3.0, 6.0])
def test_a_shaft_that_a_pack_stops_is_at_rest_with_few_reversals(drags, first):
    """The pack knows the inertia, and that its torque acts at once; friction of 1.5 to 6 N m."""
    memory, coupling = np.zeros(M.N_MEMORY), (M.IDENTIFIED, 0.1, 0, 1e-9, True)
    speed, before, last, speeds = first, first, 0.0, []
    for n in range(120):
        outside = (speed - before) / H + last / INERTIA if n else 0.0
        pack = float(np.clip(INERTIA * (outside + speed / H), -CAPACITY, CAPACITY))
        width = drag.width_at(coupling, memory, speed, H)
        share = drag.risen(speed, width)[0]
        friction = float(np.sign(speed)) * share * drags
        drag.keep(coupling, memory, speed, H, friction, drags)
        speeds.append(speed)
        before, last = speed, pack
        speed += H * (-2.0 - pack - friction) / INERTIA
    large = 0.5 * drags * H / INERTIA  # half of what this friction makes in a step
    signs = np.sign([s for s in speeds if abs(s) > large])
    assert np.abs(speeds[-20:]).max() < 1e-6 * first
    assert np.count_nonzero(signs[1:] != signs[:-1]) < 10
