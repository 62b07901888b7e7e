"""The washer behind the step ABI (see the package's docstring).

Rungs: `closed` and `stribeck` have no mesh and no memory, the others are one kernel on meshes.
"""

import numpy as np
from numpy.typing import NDArray

from ._jit import inlined, kernel
from .washer_branch import ANY, MULTIPLICITY, N_FOUND, NO_BRANCH
from .washer_closed import closed_sens, closed_step
from .washer_curve import N_WALK
from .washer_fields import Bench, Point, size_of_work, washer_fields
from .washer_map_layout import DATA, MAGIC, PARAMS, ROOM, SIZE
from .washer_map_step import MAP_BRANCH, N_MAP_WORK, NOT_HERE, map_sens, map_step
from .washer_memory import MULTIPLICITY_NOW, SUBSTEP, VALID, size_of_state
from .washer_model import (
    BAD_INPUT,
    FROM_OIL,
    N_PARAM,
    N_STEADY,
    NOT_FINITE,
    OK,
    THERMAL_MODE,
    THERMAL_START,
    TRANSIENT,
    derive_grid,
    size_of_par,
    washer_model,
)  # fmt: skip
from .washer_newton import ARRIVED, FACTORED, ITERATIONS, N_INFO, SCANNED, SINGULAR
from .washer_outputs import (
    CONTACT_LOAD,
    FLUID_SHARE,
    MEAN_TEMPERATURE,
    N_ALL,
    N_REAL,
    RATIO,
    washer_outputs,
)  # fmt: skip
from .washer_rules import broken_rule as broken_rule
from .washer_sens import differentiate
from .washer_simple import derive_simple
from .washer_solve import is_distressed, keep_solution, solve
from .washer_stribeck import stribeck_sens, stribeck_step
from .washer_transient import (
    advance_heat,
    look_for_folds,
    name_branch,
    set_rate,
    start_cold,
    take_up,
)  # fmt: skip
from .washer_verdict import (
    BOUNDARY,
    CLOSED,
    COARSE,
    DISTRESS,
    DISTRESS_OUT,
    FIELD,
    FILM,
    FINE,
    LEAST_LOAD,
    LEAST_TILT,
    MAP,
    MIXED,
    OUTSIDE_VERIFIED,
    REGIME_OUT,
    STATUS_OUT,
    STRIBECK,
    change_of,
    is_bad,
    judge,
    point_of,
    regime_of,
)  # fmt: skip

COARSE_GRID = (8, 20)  # radial and circumferential nodes of fidelity "coarse"
FIELD_GRID = (10, 32)  # of "field"
FINE_GRID = (19, 64)  # of "fine"
NINP, NOUT, NIOUT = 4, N_REAL, 3
NPAR = size_of_par(*FINE_GRID)
NSTATE = size_of_state(*FINE_GRID)
N_HEAD = N_INFO + N_FOUND + N_WALK + N_ALL + 4
MAP_WORK = N_HEAD + size_of_work(*FINE_GRID)  # behind the fields: scratch of a look-up, then
BY_MAP = MAP_WORK + N_MAP_WORK  # 1 if the last solution was looked up, then the map itself
TABLE = {
    "AT": BY_MAP + 1, "ROOM": ROOM, "MAGIC": MAGIC, "SIZE": SIZE, "PARAMS": PARAMS,
    "N_PARAMS": N_STEADY, "HEADER": DATA, "SWITCH": N_PARAM - 1, "ON": MAP,
}  # fmt: skip
TABLE_AT = BY_MAP + 1
NWORK = TABLE_AT + ROOM

__all__ = [
    "BOUNDARY",
    "CLOSED",
    "COARSE",
    "COARSE_GRID",
    "DISTRESS",
    "DISTRESS_OUT",
    "FIELD",
    "FIELD_GRID",
    "FILM",
    "FINE",
    "FINE_GRID",
    "LEAST_LOAD",
    "LEAST_TILT",
    "MAP",
    "MIXED",
    "NINP",
    "NIOUT",
    "NOUT",
    "NPAR",
    "NSTATE",
    "NWORK",
    "N_ALL",
    "N_FOUND",
    "N_HEAD",
    "N_INFO",
    "N_PARAM",
    "N_WALK",
    "OUTSIDE_VERIFIED",
    "REGIME_OUT",
    "STATUS_OUT",
    "STRIBECK",
    "TABLE",
    "TABLE_AT",
    "derive",
    "regime_of",
    "sens",
    "step",
]  # fmt: skip


@kernel
def derive(par: NDArray[np.float64]) -> int:
    """Fill ``par`` behind its ``N_PARAM`` parameters: contact tables, scalars, mesh if any."""
    fidelity = par[N_PARAM - 1]
    if fidelity == CLOSED or fidelity == STRIBECK:
        return derive_simple(par)
    if fidelity == COARSE:
        return derive_grid(par, COARSE_GRID[0], COARSE_GRID[1])
    if fidelity == FINE:
        return derive_grid(par, FINE_GRID[0], FINE_GRID[1])
    return derive_grid(par, FIELD_GRID[0], FIELD_GRID[1])


@inlined
def _in_time(
    b: Bench, pt: Point, dt: float, fresh: bool, state: NDArray[np.float64],
    q: NDArray[np.float64], info: NDArray[np.float64], found: NDArray[np.float64],
    walk: NDArray[np.float64],
) -> tuple[int, float]:  # fmt: skip
    """Go on from the remembered temperatures through ``dt``; return status and next substep."""
    if not fresh:
        info[ITERATIONS], info[FACTORED] = 0.0, 0.0
        take_up(b, pt, state, q)
        found[MULTIPLICITY] = state[MULTIPLICITY_NOW]
    info[ARRIVED], info[SCANNED] = 1.0, 0.0
    status, substep = OK, 0.0
    if dt > 0.0 or not fresh:
        status, substep = advance_heat(b, pt, dt, state[SUBSTEP], q, info, walk)
    return status, substep


