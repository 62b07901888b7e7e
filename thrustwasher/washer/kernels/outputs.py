"""From a converged state to the numbers a user sees, and how they change with it."""

import math

import numpy as np

from ...numerics.jit import Array, inlined, kernel
from ...numerics.status import NOT_FINITE, OK
from . import layout as L
from .constants import WasherModel
from .jacobian import contact_change, film_thickness_change
from .layout import TILT_X, TILT_Y, Z_WASHER
from .newton import tilt_of
from .workspace import Fields, Point, Workspace, fields_of, model_of, vector


@kernel
def are_finite(a: Array) -> bool:
    """Tell if all numbers are finite."""
    good = True
    for k in range(a.size):
        good = good and math.isfinite(a[np.uintp(k)])
    return good


@kernel
def coefficient_per_torque(inner: float, outer: float, load: float) -> float:
    """Return the friction coefficient that a torque of 1 N m stands for."""
    return 1.5 * (outer**2 - inner**2) / (load * (outer**3 - inner**3))


@kernel
def side_of(speed: float) -> float:
    """Return the sign of a speed, 0 at rest."""
    return math.copysign(1.0, speed) if speed != 0.0 else 0.0


@kernel
def washer_outputs(m: WasherModel, pt: Point, q: Array, f: Fields, out: Array) -> bool:
    """Fill ``out`` (N_ALL,) from the fields evaluated at the solution; return True if finite.

    Source: Jackson & Green Eq 39-43 for film 1, with the weights of the balances.
    """
    n_r = m.n_r
    m_t = 3 * n_r - m.i_g
    torque, mean, area, hottest, fluid = 0.0, 0.0, 0.0, -1e300, 0.0
    dry = side_of(pt.speed) * f.small[L.FRICTION]
    for j in range(m.n_t):
        for i in range(n_r):
            k = j * n_r + i
            w = m.weight1[i] * m.weight_t[j]
            r = m.r[i]
            torque += w * r * (f.mu[k] * pt.speed * r / f.ht[k] + dry * f.pc[k])
            carrier, washer = f.temp[j * m_t + i], f.temp[j * m_t + n_r + i]
            mean += 0.5 * w * (carrier + washer)
            hottest = max(hottest, max(carrier, washer))
            fluid += w * f.p[k]
            area += w
    out[L.O_TORQUE] = torque
    out[L.O_MEAN] = pt.oil_temperature + mean / area
    out[L.O_PEAK] = pt.oil_temperature + max(hottest, mean / area)
    out[L.O_RATIO] = (q[Z_WASHER] - m.outer_radius * tilt_of(q)) / m.sigma1
    out[L.O_FILM] = out[L.O_RATIO] * m.sigma1
    out[L.O_FLUID_LOAD], out[L.O_CONTACT_LOAD] = fluid, f.small[L.CONTACT]
    out[L.O_FLUID_SHARE] = fluid / (fluid + f.small[L.CONTACT])
    ro, ri = m.outer_radius, m.inner_radius
    out[L.O_COEFFICIENT] = 1.5 * abs(torque) * (ro**2 - ri**2) / (pt.load * (ro**3 - ri**3))
    out[L.O_POWER] = torque * pt.speed
    return are_finite(out)


@kernel
def outputs_at(w: Workspace, pt: Point) -> bool:
    """Fill the outputs of ``w`` from its fields at the solution; return True if finite."""
    return washer_outputs(model_of(w), pt, w.q, fields_of(w), w.outputs)


@inlined
def change_of_outputs(
    m: WasherModel, pt: Point, change: Point, w: Workspace, f: Fields, dout: Array
) -> int:
    """Fill ``dout`` from the change of the state, CHANGE and ``f.keep[: n_temp]``; see `sens`."""
    n_r, m_t = m.n_r, 3 * m.n_r - m.i_g
    out, dq, dtemp = w.outputs, vector(f.small, L.CHANGE), f.keep[: f.temp.size]
    side, dcontact = side_of(pt.speed), contact_change(f.small, dq)
    friction = side * f.small[L.FRICTION]
    dfriction = side * f.small[L.FRICTION_SLOPE] * dcontact
    torque, mean, area, hottest, dhottest = 0.0, 0.0, 0.0, -1e300, 0.0
    for j in range(m.n_t):
        for i in range(n_r):
            k = j * n_r + i
            r = m.r[i]
            weight = m.weight1[i] * m.weight_t[j]
            dh = dq[Z_WASHER] + r * m.sin[j] * dq[TILT_X] - r * m.cos[j] * dq[TILT_Y]
            carrier, washer = f.temp[j * m_t + i], f.temp[j * m_t + n_r + i]
            dcarrier, dwasher = dtemp[j * m_t + i], dtemp[j * m_t + n_r + i]
            dmu = f.dmu[k] * (0.5 * (dcarrier + dwasher) + change.oil_temperature)
            shear = pt.speed * r / f.ht[k]
            torque += weight * r * (
                shear * (dmu - f.mu[k] * f.dht[k] * dh / f.ht[k])
                + f.mu[k] * change.speed * r / f.ht[k]
                + friction * f.dpc[k] * dh + dfriction * f.pc[k]
            )  # fmt: skip
            mean += 0.5 * weight * (dcarrier + dwasher)
            area += weight
            if max(carrier, washer) > hottest:
                hottest = max(carrier, washer)
                dhottest = dcarrier if carrier >= washer else dwasher
    dout[L.O_TORQUE] = torque
    dout[L.O_MEAN] = change.oil_temperature + mean / area
    peak = out[L.O_PEAK] > out[L.O_MEAN]
    dout[L.O_PEAK] = change.oil_temperature + (dhottest if peak else mean / area)
    dout[L.O_FILM] = film_thickness_change(m.outer_radius, w.q, dq)
    dout[L.O_RATIO] = dout[L.O_FILM] / m.sigma1
    # film and contact together carry the load
    dfluid = change.load - dcontact
    share = out[L.O_FLUID_SHARE]
    dout[L.O_FLUID_SHARE] = ((1.0 - share) * dfluid - share * dcontact) / pt.load
    per_torque = coefficient_per_torque(m.inner_radius, m.outer_radius, pt.load)
    dout[L.O_COEFFICIENT] = (
        per_torque * side_of(out[L.O_TORQUE]) * torque
        - out[L.O_COEFFICIENT] * change.load / pt.load
    )
    dout[L.O_POWER] = torque * pt.speed + out[L.O_TORQUE] * change.speed
    return OK if are_finite(dout) else NOT_FINITE
