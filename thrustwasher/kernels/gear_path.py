"""The line of action of the rung `fine`: positions, what the pair bears there, its loss."""

import math

import numpy as np
from numpy.typing import NDArray

from . import gear_layout as L
from ._jit import kernel

Array = NDArray[np.float64]
# Lobatto's rule of five nodes on [0, 1]: both ends are among them, exact to power 7
NODES = (0.0, 0.5 - math.sqrt(3.0 / 28.0), 0.5, 0.5 + math.sqrt(3.0 / 28.0), 1.0)
WEIGHTS = (0.05, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 0.05)
N_NODES = 5
MAX_PIECES = 16
LEAST_SLIDING = 1e-6  # of the line's length per speed of 1 rad/s; at the pitch point nothing slides


@kernel
def _piece(par: Array, low: float, high: float, shared: float, borne: float) -> None:
    """Add the positions from ``low`` to ``high`` [base pitches]; ``shared`` by that many pairs."""
    n = int(par[L.D_PLACES])
    if not high > low or n + N_NODES > L.N_PATH:
        return
    for k in range(N_NODES):
        s = low + (high - low) * NODES[k]
        par[L.D_POSITION + n + k] = s
        par[L.D_PATH_SHARE + n + k] = borne
        par[L.D_PATH_LOSS + n + k] = (high - low) * WEIGHTS[k] * abs(s) / shared
    par[L.D_PLACES] = float(n + N_NODES)


@kernel
def _split(par: Array, low: float, high: float, shared: float, borne: float) -> None:
    """Add a stretch, cut at the pitch point, where sliding turns round."""
    if low < 0.0 < high:
        _piece(par, low, 0.0, shared, borne)
        _piece(par, 0.0, high, shared, borne)
    else:
        _piece(par, low, high, shared, borne)


@kernel
def line_of_action(par: Array, approach: float, recess: float) -> None:
    """Fill positions, shares and losses from the start to the end of contact.

    The loss books equal shares, as ``loss_factor`` does, and comes to it. Heat is made by the pair
    that bears ``load_share`` where it has company, all of the load where it is alone.
    """
    whole = math.floor(approach + recess)
    more = approach + recess - whole
    given = par[L.P_LOAD_SHARE]
    alone = 1.0 if whole <= 1.0 else min(1.0, given * (whole + 1.0) / whole)
    par[L.D_PLACES] = 0.0
    for k in range(int(min(whole, 0.5 * MAX_PIECES - 1.0)) + 1):
        low = -approach + k
        _split(par, low, low + more, whole + 1.0, given)
        if k < whole:
            _split(par, low + more, low + 1.0, max(whole, 1.0), alone)
    total = 0.0
    for k in range(int(par[L.D_PLACES])):
        total += par[L.D_PATH_LOSS + k]
    for k in range(int(par[L.D_PLACES])):  # shares of the loss for one coefficient of friction
        par[L.D_PATH_LOSS + k] /= total


@kernel
def place_mesh(par: Array, place: int, local: Array) -> None:
    """Fill ``local`` with the constants of the mesh as they are at a place of the line."""
    for i in range(L.D_POSITION):
        local[np.uintp(i)] = par[np.uintp(i)]
    ratio, angle = par[L.P_GEAR_RATIO], par[L.P_PRESSURE_ANGLE]
    pitch = (
        2.0 * math.pi * math.cos(angle) / (par[L.P_PINION_TEETH] * (1.0 + ratio) * math.sin(angle))
    )  # base pitch over the line's length
    x = 1.0 / (1.0 + ratio) + par[L.D_POSITION + place] * pitch
    line = par[L.P_CENTRE_DISTANCE] * math.sin(angle)
    v1, v2 = x * line, (1.0 - x) * line / ratio
    local[L.D_RADIUS] = x * (1.0 - x) * line
    local[L.D_V1], local[L.D_V2] = v1, v2
    local[L.D_SLIDING] = max(abs(v2 - v1), LEAST_SLIDING * line)
    local[L.D_LINE] = par[L.D_LINE] / par[L.P_LOAD_SHARE] * par[L.D_PATH_SHARE + place]
    if par[L.P_HEAT_PARTITION] != L.CONSTANT_SHARE:
        local[L.D_SHARE] = math.sqrt(v1) / (math.sqrt(v1) + math.sqrt(v2))
