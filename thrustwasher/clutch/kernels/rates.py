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
from ...tribology.flow_factors import gap_flow
from ...tribology.greenwood_tripp import contact_integral, normal_heights
from ...tribology.viscosities import straight_viscosity
from ...tribology.viscosity import viscosity
from . import layout as L
from .pack_friction import (
    Faces,
    Oil,
    coefficient_slopes,
    cooling_slope,
    pack_torques,
    rough_faces,
    share_of_load,
)

LEAST_CDF = 1e-3
MOST_TORN = 85.0  # times as fast as untorn oil lets them: no more


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
def ring_at(par: Array, k: int) -> int:
    """Return where the k-th ring's block begins in ``par``."""
    return int(par[L.D_FIRST]) + k * L.N_PACK


@kernel
def kept_of(work: Array, place: int, k: int) -> Array:
    """Return the k-th ring's numbers at the ``place``-th of W_KEPT (layout, R_POWER on)."""
    at = L.W_KEPT + place * L.N_RATES + L.R_RINGS + k * L.N_OF_RING
    return work[at : at + L.N_OF_RING]


@kernel
def n_unknowns(par: Array) -> int:
    """Return the number of a pack's unknowns."""
    return L.Y_HEAT + int(par[L.D_RINGS]) * (1 + int(par[L.D_MODES]))


@kernel
def groove_lift(par: Array, u: float, eta: float, slip: float) -> tuple[float, float, float, float]:
    """Return the mean pressure [Pa] by which grooves part the faces; slopes over u, eta, |slip|.

    Slip piles oil up before a land and draws it away behind: +- P/2 about that of the rims, and so
    nothing on average, until the oil behind is torn: it bears one atmosphere only. Derived in
    docs/theory/clutch/release.md.
    """
    thick = max(u, 0.0)
    deep = thick + par[L.D_GROOVE_RATIO]
    resists = deep * deep * deep + par[L.D_PAD_RATIO] * thick * thick * thick
    piled = par[L.D_LIFT] * eta * abs(slip) / resists
    if piled <= L.AMBIENT:
        return 0.0, 0.0, 0.0, 0.0
    share = par[L.D_LIFT_SHARE]
    steep = 0.0
    if u > 0.0:
        steep = -3.0 * (deep * deep + par[L.D_PAD_RATIO] * u * u) / resists * piled
    return (
        share * (piled - L.AMBIENT),
        share * steep,
        share * piled / eta,
        share * piled / abs(slip),
    )


@kernel
def torn(suction: float) -> tuple[float, float]:
    """Return how much faster [-] faces part than untorn oil lets them, and its slope [1/Pa].

    ``suction``: mean of the film's [Pa > 0]. A narrow pad's parabola reaches one atmosphere at a
    mean of 2/3 of it; from there on a cavity grows from its middle: 1/(9 (1 - q)^2) over 3 q/2, q
    the mean suction in atmospheres. The plates' mass, in series with it, lets it grow to MOST_TORN.
    Derived in docs/theory/clutch/release.md.
    """
    q = suction / L.AMBIENT
    if q <= 2.0 / 3.0:
        return 1.0, 0.0
    if q >= 1.0:
        return MOST_TORN, 0.0
    rest = 13.5 * q * (1.0 - q) * (1.0 - q)  # 1 over the massless plates' factor
    most = MOST_TORN - 1.0
    below = most * rest + 1.0 - rest
    slope = 13.5 * (1.0 - q) * (3.0 * q - 1.0)  # of -rest
    return 1.0 + most * (1.0 - rest) / below, most * most * slope / (below * below) / L.AMBIENT


