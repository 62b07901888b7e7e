"""One co-simulation step of the gear mesh: it remembers the temperature of the gears' bodies."""

import math

from ...numerics.arrays import are_finite, copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.smoothing import soft_size, soft_size_slope
from ...numerics.status import BAD_INPUT, NOT_FINITE, OK
from . import layout as L
from .constants import broken_rule as broken_rule
from .constants import derive as derive
from .mesh_point import LEAST_LINE_LOAD
from .operating_point import point_changes, solve_point

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
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float
) -> int:
    """Fill the outputs at the present load, speed and oil temperature, held from t to t + dt.

    Returns 0 or the status of a failure; advice stands in ``iout`` only.
    """
    load, speed, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    if not (are_finite(inp) and oil > 0.0 and math.isfinite(dt) and dt >= 0.0):
        iout[L.IO_STATUS] = BAD_INPUT
        return BAD_INPUT
    # The loss grows from zero load with a continuous slope, over twice the least line load.
    pressed = soft_size(load, 2.0 * LEAST_LINE_LOAD / par[L.D_LINE])
    smooth_sign = math.tanh(speed / par[L.P_SPEED_SMOOTHING])
    status = solve_point(par, load, speed, oil, pressed * smooth_sign * speed, state, dt, work)
    work[L.F_SMOOTH_SIGN] = smooth_sign
    work[L.F_TORQUE] = work[L.F_MEAN_FRICTION] * par[L.D_LOSS] * pressed * smooth_sign
    work[L.F_POWER] = work[L.F_TORQUE] * speed
    work[L.F_OIL_ENERGY] = state[L.S_OIL_ENERGY] + work[L.F_OIL_HEAT] * dt
    iout[L.IO_REGIME] = regime_of(work[L.F_RATIO])
    copy(work, out)
    if not are_finite(out):
        status = NOT_FINITE
    if dt > 0.0 and status < 10:
        state[L.S_STARTED] = 1.0
        state[L.S_BULK], state[L.S_STORED] = work[L.F_BULK], work[L.F_STORED]
        state[L.S_OIL_ENERGY] = work[L.F_OIL_ENERGY]
    iout[L.IO_STATUS] = status
    return status if status >= 10 else 0


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` with the change of the real outputs when the inputs change by ``seed``.

    ``work`` is as the last successful step with these inputs left it. Corners that are not
    rounded (the oil's lowest temperature, the sharp switch) count as on the side the point is on.
    Returns 0, or NOT_FINITE.
    """
    torque, speed, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    width = 2.0 * LEAST_LINE_LOAD / par[L.D_LINE]
    pressed, smooth = soft_size(torque, width), work[L.F_SMOOTH_SIGN]
    heavier, friction = soft_size_slope(torque, width), work[L.F_MEAN_FRICTION]
    steep = (1.0 - smooth) * (1.0 + smooth) / par[L.P_SPEED_SMOOTHING]
    # what the mesh transmits [W] as it counts for the loss, and its change
    drive = pressed * smooth * speed
    more = heavier * seed[L.I_LOAD] * smooth * speed
    more += pressed * (steep * speed + smooth) * seed[L.I_SPEED]
    point_changes(
        par, work, torque, speed, oil, par[L.D_LOSS] * drive, par[L.D_LOSS] * more, seed, dout
    )
    rising = dout[L.F_MEAN_FRICTION] * pressed
    rising += friction * heavier * seed[L.I_LOAD]
    dout[L.F_TORQUE] = par[L.D_LOSS] * (
        rising * smooth + friction * pressed * steep * seed[L.I_SPEED]
    )
    dout[L.F_POWER] = dout[L.F_TORQUE] * speed + work[L.F_TORQUE] * seed[L.I_SPEED]
    dout[L.F_OIL_ENERGY] = 0.0
    return OK if are_finite(dout) else NOT_FINITE
