"""What every rung of the washer makes of its inputs, and what it says of its result."""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .washer_fields import Point

OK, OUTSIDE_VERIFIED, DISTRESS = 0, 1, 3  # errors.Status; a test keeps them equal
CLOSED, STRIBECK, MAP, COARSE, FIELD, FINE = range(1, 7)  # fidelity
FILM, MIXED, BOUNDARY = 1, 2, 3  # regimes
REGIME_OUT, DISTRESS_OUT, STATUS_OUT = 0, 1, 2
LEAST_TILT = 1e-9  # [rad]; less counts as none: a wedge of 0.02 nm has lift of no account
LEAST_LOAD = 1.0  # [N]; an unloaded washer counts as loaded so much


@kernel
def is_bad(inp: NDArray[np.float64]) -> bool:
    """Tell if an input is not finite, or the tilt negative."""
    return not math.isfinite(inp[0] + inp[1] + inp[2] + inp[3]) or inp[2] < 0.0


@kernel
def point_of(inp: NDArray[np.float64]) -> Point:
    """Return the operating point: load, speed, tilt, oil temperature as they count."""
    tilt = inp[2] if inp[2] > LEAST_TILT else 0.0
    return Point(max(inp[0], LEAST_LOAD), inp[1], tilt, inp[3])


@kernel
def change_of(inp: NDArray[np.float64], seed: NDArray[np.float64]) -> Point:
    """Return how the operating point changes; an input held at its bound does not."""
    dload = seed[0] if inp[0] > LEAST_LOAD else 0.0
    return Point(dload, seed[1], seed[2] if inp[2] > LEAST_TILT else 0.0, seed[3])


@kernel
def is_verified(pt: Point) -> bool:
    """Tell if the operating point is inside the range that the tests cover."""
    return (
        pt.load <= 3000.0 and abs(pt.speed) <= 1500.0 and pt.tilt <= 0.004
        and 260.0 <= pt.oil_temperature <= 420.0
    )  # fmt: skip


@kernel
def regime_of(ratio: float) -> int:
    """Return the regime's number at a film ratio."""
    if ratio > 3.0:
        return FILM
    return MIXED if ratio >= 1.0 else BOUNDARY


@kernel
def judge(pt: Point, ratio: float, distressed: bool, status: int, iout: NDArray[np.int32]) -> None:
    """Fill ``iout``: regime, distress, and the status or the advice in its place."""
    iout[REGIME_OUT] = regime_of(ratio)
    iout[DISTRESS_OUT] = 1 if distressed else 0
    iout[STATUS_OUT] = status
    if status == OK and distressed:
        iout[STATUS_OUT] = DISTRESS
    elif status == OK and not is_verified(pt):
        iout[STATUS_OUT] = OUTSIDE_VERIFIED