@kernel
def film_rate(
    par: Array,
    pressure: float,
    u: float,
    carried: float,
    carried_slope: float,
    eta: float,
    slip: float,
    cdf: float,
    density: float,
) -> tuple[float, float, float, float, float, float]:
    """Return du/dt [1/s] of the film ratio; slopes over u, pressure, eta and |slip|; ``film_bend``.

    The film carries what the asperities do not: d h_T/dt = cdf(u) dh/dt is what flows out between
    the rough faces and through the lining (Darcy). Where the faces overlap by more than 3 sigma the
    cdf is held: the film there follows in no time. Where asperities press more than the load, the
    film draws in oil the same way, by suction. A pack that is not pressed is parted by its
    asperities, by springs and by its grooves until it has its clearance.
    """
    squeezed, squeezed_u, by_eta, by_slip = pressure - carried, -carried_slope, 0.0, 0.0
    opens = pressure < L.OPEN_PRESSURE
    if opens:
        lift, lift_u, by_eta, by_slip = groove_lift(par, u, eta, slip)
        lift += par[L.D_PARTING]
        left = 1.0 - u / par[L.D_OPEN_RATIO]
        squeezed = -carried - lift * left
        squeezed_u = -carried_slope - lift_u * left + lift / par[L.D_OPEN_RATIO]
        by_eta, by_slip = -by_eta * left, -by_slip * left
    flow, flow_slope = gap_flow(u)
    if cdf < LEAST_CDF:
        cdf, density = LEAST_CDF, 0.0
    bend = 0.0 if opens else _bend(par, flow, flow_slope, cdf, density)
    ease = par[L.D_CLOSING] / (eta * cdf)
    open_for = flow + par[L.D_SEEPAGE]
    gives = open_for
    if squeezed < 0.0:
        factor, steep = torn(-squeezed)
        gives *= factor - steep * squeezed
        open_for *= factor
        flow_slope *= factor
    rate = -ease * open_for * squeezed
    slope = -ease * (flow_slope * squeezed + gives * squeezed_u) - rate * density / cdf
    by_squeezed = -ease * gives
    by_eta = by_squeezed * by_eta - rate / eta
    return rate, slope, 0.0 if opens else by_squeezed, by_eta, by_squeezed * by_slip, bend


@kernel
def film_bend(par: Array, load: float, u: float) -> float:
    """Return how a closing film's ease of flow grows with the film ratio: a third of d ln/du.

    The ease is that of ``film_rate``: rate = ease x what the asperities leave to the film. 0 for a
    pack that opens, whose film follows no flow.
    """
    if not moves_film(par) or load < L.OPEN_PRESSURE * par[L.D_AREA]:
        return 0.0
    flow, slope = gap_flow(u)
    density, cdf, _ = normal_heights(u)
    if cdf < LEAST_CDF:
        cdf, density = LEAST_CDF, 0.0
    return _bend(par, flow, slope, cdf, density)


@kernel
def _bend(par: Array, flow: float, slope: float, cdf: float, density: float) -> float:
    """Return a closing film's ``film_bend`` from what ``film_rate`` has."""
    return max((slope / (flow + par[L.D_SEEPAGE]) - density / cdf) / 3.0, 0.0)


@kernel
def oil_of(work: Array, k: int) -> Oil:
    """Return what the oil of the k-th ring is, after ``fill_viscosities``."""
    return (
        work[np.uintp(L.W_SURFACE + k)],
        work[np.uintp(L.W_VISCOSITY + k)],
        work[np.uintp(L.W_VISCOSITY_SLOPE + k)],
    )


@kernel
def heat_slopes(
    par: Array,
    load: float,
    slip: float,
    drum: float,
    faces: Faces,
    smooth: float,
    oil: Oil,
) -> tuple[
    tuple[float, float, float, float, float, float],
    tuple[float, float, float],
    tuple[float, float],
]:
    """Return power, cooling of a pack of one temperature, their slopes, what moves its film.

    (power of a face [W], its slopes over u, T, load, |slip| and drum), (cooling of a face [W/K],
    its slopes over u and load), (pressure of the asperities [Pa], its slope over u). ``smooth``:
    tanh of the slip over its smoothing.
    """
    contact, viscous, carried, _ = pack_torques(par, load, slip, drum, faces, oil)
    number, width = par[L.P_FACES], par[L.P_SPEED_SMOOTHING]
    speed = abs(slip) / number
    steep = (1.0 - smooth) * (1.0 + smooth) / width
    torque = contact[0] * smooth + viscous[0]
    power = (
        speed * torque,
        speed * (contact[1] * smooth + viscous[1]),
        speed * (contact[2] * smooth + viscous[2]),
        speed * (contact[4] * smooth + viscous[5]),
        torque / number + speed * (contact[3] * smooth + contact[0] * steep + viscous[3]),
        speed * viscous[4],
    )
    cooling, over = cooling_slope(par, carried[0])
    cooling, over = cooling * par[L.D_AREA], over * par[L.D_AREA]
    return power, (cooling, over * carried[1], over * carried[2]), (carried[3], carried[4])


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
    power: tuple[float, float, float, float, float, float],
    cooling: tuple[float, float, float],
    share: float,
    slip: float,
    at: int,
    work: Array,
) -> None:
    """Store power and cooling of a ring, which has this share of the load, and their slopes."""
    for i in range(3):
        work[np.uintp(at + L.R_POWER + i)] = power[i]
    work[np.uintp(at + L.R_POWER_F)] = power[3] * share
    work[np.uintp(at + L.R_POWER_S)] = power[4] * sign_of(slip)
    work[np.uintp(at + L.R_POWER_D)] = power[5]
    work[np.uintp(at + L.R_COOL)], work[np.uintp(at + L.R_COOL_U)] = cooling[0], cooling[1]
    work[np.uintp(at + L.R_COOL_F)] = cooling[2] * share


