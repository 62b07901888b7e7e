# mypy: disable-error-code="no-any-return"
"""One step of Dormand & Prince's embedded Runge-Kutta pair 5(4) for the driveline."""

import numpy as np
from numpy.typing import NDArray

from . import transmission_layout as L
from ._jit import kernel
from .transmission_motion import rates

Array = NDArray[np.float64]

# Dormand & Prince (1980): stage times, stage weights row by row, and fifth minus fourth order.
TIMES = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
WEIGHTS = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
    [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
    [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
    [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
    [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
])  # fmt: skip
DIFFERENCE = np.array([
    71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40,
])  # fmt: skip
SPEED_SCALE = 1.0  # rad/s: smaller speeds are kept to an absolute error
TWIST_SCALE = 0.01  # rad
ENERGY_SCALE = 100.0  # J


@kernel
def trial_step(par: Array, work: Array, s: float, h: float) -> float:
    """Fill ``work[W_NEW:]`` with the solution ``h`` seconds after ``s``; return the error ratio.

    The error ratio is the embedded estimate over the tolerance, 1 is just acceptable. The slope at
    the end lies in the last stage.
    """
    for stage in range(L.N_STAGES):
        for i in range(L.N_Y):
            total = 0.0
            for k in range(stage):
                slope = work[np.uintp(L.W_SLOPES + k * L.N_Y + i)]
                total += WEIGHTS[np.uintp(stage), np.uintp(k)] * slope
            work[np.uintp(L.W_STAGE + i)] = work[np.uintp(L.W_Y + i)] + h * total
        rates(par, work, s + TIMES[np.uintp(stage)] * h, L.W_STAGE, L.W_SLOPES + stage * L.N_Y)
    worst = 0.0
    for i in range(L.N_Y):
        error = 0.0
        for k in range(L.N_STAGES):
            error += DIFFERENCE[np.uintp(k)] * work[np.uintp(L.W_SLOPES + k * L.N_Y + i)]
        new = work[np.uintp(L.W_STAGE + i)]  # the last stage is the fifth-order result
        work[np.uintp(L.W_NEW + i)] = new
        scale = ENERGY_SCALE
        if i == L.Y_TWIST:
            scale = TWIST_SCALE
        elif i <= L.Y_VEHICLE:
            scale = SPEED_SCALE
        worst = max(worst, abs(h * error) / (par[L.P_TOLERANCE] * (scale + abs(new))))
    return worst
