"""The washer's outputs where a look-up has found its point, and their derivatives."""

import math

import numpy as np

from ....numerics.chebyshev import CHANGES, polynomial, polynomial_slope, share_out_change
from ....numerics.jit import Array, inlined, kernel
from ....numerics.smoothing import sign_of
from .. import layout as L
from ..gap import dry_friction, oil_viscosity
from ..outputs import MOST_MARGIN, coefficient_per_torque
from ..workspace import Point
from . import map_layout as M
from .map_layout import THICK
from .map_search import ratio_at, read_lines, read_rest


@inlined
def _exp(x: float) -> float:
    return math.exp(min(x, 600.0))


@inlined
def _main_values(w: Array, at: int, n: int, u: float) -> tuple[float, float, float, float]:
    """Return the sums of the main curves: the Chebyshev polynomials are made once."""
    before, now = 1.0, u
    fluid, contact = w[at] + u * w[at + 1], w[at + n] + u * w[at + n + 1]
    dry = w[at + 2 * n] + u * w[at + 2 * n + 1]
    viscous = w[at + 3 * n] + u * w[at + 3 * n + 1]
    for j in range(2, n):
        following = 2.0 * u * now - before
        before, now = now, following
        fluid += now * w[np.uintp(at + j)]
        contact += now * w[np.uintp(at + n + j)]
        dry += now * w[np.uintp(at + 2 * n + j)]
        viscous += now * w[np.uintp(at + 3 * n + j)]
    return fluid, contact, dry, viscous


@inlined
def _more_values(
    w: Array, at: int, n: int, u: float
) -> tuple[float, float, float, float, float, float]:
    """Return the sums of the other curves."""
    before, now = 1.0, u
    at1, at2, at3, at4, at5 = at + n, at + 2 * n, at + 3 * n, at + 4 * n, at + 5 * n
    mean, top, film = w[at] + u * w[at + 1], w[at1] + u * w[at1 + 1], w[at2] + u * w[at2 + 1]
    flow, carried = w[at3] + u * w[at3 + 1], w[at4] + u * w[at4 + 1]
    grip = w[at5] + u * w[at5 + 1]
    for j in range(2, n):
        following = 2.0 * u * now - before
        before, now = now, following
        mean += now * w[np.uintp(at + j)]
        top += now * w[np.uintp(at1 + j)]
        film += now * w[np.uintp(at2 + j)]
        flow += now * w[np.uintp(at3 + j)]
        carried += now * w[np.uintp(at4 + j)]
        grip += now * w[np.uintp(at5 + j)]
    return mean, top, film, flow, carried, grip


@kernel
def map_outputs(data: Array, w: Array, pt: Point, place: Array, out: Array) -> None:
    """Fill ``out`` (L.N_ALL,) at a found place.

    ``w`` still holds the load's curves of the piece.
    """
    piece, u, scale = int(place[M.AT_PIECE]), place[M.AT_U], place[M.AT_SCALE]
    read_rest(data, w, piece)
    par, n = data[M.PARAMS :], int(data[M.TERMS + piece])
    at = M.CURVES + piece * M.MOST
    log_fluid, log_contact, log_dry, log_viscous = _main_values(w, at, n, u)
    mean, top, film, log_flow, log_carried, grip = _more_values(
        w, at + M.N_MAIN * n, int(data[M.MORE_TERMS + piece]), u
    )
    fluid = scale * _exp(log_fluid)
    contact, dry = 0.0, 0.0
    if piece != THICK:
        contact = _exp(log_contact)
        dry = contact * _exp(log_dry)
    speed, viscous = abs(pt.speed), scale * _exp(log_viscous)
    torque = sign_of(pt.speed) * (viscous + dry)
    power = torque * pt.speed
    oil = pt.oil_temperature
    mean = power * _exp(mean)
    flow = speed * _exp(log_flow)
    carried = (1.0 - par[L.P_FILM_HEAT_FRACTION]) * viscous * speed
    if par[L.P_OIL_COOLING] != 0.0:
        carried = power * speed * _exp(log_carried)
    out[L.O_TORQUE] = torque
    out[L.O_MEAN] = oil + mean
    out[L.O_PEAK] = oil + max(power * _exp(top), mean)
    out[L.O_RATIO] = place[M.AT_RATIO]
    out[L.O_FILM] = place[M.AT_RATIO] * data[M.SIGMA]
    out[L.O_FLUID_LOAD], out[L.O_CONTACT_LOAD] = fluid, contact
    out[L.O_FLUID_SHARE] = fluid / (fluid + contact) if fluid > 0.0 else 0.0
    inner, outer = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS]
    out[L.O_COEFFICIENT] = abs(torque) * coefficient_per_torque(inner, outer, pt.load)
    out[L.O_POWER] = power
    out[L.O_OIL_FLOW] = flow
    out[L.O_THROUGHFLOW_HEAT] = carried
    out[L.O_OIL_HEAT] = power
    out[L.O_OUTLET] = oil
    if par[L.P_OIL_COOLING] != 0.0 and flow > 0.0:
        out[L.O_OUTLET] = oil + carried / (par[L.P_OIL_DENSITY] * par[L.P_OIL_HEAT_CAPACITY] * flow)
    out[L.O_FILM_TEMPERATURE] = oil + power * _exp(film)
    friction, _ = dry_friction(par, pt.load)
    hold = friction * pt.load * _exp(grip)
    out[L.O_ENERGY], out[L.O_STORED_HEAT] = 0.0, 0.0
    out[L.O_OIL_ENERGY], out[L.O_ADVISED] = 0.0, 0.0
    out[L.O_STICK_MARGIN] = MOST_MARGIN
    if hold < MOST_MARGIN * abs(torque):
        out[L.O_STICK_MARGIN] = hold / abs(torque)


