# mypy: disable-error-code="no-any-return"
"""How fast film and heat of an engaging pack change, with slopes for an implicit step.

A pack is one ring or several, each with its own slip speed, heat and temperature. The plates are
stiff: one film thickness and one pressure. Each ring is a pack by its own block of ``par``
(clutch_constants); the film is squeezed out against the rings' mean viscosity.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from ...tribology.flow_factors import INV_SQRT2, INV_SQRT2PI, gap_flow
from . import layout as L
from .pack_friction import coefficient_slopes, contact_slopes, viscous_slopes

LEAST_CDF = 1e-3


@kernel
def moves_film(par: Array) -> bool:
    """Tell if the film is a state; else it is settled and its shear left out."""
    return par[L.P_FIDELITY] >= L.FIELD and par[L.P_FILM_DYNAMICS] != 0.0


@kernel
def ring_of(par: Array, k: int) -> Array:
    """Return the k-th ring's block of ``par``."""
    first = int(par[L.D_FIRST]) + k * L.N_PACK
    return par[first : first + L.N_PACK]


@kernel
def n_unknowns(par: Array) -> int:
    """Return the number of a pack's unknowns."""
    return L.Y_HEAT + int(par[L.D_RINGS]) * (1 + int(par[L.D_MODES]))


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
def pack_slopes(
    par: Array, load: float, slip: float, u: float, temperature: float
) -> tuple[
    tuple[float, float, float, float, float, float], tuple[float, float, float], float, float
]:
    """Return the rates of a pack of one temperature, and how they change with the inputs.

    (du/dt, its slopes over u and T, power of a face [W], its slopes over u and T), then (slope of
    du/dt over the load, slopes of the power over load and |slip|), viscosity and its slope.
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
    rates = (
        rate, rate_u, rate_t, speed * torque,
        speed * (contact_u * smooth + viscous_u), speed * (contact_t * smooth + viscous_t),
    )  # fmt: skip
    return rates, (rate_p / par[L.D_AREA], speed * contact_f * smooth, by_slip), eta, eta_slope


@kernel
def surfaces(par: Array, work: Array, base: int, to: int) -> None:
    """Fill ``work[to:]`` with the interface temperatures, or their changes, of the unknowns.

    A ring's is its plate's mean temperature and the modes on top of it; ``base``: the place of the
    unknowns, or of their changes.
    """
    place = base + L.Y_HEAT
    for k in range(int(par[L.D_RINGS])):
        total = work[np.uintp(place)]
        for i in range(int(par[L.D_MODES])):
            total += work[np.uintp(place + 1 + i)]
        place += 1 + int(par[L.D_MODES])
        work[np.uintp(to + k)] = total


@kernel
def _keep(
    found: tuple[float, float, float, float, float, float], by: tuple[float, float, float],
    slip: float, at: int, work: Array,
) -> None:  # fmt: skip
    """Store the power of a ring and its slopes."""
    work[np.uintp(at + L.R_POWER)] = found[3]
    work[np.uintp(at + L.R_POWER_U)], work[np.uintp(at + L.R_POWER_T)] = found[4], found[5]
    work[np.uintp(at + L.R_POWER_F)], work[np.uintp(at + L.R_POWER_S)] = (
        by[1],
        by[2] * sign_of(slip),
    )


@kernel
def _settled_power(par: Array, load: float, slip: float, k: int, at: int, work: Array) -> None:
    """Store the power of a ring and its slopes where the film is settled."""
    ring = ring_of(par, k)
    mu, mu_t, mu_s = coefficient_slopes(ring, slip, work[np.uintp(L.W_SURFACE + k)])
    lever = ring[L.D_RADIUS] * ring[L.D_AREA] / par[L.D_AREA]
    width = par[L.P_SPEED_SMOOTHING]
    smooth = math.tanh(abs(slip) / width)
    steep = (1.0 - smooth) * (1.0 + smooth) / width
    speed = abs(slip) * smooth * lever
    by_slip = lever * load * (smooth * mu + abs(slip) * (steep * mu + smooth * mu_s))
    found = (0.0, 0.0, 0.0, speed * mu * load, 0.0, speed * mu_t * load)
    _keep(found, (0.0, speed * mu, by_slip), slip, at, work)
    work[np.uintp(at + L.R_RATE_T)] = 0.0


@kernel
def _rates_in_rings(par: Array, load: float, slip: float, u: float, work: Array, to: int) -> None:
    """Do what ``pack_rates`` says for a pack in rings."""
    rate, rate_u, rate_f, mean, first = 0.0, 0.0, 0.0, 0.0, 1.0
    at, rings = to + L.R_RINGS, int(par[L.D_RINGS])
    moves = moves_film(par)
    for k in range(rings):
        if not moves:
            _settled_power(par, load, slip, k, at + k * L.N_OF_RING, work)
            continue
        ring = ring_of(par, k)
        share, weight = ring[L.D_AREA] / par[L.D_AREA], par[np.uintp(L.D_SQUEEZE + k)]
        found, by, eta, eta_t = pack_slopes(
            ring, load * share, slip, u, work[np.uintp(L.W_SURFACE + k)]
        )
        _keep(found, (by[0] * share, by[1] * share, by[2]), slip, at + k * L.N_OF_RING, work)
        work[np.uintp(at + k * L.N_OF_RING + L.R_RATE_T)] = weight * eta_t
        mean += weight * eta
        if k == 0:
            first, rate, rate_u, rate_f = eta, found[0], found[1], by[0] * share
    if moves:
        opens = load < L.OPEN_PRESSURE * par[L.D_AREA]
        thick = 1.0 if opens else first / mean
        rate, rate_u, rate_f = rate * thick, rate_u * thick, rate_f * thick
        for k in range(rings):
            place = np.uintp(at + k * L.N_OF_RING + L.R_RATE_T)
            work[place] = 0.0 if opens else -rate * work[place] / mean
    work[np.uintp(to + L.R_RATE)] = rate
    work[np.uintp(to + L.R_RATE_U)], work[np.uintp(to + L.R_RATE_F)] = rate_u, rate_f


@kernel
def pack_rates(par: Array, load: float, slip: float, u: float, work: Array, to: int) -> None:
    """Fill ``work[to:]`` with film rate, powers and their slopes (clutch_layout, R_RATE on).

    ``u``: film ratio; the rings' temperatures are those in W_SURFACE.
    """
    if par[L.D_FIRST] != 0.0:
        _rates_in_rings(par, load, slip, u, work, to)
        return
    found, by, _, _ = pack_slopes(par, load, slip, u, work[L.W_SURFACE])
    _keep(found, by, slip, to + L.R_RINGS, work)
    work[np.uintp(to + L.R_RINGS + L.R_RATE_T)] = found[2]
    work[np.uintp(to + L.R_RATE)] = found[0]
    work[np.uintp(to + L.R_RATE_U)], work[np.uintp(to + L.R_RATE_F)] = found[1], by[0]
