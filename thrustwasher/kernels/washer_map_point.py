"""The washer's outputs where a look-up has found its point, and their derivatives."""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .chebyshev import N_TERMS, polynomial, polynomial_slope
from .washer_fields import Point
from .washer_map import (
    AT_PIECE,
    AT_RATIO,
    AT_SCALE,
    AT_U,
    oil_viscosity,
    ratio_at,
    read_lines,
)  # fmt: skip
from .washer_map_layout import (
    AXES,
    BEND,
    CHANGE,
    CURVES,
    DRY,
    EDGES,
    GC,
    GF,
    HEAD,
    MEAN,
    MIDDLE,
    N_LINE_HEAD,
    PARAMS,
    PIECE,
    REACH,
    SIGMA,
    THICK,
    TOP,
    VISCOUS,
)  # fmt: skip
from .washer_outputs import (
    COEFFICIENT,
    CONTACT_LOAD,
    FILM_THICKNESS,
    FLUID_LOAD,
    FLUID_SHARE,
    MAX_TEMPERATURE,
    MEAN_TEMPERATURE,
    POWER,
    RATIO,
    TORQUE,
)  # fmt: skip


@kernel
def _value(w: NDArray[np.float64], curve: int, u: float) -> float:
    """Return exp of one of the curves in ``w``."""
    return math.exp(min(polynomial(w, CURVES + curve * N_TERMS, u), 600.0))


@kernel
def _values(w: NDArray[np.float64], u: float) -> tuple[float, float, float, float, float, float]:
    """Return the sums of all curves in ``w``: the Chebyshev polynomials are made once."""
    before, now = 1.0, u
    k = np.uintp(CURVES)
    n = np.uintp(N_TERMS)
    a, b, c = w[k] + u * w[k + 1], w[k + n] + u * w[k + n + 1], w[k + 2 * n] + u * w[k + 2 * n + 1]
    k += 3 * n
    d, e, f = w[k] + u * w[k + 1], w[k + n] + u * w[k + n + 1], w[k + 2 * n] + u * w[k + 2 * n + 1]
    for j in range(2, N_TERMS):
        following = 2.0 * u * now - before
        before, now = now, following
        k = np.uintp(CURVES + j)
        a += now * w[k]
        b += now * w[k + n]
        c += now * w[k + 2 * n]
        k += 3 * n
        d += now * w[k]
        e += now * w[k + n]
        f += now * w[k + 2 * n]
    return a, b, c, d, e, f


@kernel
def map_outputs(
    data: NDArray[np.float64], w: NDArray[np.float64], pt: Point,
    place: NDArray[np.float64], out: NDArray[np.float64],
) -> None:  # fmt: skip
    """Fill ``out`` (N_ALL,) at a found place.

    ``w`` still holds the load's curves of the piece.
    """
    piece, u, scale = int(place[AT_PIECE]), place[AT_U], place[AT_SCALE]
    read_lines(data, w, N_LINE_HEAD + piece * PIECE + VISCOUS * N_TERMS, 4 * N_TERMS, -1,
               CURVES + VISCOUS * N_TERMS)  # fmt: skip
    log_fluid, log_contact, log_viscous, log_dry, log_mean, log_top = _values(w, u)
    fluid = scale * math.exp(min(log_fluid, 600.0))
    contact, dry = 0.0, 0.0
    if piece != THICK:
        contact = math.exp(min(log_contact, 600.0))
        dry = contact * math.exp(min(log_dry, 600.0))
    side = 0.0
    if pt.speed != 0.0:
        side = math.copysign(1.0, pt.speed)
    torque = side * (scale * math.exp(min(log_viscous, 600.0)) + dry)
    power = torque * pt.speed
    mean = power * math.exp(min(log_mean, 600.0))
    out[TORQUE] = torque
    out[MEAN_TEMPERATURE] = pt.oil_temperature + mean
    out[MAX_TEMPERATURE] = pt.oil_temperature + max(power * math.exp(min(log_top, 600.0)), mean)
    out[RATIO] = place[AT_RATIO]
    out[FILM_THICKNESS] = place[AT_RATIO] * data[SIGMA]
    out[FLUID_LOAD], out[CONTACT_LOAD] = fluid, contact
    out[FLUID_SHARE] = fluid / (fluid + contact) if fluid > 0.0 else 0.0
    inner, outer = data[PARAMS], data[PARAMS + 1]
    lever = 1.5 * (outer**2 - inner**2) / (outer**3 - inner**3)
    out[COEFFICIENT] = abs(torque) * lever / pt.load
    out[POWER] = power


@kernel
def _edges_change(data: NDArray[np.float64], w: NDArray[np.float64], scale_change: float) -> None:
    """Turn the changes of a line's head in ``w[HEAD:]`` into those of the edges, there."""
    first, second, third = w[HEAD], w[HEAD + 1], w[HEAD + 2]
    w[HEAD] = 0.5 * data[REACH] * scale_change / w[EDGES]  # of the thick end
    w[HEAD + 1], w[HEAD + 2], w[HEAD + 3] = first, second, third


@kernel
def _ratio_change(w: NDArray[np.float64], piece: int, u: float) -> float:
    """Return the change of the film ratio at held ``u``; `_edges_change` has been."""
    up, down = 0.5 * (1.0 + u), 0.5 * (1.0 - u)
    if piece == THICK:
        return float(ratio_at(w, piece, u) * up * w[HEAD] / w[EDGES])
    middle = (1.0 - MIDDLE) * w[HEAD + 1]
    if piece == 1:
        return float(down * middle)
    if piece == 2:
        return float(up * middle + down * w[HEAD + 1])
    return float(up * w[HEAD + piece - 2] + down * w[HEAD + piece - 1])


