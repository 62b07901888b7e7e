# mypy: disable-error-code="no-any-return"
"""Rung `fine` of the gear mesh: resolved along the line of action.

Every position has its own load, radii, speeds, film, temperatures and coefficient of friction. The
loss is their sum; all other outputs are those of the position whose asperities are hottest.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import floored, floored_slope
from ...numerics.status import OK
from . import layout as L
from .directional_derivative import fill_changes, friction_change
from .mesh_point import LEAST_LINE_LOAD, LEAST_SPEED, mesh_point

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


@kernel
def solve_mesh(par: Array, torque: float, speed: float, oil: float, work: Array) -> int:
    """Fill ``work[:N_FIELD]``, except loss torque and power; return 0, an advice or a failure.

    Of the rung `fine` the coefficient of friction is the mean that the loss feels.
    """
    if par[L.P_FIDELITY] != L.FINE:
        return mesh_point(par, torque, speed, oil, work)
    hottest = work[L.W_HOTTEST : L.W_HERE]
    here, local = work[L.W_HERE : L.W_LOCAL], work[L.W_LOCAL : L.W_PLACE]
    worst, friction, iterations = OK, 0.0, 0.0
    for place in range(int(par[L.D_PLACES])):
        place_mesh(par, place, local)
        worst = max(worst, mesh_point(local, torque, speed, oil, here))
        friction += par[L.D_PATH_LOSS + place] * here[L.F_FRICTION]
        iterations += here[L.F_ITERATIONS]
        if place == 0 or here[L.F_ASPERITY] > hottest[L.F_ASPERITY]:
            work[L.W_PLACE] = float(place)
            for i in range(L.N_FIELD):
                hottest[np.uintp(i)] = here[np.uintp(i)]
    for i in range(L.N_FIELD):
        work[np.uintp(i)] = hottest[np.uintp(i)]
    work[L.F_FRICTION], work[L.F_ITERATIONS] = friction, iterations
    work[L.F_STATUS] = float(worst)
    return worst


@kernel
def mesh_changes(
    par: Array, work: Array, torque: float, speed: float, oil: float, seed: Array, dout: Array
) -> None:
    """Fill the changes of all outputs but loss torque and power along ``seed``."""
    turning = floored(speed, LEAST_SPEED)
    faster = floored_slope(speed, LEAST_SPEED) * seed[L.I_SPEED] / turning
    if par[L.P_FIDELITY] != L.FINE:
        load = _heavier(par, torque, seed[L.I_LOAD])
        fill_changes(
            par, work, torque, oil, turning, load, faster, seed[L.I_LOAD], seed[L.I_OIL], dout
        )
        return
    here, local = work[L.W_HERE : L.W_LOCAL], work[L.W_LOCAL : L.W_PLACE]
    friction = 0.0
    for place in range(int(par[L.D_PLACES])):
        place_mesh(par, place, local)
        mesh_point(local, torque, speed, oil, here)
        load = _heavier(local, torque, seed[L.I_LOAD])
        friction += par[L.D_PATH_LOSS + place] * friction_change(
            local, here, oil, turning, load, faster, seed[L.I_OIL]
        )
    place_mesh(par, int(work[L.W_PLACE]), local)
    load = _heavier(local, torque, seed[L.I_LOAD])
    fill_changes(
        local, work[L.W_HOTTEST : L.W_HERE], torque, oil, turning, load, faster, seed[L.I_LOAD],
        seed[L.I_OIL], dout,
    )  # fmt: skip
    dout[L.F_FRICTION] = friction


@kernel
def _heavier(par: Array, torque: float, change: float) -> float:
    """Return the relative change of the line load when the torque changes by ``change`` [N m]."""
    line = torque * par[L.D_LINE]
    slope = floored_slope(line, LEAST_LINE_LOAD) * par[L.D_LINE]
    return slope * change / floored(line, LEAST_LINE_LOAD)
