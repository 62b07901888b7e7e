"""The washer behind the step ABI (see the package's docstring).

The map is a look-up; the other levels are one kernel on meshes.
"""

from ...numerics.arrays import clear, copy
from ...numerics.jit import Array, Ints, inlined, kernel
from ...numerics.status import BAD_INPUT, CHATTER, NO_BRANCH, NOT_FINITE, OK, SINGULAR
from ...tribology.holding.drag import keep, risen, wants_capacity, width_at
from ...tribology.holding.figures import fill_figures
from ...tribology.holding.memory import CAPACITY, N_MEMORY, Coupling
from ...tribology.holding.reversals import chatters
from . import layout as L
from .constants import derive_grid, size_of_par
from .directional_derivative import differentiate
from .heat import set_steady
from .ladder import (
    X_CARRIER,
    X_GEAR,
    X_WASHER,
    fill_means,
    set_held,
    start_terms,
    stored_heat,
)
from .layout import N_PARAM, NINP, NIOUT, NOUT
from .map.map_layout import DATA, MAGIC, PARAMS, ROOM, SIZE
from .map.map_step import N_MAP_WORK, NOT_HERE, map_sens, map_step
from .outputs import book, keep_book, lessen, lessen_slopes, outputs_at
from .parameter_derivative import SHARES, add_share_slope
from .regime_and_status import (
    BOUNDARY,
    broken_rule,
    change_of,
    is_bad,
    judge,
    point_of,
    tell_outside_map,
)
from .solve import end_of_budget, is_distressed, keep_solution, solve
from .transient import advance_heat, look_for_folds, name_branch, start_cold, take_up
from .workspace import (
    Point,
    Workspace,
    fields_of,
    model_of,
    size_of_state,
    size_of_work,
    workspace_of,
)

FIELD_GRID = (10, 32)  # radial and circumferential nodes of fidelity "field"
FINE_GRID = (19, 64)  # of "fine"
NPAR = size_of_par(*FINE_GRID)
NSTATE = size_of_state(*FINE_GRID)
MAP_WORK = L.N_HEAD + size_of_work(*FINE_GRID)  # behind the fields: scratch of a look-up, then
BY_MAP = MAP_WORK + N_MAP_WORK  # 1 if the last solution was looked up, then the map itself
W_TOLD, W_STATES = L.AT_TOLD, L.AT_STATES
TABLE_AT = BY_MAP + 1
TABLE = {
    "AT": TABLE_AT,
    "ROOM": ROOM,
    "MAGIC": MAGIC,
    "SIZE": SIZE,
    "PARAMS": PARAMS,
    "N_PARAMS": L.N_STEADY,
    "HEADER": DATA,
    "SWITCH": L.P_FIDELITY,
    "ON": L.MAP,
}
NWORK = TABLE_AT + ROOM
NSEED = NINP + len(SHARES)  # inputs, then tunable shares of heat
BUDGET_IN_TIME = 3000.0  # Newton iterations that one step of the bodies' heat may take
LESS = 0.2  # of the step that was taken: the advice where the speed chatters

__all__ = [
    "NINP",
    "NIOUT",
    "NOUT",
    "NPAR",
    "NSEED",
    "NSTATE",
    "NWORK",
    "N_PARAM",
    "broken_rule",
    "derive",
    "sens",
    "step",
]


@kernel
def derive(par: Array) -> int:
    """Fill ``par`` behind its ``N_PARAM`` parameters: contact tables, scalars, mesh if any."""
    n_r, n_t = FIELD_GRID
    if par[L.P_FIDELITY] == L.FINE:
        n_r, n_t = FINE_GRID
    return derive_grid(par, n_r, n_t)


@inlined
def _in_time(
    w: Workspace, pt: Point, dt: float, fresh: bool, state: Array
) -> tuple[int, float, float, float]:
    """Go on from the remembered temperatures through ``dt``.

    Returns a status, the next substep [s], the heat made and what of it stays in the bodies [J].
    """
    if fresh:
        start_terms(w, pt)
    else:
        w.info[L.ITERATIONS], w.info[L.FACTORED] = 0.0, 0.0
        take_up(w, pt, state)
        w.found[L.MULTIPLICITY] = state[L.S_MULTIPLICITY]
    w.info[L.ARRIVED], w.info[L.SCANNED] = 1.0, 0.0
    status, substep, made, before = OK, 0.0, 0.0, stored_heat(w)
    if dt > 0.0 or not fresh:
        w.info[L.BUDGET] = w.info[L.ITERATIONS] + BUDGET_IN_TIME
        status, substep, made = advance_heat(w, pt, dt, state[L.S_SUBSTEP])
        status = end_of_budget(w, status)
    return status, substep, made, stored_heat(w) - before


