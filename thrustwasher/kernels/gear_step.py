"""One co-simulation step of the gear mesh: it follows its inputs at once and remembers nothing."""

import math

import numpy as np
from numpy.typing import NDArray

from . import gear_layout as L
from ._jit import kernel
from .corners import soft_size
from .gear_constants import derive as derive
from .gear_point import LEAST_LINE_LOAD, mesh_point
from .gear_rules import broken_rule as broken_rule
from .gear_sens import sens as sens

Array = NDArray[np.float64]
N_PARAM, NPAR, NINP, NSTATE, NWORK = L.N_PARAM, L.NPAR, L.NINP, L.NSTATE, L.NWORK
NOUT, NIOUT = L.NOUT, L.NIOUT


@kernel
def regime_of(film_ratio: float) -> int:
    """Return the lubrication regime that the film ratio names."""
    if film_ratio > 3.0:
        return L.FILM
    return L.MIXED if film_ratio >= 1.0 else L.BOUNDARY


@kernel
def step(
    par: Array,
    inp: Array,
    state: Array,
    work: Array,
    out: Array,
    iout: NDArray[np.int32],
    t: float,
    dt: float,
) -> int:
    """Fill the outputs at the present load, speed and oil temperature; ``state`` stays.

    Returns 0 or the status of a failure; advice stands in ``iout`` only.
    """
    load, speed, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    if not (
        math.isfinite(load) and math.isfinite(speed) and math.isfinite(oil) and dt >= 0.0
        and oil > 0.0
    ):  # fmt: skip
        iout[L.IO_STATUS] = L.BAD_INPUT
        return L.BAD_INPUT
    status = mesh_point(par, load, speed, oil, work)
    # The loss grows from zero load with a continuous slope, over twice the least line load.
    pressed = soft_size(load, 2.0 * LEAST_LINE_LOAD / par[L.D_LINE])
    smooth_sign = math.tanh(speed / par[L.P_SPEED_SMOOTHING])
    work[L.F_SMOOTH_SIGN] = smooth_sign
    work[L.F_TORQUE] = work[L.F_FRICTION] * par[L.D_LOSS] * pressed * smooth_sign
    work[L.F_POWER] = work[L.F_TORQUE] * speed
    iout[L.IO_REGIME] = regime_of(work[L.F_RATIO])
    for i in range(L.NOUT):
        out[np.uintp(i)] = work[np.uintp(i)]
        if not math.isfinite(out[np.uintp(i)]):
            status = L.NOT_FINITE
    iout[L.IO_STATUS] = status
    return status if status >= 10 else 0
