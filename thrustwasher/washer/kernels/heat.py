"""Heat balance of carrier, washer and gear: residual, matrix, slopes over the positions.

Finite volumes in the plane, conduction across by resistances. Sources and conduction across use
the same weights as force and torque, so that friction power in is heat out to rounding.

Temperatures are rises above the oil: no digits are lost on a cool washer.

Source: Jackson & Green Eq 19-29; R1 = h_T/K_oil + t_w/(2 K), likewise R2.
"""

import numpy as np

from ...numerics.banded import cholesky, cholesky_solve, lu, lu_solve, mirror
from ...numerics.jit import Array, kernel
from . import layout as L
from .constants import WasherModel
from .workspace import Fields, Point, clear, vector


@kernel
def conduct(m: WasherModel, temp: Array, f: Fields, heat: Array) -> None:
    """Fill ``heat`` [W], what leaves each node by conduction at temperatures ``temp``."""
    n_r, n_t, i_g = m.n_r, m.n_t, m.i_g
    m_t = 3 * n_r - i_g
    kc = m.conductivity * m.carrier_thickness
    kw = m.conductivity * m.washer_thickness
    kg = m.conductivity * m.gear_thickness
    far_c, far_g = m.conductivity / m.carrier_thickness, m.conductivity / m.gear_thickness
    half = m.washer_thickness / (2.0 * m.conductivity)
    per_oil = 1.0 / m.oil_conductivity
    clear(heat)
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        c0, n0 = j * m_t, jn * m_t
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            ic, iw = np.uintp(c0 + i), np.uintp(c0 + n_r + i)
            w1 = m.weight1[i] * m.weight_t[j]
            across = w1 * (temp[ic] - temp[iw]) / (f.ht[k] * per_oil + half)
            heat[ic] += across + w1 * far_c * temp[ic]
            heat[iw] -= across
            # to the next column
            g = m.log_width[i] * m.per_step[j]
            flow = kc * m.carrier_spread * g * (temp[ic] - temp[np.uintp(n0 + i)])
            heat[ic] += flow
            heat[np.uintp(n0 + i)] -= flow
            flow = kw * m.rotating_spread * g * (temp[iw] - temp[np.uintp(n0 + n_r + i)])
            heat[iw] += flow
            heat[np.uintp(n0 + n_r + i)] -= flow
            if i + 1 < n_r:  # to the next radius
                g = m.along[i] * m.width_t[j]
                flow = kc * g * (temp[ic] - temp[ic + np.uintp(1)])
                heat[ic] += flow
                heat[ic + np.uintp(1)] -= flow
                flow = kw * g * (temp[iw] - temp[iw + np.uintp(1)])
                heat[iw] += flow
                heat[iw + np.uintp(1)] -= flow
            if i >= i_g:
                ig = np.uintp(c0 + 2 * n_r + i - i_g)
                ign = np.uintp(n0 + 2 * n_r + i - i_g)
                w2 = m.weight2[i] * m.weight_t[j]
                across = w2 * (temp[iw] - temp[ig]) / (f.ht2[k] * per_oil + half)
                heat[iw] += across
                heat[ig] += w2 * far_g * temp[ig] - across
                g = kg * m.rotating_spread * m.gear_width[i] * m.per_step[j]
                flow = g * (temp[ig] - temp[ign])
                heat[ig] += flow
                heat[ign] -= flow
                if i + 1 < n_r:
                    g = m.along[i] * m.width_t[j]
                    flow = kg * g * (temp[ig] - temp[ig + np.uintp(1)])
                    heat[ig] += flow
                    heat[ig + np.uintp(1)] -= flow


@kernel
def store(m: WasherModel, temp: Array, less: Array, more: float, f: Fields, heat: Array) -> float:
    """Add to ``heat`` [W] what the bodies store at the rate in ``f.small``; return its size [W].

    A body of thickness t takes density x specific heat x t x area x rate x (temp - less + more).
    """
    n_r, m_t = m.n_r, 3 * m.n_r - m.i_g
    rate = m.volume_heat * f.small[L.RATE]
    size = 0.0
    for j in range(m.n_t):
        for k in range(m_t):
            i = k % n_r if k < 2 * n_r else k - 2 * n_r + m.i_g
            if k < n_r:
                capacity = m.carrier_thickness * m.weight1[i]
            elif k < 2 * n_r:
                capacity = m.washer_thickness * m.weight1[i]
            else:
                capacity = m.gear_thickness * m.weight2[i]
            a = np.uintp(j * m_t + k)
            flow = rate * capacity * m.weight_t[j] * (temp[a] - less[a] + more)
            heat[a] += flow
            # no balance is better than the rounding of a temperature
            size += abs(flow) + 1e-8 * rate * capacity * m.weight_t[j] * abs(temp[a])
    return size