@kernel
def coupling_of(par: Array) -> Coupling:
    """Return how the washer holds where its shaft could stand."""
    return int(par[L.P_HOLDING]), par[L.P_COUPLING_INERTIA], int(par[L.P_COUPLING_AGE]), 0.0, False


@kernel
def step(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float
) -> int:
    """Advance by ``dt``, write the outputs; near rest with a share of the torque of sliding."""
    mem, way, speed = work[L.AT_MEMORY : L.AT_TOLD], coupling_of(par), inp[L.I_SPEED]
    states = work[L.AT_STATES : L.AT_FOUND]
    states[X_CARRIER] = states[X_WASHER] = states[X_GEAR] = inp[L.I_OIL]
    if is_bad(inp):
        return slide(par, inp, state, work, out, iout, t, dt, 1.0, 0.0)
    copy(state[L.S_MEMORY : L.S_MEMORY + N_MEMORY], mem)
    if wants_capacity(way, mem, speed, dt):
        status = slide(par, inp, state, work, out, iout, t, 0.0, 1.0, 0.0)
        if status != OK:
            return status
        mem[CAPACITY] = abs(out[L.O_TORQUE])
    share, slope = risen(speed, width_at(way, mem, speed, dt))
    status = slide(par, inp, state, work, out, iout, t, dt, share, slope)
    if status != OK:
        return status
    if dt > 0.0:
        torque = out[L.O_TORQUE]
        keep(way, mem, speed, dt, torque, abs(torque) / share)
        copy(mem, state[L.S_MEMORY : L.S_MEMORY + N_MEMORY])
    if chatters(mem):
        fill_figures(way, mem, work[L.AT_TOLD : L.AT_STATES])
        iout[L.IO_STATUS] = CHATTER
        if par[L.P_THERMAL_MODE] == L.TRANSIENT and dt > 0.0:
            out[L.O_ADVISED] = min(out[L.O_ADVISED], LESS * dt)
    return status


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
def slide(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, t: float, dt: float,
    share: float, slope: float,
) -> int:  # fmt: skip
    """Advance by ``dt`` (quasi-steady: solve at the present inputs) and write the outputs.

    Torque and heat are ``share`` of those of sliding, which has a ``slope`` over the speed.

    ``inp`` is load, speed, tilt, oil temperature, that of the gear's far face (0: the oil's); a
    sixth entry, if there is one, names the wanted branch, otherwise the one that ``state``
    remembers goes on. ``work`` begins with the head of the layout: for Python's results.
    """
    fidelity = par[L.P_FIDELITY]
    iout[L.IO_REGIME], iout[L.IO_DISTRESS], iout[L.IO_STATUS] = BOUNDARY, 0, BAD_INPUT
    if is_bad(inp):
        return BAD_INPUT
    is_asked = inp.size > L.I_BRANCH
    wanted = inp[L.I_BRANCH] if is_asked else L.ANY
    if fidelity == L.MAP:
        pt = point_of(par, inp)
        work[L.ITERATIONS], work[L.FACTORED] = 0.0, 0.0
        work[BY_MAP] = 1.0
        status = map_step(
            par,
            inp,
            wanted,
            state,
            work[L.AT_OUTPUTS : L.AT_POSITIONS],
            work[MAP_WORK:BY_MAP],
            work[TABLE_AT:],
            out,
            iout,
            dt,
        )
        if status == OK:
            if share != 1.0:
                lessen(share, pt.oil_temperature, out)
            book(out[L.O_POWER] * dt, 0.0, dt, state, out)
            if dt > 0.0:
                keep_book(out, state)
        if status != NOT_HERE:
            return status
        work[BY_MAP] = 0.0
        if wanted == L.ANY:
            wanted = state[L.S_MAP_BRANCH]
    return _slide_on_mesh(par, inp, state, work, out, iout, dt, share, slope, wanted)


