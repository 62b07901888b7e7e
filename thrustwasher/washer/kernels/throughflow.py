"""Oil that flows through film 1: where it goes, where the gap holds liquid, what heat it carries.

Film 1 is full of liquid where the gap closes in the direction of motion; where it opens, the
liquid that enters a cell leaves it (continuity), so that the cavity is filled in part. Missing oil
is drawn in at the supply temperature; what a rim cell gains flows out over the rim.

Oil leaves a cell for the next one warmer than it is in its middle by T_out - T_f = (heat made -
heat given to the walls)/(2 G + E), G heat capacity of what leaves [W/K], E conductance to the
walls. Along a stream this is of second order, and damps as 1/(1 + z + z^2/2), z = E/G: no
undershoot where walls or oil drawn in cool the film at once. What leaves to the side of a stream
leaves on average from its middle: in radial direction the difference counts by the square of the
flow's share.
"""

import math

import numpy as np

from ...numerics.arrays import clear
from ...numerics.jit import Array, kernel
from . import layout as L
from .constants import WasherModel
from .layout import TILT_X, TILT_Y
from .workspace import Fields, Point

SWEEPS = 40  # of the liquid fraction, at most; two are usual
STILL = 1e-13  # its change by which a sweep ends


@kernel
def supply_rise(m: WasherModel, pt: Point) -> float:
    """Return how much warmer than the oil around the washer the oil drawn in is [K]."""
    supply = m.par[L.P_OIL_SUPPLY_TEMPERATURE]
    return float(supply - pt.oil_temperature) if supply > 0.0 else 0.0


@kernel
def _share(angle: float, width: float) -> tuple[float, float]:
    """Return how far a cell is flooded at an angle behind the widest gap, and the slope."""
    if angle > 0.5 * math.pi:
        at, side = (math.pi - angle) / width, -1.0
    elif angle < -0.5 * math.pi:
        at, side = (-math.pi - angle) / width, -1.0
    else:
        at, side = angle / width, 1.0
    if at <= -0.5:
        return 0.0, 0.0
    if at >= 0.5:
        return 1.0, 0.0
    return 0.5 + at, side / width


@kernel
def flooded(m: WasherModel, pt: Point, q: Array, j: int) -> tuple[float, float]:
    """Return the share of column j that is flooded, and its slope over the widest gap's angle.

    The gap z + y gx - x gy is widest at atan2(gx, -gy); it closes behind it, as the washer turns.
    """
    gx, gy = q[TILT_X], q[TILT_Y]
    if gx == 0.0 and gy == 0.0:
        return 1.0, 0.0
    side = -1.0 if pt.speed < 0.0 else 1.0
    across = -gy * m.sin[j] - gx * m.cos[j]
    if across * across > 0.25 * m.width_t[j] * m.width_t[j] * (gx * gx + gy * gy):  # no ramp
        return (1.0, 0.0) if side * across > 0.0 else (0.0, 0.0)
    angle = math.atan2(across, -gy * m.cos[j] + gx * m.sin[j])
    share, slope = _share(side * angle, m.width_t[j])
    return share, -side * slope


@kernel
def _leave(m: WasherModel, f: Fields) -> None:
    """Fill what leaves each node, and what leaves over the rims."""
    n_r, n_t = m.n_r, m.n_t
    for j in range(n_t):
        jb = j - 1 if j > 0 else n_t - 1
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            on, back = f.flow_t[k], f.flow_t[np.uintp(jb * n_r + i)]
            up = f.flow_r[k]
            down = f.flow_r[np.uintp(j * n_r + i - 1)] if i > 0 else 0.0
            f.rim[k] = 0.0
            if i == 0 or i == n_r - 1:
                f.rim[k] = max(back - on + down - up, 0.0)
            along = max(on, 0.0) + max(-back, 0.0)
            across = max(up, 0.0) + max(-down, 0.0) + f.rim[k]
            f.leaving[k] = along + across
            f.across[k] = 0.0
            if across > 0.0:
                s, t = across / f.leaving[k], along / f.leaving[k]
                f.across[k] = s * s / (s * s + t * t)


@kernel
def find_flows(m: WasherModel, pt: Point, q: Array, f: Fields) -> float:
    """Fill the flows through all faces, what leaves the nodes and the share of liquid.

    Returns how far that share is from standing still, 0 if it does.
    """
    n_r, n_t = m.n_r, m.n_t
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        for i in range(n_r):
            k, o = np.uintp(j * n_r + i), np.uintp(jn * n_r + i)
            drop = f.p[k] - f.p[o]
            f.flow_t[k] = f.wedge[k] + f.ct[k] * (f.fluidity[k] + f.fluidity[o]) * drop
            f.flow_r[k] = 0.0
            if i + 1 < n_r:
                o = k + np.uintp(1)
                f.flow_r[k] = f.cr[k] * (f.fluidity[k] + f.fluidity[o]) * (f.p[k] - f.p[o])
    _leave(m, f)
    return float(_fill(m, pt, q, f))


