"""Tangents at a solution: of the heat balance and of the forces, over everything they depend on.

A change of the operating point is a ``Point`` of changes. The film follows each change by its own
equations, its full nodes held: dF = w . dp with L dp = -dR becomes dF = -(L^-1 w) . dR, so that
four solves with the film's symmetric matrix give the slopes of all forces over everything.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .banded import N_SIDES, cholesky_solve_many
from .washer_fields import RATE, Fields, Point
from .washer_film import band_of_film, film_factor, size_of_film
from .washer_gap import DCONTACT, FRICTION, STIFF, TANGENT_READY
from .washer_heat import conduct, store
from .washer_model import WasherModel

Array = NDArray[np.float64]
# places in Fields.small, all used by nothing else between evaluations
FORCE_SLOPES = 80  # (16,) slopes of the forces over q, temperatures following by ``Fields.sens``
OVER_SPEED = 96  # (4,) slopes of the forces over the speed, temperatures held
OVER_TILT = 100  # (4,) over the tilt
OVER_OIL = 104  # (4,) over the oil temperature
N_PRESSED = 3  # of the forces: the film presses on all but the gear, z_w, gx, gy


@kernel
def heat_tangent(
    m: WasherModel, pt: Point, change: Point, dq: Array, dtemp: Array, f: Fields, heat: Array
) -> None:
    """Fill ``heat`` [W], the change of the heat residual that positions, T and inputs bring."""
    n_r, n_t, i_g = m.n_r, m.n_t, m.i_g
    m_t = 3 * n_r - i_g
    half = m.washer_thickness / (2.0 * m.conductivity)
    per_oil = 1.0 / m.oil_conductivity
    omega = abs(pt.speed)
    domega = change.speed if pt.speed > 0.0 else -change.speed
    if pt.speed == 0.0:
        domega = 0.0
    dcontact = 0.0
    for a in range(4):
        dcontact += f.small[DCONTACT + a] * dq[a]
    friction, dfriction = f.small[FRICTION], f.small[FRICTION + 1] * dcontact
    conduct(m, dtemp, f, heat)
    if f.small[RATE] != 0.0:  # a rise above warmer oil is less: the body stays as warm as it was
        for node in range(dtemp.size):
            f.spare[np.uintp(node)] = 0.0
        store(m, dtemp, f.spare, change.oil_temperature, f, heat)
    for j in range(n_t):
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            ic = np.uintp(j * m_t + i)
            iw = ic + np.uintp(n_r)
            x, y = m.r[i] * m.cos[j], m.r[i] * m.sin[j]
            w1 = m.weight1[i] * m.weight_t[j]
            v, dv = omega * m.r[i], domega * m.r[i]
            dh = dq[0] + y * dq[2] - x * dq[3]
            dht, dpc = f.dht[k] * dh, f.dpc[k] * dh
            dmu = f.dmu[k] * (0.5 * (dtemp[ic] + dtemp[iw]) + change.oil_temperature)
            per_gap = 1.0 / f.ht[k]
            shear = m.film_heat_fraction * v * per_gap
            made = w1 * (
                shear * (dmu * v + 2.0 * f.mu[k] * dv - f.mu[k] * v * dht * per_gap)
                + friction * (dpc * v + f.pc[k] * dv) + dfriction * f.pc[k] * v
            )  # fmt: skip
            res = f.ht[k] * per_oil + half
            across = w1 * (f.temp[ic] - f.temp[iw]) / (res * res) * dht * per_oil
            heat[ic] -= across + m.heat_split * made
            heat[iw] += across - (1.0 - m.heat_split) * made
            if i >= i_g:
                ig = np.uintp(j * m_t + 2 * n_r + i - i_g)
                w2 = m.weight2[i] * m.weight_t[j]
                dh2 = dq[1] - dq[0] - y * dq[2] + x * (dq[3] - change.tilt)
                res = f.ht2[k] * per_oil + half
                across = w2 * (f.temp[iw] - f.temp[ig]) / (res * res)
                across *= f.dht2[k] * dh2 * per_oil
                heat[iw] -= across
                heat[ig] += across


@kernel
def _spread(m: WasherModel, f: Fields) -> bool:
    """Fill ``f.lag[node * N_SIDES + c]``, what force c gains by a unit source at a film node."""
    n_r, n_t = m.n_r, m.n_t
    rows = n_r - 2
    if not film_factor(m, f):
        return False
    for j in range(n_t):
        row = int(f.place[j]) * rows - 1
        for i in range(1, n_r - 1):
            if f.place[j] >= 0.0:
                k = j * n_r + i
                w = m.weight1[i] * m.weight_t[j] * f.wet[k]
                a = (row + i) * N_SIDES
                for s in range(N_SIDES):
                    f.sides[np.uintp(a + s)] = 0.0
                f.sides[a], f.sides[a + 1] = w, w * m.r[i] * m.sin[j]
                f.sides[a + 2] = -w * m.r[i] * m.cos[j]
    cholesky_solve_many(f.film, f.sides, size_of_film(m, f), band_of_film(m, f))
    for j in range(n_t):
        row = int(f.place[j]) * rows - 1
        for i in range(n_r):
            k = j * n_r + i
            inside = f.place[j] >= 0.0 and 0 < i < n_r - 1
            for s in range(N_PRESSED):
                f.lag[np.uintp(k * N_SIDES + s)] = (
                    f.sides[np.uintp((row + i) * N_SIDES + s)] * f.wet[k] if inside else 0.0
                )
    return True


@kernel
def _through(
    f: Fields, k: int, o: int, flow: float, per_h: float, wedge: float, x: float, y: float
) -> None:
    """Add what one face, from node ``k`` to ``o``, contributes to the slopes of the forces.

    ``flow`` is conductance times pressure drop, per unit of fluidity; ``per_h`` the change of the
    flow over the gap; ``wedge`` that over the speed.
    """
    s = f.small
    a, b = k * N_SIDES, o * N_SIDES
    for c in range(N_PRESSED):
        gain = f.lag[np.uintp(b + c)] - f.lag[np.uintp(a + c)]
        f.film_rhs[np.uintp(a + c)] += gain * flow
        f.film_rhs[np.uintp(b + c)] += gain * flow
        force = c + 1 if c > 0 else 0
        s[FORCE_SLOPES + 4 * force] += gain * per_h
        s[FORCE_SLOPES + 4 * force + 2] += gain * per_h * y
        s[FORCE_SLOPES + 4 * force + 3] -= gain * per_h * x
        s[OVER_SPEED + force] += gain * wedge


@kernel
def _film_slopes(m: WasherModel, pt: Point, f: Fields) -> None:
    """Add the film's part to the slopes of the forces; over the fluidity in ``f.film_rhs``."""
    n_r, n_t = m.n_r, m.n_t
    per_speed = 1.0 / pt.speed if pt.speed != 0.0 else 0.0
    for k in range(N_SIDES * n_r * n_t):
        f.film_rhs[np.uintp(k)] = 0.0
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        if not (f.place[j] >= 0.0 or f.place[jn] >= 0.0):
            continue
        for i in range(n_r - 1):
            k = j * n_r + i
            here = f.fluidity[k]
            if i > 0:
                o = jn * n_r + i
                drop = f.p[k] - f.p[o]
                fluid = here + f.fluidity[o]
                _through(f, k, o, f.ct[k] * drop, f.dct[k] * fluid * drop + f.dwedge[k],
                         f.wedge[k] * per_speed, m.r[i] * m.cos_face[j],
                         m.r[i] * m.sin_face[j])  # fmt: skip
            drop = f.p[k] - f.p[k + 1]
            fluid = here + f.fluidity[k + 1]
            _through(f, k, k + 1, f.cr[k] * drop, f.dcr[k] * fluid * drop, 0.0,
                     m.r_face[i] * m.cos[j], m.r_face[i] * m.sin[j])  # fmt: skip


