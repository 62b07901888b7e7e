"""One step of a washer without a mesh, and its derivatives; see washer_lumped."""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .asperities import N_CONTACT_WORK
from .washer_branch import (
    ANY,
    BRANCH,
    CONTACT_BRANCH,
    FILM_BRANCH,
    FILM_RATIO,
    MULTIPLICITY,
    N_FOUND,
    NO_BRANCH,
    SINGLE,
)  # fmt: skip
from .washer_curve import N_WALK
from .washer_fields import Point
from .washer_lumped import (
    CONTACT,
    DRY_TORQUE,
    FILM_TORQUE,
    GAP,
    LIFT,
    N_LUMPED,
    PEAK,
    RISE,
    TILT,
    least_gap,
    wedge_forces,
)  # fmt: skip
from .washer_model import BAD_INPUT, SIGMA1, WEDGE, derive_surfaces, washer_plates
from .washer_newton import ITERATIONS, N_INFO
from .washer_outputs import (
    COEFFICIENT,
    CONTACT_LOAD,
    FILM_THICKNESS,
    FLUID_LOAD,
    FLUID_SHARE,
    MAX_TEMPERATURE,
    MEAN_TEMPERATURE,
    N_ALL,
    N_REAL,
    POWER,
    RATIO,
    TORQUE,
)  # fmt: skip
from .washer_verdict import STATUS_OUT, change_of, is_bad, judge, point_of
from .washer_wedge import N_WEDGE, wedge_nodes

Array = NDArray[np.float64]
OK, SINGULAR, NOT_FINITE = 0, 11, 14  # errors.Status; a test keeps them equal
HEAD = N_INFO + N_FOUND + N_WALK + N_ALL + 4
N_WORK = HEAD + 2 * N_LUMPED  # values and changes lie behind the head
N_SIMPLE_PAR = WEDGE + 3 * N_WEDGE + N_CONTACT_WORK
LARGEST_RISE = 200.0  # [K] mean rise that counts as distress


@kernel
def derive_simple(par: Array) -> int:
    """Fill what ``par`` (N_SIMPLE_PAR,) holds behind its parameters; return a status."""
    if not 0.0 < par[0] < par[2] < par[1]:
        return BAD_INPUT
    status = derive_surfaces(par, par[WEDGE + 3 * N_WEDGE :])
    wedge_nodes(par)
    return status


@kernel
def _fill(par: Array, pt: Point, v: Array, out: Array) -> bool:
    """Fill all outputs ``out`` (N_ALL,) from the solution ``v``; return True if finite."""
    ri, ro = par[0], par[1]
    side = 0.0 if pt.speed == 0.0 else math.copysign(1.0, pt.speed)
    out[TORQUE] = side * (v[FILM_TORQUE] + v[DRY_TORQUE])
    out[MEAN_TEMPERATURE] = pt.oil_temperature + v[RISE]
    out[MAX_TEMPERATURE] = pt.oil_temperature + v[PEAK]
    out[FILM_THICKNESS], out[RATIO] = v[GAP], v[GAP] / par[SIGMA1]
    out[FLUID_LOAD], out[CONTACT_LOAD] = v[LIFT], v[CONTACT]
    out[FLUID_SHARE] = v[LIFT] / (v[LIFT] + v[CONTACT])
    per_torque = 1.5 * (ro**2 - ri**2) / (pt.load * (ro**3 - ri**3))
    out[COEFFICIENT], out[POWER] = per_torque * abs(out[TORQUE]), out[TORQUE] * pt.speed
    good = True
    for k in range(N_ALL):
        good = good and math.isfinite(out[np.uintp(k)])
    return good


