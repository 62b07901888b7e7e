"""The thrust washer: one operating point.

Average-flow Reynolds equation with cavitation, elasto-plastic asperity contact, heat balance of
carrier, washer and gear, force and moment balance (Jackson & Green 2006); docs/theory/washer.md.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from ..errors import FIRST_FAILURE, BranchError, ParameterError, SolveError, Status
from ..model.levels import gone_level, level_named
from ..model.parameters import check_number
from ..model.prepare import Recent
from ..model.record import Sweep
from ..native.load import bound
from ..numerics.jit import Array
from ..units import meant
from .kernel_arguments import constants, work_array
from .kernels import layout as L
from .kernels import step as kernel
from .kernels.continuation import BUDGET
from .kernels.regime_and_status import LEAST_TEMPERATURE
from .kernels.workspace import size_of_state, size_of_work
from .parameters import SPEC, WasherParams
from .washer_result import (
    BRANCH_NAMES,
    BRANCHES,
    FROM_TABLES,
    OVERLAP,
    Inputs,
    WasherResult,
    result_of,
)

__all__ = ["WasherParams", "WasherResult", "solve_washer"]

GRIDS = {"map": kernel.FIELD_GRID, "field": kernel.FIELD_GRID, "fine": kernel.FINE_GRID}
BOTH = (
    "load = {:.4g} N lies between two folds: with friction_torque = {:.4g} N m the branch {!r} has "
    "a solution too, which one a washer is on depends on how it came there; this one is {!r}"
)
NOT_IN_MAP = (
    "fidelity = 'map' has no answer here, outside its box or without tilt: solved with 'field' "
    "(outside_map = 'solve'), which takes some hundred times as long; build a map for a larger "
    "box, or choose 'field'"
)
OK = Status.OK
LARGEST_GRID = (129, 512)


def resolve_grid(level: str, grid: tuple[int, int] | None) -> tuple[int, int]:
    """Return (n_r, n_theta) or raise ParameterError naming what is wrong."""
    if grid is None:
        return GRIDS[level]
    try:
        n_r, n_t = (int(n) for n in grid)
        whole = (n_r, n_t) == tuple(grid)
    except (TypeError, ValueError):
        whole = False
    if not whole or not (5 <= n_r <= LARGEST_GRID[0] and 8 <= n_t <= LARGEST_GRID[1]):
        raise ParameterError(
            f"grid = {grid!r} (radial x circumferential nodes), allowed: two integers from 5 x 8 "
            f"to {LARGEST_GRID[0]} x {LARGEST_GRID[1]}"
        )
    return n_r, n_t


RANGES = tuple(
    # an FMU takes 0 from an unconnected input; here a load is required
    (s.name, s.unit, 1.0 if s.name == "load" else float(s.low or 0.0), float(s.high or 0.0))
    for s in SPEC.inputs
)
TILT = next(s.start or 0.0 for s in SPEC.inputs if s.name == "tilt")


def check_far_face(params: WasherParams, far_face_temperature: float) -> None:
    """Raise ParameterError if a temperature at the gear's far face is too cold or in vain."""
    if far_face_temperature == 0.0:
        return
    if params.gear_far_face != "bulk":
        raise ParameterError(
            f"far_face_temperature = {far_face_temperature:g} K, allowed: with gear_far_face = "
            f"'bulk' (here {params.gear_far_face!r}), or 0"
        )
    if far_face_temperature < LEAST_TEMPERATURE:
        _, unit, _, highest = RANGES[-1]
        hint = meant(far_face_temperature, unit, LEAST_TEMPERATURE, highest)
        raise ParameterError(
            f"far_face_temperature = {far_face_temperature:g} K, allowed: 0 (the oil's) or "
            f"{LEAST_TEMPERATURE:g} .. {highest:g} K{hint}"
        )


def check_point(
    params: WasherParams,
    load: float,
    speed: float,
    tilt: float,
    oil_temperature: float,
    far_face_temperature: float = 0.0,
) -> Inputs:
    """Return the operating point as floats, or raise ParameterError for the first bad one."""
    given = load, speed, tilt, oil_temperature, far_face_temperature
    a, b, c, d, e = (
        check_number(name, value, unit, low, high)
        for (name, unit, low, high), value in zip(RANGES, given, strict=True)
    )
    check_far_face(params, e)
    return a, b, c, d, e


def result_from(
    params: WasherParams,
    point: Inputs,
    fidelity: str,
    grid: tuple[int, int],
    state: Array,
    work: Array,
    status: Status,
    branch: float,
    lost: bool,
    error: float | None,
) -> WasherResult:
    """Build the result from what the kernel left at the head of ``work``."""
    x, q = work[L.AT_OUTPUTS : L.AT_POSITIONS].tolist(), work[L.AT_POSITIONS : L.N_HEAD].tolist()
    return result_of(
        params,
        point,
        x,
        q[L.TILT_X :],
        BRANCH_NAMES.get(branch, "film"),
        lost,
        status,
        int(work[L.ITERATIONS]),
        fidelity,
        grid,
        error,
        state,
    )


