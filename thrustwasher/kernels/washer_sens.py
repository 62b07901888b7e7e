"""Directional derivatives of the washer's outputs, from the factored heat balance.

The unknowns' change solves the tangent equations exactly; the factor at hand, made at an earlier
point, is only their preconditioner. Each round takes the heat residual through the factor, lets
positions and film follow so that all forces keep their balance, and combines the last two changes
for the least residual (truncated generalised conjugate residuals).
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import inlined, kernel
from .dense import dense_solve
from .washer_fields import Bench, Fields, Point, washer_fields
from .washer_gap import DCONTACT, FRICTION, TANGENT_READY
from .washer_heat import solve_heat
from .washer_model import WasherModel, washer_model
from .washer_newton import RIGHT, SYSTEM, make_factor
from .washer_outputs import (
    COEFFICIENT,
    FILM_THICKNESS,
    FLUID_SHARE,
    MAX_TEMPERATURE,
    MEAN_TEMPERATURE,
    POWER,
    RATIO,
    TORQUE,
)  # fmt: skip
from .washer_tangent import (
    FORCE_SLOPES,
    OVER_OIL,
    OVER_SPEED,
    OVER_TILT,
    film_thickness_change,
    force_tangent,
    forces_by_heat,
    heat_tangent,
)  # fmt: skip

Array = NDArray[np.float64]
OK, MAX_ITERATIONS, SINGULAR, NOT_FINITE = 0, 10, 11, 14  # errors.Status; a test keeps them equal
DQ, STEP_Q, BEFORE_Q, LOOSE = 108, 112, 116, 120  # (4,) each, places in Fields.small
ROUNDS_DONE = 124  # counts the passes through the heat factor
CLOSE = 2e-7  # of the heat that the change moves
ROUNDS = 12  # then a new factor is made
NEAR_FOLD = 1e-8  # dload/dfilm in load per sigma below which there is no derivative


@kernel
def _follow(m: WasherModel, f: Fields, dq: Array) -> bool:
    """Fill ``dq`` so that the forces change by ``dq`` (on entry) [N, N, N m, N m]."""
    s, ro = f.small, m.outer_radius
    for a in range(4):
        row = 1.0 if a < 2 else 1.0 / ro
        for c in range(4):
            unit = m.sigma1 if c < 2 else m.sigma1 / ro
            s[SYSTEM + 4 * a + c] = s[FORCE_SLOPES + 4 * a + c] * unit * row
        s[RIGHT + a] = dq[a] * row
    if not dense_solve(s[SYSTEM : SYSTEM + 16], s[RIGHT : RIGHT + 4], 4, 1):
        return False
    for c in range(4):
        dq[c] = s[RIGHT + c] * (m.sigma1 if c < 2 else m.sigma1 / ro)
    return True


@kernel
def _add_slopes(f: Fields, dq: Array, dtemp: Array) -> None:
    """Add what the temperatures gain when the positions change by ``dq``."""
    n = dtemp.size
    for k in range(n):
        dtemp[np.uintp(k)] += (
            f.sens[np.uintp(k)] * dq[0] + f.sens[np.uintp(n + k)] * dq[1]
            + f.sens[np.uintp(2 * n + k)] * dq[2] + f.sens[np.uintp(3 * n + k)] * dq[3]
        )  # fmt: skip


@kernel
def _dot(a: Array, b: Array) -> float:
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    n = a.size // 4 * 4
    for k in range(0, n, 4):
        s0 += a[np.uintp(k)] * b[np.uintp(k)]
        s1 += a[np.uintp(k + 1)] * b[np.uintp(k + 1)]
        s2 += a[np.uintp(k + 2)] * b[np.uintp(k + 2)]
        s3 += a[np.uintp(k + 3)] * b[np.uintp(k + 3)]
    for k in range(n, a.size):
        s0 += a[np.uintp(k)] * b[np.uintp(k)]
    return (s0 + s1) + (s2 + s3)


@kernel
def _start(m: WasherModel, pt: Point, change: Point, f: Fields, dtemp: Array, heat: Array) -> int:
    """Fill a first change of positions (DQ) and ``dtemp``, with ``heat`` the residual it leaves."""
    s = f.small
    dq = s[DQ : DQ + 4]
    for a in range(4):
        dq[a] = 0.0
    for k in range(dtemp.size):
        dtemp[np.uintp(k)] = 0.0
    moved = abs(change.speed) + abs(change.tilt) + abs(change.oil_temperature)
    if moved > 0.0:
        heat_tangent(m, pt, change, dq, dtemp, f, heat)
        for k in range(heat.size):
            heat[np.uintp(k)] = -heat[np.uintp(k)]
        solve_heat(m, heat, dtemp, f)
    forces_by_heat(m, dtemp, f, dq)
    for a in range(4):
        dq[a] = -dq[a] - (
            s[OVER_SPEED + a] * change.speed + s[OVER_TILT + a] * change.tilt
            + s[OVER_OIL + a] * change.oil_temperature
        )  # fmt: skip
    dq[1] += change.load
    if not _follow(m, f, dq):
        return SINGULAR
    _add_slopes(f, dq, dtemp)
    heat_tangent(m, pt, change, dq, dtemp, f, heat)
    for k in range(heat.size):
        heat[np.uintp(k)] = -heat[np.uintp(k)]
    return OK


@kernel
def _size(a: Array) -> float:
    total = 0.0
    for k in range(a.size):
        total += abs(a[np.uintp(k)])
    return total


@kernel
def _refine(m: WasherModel, pt: Point, f: Fields, dtemp: Array, heat: Array, enough: float) -> int:
    """Improve DQ and ``dtemp`` until the residual ``heat`` is below ``enough`` [W]."""
    s, n = f.small, dtemp.size
    none = Point(0.0, 0.0, 0.0, 0.0)
    dq, step, before = s[DQ : DQ + 4], s[STEP_Q : STEP_Q + 4], s[BEFORE_Q : BEFORE_Q + 4]
    gain, old, old_gain = f.keep[n : 2 * n], f.keep[2 * n : 3 * n], f.keep[3 * n : 4 * n]
    old_square = 0.0
    for _ in range(ROUNDS):
        if _size(heat) <= enough:
            return OK
        f.small[ROUNDS_DONE] += 1.0
        solve_heat(m, heat, f.dtemp, f)
        forces_by_heat(m, f.dtemp, f, step)
        for a in range(4):
            step[a] = -step[a]
        if not _follow(m, f, step):
            return SINGULAR
        _add_slopes(f, step, f.dtemp)
        heat_tangent(m, pt, none, step, f.dtemp, f, gain)
        if old_square > 0.0:
            share = _dot(gain, old_gain) / old_square
            for k in range(n):
                f.dtemp[np.uintp(k)] -= share * old[np.uintp(k)]
                gain[np.uintp(k)] -= share * old_gain[np.uintp(k)]
            for a in range(4):
                step[a] -= share * before[a]
        old_square = _dot(gain, gain)
        if not old_square > 0.0:
            return MAX_ITERATIONS
        share = _dot(gain, heat) / old_square
        for k in range(n):
            dtemp[np.uintp(k)] += share * f.dtemp[np.uintp(k)]
            heat[np.uintp(k)] -= share * gain[np.uintp(k)]
            old[np.uintp(k)], old_gain[np.uintp(k)] = f.dtemp[np.uintp(k)], gain[np.uintp(k)]
        for a in range(4):
            dq[a] += share * step[a]
            before[a] = step[a]
    return OK if _size(heat) <= enough else MAX_ITERATIONS


@kernel
def _at_fold(m: WasherModel, pt: Point, f: Fields) -> bool:
    """Tell if the load has an extremum over the film thickness here."""
    rise = f.small[LOOSE : LOOSE + 4]
    rise[0], rise[1], rise[2], rise[3] = 0.0, pt.load, 0.0, 0.0
    if not _follow(m, f, rise):
        return True
    move = max(abs(rise[0]), m.outer_radius * max(abs(rise[2]), abs(rise[3])))
    return not move * NEAR_FOLD < m.sigma1


@inlined
def _change_of_state(m: WasherModel, pt: Point, change: Point, q: Array, f: Fields) -> int:
    """Fill DQ and the temperatures' change, ``f.keep[: n_temp]``; return a status."""
    n = f.temp.size
    dtemp, heat = f.keep[:n], f.heat
    for attempt in range(2):
        if attempt == 1 or f.tag[0] != 1.0:
            if not make_factor(m, pt, q, f.temp, f):
                return SINGULAR
            f.small[TANGENT_READY] = 0.0
        if not force_tangent(m, pt, f) or _at_fold(m, pt, f):
            return SINGULAR
        status = _start(m, pt, change, f, dtemp, heat)
        if status != OK:
            return status
        # what the change moves: a heat balance is as good as its largest terms
        moved = 0.0
        for k in range(n):
            moved += abs(dtemp[np.uintp(k)])
        spread = m.conductivity * m.outer_radius * m.outer_radius / m.carrier_thickness
        status = _refine(m, pt, f, dtemp, heat, CLOSE * moved / n * spread)
        if status == OK:
            return OK
    return status