@kernel
def map_derivative(
    data: NDArray[np.float64], w: NDArray[np.float64], pt: Point,
    change: Point, place: NDArray[np.float64], out: NDArray[np.float64],
    dout: NDArray[np.float64],
) -> bool:  # fmt: skip
    """Fill ``dout`` (real outputs) with their change along ``change`` at a found place.

    ``w`` and ``out`` are as `map_outputs` left them. The branch is held. False at a fold.
    """
    piece, u, scale = int(place[AT_PIECE]), place[AT_U], place[AT_SCALE]
    side = 1.0
    if pt.speed < 0.0:
        side = -1.0
    speed, speed_change = abs(pt.speed), side * change.speed
    mu, mu_slope = oil_viscosity(data, pt.oil_temperature)
    scale_change = mu_slope * change.oil_temperature * speed + mu * speed_change
    bend = data[BEND]
    first = speed_change / math.sqrt(speed * speed + bend * bend)
    second = change.tilt / pt.tilt
    start = N_LINE_HEAD + piece * PIECE
    for k in range(PIECE):
        w[CHANGE + k] = 0.0
    head0, head1, head2 = 0.0, 0.0, 0.0
    spare = CHANGE + PIECE + N_LINE_HEAD  # behind HEAD: scratch of one contraction
    for axis in range(3):
        along = change.oil_temperature
        if axis == 0:
            along = first
        elif axis == 1:
            along = second
        if along == 0.0 or data[AXES + 3 * axis + 2] < 1.0:
            continue
        read_lines(data, w, start, PIECE, axis, spare)
        for k in range(PIECE):
            w[CHANGE + k] += along * w[spare + k]
        read_lines(data, w, 0, N_LINE_HEAD, axis, HEAD)
        head0 += along * w[HEAD]
        head1 += along * w[HEAD + 1]
        head2 += along * w[HEAD + 2]
    w[HEAD], w[HEAD + 1], w[HEAD + 2] = head0, head1, head2
    _edges_change(data, w, scale_change)
    # at held u, then along u so that the load comes out
    fluid, contact = out[FLUID_LOAD], out[CONTACT_LOAD]
    relative = scale_change / scale if scale > 0.0 else 0.0
    _, gf_u = polynomial_slope(w, CURVES + GF * N_TERMS, u)
    held = fluid * polynomial(w, CHANGE + GF * N_TERMS, u)
    if scale > 0.0:
        held += fluid * relative
    load_u = fluid * gf_u
    fluid_u, fluid_held = load_u, held
    contact_u, contact_held = 0.0, 0.0
    if piece != THICK:
        _, gc_u = polynomial_slope(w, CURVES + GC * N_TERMS, u)
        contact_u = contact * gc_u
        contact_held = contact * polynomial(w, CHANGE + GC * N_TERMS, u)
        held += contact_held
        load_u += contact_u
    if abs(load_u) <= 1e-10 * (fluid + contact):
        return False
    du = (change.load - held) / load_u
    fluid_change, contact_change = fluid_held + fluid_u * du, contact_held + contact_u * du
    torque = abs(out[TORQUE])
    _, curve_u = polynomial_slope(w, CURVES + VISCOUS * N_TERMS, u)
    viscous = scale * _value(w, VISCOUS, u)
    torque_change = viscous * (
        polynomial(w, CHANGE + VISCOUS * N_TERMS, u) + curve_u * du + relative
    )
    if piece != THICK:
        _, curve_u = polynomial_slope(w, CURVES + DRY * N_TERMS, u)
        lever = _value(w, DRY, u)
        torque_change += lever * contact_change + lever * contact * (
            polynomial(w, CHANGE + DRY * N_TERMS, u) + curve_u * du
        )
    power = torque * speed
    power_change = torque_change * speed + torque * speed_change
    dout[TORQUE] = side * torque_change
    _, curve_u = polynomial_slope(w, CURVES + MEAN * N_TERMS, u)
    mean = _value(w, MEAN, u)
    mean_change = mean * power_change + power * mean * (
        polynomial(w, CHANGE + MEAN * N_TERMS, u) + curve_u * du
    )
    dout[MEAN_TEMPERATURE] = change.oil_temperature + mean_change
    _, curve_u = polynomial_slope(w, CURVES + TOP * N_TERMS, u)
    top = _value(w, TOP, u)
    if top >= mean:
        mean_change = top * power_change + power * top * (
            polynomial(w, CHANGE + TOP * N_TERMS, u) + curve_u * du
        )
    dout[MAX_TEMPERATURE] = change.oil_temperature + mean_change
    thick = 0.5 * (w[EDGES + piece] - w[EDGES + piece + 1])
    if piece == THICK:
        thick = 0.5 * math.log(w[EDGES] / w[EDGES + 1]) * place[AT_RATIO]
    dout[RATIO] = _ratio_change(w, piece, u) + thick * du
    dout[FILM_THICKNESS] = dout[RATIO] * data[SIGMA]
    total = fluid + contact
    dout[FLUID_SHARE] = (fluid_change * contact - fluid * contact_change) / (total * total)
    dout[COEFFICIENT] = 0.0
    if torque > 0.0:
        dout[COEFFICIENT] = out[COEFFICIENT] * (torque_change / torque - change.load / pt.load)
    dout[POWER] = power_change
    return True