def solve_washer(
    params: WasherParams,
    *,
    load: float,
    speed: float,
    tilt: float = TILT,
    oil_temperature: float = 297.15,
    far_face_temperature: float = 0.0,
    fidelity: str = "field",
    grid: tuple[int, int] | None = None,
    branch: str | None = None,
    start: WasherResult | None = None,
    throw: bool = True,
) -> WasherResult:
    """Return friction torque, temperature and film thickness of a thrust washer.

    Parameters
    ----------
    params : geometry, surfaces, oil
    load : axial load [N], 1 .. 2e5
    speed : [rad/s] of washer and gear against the carrier, either sign, up to 2000
    tilt : of the gear [rad], 0 .. 0.01; default 0.002, as of command and FMU: parallel faces
        build no pressure
    oil_temperature : [K], 233.15 .. 473.15
    far_face_temperature : [K] at the gear's far face, with ``gear_far_face = "bulk"``; 0: the oil's
    fidelity : "field" (10 x 32 nodes), "fine" (19 x 64) or "map", which does outside its box what
        ``params.outside_map`` says; the result's status is OUTSIDE_MAP there
    grid : (n_r, n_theta), overrides the nodes of the fidelity
    branch : "film" or "contact", the one to take where several solutions exist; without it the
        branch of ``start``, else the film branch up to its fold and the contact branch beyond
    start : a result to start from; same parameters and grid, else only its branch is used
    throw : raise on failure, or return the best estimate with its status

    Returns
    -------
    WasherResult

    Raises
    ------
    ParameterError : an argument is outside its range (named, with unit and range)
    BranchError : the branch requested has no solution at this load
    SolveError : not converged, or not within the budget of work: BUDGET = 1500 Newton iterations,
        counted by ``iterations`` of the result, after which the status is OVER_BUDGET

    Notes
    -----
    Source: Jackson & Green (2006), misprints corrected as listed in docs/theory/washer.md; beyond
    it the heat that the oil carries, which ``WasherParams.preset("paper")`` leaves out.
    Quasi-steady: no heat capacity, no squeeze film.

    Examples
    --------
    >>> r = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)
    >>> f"{r.friction_torque:.3f} N m, film ratio {r.film_ratio:.1f}, {r.branch}"
    '0.258 N m, film ratio 20.8, film'
    """
    level, messages = level_named(SPEC, fidelity), gone_level(SPEC, fidelity)
    nodes = resolve_grid(level, grid)
    point = check_point(params, load, speed, tilt, oil_temperature, far_face_temperature)
    if branch is not None and branch not in BRANCHES:
        raise ParameterError(f"branch = {branch!r}, allowed: 'film' or 'contact'")
    preferred = BRANCHES[branch] if branch is not None else 0.0
    found: WasherResult | None = None
    if level == "map":
        if grid is not None:
            raise ParameterError(f"grid = {grid!r}, allowed: none; fidelity 'map' has no mesh")
        found = _map_solver()(params, point, preferred, start)
    leaves = level == "map" and not found
    solver = "field" if leaves else level
    result = found or _solve(params, point, solver, nodes, preferred, start, grid is None)
    if leaves:
        result = _told_outside()(result, NOT_IN_MAP)
    if messages:
        result = replace(result, warnings=(*messages, *result.warnings))
    if grid is not None and nodes[0] >= 9 and nodes[1] >= 16:
        result = _with_embedded_estimate(result, preferred)
    if throw and result.status is Status.NO_BRANCH:
        raise BranchError(
            f"branch = {branch!r} has no solution at load = {point[0]:g} N, speed = {point[1]:g} "
            f"rad/s, tilt = {point[2]:g} rad; allowed here: {result.branch!r} (the folds that "
            "bound the branches come from load_curve)"
        )
    if throw and result.status.is_failure:
        raise SolveError(
            f"washer: {result.status.advice} (load = {point[0]:g} N, speed = {point[1]:g} rad/s, "
            f"tilt = {point[2]:g} rad, oil_temperature = {point[3]:g} K, grid {nodes[0]} x "
            f"{nodes[1]}; tried: warm start, Newton from a guess, descent in film thickness, "
            f"raising the load; {result.iterations} Newton iterations, at most {BUDGET:.0f})"
        )
    return result


def other_branch(result: WasherResult) -> str:
    """Return a warning if a point has a solution on the other branch too; it takes a solve."""
    other = "contact" if result.branch == "film" else "film"
    found = _solve(result.params, result.point(), "field", GRIDS["field"], BRANCHES[other], None)
    if found.status.is_failure or found.branch != other:
        return ""
    return BOTH.format(result.load, found.friction_torque, other, result.branch)