@kernel
def heat_residual(m: WasherModel, pt: Point, temp: Array, f: Fields) -> float:
    """Fill ``f.heat`` [W], heat leaving each node less heat made; return the heat made [W]."""
    n_r, m_t = m.n_r, 3 * m.n_r - m.i_g
    omega = abs(pt.speed)
    friction = f.small[L.FRICTION]
    conduct(m, temp, f, f.heat)
    if f.small[L.RATE] != 0.0:
        f.small[L.STORED] = store(m, temp, f.past, 0.0, f, f.heat)
    made = 0.0
    for j in range(m.n_t):
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            ic = np.uintp(j * m_t + i)
            v = omega * m.r[i]
            q = m.film_heat_fraction * f.mu[k] * v * v / f.ht[k] + friction * f.pc[k] * v
            q *= m.weight1[i] * m.weight_t[j]
            made += q
            f.heat[ic] -= m.heat_split * q
            f.heat[ic + np.uintp(n_r)] -= (1.0 - m.heat_split) * q
    return made


@kernel
def _place(j: int, n_t: int) -> int:
    """Return the position of column j when the ring is folded: 0, n-1, 1, n-2, ..."""
    return 2 * j if 2 * j <= n_t - 1 else 2 * (n_t - 1 - j) + 1


@kernel
def _add(a: Array, band: int, symmetric: bool, row: int, col: int, value: float) -> None:
    """Add to one entry of the band matrix; a symmetric one keeps its lower half only."""
    if symmetric:
        if row >= col:
            a[col * (band + 1) + row - col] += value
    else:
        a[row * (2 * band + 1) + band + col - row] += value


@kernel
def _link(a: Array, band: int, symmetric: bool, one: int, two: int, g: float) -> None:
    """Add a conductance between two unknowns."""
    _add(a, band, symmetric, one, one, g)
    _add(a, band, symmetric, two, two, g)
    _add(a, band, symmetric, one, two, -g)
    _add(a, band, symmetric, two, one, -g)


@kernel
def factor_heat(m: WasherModel, pt: Point, f: Fields) -> bool:
    """Assemble the slope of the heat residual over all temperatures in ``f.factor``; factor it.

    Columns go in folded order, so that the ring is a band of two columns. The matrix is symmetric
    (Cholesky) when the heat is split evenly, else it is factored by LU.
    """
    n_r, n_t, i_g = m.n_r, m.n_t, m.i_g
    m_t = 3 * n_r - i_g
    band = 2 * m_t
    symmetric = m.heat_split == 0.5
    a = f.factor
    clear(a[: m_t * n_t * (band + 1 if symmetric else 2 * band + 1)])
    kc = m.conductivity * m.carrier_thickness
    kw = m.conductivity * m.washer_thickness
    kg = m.conductivity * m.gear_thickness
    far_c, far_g = m.conductivity / m.carrier_thickness, m.conductivity / m.gear_thickness
    half = m.washer_thickness / (2.0 * m.conductivity)
    per_oil = 1.0 / m.oil_conductivity
    omega = abs(pt.speed)
    rate = m.volume_heat * f.small[L.RATE]
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        c0, n0 = _place(j, n_t) * m_t, _place(jn, n_t) * m_t
        for i in range(n_r):
            k = j * n_r + i
            ic, iw = c0 + i, c0 + n_r + i
            w1 = m.weight1[i] * m.weight_t[j]
            v = omega * m.r[i]
            _link(a, band, symmetric, ic, iw, w1 / (f.ht[k] * per_oil + half))
            _add(a, band, symmetric, ic, ic, w1 * (far_c + rate * m.carrier_thickness))
            _add(a, band, symmetric, iw, iw, w1 * rate * m.washer_thickness)
            # the film's heat falls with either temperature
            s = -0.5 * w1 * m.film_heat_fraction * f.dmu[k] * v * v / f.ht[k]
            _add(a, band, symmetric, ic, ic, m.heat_split * s)
            _add(a, band, symmetric, ic, iw, m.heat_split * s)
            _add(a, band, symmetric, iw, ic, (1.0 - m.heat_split) * s)
            _add(a, band, symmetric, iw, iw, (1.0 - m.heat_split) * s)
            g = m.log_width[i] * m.per_step[j]
            _link(a, band, symmetric, ic, n0 + i, kc * m.carrier_spread * g)
            _link(a, band, symmetric, iw, n0 + n_r + i, kw * m.rotating_spread * g)
            along = 0.0
            if i + 1 < n_r:
                along = m.along[i] * m.width_t[j]
                _link(a, band, symmetric, ic, ic + 1, kc * along)
                _link(a, band, symmetric, iw, iw + 1, kw * along)
            if i >= i_g:
                ig, ign = c0 + 2 * n_r + i - i_g, n0 + 2 * n_r + i - i_g
                w2 = m.weight2[i] * m.weight_t[j]
                _link(a, band, symmetric, iw, ig, w2 / (f.ht2[k] * per_oil + half))
                _add(a, band, symmetric, ig, ig, w2 * (far_g + rate * m.gear_thickness))
                g = kg * m.rotating_spread * m.gear_width[i] * m.per_step[j]
                _link(a, band, symmetric, ig, ign, g)
                if i + 1 < n_r:
                    _link(a, band, symmetric, ig, ig + 1, kg * along)
    if symmetric:
        if not cholesky(a, m_t * n_t, band):
            return False
        mirror(a, m_t * n_t, band)
        return True
    return lu(a, m_t * n_t, band)


