"""The washer's film as a plain wedge: lift, shear and contact at one least gap and one tilt.

Every function goes along one direction of change: a quantity ``x`` comes with its change ``dx``,
so that slopes are exact wherever they are used, in Newton's method and as derivatives of a step.

symbol | meaning                                                        | unit
s      | least separation of the mean surfaces, at the outer rim        | m
c      | the mean gap there, above 0 for every s                        | m
g      | tilt of the washer against the carrier                         | rad
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel, matrix
from ...numerics.quadrature import GAUSS_NODES, GAUSS_WEIGHTS
from ...tribology.asperities import contact_pressure
from ...tribology.flow_factors import flow_conductance
from . import layout as L
from .layout import N_PANEL, N_WEDGE

END_OF_WEDGE = L.D_MESH + 3 * N_WEDGE  # in `par` of a rung without a mesh
# 1/lift over that of a narrow ring: 1 + sum of rho^i lambda^j, i = 0 .. 2, j = 1 .. 4; see `lift`
WIDE = (
    (0.11160, -1.50311, 2.20410, -1.38707),
    (0.23950, -0.32276, 1.07014, -0.76025),
    (-0.30704, 1.26396, -2.70685, 1.65935),
)
# its centre over that of a narrow ring: 1 + sum of (1 - rho)^i lambda^j, i = 1 .. 2, j = 0 .. 2
CENTRE = (-0.1325, 0.0825, 0.0354, 0.7261, -1.0199, 1.5580)


@kernel
def _poly(x: float, dx: float, a: tuple[float, float, float, float]) -> tuple[float, float]:
    """Return a0 x + a1 x^2 + a2 x^3 + a3 x^4 and its change."""
    value = x * (a[0] + x * (a[1] + x * (a[2] + x * a[3])))
    slope = a[0] + x * (2.0 * a[1] + x * (3.0 * a[2] + x * 4.0 * a[3]))
    return value, slope * dx


@kernel
def lift(
    c: float, dc: float, g: float, dg: float, strength: float, dstrength: float, ri: float,
    ro: float, sigma: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """Return the film's force [N], how far from the axis it acts over ro [-], and their changes.

    ``strength`` is viscosity x speed [Pa], 0 or more. A narrow ring's force with Reynolds
    cavitation, mu omega R^2 L^3 g z/(e1 e2)^2 with the gaps e1, e2 at the mean radius R and z at
    the axis, times a factor for the width L, fitted to solutions of the complete annulus: 2.0 %
    at the worst, over ri/ro 0.05 .. 0.96 and every tilt (docs/theory/washer.md). Roughness enters
    by the mean gap and by the flow factor at e1.
    """
    if not (g > 0.0 and strength > 0.0):
        return 0.0, 0.0, 0.0, 0.0
    mean, width, rho = 0.5 * (ri + ro), ro - ri, ri / ro
    z, dz = c + g * ro, dc + dg * ro
    e1, de1 = c + 0.5 * g * width, dc + 0.5 * dg * width
    e2, de2 = z + g * mean, dz + dg * mean
    lam = 0.5 * g * width / e1
    dlam = lam * (dg / g - de1 / e1)
    p0, d0 = _poly(lam, dlam, WIDE[0])
    p1, d1 = _poly(lam, dlam, WIDE[1])
    p2, d2 = _poly(lam, dlam, WIDE[2])
    wide = 1.0 + p0 + rho * (p1 + rho * p2)
    dwide = d0 + rho * (d1 + rho * d2)
    flow, dflow = flow_conductance(e1, sigma)
    # flow = phi e1^3, hence phi^-1 e1^-2 = e1/flow
    force = strength * mean * mean * width**3 * g * z * e1 / (flow * e2 * e2 * wide)
    change = dstrength / strength + dg / g + dz / z + de1 / e1 - dflow * de1 / flow
    change -= 2.0 * de2 / e2 + dwide / wide
    w = 1.0 - rho
    b0, b1 = w * (CENTRE[0] + w * CENTRE[3]), w * (CENTRE[1] + w * CENTRE[4])
    b2 = w * (CENTRE[2] + w * CENTRE[5])
    near = g * mean * mean / (z * ro)
    centre = near * (1.0 + b0 + lam * (b1 + lam * b2))
    dcentre = centre * (dg / g - dz / z) + near * (b1 + 2.0 * lam * b2) * dlam
    if centre > 1.0:
        centre, dcentre = 1.0, 0.0
    return force, centre, force * change, dcentre


@kernel
def shear_moment(
    c: float, dc: float, g: float, dg: float, ri: float, ro: float
) -> tuple[float, float]:
    """Return the integral of r^2/h over the annulus [m^3] and its change; h = c + g (ro - x).

    Exact for a plane gap: around a radius r it is 2 pi r^3/sqrt(z^2 - g^2 r^2), z = c + g ro.
    """
    z, dz = c + g * ro, dc + dg * ro
    y1, y2 = math.sqrt(z * z - g * g * ri * ri), math.sqrt(c * (z + g * ro))
    dy1 = (z * dz - g * dg * ri * ri) / y1
    dy2 = 0.5 * (dc * (z + g * ro) + c * (dz + dg * ro)) / y2
    y, dy = y1 + y2, dy1 + dy2
    area, twice = ro * ro - ri * ri, ro * ro + ri * ri
    bend = g * area / y
    dbend = (dg * area - bend * dy) / y
    value = math.pi * area / y * (twice + bend * bend / 3.0)
    return value, -value * dy / y + math.pi * area / y * (2.0 * bend * dbend / 3.0)


@kernel
def _nodes(par: Array) -> Array:
    """Return the wedge's nodes: distances, areas and moments, (3, N_WEDGE)."""
    return matrix(par[L.D_MESH : END_OF_WEDGE], 3, N_WEDGE)


