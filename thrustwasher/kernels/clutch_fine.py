# mypy: disable-error-code="no-any-return"
"""Rung `fine` of the wet clutch: a step of the pack in rings, and its derivatives.

The same course of events as in clutch_step: held or linear inputs, heat booked in advance.
"""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_friction import regime_of, settled_slope
from .clutch_ring_time import advance_rings
from .clutch_rings import POWER, film_moves, mean_surface, ring_outputs, ring_rates, surfaces
from .heating import exponential_weights

Array = NDArray[np.float64]


@kernel
def load_rings(par: Array, load: float, oil: float, state: Array, work: Array) -> int:
    """Copy the memory to W_Z, or set the start; changes at W_DZ are 0."""
    n = L.Z_RINGS + int(par[L.D_RINGS]) * L.N_BODY
    status = L.OK
    work[L.W_SETTLED_LOAD] = 0.0
    for i in range(n):
        work[np.uintp(L.W_Z + i)], work[np.uintp(L.W_DZ + i)] = 0.0, 0.0
    if state[L.S_STARTED] != 0.0:
        work[np.uintp(L.W_Z + L.Z_FILM)] = state[L.S_FILM]
        work[np.uintp(L.W_Z + L.Z_ENERGY)] = state[L.S_ENERGY]
        for i in range(L.Z_RINGS, n):
            work[np.uintp(L.W_Z + i)] = state[np.uintp(L.S_RINGS + i - L.Z_RINGS)]
        return status
    ratio = par[L.D_OPEN_RATIO]
    if par[L.P_STARTS_PRESSED] != 0.0:
        ratio, work[L.W_SETTLED_LOAD], status, _ = settled_slope(par, load, 1.0)
    work[np.uintp(L.W_Z + L.Z_FILM)] = ratio
    for k in range(int(par[L.D_RINGS])):
        work[np.uintp(L.W_Z + L.Z_RINGS + k * L.N_BODY)] = oil
    return status


@kernel
def settle_film(par: Array, load: float, work: Array) -> int:
    """Put the settled film to W_Z where the film is no state; return a status."""
    if film_moves(par):
        return L.OK
    work[np.uintp(L.W_Z + L.Z_FILM)], work[L.W_SETTLED_LOAD], status, _ = settled_slope(
        par, load, work[np.uintp(L.W_Z + L.Z_FILM)]
    )
    return status


@kernel
def _look_ahead(par: Array, load: float, slip: float, oil: float, dt: float, work: Array) -> None:
    """Warm the rings for ``dt`` with their present power; W_SURFACE and energy follow."""
    surfaces(par, work, L.W_Z, L.W_SURFACE)
    ring_rates(par, load, slip, work[np.uintp(L.W_Z + L.Z_FILM)], work)
    energy = work[np.uintp(L.W_Z + L.Z_ENERGY)]
    for k in range(int(par[L.D_RINGS])):
        power = work[np.uintp(L.W_AT + k * L.N_AT + POWER)]
        energy += power * dt
        per = par[L.D_AREA] / par[np.uintp(L.D_BLOCKS + k * L.N_PACK + L.D_AREA)]
        total = 0.0
        for i in range(int(par[L.D_MODES]) + 1):
            level = oil if i == 0 else 0.0
            value = work[np.uintp(L.W_Z + L.Z_RINGS + k * L.N_BODY + i)]
            decay, first, _ = exponential_weights(par[np.uintp(L.D_DECAY + i)] * dt)
            gain = par[np.uintp(L.D_GAIN + i)] * per * power * first * dt
            total += level + (value - level) * decay + gain
        work[np.uintp(L.W_SURFACE + k)] = total
    work[np.uintp(L.W_BASE + L.Z_ENERGY)] = energy


@kernel
def _still(par: Array, work: Array) -> None:
    """Have temperatures that do not change at W_SURFACE + MAX_RINGS."""
    for k in range(int(par[L.D_RINGS])):
        work[np.uintp(L.W_SURFACE + L.MAX_RINGS + k)] = 0.0


