"""Settings and mesh of the method of 2006."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernels.washer_layout import P_GEAR_INNER_RADIUS
from ..kernels.washer_model import WasherModel
from ._jit import rival

Array = NDArray[np.float64]


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
