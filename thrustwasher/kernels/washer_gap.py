"""Film 1 and gap 2 at the nodes: gaps, contact pressures, viscosity, and what they balance.

symbol | meaning                                   | unit
q      | z_w, z_g (heights), gx, gy (washer tilts) | m, m, rad, rad
h1     | z_w + y gx - x gy                         | m
h2     | z_g - z_w - x (tilt - gy) - y gx          | m
dh1/dq | 1, 0, y, -x        dh2/dq: -1, 1, -y, x
"""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .asperities import contact_pressure
from .flow_factors import mean_gap
from .viscosity import viscosity
from .washer_fields import Fields, Point
from .washer_model import Plates, WasherModel

# places in Fields.small
FORCE = 0  # (4,) contact forces conjugate to q
STIFF = 4  # (16,) their slopes
CONTACT = 20  # contact force of film 1 [N]
DCONTACT = 21  # (4,) its slope over q
FLOAT = 1e-9  # [N] lifts the washer off the carrier: gap 2 never loses touch, and its stiffness
FRICTION = 25  # dry friction coefficient and its slope over the contact force [1/N]
TANGENT_READY = 27  # 1 if washer_tangent has been through since the last evaluation


@kernel
def dry_friction(m: WasherModel | Plates, contact_load: float) -> tuple[float, float]:
    """Return the dry friction coefficient and its slope over the contact force [1/N].

    Source: Jackson & Green Eq 18 with the total contact force, f = a - b ln F, held constant
    outside the range of the loads it was measured for; never negative.
    """
    if m.constant_friction:
        return m.dry_friction, 0.0
    lo, hi = m.friction_load_min, m.friction_load_max
    f = min(max(contact_load, lo), hi)
    value = m.friction_constant - m.friction_slope * math.log(f)
    if value <= 0.0:
        return 0.0, 0.0
    return value, -m.friction_slope / f if lo < contact_load < hi else 0.0


@kernel
def evaluate_gaps(m: WasherModel, pt: Point, q: NDArray[np.float64], f: Fields) -> None:
    """Fill gaps, contact pressures and their sums in ``f`` at the positions ``q``."""
    s = f.small
    for place in range(TANGENT_READY + 1):
        s[place] = 0.0
    z_w, z_g, gx, gy = q[0], q[1], q[2], q[3]
    for j in range(m.n_t):
        cj, sj = m.cos[j], m.sin[j]
        for i in range(m.n_r):
            k = np.uintp(j * m.n_r + i)
            x, y = m.r[i] * cj, m.r[i] * sj
            h = z_w + y * gx - x * gy
            f.ht[k], f.dht[k] = mean_gap(h, m.sigma1)
            p, dp = contact_pressure((h - m.mean_summit1) / m.summit_sigma1, m.table1)
            dp /= m.summit_sigma1
            f.pc[k], f.dpc[k] = p, dp
            if p > 0.0:
                w = m.weight1[i] * m.weight_t[j]
                wp, wd = w * p, w * dp
                s[FORCE] += wp
                s[FORCE + 2] += wp * y
                s[FORCE + 3] -= wp * x
                s[STIFF] += wd
                s[STIFF + 2] += wd * y
                s[STIFF + 3] -= wd * x
                s[STIFF + 10] += wd * y * y
                s[STIFF + 11] -= wd * x * y
                s[STIFF + 15] += wd * x * x
    s[CONTACT] = s[FORCE]
    s[DCONTACT], s[DCONTACT + 1] = s[STIFF], 0.0
    s[DCONTACT + 2], s[DCONTACT + 3] = s[STIFF + 2], s[STIFF + 3]
    s[FRICTION], s[FRICTION + 1] = dry_friction(m, s[CONTACT])
    s[FORCE] += FLOAT
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
                s[FORCE] -= wp
                s[FORCE + 1] += wp
                s[FORCE + 2] -= wp * y
                s[FORCE + 3] += wp * x
                s[STIFF] += wd
                s[STIFF + 1] -= wd
                s[STIFF + 2] += wd * y
                s[STIFF + 3] -= wd * x
                s[STIFF + 5] += wd
                s[STIFF + 6] -= wd * y
                s[STIFF + 7] += wd * x
                s[STIFF + 10] += wd * y * y
                s[STIFF + 11] -= wd * x * y
                s[STIFF + 15] += wd * x * x
    for a in range(4):
        for b in range(a):
            s[STIFF + 4 * a + b] = s[STIFF + 4 * b + a]


@kernel
def evaluate_viscosity(m: WasherModel, pt: Point, f: Fields) -> None:
    """Fill viscosity and slope at the film temperature, the mean of carrier and washer."""
    m_t = 3 * m.n_r - m.i_g
    for j in range(m.n_t):
        for i in range(m.n_r):
            k = np.uintp(j * m.n_r + i)
            a = j * m_t + i
            rise = 0.5 * (f.temp[np.uintp(a)] + f.temp[np.uintp(a + m.n_r)])
            f.mu[k], f.dmu[k] = viscosity(
                pt.oil_temperature + rise,
                m.viscosity_scale,
                m.viscosity_constant,
                m.viscosity_exponent,
            )
            f.fluidity[k] = 1.0 / f.mu[k]
