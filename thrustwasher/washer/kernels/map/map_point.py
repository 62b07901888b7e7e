"""The washer's outputs where a look-up has found its point, and their derivatives."""

import math

import numpy as np

from ....numerics.chebyshev import N_TERMS, polynomial, polynomial_slope
from ....numerics.jit import Array, kernel, matrix
from .. import layout as L
from ..gap import oil_viscosity
from ..outputs import side_of
from ..workspace import Point, clear
from . import map_layout as M
from .map_layout import THICK
from .map_search import AT_PIECE, AT_RATIO, AT_SCALE, AT_U, ratio_at, read_lines


@kernel
def _value(w: Array, curve: int, u: float) -> float:
    """Return exp of one of the curves in ``w``."""
    return math.exp(min(polynomial(w, M.CURVES + curve * N_TERMS, u), 600.0))


@kernel
def _values(w: Array, u: float) -> tuple[float, float, float, float, float, float]:
    """Return the sums of all curves in ``w``: the Chebyshev polynomials are made once."""
    curves = matrix(w[M.CURVES : M.CURVES + M.N_CURVES * N_TERMS], M.N_CURVES, N_TERMS)
    before, now = 1.0, u
    fluid, contact = curves[M.GF, 0] + u * curves[M.GF, 1], curves[M.GC, 0] + u * curves[M.GC, 1]
    viscous = curves[M.VISCOUS, 0] + u * curves[M.VISCOUS, 1]
    dry = curves[M.DRY, 0] + u * curves[M.DRY, 1]
    mean, top = curves[M.MEAN, 0] + u * curves[M.MEAN, 1], curves[M.TOP, 0] + u * curves[M.TOP, 1]
    for j in range(2, N_TERMS):
        following = 2.0 * u * now - before
        before, now = now, following
        k = np.uintp(j)
        fluid += now * curves[M.GF, k]
        contact += now * curves[M.GC, k]
        viscous += now * curves[M.VISCOUS, k]
        dry += now * curves[M.DRY, k]
        mean += now * curves[M.MEAN, k]
        top += now * curves[M.TOP, k]
    return fluid, contact, viscous, dry, mean, top


@kernel
def map_outputs(data: Array, w: Array, pt: Point, place: Array, out: Array) -> None:
    """Fill ``out`` (L.N_ALL,) at a found place.

    ``w`` still holds the load's curves of the piece.
    """
    piece, u, scale = int(place[AT_PIECE]), place[AT_U], place[AT_SCALE]
    read_lines(data, w, M.N_LINE_HEAD + piece * M.PIECE + M.VISCOUS * N_TERMS, 4 * N_TERMS, -1,
               M.CURVES + M.VISCOUS * N_TERMS)  # fmt: skip
    log_fluid, log_contact, log_viscous, log_dry, log_mean, log_top = _values(w, u)
    fluid = scale * math.exp(min(log_fluid, 600.0))
    contact, dry = 0.0, 0.0
    if piece != THICK:
        contact = math.exp(min(log_contact, 600.0))
        dry = contact * math.exp(min(log_dry, 600.0))
    torque = side_of(pt.speed) * (scale * math.exp(min(log_viscous, 600.0)) + dry)
    power = torque * pt.speed
    mean = power * math.exp(min(log_mean, 600.0))
    out[L.O_TORQUE] = torque
    out[L.O_MEAN] = pt.oil_temperature + mean
    out[L.O_PEAK] = pt.oil_temperature + max(power * math.exp(min(log_top, 600.0)), mean)
    out[L.O_RATIO] = place[AT_RATIO]
    out[L.O_FILM] = place[AT_RATIO] * data[M.SIGMA]
    out[L.O_FLUID_LOAD], out[L.O_CONTACT_LOAD] = fluid, contact
    out[L.O_FLUID_SHARE] = fluid / (fluid + contact) if fluid > 0.0 else 0.0
    inner, outer = data[M.PARAMS + L.P_INNER_RADIUS], data[M.PARAMS + L.P_OUTER_RADIUS]
    lever = 1.5 * (outer**2 - inner**2) / (outer**3 - inner**3)
    out[L.O_COEFFICIENT] = abs(torque) * lever / pt.load
    out[L.O_POWER] = power


@kernel
def _edges_change(data: Array, w: Array, scale_change: float) -> None:
    """Turn the changes of a line's head in ``w[M.HEAD:]`` into those of the edges, there."""
    first, second, third = w[M.HEAD], w[M.HEAD + 1], w[M.HEAD + 2]
    w[M.HEAD] = 0.5 * data[M.REACH] * scale_change / w[M.EDGES]  # of the thick end
    w[M.HEAD + 1], w[M.HEAD + 2], w[M.HEAD + 3] = first, second, third


@kernel
def _ratio_change(w: Array, piece: int, u: float) -> float:
    """Return the change of the film ratio at held ``u``; `_edges_change` has been."""
    up, down = 0.5 * (1.0 + u), 0.5 * (1.0 - u)
    if piece == THICK:
        return float(ratio_at(w, piece, u) * up * w[M.HEAD] / w[M.EDGES])
    middle = (1.0 - M.MIDDLE) * w[M.HEAD + 1]
    if piece == 1:
        return float(down * middle)
    if piece == 2:
        return float(up * middle + down * w[M.HEAD + 1])
    return float(up * w[M.HEAD + piece - 2] + down * w[M.HEAD + piece - 1])


