"""Derivatives of the washer's outputs over its parameters, from the factored heat balance.

At a solution the residuals F(x, p) of forces and heat vanish, the film being settled; so
dx/dp = -F_x^-1 F_p. F_x is that of the directional derivatives. F_p is the difference of the
residuals for two values of a parameter at the same positions and temperatures: no solve.

With the film thickness held (FILM) the load is a result. At a fold it does not change with the
film, so that dload/dp is the slope of the fold's load: what the left null vector of F_x gives.
"""

import numpy as np

from ...numerics.arrays import clear, copy, negate, size_of
from ...numerics.jit import Array, kernel
from ...numerics.status import NOT_FINITE, OK, SINGULAR
from . import layout as L
from .directional_derivative import (
    CLOSE,
    add_slopes,
    follow_forces,
    forces_change,
    is_at_fold,
    refine_change,
)
from .film import film_solve, hold_pressure, let_flows_follow
from .gap import dry_friction
from .heat import contact_change, heat_change, let_film_follow, let_out
from .heat_factor import solve_heat
from .layout import ON_GEAR, ON_WASHER
from .newton import (
    EXACT,
    FILM,
    LOAD,
    NO_FLOOR,
    add_pressure,
    evaluate,
    linearise,
    make_factor,
    newton,
)
from .outputs import MOST_MARGIN, change_of_outputs, outputs_at
from .workspace import Point, Workspace, fields_of, model_of, vector

SHARES = (L.P_HEAT_SPLIT, L.P_FILM_HEAT_FRACTION)  # tunable parameters, from 0 to 1
STEP = 1e-6  # of a share
SHARP = 1e-10  # tolerance of the solution that is differentiated


@kernel
def residuals_here(w: Workspace, pt: Point, forces: Array, heat: Array) -> bool:
    """Fill ``forces`` (4,) and ``heat`` (n_temp,), the residuals at positions and temperatures.

    The film is settled; ``w.outputs`` are those of this state. Returns True if they are finite.
    """
    m, f = model_of(w), fields_of(w)
    let_out(m, pt, f)
    evaluate(m, pt, w.q, f, False)
    copy(vector(f.small, L.FORCES), forces)
    add_pressure(m, f.p, forces)
    copy(f.heat, heat)
    return outputs_at(w, pt)


@kernel
def factor_for_parameters(w: Workspace, pt: Point, mode: float) -> int:
    """Factor the equations at the solution in ``w``, for any number of right sides.

    Returns SINGULAR at a fold if the load is held (``mode`` LOAD).
    """
    m, f = model_of(w), fields_of(w)
    let_out(m, pt, f)
    evaluate(m, pt, w.q, f, False)
    if not outputs_at(w, pt) or not make_factor(m, pt, w.q, f.temp, f, EXACT):
        return SINGULAR
    clear(f.dtemp)
    film_solve(m, f)
    linearise(m, f)
    return SINGULAR if mode == LOAD and is_at_fold(m, pt, w.q, f) else OK