@kernel
def _ratio_change(data: Array, w: Array, piece: int, u: float, scale_change: float) -> float:
    """Return the change of the film ratio at held ``u``; HEAD_CHANGE is that of the line's head."""
    up, down, head = 0.5 * (1.0 + u), 0.5 * (1.0 - u), M.HEAD_CHANGE
    if piece == THICK:
        thick = w[M.EDGES]
        return float(ratio_at(w, piece, u) * up * 0.5 * data[M.REACH] * scale_change / thick**2)
    middle = (1.0 - M.MIDDLE) * w[head]
    if piece == 1:
        return float(down * middle)
    if piece == 2:
        return float(up * middle + down * w[head])
    return float(up * w[head + piece - 3] + down * w[head + piece - 2])


@kernel
def _change_of_curves(
    data: Array, w: Array, pt: Point, change: Point, piece: int, u: float, scale_change: float
) -> tuple[float, float]:
    """Fill LOGS with the changes of the curves as the load comes out; return du and d(ratio).

    du is infinite at a fold.
    """
    mu, mu_slope = oil_viscosity(data[M.PARAMS :], pt.oil_temperature)
    speed, bend = abs(pt.speed), data[M.BEND]
    along1 = change.speed / math.sqrt(speed * speed + bend * bend)
    along3 = -mu_slope * change.oil_temperature / mu
    share_out_change(w[M.CELL :], along1, change.tilt / pt.tilt, along3)
    n, more = int(data[M.TERMS + piece]), int(data[M.MORE_TERMS + piece])
    at, width = M.CURVES + piece * M.MOST, M.N_MAIN * n + M.N_MORE * more
    read_lines(data, w, int(data[M.PIECE_AT + piece]), width, CHANGES, M.CHANGE)
    read_lines(data, w, 0, M.N_LINE_HEAD, CHANGES, M.HEAD_CHANGE)
    # at held u, then along u so that the load comes out
    scale = w[M.SCALE]
    log_fluid, slope_fluid = polynomial_slope(w, at, n, u)
    fluid = scale * _exp(log_fluid)
    held = fluid * polynomial(w, M.CHANGE, n, u) + scale_change * _exp(log_fluid)
    load_u, load = fluid * slope_fluid, fluid
    if piece != THICK:
        log_contact, slope_contact = polynomial_slope(w, at + n, n, u)
        contact = _exp(log_contact)
        held += contact * polynomial(w, M.CHANGE + n, n, u)
        load_u += contact * slope_contact
        load += contact
    if abs(load_u) <= 1e-10 * load:
        return math.inf, 0.0
    du = (change.load - held) / load_u
    place = 0
    for curve in range(M.N_CURVES):
        terms = n if curve < M.N_MAIN else more
        w[M.LOGS + curve] = 0.0
        if piece != THICK or (curve != M.GC and curve != M.DRY):
            _, slope = polynomial_slope(w, at + place, terms, u)
            w[M.LOGS + curve] = polynomial(w, M.CHANGE + place, terms, u) + slope * du
        place += terms
    thick = 0.5 * (w[M.EDGES + piece] - w[M.EDGES + piece + 1])
    if piece == THICK:
        thick = 0.5 * math.log(w[M.EDGES] / w[M.EDGES + 1]) * ratio_at(w, piece, u)
    return du, _ratio_change(data, w, piece, u, scale_change) + thick * du


