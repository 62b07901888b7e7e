# mypy: disable-error-code="no-any-return"
"""How fast film and heat of an engaging pack change, with slopes for an implicit step."""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_friction import contact_torque, viscous_torque
from .film import INV_SQRT2, INV_SQRT2PI
from .squeeze import gap_flow

Array = NDArray[np.float64]
LEAST_CDF = 1e-3


@kernel
def film_rate(
    par: Array, pressure: float, u: float, carried: float, carried_slope: float,
    eta: float, eta_slope: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Return du/dt [1/s] of the film ratio and its slopes over u and over temperature [1/(s K)].

    The film carries what the asperities do not: d h_T/dt = cdf(u) dh/dt is what flows out between
    the rough faces and through the lining (Darcy). An open pack returns to its clearance. Where
    the faces overlap by more than 3 sigma the cdf is held: the film there follows in no time.
    """
    if pressure < L.OPEN_PRESSURE:
        return (par[L.D_OPEN_RATIO] - u) / L.OPENING_TIME, -1.0 / L.OPENING_TIME, 0.0
    flow, flow_slope = gap_flow(u)
    cdf = 0.5 * math.erfc(-max(u, -30.0) * INV_SQRT2)
    cdf_slope = INV_SQRT2PI * math.exp(-0.5 * min(u * u, 1400.0))
    if cdf < LEAST_CDF:
        cdf, cdf_slope = LEAST_CDF, 0.0
    ease = par[L.D_CLOSING] / (eta * cdf)
    open_for = flow + par[L.D_SEEPAGE]
    squeezed = pressure - carried
    rate = -ease * open_for * squeezed
    slope = -ease * (flow_slope * squeezed - open_for * carried_slope) - rate * cdf_slope / cdf
    return rate, slope, -rate * eta_slope / eta


@kernel
def pack_rates(
    par: Array, load: float, slip: float, u: float, temperature: float
) -> tuple[float, float, float, float, float, float]:
    """Return (du/dt, its slopes over u and T, power of a face [W], its slopes over u and T)."""
    contact, contact_u, contact_t, pressure, rise = contact_torque(par, load, slip, u, temperature)
    viscous, viscous_u, viscous_t, eta, eta_slope, _ = viscous_torque(par, slip, u, temperature)
    rate, rate_u, rate_t = film_rate(par, load / par[L.D_AREA], u, pressure, rise, eta, eta_slope)
    speed = abs(slip) / par[L.P_FACES]
    smooth = math.tanh(abs(slip) / par[L.P_SPEED_SMOOTHING])
    return (
        rate, rate_u, rate_t, speed * (contact * smooth + viscous),
        speed * (contact_u * smooth + viscous_u), speed * (contact_t * smooth + viscous_t),
    )  # fmt: skip