@cache
def _map_solver() -> Any:
    """Return what solves by look-up; maps are read only where they are needed."""
    from .map.look_up import solve_by_map

    return solve_by_map


@cache
def _map_guess() -> Any:
    """Return what guesses by look-up where a solve may start."""
    from .map.look_up import guess_by_map

    return guess_by_map


def _told_outside() -> Any:
    """Return what says of a result that it lies outside its map."""
    from .map.look_up import told_outside

    return told_outside


def doubt_of_rows(params: WasherParams, fidelity: str, columns: Sequence[Array]) -> str:
    """Return a warning of a sweep's points, by inputs (n,), that its map leaves to the field.

    ParameterError: a temperature at the gear's far face is too cold or in vain.
    """
    far = columns[-1]
    check_far_face(params, float(min(far[far != 0.0], default=0.0)))
    if fidelity == "map" and len(far):
        from .map.look_up import outside_text

        with suppress(ParameterError):  # without a map nothing is solved
            return outside_text(params, columns, "points")
    return ""


SWEEP = Sweep(
    not_shown=("energy", "stored_heat", "oil_energy", "advised_step"),
    doubt=doubt_of_rows,
    least={
        "stick_margin": (
            1.0,
            "the gear cannot hold the washer, which would slip on it; here both turn together",
        ),
        "film_thickness": (0.0, OVERLAP),
    },
)


class _Prepared:
    """One mesh for one washer, ready to be solved again: constants, memory, the kernel."""

    def __init__(self, params: WasherParams, nodes: tuple[int, int]) -> None:
        par = constants(params, nodes)
        self.work = work_array(("washer", nodes), L.N_HEAD + size_of_work(*nodes))
        self.inp, self.iout = np.zeros(kernel.NINP + 1), np.zeros(3, np.int32)
        self.step = bound(
            kernel.step,
            par=par,
            inp=self.inp,
            work=self.work,
            out=np.zeros(kernel.NOUT),
            iout=self.iout,
        )


_prepared = Recent(_Prepared)


def _solve(
    params: WasherParams,
    point: Inputs,
    fidelity: str,
    nodes: tuple[int, int],
    preferred: float,
    start: WasherResult | None,
    from_tables: bool = False,
) -> WasherResult:
    """Solve on a mesh; ``from_tables``: verification tables know the error of the level."""
    ready = _prepared(params, nodes)
    if start is not None and _continues(start, params, nodes):
        state = start._state.copy()
    else:
        state = np.zeros(size_of_state(*nodes))
        if start is not None and preferred == 0.0:
            preferred = BRANCHES.get(start.branch, 0.0)
            return _prefer(params, point, fidelity, nodes, preferred, from_tables)
        _map_guess()(params, point, preferred, state)
    ready.inp[:] = (*point, preferred)
    code = ready.step(state, 0.0, 1.0)
    status = OK if code == 0 else Status(code)
    work = ready.work
    if code >= FIRST_FAILURE:
        if state[L.S_VALID] == L.GUESSED:
            state[L.S_VALID] = 0.0
        estimate = work[L.AT_POSITIONS : L.N_HEAD]  # so that fields() shows it
        if np.all(np.isfinite(estimate)):
            state[L.S_POSITIONS :][:4] = estimate
    return result_from(
        params,
        point,
        fidelity,
        nodes,
        state,
        work,
        status,
        float(work[L.AT_FOUND]),
        bool(ready.iout[1]),
        FROM_TABLES if from_tables else None,
    )


def _continues(start: WasherResult, params: WasherParams, nodes: tuple[int, int]) -> bool:
    """Tell if a result's memory is one for these parameters and this grid."""
    if start.grid != nodes or start._state.size != size_of_state(*nodes):
        return False
    return start.params is params or start.params == params


def _prefer(
    params: WasherParams,
    point: Inputs,
    fidelity: str,
    nodes: tuple[int, int],
    preferred: float,
    from_tables: bool = False,
) -> WasherResult:
    """Solve from nothing on a preferred branch, on the other if it does not exist."""
    result = _solve(params, point, fidelity, nodes, preferred, None, from_tables)
    if result.status is Status.NO_BRANCH:
        return _solve(params, point, fidelity, nodes, 0.0, None, from_tables)
    return result


def _with_embedded_estimate(result: WasherResult, preferred: float) -> WasherResult:
    """Replace the error estimate by the change from a grid of half the intervals."""
    half = ((result.grid[0] - 1) // 2 + 1, result.grid[1] // 2)
    point = result.point()
    coarse = _prefer(result.params, point, result.fidelity, half, BRANCHES.get(result.branch, 0.0))
    estimate = None
    if not coarse.status.is_failure and coarse.branch == result.branch:
        change = abs(result.friction_torque - coarse.friction_torque)
        # order 1.3, the lowest seen (boundary lubrication; 2.2 in full film): error = change/1.46
        estimate = change / 1.46 / max(abs(result.friction_torque), 1e-12)
    return replace(result, _error=estimate)
