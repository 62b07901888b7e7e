"""The washer that only looks up: its map behind the step ABI, and no solver.

The washer's parameters are those in the map; ``par`` has what may differ between runs.
"""

from ....numerics.arrays import are_finite, copy
from ....numerics.jit import Array, Ints, kernel
from ....numerics.status import BAD_INPUT, CHATTER, OK
from ....tribology.holding.drag import keep, risen, wants_capacity, width_at
from ....tribology.holding.figures import fill_figures
from ....tribology.holding.memory import CAPACITY, N_FIGURES, N_MEMORY, Coupling
from ....tribology.holding.reversals import chatters
from .. import layout as L
from ..outputs import book, keep_book, lessen, lessen_slopes
from ..regime_and_status import BOUNDARY, change_of, point_of
from . import map_layout as M
from .map_step import N_MAP_WORK, look_up_slopes, look_up_step

P_HOLDING, P_COUPLING_INERTIA, P_COUPLING_AGE, P_OUTSIDE_MAP, P_FIDELITY, N_PARAM = range(6)
NPAR = N_PARAM
NINP = L.I_FAR_FACE  # a map has no such face
NOUT, NIOUT = L.NOUT, L.NIOUT
NSTATE = L.S_FIELDS
NUMBERS, SCRATCH = 0, L.N_ALL  # all outputs of the last look-up, then its scratch, the map
W_MEMORY = SCRATCH + N_MAP_WORK
W_TOLD = W_MEMORY + N_MEMORY
TABLE_AT = W_TOLD + N_FIGURES
ROOM = 360_000  # numbers of the largest map, 2.9 MB
NWORK = TABLE_AT + ROOM
TABLE = {
    "AT": TABLE_AT,
    "ROOM": ROOM,
    "MAGIC": M.MAGIC,
    "SIZE": M.SIZE,
    "PARAMS": M.PARAMS,
    "N_PARAMS": 0,
    "HEADER": M.DATA,
    "SWITCH": P_FIDELITY,
    "ON": L.MAP,
}


@kernel
def derive(par: Array) -> int:
    """Do nothing: there are no constants behind the parameters."""
    return OK


@kernel
def coupling_of(par: Array) -> Coupling:
    """Return how the washer holds where its shaft could stand."""
    return int(par[P_HOLDING]), par[P_COUPLING_INERTIA], int(par[P_COUPLING_AGE]), 0.0, False


@kernel
def _look_up(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, dt: float
) -> int:
    """Fill the outputs of sliding."""
    data = work[TABLE_AT:]
    return look_up_step(
        point_of(data[M.PARAMS :], inp),
        par[P_OUTSIDE_MAP],
        L.ANY,
        state,
        work[NUMBERS:SCRATCH],
        work[SCRATCH:W_MEMORY],
        data,
        out,
        iout,
        dt,
    )


@kernel
def step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float
) -> int:
    """Look up at ``inp``: load, speed, tilt, oil temperature; as ``washer.kernels.step`` does."""
    iout[L.IO_REGIME], iout[L.IO_DISTRESS], iout[L.IO_STATUS] = BOUNDARY, 0, BAD_INPUT
    if not are_finite(inp) or inp[L.I_TILT] < 0.0 or work[TABLE_AT + M.KIND] != M.MAGIC:
        return BAD_INPUT
    mem, way, speed = work[W_MEMORY:W_TOLD], coupling_of(par), inp[L.I_SPEED]
    copy(state[L.S_MEMORY : L.S_MEMORY + N_MEMORY], mem)
    if wants_capacity(way, mem, speed, dt):
        status = _look_up(par, inp, state, work, out, iout, 0.0)
        if status != OK:
            return status
        mem[CAPACITY] = abs(out[L.O_TORQUE])
    share, _ = risen(speed, width_at(way, mem, speed, dt))
    status = _look_up(par, inp, state, work, out, iout, dt)
    if status != OK:
        return status
    torque = out[L.O_TORQUE]
    if share != 1.0:
        lessen(share, inp[L.I_OIL], out)
    book(out[L.O_POWER] * dt, 0.0, dt, state, out)
    if dt > 0.0:
        keep_book(out, state)
        keep(way, mem, speed, dt, out[L.O_TORQUE], abs(torque))
        copy(mem, state[L.S_MEMORY : L.S_MEMORY + N_MEMORY])
    if chatters(mem):
        fill_figures(way, mem, work[W_TOLD:TABLE_AT])
        iout[L.IO_STATUS] = CHATTER
    return OK


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` (NOUT,), the derivative of the real outputs along ``seed`` (NINP,)."""
    data = work[TABLE_AT:]
    pt, change = point_of(data[M.PARAMS :], inp), change_of(data[M.PARAMS :], inp, seed)
    numbers = work[NUMBERS:SCRATCH]
    status = look_up_slopes(pt, change, numbers, work[SCRATCH:W_MEMORY], data, dout)
    mem = state[L.S_MEMORY : L.S_MEMORY + N_MEMORY]
    share, slope = risen(pt.speed, width_at(coupling_of(par), mem, pt.speed, 0.0))
    if status == OK and share != 1.0:
        rise, doil = slope * change.speed / share, change.oil_temperature
        lessen_slopes(share, rise, pt.oil_temperature, doil, numbers, dout)
    return status
