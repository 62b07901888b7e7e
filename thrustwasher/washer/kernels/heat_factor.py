"""Factor of the heat equations: a band over the columns, bordered by the rings of bodies that turn.

Columns go in folded order (0, n - 1, 1, n - 2, ...), so that the ring of columns is a band of two.
The flows of the oil, its pressures and its share of liquid are held, and so is what the walls
upstream change of its temperature: with them the matrix would lose its band. It is symmetric
(Cholesky) where the oil carries no heat and the heat is split evenly, else factored by LU.

``Fields.factor``: the band, its factors; the columns of the border, then solved for; its rows;
what the rings keep, factored (Schur complement).
"""

from typing import NamedTuple

import numpy as np

from ...numerics.arrays import clear
from ...numerics.banded import N_SIDES, cholesky, factor_solve, factor_solve_many, halve, lu, mirror
from ...numerics.dense import dense_factor, dense_substitute
from ...numerics.jit import Array, kernel, matrix
from . import layout as L
from .constants import WasherModel
from .workspace import Fields, Point, padded


class Blocks(NamedTuple):
    """The parts of the heat equations' factor."""

    band: Array  # the matrix: by rows, or its lower half by columns if it is symmetric
    lower: Array  # (n_band (2 per_column + 1),) lower factor by columns
    mirrored: Array  # upper factor by columns, last first
    right: Array  # (sides / N_SIDES, n_band, N_SIDES) flat: columns of the border, in groups
    below: Array  # (n_band, sides) rows of the border, node by node
    under: Array  # the same, flat
    rings: Array  # (sides, sides)
    flat: Array  # the same with room for the pivots


@kernel
def blocks_of(m: WasherModel, f: Fields) -> Blocks:
    """Return the parts of the factor; the arrays are views."""
    n = m.per_column * m.n_t
    size = n * (2 * m.per_column + 1)
    sides = padded(m.n_ring)
    border = 4 * size
    rows = border + sides * n
    rings = rows + sides * n
    return Blocks(
        band=f.factor[: 2 * size],
        lower=f.factor[2 * size : 3 * size],
        mirrored=f.factor[3 * size : border],
        right=f.factor[border:rows],
        below=matrix(f.factor[rows:rings], n, sides),
        under=f.factor[rows:rings],
        rings=matrix(f.factor[rings : rings + sides * sides], sides, sides),
        flat=f.factor[rings:],
    )


@kernel
def _place(j: int, n_t: int) -> int:
    """Return the position of column j when the ring is folded: 0, n-1, 1, n-2, ..."""
    return 2 * j if 2 * j <= n_t - 1 else 2 * (n_t - 1 - j) + 1


@kernel
def _add(b: Blocks, band: int, n: int, row: int, col: int, value: float) -> None:
    """Add to one entry of the matrix; places from ``n`` on are rings."""
    if row < n and col < n:
        b.band[np.uintp(row * (2 * band + 1) + band + col - row)] += value
    elif row < n:
        group, side = (col - n) // N_SIDES, (col - n) % N_SIDES
        b.right[np.uintp((group * n + row) * N_SIDES + side)] += value
    elif col < n:
        b.below[np.uintp(col), np.uintp(row - n)] += value
    else:
        b.rings[np.uintp(row - n), np.uintp(col - n)] += value


@kernel
def _link(b: Blocks, band: int, n: int, one: int, two: int, g: float) -> None:
    """Add a conductance between two unknowns."""
    _add(b, band, n, one, one, g)
    _add(b, band, n, two, two, g)
    _add(b, band, n, one, two, -g)
    _add(b, band, n, two, one, -g)


@kernel
def _warmth(m: WasherModel, f: Fields, node: int, share: float) -> float:
    """Return what a flow out of a node carries per flow and rise of its film [J/(m^3 K)].

    ``share`` of the outlet's rise above the node counts. What the walls' temperatures change of it
    is left out.
    """
    k = np.uintp(node)
    twice = 2.0 * m.oil_storage * f.liquid[k] * f.leaving[k]
    less = -f.made[k] * f.dmu[k] * f.fluidity[k]  # of the heat made
    outlet = max(twice - less, 0.0) / (twice + f.exchange[k])
    return float(m.oil_storage * f.liquid[k] * (1.0 + share * (outlet - 1.0)))