@kernel
def _slide_on_mesh(
    par: Array, inp: Array, state: Array, work: Array, out: Array, iout: Ints, dt: float,
    share: float, slope: float, wanted: float,
) -> int:  # fmt: skip
    """Do as `slide` where no map answers: apart, so that a look-up has no room for fields."""
    is_asked = inp.size > L.I_BRANCH
    pt, w = point_of(par, inp), workspace_of(par, work)
    in_time = par[L.P_THERMAL_MODE] == L.TRANSIENT
    fresh = state[L.S_VALID] != 1.0
    f = fields_of(w)
    set_steady(model_of(w), pt, f)
    f.small[L.GIVEN], f.small[L.GIVEN_SLOPE] = share, slope
    if in_time and fresh and par[L.P_THERMAL_START] == L.FROM_OIL:
        start_cold(w)
    status = OK
    for _ in range(2):
        if in_time and not fresh:
            break
        status = solve(w, pt, wanted, state)
        if status != NO_BRANCH or wanted == L.ANY or is_asked:
            break
        wanted = L.ANY  # the branch of the map ends outside it
    substep, made, kept = state[L.S_SUBSTEP], 0.0, 0.0
    if in_time and status == OK:
        status, substep, made, kept = _in_time(w, pt, dt, fresh, state)
    if not outputs_at(w, pt) and status == OK:
        status = NOT_FINITE
    copy(w.outputs, out)
    if not in_time:
        made = out[L.O_POWER] * dt
        out[L.O_OIL_HEAT] = out[L.O_POWER]
    book(made, kept, dt, state, out)
    if in_time:
        fill_means(w, pt, work[L.AT_STATES : L.AT_FOUND])
        out[L.O_ADVISED] = substep if dt > 0.0 else state[L.S_SUBSTEP]
    lost = in_time and name_branch(w, w.outputs[L.O_RATIO], w.outputs[L.O_FLUID_SHARE])
    if dt > 0.0 and (status == OK or status == NO_BRANCH):
        keep_solution(w, pt, state)
        state[L.S_MAP_BRANCH] = 0.0
        state[L.S_SUBSTEP] = substep
        keep_book(out, state)
        if lost:
            look_for_folds(w, pt, state)
    if in_time and (dt > 0.0 or not fresh or par[L.P_THERMAL_START] == L.FROM_OIL):
        set_held(w, dt)
    judge(pt, out, is_distressed(w, out[L.O_MEAN] - pt.oil_temperature), status, iout)
    if par[L.P_FIDELITY] == L.MAP:
        tell_outside_map(iout)
    return status


@kernel
def sens(par: Array, inp: Array, state: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` (NOUT,), the derivative of the real outputs along ``seed`` (NSEED,).

    ``seed`` holds changes of the inputs, then, if it is so long, of the tunable shares of heat.
    ``work`` is as ``step`` left it after solving at these inputs. Where an input is held at a bound
    (an unloaded or a level washer) its derivative is zero. Returns SINGULAR at a fold, and at rest
    with contact, where the torque jumps.
    """
    fidelity = par[L.P_FIDELITY]
    pt, change, w = point_of(par, inp), change_of(par, inp, seed), workspace_of(par, work)
    if fidelity == L.MAP and work[BY_MAP] == 1.0:
        status = map_sens(inp, seed, w.outputs, work[MAP_WORK:BY_MAP], work[TABLE_AT:], dout)
        mem = state[L.S_MEMORY : L.S_MEMORY + N_MEMORY]
        share, slope = risen(pt.speed, width_at(coupling_of(par), mem, pt.speed, 0.0))
        if status == OK and share != 1.0:
            rise, doil = slope * change.speed / share, change.oil_temperature
            lessen_slopes(share, rise, pt.oil_temperature, doil, w.outputs, dout)
        return status
    if pt.speed == 0.0 and seed[L.I_SPEED] != 0.0 and w.outputs[L.O_CONTACT_LOAD] > 0.0:
        return SINGULAR
    status, by_inputs = OK, False
    for i in range(NINP):
        by_inputs = by_inputs or seed[i] != 0.0
    clear(dout)
    if by_inputs:
        clear(fields_of(w).small[L.WARMED : L.N_SMALL])
        status = differentiate(w, pt, change, dout)
    steady = par[L.P_THERMAL_MODE] != L.TRANSIENT
    for k in range(len(SHARES)):
        if status == OK and seed.size == NSEED and seed[NINP + k] != 0.0:
            # the room for a map serves: with one there is no such derivative
            own, room = work[TABLE_AT : TABLE_AT + NPAR], work[TABLE_AT + NPAR :]
            copy(par, own)
            along, moved = seed[NINP + k], workspace_of(own, work)
            status = add_share_slope(moved, pt, SHARES[k], along, steady, room, dout)
    return status
