# mypy: disable-error-code="no-any-return"
"""Level `fine` of the gear mesh with the paper's heat: resolved along the line of action.

Every position has its own load, radii, speeds, film, temperatures and coefficient of friction. The
loss is their sum; all other outputs are those of the position whose asperities are hottest.
"""

import math

from ...numerics.arrays import copy
from ...numerics.jit import Array, kernel
from ...numerics.smoothing import floored, floored_slope
from ...numerics.status import OK
from . import layout as L
from .directional_derivative import fill_changes, film_changes, follow_friction
from .mesh_point import LEAST_LINE_LOAD, LEAST_SPEED, mesh_point
from .path_of_contact import flanks_at

LEAST_SLIDING = 1e-6  # of the line's length per speed of 1 rad/s; at the pitch point nothing slides


@kernel
def place_mesh(par: Array, place: int, local: Array) -> None:
    """Fill ``local`` with the constants of the mesh as they are at a place of the line."""
    copy(par, local)
    local[L.D_RADIUS], v1, v2 = flanks_at(par, par[L.D_POSITION + place])
    line = par[L.D_CENTRE] * math.sin(par[L.D_ANGLE])
    local[L.D_V1], local[L.D_V2] = v1, v2
    local[L.D_SLIDING] = max(abs(v2 - v1), LEAST_SLIDING * line)
    local[L.D_LINE] = par[L.D_LINE] / par[L.P_LOAD_SHARE] * par[L.D_PATH_SHARE + place]
    if par[L.P_HEAT_PARTITION] != L.CONSTANT_SHARE:
        local[L.D_SHARE] = math.sqrt(v1) / (math.sqrt(v1) + math.sqrt(v2))


@kernel
def solve_mesh(par: Array, torque: float, speed: float, oil: float, work: Array) -> int:
    """Fill ``work[:N_FIELD]``, except loss torque and power; return 0, an advice or a failure.

    Of the level `fine` the coefficient of friction is the mean that the loss feels.
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
            copy(here, hottest)
    copy(hottest, work[: L.N_FIELD])
    work[L.F_FRICTION], work[L.F_ITERATIONS] = friction, iterations
    work[L.F_SCUFFING_FRICTION] = friction
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
        film, bulk, _, _ = film_changes(local, here, oil, turning, load, faster, seed[L.I_OIL])
        change = follow_friction(local, here, film, bulk, load, faster)
        friction += par[L.D_PATH_LOSS + place] * change
    place_mesh(par, int(work[L.W_PLACE]), local)
    load = _heavier(local, torque, seed[L.I_LOAD])
    fill_changes(
        local,
        work[L.W_HOTTEST : L.W_HERE],
        torque,
        oil,
        turning,
        load,
        faster,
        seed[L.I_LOAD],
        seed[L.I_OIL],
        dout,
    )
    dout[L.F_FRICTION] = friction


@kernel
def _heavier(par: Array, torque: float, change: float) -> float:
    """Return the relative change of the line load when the torque changes by ``change`` [N m]."""
    line = torque * par[L.D_LINE]
    slope = floored_slope(line, LEAST_LINE_LOAD) * par[L.D_LINE]
    return slope * change / floored(line, LEAST_LINE_LOAD)
