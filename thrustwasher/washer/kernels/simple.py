"""The rungs of the washer without a mesh, see washer_lumped: a step, and its derivatives.

`closed` keeps the oil at the temperature it is supplied with; in `stribeck` it is as warm as the
film itself makes it.
"""

import numpy as np
from numpy.typing import NDArray

from ...numerics.jit import Array, kernel
from ...numerics.status import BAD_INPUT, NO_BRANCH, NOT_FINITE, OK, SINGULAR
from ...tribology.asperities import N_CONTACT_WORK
from . import layout as L
from .branch import FILM_RATIO
from .constants import derive_surfaces
from .lumped import (
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
)
from .outputs import are_finite, coefficient_per_torque, side_of
from .regime_and_status import BOUNDARY, LARGEST_RISE, change_of, is_bad, judge, point_of
from .wedge import END_OF_WEDGE, wedge_nodes
from .workspace import Point, clear, copy

N_WORK = L.N_HEAD + 2 * N_LUMPED  # values and changes lie behind the head
N_SIMPLE_PAR = END_OF_WEDGE + N_CONTACT_WORK


@kernel
def derive_simple(par: Array) -> int:
    """Fill what ``par`` (N_SIMPLE_PAR,) holds behind its parameters; return a status."""
    if not 0.0 < par[L.P_INNER_RADIUS] < par[L.P_GEAR_INNER_RADIUS] < par[L.P_OUTER_RADIUS]:
        return BAD_INPUT
    status = derive_surfaces(par, par[END_OF_WEDGE:])
    wedge_nodes(par)
    return status


@kernel
def _fill(par: Array, pt: Point, v: Array, out: Array) -> bool:
    """Fill all outputs ``out`` (N_ALL,) from the solution ``v``; return True if finite."""
    out[L.O_TORQUE] = side_of(pt.speed) * (v[FILM_TORQUE] + v[DRY_TORQUE])
    out[L.O_MEAN] = pt.oil_temperature + v[RISE]
    out[L.O_PEAK] = pt.oil_temperature + v[PEAK]
    out[L.O_FILM], out[L.O_RATIO] = v[GAP], v[GAP] / par[L.D_SIGMA1]
    out[L.O_FLUID_LOAD], out[L.O_CONTACT_LOAD] = v[LIFT], v[CONTACT]
    out[L.O_FLUID_SHARE] = v[LIFT] / (v[LIFT] + v[CONTACT])
    per_torque = coefficient_per_torque(par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], pt.load)
    out[L.O_COEFFICIENT] = per_torque * abs(out[L.O_TORQUE])
    out[L.O_POWER] = out[L.O_TORQUE] * pt.speed
    return are_finite(out)


@kernel
def simple_step(
    heated: bool, par: Array, inp: Array, work: Array, out: Array, iout: NDArray[np.int32]
) -> int:
    """Solve at the present inputs and fill the outputs; the face of washer_step but for memory.

    There is none: the curve has one branch, film above film ratio 3, contact below.
    """
    iout[L.IO_REGIME], iout[L.IO_DISTRESS], iout[L.IO_STATUS] = BOUNDARY, 0, BAD_INPUT
    if is_bad(inp):
        return BAD_INPUT
    pt = point_of(inp)
    clear(work[: L.AT_OUTPUTS])
    v, d = work[L.N_HEAD : L.N_HEAD + N_LUMPED], work[L.N_HEAD + N_LUMPED : N_WORK]
    s, status, iterations = least_gap(
        par, heated, pt.load, abs(pt.speed), pt.tilt, pt.oil_temperature, v, d
    )
    numbers = work[L.AT_OUTPUTS : L.AT_POSITIONS]
    if not _fill(par, pt, v, numbers) and status == OK:
        status = NOT_FINITE
    branch = L.FILM_BRANCH if numbers[L.O_RATIO] >= FILM_RATIO else L.CONTACT_BRANCH
    found = work[L.AT_FOUND : L.AT_CURVE]
    found[L.BRANCH], found[L.MULTIPLICITY] = branch, L.SINGLE
    work[L.ITERATIONS] = float(iterations)
    q, ro = work[L.AT_POSITIONS : L.N_HEAD], par[L.P_OUTER_RADIUS]
    q[L.Z_WASHER], q[L.TILT_X], q[L.TILT_Y] = s + v[TILT] * ro, 0.0, v[TILT]
    q[L.Z_GEAR] = q[L.Z_WASHER] + (pt.tilt - v[TILT]) * ro
    wanted = inp[L.I_BRANCH] if inp.size > L.I_BRANCH else L.ANY
    if status == OK and wanted != L.ANY and wanted != branch:
        status = NO_BRANCH
    copy(numbers, out)
    judge(pt, out[L.O_RATIO], not v[RISE] <= LARGEST_RISE, status, iout)
    return status


@kernel
def simple_sens(heated: bool, par: Array, inp: Array, work: Array, seed: Array, dout: Array) -> int:
    """Fill ``dout`` (NOUT,), the derivative along ``seed``; ``work`` as the step left it."""
    pt, change = point_of(inp), change_of(inp, seed)
    out = work[L.AT_OUTPUTS : L.AT_POSITIONS]
    v, d = work[L.N_HEAD : L.N_HEAD + N_LUMPED], work[L.N_HEAD + N_LUMPED : N_WORK]
    if pt.speed == 0.0 and seed[L.I_SPEED] != 0.0 and v[CONTACT] > 0.0:
        return SINGULAR
    side = 1.0 if pt.speed >= 0.0 else -1.0
    s, w, tilt = v[GAP], (abs(pt.speed), side * change.speed), (pt.tilt, change.tilt)
    oil = (pt.oil_temperature, change.oil_temperature)
    still = ((w[0], 0.0), (tilt[0], 0.0), (oil[0], 0.0))
    wedge_forces(par, heated, (s, 1.0), still[0], still[1], still[2], v, d)
    stiff = d[LIFT] + d[CONTACT]
    wedge_forces(par, heated, (s, 0.0), w, tilt, oil, v, d)
    ds = (change.load - d[LIFT] - d[CONTACT]) / stiff
    wedge_forces(par, heated, (s, ds), w, tilt, oil, v, d)
    torque = side * (d[FILM_TORQUE] + d[DRY_TORQUE])
    dout[L.O_TORQUE] = torque
    dout[L.O_MEAN] = change.oil_temperature + d[RISE]
    dout[L.O_PEAK] = change.oil_temperature + d[PEAK]
    dout[L.O_FILM], dout[L.O_RATIO] = ds, ds / par[L.D_SIGMA1]
    share = out[L.O_FLUID_SHARE]
    dout[L.O_FLUID_SHARE] = ((1.0 - share) * d[LIFT] - share * d[CONTACT]) / (v[LIFT] + v[CONTACT])
    per_torque = coefficient_per_torque(par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], pt.load)
    of_load = out[L.O_COEFFICIENT] * change.load / pt.load
    dout[L.O_COEFFICIENT] = per_torque * side * torque - of_load
    dout[L.O_POWER] = torque * pt.speed + out[L.O_TORQUE] * change.speed
    return OK if are_finite(dout) else NOT_FINITE
