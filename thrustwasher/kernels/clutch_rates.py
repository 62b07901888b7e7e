# mypy: disable-error-code="no-any-return"
"""How fast film and heat of an engaging pack change, with slopes for an implicit step."""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .clutch_friction import contact_slopes, viscous_slopes
from .film import INV_SQRT2, INV_SQRT2PI
from .squeeze import gap_flow

Array = NDArray[np.float64]
LEAST_CDF = 1e-3


@kernel
def film_rate(
    par: Array, pressure: float, u: float, carried: float, carried_slope: float,
    eta: float, eta_slope: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """Return du/dt [1/s] of the film ratio; slopes over u, temperature [1/(s K)] and pressure.

    The film carries what the asperities do not: d h_T/dt = cdf(u) dh/dt is what flows out between
    the rough faces and through the lining (Darcy). An open pack returns to its clearance. Where
    the faces overlap by more than 3 sigma the cdf is held: the film there follows in no time.
    """
    if pressure < L.OPEN_PRESSURE:
        return (par[L.D_OPEN_RATIO] - u) / L.OPENING_TIME, -1.0 / L.OPENING_TIME, 0.0, 0.0
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
    return rate, slope, -rate * eta_slope / eta, -ease * open_for


@kernel
def pack_rates(
    par: Array, load: float, slip: float, u: float, temperature: float
) -> tuple[float, float, float, float, float, float]:
    """Return (du/dt, its slopes over u and T, power of a face [W], its slopes over u and T)."""
    rates, _ = pack_slopes(par, load, slip, u, temperature)
    return rates


@kernel
def pack_slopes(
    par: Array, load: float, slip: float, u: float, temperature: float
) -> tuple[tuple[float, float, float, float, float, float], tuple[float, float, float]]:
    """Return what ``pack_rates`` does, and how it changes with the inputs.

    (du/dt, its slopes over u and T, power of a face [W], its slopes over u and T), then (slope of
    du/dt over the load, slopes of the power over load and |slip|).
    """
    contact, contact_u, contact_t, contact_s, contact_f, pressure, rise = contact_slopes(
        par, load, slip, u, temperature
    )
    viscous, viscous_u, viscous_t, viscous_s, eta, eta_slope, _, _ = viscous_slopes(
        par, slip, u, temperature
    )
    rate, rate_u, rate_t, rate_p = film_rate(
        par, load / par[L.D_AREA], u, pressure, rise, eta, eta_slope
    )
    faces, width = par[L.P_FACES], par[L.P_SPEED_SMOOTHING]
    speed = abs(slip) / faces
    smooth = math.tanh(abs(slip) / width)
    steep = (1.0 - smooth) * (1.0 + smooth) / width
    torque = contact * smooth + viscous
    by_slip = torque / faces + speed * (contact_s * smooth + contact * steep + viscous_s)
    return (
        rate, rate_u, rate_t, speed * torque,
        speed * (contact_u * smooth + viscous_u), speed * (contact_t * smooth + viscous_t),
    ), (rate_p / par[L.D_AREA], speed * contact_f * smooth, by_slip)  # fmt: skip
