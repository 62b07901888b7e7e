"""One co-simulation step of the gear mesh: it remembers the temperature of the gears' bodies."""

import math

from ...numerics.arrays import are_finite, clear, copy
from ...numerics.jit import Array, Ints, kernel
from ...numerics.smoothing import floored, floored_slope, soft_size, soft_size_slope
from ...numerics.status import BAD_INPUT, CHATTER, NOT_FINITE, OK
from ...tribology.holding import memory as M
from ...tribology.holding.drag import keep, wants_capacity, width_at
from ...tribology.holding.figures import fill_figures
from ...tribology.holding.memory import Coupling
from ...tribology.holding.reversals import chatters
from . import layout as L
from .constants import broken_rule as broken_rule
from .constants import derive as derive
from .load_sharing import shared, shared_at
from .mesh_point import LEAST_LINE_LOAD
from .operating_point import point_changes, solve_point
from .path_friction import way_of_power

N_PARAM, NPAR, NINP, NSTATE, NWORK = L.N_PARAM, L.NPAR, L.NINP, L.NSTATE, L.NWORK
NOUT, NIOUT, W_TOLD, W_STATES = L.NOUT, L.NIOUT, L.W_TOLD, L.W_STATES
SHARE_STEP = 1e-5  # of the load, for the slope of the shares


@kernel
def regime_of(film_ratio: float) -> int:
    """Return the lubrication regime that the film ratio names."""
    if film_ratio > 3.0:
        return L.FILM
    return L.MIXED if film_ratio >= 1.0 else L.BOUNDARY


@kernel
def _solve(
    par: Array, load: float, speed: float, oil: float, width: float, state: Array, dt: float,
    work: Array,
) -> int:  # fmt: skip
    """Fill as ``solve_risen``; friction rises from rest over the speed ``width`` [rad/s]."""
    work[L.W_WIDTH] = width
    return solve_risen(par, load, speed, oil, math.tanh(speed / width), state, dt, work)


@kernel
def solve_risen(
    par: Array, load: float, speed: float, oil: float, risen: float, state: Array, dt: float,
    work: Array,
) -> int:  # fmt: skip
    """Fill the outputs but the oil's energy with these constants; return 0, an advice or a failure.

    The loss grows from zero load with a continuous slope, over twice the least line load.
    ``risen``: the part of the friction that acts, with its sign.
    """
    pressed = soft_size(load, 2.0 * LEAST_LINE_LOAD / par[L.D_LINE])
    work[L.W_WAY] = way_of_power(par, load)[0] * risen
    status = solve_point(par, load, speed, oil, pressed * risen * speed, state, dt, work)
    work[L.F_SMOOTH_SIGN] = risen
    work[L.F_TORQUE] = work[L.F_MEAN_FRICTION] * par[L.D_LOSS] * pressed * risen
    work[L.F_POWER] = work[L.F_TORQUE] * speed
    return status


@kernel
def coupling_of(par: Array) -> Coupling:
    """Return how the mesh holds where its shafts could stand."""
    width = par[L.P_SPEED_SMOOTHING]
    return (
        int(par[L.P_HOLDING]),
        par[L.P_COUPLING_INERTIA],
        int(par[L.P_COUPLING_AGE]),
        width,
        False,
    )


@kernel
def capacity_of(work: Array) -> float:
    """Return the friction torque of sliding teeth [N m >= 0] at this load and speed."""
    smooth = work[L.F_SMOOTH_SIGN]
    return abs(work[L.F_TORQUE] / smooth) if smooth != 0.0 else 0.0


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
    mem, way = work[L.W_MEMORY : L.W_MEMORY + M.N_MEMORY], coupling_of(par)
    copy(state[L.S_MEMORY : L.S_MEMORY + M.N_MEMORY], mem)
    if wants_capacity(way, mem, speed, dt):
        _solve(shared(par, load, work), load, speed, oil, way[3], state, 0.0, work)
        mem[M.CAPACITY] = capacity_of(work)
    width = width_at(way, mem, speed, dt)
    status = step_over(par, inp, width, state, work, out, iout, dt)
    if status >= 10:
        return status
    work[L.W_STATES] = work[L.F_BULK]
    if dt > 0.0:
        keep(way, mem, speed, dt, out[L.F_TORQUE], capacity_of(work))
        copy(mem, state[L.S_MEMORY : L.S_MEMORY + M.N_MEMORY])
    if chatters(mem):
        fill_figures(way, mem, work[L.W_TOLD : L.W_TOLD + M.N_FIGURES])
        iout[L.IO_STATUS] = CHATTER
    return OK


@kernel
def step_rows(
    par: Array, inputs: Array, state: Array, work: Array, iout: Ints, out: Array, whole: Ints,
    statuses: Ints,
) -> None:  # fmt: skip
    """Step over rows of inputs (n, NINP), one after the other, each held for a second.

    Fills ``out`` (n, NOUT), ``whole`` (n, NIOUT), what ``iout`` is after each, and ``statuses``.
    """
    for i in range(inputs.shape[0]):
        statuses[i] = step(par, inputs[i], state, work, out[i], iout, 0.0, 1.0)
        for k in range(iout.size):
            whole[i, k] = iout[k]