@kernel
def _first(m: WasherModel, q: Array) -> int:
    """Return the column nearest to the widest gap: sweeps begin there."""
    best, first = -math.inf, 0
    for j in range(m.n_t):
        gap = q[TILT_X] * m.sin[j] - q[TILT_Y] * m.cos[j]
        if gap > best:
            best, first = gap, j
    return first


@kernel
def _fill(m: WasherModel, pt: Point, q: Array, f: Fields) -> float:
    """Fill the share of liquid by continuity, sweeping with the motion from the widest gap.

    Returns 0 when it stands still, else by how much the last sweep has moved it.
    """
    n_r, n_t = m.n_r, m.n_t
    for node in range(n_r * n_t):
        f.liquid[np.uintp(node)] = 1.0
    first = _first(m, q)
    moved = 0.0
    for _ in range(SWEEPS):
        moved = 0.0
        for step in range(n_t):
            j = (first - step if pt.speed < 0.0 else first + step) % n_t
            jn = j + 1 if j + 1 < n_t else 0
            jb = j - 1 if j > 0 else n_t - 1
            share, _slope = flooded(m, pt, q, j)
            if share == 1.0:
                continue
            for i in range(n_r):
                k = np.uintp(j * n_r + i)
                if not f.leaving[k] > 0.0:
                    continue
                kb = np.uintp(jb * n_r + i)
                enters = max(f.flow_t[kb], 0.0) * f.liquid[kb]
                enters += max(-f.flow_t[k], 0.0) * f.liquid[np.uintp(jn * n_r + i)]
                if i + 1 < n_r:
                    enters += max(-f.flow_r[k], 0.0) * f.liquid[k + np.uintp(1)]
                if i > 0:
                    below = k - np.uintp(1)
                    enters += max(f.flow_r[below], 0.0) * f.liquid[below]
                liquid = (1.0 - share) * enters / f.leaving[k] + share
                moved = max(moved, abs(liquid - f.liquid[k]))
                f.liquid[k] = liquid
        if moved < STILL:
            return 0.0
    return moved


@kernel
def flows_change(m: WasherModel, pt: Point, q: Array, dq: Array, f: Fields) -> None:
    """Fill the changes of what leaves the nodes and of the liquid, given those of the flows."""
    n_r, n_t = m.n_r, m.n_t
    for j in range(n_t):
        jb = j - 1 if j > 0 else n_t - 1
        for i in range(n_r):
            k, kb = np.uintp(j * n_r + i), np.uintp(jb * n_r + i)
            on, back, up = f.flow_t[k], f.flow_t[kb], f.flow_r[k]
            d_on, d_back, d_up = f.dflow_t[k], f.dflow_t[kb], f.dflow_r[k]
            down, d_down = 0.0, 0.0
            if i > 0:
                down, d_down = f.flow_r[k - np.uintp(1)], f.dflow_r[k - np.uintp(1)]
            along, across, dalong, dacross = 0.0, f.rim[k], 0.0, 0.0
            if on > 0.0:
                along += on
                dalong += d_on
            if back < 0.0:
                along -= back
                dalong -= d_back
            f.drim[k] = 0.0
            if f.rim[k] > 0.0:
                f.drim[k] = d_back - d_on + d_down - d_up
                dacross = f.drim[k]
            if up > 0.0:
                across += up
                dacross += d_up
            if down < 0.0:
                across -= down
                dacross -= d_down
            f.dleaving[k] = dalong + dacross
            f.dacross[k] = 0.0
            if across > 0.0:
                s, t = across / f.leaving[k], along / f.leaving[k]
                whole = s * s + t * t
                turned = (dacross * t - dalong * s) / (whole * f.leaving[k])
                f.dacross[k] = 2.0 * s * t / whole * turned
    _filling_change(m, pt, q, dq, f)