@kernel
def wedge_nodes(par: Array) -> None:
    """Fill distances from the outer rim along the tilt [m], areas [m^2], moments [m^3] of nodes.

    Chords across the annulus at x = ro cos(phi): phi = pi t^2 crowds nodes at the rim, where
    contact is. Scaled to the exact area and the exact integral of r, for a level washer.
    """
    ri, ro, nodes = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], _nodes(par)
    area, moment = 0.0, 0.0
    for k in range(N_WEDGE):
        t = 0.5 * (k // N_PANEL + GAUSS_NODES[k % N_PANEL])
        phi = math.pi * t * t
        half = math.sin(0.5 * phi)
        x, y = ro * math.cos(phi), ro * math.sin(phi)
        step = GAUSS_WEIGHTS[k % N_PANEL] * math.pi * t * y  # dx
        long, far = 2.0 * y, _chord_moment(x, y)
        if abs(x) < ri:
            inner = math.sqrt(ri * ri - x * x)
            long -= 2.0 * inner
            far -= _chord_moment(x, inner)
        nodes[L.DISTANCE, k] = 2.0 * ro * half * half
        nodes[L.AREA, k], nodes[L.MOMENT, k] = step * long, step * far
        area += step * long
        moment += step * far
    area = math.pi * (ro * ro - ri * ri) / area
    moment = 2.0 / 3.0 * math.pi * (ro**3 - ri**3) / moment
    for k in range(N_WEDGE):
        nodes[L.AREA, k] *= area
        nodes[L.MOMENT, k] *= moment


@kernel
def _chord_moment(x: float, y: float) -> float:
    """Return the integral of sqrt(x^2 + t^2) over t from -y to y."""
    r = math.sqrt(x * x + y * y)
    size = max(abs(x), 1e-12 * r)
    return y * r + size * size * math.log((y + r) / size)


@kernel
def rim_contact(
    par: Array, s: float, ds: float, g: float, dg: float
) -> tuple[float, float, float, float]:
    """Return the asperities' force [N], its change, their integral of P r [N m], its change."""
    force, dforce, moment, dmoment = 0.0, 0.0, 0.0, 0.0
    table, nodes = par[L.D_TABLE1 : L.D_MESH], _nodes(par)
    offset, scatter = par[L.D_MEAN_SUMMIT1], par[L.D_SUMMIT_SIGMA1]
    for node in range(N_WEDGE):
        k = np.uintp(node)
        far = nodes[L.DISTANCE, k]
        p, dp = contact_pressure((s + g * far - offset) / scatter, table)
        if p == 0.0:  # gaps grow from node to node
            break
        dp *= (ds + dg * far) / scatter
        force += nodes[L.AREA, k] * p
        dforce += nodes[L.AREA, k] * dp
        moment += nodes[L.MOMENT, k] * p
        dmoment += nodes[L.MOMENT, k] * dp
    return force, dforce, moment, dmoment