@inlined
def _change_of_outputs(
    m: WasherModel, pt: Point, change: Point, q: Array, f: Fields, out: Array, dout: Array
) -> None:
    """Fill ``dout`` from the change of the state; ``out`` holds the outputs themselves."""
    n_r, m_t = m.n_r, 3 * m.n_r - m.i_g
    s = f.small
    dq, dtemp = s[DQ : DQ + 4], f.keep[: f.temp.size]
    side = 0.0
    if pt.speed != 0.0:
        side = math.copysign(1.0, pt.speed)
    dcontact = 0.0
    for a in range(4):
        dcontact += s[DCONTACT + a] * dq[a]
    friction, dfriction = side * s[FRICTION], side * s[FRICTION + 1] * dcontact
    torque, mean, area, hottest, dhottest = 0.0, 0.0, 0.0, -1e300, 0.0
    for j in range(m.n_t):
        for i in range(n_r):
            k = j * n_r + i
            r = m.r[i]
            w = m.weight1[i] * m.weight_t[j]
            dh = dq[0] + r * m.sin[j] * dq[2] - r * m.cos[j] * dq[3]
            carrier, washer = f.temp[j * m_t + i], f.temp[j * m_t + n_r + i]
            dcarrier, dwasher = dtemp[j * m_t + i], dtemp[j * m_t + n_r + i]
            dmu = f.dmu[k] * (0.5 * (dcarrier + dwasher) + change.oil_temperature)
            shear = pt.speed * r / f.ht[k]
            torque += w * r * (
                shear * (dmu - f.mu[k] * f.dht[k] * dh / f.ht[k])
                + f.mu[k] * change.speed * r / f.ht[k]
                + friction * f.dpc[k] * dh + dfriction * f.pc[k]
            )  # fmt: skip
            mean += 0.5 * w * (dcarrier + dwasher)
            area += w
            if max(carrier, washer) > hottest:
                hottest = max(carrier, washer)
                dhottest = dcarrier if carrier >= washer else dwasher
    dout[TORQUE] = torque
    dout[MEAN_TEMPERATURE] = change.oil_temperature + mean / area
    peak = out[MAX_TEMPERATURE] > out[MEAN_TEMPERATURE]
    dout[MAX_TEMPERATURE] = change.oil_temperature + (dhottest if peak else mean / area)
    dout[FILM_THICKNESS] = film_thickness_change(m, q, dq)
    dout[RATIO] = dout[FILM_THICKNESS] / m.sigma1
    # film and contact together carry the load
    dfluid = change.load - dcontact
    share = out[FLUID_SHARE]
    dout[FLUID_SHARE] = ((1.0 - share) * dfluid - share * dcontact) / pt.load
    ro, ri = m.outer_radius, m.inner_radius
    per_torque = 1.5 * (ro**2 - ri**2) / (pt.load * (ro**3 - ri**3))
    turn = math.copysign(1.0, out[TORQUE]) if out[TORQUE] != 0.0 else 0.0
    dout[COEFFICIENT] = per_torque * turn * torque - out[COEFFICIENT] * change.load / pt.load
    dout[POWER] = torque * pt.speed + out[TORQUE] * change.speed


@inlined
def differentiate(b: Bench, pt: Point, change: Point, q: Array, out: Array, dout: Array) -> int:
    """Fill ``dout``, the change of the outputs over a change of the point; return a status.

    Everything is as the last solve at ``pt`` has left it. SINGULAR at a fold: there the film
    thickness moves without bound as the load changes.
    """
    m = washer_model(b.par)
    f = washer_fields(m, b.work)
    f.small[ROUNDS_DONE] = 0.0
    status = _change_of_state(m, pt, change, q, f)
    if status != OK:
        return status
    _change_of_outputs(m, pt, change, q, f, out, dout)
    for k in range(dout.size):
        if not math.isfinite(dout[k]):
            return NOT_FINITE
    return OK
