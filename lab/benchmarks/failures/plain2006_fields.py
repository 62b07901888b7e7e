"""Settings and mesh of the method of 2006, its pressures, and temperatures of the three bodies.

Both fields are found by Gauss-Seidel sweeps, over-relaxed.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from thrustwasher.tribology.asperities import contact_pressure
from thrustwasher.tribology.flow_factors import flow_conductance, mean_gap, shear_flow
from thrustwasher.washer.kernels.constants import WasherModel
from thrustwasher.washer.kernels.gap import dry_friction
from thrustwasher.washer.kernels.layout import P_GEAR_INNER_RADIUS

from .compiled import rival

Array = NDArray[np.float64]
MOST_SWEEPS = 20000  # of temperature


class Settings(NamedTuple):
    """How the method is run."""

    relaxation: float  # over-relaxation of the pressure
    heat_relaxation: float  # of the temperatures
    tolerance: float  # of every loop, relative
    difference: float  # of the derivatives [sigma]
    share: float  # of a temperature step that is taken
    most_rounds: int
    limit: float  # of Newton's steps: 1 for that said in `balance`, large for none


class Mesh(NamedTuple):
    """A uniform polar mesh; nodes (n_t, n_r), cells around them."""

    r: Array  # (n_r,) [m]
    area: Array  # (n_r,) of a cell [m2]
    gear_area: Array  # (n_r,) of its part below the gear [m2]
    cos: Array  # (n_t,)
    sin: Array
    i_g: int  # radial node on the gear's inner radius
    d_theta: float


@rival
def make_mesh(m: WasherModel, n_r: int, n_t: int) -> Mesh:
    """Return the mesh: equal intervals inside and outside the gear's inner radius."""
    gear = m.par[P_GEAR_INNER_RADIUS]
    share = (gear - m.inner_radius) / (m.outer_radius - m.inner_radius)
    i_g = min(max(1, int(share * (n_r - 1) + 0.5)), n_r - 2)
    r, area, gear_area = np.empty(n_r), np.empty(n_r), np.zeros(n_r)
    for i in range(n_r):
        if i <= i_g:
            r[i] = m.inner_radius + (gear - m.inner_radius) * i / i_g
        else:
            s = (i - i_g) / (n_r - 1 - i_g)
            r[i] = gear + (m.outer_radius - gear) * s
    d_theta = 2.0 * math.pi / n_t
    for i in range(n_r):
        a = 0.5 * (r[i] + r[i - 1]) if i > 0 else r[0]
        b = 0.5 * (r[i] + r[i + 1]) if i < n_r - 1 else r[n_r - 1]
        area[i] = 0.5 * (b * b - a * a) * d_theta
        if i >= i_g:
            a = r[i] if i == i_g else a
            gear_area[i] = 0.5 * (b * b - a * a) * d_theta
    cos, sin = np.empty(n_t), np.empty(n_t)
    for j in range(n_t):
        cos[j], sin[j] = math.cos(j * d_theta), math.sin(j * d_theta)
    return Mesh(r, area, gear_area, cos, sin, i_g, d_theta)


@rival
def gap_at(g: Mesh, q: Array, j: int, i: int) -> float:
    """Return the gap of film 1 [m] at a node."""
    return float(q[0] + g.r[i] * (g.sin[j] * q[2] - g.cos[j] * q[3]))


@rival
def conductances(
    m: WasherModel,
    g: Mesh,
    q: Array,
    speed: float,
    mu: Array,
    east: Array,
    north: Array,
    source: Array,
) -> None:
    """Fill the flow conductances to the next angle and radius, and what drives the flow."""
    n_t, n_r = mu.shape
    source[:, 1 : n_r - 1] = 0.0
    for j in range(n_t):
        jn = (j + 1) % n_t
        for i in range(n_r):
            h0, h1 = gap_at(g, q, j, i), gap_at(g, q, jn, i)
            h = 0.5 * (h0 + h1)
            flow, _ = flow_conductance(h, m.sigma1)
            if 0 < i < n_r - 1:
                dr = 0.5 * (g.r[i + 1] - g.r[i - 1])
                east[j, i] = flow * dr / (g.r[i] * g.d_theta) / (6.0 * (mu[j, i] + mu[jn, i]))
                mean, _ = mean_gap(h, m.sigma1)
                if m.shear != 0.0:
                    phi, _ = shear_flow(h, m.sigma1)
                    mean -= m.sigma1 * m.shear * phi
                through = 0.5 * speed * g.r[i] * dr * mean
                source[j, i] -= through
                source[jn, i] += through
            if i < n_r - 1:
                h = 0.5 * (h0 + gap_at(g, q, j, i + 1))
                flow, _ = flow_conductance(h, m.sigma1)
                north[j, i] = (
                    flow
                    * 0.5
                    * (g.r[i] + g.r[i + 1])
                    * g.d_theta
                    / (g.r[i + 1] - g.r[i])
                    / (6.0 * (mu[j, i] + mu[j, i + 1]))
                )


@rival
def relax_pressure(
    east: Array, north: Array, source: Array, p: Array, s: Settings, most: int
) -> int:
    """Gauss-Seidel with over-relaxation and p >= 0; return the sweeps made.

    The stop test is the paper's kind: the change of a sweep against the sum of pressures.
    """
    n_t, n_r = p.shape
    for sweep in range(most):
        change, total = 0.0, 0.0
        for j in range(n_t):
            jb, jn = (j - 1) % n_t, (j + 1) % n_t
            for i in range(1, n_r - 1):
                a, b = east[j, i], east[jb, i]
                c, d = north[j, i], north[j, i - 1]
                value = (
                    a * p[jn, i] + b * p[jb, i] + c * p[j, i + 1] + d * p[j, i - 1] + source[j, i]
                ) / (a + b + c + d)
                value = max(p[j, i] + s.relaxation * (value - p[j, i]), 0.0)
                change += abs(value - p[j, i])
                total += value
                p[j, i] = value
        if change <= s.tolerance * total:
            return sweep + 1
    return most


