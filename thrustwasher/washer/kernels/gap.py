"""Film 1 and gap 2 at the nodes: gaps, contact pressures, viscosity, and what they balance.

symbol | meaning                                   | unit
q      | z_w, z_g (heights), gx, gy (washer tilts) | m, m, rad, rad
h1     | z_w + y gx - x gy                         | m
h2     | z_g - z_w - x (tilt - gy) - y gx          | m
dh1/dq | 1, 0, y, -x        dh2/dq: -1, 1, -y, x
"""

import math

import numpy as np

from ...numerics.arrays import clear
from ...numerics.jit import Array, kernel
from ...tribology.asperities import D_MAX, contact_pressure
from ...tribology.flow_factors import mean_gap
from ...tribology.viscosity import viscosity
from . import layout as L
from .constants import WasherModel
from .layout import MOMENT_X, MOMENT_Y, ON_GEAR, ON_WASHER, TILT_X, TILT_Y, Z_GEAR, Z_WASHER
from .workspace import Fields, Point, square, vector

REFERENCE_PRESSURE = 1e6  # [Pa] of the dry friction law
HALF = 0.3872983346207417  # sqrt(0.15): outer of three Gauss points from the middle of 0 .. 1
FLOAT = 1e-9  # [N] lifts the washer off the carrier: gap 2 never loses touch, and its stiffness


@kernel
def face_area(par: Array) -> float:
    """Return the area of the washer's face [m^2], to which mean contact pressures refer."""
    inner, outer = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS]
    return float(math.pi * (outer * outer - inner * inner))


@kernel
def dry_friction(par: Array, contact_load: float) -> tuple[float, float]:
    """Return the dry friction coefficient and its slope over the contact force [1/N].

    Source: Jackson & Green Eq 18 with the total contact force over the washer's face, f = a - b ln
    p, held constant outside the range of the pressures it was measured for; never negative.
    """
    if par[L.P_FRICTION_LAW] == L.CONSTANT_FRICTION:
        return par[L.P_DRY_FRICTION], 0.0
    face = face_area(par)
    lo, hi = par[L.P_FRICTION_PRESSURE_MIN] * face, par[L.P_FRICTION_PRESSURE_MAX] * face
    f = min(max(contact_load, lo), hi)
    slope = par[L.P_FRICTION_SLOPE]
    value = par[L.P_FRICTION_REFERENCE] - slope * math.log(f / (REFERENCE_PRESSURE * face))
    if value <= 0.0:
        return 0.0, 0.0
    return value, -slope / f if lo < contact_load < hi else 0.0


@kernel
def oil_viscosity(par: Array, temperature: float) -> tuple[float, float]:
    """Return the oil's viscosity [Pa s] and its slope [Pa s/K] at a temperature [K]."""
    constant, exponent = par[L.P_VISCOSITY_CONSTANT], par[L.P_VISCOSITY_EXPONENT]
    return viscosity(temperature, par[L.P_VISCOSITY_SCALE], constant, exponent)


@kernel
def _touch(m: WasherModel, z_w: float, slope: float, j: int, f: Fields) -> None:
    """Fill the contact pressures of film 1 in column ``j``, whose gap is z_w + r slope.

    The pressure falls by orders of magnitude between two nodes. It is integrated there and goes to
    both by the lever rule, so that force and moments are those of the integral; each node's part
    over its weight is what stands there.
    """
    n_r, scale, lift = m.n_r, 1.0 / m.summit_sigma1, m.mean_summit1
    first = j * n_r
    for i in range(n_r):
        k = np.uintp(first + i)
        f.pc[k], f.dpc[k], f.arm_pc[k] = 0.0, 0.0, 0.0
    for i in range(n_r - 1):
        r0, r1 = m.r[i], m.r[i + 1]
        nearest = (z_w + min(r0 * slope, r1 * slope) - lift) * scale
        if nearest >= D_MAX:
            continue
        k, up = np.uintp(first + i), np.uintp(first + i + 1)
        for part in range(3):
            x = 0.5 + HALF * (part - 1.0)
            r = r0 + (r1 - r0) * x
            p, dp = contact_pressure((z_w + r * slope - lift) * scale, m.table1)
            area = (r1 - r0) * r * (4.0 if part == 1 else 2.5) / 9.0
            p, dp = area * p, area * dp * scale
            f.pc[k] += (1.0 - x) * p
            f.pc[up] += x * p
            f.dpc[k] += (1.0 - x) * dp
            f.dpc[up] += x * dp
            f.arm_pc[k] += (1.0 - x) * dp * r
            f.arm_pc[up] += x * dp * r
    for i in range(n_r):
        k = np.uintp(first + i)
        f.arm_pc[k] = f.arm_pc[k] / f.dpc[k] if f.dpc[k] != 0.0 else m.r[i]
        f.pc[k] /= m.weight1[i]
        f.dpc[k] /= m.weight1[i]