@kernel
def solve_heat(m: WasherModel, rhs: Array, x: Array, f: Fields) -> None:
    """Solve the factored heat equations for ``rhs`` (n_temp,); the solution goes to ``x``."""
    n_t, m_t = m.n_t, 3 * m.n_r - m.i_g
    for j in range(n_t):
        to, fro = _place(j, n_t) * m_t, j * m_t
        for k in range(m_t):
            f.spare[np.uintp(to + k)] = rhs[np.uintp(fro + k)]
    if m.heat_split == 0.5:
        cholesky_solve(f.factor, f.spare, m_t * n_t, 2 * m_t)
    else:
        lu_solve(f.factor, f.spare, m_t * n_t, 2 * m_t)
    for j in range(n_t):
        fro, to = _place(j, n_t) * m_t, j * m_t
        for k in range(m_t):
            x[np.uintp(to + k)] = f.spare[np.uintp(fro + k)]


@kernel
def heat_slopes(m: WasherModel, pt: Point, temp: Array, f: Fields) -> None:
    """Fill ``f.following``, minus the slopes of the heat residual over the positions."""
    n_r, n_t, i_g = m.n_r, m.n_t, m.i_g
    m_t = 3 * n_r - i_g
    half = m.washer_thickness / (2.0 * m.conductivity)
    per_oil = 1.0 / m.oil_conductivity
    omega = abs(pt.speed)
    friction, dfriction = f.small[L.FRICTION], f.small[L.FRICTION_SLOPE]
    contact_slopes = vector(f.small, L.CONTACT_SLOPES)
    for c in range(4):
        clear(f.following[c])
    for j in range(n_t):
        for i in range(n_r):
            k = j * n_r + i
            ic = j * m_t + i
            iw = ic + n_r
            x, y = m.r[i] * m.cos[j], m.r[i] * m.sin[j]
            w1 = m.weight1[i] * m.weight_t[j]
            v = omega * m.r[i]
            res = f.ht[k] * per_oil + half
            dacross = -w1 * (temp[ic] - temp[iw]) / (res * res) * f.dht[k] * per_oil
            dq = w1 * (
                friction * f.dpc[k] * v
                - m.film_heat_fraction * f.mu[k] * v * v / (f.ht[k] * f.ht[k]) * f.dht[k]
            )
            dc = m.heat_split * dq - dacross
            dw = (1.0 - m.heat_split) * dq + dacross
            # through the friction coefficient, which knows the total contact force
            all_q = w1 * dfriction * f.pc[k] * v
            slopes = (1.0, 0.0, y, -x)  # of the gap over the positions
            for c in range(4):
                part = all_q * contact_slopes[c]
                f.following[c, ic] += dc * slopes[c] + m.heat_split * part
                f.following[c, iw] += dw * slopes[c] + (1.0 - m.heat_split) * part
            if i >= i_g:
                ig = j * m_t + 2 * n_r + i - i_g
                w2 = m.weight2[i] * m.weight_t[j]
                res = f.ht2[k] * per_oil + half
                d = -w2 * (temp[iw] - temp[ig]) / (res * res) * f.dht2[k] * per_oil
                slopes = (-1.0, 1.0, -y, x)
                for c in range(4):
                    f.following[c, iw] -= d * slopes[c]
                    f.following[c, ig] += d * slopes[c]