@kernel
def settled_cooling(par: Array, load: float) -> float:
    """Return how well a face is cooled [W/(m2 K)] where the film is settled, or the pack open."""
    return cooling_slope(par, 1.0 if load >= L.OPEN_PRESSURE * par[L.D_AREA] else 0.0)[0]


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
    power = (speed * mu * load, 0.0, speed * mu_t * load, speed * mu, by_slip, 0.0)
    cooling = settled_cooling(par, load) * ring[L.D_AREA]
    _keep(power, (cooling, 0.0, 0.0), 1.0, slip, at, work)
    work[np.uintp(at + L.R_RATE_T)] = 0.0


@kernel
def pack_rates(
    par: Array, load: float, slip: float, drum: float, u: float, work: Array, to: int
) -> None:
    """Fill ``work[to:]`` with film rate, powers, cooling and their slopes (layout, R_RATE on).

    ``u``: film ratio; the rings' temperatures are those in W_SURFACE.
    """
    at = to + L.R_RINGS
    given, rings = work[L.W_GIVEN] != 0.0, int(par[L.D_RINGS])
    if moves_film(par):
        if given:
            _given_heat(par, load, slip, u, work, to)
        else:
            _own_heat(par, load, slip, drum, u, work, to)
        return
    work[L.W_BEND_HERE] = 0.0
    for k in range(rings):
        _settled_power(par, load, slip, k, at + k * L.N_OF_RING, work)
    for i in range(L.R_RINGS):
        work[np.uintp(to + i)] = 0.0
    if given:
        for k in range(rings):
            _give_power(work, slip, k, at + k * L.N_OF_RING)