@kernel
def step_over(
    par: Array, inp: Array, width: float, state: Array, work: Array, out: Array, iout: Ints,
    dt: float,
) -> int:  # fmt: skip
    """Step as ``step`` with a friction that rises over the speed ``width`` [rad/s]."""
    work[L.W_WIDTH] = width
    status = step_risen(par, inp, math.tanh(inp[L.I_SPEED] / width), state, work, out, dt)
    iout[L.IO_REGIME], iout[L.IO_STATUS] = regime_of(work[L.F_RATIO]), status
    return status if status >= 10 else OK


@kernel
def step_risen(
    par: Array, inp: Array, risen: float, state: Array, work: Array, out: Array, dt: float
) -> int:
    """Step with the part ``risen`` of the friction, with its sign; return advice or failure."""
    load, speed, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    here = shared(par, load, work)
    status = solve_risen(here, load, speed, oil, risen, state, dt, work)
    work[L.F_OIL_ENERGY] = state[L.S_OIL_ENERGY] + work[L.F_OIL_HEAT] * dt
    copy(work, out)
    if not are_finite(out):
        status = NOT_FINITE
    if dt > 0.0 and status < 10:
        state[L.S_STARTED] = 1.0
        state[L.S_BULK], state[L.S_STORED] = work[L.F_BULK], work[L.F_STORED]
        state[L.S_OIL_ENERGY] = out[L.F_OIL_ENERGY]
    return status


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` with the change of the real outputs when the inputs change by ``seed``.

    ``work`` is as the last successful step with these inputs left it. Corners that are not
    rounded (the oil's lowest temperature, the sharp switch) count as on the side the point is on.
    Returns 0, or NOT_FINITE.
    """
    changes_along(par, inp, work, seed, 0.0, dout)
    return OK if are_finite(dout) else NOT_FINITE


@kernel
def changes_along(
    par: Array, inp: Array, work: Array, seed: Array, warms: float, dout: Array
) -> None:
    """Fill as ``sens``; ``warms`` [K]: how the bodies change where they are held."""
    torque, speed, oil = inp[L.I_LOAD], inp[L.I_SPEED], inp[L.I_OIL]
    if par[L.P_LOAD_SHARING] == L.ELASTIC:
        _changes(work[L.W_PAR : L.W_AGAIN], torque, speed, oil, work, seed, warms, dout)
        if seed[L.I_LOAD] != 0.0:
            _add_sharing(par, torque, speed, oil, work, seed[L.I_LOAD], dout)
    else:
        _changes(par, torque, speed, oil, work, seed, warms, dout)


@kernel
def _changes(
    par: Array,
    torque: float,
    speed: float,
    oil: float,
    work: Array,
    seed: Array,
    warms: float,
    dout: Array,
) -> None:
    """Fill the changes along ``seed`` with the shares of the load as they are."""
    width = 2.0 * LEAST_LINE_LOAD / par[L.D_LINE]
    pressed, smooth = soft_size(torque, width), work[L.F_SMOOTH_SIGN]
    heavier, friction = soft_size_slope(torque, width), work[L.F_MEAN_FRICTION]
    steep = (1.0 - smooth) * (1.0 + smooth) / work[L.W_WIDTH]
    # what the mesh transmits [W] as it counts for the loss, and its change
    drive = pressed * smooth * speed
    more = heavier * seed[L.I_LOAD] * smooth * speed
    more += pressed * (steep * speed + smooth) * seed[L.I_SPEED]
    drive, more = par[L.D_LOSS] * drive, par[L.D_LOSS] * more
    point_changes(par, work, torque, speed, oil, drive, more, seed, warms, dout)
    rising = dout[L.F_MEAN_FRICTION] * pressed
    rising += friction * heavier * seed[L.I_LOAD]
    dout[L.F_TORQUE] = par[L.D_LOSS] * (
        rising * smooth + friction * pressed * steep * seed[L.I_SPEED]
    )
    dout[L.F_POWER] = dout[L.F_TORQUE] * speed + work[L.F_TORQUE] * seed[L.I_SPEED]
    dout[L.F_OIL_ENERGY] = 0.0


@kernel
def _add_sharing(
    par: Array, torque: float, speed: float, oil: float, work: Array, change: float, dout: Array
) -> None:
    """Add what the shares do as the torque changes by ``change`` [N m].

    A central difference over the shares alone, at the same torque: the point is solved with those
    of a little less and a little more load. Then the shares at the torque are made again.
    """
    line = torque * par[L.D_LINE]
    load = floored(line, LEAST_LINE_LOAD)
    per_step = floored_slope(line, LEAST_LINE_LOAD) * par[L.D_LINE] * change
    per_step /= 2.0 * SHARE_STEP * load
    again, state = work[L.W_AGAIN : L.W_AGAIN + L.W_PAR], work[L.W_AGAIN + L.W_PAR :]
    for side in range(2):
        weight = per_step if side == 1 else -per_step
        here = shared_at(par, load * (1.0 + SHARE_STEP * (2.0 * side - 1.0)), work)
        clear(state)
        if work[L.W_BEGAN] == L.HELD:
            state[L.S_STARTED], state[L.S_BULK] = 1.0, oil + work[L.W_FROM]
        risen = work[L.F_SMOOTH_SIGN]
        solve_risen(here, torque, speed, oil, risen, state, work[L.W_DURATION], again)
        for k in range(L.NOUT):
            if k != L.F_STORED and k != L.F_OIL_ENERGY:
                dout[k] += weight * again[k]
    shared_at(par, load, work)