@kernel
def fine_step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: NDArray[np.int32],
    t: float, dt: float,
) -> int:  # fmt: skip
    """Advance the pack from t to t + dt, then fill the outputs; see clutch_step.

    ``temperature`` is the rings' area mean; the advice HOT goes by the hottest ring.
    """
    load, slip, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    started, linear = state[L.S_STARTED] != 0.0, par[L.P_INPUT_COURSE] == L.LINEAR_COURSE
    still = (0.0, 0.0, 0.0)
    work[L.W_SUBSTEPS] = work[L.W_REFUSED] = 0.0
    work[L.W_PROPOSED] = state[L.S_SUBSTEP]
    status = load_rings(par, load, oil, state, work)
    if linear and started and status == L.OK:
        course = (state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL], load, slip, oil)
        first, duration = state[L.S_SUBSTEP], state[L.S_DURATION]
        status = advance_rings(par, course, still, duration, first, False, work)
    elif not linear and dt > 0.0 and status == L.OK:
        course = (load, slip, oil, load, slip, oil)
        status = advance_rings(par, course, still, dt, state[L.S_SUBSTEP], False, work)
    if status == L.OK:
        status = settle_film(par, load, work)
    surfaces(par, work, L.W_Z, L.W_SURFACE)
    _still(par, work)
    scratch = work[L.W_VARIED : L.W_VARIED + L.NOUT]
    ring_outputs(par, (load, slip, work[np.uintp(L.W_Z + L.Z_FILM)]), still, work, out, scratch)
    power = out[L.O_POWER] / par[L.P_FACES]
    temperature, hottest = mean_surface(par, work)
    energy = par[L.P_FACES] * work[np.uintp(L.W_Z + L.Z_ENERGY)]
    if linear and dt > 0.0:
        _look_ahead(par, load, slip, oil, dt, work)
        temperature, hottest = mean_surface(par, work)
        energy = par[L.P_FACES] * work[np.uintp(L.W_BASE + L.Z_ENERGY)]
    elif linear and started:
        temperature, energy = state[L.S_SHOWN_TEMPERATURE], state[L.S_SHOWN_ENERGY]
    energy = max(energy, state[L.S_SHOWN_ENERGY])
    out[L.O_TEMPERATURE], out[L.O_ENERGY] = temperature, energy
    if status == L.OK and not _is_finite(par, work, out):
        status = L.NOT_FINITE
    if dt > 0.0 and status == L.OK:
        state[L.S_STARTED] = 1.0
        state[L.S_FILM] = work[np.uintp(L.W_Z + L.Z_FILM)]
        state[L.S_ENERGY] = work[np.uintp(L.W_Z + L.Z_ENERGY)]
        for i in range(int(par[L.D_RINGS]) * L.N_BODY):
            state[np.uintp(L.S_RINGS + i)] = work[np.uintp(L.W_Z + L.Z_RINGS + i)]
        state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL] = load, slip, oil
        state[L.S_POWER], state[L.S_DURATION], state[L.S_SUBSTEP] = power, dt, work[L.W_PROPOSED]
        state[L.S_SHOWN_TEMPERATURE], state[L.S_SHOWN_ENERGY] = temperature, energy
    iout[L.IO_REGIME] = regime_of(par, out[L.O_RATIO], slip)
    advice = L.OUTSIDE_VERIFIED if out[L.O_RATIO] < L.LEAST_RATIO else L.OK
    if hottest > L.HOT_LIMIT:
        advice = L.HOT
    iout[L.IO_STATUS] = advice if status == L.OK else status
    return status


@kernel
def _is_finite(par: Array, work: Array, out: Array) -> bool:
    """Tell if what the memory takes over and all outputs are numbers."""
    good = math.isfinite(work[L.W_PROPOSED])
    for i in range(L.Z_RINGS + int(par[L.D_RINGS]) * L.N_BODY):
        good = good and math.isfinite(work[np.uintp(L.W_Z + i)])
    for i in range(L.NOUT):
        good = good and math.isfinite(out[np.uintp(i)])
    return good


@kernel
def fine_sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` with the change of the real outputs when the inputs change by ``seed``.

    Film and rings are states, as in clutch_sens; with linear inputs the stretch since the last step
    is gone through again with its changes, the sizes of its substeps held.
    """
    load, slip, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    change = (seed[L.I_LOAD], seed[L.I_SPEED], seed[L.I_OIL])
    started, linear = state[L.S_STARTED] != 0.0, par[L.P_INPUT_COURSE] == L.LINEAR_COURSE
    status = load_rings(par, load, oil, state, work)
    if started and linear and status == L.OK:
        course = (state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL], load, slip, oil)
        status = advance_rings(
            par, course, change, state[L.S_DURATION], state[L.S_SUBSTEP], True, work
        )
    elif not started:
        for k in range(int(par[L.D_RINGS])):
            work[np.uintp(L.W_DZ + L.Z_RINGS + k * L.N_BODY)] = change[2]
    if status == L.OK:
        status = settle_film(par, load, work)
    film = work[np.uintp(L.W_DZ + L.Z_FILM)] + work[L.W_SETTLED_LOAD] * change[0]
    surfaces(par, work, L.W_Z, L.W_SURFACE)
    surfaces(par, work, L.W_DZ, L.W_SURFACE + L.MAX_RINGS)
    scratch = work[L.W_VARIED : L.W_VARIED + L.NOUT]
    point = (load, slip, work[np.uintp(L.W_Z + L.Z_FILM)])
    ring_outputs(par, point, (change[0], change[1], film), work, scratch, dout)
    dout[L.O_TEMPERATURE], dout[L.O_ENERGY] = 0.0 if started else change[2], 0.0
    for i in range(L.NOUT):
        if status == L.OK and not math.isfinite(dout[np.uintp(i)]):
            status = L.NOT_FINITE
    return status
