"""Elasto-plastic asperities: the force of one, and the pressure of many over the separation.

The pressure is a table of ln P with exact slopes, by quintic Hermite interpolation.
"""

import math
from typing import NamedTuple

import numpy as np

from ..numerics.jit import Array, kernel
from ..numerics.quadrature import GAUSS_NODES, GAUSS_WEIGHTS
from ..numerics.spline import quintic

YIELD_END = 1.9  # w_t*: up to here the asperity counts as elastic

D_MIN = -8.0  # d/sigma_s, first knot
D_MAX = 14.0  # last knot; no contact beyond it
N_KNOTS = 265
STEP = (D_MAX - D_MIN) / (N_KNOTS - 1)
N_TABLE = 3 * N_KNOTS  # ln P, its first and its second derivative times the knot distance
N_NODES = 1200  # quadrature nodes: interference and weight x force, at most
N_CONTACT_WORK = 2 * N_NODES
_FAR = 9.0  # heights beyond this many sigma_s do not count


class AsperityArgs(NamedTuple):
    """What one asperity needs: see `asperity_args`."""

    critical_interference: float  # w_c [m]
    critical_force: float  # P_c [N]
    c: float  # C of Eq 12 [-]
    yield_strain: float  # e_y [-]
    b: float  # B of the nomenclature [-]


@kernel
def asperity_args(
    contact_modulus: float,
    youngs_modulus: float,
    poisson_ratio: float,
    yield_strength: float,
    by_contact: bool,
    radius: float,
) -> AsperityArgs:
    """Return the constants of one asperity; ``by_contact``: e_y = S_y/E' instead of S_y/E.

    ``contact_modulus`` is E' of both bodies, the other constants are those of the softer one.

    Source: Jackson & Green Eq 11 (with E' in place of the printed E, or P_c = (4/3) E' sqrt(R)
    w_c^1.5 would not hold), Eq 12; 1/E' = sum of (1 - nu^2)/E over both bodies.
    """
    c = 1.295 * math.exp(0.736 * poisson_ratio)
    w_c = (math.pi * c * yield_strength / (2.0 * contact_modulus)) ** 2 * radius
    p_c = 4.0 / 3.0 * contact_modulus * math.sqrt(radius) * w_c * math.sqrt(w_c)
    e_y = yield_strength / (contact_modulus if by_contact else youngs_modulus)
    return AsperityArgs(w_c, p_c, c, e_y, 0.14 * math.exp(min(23.0 * e_y, 200.0)))


@kernel
def asperity_force(w: float, a: AsperityArgs) -> float:
    """Return the force [N] of one asperity pressed in by ``w`` >= 0 [m].

    Source: Jackson & Green Eq 8-10. The fit jumps by 0.558 % at w* = 1.9; kept as published.
    """
    if w <= 0.0:
        return 0.0
    x = w / a.critical_interference
    if x <= YIELD_END:
        return a.critical_force * x * math.sqrt(x)
    log_x = math.log(x)
    contact_strain = (
        0.5
        * math.pi
        * a.c
        * a.yield_strain
        * math.exp(min(0.5 * log_x + 0.5 * a.b * (log_x - math.log(YIELD_END)), 300.0))
    )
    hardness = 2.84 * (1.0 - math.exp(-0.82 * contact_strain**-0.7))  # H/S_y
    elastic = math.exp(-0.25 * math.exp(5.0 / 12.0 * log_x)) * x * math.sqrt(x)
    plastic = 4.0 * hardness / a.c * -math.expm1(-0.04 * math.exp(5.0 / 9.0 * log_x)) * x
    return a.critical_force * (elastic + plastic)


