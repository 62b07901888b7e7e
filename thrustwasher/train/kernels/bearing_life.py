# mypy: disable-error-code="no-any-return"
"""Equivalent load and basic rating life of a rolling bearing: ISO 281, as publicly quoted."""

import math

from ...numerics.jit import kernel
from . import layout as L

REVOLUTIONS = 2.0 * math.pi * 1e6  # rad, of L10 = 1
BALLS, ROLLERS = 3.0, 10.0 / 3.0  # powers of the load
MOST = 1e12  # s, of a bearing that is not loaded or does not turn


@kernel
def equivalent_load(radial: float, axial: float, x: float, y: float) -> float:
    """Return P [N] = X F_r + Y F_a, and no less than F_r."""
    return max(radial, x * radial + y * axial)


@kernel
def rating_life(capacity: float, load: float, speed: float, kind: int) -> float:
    """Return L10h [s] = 1e6 turns (C/P)^p over the speed [rad/s], at most ``MOST``.

    p is 3 for ball bearings, 10/3 for roller bearings. 90 % of bearings live longer.
    """
    power = BALLS if kind <= L.ANGULAR else ROLLERS
    turns = REVOLUTIONS * math.exp(power * math.log(capacity / max(load, 1e-9 * capacity)))
    return min(turns / max(abs(speed), 1e-9), MOST)