@kernel
def _transport(m: WasherModel, f: Fields, b: Blocks) -> None:
    """Add what flowing oil carries."""
    n_r, n_t = m.n_r, m.n_t
    band, n = 2 * m.per_column, m.per_column * m.n_t
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        at, on = _place(j, n_t) * m.per_column, _place(jn, n_t) * m.per_column
        for i in range(n_r):
            k = j * n_r + i
            edge = _warmth(m, f, k, f.across[k])
            _add(b, band, n, at + i, at + i, f.rim[k] * edge)
            flow = f.flow_t[k]
            if flow > 0.0:
                flow *= _warmth(m, f, k, 1.0)
                _add(b, band, n, at + i, at + i, flow)
                _add(b, band, n, on + i, at + i, -flow)
            else:
                flow *= _warmth(m, f, jn * n_r + i, 1.0)
                _add(b, band, n, on + i, on + i, -flow)
                _add(b, band, n, at + i, on + i, flow)
            if i + 1 < n_r:
                flow = f.flow_r[k]
                if flow > 0.0:
                    flow *= edge
                    _add(b, band, n, at + i, at + i, flow)
                    _add(b, band, n, at + i + 1, at + i, -flow)
                else:
                    flow *= _warmth(m, f, k + 1, f.across[k + 1])
                    _add(b, band, n, at + i + 1, at + i + 1, -flow)
                    _add(b, band, n, at + i, at + i + 1, flow)


@kernel
def _assemble(m: WasherModel, pt: Point, f: Fields, b: Blocks) -> None:
    """Add the slopes of the heat residual over all temperatures."""
    n_r, n_t, i_g = m.n_r, m.n_t, m.i_g
    band, n = 2 * m.per_column, m.per_column * m.n_t
    kc = m.carrier_conductivity * m.carrier_thickness
    kw = m.washer_conductivity * m.washer_thickness
    kg = m.gear_conductivity * m.gear_thickness
    out_c, out_w = f.small[L.OUT_CARRIER], f.small[L.OUT_WASHER]
    out_g = f.small[L.OUT_GEAR]
    half = m.washer_thickness / (2.0 * m.washer_conductivity)
    per_oil = 1.0 / m.oil_conductivity
    omega = abs(pt.speed)
    cooled = m.film_step > 0
    split, heated = m.heat_split, f.small[L.GIVEN] * m.film_heat_fraction
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        here, on = _place(j, n_t) * m.per_column, _place(jn, n_t) * m.per_column
        film = here + m.film_at
        carrier, carrier_on = m.carrier_at, m.carrier_at
        if m.carrier_step > 0:
            carrier, carrier_on = here + m.carrier_at, on + m.carrier_at
        washer, washer_on, gear, gear_on = m.washer_at, m.washer_at, m.gear_at, m.gear_at
        if m.washer_step > 0:
            washer, washer_on = here + m.washer_at, on + m.washer_at
            gear, gear_on = here + m.gear_at, on + m.gear_at
        for i in range(n_r):
            k = j * n_r + i
            ic, iw = carrier + i, washer + i
            w1 = m.weight1[i] * m.weight_t[j]
            v = omega * m.r[i]
            part = 1.0
            if m.only_liquid:
                part = f.liquid[k]
            _link(b, band, n, ic, iw, w1 / (f.ht[k] * per_oil + half))
            _add(b, band, n, ic, ic, w1 * out_c)
            _add(b, band, n, iw, iw, w1 * out_w)
            s = -w1 * part * heated * f.dmu[k] * v * v / f.ht[k]
            if cooled:
                t = film + i
                e = w1 * part * m.film_exchange / f.ht[k]
                _add(b, band, n, t, t, s + e)
                _add(b, band, n, t, ic, -0.5 * e)
                _add(b, band, n, t, iw, -0.5 * e)
                _add(b, band, n, ic, t, -split * e)
                _add(b, band, n, iw, t, (split - 1.0) * e)
                s = e
            _add(b, band, n, ic, ic, 0.5 * split * s)
            _add(b, band, n, ic, iw, 0.5 * split * s)
            _add(b, band, n, iw, ic, 0.5 * (1.0 - split) * s)
            _add(b, band, n, iw, iw, 0.5 * (1.0 - split) * s)
            g = m.log_width[i] * m.per_step[j]
            if m.carrier_step > 0:
                _link(b, band, n, ic, carrier_on + i, kc * g)
            if m.washer_step > 0:
                _link(b, band, n, iw, washer_on + i, kw * g)
            along = 0.0
            if i + 1 < n_r:
                along = m.along[i] * m.width_t[j]
                _link(b, band, n, ic, ic + 1, kc * along)
                _link(b, band, n, iw, iw + 1, kw * along)
            if i >= i_g:
                ig = gear + i - i_g
                w2 = m.weight2[i] * m.weight_t[j]
                _link(b, band, n, iw, ig, w2 / (f.ht2[k] * per_oil + half))
                _add(b, band, n, ig, ig, w2 * out_g)
                if m.gear_step > 0:
                    g = kg * m.gear_width[i] * m.per_step[j]
                    _link(b, band, n, ig, gear_on + i - i_g, g)
                if i + 1 < n_r:
                    _link(b, band, n, ig, ig + 1, kg * along)


