# mypy: disable-error-code="no-any-return"
"""Equivalent load and basic rating life of a rolling bearing: ISO 281, as publicly quoted."""

import math

from ...numerics.jit import kernel
from . import layout as L

REVOLUTIONS = 2.0 * math.pi * 1e6  # rad, of L10 = 1
BALLS, ROLLERS = 3.0, 10.0 / 3.0  # powers of the load
MOST = 1e12  # s, of a bearing that is not loaded or does not turn


@kernel
def equivalent_load(radial: float, axial: float, x: float, y: float, limit: float) -> float:
    """Return P [N] = F_r where F_a is ``limit`` F_r or less, else X F_r + Y F_a.

    ``limit``: e of a catalogue; 0: P is X F_r + Y F_a, and no less than F_r.
    """
    if limit <= 0.0:
        return max(radial, x * radial + y * axial)
    return radial if axial <= limit * radial else x * radial + y * axial


@kernel
def induced_share(kind: int, x: float, y: float, limit: float, given: float) -> float:
    """Return the axial force that a bearing makes of its radial load, over that load.

    ``given``, where it is 0 or more; else by its ``kind``: taper 0.5/Y, angular contact e, which
    is (1 - X)/Y where ``limit`` is 0, others 0. Source: catalogues of SKF and Schaeffler.
    """
    if given >= 0.0:
        return given
    if kind == L.TAPER:
        return 0.5 / max(y, 1e-12)
    if kind == L.ANGULAR:
        return limit if limit > 0.0 else max(1.0 - x, 0.0) / max(y, 1e-12)
    return 0.0


@kernel
def shared_thrust(
    arrangement: int, induced: tuple[float, float], towards_second: float
) -> tuple[float, float]:
    """Return the axial forces [N] of both bearings of a pair in O or X without preload.

    ``induced``: what each makes of its radial load [N]; ``towards_second``: axial force on the
    shaft, from the first bearing to the second. In X the shaft leans on the bearing that it is
    pushed to, in O on the other one; neither bears less than it induces, and one no more.
    """
    push = towards_second if arrangement == L.FACE_TO_FACE else -towards_second
    first = max(induced[0], induced[1] - push)
    second = max(induced[1], induced[0] + push)
    return first, second


@kernel
def rating_life(capacity: float, load: float, speed: float, kind: int) -> float:
    """Return L10h [s] = 1e6 turns (C/P)^p over the speed [rad/s], at most ``MOST``.

    p is 3 for ball bearings, 10/3 for roller bearings. 90 % of bearings live longer.
    """
    power = BALLS if kind <= L.ANGULAR else ROLLERS
    turns = REVOLUTIONS * math.exp(power * math.log(capacity / max(load, 1e-9 * capacity)))
    return min(turns / max(abs(speed), 1e-9), MOST)
