# mypy: disable-error-code="no-any-return"
"""One co-simulation step of the wet clutch: film, heat and friction of the pack.

``input_course`` says what the inputs do inside a step. Held: they stay, the step ends with all
outputs at its end. Linear: they run straight from one communication point to the next. Then a step
first brings film and heat from the last point to the present one, whose inputs are known now, gives
the friction there, and books heat in advance with the present power; the next step replaces that
advance. This couples with second order to a partner that looks ahead by itself.
"""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_constants import derive
from .clutch_fine import fine_sens, fine_step
from .clutch_friction import regime_of, settled_slope
from .clutch_point import advance, fill_outputs, load_memory, moves_film, store_memory, warm_up
from .clutch_rules import broken_rule
from .clutch_sens import sens as lumped_sens
from .clutch_stage import surface_temperature

__all__ = [
    "NINP", "NIOUT", "NOUT", "NPAR", "NSTATE", "NWORK", "N_PARAM", "broken_rule", "derive", "sens",
    "step",
]  # fmt: skip

Array = NDArray[np.float64]
N_PARAM, NPAR, NINP, NSTATE, NWORK = L.N_PARAM, L.NPAR, L.NINP, L.NSTATE, L.NWORK
NOUT, NIOUT = L.NOUT, L.NIOUT


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
    """Advance the pack from t to t + dt, then fill the outputs.

    Returns 0 or the status of a failure; advice stands in ``iout`` only.
    """
    load, slip, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    if not (
        math.isfinite(load) and load >= 0.0 and math.isfinite(slip) and math.isfinite(oil)
        and math.isfinite(dt) and dt >= 0.0 and oil > 0.0
    ):  # fmt: skip
        iout[L.IO_STATUS] = L.BAD_INPUT
        return L.BAD_INPUT
    if par[L.P_FIDELITY] == L.FINE:
        return fine_step(par, inp, state, work, out, iout, t, dt)
    started = state[L.S_STARTED] != 0.0
    linear = par[L.P_INPUT_COURSE] == L.LINEAR_COURSE
    film = moves_film(par)
    work[L.W_SUBSTEPS] = work[L.W_REFUSED] = 0.0
    work[L.W_PROPOSED], work[L.W_DURATION] = state[L.S_SUBSTEP], dt
    status = load_memory(par, load, oil, state, work)
    if par[L.P_FIDELITY] == L.BOUNDARY_ONLY:
        work[np.uintp(L.W_NOW + L.Y_HEAT)] = oil
    if linear:
        if started and status == L.OK:
            course = (state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL], load, slip, oil)
            status = advance(
                par, course, state[L.S_DURATION], state[L.S_POWER], state[L.S_SUBSTEP], work
            )
    elif dt > 0.0 and status == L.OK:
        course = (load, slip, oil, load, slip, oil)
        status = advance(par, course, dt, 0.0, state[L.S_SUBSTEP], work)
    if not film and status == L.OK:
        work[np.uintp(L.W_NOW + L.Y_FILM)], work[L.W_SETTLED_LOAD], status, _ = settled_slope(
            par, load, work[np.uintp(L.W_NOW + L.Y_FILM)]
        )
    fill_outputs(par, load, slip, work, out)
    power = out[L.O_POWER] / par[L.P_FACES]
    temperature = surface_temperature(par, work, L.W_NOW)
    energy = par[L.P_FACES] * work[np.uintp(L.W_NOW + L.Y_ENERGY)]
    unknowns = L.W_NOW
    if linear and dt > 0.0:
        unknowns = L.W_TRIAL  # the memory is that of now; what is shown looks ahead
        for i in range(L.NY):
            work[np.uintp(L.W_TRIAL + i)] = work[np.uintp(L.W_NOW + i)]
        warm_up(par, power, power, oil, dt, work)
        temperature = surface_temperature(par, work, L.W_NOW)
        energy = par[L.P_FACES] * work[np.uintp(L.W_NOW + L.Y_ENERGY)]
    elif linear and started:
        energy = state[L.S_SHOWN_ENERGY]
        if par[L.P_FIDELITY] != L.BOUNDARY_ONLY:
            temperature = state[L.S_SHOWN_TEMPERATURE]
    out[L.O_TEMPERATURE], out[L.O_ENERGY] = temperature, energy
    if status == L.OK and not _is_finite(par, work, unknowns, out):
        status = L.NOT_FINITE
    # Heat does not come back: where the advance was too large the output waits.
    energy = max(energy, state[L.S_SHOWN_ENERGY])
    out[L.O_ENERGY] = energy
    if dt > 0.0 and status == L.OK:
        store_memory(par, work, unknowns, state)
        state[L.S_LOAD], state[L.S_SLIP], state[L.S_OIL] = load, slip, oil
        state[L.S_POWER], state[L.S_DURATION], state[L.S_SUBSTEP] = power, dt, work[L.W_PROPOSED]
        state[L.S_SHOWN_TEMPERATURE], state[L.S_SHOWN_ENERGY] = temperature, energy
    iout[L.IO_REGIME] = regime_of(par, out[L.O_RATIO], slip)
    advice = L.OK
    if out[L.O_RATIO] < L.LEAST_RATIO:
        advice = L.OUTSIDE_VERIFIED
    if temperature > L.HOT_LIMIT:
        advice = L.HOT
    iout[L.IO_STATUS] = advice if status == L.OK else status
    return status


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` with the change of the real outputs when the inputs change by ``seed``.

    ``work`` is as the last successful step with these inputs left it; see clutch_sens, clutch_fine.
    """
    if par[L.P_FIDELITY] == L.FINE:
        return fine_sens(par, inp, state, work, seed, dout)
    return lumped_sens(par, inp, state, work, seed, dout)


@kernel
def _is_finite(par: Array, work: Array, unknowns: int, out: Array) -> bool:
    """Tell if what the memory takes over and all outputs are numbers."""
    good = math.isfinite(work[L.W_PROPOSED])
    for i in range(L.Y_HEAT + 1 + int(par[L.D_MODES])):
        good = good and math.isfinite(work[np.uintp(unknowns + i)])
    for i in range(L.NOUT):
        good = good and math.isfinite(out[np.uintp(i)])
    return good
