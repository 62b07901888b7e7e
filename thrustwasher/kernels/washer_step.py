"""The washer behind the step ABI (see the package's docstring)."""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .washer_branch import ANY, N_FOUND, NO_BRANCH
from .washer_curve import N_WALK
from .washer_fields import Bench, Point, size_of_work, washer_fields
from .washer_memory import size_of_state
from .washer_model import BAD_INPUT, N_PARAM, NOT_FINITE, OK, derive_grid, size_of_par, washer_model
from .washer_newton import N_INFO, SINGULAR
from .washer_outputs import CONTACT_LOAD, MEAN_TEMPERATURE, N_ALL, N_REAL, RATIO, washer_outputs
from .washer_rules import broken_rule as broken_rule
from .washer_sens import differentiate
from .washer_solve import is_distressed, keep_solution, solve

FIELD_GRID = (10, 32)  # radial and circumferential nodes of fidelity "field", number 1
FINE_GRID = (19, 64)  # of fidelity "fine", number 2
NINP, NOUT, NIOUT = 4, N_REAL, 3
NPAR = size_of_par(*FINE_GRID)
NSTATE = size_of_state(*FINE_GRID)
N_HEAD = N_INFO + N_FOUND + N_WALK + N_ALL + 4
NWORK = N_HEAD + size_of_work(*FINE_GRID)
OUTSIDE_VERIFIED, DISTRESS = 1, 3  # errors.Status; a test keeps them equal
FILM, MIXED, BOUNDARY = 1, 2, 3  # regimes
REGIME_OUT, DISTRESS_OUT, STATUS_OUT = 0, 1, 2
LEAST_TILT = 1e-9  # [rad]; less counts as none: a wedge of 0.02 nm has lift of no account
LEAST_LOAD = 1.0  # [N]; an unloaded washer counts as loaded so much

__all__ = [
    "FIELD_GRID", "FINE_GRID", "NINP", "NIOUT", "NOUT", "NPAR", "NSTATE", "NWORK", "N_ALL",
    "N_FOUND", "N_HEAD", "N_INFO", "N_PARAM", "N_WALK", "derive", "sens", "step",
]  # fmt: skip


@kernel
def derive(par: NDArray[np.float64]) -> int:
    """Fill ``par`` behind its ``N_PARAM`` parameters: mesh, contact tables, scalars."""
    if par[N_PARAM - 1] == 2.0:
        return derive_grid(par, FINE_GRID[0], FINE_GRID[1])
    return derive_grid(par, FIELD_GRID[0], FIELD_GRID[1])


@kernel
def _is_verified(pt: Point) -> bool:
    """Tell if the operating point is inside the range that the tests cover."""
    return (
        pt.load <= 3000.0 and abs(pt.speed) <= 1500.0 and pt.tilt <= 0.004
        and 260.0 <= pt.oil_temperature <= 420.0
    )  # fmt: skip


@kernel
def regime_of(ratio: float) -> int:
    """Return the regime's number at a film ratio."""
    if ratio > 3.0:
        return FILM
    return MIXED if ratio >= 1.0 else BOUNDARY


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
    iout[REGIME_OUT], iout[DISTRESS_OUT], iout[STATUS_OUT] = BOUNDARY, 0, BAD_INPUT
    if not math.isfinite(inp[0] + inp[1] + inp[2] + inp[3]) or inp[2] < 0.0:
        return BAD_INPUT
    wanted = inp[4] if inp.size > 4 else ANY
    tilt = inp[2] if inp[2] > LEAST_TILT else 0.0
    pt = Point(max(inp[0], LEAST_LOAD), inp[1], tilt, inp[3])
    a = N_INFO + N_FOUND
    n = a + N_WALK
    info, found = work[:N_INFO], work[N_INFO:a]
    walk, numbers = work[a:n], work[n : n + N_ALL]
    q = work[n + N_ALL : N_HEAD]
    b = Bench(par, work[N_HEAD:])
    status = solve(b, pt, wanted, state, q, info, found, walk)
    m = washer_model(par)
    f = washer_fields(m, b.work)
    if not washer_outputs(m, pt, q, f, numbers) and status == OK:
        status = NOT_FINITE
    if dt > 0.0 and (status == OK or status == NO_BRANCH):
        keep_solution(b, pt, q, info, found, state)
    for k in range(N_REAL):
        out[k] = numbers[k]
    distressed = is_distressed(found, out[MEAN_TEMPERATURE] - pt.oil_temperature)
    iout[REGIME_OUT] = regime_of(out[RATIO])
    iout[DISTRESS_OUT] = 1 if distressed else 0
    iout[STATUS_OUT] = status
    if status == OK and distressed:
        iout[STATUS_OUT] = DISTRESS
    elif status == OK and not _is_verified(pt):
        iout[STATUS_OUT] = OUTSIDE_VERIFIED
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
    tilted = inp[2] > LEAST_TILT
    pt = Point(max(inp[0], LEAST_LOAD), inp[1], inp[2] if tilted else 0.0, inp[3])
    dload = seed[0] if inp[0] > LEAST_LOAD else 0.0
    change = Point(dload, seed[1], seed[2] if tilted else 0.0, seed[3])
    n = N_INFO + N_FOUND + N_WALK
    out, q = work[n : n + N_ALL], work[n + N_ALL : N_HEAD]
    if pt.speed == 0.0 and seed[1] != 0.0 and out[CONTACT_LOAD] > 0.0:
        return SINGULAR
    return differentiate(Bench(par, work[N_HEAD:]), pt, change, q, out, dout)