@kernel
def map_derivative(
    data: Array, w: Array, pt: Point, change: Point, place: Array, out: Array, dout: Array
) -> bool:
    """Fill ``dout`` (real outputs) with their change along ``change`` at a found place.

    ``w`` and ``out`` are as `map_outputs` left them. The branch is held. False at a fold.
    """
    piece, u, scale = int(place[AT_PIECE]), place[AT_U], place[AT_SCALE]
    side = 1.0
    if pt.speed < 0.0:
        side = -1.0
    speed, speed_change = abs(pt.speed), side * change.speed
    mu, mu_slope = oil_viscosity(data[M.PARAMS :], pt.oil_temperature)
    scale_change = mu_slope * change.oil_temperature * speed + mu * speed_change
    bend = data[M.BEND]
    first = speed_change / math.sqrt(speed * speed + bend * bend)
    second = change.tilt / pt.tilt
    start = M.N_LINE_HEAD + piece * M.PIECE
    clear(w[M.CHANGE : M.CHANGE + M.PIECE])
    head0, head1, head2 = 0.0, 0.0, 0.0
    for axis in range(3):
        along = change.oil_temperature
        if axis == 0:
            along = first
        elif axis == 1:
            along = second
        if along == 0.0 or data[M.AXES + 3 * axis + 2] < 1.0:
            continue
        read_lines(data, w, start, M.PIECE, axis, M.SPARE)
        for k in range(M.PIECE):
            w[M.CHANGE + k] += along * w[M.SPARE + k]
        read_lines(data, w, 0, M.N_LINE_HEAD, axis, M.HEAD)
        head0 += along * w[M.HEAD]
        head1 += along * w[M.HEAD + 1]
        head2 += along * w[M.HEAD + 2]
    w[M.HEAD], w[M.HEAD + 1], w[M.HEAD + 2] = head0, head1, head2
    _edges_change(data, w, scale_change)
    # at held u, then along u so that the load comes out
    fluid, contact = out[L.O_FLUID_LOAD], out[L.O_CONTACT_LOAD]
    relative = scale_change / scale if scale > 0.0 else 0.0
    _, gf_u = polynomial_slope(w, M.CURVES + M.GF * N_TERMS, u)
    held = fluid * polynomial(w, M.CHANGE + M.GF * N_TERMS, u)
    if scale > 0.0:
        held += fluid * relative
    load_u = fluid * gf_u
    fluid_u, fluid_held = load_u, held
    contact_u, contact_held = 0.0, 0.0
    if piece != THICK:
        _, gc_u = polynomial_slope(w, M.CURVES + M.GC * N_TERMS, u)
        contact_u = contact * gc_u
        contact_held = contact * polynomial(w, M.CHANGE + M.GC * N_TERMS, u)
        held += contact_held
        load_u += contact_u
    if abs(load_u) <= 1e-10 * (fluid + contact):
        return False
    du = (change.load - held) / load_u
    fluid_change, contact_change = fluid_held + fluid_u * du, contact_held + contact_u * du
    torque = abs(out[L.O_TORQUE])
    _, curve_u = polynomial_slope(w, M.CURVES + M.VISCOUS * N_TERMS, u)
    viscous = scale * _value(w, M.VISCOUS, u)
    torque_change = viscous * (
        polynomial(w, M.CHANGE + M.VISCOUS * N_TERMS, u) + curve_u * du + relative
    )
    if piece != THICK:
        _, curve_u = polynomial_slope(w, M.CURVES + M.DRY * N_TERMS, u)
        lever = _value(w, M.DRY, u)
        torque_change += lever * contact_change + lever * contact * (
            polynomial(w, M.CHANGE + M.DRY * N_TERMS, u) + curve_u * du
        )
    power = torque * speed
    power_change = torque_change * speed + torque * speed_change
    dout[L.O_TORQUE] = side * torque_change
    _, curve_u = polynomial_slope(w, M.CURVES + M.MEAN * N_TERMS, u)
    mean = _value(w, M.MEAN, u)
    mean_change = mean * power_change + power * mean * (
        polynomial(w, M.CHANGE + M.MEAN * N_TERMS, u) + curve_u * du
    )
    dout[L.O_MEAN] = change.oil_temperature + mean_change
    _, curve_u = polynomial_slope(w, M.CURVES + M.TOP * N_TERMS, u)
    top = _value(w, M.TOP, u)
    if top >= mean:
        mean_change = top * power_change + power * top * (
            polynomial(w, M.CHANGE + M.TOP * N_TERMS, u) + curve_u * du
        )
    dout[L.O_PEAK] = change.oil_temperature + mean_change
    thick = 0.5 * (w[M.EDGES + piece] - w[M.EDGES + piece + 1])
    if piece == THICK:
        thick = 0.5 * math.log(w[M.EDGES] / w[M.EDGES + 1]) * place[AT_RATIO]
    dout[L.O_RATIO] = _ratio_change(w, piece, u) + thick * du
    dout[L.O_FILM] = dout[L.O_RATIO] * data[M.SIGMA]
    total = fluid + contact
    dout[L.O_FLUID_SHARE] = (fluid_change * contact - fluid * contact_change) / (total * total)
    dout[L.O_COEFFICIENT] = 0.0
    if torque > 0.0:
        dout[L.O_COEFFICIENT] = out[L.O_COEFFICIENT] * (
            torque_change / torque - change.load / pt.load
        )
    dout[L.O_POWER] = power_change
    return True