@kernel
def fill_viscosities(par: Array, work: Array) -> None:
    """Fill W_VISCOSITY and the slopes behind it at the temperatures in W_SURFACE.

    Several rings in whole groups of four, which go side by side: those that a pack does not have
    count for nothing.
    """
    scale, constant = par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_CONSTANT]
    exponent = par[L.P_VISCOSITY_EXPONENT]
    if par[L.D_RINGS] == 1.0:
        eta, slope = viscosity(work[L.W_SURFACE], scale, constant, exponent)
        work[L.W_VISCOSITY], work[L.W_VISCOSITY_SLOPE] = eta, slope
        return
    for k in range(4 * ((int(par[L.D_RINGS]) + 3) // 4)):
        warmth = work[np.uintp(L.W_SURFACE + k)]
        eta, slope = straight_viscosity(warmth, scale, constant, exponent)
        work[np.uintp(L.W_VISCOSITY + k)] = eta
        work[np.uintp(L.W_VISCOSITY_SLOPE + k)] = slope


@kernel
def _own_heat(
    par: Array, load: float, slip: float, drum: float, u: float, work: Array, to: int
) -> None:
    """Fill ``work[to:]`` as ``pack_rates`` where the film is a state and the heat the pack's."""
    at, pressure, rise = to + L.R_RINGS, 0.0, 0.0
    fill_viscosities(par, work)
    faces, smooth = rough_faces(u), math.tanh(abs(slip) / par[L.P_SPEED_SMOOTHING])
    for k in range(int(par[L.D_RINGS])):
        ring = ring_of(par, k)
        share = ring[L.D_AREA] / par[L.D_AREA]
        oil = oil_of(work, k)
        power, cooling, (pressure, rise) = heat_slopes(
            ring, load * share, slip, drum, faces, smooth, oil
        )
        _keep(power, cooling, share, slip, at + k * L.N_OF_RING, work)
    _film_of_rings(par, load, slip, u, (pressure, rise, faces[5], faces[6]), work, to)


@kernel
def _given_heat(par: Array, load: float, slip: float, u: float, work: Array, to: int) -> None:
    """Fill ``work[to:]`` as ``pack_rates`` where the film is a state and the heat is given."""
    at = to + L.R_RINGS
    fill_viscosities(par, work)
    height, slope = contact_integral(u)
    density, cdf, _ = normal_heights(u)
    share, share_u, share_f, pressure, rise = share_of_load(par, load, height, slope)
    cooling, over = cooling_slope(par, share)
    for k in range(int(par[L.D_RINGS])):
        place, area = at + k * L.N_OF_RING, par[np.uintp(ring_at(par, k) + L.D_AREA)]
        _give_power(work, slip, k, place)
        work[np.uintp(place + L.R_COOL)] = cooling * area
        work[np.uintp(place + L.R_COOL_U)] = over * area * share_u
        work[np.uintp(place + L.R_COOL_F)] = over * area * share_f
    _film_of_rings(par, load, slip, u, (pressure, rise, cdf, density), work, to)


@kernel
def _film_of_rings(
    par: Array,
    load: float,
    slip: float,
    u: float,
    carried: tuple[float, float, float, float],
    work: Array,
    to: int,
) -> None:
    """Fill the film's rate and slopes in ``work[to:]``; the viscosities are in W_VISCOSITY.

    ``carried``: pressure of the asperities [Pa], its slope over u, share of heights below u, their
    density there. An open film follows the first ring's viscosity, whatever the others'.
    """
    pressure, rise, cdf, density = carried
    at, rings, first = to + L.R_RINGS, int(par[L.D_RINGS]), work[L.W_VISCOSITY]
    film = film_rate(par, load / par[L.D_AREA], u, pressure, rise, first, slip, cdf, density)
    own = (film[3] + film[0] / first) * work[L.W_VISCOSITY_SLOPE]
    mean = 0.0
    for k in range(rings):
        mean += par[np.uintp(L.D_SQUEEZE + k)] * work[np.uintp(L.W_VISCOSITY + k)]
    thick = first / mean
    rate = film[0] * thick
    for k in range(rings):
        weight = par[np.uintp(L.D_SQUEEZE + k)] * work[np.uintp(L.W_VISCOSITY_SLOPE + k)]
        work[np.uintp(at + k * L.N_OF_RING + L.R_RATE_T)] = -rate * weight / mean
    if load < L.OPEN_PRESSURE * par[L.D_AREA]:
        work[np.uintp(at + L.R_RATE_T)] += own * thick
    work[np.uintp(to + L.R_RATE)], work[np.uintp(to + L.R_RATE_U)] = rate, film[1] * thick
    work[np.uintp(to + L.R_RATE_F)] = film[2] / par[L.D_AREA] * thick
    work[np.uintp(to + L.R_RATE_S)] = film[4] * sign_of(slip) * thick
    work[L.W_BEND_HERE] = film[5]


@kernel
def given_power(work: Array, slip: float) -> float:
    """Return the power of a face [W] that is given, at a slip [rad/s]."""
    return work[L.W_GIVEN_POWER] + work[L.W_GIVEN_SLOPE] * slip


@kernel
def _give_power(work: Array, slip: float, k: int, place: int) -> None:
    """Put a ring's share of the power that is given at ``work[place:]``."""
    share = work[np.uintp(L.W_RING_SHARE + k)]
    for i in range(L.R_POWER, L.R_POWER_D + 1):
        work[np.uintp(place + i)] = 0.0
    work[np.uintp(place + L.R_POWER)] = share * given_power(work, slip)
    work[np.uintp(place + L.R_POWER_S)] = share * work[L.W_GIVEN_SLOPE]


@kernel
def add_heat(par: Array, work: Array, heat: float) -> None:
    """Give a face heat [J] at once, in W_NOW, shared as a power that is given."""
    work[np.uintp(L.W_NOW + L.Y_ENERGY)] += heat
    n = 1 + int(par[L.D_MODES])
    for k in range(int(par[L.D_RINGS])):
        ring, own = ring_of(par, k), heat * work[np.uintp(L.W_RING_SHARE + k)]
        for i in range(n):
            place = np.uintp(L.W_NOW + L.Y_HEAT + k * n + i)
            work[place] += ring[np.uintp(L.D_GAIN + i)] * own


@kernel
def share_power(par: Array, load: float, slip: float, drum: float, u: float, work: Array) -> None:
    """Fill the rings' shares in a power that is given: as they would share their own now."""
    rings, total = int(par[L.D_RINGS]), 0.0
    work[L.W_RING_SHARE] = 1.0
    if rings == 1:
        return
    work[L.W_GIVEN] = 0.0
    surfaces(par, work, L.W_NOW, L.W_SURFACE)
    pack_rates(par, load, slip, drum, u, work, L.W_NEIGHBOUR)
    for k in range(rings):
        total += kept_of(work, L.NEIGHBOUR, k)[L.R_POWER]
    for k in range(rings):
        ring, own = ring_of(par, k), kept_of(work, L.NEIGHBOUR, k)[L.R_POWER]
        share = own / total if total > 0.0 else ring[L.D_AREA] / par[L.D_AREA]
        work[np.uintp(L.W_RING_SHARE + k)] = share