@kernel
def _nodes(a: AsperityArgs, sigma: float, work: Array) -> int:
    """Fill ``work`` with interferences [sigma] and weight x force [N]; return their number.

    Panels grow from the scale on which the elastic force rises; the first is mapped by w = v^2
    (the force goes as w^1.5), one ends at w* = 1.9, where the published fit jumps.
    """
    end = _FAR - D_MIN
    yield_at = YIELD_END * a.critical_interference / sigma
    width = min(0.02, yield_at)
    left, n = 0.0, 0
    for _ in range(N_NODES // 12):
        right = left + width
        if left < yield_at < right * (1.0 + 1e-9):
            right = yield_at
        right = min(right, end)
        for k in range(12):
            if left == 0.0:
                v = math.sqrt(right) * GAUSS_NODES[k]
                w, weight = v * v, 2.0 * v * math.sqrt(right) * GAUSS_WEIGHTS[k]
            else:
                w = left + (right - left) * GAUSS_NODES[k]
                weight = (right - left) * GAUSS_WEIGHTS[k]
            work[n] = w
            work[N_NODES + n] = weight * asperity_force(w * sigma, a)
            n += 1
        left = right
        width = min(0.6 * left, 0.35)
        if left >= end:
            break
    return n


@kernel
def contact_table(
    a: AsperityArgs,
    density: float,
    sigma: float,
    table: Array,
    work: Array,
) -> bool:
    """Tabulate ln P over d/sigma, with first and second derivative; return True if finite.

    Parameters
    ----------
    a : constants of one asperity; density [1/m2] of asperities; sigma [m] of their heights
    table : (N_TABLE,) out; work : (N_CONTACT_WORK,) overwritten

    Notes
    -----
    Source: Jackson & Green Eq 13, P = density int_d^inf P_F(z - d) G(z) dz. The derivatives act
    on the Gaussian alone, so that value and slopes come from one quadrature. Knots 1/12 sigma
    apart: interpolation error below 1e-10 (tests/core/tribology/test_asperities.py).
    """
    n = _nodes(a, sigma, work)
    good = True
    for i in range(N_KNOTS):
        d = D_MIN + i * STEP
        p0, p1, p2 = 0.0, 0.0, 0.0
        for k in range(n):
            u = work[k] + d
            if u > 40.0:
                break
            # relative to the Gaussian at d, so that nothing underflows at large d
            g = (
                math.exp(
                    -0.5 * work[k] * (work[k] + 2.0 * max(d, 0.0))
                    - (0.0 if d > 0.0 else 0.5 * d * d + d * work[k])
                )
                * work[N_NODES + k]
            )
            p0 += g
            p1 -= u * g
            p2 += (u * u - 1.0) * g
        shift = 0.5 * d * d if d > 0.0 else 0.0
        scale = density * 0.3989422804014327
        good = good and p0 > 0.0 and math.isfinite(p0 * scale)
        slope = p1 / p0
        table[i] = math.log(scale * p0) - shift
        table[N_KNOTS + i] = STEP * slope
        table[2 * N_KNOTS + i] = STEP * STEP * (p2 / p0 - slope * slope)
    return good


@kernel
def contact_pressure(d: float, table: Array) -> tuple[float, float]:
    """Return P [Pa] and dP/d(d/sigma) [Pa] at the separation ``d`` of the summits' mean [sigma].

    Zero beyond d = 14, where the pressure is below 1e-34 Pa; linear with the last slope below -8.
    """
    if not d < D_MAX:
        return (d if math.isnan(d) else 0.0), 0.0
    x = (d - D_MIN) / STEP
    below = 0.0
    if x < 0.0:
        below, x = x, 0.0
    i = min(int(x), N_KNOTS - 2)
    t = x - i
    j = i + 1
    one = table[np.uintp(i)], table[np.uintp(N_KNOTS + i)], table[np.uintp(2 * N_KNOTS + i)]
    two = table[np.uintp(j)], table[np.uintp(N_KNOTS + j)], table[np.uintp(2 * N_KNOTS + j)]
    ln_p, slope = quintic(one, two, t)
    p = math.exp(ln_p)
    dp = p * slope / STEP
    if below < 0.0:
        return p + dp * below * STEP, dp
    return p, dp