@kernel
def _filling_change(m: WasherModel, pt: Point, q: Array, dq: Array, f: Fields) -> None:
    """Fill the change of the liquid."""
    n_r, n_t = m.n_r, m.n_t
    clear(f.dliquid)
    gx, gy = q[TILT_X], q[TILT_Y]
    square = gx * gx + gy * gy
    turn = 0.0  # of the widest gap
    if square > 0.0:
        turn = (gx * dq[TILT_Y] - gy * dq[TILT_X]) / square
    first = _first(m, q)
    for _ in range(SWEEPS):
        moved, largest = 0.0, 0.0
        for step in range(n_t):
            j = (first - step if pt.speed < 0.0 else first + step) % n_t
            jn = j + 1 if j + 1 < n_t else 0
            jb = j - 1 if j > 0 else n_t - 1
            share, slope = flooded(m, pt, q, j)
            if share == 1.0:
                continue
            for i in range(n_r):
                k = np.uintp(j * n_r + i)
                if not f.leaving[k] > 0.0:
                    continue
                enters, change = 0.0, 0.0
                kb = np.uintp(jb * n_r + i)
                if f.flow_t[kb] > 0.0:
                    enters += f.flow_t[kb] * f.liquid[kb]
                    change += f.dflow_t[kb] * f.liquid[kb] + f.flow_t[kb] * f.dliquid[kb]
                if f.flow_t[k] < 0.0:
                    kn = np.uintp(jn * n_r + i)
                    enters -= f.flow_t[k] * f.liquid[kn]
                    change -= f.dflow_t[k] * f.liquid[kn] + f.flow_t[k] * f.dliquid[kn]
                if i + 1 < n_r and f.flow_r[k] < 0.0:
                    up = k + np.uintp(1)
                    enters -= f.flow_r[k] * f.liquid[up]
                    change -= f.dflow_r[k] * f.liquid[up] + f.flow_r[k] * f.dliquid[up]
                if i > 0 and f.flow_r[k - np.uintp(1)] > 0.0:
                    down = k - np.uintp(1)
                    enters += f.flow_r[down] * f.liquid[down]
                    change += f.dflow_r[down] * f.liquid[down] + f.flow_r[down] * f.dliquid[down]
                full = enters / f.leaving[k]
                value = (1.0 - share) * (change - full * f.dleaving[k]) / f.leaving[k]
                value += slope * turn * (1.0 - full)
                moved = max(moved, abs(value - f.dliquid[k]))
                largest = max(largest, abs(value))
                f.dliquid[k] = value
        if moved <= STILL * largest:
            return


@kernel
def carry(m: WasherModel, f: Fields, heat: Array) -> None:
    """Add to ``heat`` [W] what flowing oil takes out of each node, less what it takes in."""
    n_r, n_t = m.n_r, m.n_t
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        at, on = m.film_at + j * m.film_step, m.film_at + jn * m.film_step
        for i in range(n_r):
            k, kn = np.uintp(j * n_r + i), np.uintp(jn * n_r + i)
            t = np.uintp(at + i)
            over = m.oil_storage * f.rim[k] * f.liquid[k] * f.edge[k]
            heat[t] += over
            flow = m.oil_storage * f.flow_t[k]
            a = k if flow > 0.0 else kn
            carried = flow * f.liquid[a] * f.outlet[a]
            heat[t] += carried
            heat[np.uintp(on + i)] -= carried
            if i + 1 < n_r:
                flow, up = f.flow_r[k], k + np.uintp(1)
                a = k if flow > 0.0 else up
                carried = m.oil_storage * flow * f.liquid[a] * f.edge[a]
                heat[t] += carried
                heat[t + np.uintp(1)] -= carried


@kernel
def carry_change(m: WasherModel, f: Fields, heat: Array) -> float:
    """Add to ``heat`` the change of what `carry` adds; return that of what leaves at rims [W]."""
    n_r, n_t = m.n_r, m.n_t
    gone = 0.0
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        at, on = m.film_at + j * m.film_step, m.film_at + jn * m.film_step
        for i in range(n_r):
            k, kn = np.uintp(j * n_r + i), np.uintp(jn * n_r + i)
            t = np.uintp(at + i)
            dout = f.dliquid[k] * f.edge[k] + f.liquid[k] * f.dedge[k]
            over = f.drim[k] * f.liquid[k] * f.edge[k] + f.rim[k] * dout
            over *= m.oil_storage
            gone += over
            a = k if f.flow_t[k] > 0.0 else kn
            dout = f.dliquid[a] * f.outlet[a] + f.liquid[a] * f.doutlet[a]
            carried = f.dflow_t[k] * f.liquid[a] * f.outlet[a] + f.flow_t[k] * dout
            carried *= m.oil_storage
            heat[t] += over + carried
            heat[np.uintp(on + i)] -= carried
            if i + 1 < n_r:
                a = k if f.flow_r[k] > 0.0 else k + np.uintp(1)
                dout = f.dliquid[a] * f.edge[a] + f.liquid[a] * f.dedge[a]
                carried = f.dflow_r[k] * f.liquid[a] * f.edge[a] + f.flow_r[k] * dout
                carried *= m.oil_storage
                heat[t] += carried
                heat[t + np.uintp(1)] -= carried
    return gone
