"""The thrust washer: one operating point.

Average-flow Reynolds equation with cavitation, elasto-plastic asperity contact, heat balance of
carrier, washer and gear, force and moment balance (Jackson & Green 2006); docs/theory/washer.md.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..errors import BranchError, ParameterError, SolveError, Status
from ..kernels import washer_step as kernel
from ..kernels.washer_fields import size_of_work
from ..kernels.washer_memory import Q, size_of_state
from ..kernels.washer_newton import ITERATIONS, N_INFO
from ..kernels.washer_simple import N_WORK
from ._buffers import work_array
from ._params import check_number
from ._prepare import OFFLINE
from .washer_constants import NO_MESH, SIMPLE, constants
from .washer_error import with_card_error
from .washer_params import SPEC, WasherParams
from .washer_result import WasherResult

__all__ = ["WasherParams", "WasherResult", "solve_washer"]

Array = NDArray[np.float64]
GRIDS = {
    "closed": NO_MESH, "stribeck": NO_MESH, "map": kernel.FIELD_GRID, "coarse": kernel.COARSE_GRID,
    "field": kernel.FIELD_GRID, "fine": kernel.FINE_GRID,
}  # fmt: skip
# largest error of friction_torque against the grid-converged value over the verified range
# (tests/models/test_washer_accuracy.py measures it again)
ERRORS = {
    "closed": 3.0, "stribeck": 1.0, "map": 6e-3, "coarse": 2e-2, "field": 6e-3, "fine": 1e-3,
}  # fmt: skip
BRANCHES = {"film": 1.0, "contact": 3.0}
NAMES = {1: "film", 2: "unstable", 3: "contact"}
LARGEST_GRID = (129, 512)
N_NUMBERS = N_INFO + kernel.N_FOUND + kernel.N_WALK


def resolve_grid(fidelity: str, grid: tuple[int, int] | None) -> tuple[int, int]:
    """Return (n_r, n_theta) or raise ParameterError naming what is wrong."""
    if fidelity == "reference":
        raise ParameterError(OFFLINE.format("washer"))
    if fidelity not in GRIDS:
        known = " or ".join(repr(name) for name in GRIDS)
        raise ParameterError(f"fidelity = {fidelity!r}, allowed: {known}")
    if grid is None:
        return GRIDS[fidelity]
    if fidelity in SIMPLE:
        raise ParameterError(f"grid = {grid!r}, allowed: none; fidelity {fidelity!r} has no mesh")
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


def check_point(
    load: float, speed: float, tilt: float, oil_temperature: float
) -> tuple[float, float, float, float]:
    """Return the operating point as floats, or raise ParameterError for the first bad one."""
    values = []
    for signal, value in zip(SPEC.inputs, (load, speed, tilt, oil_temperature), strict=True):
        # an FMU takes 0 from an unconnected input; here a load is wanted
        low = 1.0 if signal.name == "load" else float(signal.low or 0.0)
        values.append(check_number(signal.name, value, signal.unit, low, float(signal.high or 0.0)))
    return values[0], values[1], values[2], values[3]


def result_from(
    params: WasherParams, point: tuple[float, float, float, float], fidelity: str,
    grid: tuple[int, int], state: Array, work: Array, status: Status, branch: float, lost: bool,
    error: float,
) -> WasherResult:  # fmt: skip
    """Build the result from what the kernel left at the head of ``work``."""
    out = work[N_NUMBERS : N_NUMBERS + kernel.N_ALL].tolist()
    q = work[N_NUMBERS + kernel.N_ALL : kernel.N_HEAD]
    return WasherResult(
        out[0], out[1], out[3], out[2], out[4], out[8], out[9], out[6], float(q[2]), float(q[3]),
        NAMES.get(int(branch), "film"), lost, status, int(work[ITERATIONS]), fidelity, grid, error,
        *point, params, state,
    )  # fmt: skip


def solve_washer(
    params: WasherParams, *, load: float, speed: float, tilt: float,
    oil_temperature: float = 297.15, fidelity: str = "field", grid: tuple[int, int] | None = None,
    branch: str | None = None, start: WasherResult | None = None, throw: bool = True,
) -> WasherResult:  # fmt: skip
    """Return friction torque, temperature and film thickness of a thrust washer.

    Parameters
    ----------
    params : geometry, surfaces, oil
    load : axial load [N], 1 .. 1e4
    speed : [rad/s] of washer and gear against the carrier, either sign, up to 2000
    tilt : of the gear [rad], 0 .. 0.01
    oil_temperature : [K], 233.15 .. 473.15
    fidelity : "field" (10 x 32 nodes), "fine" (19 x 64), "coarse" (8 x 20), "map", or without
        mesh and memory "stribeck" (one film temperature) and "closed" (oil as supplied). A "map"
        answers outside its box with the field, and the result says so
    grid : (n_r, n_theta), overrides the nodes of the fidelity
    branch : "film" or "contact", the one wanted where several solutions exist; without it the
        branch of ``start``, else the film branch up to its fold and the contact branch beyond
    start : a result to start from; same parameters and grid, else only its branch is used
    throw : raise on failure, or return the best estimate with its status

    Returns
    -------
    WasherResult

    Raises
    ------
    ParameterError : an argument is outside its range (named, with unit and range)
    BranchError : the branch asked for has no solution at this load
    SolveError : not converged

    Notes
    -----
    Source: Jackson & Green (2006), misprints corrected as listed in docs/theory/washer.md.
    Quasi-steady: no heat capacity, no squeeze film.

    Examples
    --------
    >>> r = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)
    >>> f"{r.friction_torque:.3f} N m, film ratio {r.film_ratio:.1f}, {r.branch}"
    '0.232 N m, film ratio 15.4, film'
    """
    nodes = resolve_grid(fidelity, grid)
    point = check_point(load, speed, tilt, oil_temperature)
    if branch is not None and branch not in BRANCHES:
        raise ParameterError(f"branch = {branch!r}, allowed: 'film' or 'contact'")
    wanted = BRANCHES[branch] if branch is not None else 0.0
    start = None if fidelity in SIMPLE else start
    found = None
    if fidelity == "map":
        from .washer_map import solve_by_map

        if grid is not None:
            raise ParameterError(f"grid = {grid!r}, allowed: none; fidelity 'map' has no mesh")
        found = solve_by_map(params, point, wanted, start)
        fidelity = "map" if found else "field"  # outside the map
    result = found or _solve(params, point, fidelity, nodes, wanted, start)
    if grid is not None and nodes[0] >= 9 and nodes[1] >= 16:
        result = _with_embedded_estimate(result, wanted)
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
            f"{nodes[1]}; tried: warm start, Newton from a guess, descent in film thickness)"
        )
    return with_card_error(result) if grid is None else result


def _solve(
    params: WasherParams, point: tuple[float, float, float, float], fidelity: str,
    nodes: tuple[int, int], wanted: float, start: WasherResult | None,
) -> WasherResult:  # fmt: skip
    par = constants(params, nodes, fidelity)
    simple = fidelity in SIMPLE
    size = N_WORK if simple else kernel.N_HEAD + size_of_work(*nodes)
    work = work_array(("washer", nodes), size)
    if simple:
        state = np.zeros(1)
    elif start is not None and start.grid == nodes and start.params == params:
        state = start._state.copy()
    else:
        state = np.zeros(size_of_state(*nodes))
        if start is not None and wanted == 0.0:
            wanted = BRANCHES.get(start.branch, 0.0)
            return _prefer(params, point, fidelity, nodes, wanted)
    inp, out, iout = np.array((*point, wanted)), np.empty(kernel.NOUT), np.zeros(3, np.int32)
    status = Status(kernel.step(par, inp, state, work, out, iout, 0.0, 1.0))
    if status.is_failure and not simple:
        keep_estimate(state, work)
    branch = work[N_INFO]
    return result_from(
        params, point, fidelity, nodes, state, work, status, branch, bool(iout[1]), ERRORS[fidelity]
    )


def _prefer(
    params: WasherParams, point: tuple[float, float, float, float], fidelity: str,
    nodes: tuple[int, int], wanted: float,
) -> WasherResult:  # fmt: skip
    """Solve from nothing on a preferred branch, on the other if it does not exist."""
    result = _solve(params, point, fidelity, nodes, wanted, None)
    if result.status is Status.NO_BRANCH:
        return _solve(params, point, fidelity, nodes, 0.0, None)
    return result


def keep_estimate(state: Array, work: Array) -> None:
    """Put the positions of a failed solve into ``state`` so that fields() shows them."""
    q = work[kernel.N_HEAD - 4 : kernel.N_HEAD]
    if np.all(np.isfinite(q)):
        state[Q : Q + 4] = q


def _with_embedded_estimate(result: WasherResult, wanted: float) -> WasherResult:
    """Replace the error estimate by the change from a grid of half the intervals."""
    import dataclasses

    half = ((result.grid[0] - 1) // 2 + 1, result.grid[1] // 2)
    point = (result.load, result.speed, result.tilt, result.oil_temperature)
    coarse = _prefer(result.params, point, result.fidelity, half, BRANCHES.get(result.branch, 0.0))
    estimate = math.inf
    if not coarse.status.is_failure and coarse.branch == result.branch:
        change = abs(result.friction_torque - coarse.friction_torque)
        # order 1.3, the lowest seen (boundary lubrication; 2.2 in full film): error = change/1.46
        estimate = change / 1.46 / max(abs(result.friction_torque), 1e-12)
    return dataclasses.replace(result, error_estimate=estimate)