@kernel
def simple_step(
    heated: bool, par: Array, inp: Array, work: Array, out: Array, iout: NDArray[np.int32]
) -> int:
    """Solve at the present inputs and fill the outputs; the face of washer_step but for memory.

    There is none: the curve has one branch, film above film ratio 3, contact below.
    """
    iout[0], iout[1], iout[STATUS_OUT] = 3, 0, BAD_INPUT
    if is_bad(inp):
        return BAD_INPUT
    pt, m = point_of(inp), washer_plates(par)
    n = N_INFO + N_FOUND + N_WALK
    for k in range(n):
        work[k] = 0.0
    v, d = work[HEAD : HEAD + N_LUMPED], work[HEAD + N_LUMPED : N_WORK]
    s, status, iterations = least_gap(
        par, m, heated, pt.load, abs(pt.speed), pt.tilt, pt.oil_temperature, v, d
    )
    numbers = work[n : n + N_ALL]
    if not _fill(par, pt, v, numbers) and status == OK:
        status = NOT_FINITE
    branch = FILM_BRANCH if numbers[RATIO] >= FILM_RATIO else CONTACT_BRANCH
    work[N_INFO + BRANCH], work[N_INFO + MULTIPLICITY] = branch, SINGLE
    work[ITERATIONS] = float(iterations)
    q = work[n + N_ALL : HEAD]
    q[0], q[2], q[3] = s + v[TILT] * par[1], 0.0, v[TILT]
    q[1] = q[0] + (pt.tilt - v[TILT]) * par[1]
    if status == OK and inp.size > 4 and inp[4] != ANY and inp[4] != branch:
        status = NO_BRANCH
    for k in range(N_REAL):
        out[k] = numbers[k]
    judge(pt, out[RATIO], not v[RISE] <= LARGEST_RISE, status, iout)
    return status


@kernel
def simple_sens(heated: bool, par: Array, inp: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` (N_REAL,), the derivative along ``seed``; ``work`` as the step left it."""
    pt, change, m = point_of(inp), change_of(inp, seed), washer_plates(par)
    n = N_INFO + N_FOUND + N_WALK
    out, v, d = work[n : n + N_ALL], work[HEAD : HEAD + N_LUMPED], work[HEAD + N_LUMPED : N_WORK]
    if pt.speed == 0.0 and seed[1] != 0.0 and v[CONTACT] > 0.0:
        return SINGULAR
    side = 1.0 if pt.speed >= 0.0 else -1.0
    w, oil, s = (abs(pt.speed), side * change.speed), (pt.oil_temperature, change[3]), v[GAP]
    tilt = (pt.tilt, change.tilt)
    still = ((w[0], 0.0), (tilt[0], 0.0), (oil[0], 0.0))
    wedge_forces(par, m, heated, (s, 1.0), still[0], still[1], still[2], v, d)
    stiff = d[LIFT] + d[CONTACT]
    wedge_forces(par, m, heated, (s, 0.0), w, tilt, oil, v, d)
    ds = (change.load - d[LIFT] - d[CONTACT]) / stiff
    wedge_forces(par, m, heated, (s, ds), w, tilt, oil, v, d)
    torque = side * (d[FILM_TORQUE] + d[DRY_TORQUE])
    dout[TORQUE] = torque
    dout[MEAN_TEMPERATURE] = change.oil_temperature + d[RISE]
    dout[MAX_TEMPERATURE] = change.oil_temperature + d[PEAK]
    dout[FILM_THICKNESS], dout[RATIO] = ds, ds / par[SIGMA1]
    share = out[FLUID_SHARE]
    dout[FLUID_SHARE] = ((1.0 - share) * d[LIFT] - share * d[CONTACT]) / (v[LIFT] + v[CONTACT])
    ri, ro = par[0], par[1]
    per_torque = 1.5 * (ro**2 - ri**2) / (pt.load * (ro**3 - ri**3))
    dout[COEFFICIENT] = per_torque * side * torque - out[COEFFICIENT] * change.load / pt.load
    dout[POWER] = torque * pt.speed + out[TORQUE] * change.speed
    for k in range(N_REAL):
        if not math.isfinite(dout[np.uintp(k)]):
            return NOT_FINITE
    return OK