@kernel
def step(
    par: NDArray[np.float64], inp: NDArray[np.float64], state: NDArray[np.float64],
    work: NDArray[np.float64], out: NDArray[np.float64], iout: NDArray[np.int32], t: float,
    dt: float,
) -> int:  # fmt: skip
    """Advance by ``dt`` (quasi-steady: solve at the present inputs) and write the outputs.

    ``inp`` is load, speed, tilt, oil temperature; a fifth entry, if there is one, names the wanted
    branch (washer_branch), otherwise the one that ``state`` remembers goes on. ``work`` begins with
    info (N_INFO), found (N_FOUND), walk (N_WALK), all outputs (N_ALL), q (4): for Python's results.
    """
    fidelity = par[N_PARAM - 1]
    if fidelity == CLOSED:
        return closed_step(par, inp, state, work, out, iout, t, dt)
    if fidelity == STRIBECK:
        return stribeck_step(par, inp, state, work, out, iout, t, dt)
    iout[REGIME_OUT], iout[DISTRESS_OUT], iout[STATUS_OUT] = BOUNDARY, 0, BAD_INPUT
    if is_bad(inp):
        return BAD_INPUT
    wanted = inp[4] if inp.size > 4 else ANY
    pt = point_of(inp)
    a = N_INFO + N_FOUND
    n = a + N_WALK
    info, found = work[:N_INFO], work[N_INFO:a]
    walk, numbers = work[a:n], work[n : n + N_ALL]
    q = work[n + N_ALL : N_HEAD]
    if fidelity == MAP:
        info[ITERATIONS], info[FACTORED] = 0.0, 0.0
        work[BY_MAP] = 1.0
        status = map_step(par, inp, wanted, state, numbers, work[MAP_WORK:BY_MAP],
                          work[TABLE_AT:], out, iout, dt)  # fmt: skip
        if status != NOT_HERE:
            return status
        work[BY_MAP] = 0.0
        if wanted == ANY:
            wanted = state[MAP_BRANCH]
    b = Bench(par, work[N_HEAD:])
    in_time = par[THERMAL_MODE] == TRANSIENT
    fresh = state[VALID] != 1.0
    set_rate(b, 0.0)
    if in_time and fresh and par[THERMAL_START] == FROM_OIL:
        start_cold(b)
    status = OK
    for _ in range(2):
        if in_time and not fresh:
            break
        status = solve(b, pt, wanted, state, q, info, found, walk)
        if status != NO_BRANCH or wanted == ANY or inp.size > 4:
            break
        wanted = ANY  # the branch of the map ends outside it
    substep = state[SUBSTEP]
    if in_time and status == OK:
        status, substep = _in_time(b, pt, dt, fresh, state, q, info, found, walk)
    m = washer_model(par)
    f = washer_fields(m, b.work)
    if not washer_outputs(m, pt, q, f, numbers) and status == OK:
        status = NOT_FINITE
    lost = in_time and name_branch(found, numbers[RATIO], numbers[FLUID_SHARE])
    if dt > 0.0 and (status == OK or status == NO_BRANCH):
        keep_solution(b, pt, q, info, found, state)
        state[MAP_BRANCH] = 0.0
        state[SUBSTEP] = substep
        if lost:
            look_for_folds(b, pt, state, q, info, found, walk)
    if in_time and dt > 0.0:
        set_rate(b, 1.0 / dt)  # derivatives: of what the whole step brings
    for k in range(N_REAL):
        out[k] = numbers[k]
    distressed = is_distressed(found, out[MEAN_TEMPERATURE] - pt.oil_temperature)
    judge(pt, out[RATIO], distressed, status, iout)
    return status


@kernel
def sens(
    par: NDArray[np.float64], inp: NDArray[np.float64], state: NDArray[np.float64],
    work: NDArray[np.float64], seed: NDArray[np.float64], dout: NDArray[np.float64],
) -> int:  # fmt: skip
    """Fill ``dout`` (N_REAL,), the derivative of the real outputs along ``seed`` (NINP,).

    ``work`` is as ``step`` left it after solving at these inputs. Where an input is held at a
    bound (an unloaded or a level washer) its derivative is zero. Returns SINGULAR at a fold, and at
    rest with contact, where the torque jumps.
    """
    if par[N_PARAM - 1] == CLOSED:
        return closed_sens(par, inp, state, work, seed, dout)
    if par[N_PARAM - 1] == STRIBECK:
        return stribeck_sens(par, inp, state, work, seed, dout)
    pt, change = point_of(inp), change_of(inp, seed)
    n = N_INFO + N_FOUND + N_WALK
    out, q = work[n : n + N_ALL], work[n + N_ALL : N_HEAD]
    if par[N_PARAM - 1] == MAP and work[BY_MAP] == 1.0:
        return map_sens(inp, seed, out, work[MAP_WORK:BY_MAP], work[TABLE_AT:], dout)
    if pt.speed == 0.0 and seed[1] != 0.0 and out[CONTACT_LOAD] > 0.0:
        return SINGULAR
    return differentiate(Bench(par, work[N_HEAD:]), pt, change, q, out, dout)
