# mypy: disable-error-code="no-any-return"
"""What resists in a pack: boundary friction of the asperities and shear of the oil between them.

Boundary friction is adhesion and ploughing after Wang, Wei & Wu (2012).
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.status import OK
from ...tribology.flow_factors import INV_SQRT2PI, mean_gap
from ...tribology.greenwood_tripp import (
    area_integrals,
    areas_of,
    contact_integral,
    normal_heights,
    separation_and_slope,
)
from ...tribology.viscosity import viscosity
from . import layout as L

FILM, MIXED, BOUNDARY, ADHESIVE = range(1, 5)  # regimes
SERIES_LIMIT = 0.5  # below it the ploughing term is summed, above it the closed form is safe
N_TERMS = 40  # 0.25^40 < 1e-24
# F_5/2 and its slope, F_2, F_1, mean gap over roughness, share of the area where the mean planes do
# not overlap, the density of heights there, share of oil that is sheared and its log slope.
Faces = tuple[float, float, float, float, float, float, float, float, float]
Oil = tuple[float, float, float]  # temperature [K], viscosity [Pa s], its slope [Pa s/K]
SETTLED = 1.0 - 1e-11  # share of the load from which on asperities carry it all


@kernel
def shear_slopes(par: Array, slip: float, temperature: float) -> tuple[float, float, float]:
    """Return the shear ratio s/s_m [-] and its slopes over temperature [1/K] and |slip| [s/rad].

    The temperature acts by ``shear_temperature_slope`` (0: not at all); the ratio stays in 0 .. 1.
    """
    ratio, steepness = shear_and_slope(
        abs(slip) * par[L.D_RADIUS],
        par[L.P_SHEAR_FLOOR],
        par[L.P_STICK_SPEED],
        par[L.P_DECAY_SPEED],
        par[L.P_KINK_WIDTH],
    )
    steepness *= par[L.D_RADIUS]
    slope = par[L.P_SHEAR_TEMPERATURE_SLOPE]
    if slope == 0.0:
        return ratio, 0.0, steepness
    factor = 1.0 + slope * (temperature - par[L.P_REFERENCE_TEMPERATURE])
    warm = ratio * factor
    if warm >= 1.0 or warm <= 0.0:
        return (1.0 if warm >= 1.0 else 0.0), 0.0, 0.0
    return warm, ratio * slope, factor * steepness


@kernel
def tabled(par: Array, speed: float) -> tuple[float, float]:
    """Return the coefficient [-] of the table at a slip speed [m/s], and its slope [s/m].

    Straight between the points; beyond the last one its value holds. The slope jumps at the points:
    there it is that above.
    """
    low, value = 0.0, par[L.P_TABLE_FRICTION_0]
    for k in range(L.N_TABLE):
        high = par[np.uintp(L.P_TABLE_SPEED_1 + 2 * k)]
        after = par[np.uintp(L.P_TABLE_FRICTION_1 + 2 * k)]
        if speed < high:
            rise, width = after - value, high - low
            return value + rise * (speed - low) / width, rise / width
        low, value = high, after
    return value, 0.0


@kernel
def point_friction(par: Array, temperature: float) -> tuple[float, float]:
    """Return the coefficient [-] of the points over temperature, and its slope [1/K].

    Straight between the points, the ends held. At a point the slope is that above.
    """
    low, value = par[L.P_POINT_TEMPERATURE_1], par[L.P_POINT_FRICTION_1]
    if temperature < low:
        return value, 0.0
    for k in range(1, int(par[L.D_POINTS])):
        high = par[np.uintp(L.P_POINT_TEMPERATURE_1 + 2 * k)]
        after = par[np.uintp(L.P_POINT_FRICTION_1 + 2 * k)]
        if temperature < high:
            rise, width = after - value, high - low
            return value + rise * (temperature - low) / width, rise / width
        low, value = high, after
    return value, 0.0


@kernel
def temperature_factor(par: Array, temperature: float) -> tuple[float, float]:
    """Return friction over that at ``reference_temperature`` [-], and its slope [1/K].

    By ``friction_temperature``: exp(slope (T - reference)), T within TEMPERATE; or the points.
    """
    if par[L.D_TEMPERATURE_LAW] == L.POINTS_LAW:
        value, rise = point_friction(par, temperature)
        return value / par[L.D_POINT_REFERENCE], rise / par[L.D_POINT_REFERENCE]
    if par[L.D_TEMPERATURE_LAW] == L.SLOPE_LAW:
        slope = par[L.P_FRICTION_TEMPERATURE_SLOPE]
        within = min(max(temperature, L.TEMPERATE[0]), L.TEMPERATE[1])
        factor = math.exp(slope * (within - par[L.P_REFERENCE_TEMPERATURE]))
        return factor, slope * factor if within == temperature else 0.0
    return 1.0, 0.0


@kernel
def coefficient_slopes(par: Array, slip: float, temperature: float) -> tuple[float, float, float]:
    """Return the coefficient of boundary friction [-], its slopes over temperature and |slip|.

    Every law is that of ``reference_temperature``; ``temperature_factor`` changes it.
    """
    factor, steep = temperature_factor(par, temperature)
    scale, change = par[L.P_FRICTION_SCALE] * factor, par[L.P_FRICTION_SCALE] * steep
    if par[L.P_FIDELITY] == L.CLOSED or par[L.P_FRICTION_LAW] == L.CONSTANT_LAW:
        mu = par[L.D_CONSTANT]
        return scale * mu, change * mu, 0.0
    if par[L.P_FRICTION_LAW] == L.TABLE_LAW:
        mu, steepness = tabled(par, abs(slip) * par[L.D_RADIUS])
        return scale * mu, change * mu, scale * steepness * par[L.D_RADIUS]
    ratio, warmer, steepness = shear_slopes(par, slip, temperature)
    adhesion = scale * par[L.D_ADHESION]
    mu = scale * par[L.D_PLOUGH] + adhesion * ratio
    by_t = adhesion * warmer + change * (par[L.D_PLOUGH] + par[L.D_ADHESION] * ratio)
    return mu, by_t, adhesion * steepness


@kernel
def settled_slope(par: Array, load: float, guess: float) -> tuple[float, float, int, int]:
    """Return the film ratio where the asperities carry all, its slope over the load [1/N].

    With them status and number of iterations. A pack pressed less than OPEN_PRESSURE is open.
    """
    pressure = load / par[L.D_AREA]
    if pressure < L.OPEN_PRESSURE:
        return par[L.D_OPEN_RATIO], 0.0, OK, 0
    carried = par[L.D_PRESSURE] * par[L.P_LAND_SHARE]
    ratio, slope, status, iterations = separation_and_slope(pressure / carried, guess)
    return ratio, slope / load, status, iterations


@kernel
def rough_faces(u: float) -> Faces:
    """Return what two rough faces are at the film ratio ``u``, the same for all rings of a pack."""
    height, rise = contact_integral(u)
    density, cdf, above = normal_heights(u)
    second, first = areas_of(u, density, above)
    gap = u * cdf + density if u >= -30.0 else mean_gap(u, 1.0)[0]
    sheared, steep = sheared_share(cdf, u)
    return height, rise, second, first, gap, cdf, density, sheared, steep


@kernel
def load_share(par: Array, load: float, u: float) -> tuple[float, float, float, float, float]:
    """Return ``share_of_load`` at the film ratio ``u``."""
    height, slope = contact_integral(u)
    return share_of_load(par, load, height, slope)


@kernel
def share_of_load(
    par: Array, load: float, height: float, slope: float
) -> tuple[float, float, float, float, float]:
    """Return the share L [-] of the load that asperities carry; slopes. ``height``: F_5/2.

    (L, dL/du, dL/dload, their pressure over the whole face [Pa], its slope over u). They never
    carry more than the load. A pack pressed with less than OPEN_PRESSURE counts as pressed with
    more, without load as with one atmosphere, the most that suction presses its asperities with.
    """
    scale = par[L.D_PRESSURE] * par[L.P_LAND_SHARE]
    pressure, rise = scale * height, scale * slope
    whole = load / par[L.D_AREA]
    least, steep = whole, 1.0 / par[L.D_AREA]
    if whole < L.OPEN_PRESSURE:
        steep *= 1.0 - L.AMBIENT / L.OPEN_PRESSURE
        least = L.AMBIENT + steep * load
    if pressure >= least * SETTLED:
        return 1.0, 0.0, 0.0, pressure, rise
    share = pressure / least
    by_load = -share / load if whole >= L.OPEN_PRESSURE else -share * steep / least
    return share, rise / least, by_load, pressure, rise


@kernel
def cooling_slope(par: Array, share: float) -> tuple[float, float]:
    """Return how well a face is cooled [W/(m2 K)] and its slope over the share L; it is linear.

    Oil in the grooves cools a closed face, oil all over an open one; a given supply warms up on its
    way through the pack and takes no more than that.
    """
    steep = par[L.D_CLOSED_COOLING] - par[L.P_HEAT_TRANSFER]
    h, supply = par[L.P_HEAT_TRANSFER] + steep * share, par[L.D_OIL_COOLING]
    if supply > 0.0:
        used = -math.expm1(-min(h / supply, 700.0))
        return supply * used, steep * (1.0 - used)
    return h, steep


@kernel
def pack_torques(
    par: Array, load: float, slip: float, drum: float, faces: Faces, oil: Oil
) -> tuple[
    tuple[float, float, float, float, float],
    tuple[float, float, float, float, float, float],
    tuple[float, float, float, float, float],
    tuple[float, float],
]:
    """Return the torques [N m >= 0] of asperities and oil, with slopes, and what they come from.

    Asperities: (torque, d/du, d/dT [N m/K], d/d|slip|, d/dload); oil: the same and d/ddrum; then
    ``load_share``; (share of the area in contact, its d/du).

    The law of friction is that of a settled pack, shear of its oil included: shear beside it counts
    for the load that asperities do not carry. All of it counts where the law is that of the
    asperities alone. Where the faces part, the film's suction presses asperities too.
    """
    carried = share_of_load(par, load, faces[0], faces[1])
    share, share_u, share_f, pressure, rise = carried
    mu, mu_t, mu_s = coefficient_slopes(par, slip, oil[0])
    lever, whole = par[L.P_FACES] * par[L.D_RADIUS], load / par[L.D_AREA]
    normal, normal_u, grows = lever * share * load, lever * share_u * load, 0.0
    if share >= 1.0 or whole < L.OPEN_PRESSURE:
        normal, normal_u = lever * pressure * par[L.D_AREA], lever * rise * par[L.D_AREA]
        if pressure > whole + L.AMBIENT:
            normal, normal_u, grows = lever * (load + L.AMBIENT * par[L.D_AREA]), 0.0, lever
    contact = (normal * mu, mu * normal_u, normal * mu_t, normal * mu_s, mu * grows)
    full, by_u, by_t, by_s, by_d, area, area_u = viscous_between(par, slip, drum, faces, oil)
    if par[L.P_FRICTION_DATA] == L.BOUNDARY_DATA:
        return contact, (full, by_u, by_t, by_s, by_d, 0.0), carried, (area, area_u)
    rest = 1.0 - share
    shear = (
        rest * full,
        rest * by_u - share_u * full,
        rest * by_t,
        rest * by_s,
        rest * by_d,
        -share_f * full,
    )
    return contact, shear, carried, (area, area_u)


@kernel
def contact_share(par: Array, u: float) -> tuple[float, float]:
    """Return ``share_in_contact`` at the film ratio ``u``."""
    second, first = area_integrals(u)
    return share_in_contact(par, second, first)


@kernel
def share_in_contact(par: Array, second: float, first: float) -> tuple[float, float]:
    """Return the share of the nominal area in contact [-] and its slope over the film ratio.

    ``second``, ``first``: F_2, F_1. Source: Greenwood & Tripp 1971, pi^2 (N beta sigma)^2 F_2(u),
    cut at 1: for a soft lining the group is ten times the usual and the formula leaves its range.
    """
    share = par[L.D_CONTACT_AREA] * second
    if share >= 1.0:
        return 1.0, 0.0
    return share, -2.0 * par[L.D_CONTACT_AREA] * first


@kernel
def shear_thinned(nahme: float) -> tuple[float, float]:
    """Return shear stress over that of oil as warm as the faces, and its slope in logarithms.

    Couette flow that heats itself between faces of one temperature, viscosity falling as
    exp(-b T): asinh(a)/(a sqrt(1 + a^2)) with a^2 = Na/8, Na = b eta V^2/k the Nahme number.
    Source: Gavis & Laurence 1968; derived in docs/theory/clutch.md.
    """
    square = 0.125 * nahme
    if square < 1e-6:
        return 1.0 - 2.0 / 3.0 * square, -2.0 / 3.0 * square
    a = math.sqrt(square)
    root = math.sqrt(1.0 + square)
    arc = math.log(a + root)
    return arc / (a * root), 0.5 * (a / (arc * root) - 1.0 - square / (1.0 + square))


@kernel
def sheared_share(cdf: float, u: float) -> tuple[float, float]:
    """Return the share [-] of oil that is sheared where faces overlap, and its log slope over u.

    1 for u >= 0. Below, the mean planes overlap: oil is left in cdf(u) of the area only, under a
    mean gap h_T/cdf, so shear goes as cdf^2/h_T and vanishes, while 1/h_T alone would explode. The
    factor 12 cdf^2 - 16 cdf^3 (a smoothstep of 2 cdf) has that limit and a continuous slope at
    u = 0. Chosen here.
    """
    if u >= 0.0:
        return 1.0, 0.0
    z = 2.0 * cdf
    slope = 2.0 * INV_SQRT2PI * math.exp(-0.5 * min(u * u, 900.0))
    return z * z * (3.0 - 2.0 * z), 6.0 * (1.0 - z) / (z * (3.0 - 2.0 * z)) * slope


@kernel
def filled_share(
    par: Array, slip: float, drum: float, gap: float, eta: float
) -> tuple[float, float, float]:
    """Return the filled share [-] of an open gap and its log slopes over slip and drum speed.

    The gap is full while the supply covers what centrifugal force pumps through it, from there on
    in the proportion of the two: air fills the rest. Oil turns with the drum on one side of the
    gap and with the hub on the other. Derived in docs/theory/clutch.md.
    """
    mean = drum + 0.5 * slip
    squares = mean * mean + 0.05 * slip * slip
    demand = par[L.D_DEMAND] * squares * gap * gap * gap / eta
    if par[L.D_SUPPLY] == 0.0 or demand <= par[L.D_SUPPLY]:
        return 1.0, 0.0, 0.0
    return par[L.D_SUPPLY] / demand, -(mean + 0.1 * slip) / squares, -2.0 * mean / squares


@kernel
def viscous_slopes(
    par: Array, slip: float, drum: float, u: float, temperature: float
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """Return ``viscous_between`` at the film ratio ``u``, viscosity and slope before the shares."""
    oil = oil_at(par, temperature)
    shear = viscous_between(par, slip, drum, rough_faces(u), oil)
    return shear[0], shear[1], shear[2], shear[3], shear[4], oil[1], oil[2], shear[5], shear[6]


@kernel
def oil_at(par: Array, temperature: float) -> Oil:
    """Return what the oil is at a temperature [K]."""
    scale, constant = par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_CONSTANT]
    eta, slope = viscosity(temperature, scale, constant, par[L.P_VISCOSITY_EXPONENT])
    return temperature, eta, slope


@kernel
def viscous_between(
    par: Array, slip: float, drum: float, faces: Faces, oil: Oil
) -> tuple[float, float, float, float, float, float, float]:
    """Return the torque [N m >= 0] of the oil's shear at |slip|; slopes; contact share.

    (torque, d/du, d/dT, d/d|slip|, d/ddrum, share of the area in contact, its d/du). Couette flow
    over the mean gap h_T where lands do not touch, and over h_T and the depth of the grooves.
    """
    temperature, eta, eta_slope = oil
    share, share_slope = share_in_contact(par, faces[2], faces[3])
    gap, gap_slope, open_share, open_slope = faces[4], faces[5], faces[7], faces[8]
    land, deep = par[L.P_LAND_SHARE] * open_share / gap, gap + par[L.D_GROOVE_RATIO]
    grooves = (1.0 - par[L.P_LAND_SHARE]) / deep
    thin = land * (1.0 - share) + grooves  # of 1/gap, over the face
    thin_u = land * ((1.0 - share) * (open_slope - gap_slope / gap) - share_slope)
    thin_u -= grooves * gap_slope / deep
    full = par[L.D_VISCOUS] * eta
    power, relative_t = 1.0, eta_slope / eta  # exponent of |slip| in the torque; its d ln/dT
    if par[L.P_SHEAR_HEATING] != 0.0 and eta_slope < 0.0:
        thinned, steepness = shear_thinned(
            -relative_t
            * eta
            * (slip * par[L.D_RADIUS])
            * (slip * par[L.D_RADIUS])
            / par[L.P_OIL_CONDUCTIVITY]
        )
        full *= thinned
        power += 2.0 * steepness
        reduced = 135.0 + temperature - 273.15
        relative_t += steepness * (relative_t - (par[L.P_VISCOSITY_EXPONENT] + 1.0) / reduced)
    filled, by_slip, by_drum = filled_share(par, slip, drum, gap, eta)
    full *= filled
    if filled < 1.0:
        thin_u -= 3.0 * thin * gap_slope / gap
        relative_t += eta_slope / eta
    torque = full * thin * abs(slip)
    return (
        torque,
        full * thin_u * abs(slip),
        torque * relative_t,
        full * thin * (power + by_slip * slip),
        torque * by_drum,
        share,
        share_slope,
    )


@kernel
def regime_of(par: Array, ratio: float, slip: float) -> int:
    """Return the stage of engagement: the film ratio names it, a full shear ratio is adhesion."""
    if ratio > 3.0:
        return FILM
    if ratio >= 1.0:
        return MIXED
    return ADHESIVE if abs(slip) * par[L.D_RADIUS] <= par[L.P_STICK_SPEED] else BOUNDARY


@kernel
def ploughing(x: float) -> float:
    """Return (2/(pi x^2)) [asin x - x sqrt(1 - x^2)] [-], the ploughing term for k = 1.

    The bracket cancels for small x: there its power series is summed instead, so that the result
    is good to rounding for every x in (0, 1].
    """
    if x >= SERIES_LIMIT:
        c = math.sqrt((1.0 - x) * (1.0 + x))
        return 2.0 / math.pi * (math.asin(x) - x * c) / (x * x)
    power = 1.0  # binom(2n, n) / 4^n x^(2n)
    total = 0.0
    for n in range(N_TERMS):
        term = power * 2.0 / (2.0 * n + 3.0)
        total += term
        if term < 1e-18 * total:
            break
        power *= (2.0 * n + 1.0) / (2.0 * n + 2.0) * x * x
    return 2.0 / math.pi * x * total


@kernel
def friction(x: float, shear_ratio: float, plough_weight: float, hardness_ratio: float) -> float:
    """Return the coefficient of boundary friction [-].

    symbol          meaning                                              unit
    x               indentation width over asperity diameter, W/2R       -, (0, 1]
    shear_ratio     shear strength of the film over the material's       -, [0, 1]
    plough_weight   k, weight of ploughing                               -
    hardness_ratio  N, hardness over shear strength                      -

    Source: Wang, Wei & Wu (2012), Eq 12, k on the ploughing bracket only; the adhesive bracket
    1 - sqrt(1 - x^2) is written x^2/(1 + sqrt(1 - x^2)) to keep its digits.
    """
    c = math.sqrt((1.0 - x) * (1.0 + x))
    adhesion = 4.0 * shear_ratio / (math.pi * hardness_ratio) / (1.0 + c)
    return plough_weight * ploughing(x) + adhesion


@kernel
def shear_and_slope(
    speed: float, floor: float, stick_speed: float, decay_speed: float, kink_width: float
) -> tuple[float, float]:
    """Return the shear ratio s/s_m [-] at the slip speed [m/s >= 0] at the mean radius; its slope.

    It is 1 up to ``stick_speed`` and falls exponentially towards ``floor`` above. With
    ``kink_width`` > 0 the corner is rounded by a softplus of that width.

    Notes
    -----
    Source: the prose of Wang, Wei & Wu (2012); the figure is lost and the constants are chosen
    so that the harmonic mean of the friction over 0..3000 rpm is the paper's 0.053.
    """
    beyond, rise = speed - stick_speed, 1.0
    if kink_width > 0.0:
        u = beyond / kink_width
        if u < 30.0:
            growth = math.exp(max(u, -700.0))
            beyond, rise = kink_width * math.log1p(growth), growth / (1.0 + growth)
    elif beyond < 0.0:
        beyond, rise = 0.0, 0.0
    decay = math.exp(-min(beyond / decay_speed, 700.0))
    return floor + (1.0 - floor) * decay, -(1.0 - floor) * decay * rise / decay_speed