@kernel
def map_derivative(
    data: Array, w: Array, pt: Point, change: Point, place: Array, out: Array, dout: Array
) -> bool:
    """Fill ``dout`` (real outputs) with their change along ``change`` at a found place.

    ``w`` and ``out`` are as `map_outputs` left them. The branch is held. False at a fold.
    """
    piece, u, scale = int(place[M.AT_PIECE]), place[M.AT_U], place[M.AT_SCALE]
    side = -1.0 if pt.speed < 0.0 else 1.0
    par, n = data[M.PARAMS :], int(data[M.TERMS + piece])
    speed, speed_change = abs(pt.speed), side * change.speed
    mu, mu_slope = oil_viscosity(par, pt.oil_temperature)
    scale_change = mu_slope * change.oil_temperature * speed + mu * speed_change
    warmer = change.oil_temperature
    forward = Point(change.load, speed_change, change.tilt, warmer, warmer)
    du, ratio_change = _change_of_curves(data, w, pt, forward, piece, u, scale_change)
    if not math.isfinite(du):
        return False
    at = M.CURVES + piece * M.MOST
    fluid, contact = out[L.O_FLUID_LOAD], out[L.O_CONTACT_LOAD]
    log_viscous = polynomial(w, at + M.VISCOUS * n, n, u)
    fluid_change = fluid * w[M.LOGS + M.GF]
    fluid_change += scale_change * _exp(polynomial(w, at, n, u))
    contact_change = contact * w[M.LOGS + M.GC]
    viscous = scale * _exp(log_viscous)
    viscous_change = viscous * w[M.LOGS + M.VISCOUS] + scale_change * _exp(log_viscous)
    torque, torque_change = abs(out[L.O_TORQUE]), viscous_change
    if piece != THICK:
        lever = _exp(polynomial(w, at + M.DRY * n, n, u))
        torque_change += lever * (contact_change + contact * w[M.LOGS + M.DRY])
    power = torque * speed
    power_change = torque_change * speed + torque * speed_change
    relative = torque_change / torque if torque > 0.0 else 0.0
    at_power = power_change / power if power > 0.0 else 0.0
    per_speed = speed_change / speed if speed > 0.0 else 0.0
    oil, oil_change = pt.oil_temperature, change.oil_temperature
    dout[L.O_TORQUE] = side * torque_change
    dout[L.O_MEAN] = oil_change + (out[L.O_MEAN] - oil) * (at_power + w[M.LOGS + M.MEAN])
    dout[L.O_PEAK] = dout[L.O_MEAN]
    if out[L.O_PEAK] > out[L.O_MEAN]:
        dout[L.O_PEAK] = oil_change + (out[L.O_PEAK] - oil) * (at_power + w[M.LOGS + M.TOP])
    dout[L.O_RATIO], dout[L.O_FILM] = ratio_change, ratio_change * data[M.SIGMA]
    total = fluid + contact
    dout[L.O_FLUID_SHARE] = (fluid_change * contact - fluid * contact_change) / (total * total)
    dout[L.O_COEFFICIENT] = out[L.O_COEFFICIENT] * (relative - change.load / pt.load)
    dout[L.O_POWER] = power_change
    flow, carried = out[L.O_OIL_FLOW], out[L.O_THROUGHFLOW_HEAT]
    more = int(data[M.MORE_TERMS + piece])
    log_flow = polynomial(w, at + M.N_MAIN * n + (M.FLOW - M.N_MAIN) * more, more, u)
    dout[L.O_OIL_FLOW] = flow * w[M.LOGS + M.FLOW] + speed_change * _exp(log_flow)
    carried_change = (1.0 - par[L.P_FILM_HEAT_FRACTION]) * (
        viscous_change * speed + viscous * speed_change
    )
    if par[L.P_OIL_COOLING] != 0.0:
        carried_change = carried * (at_power + per_speed + w[M.LOGS + M.CARRIED])
    dout[L.O_THROUGHFLOW_HEAT] = carried_change
    dout[L.O_OIL_HEAT] = power_change
    dout[L.O_OUTLET] = oil_change
    if par[L.P_OIL_COOLING] != 0.0 and flow > 0.0:
        storage = par[L.P_OIL_DENSITY] * par[L.P_OIL_HEAT_CAPACITY] * flow
        dout[L.O_OUTLET] += (carried_change - carried * dout[L.O_OIL_FLOW] / flow) / storage
    film = out[L.O_FILM_TEMPERATURE] - oil
    dout[L.O_FILM_TEMPERATURE] = oil_change + film * (at_power + w[M.LOGS + M.FILM])
    dout[L.O_ENERGY], dout[L.O_STORED_HEAT] = 0.0, 0.0
    dout[L.O_OIL_ENERGY], dout[L.O_ADVISED] = 0.0, 0.0
    dout[L.O_STICK_MARGIN] = 0.0
    friction, friction_slope = dry_friction(par, pt.load)
    if out[L.O_STICK_MARGIN] < MOST_MARGIN and friction > 0.0:
        own = change.load / pt.load + friction_slope * change.load / friction
        dout[L.O_STICK_MARGIN] = out[L.O_STICK_MARGIN] * (own + w[M.LOGS + M.GRIP] - relative)
    return True
