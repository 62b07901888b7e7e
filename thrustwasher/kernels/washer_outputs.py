"""From a converged state to the numbers a user sees."""

import math

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .washer_fields import Bench, Fields, Point, washer_fields
from .washer_gap import CONTACT, FRICTION
from .washer_model import WasherModel, washer_model

# real outputs, in the order of the model's list, then what only Python shows
TORQUE, MEAN_TEMPERATURE, FILM_THICKNESS, MAX_TEMPERATURE, RATIO = 0, 1, 2, 3, 4
FLUID_SHARE, COEFFICIENT, POWER, N_REAL = 5, 6, 7, 8
FLUID_LOAD, CONTACT_LOAD, N_ALL = 8, 9, 10


@kernel
def washer_outputs(
    m: WasherModel, pt: Point, q: NDArray[np.float64], f: Fields, out: NDArray[np.float64]
) -> bool:
    """Fill ``out`` (N_ALL,) from the fields evaluated at the solution; return True if finite.

    Source: Jackson & Green Eq 39-43 for film 1, with the weights of the balances.
    """
    n_r = m.n_r
    m_t = 3 * n_r - m.i_g
    torque, mean, area, hottest, fluid = 0.0, 0.0, 0.0, -1e300, 0.0
    side = 0.0
    if pt.speed != 0.0:
        side = math.copysign(1.0, pt.speed)
    dry = side * f.small[FRICTION]
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
    out[TORQUE] = torque
    out[MEAN_TEMPERATURE] = pt.oil_temperature + mean / area
    out[MAX_TEMPERATURE] = pt.oil_temperature + max(hottest, mean / area)
    tilt = math.sqrt(q[2] * q[2] + q[3] * q[3])
    out[RATIO] = (q[0] - m.outer_radius * tilt) / m.sigma1
    out[FILM_THICKNESS] = out[RATIO] * m.sigma1
    out[FLUID_LOAD], out[CONTACT_LOAD] = fluid, f.small[CONTACT]
    out[FLUID_SHARE] = fluid / (fluid + f.small[CONTACT])
    ro, ri = m.outer_radius, m.inner_radius
    out[COEFFICIENT] = 1.5 * abs(torque) * (ro**2 - ri**2) / (pt.load * (ro**3 - ri**3))
    out[POWER] = torque * pt.speed
    good = True
    for k in range(N_ALL):
        good = good and math.isfinite(out[k])
    return good


@kernel
def outputs_at(b: Bench, pt: Point, q: NDArray[np.float64], out: NDArray[np.float64]) -> bool:
    """Fill ``out`` (N_ALL,) from the fields in ``b`` at the solution q; return True if finite."""
    m = washer_model(b.par)
    return washer_outputs(m, pt, q, washer_fields(m, b.work), out)