@kernel
def evaluate_gaps(m: WasherModel, pt: Point, q: Array, f: Fields) -> None:
    """Fill gaps, contact pressures and their sums in ``f`` at the positions ``q``."""
    s = f.small
    clear(s[: L.FRICTION2 + 1])
    forces, slopes = vector(s, L.FORCES), square(s, L.STIFFNESS)
    z_w, z_g, gx, gy = q[Z_WASHER], q[Z_GEAR], q[TILT_X], q[TILT_Y]
    for j in range(m.n_t):
        cj, sj = m.cos[j], m.sin[j]
        slope = sj * gx - cj * gy
        _touch(m, z_w, slope, j, f)
        for i in range(m.n_r):
            k = np.uintp(j * m.n_r + i)
            f.ht[k], f.dht[k] = mean_gap(z_w + m.r[i] * slope, m.sigma1)
            if f.pc[k] > 0.0:
                x, y = m.r[i] * cj, m.r[i] * sj
                w = m.weight1[i] * m.weight_t[j]
                wp, wd = w * f.pc[k], w * f.dpc[k]
                over_x, over_y = wd * f.arm_pc[k] * sj, wd * f.arm_pc[k] * cj
                forces[ON_WASHER] += wp
                forces[MOMENT_X] += wp * y
                forces[MOMENT_Y] -= wp * x
                slopes[ON_WASHER, Z_WASHER] += wd
                slopes[ON_WASHER, TILT_X] += over_x
                slopes[ON_WASHER, TILT_Y] -= over_y
                slopes[MOMENT_X, TILT_X] += over_x * y
                slopes[MOMENT_X, TILT_Y] -= over_y * y
                slopes[MOMENT_Y, TILT_Y] += over_y * x
    s[L.CONTACT] = forces[ON_WASHER]
    over = vector(s, L.CONTACT_SLOPES)
    for c in range(4):
        over[c] = slopes[ON_WASHER, c]
    s[L.FRICTION], s[L.FRICTION_SLOPE] = dry_friction(m.par, s[L.CONTACT])
    forces[ON_WASHER] += FLOAT
    rel = pt.tilt - gy
    for j in range(m.n_t):
        cj, sj = m.cos[j], m.sin[j]
        for i in range(m.i_g, m.n_r):
            k = np.uintp(j * m.n_r + i)
            x, y = m.r[i] * cj, m.r[i] * sj
            h = z_g - z_w - x * rel - y * gx
            f.ht2[k], f.dht2[k] = mean_gap(h, m.sigma2)
            p, dp = contact_pressure((h - m.mean_summit2) / m.summit_sigma2, m.table2)
            dp /= m.summit_sigma2
            f.pc2[k], f.dpc2[k] = p, dp
            if p > 0.0:
                w = m.weight2[i] * m.weight_t[j]
                wp, wd = w * p, w * dp
                forces[ON_WASHER] -= wp
                forces[ON_GEAR] += wp
                forces[MOMENT_X] -= wp * y
                forces[MOMENT_Y] += wp * x
                slopes[ON_WASHER, Z_WASHER] += wd
                slopes[ON_WASHER, Z_GEAR] -= wd
                slopes[ON_WASHER, TILT_X] += wd * y
                slopes[ON_WASHER, TILT_Y] -= wd * x
                slopes[ON_GEAR, Z_GEAR] += wd
                slopes[ON_GEAR, TILT_X] -= wd * y
                slopes[ON_GEAR, TILT_Y] += wd * x
                slopes[MOMENT_X, TILT_X] += wd * y * y
                slopes[MOMENT_X, TILT_Y] -= wd * x * y
                slopes[MOMENT_Y, TILT_Y] += wd * x * x
    s[L.FRICTION2], _ = dry_friction(m.par, forces[ON_GEAR])
    for a in range(4):
        for b in range(a):
            slopes[a, b] = slopes[b, a]


@kernel
def evaluate_viscosity(m: WasherModel, pt: Point, f: Fields) -> None:
    """Fill viscosity and slope at the film's own temperature, else the mean of both walls."""
    own = m.film_step > 0
    for j in range(m.n_t):
        film = m.film_at + j * m.film_step
        carrier = m.carrier_at + j * m.carrier_step
        washer = m.washer_at + j * m.washer_step
        for i in range(m.n_r):
            k = np.uintp(j * m.n_r + i)
            if own:
                rise = f.temp[np.uintp(film + i)]
            else:
                rise = 0.5 * (f.temp[np.uintp(carrier + i)] + f.temp[np.uintp(washer + i)])
            f.mu[k], f.dmu[k] = oil_viscosity(m.par, pt.oil_temperature + rise)
            f.fluidity[k] = 1.0 / f.mu[k]


@kernel
def film_change(m: WasherModel, dtemp: Array, j: int, i: int) -> float:
    """Return how the film's temperature changes at a node when the temperatures change."""
    if m.film_step > 0:
        return float(dtemp[np.uintp(m.film_at + j * m.film_step + i)])
    carrier = dtemp[np.uintp(m.carrier_at + j * m.carrier_step + i)]
    washer = dtemp[np.uintp(m.washer_at + j * m.washer_step + i)]
    return float(0.5 * (carrier + washer))