@kernel
def _over_temperature(m: WasherModel, f: Fields) -> None:
    """Turn the slopes over the fluidity in ``f.film_rhs`` into slopes over the film's temperature.

    Adds what follows from ``f.sens`` to the slopes over q, and fills those over the oil's.
    """
    n_r, m_t = m.n_r, 3 * m.n_r - m.i_g
    n_temp = m_t * m.n_t
    s = f.small
    for j in range(m.n_t):
        for i in range(n_r):
            k, t = j * n_r + i, j * m_t + i
            scale = -f.dmu[k] * f.fluidity[k] * f.fluidity[k]
            for c in range(N_PRESSED):
                force = c + 1 if c > 0 else 0
                slope = scale * f.film_rhs[np.uintp(k * N_SIDES + c)]
                f.film_rhs[np.uintp(k * N_SIDES + c)] = slope
                s[OVER_OIL + force] += slope
                for a in range(4):
                    b = a * n_temp + t
                    s[FORCE_SLOPES + 4 * force + a] += (
                        0.5 * slope * (f.sens[np.uintp(b)] + f.sens[np.uintp(b + n_r)])
                    )


@kernel
def force_tangent(m: WasherModel, pt: Point, f: Fields) -> bool:
    """Fill the slopes of the forces conjugate to q; return False if the film has none.

    Done once for each evaluation of the gaps.

    Out: FORCE_SLOPES, OVER_SPEED, OVER_TILT, OVER_OIL in ``f.small``; over the mean temperature of
    the film at a node in ``f.film_rhs[node * N_SIDES + c]``, c < N_PRESSED.
    """
    s = f.small
    if s[TANGENT_READY] == 1.0:
        return True
    for a in range(16):
        s[FORCE_SLOPES + a] = s[STIFF + a]
    for a in range(4):
        s[OVER_SPEED + a], s[OVER_TILT + a], s[OVER_OIL + a] = 0.0, 0.0, 0.0
    for j in range(m.n_t):
        for i in range(m.i_g, m.n_r):
            k = np.uintp(j * m.n_r + i)
            if f.pc2[k] > 0.0:
                x, y = m.r[i] * m.cos[j], m.r[i] * m.sin[j]
                push = -m.weight2[i] * m.weight_t[j] * f.dpc2[k] * x
                s[OVER_TILT] -= push
                s[OVER_TILT + 1] += push
                s[OVER_TILT + 2] -= push * y
                s[OVER_TILT + 3] += push * x
    if not _spread(m, f):
        return False
    _film_slopes(m, pt, f)
    _over_temperature(m, f)
    s[TANGENT_READY] = 1.0
    return True