@kernel
def follow_parameter(
    w: Workspace, pt: Point, mode: float, film: float, forces: Array, heat: Array, dout: Array
) -> int:
    """Fill ``dout`` (N_ALL + 3,) as the state follows a change of the residuals; return a status.

    Parameters
    ----------
    mode : LOAD, or FILM: the film thickness is given
    film : its change [m] in mode FILM
    forces, heat : (4,) [N, N m] and (n_temp,) [W], change of the residuals at the state as it is
    dout : change of all outputs through the state; behind them the change of the load [N] (mode
        FILM) and of the washer's two tilts [rad]
    """
    m, f, q, out = model_of(w), fields_of(w), w.q, w.outputs
    none = Point(0.0, 0.0, 0.0, 0.0, 0.0)
    dtemp = f.keep[: f.temp.size]
    dq, step = vector(f.small, L.CHANGE), vector(f.small, L.STEP)
    clear(dq)
    copy(heat, f.heat)
    negate(f.heat)
    solve_heat(m, f.heat, dtemp, f)
    let_film_follow(m, pt, none, q, dq, dtemp, f)
    forces_change(m, none, dq, f, step)
    for a in range(4):
        step[a] = -step[a] - forces[a]
    if mode == FILM:
        step[ON_GEAR] = film
    if not follow_forces(m, q, f, mode, step):
        return SINGULAR
    copy(step, dq)
    add_slopes(f, dq, dtemp)
    let_film_follow(m, pt, none, q, dq, dtemp, f)
    heat_change(m, pt, none, q, dq, dtemp, f, f.heat)
    for node in range(heat.size):
        k = np.uintp(node)
        f.heat[k] = -f.heat[k] - heat[k]
    spread = m.carrier_conductivity * m.outer_radius * m.outer_radius / m.carrier_thickness
    enough = CLOSE * size_of(dtemp) / heat.size * spread
    status = refine_change(m, pt, q, f, mode, dtemp, f.heat, enough)
    if status != OK:
        return status
    let_film_follow(m, pt, none, q, dq, dtemp, f)
    forces_change(m, none, dq, f, step)
    on_gear = step[ON_GEAR]
    clear(step)
    add_pressure(m, f.dp, step)
    dfluid, dcontact = step[ON_WASHER], contact_change(f.small, dq)
    f.small[L.RIM_CHANGE] = heat_change(m, pt, none, q, dq, dtemp, f, f.heat)
    hold_pressure(m, pt, none, dq, dtemp, f)
    let_flows_follow(m, f)
    status = change_of_outputs(m, pt, none, w, f, dout[: L.N_ALL])
    carried = out[L.O_FLUID_LOAD] + out[L.O_CONTACT_LOAD]
    share = out[L.O_FLUID_SHARE]
    dout[L.O_FLUID_LOAD], dout[L.O_CONTACT_LOAD] = dfluid, dcontact
    dout[L.O_FLUID_SHARE] = ((1.0 - share) * dfluid - share * dcontact) / carried
    if out[L.O_STICK_MARGIN] < MOST_MARGIN and f.small[L.FRICTION2] > 0.0:
        _, slope = dry_friction(m.par, f.small[L.FORCES + L.ON_GEAR])
        dout[L.O_STICK_MARGIN] += out[L.O_STICK_MARGIN] * slope * on_gear / f.small[L.FRICTION2]
    dout[L.N_ALL] = forces[ON_GEAR] + on_gear
    dout[L.N_ALL + 1], dout[L.N_ALL + 2] = dq[L.TILT_X], dq[L.TILT_Y]
    return status


@kernel
def add_share_slope(
    w: Workspace, pt: Point, place: int, along: float, steady: bool, room: Array, dout: Array
) -> int:
    """Add to ``dout`` (NOUT,) ``along`` times the derivative over a share of heat; return a status.

    Parameters
    ----------
    w : with parameters of its own, which change meanwhile
    place : of the share in them
    steady : the heat is balanced; else temperatures are held, and only what follows at once moves
    room : 2 x (4 + n_temp + N_ALL + 3) numbers, of scratch
    """
    n = fields_of(w).temp.size
    forces, heat = room[:4], room[4 : 4 + n]
    now, warm = room[4 + n : 8 + n], room[8 + n : 8 + 2 * n]
    direct = room[8 + 2 * n : 8 + 2 * n + L.N_ALL]
    change = room[8 + 2 * n + L.N_ALL : 11 + 2 * n + 2 * L.N_ALL]
    clear(room[: 11 + 2 * n + 2 * L.N_ALL])
    if steady:
        status = newton(w, pt, LOAD, pt.load, NO_FLOOR, SHARP, 20.0)
        if status != OK:
            return status
    value, sound = w.par[place], True
    inside = STEP <= value <= 1.0 - STEP
    side = STEP if value < 0.5 else -STEP
    for k in range(3):
        if inside:  # central, else one-sided, both of second order
            offset, weight = STEP * (k - 1.0), 0.5 * (k - 1.0) / STEP
        else:
            offset, weight = side * k, (-1.5, 2.0, -0.5)[k] / side
        if weight == 0.0:
            continue
        w.par[place] = value + offset
        if steady:
            sound = residuals_here(w, pt, now, warm) and sound
        else:
            sound = outputs_at(w, pt) and sound
        for i in range(4):
            forces[i] += weight * now[i]
        for i in range(n):
            heat[np.uintp(i)] += weight * warm[np.uintp(i)]
        for i in range(L.N_ALL):
            direct[i] += weight * w.outputs[i]
    w.par[place] = value
    if not sound:
        return NOT_FINITE
    if steady:
        status = factor_for_parameters(w, pt, LOAD)
        if status == OK:
            status = follow_parameter(w, pt, LOAD, 0.0, forces, heat, change)
        if status != OK:
            return status
    elif not outputs_at(w, pt):
        return NOT_FINITE
    for i in range(dout.size):
        dout[i] += along * (direct[i] + change[i])
    return OK
