"""The washer that only looks up: its map behind the step ABI, and no solver.

The washer's parameters are those in the map; ``par`` has what may differ between runs.
"""

from ....numerics.arrays import are_finite
from ....numerics.jit import Array, Ints, kernel
from ....numerics.status import BAD_INPUT, OK
from ....tribology.holding.memory import N_MEMORY, Coupling
from .. import layout as L
from ..outputs import book, hold_outputs, hold_slopes, keep_book
from ..regime_and_status import BOUNDARY, change_of, point_of
from . import map_layout as M
from .map_step import N_MAP_WORK, look_up_slopes, look_up_step

P_HOLDING, P_COUPLING_INERTIA, P_COUPLING_AGE, P_OUTSIDE_MAP, P_FIDELITY, N_PARAM = range(6)
NPAR = N_PARAM
NINP = L.I_FAR_FACE  # a map has no such face
NOUT, NIOUT = L.NOUT, L.NIOUT
NSTATE = L.S_FIELDS
NUMBERS, SCRATCH = 0, L.N_ALL  # all outputs of the last look-up, then its scratch, the map
TABLE_AT = SCRATCH + N_MAP_WORK
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
def step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float
) -> int:
    """Look up at ``inp``: load, speed, tilt, oil temperature; as ``washer.kernels.step`` does."""
    iout[L.IO_REGIME], iout[L.IO_DISTRESS], iout[L.IO_STATUS] = BOUNDARY, 0, BAD_INPUT
    data = work[TABLE_AT:]
    if not are_finite(inp) or inp[L.I_TILT] < 0.0 or data[M.KIND] != M.MAGIC:
        return BAD_INPUT
    status = look_up_step(
        point_of(data[M.PARAMS :], inp),
        par[P_OUTSIDE_MAP],
        L.ANY,
        state,
        work[NUMBERS:SCRATCH],
        work[SCRATCH:TABLE_AT],
        data,
        out,
        iout,
        dt,
    )
    if status != OK:
        return status
    book(out[L.O_POWER] * dt, 0.0, dt, state, out)
    if dt > 0.0:
        keep_book(out, state)
    mem, torque = state[L.S_MEMORY : L.S_MEMORY + N_MEMORY], out[L.O_TORQUE]
    hold_outputs(coupling_of(par), mem, inp[L.I_SPEED], dt, out, iout)
    if dt > 0.0 and out[L.O_TORQUE] != torque:
        keep_book(out, state)
    return OK


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` (NOUT,), the derivative of the real outputs along ``seed`` (NINP,)."""
    data = work[TABLE_AT:]
    own = data[M.PARAMS :]
    status = look_up_slopes(
        point_of(own, inp),
        change_of(own, inp, seed),
        work[NUMBERS:SCRATCH],
        work[SCRATCH:TABLE_AT],
        data,
        dout,
    )
    mem = state[L.S_MEMORY : L.S_MEMORY + N_MEMORY]
    if status == OK:
        held = work[NUMBERS:SCRATCH]
        hold_slopes(coupling_of(par), mem, inp[L.I_SPEED], seed[L.I_SPEED], held, dout)
    return status