@kernel
def forces_by_heat(m: WasherModel, dtemp: Array, f: Fields, out: Array) -> None:
    """Fill ``out`` (4,), the changes of the forces that a change of temperatures brings."""
    n_r, m_t = m.n_r, 3 * m.n_r - m.i_g
    o0, o2, o3 = 0.0, 0.0, 0.0  # the film does not press on the gear
    for j in range(m.n_t):
        for i in range(n_r):
            a = np.uintp((j * n_r + i) * N_SIDES)
            t = np.uintp(j * m_t + i)
            mean = 0.5 * (dtemp[t] + dtemp[t + np.uintp(n_r)])
            o0 += f.film_rhs[a] * mean
            o2 += f.film_rhs[a + np.uintp(1)] * mean
            o3 += f.film_rhs[a + np.uintp(2)] * mean
    out[0], out[1], out[2], out[3] = o0, 0.0, o2, o3


@kernel
def film_thickness_change(m: WasherModel, q: Array, dq: Array) -> float:
    """Return the change of the least film thickness [m]; a level washer's tilt has no slope."""
    tilt = math.sqrt(q[2] * q[2] + q[3] * q[3])
    if tilt == 0.0:
        return float(dq[0])
    return float(dq[0] - m.outer_radius * (q[2] * dq[2] + q[3] * dq[3]) / tilt)