@rival
def _across(
    m: WasherModel,
    g: Mesh,
    q: Array,
    speed: float,
    tilt: float,
    mu: Array,
    contact: float,
    made: Array,
    across: Array,
) -> None:
    """Fill heat made in the film [W] and the conductances across both gaps (2, n_t, n_r) [W/K]."""
    n_t, n_r = mu.shape
    friction, _ = dry_friction(m.par, contact)
    half = m.washer_thickness / (2.0 * m.washer_conductivity)
    for j in range(n_t):
        for i in range(n_r):
            h = gap_at(g, q, j, i)
            mean, _ = mean_gap(h, m.sigma1)
            pc, _ = contact_pressure((h - m.mean_summit1) / m.summit_sigma1, m.table1)
            v = abs(speed) * g.r[i]
            film = m.film_heat_fraction * mu[j, i] * v * v / mean
            made[j, i] = g.area[i] * (film + friction * pc * v)
            across[0, j, i] = g.area[i] / (mean / m.oil_conductivity + half)
            if i >= g.i_g:
                x, y = g.r[i] * g.cos[j], g.r[i] * g.sin[j]
                h = q[1] - q[0] - x * (tilt - q[3]) - y * q[2]
                mean, _ = mean_gap(h, m.sigma2)
                across[1, j, i] = g.gear_area[i] / (mean / m.oil_conductivity + half)


@rival
def _plate(
    m: WasherModel, g: Mesh, body: int, thick: float, along: Array, outwards: Array, far: Array
) -> int:
    """Fill the conductances of a body in its plane and to the far side; return its first node."""
    n_r = g.r.size
    first = g.i_g if body == 2 else 0
    conductivity = (m.carrier_conductivity, m.washer_conductivity, m.gear_conductivity)[body]
    plate = conductivity * thick
    for i in range(first, n_r):
        a = g.r[i] if i == first else 0.5 * (g.r[i] + g.r[i - 1])
        b = g.r[i] if i == n_r - 1 else 0.5 * (g.r[i] + g.r[i + 1])
        along[i] = plate * (b - a) / (g.r[i] * g.d_theta)
        outwards[i] = 0.0 if i == n_r - 1 else plate * b * g.d_theta / (g.r[i + 1] - g.r[i])
        far[i] = 0.0 if body == 1 else conductivity / thick * 0.5 * (b * b - a * a) * g.d_theta
    return first


@rival
def _sweep(
    m: WasherModel,
    body: int,
    first: int,
    along: Array,
    outwards: Array,
    far: Array,
    made: Array,
    across: Array,
    rise: Array,
    relaxation: float,
) -> tuple[float, float]:
    """Relax one body once; return the sum of changes and of temperatures."""
    n_t, n_r = made.shape
    change, total = 0.0, 0.0
    for j in range(n_t):
        jb, jn = (j - 1) % n_t, (j + 1) % n_t
        for i in range(first, n_r):
            diagonal = 2.0 * along[i] + outwards[i] + far[i]
            value = along[i] * (rise[body, jb, i] + rise[body, jn, i])
            if i < n_r - 1:
                value += outwards[i] * rise[body, j, i + 1]
            if i > first:
                diagonal += outwards[i - 1]
                value += outwards[i - 1] * rise[body, j, i - 1]
            if body == 1:
                diagonal += across[0, j, i] + across[1, j, i]
                value += across[0, j, i] * rise[0, j, i] + across[1, j, i] * rise[2, j, i]
                value += (1.0 - m.heat_split) * made[j, i]
            else:
                c = across[body // 2, j, i]
                diagonal += c
                value += c * rise[1, j, i]
                if body == 0:
                    value += m.heat_split * made[j, i]
            step = relaxation * (value / diagonal - rise[body, j, i])
            rise[body, j, i] += step
            change += abs(step)
            total += abs(rise[body, j, i])
    return change, total


@rival
def heat(
    m: WasherModel,
    g: Mesh,
    q: Array,
    speed: float,
    tilt: float,
    mu: Array,
    contact: float,
    rise: Array,
    s: Settings,
) -> int:
    """Solve for the rises of the three bodies (3, n_t, n_r) at given gaps; return the sweeps."""
    n_t, n_r = mu.shape
    made, across = np.zeros((n_t, n_r)), np.zeros((2, n_t, n_r))
    along, outwards, far = np.zeros((3, n_r)), np.zeros((3, n_r)), np.zeros((3, n_r))
    first = np.zeros(3, np.int64)
    _across(m, g, q, speed, tilt, mu, contact, made, across)
    thick = (m.carrier_thickness, m.washer_thickness, m.gear_thickness)
    for body in range(3):
        first[body] = _plate(m, g, body, thick[body], along[body], outwards[body], far[body])
    for sweep in range(MOST_SWEEPS):
        change, total = 0.0, 0.0
        for body in range(3):
            c, t = _sweep(
                m,
                body,
                first[body],
                along[body],
                outwards[body],
                far[body],
                made,
                across,
                rise,
                s.heat_relaxation,
            )
            change += c
            total += t
        if change <= 0.1 * s.tolerance * total:
            return sweep + 1
    return MOST_SWEEPS