@kernel
def _keep_half(b: Blocks, n: int, band: int) -> None:
    """Write the lower half of the band by columns to ``b.lower``."""
    for j in range(n):
        for k in range(min(band, n - 1 - j) + 1):
            entry = b.band[np.uintp((j + k) * (2 * band + 1) + band - k)]
            b.lower[np.uintp(j * (band + 1) + k)] = entry


@kernel
def factor_heat(m: WasherModel, pt: Point, f: Fields) -> bool:
    """Assemble and factor the slope of the heat residual; return False if a pivot fails."""
    n, band, sides = m.per_column * m.n_t, 2 * m.per_column, padded(m.n_ring)
    size = n * (band + 1)
    clear(f.factor[: 2 * size])
    clear(f.factor[4 * size :])
    b = blocks_of(m, f)
    _assemble(m, pt, f, b)
    if m.film_step > 0:
        _transport(m, f, b)
    if m.film_step == 0 and m.heat_split == 0.5:  # symmetric
        _keep_half(b, n, band)
        if not cholesky(b.lower, n, band):
            return False
        mirror(b.lower, b.mirrored, n, band)
    else:
        if not lu(b.band, n, band):
            return False
        halve(b.band, b.lower, b.mirrored, n, band)
    if m.n_ring == 0:
        return True
    for group in range(sides // N_SIDES):
        first = group * n * N_SIDES
        columns = b.right[first : first + n * N_SIDES]
        factor_solve_many(b.lower, b.mirrored, columns, n, band)
        for k in range(n):
            row = b.below[np.uintp(k)]
            for c in range(m.n_ring):
                value = row[np.uintp(c)]
                if value != 0.0:
                    at = c * sides + group * N_SIDES
                    for s in range(N_SIDES):
                        x = columns[np.uintp(k * N_SIDES + s)]
                        b.flat[np.uintp(at + s)] -= value * x
    for c in range(m.n_ring, sides):
        b.rings[c, c] = 1.0
    return dense_factor(b.flat, sides)


@kernel
def solve_heat(m: WasherModel, rhs: Array, x: Array, f: Fields) -> None:
    """Solve the factored heat equations for ``rhs`` (n_temp,); the solution goes to ``x``."""
    n_t, column = m.n_t, m.per_column
    n, sides = column * n_t, padded(m.n_ring)
    b = blocks_of(m, f)
    z = f.spare
    for j in range(n_t):
        to, fro = _place(j, n_t) * column, j * column
        for k in range(column):
            z[np.uintp(to + k)] = rhs[np.uintp(fro + k)]
    factor_solve(b.lower, b.mirrored, z, n, 2 * column)
    if m.n_ring > 0:
        ring = f.rings
        clear(ring)
        for c in range(m.n_ring):
            ring[c] = rhs[n + c]
        for g in range(0, sides, N_SIDES):
            r0, r1, r2, r3 = ring[g], ring[g + 1], ring[g + 2], ring[g + 3]
            r4, r5, r6, r7 = ring[g + 4], ring[g + 5], ring[g + 6], ring[g + 7]
            for k in range(n):
                value, here = z[np.uintp(k)], np.uintp(k * sides + g)
                r0 -= b.under[here] * value
                r1 -= b.under[here + np.uintp(1)] * value
                r2 -= b.under[here + np.uintp(2)] * value
                r3 -= b.under[here + np.uintp(3)] * value
                r4 -= b.under[here + np.uintp(4)] * value
                r5 -= b.under[here + np.uintp(5)] * value
                r6 -= b.under[here + np.uintp(6)] * value
                r7 -= b.under[here + np.uintp(7)] * value
            ring[g], ring[g + 1], ring[g + 2], ring[g + 3] = r0, r1, r2, r3
            ring[g + 4], ring[g + 5], ring[g + 6], ring[g + 7] = r4, r5, r6, r7
        dense_substitute(b.flat, ring, sides)
        for group in range(sides // N_SIDES):
            first = group * n * N_SIDES
            g = group * N_SIDES
            r0, r1, r2, r3 = ring[g], ring[g + 1], ring[g + 2], ring[g + 3]
            r4, r5, r6, r7 = ring[g + 4], ring[g + 5], ring[g + 6], ring[g + 7]
            for k in range(n):
                at = first + k * N_SIDES
                z[np.uintp(k)] -= (
                    (b.right[np.uintp(at)] * r0 + b.right[np.uintp(at + 1)] * r1)
                    + (b.right[np.uintp(at + 2)] * r2 + b.right[np.uintp(at + 3)] * r3)
                ) + (
                    (b.right[np.uintp(at + 4)] * r4 + b.right[np.uintp(at + 5)] * r5)
                    + (b.right[np.uintp(at + 6)] * r6 + b.right[np.uintp(at + 7)] * r7)
                )
        for c in range(m.n_ring):
            x[n + c] = ring[c]
    for j in range(n_t):
        fro, to = _place(j, n_t) * column, j * column
        for k in range(column):
            x[np.uintp(to + k)] = z[np.uintp(fro + k)]
