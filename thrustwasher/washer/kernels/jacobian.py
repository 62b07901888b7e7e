"""Jacobian at a solution: of the heat balance and of the forces, over everything they depend on.

A change of the operating point is a ``Point`` of changes. The film follows each change by its own
equations, its full nodes held: dF = w . dp with L dp = -dR becomes dF = -(L^-1 w) . dR, so that
four solves with the film's symmetric matrix give the slopes of all forces over everything.
"""

import numpy as np

from ...numerics.banded import N_SIDES
from ...numerics.jit import Array, kernel, matrix
from . import layout as L
from .constants import WasherModel
from .film import film_back_substitution, film_factor
from .heat import conduct, store
from .layout import MOMENT_X, MOMENT_Y, ON_GEAR, ON_WASHER, TILT_X, TILT_Y, Z_GEAR, Z_WASHER
from .newton import tilt_of
from .workspace import Fields, Point, clear, copy, square, vector


@kernel
def contact_change(small: Array, dq: Array) -> float:
    """Return the change of the contact force of film 1 [N] as the positions change."""
    slopes = vector(small, L.CONTACT_SLOPES)
    change = 0.0
    for c in range(4):
        change += slopes[c] * dq[c]
    return change


@kernel
def heat_change(
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
    friction, dfriction = (
        f.small[L.FRICTION],
        f.small[L.FRICTION_SLOPE] * contact_change(f.small, dq),
    )
    conduct(m, dtemp, f, heat)
    if f.small[L.RATE] != 0.0:  # a rise above warmer oil is less: the body stays as warm as it was
        clear(f.spare)
        store(m, dtemp, f.spare, change.oil_temperature, f, heat)
    for j in range(n_t):
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            ic = np.uintp(j * m_t + i)
            iw = ic + np.uintp(n_r)
            x, y = m.r[i] * m.cos[j], m.r[i] * m.sin[j]
            w1 = m.weight1[i] * m.weight_t[j]
            v, dv = omega * m.r[i], domega * m.r[i]
            dh = dq[Z_WASHER] + y * dq[TILT_X] - x * dq[TILT_Y]
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
                dh2 = dq[Z_GEAR] - dq[Z_WASHER] - y * dq[TILT_X]
                dh2 += x * (dq[TILT_Y] - change.tilt)
                res = f.ht2[k] * per_oil + half
                across = w2 * (f.temp[iw] - f.temp[ig]) / (res * res)
                across *= f.dht2[k] * dh2 * per_oil
                heat[iw] -= across
                heat[ig] += across


@kernel
def force_of(c: int) -> int:
    """Return which force the film's pressure makes with its weights ``c`` (none on the gear)."""
    return c + 1 if c > 0 else 0


@kernel
def _spread(m: WasherModel, f: Fields) -> bool:
    """Fill ``f.lag[node, c]``, what force c gains by a unit source at a film node."""
    n_r, n_t = m.n_r, m.n_t
    rows = n_r - 2
    if not film_factor(m, f):
        return False
    sides = matrix(f.sides, n_r * n_t, N_SIDES)
    for j in range(n_t):
        row = int(f.place[j]) * rows - 1
        for i in range(1, n_r - 1):
            if f.place[j] >= 0.0:
                w = m.weight1[i] * m.weight_t[j] * f.wet[j * n_r + i]
                side = sides[row + i]
                clear(side)
                side[0], side[1] = w, w * m.r[i] * m.sin[j]
                side[2] = -w * m.r[i] * m.cos[j]
    film_back_substitution(m, f, f.lag, L.N_PRESSED)
    return True


@kernel
def _through(
    f: Fields, k: int, o: int, flow: float, per_h: float, wedge: float, x: float, y: float
) -> None:
    """Add what one face, from node ``k`` to ``o``, contributes to the slopes of the forces.

    ``flow`` is conductance times pressure drop, per unit of fluidity; ``per_h`` the change of the
    flow over the gap; ``wedge`` that over the speed.
    """
    slopes, over_speed = square(f.small, L.FORCE_SLOPES), vector(f.small, L.OVER_SPEED)
    a, b = np.uintp(k), np.uintp(o)
    for c in range(L.N_PRESSED):
        gain = f.lag[b, np.uintp(c)] - f.lag[a, np.uintp(c)]
        f.film_rhs[a, np.uintp(c)] += gain * flow
        f.film_rhs[b, np.uintp(c)] += gain * flow
        force = np.uintp(force_of(c))
        slopes[force, Z_WASHER] += gain * per_h
        slopes[force, TILT_X] += gain * per_h * y
        slopes[force, TILT_Y] -= gain * per_h * x
        over_speed[force] += gain * wedge


@kernel
def _film_slopes(m: WasherModel, pt: Point, f: Fields) -> None:
    """Add the film's part to the slopes of the forces; over the fluidity in ``f.film_rhs``."""
    n_r, n_t = m.n_r, m.n_t
    per_speed = 1.0 / pt.speed if pt.speed != 0.0 else 0.0
    for k in range(n_r * n_t):
        for c in range(N_SIDES):
            f.film_rhs[np.uintp(k), np.uintp(c)] = 0.0
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
                per_h = f.dct[k] * fluid * drop + f.dwedge[k]
                x, y = m.r[i] * m.cos_face[j], m.r[i] * m.sin_face[j]
                _through(f, k, o, f.ct[k] * drop, per_h, f.wedge[k] * per_speed, x, y)
            drop = f.p[k] - f.p[k + 1]
            fluid = here + f.fluidity[k + 1]
            x, y = m.r_face[i] * m.cos[j], m.r_face[i] * m.sin[j]
            _through(f, k, k + 1, f.cr[k] * drop, f.dcr[k] * fluid * drop, 0.0, x, y)


@kernel
def _over_temperature(m: WasherModel, f: Fields) -> None:
    """Turn the slopes over the fluidity in ``f.film_rhs`` into slopes over the film's temperature.

    Adds what follows from ``f.following`` to the slopes over q, and fills those over the oil's.
    """
    n_r, m_t = m.n_r, 3 * m.n_r - m.i_g
    slopes, over_oil = square(f.small, L.FORCE_SLOPES), vector(f.small, L.OVER_OIL)
    for j in range(m.n_t):
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            t, below = np.uintp(j * m_t + i), np.uintp(j * m_t + i + n_r)
            scale = -f.dmu[k] * f.fluidity[k] * f.fluidity[k]
            for c in range(L.N_PRESSED):
                force = np.uintp(force_of(c))
                slope = scale * f.film_rhs[k, np.uintp(c)]
                f.film_rhs[k, np.uintp(c)] = slope
                over_oil[force] += slope
                for a in range(4):
                    following = f.following[np.uintp(a), t] + f.following[np.uintp(a), below]
                    slopes[force, np.uintp(a)] += 0.5 * slope * following


@kernel
def force_jacobian(m: WasherModel, pt: Point, f: Fields) -> bool:
    """Fill the slopes of the forces conjugate to q; return False if the film has none.

    Done once for each evaluation of the gaps.

    Out: FORCE_SLOPES, OVER_SPEED, OVER_TILT, OVER_OIL in ``f.small``; over the mean temperature of
    the film at a node in ``f.film_rhs[node, c]``, c < N_PRESSED.
    """
    s = f.small
    if s[L.JACOBIAN_READY] == 1.0:
        return True
    copy(s[L.STIFFNESS : L.STIFFNESS + 16], s[L.FORCE_SLOPES : L.FORCE_SLOPES + 16])
    over_tilt = vector(s, L.OVER_TILT)
    clear(vector(s, L.OVER_SPEED))
    clear(over_tilt)
    clear(vector(s, L.OVER_OIL))
    for j in range(m.n_t):
        for i in range(m.i_g, m.n_r):
            k = np.uintp(j * m.n_r + i)
            if f.pc2[k] > 0.0:
                x, y = m.r[i] * m.cos[j], m.r[i] * m.sin[j]
                push = -m.weight2[i] * m.weight_t[j] * f.dpc2[k] * x
                over_tilt[ON_WASHER] -= push
                over_tilt[ON_GEAR] += push
                over_tilt[MOMENT_X] -= push * y
                over_tilt[MOMENT_Y] += push * x
    if not _spread(m, f):
        return False
    _film_slopes(m, pt, f)
    _over_temperature(m, f)
    s[L.JACOBIAN_READY] = 1.0
    return True


@kernel
def forces_by_heat(m: WasherModel, dtemp: Array, f: Fields, out: Array) -> None:
    """Fill ``out`` (4,), the changes of the forces that a change of temperatures brings."""
    n_r, m_t = m.n_r, 3 * m.n_r - m.i_g
    on_washer, moment_x, moment_y = 0.0, 0.0, 0.0  # the film does not press on the gear
    for j in range(m.n_t):
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            t = np.uintp(j * m_t + i)
            mean = 0.5 * (dtemp[t] + dtemp[t + np.uintp(n_r)])
            on_washer += f.film_rhs[k, 0] * mean
            moment_x += f.film_rhs[k, 1] * mean
            moment_y += f.film_rhs[k, 2] * mean
    out[ON_WASHER], out[ON_GEAR] = on_washer, 0.0
    out[MOMENT_X], out[MOMENT_Y] = moment_x, moment_y


@kernel
def film_thickness_change(ro: float, q: Array, dq: Array) -> float:
    """Return the change of the least film thickness [m]; a level washer's tilt has no slope."""
    tilt = tilt_of(q)
    if tilt == 0.0:
        return float(dq[Z_WASHER])
    dip = ro * (q[TILT_X] * dq[TILT_X] + q[TILT_Y] * dq[TILT_Y]) / tilt
    return float(dq[Z_WASHER] - dip)
