"""The washer as a wedge with one film temperature: what `closed` and `stribeck` have in common.

Single-valued: the least gap ``s`` for a load is the only root of a force that falls with ``s``.
Heat of rubbing asperities thins the oil, but never so much that more contact carries less. So there
is no fold, and none of the washer's memory: where the meshed washer loses its film at a fold, this
one passes from film to contact on a steep stretch.
"""

import math

from ...numerics.jit import Array, kernel
from ...numerics.status import MAX_ITERATIONS, NOT_FINITE, OK
from ...tribology.flow_factors import mean_gap
from ...tribology.viscosity import LN10
from . import layout as L
from .gap import dry_friction, oil_viscosity
from .wedge import lift, rim_contact, shear_moment

# Fitted once to the meshed rungs over random washers: benchmarks/fit_washer.py
FILM_HEAT = 1.18  # rise of the oil that carries over the mean rise of evenly heated parts
PEAK_FILM = 0.56  # rise of the hottest place above the mean, per rise by the film
PEAK_RIM = 0.94  # the same by rubbing, in power/(conductivity x outer radius)
SOFTENING = 0.3  # sigma over which the contact pressure grows by e
RUB_HEAT = 3.4  # rise of the oil that carries by rubbing over that of evenly heated parts
YIELDING = 0.95  # at most so much of a change of contact is lost by the film
FIRST_TILT = 0.85  # of the washer over the gear's, to find how film and contact share the load
# places in the values of a point and in their changes
LIFT, CONTACT, FILM_TORQUE, DRY_TORQUE, FILM_RISE, RISE, PEAK, TILT, GAP, N_LUMPED = range(10)


@kernel
def resistance(par: Array, sigma2: float, gap: float, dgap: float) -> tuple[float, float]:
    """Return the mean rise of carrier and washer [K] per heat flow [W/m2], and its change.

    Three flat bodies in a stack, heated in ``gap`` [m]; the gear's part counts by its area, the
    gap below it as 3 sigma.
    """
    ri, ro, rg = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS], par[L.P_GEAR_INNER_RADIUS]
    half = par[L.P_WASHER_THICKNESS] / (2.0 * par[L.P_CONDUCTIVITY])
    one, done = gap / par[L.P_OIL_CONDUCTIVITY] + half, dgap / par[L.P_OIL_CONDUCTIVITY]
    two = 3.0 * sigma2 / par[L.P_OIL_CONDUCTIVITY] + half
    carrier = par[L.P_CARRIER_THICKNESS] / par[L.P_CONDUCTIVITY]
    gear = two + par[L.P_GEAR_THICKNESS] / par[L.P_CONDUCTIVITY]
    gear *= (ro * ro - ri * ri) / (ro * ro - rg * rg)
    loop = carrier + one + gear
    out = (gear + par[L.P_HEAT_SPLIT] * one) / loop  # share that leaves through the carrier
    dout = (par[L.P_HEAT_SPLIT] - out) / loop * done
    return 0.5 * (out * carrier + (1.0 - out) * gear), 0.5 * dout * (carrier - gear)


@kernel
def film_rise(
    par: Array, heat: float, dheat: float, oil: float, doil: float
) -> tuple[float, float]:
    """Return the rise [K] = heat x viscosity(oil + rise) and its change; ``heat`` [K/(Pa s)].

    The right side falls with the rise: one root. Newton's method on the logarithm, bracketed.
    """
    mu, slope = oil_viscosity(par, oil)
    if not heat * mu > 0.0:
        return 0.0, dheat * mu
    low, high = 0.0, heat * mu
    rise = heat * mu / (1.0 - heat * slope)
    for _ in range(60):
        mu, slope = oil_viscosity(par, oil + rise)
        if rise > heat * mu:
            high = rise
        else:
            low = rise
        miss = math.log(rise / (heat * mu))
        step = miss / (1.0 / rise - slope / mu)
        if abs(miss) < 1e-14 or high - low <= 1e-15 * high:
            break
        rise = rise - step
        if not low < rise < high:
            rise = 0.5 * (low + high)
    return rise, (dheat * mu + heat * slope * doil) / (1.0 - heat * slope)


@kernel
def thinning(
    par: Array, film: float, dfilm: float, dry: float, ddry: float, rise: float, drise: float,
    warm: float, dwarm: float,
) -> tuple[float, float]:  # fmt: skip
    """Return by what the viscosity is divided where asperities rub, and its change.

    ``film``, ``dry`` [N] carried; ``rise`` [K/N] of the oil per force that rubs, at the oil's
    temperature ``warm`` [K]. exp(b dry/(1 + b film/YIELDING)), b the relative loss of viscosity per
    force: film + dry then grows with dry whatever b is.
    """
    x = max(1.0 + (warm - 273.15) / 135.0, 1e-3)
    steep = LN10 * par[L.P_VISCOSITY_CONSTANT] * par[L.P_VISCOSITY_EXPONENT] / 135.0
    steep *= math.exp(-(par[L.P_VISCOSITY_EXPONENT] + 1.0) * math.log(x))
    b = steep * rise
    db = steep * drise - b * (par[L.P_VISCOSITY_EXPONENT] + 1.0) / (135.0 * x) * dwarm
    below = 1.0 + b * film / YIELDING
    dbelow = (db * film + b * dfilm) / YIELDING
    more = b * dry / below
    if more > 100.0:
        return math.exp(100.0), 0.0
    thin = math.exp(more)
    return thin, thin * (db * dry + b * ddry - more * dbelow) / below


@kernel
def washer_tilt(
    par: Array, share: float, dshare: float, centre: float, dcentre: float, tilt: float,
    dtilt: float, sigma1: float, sigma2: float,
) -> tuple[float, float]:  # fmt: skip
    """Return the washer's tilt [rad] and its change where the film carries ``share`` of the load.

    Moments about the outer rim: the film acts far from it, contact 1.5 l/tilt away, l the
    separation over which contact pressure falls by e. Gap 2 has contact alone, at the rest of the
    gear's ``tilt``: a g^2 + (e + b - a tilt) g - b tilt = 0. Half the tilt when nothing is lifted.
    """
    dry = 1.5 * SOFTENING
    a = share * par[L.P_OUTER_RADIUS] * (1.0 - centre)
    da = par[L.P_OUTER_RADIUS] * (dshare * (1.0 - centre) - share * dcentre)
    b, db = (1.0 - share) * dry * sigma1, -dshare * dry * sigma1
    e = dry * sigma2 * (share * centre + 1.0 - share)
    de = dry * sigma2 * (dshare * (centre - 1.0) + share * dcentre)
    linear = a * tilt - e - b
    root = math.sqrt(linear * linear + 4.0 * a * b * tilt)
    if linear > 0.0:
        g = (linear + root) / (2.0 * a)
    else:
        g = 2.0 * b * tilt / (root - linear)
    more = db * tilt + b * dtilt - da * g * g
    more -= (de + db - da * tilt - a * dtilt) * g
    return g, more / root


@kernel
def wedge_forces(
    par: Array, heated: bool, s: tuple[float, float], w: tuple[float, float],
    tilt: tuple[float, float], oil: tuple[float, float], v: Array, d: Array,
) -> None:  # fmt: skip
    """Fill ``v`` and, along one direction, ``d``: all that a least gap and a point come to.

    Least gap ``s`` [m], size of the speed ``w`` [rad/s], ``tilt`` [rad] and ``oil`` temperature [K]
    come as (value, change). With ``heated`` false the oil keeps its temperature.
    """
    ri, ro = par[L.P_INNER_RADIUS], par[L.P_OUTER_RADIUS]
    sigma1, sigma2 = par[L.D_SIGMA1], par[L.D_SIGMA2]
    area = math.pi * (ro * ro - ri * ri)
    c, slope = mean_gap(s[0], sigma1)
    dc = slope * s[1]
    shear, dshear = shear_moment(c, dc, tilt[0], tilt[1], ri, ro)
    rises, drises = resistance(par, sigma2, c + tilt[0] * ro, dc + tilt[1] * ro)
    heat = FILM_HEAT / area * par[L.P_FILM_HEAT_FRACTION] * w[0] * w[0]
    dheat = 2.0 * FILM_HEAT / area * par[L.P_FILM_HEAT_FRACTION] * w[0] * w[1] * shear * rises
    dheat += heat * (dshear * rises + shear * drises)
    warmer, dwarmer = 0.0, 0.0
    if heated:
        warmer, dwarmer = film_rise(par, heat * shear * rises, dheat, oil[0], oil[1])
    mu, dmu = oil_viscosity(par, oil[0] + warmer)
    dmu *= oil[1] + dwarmer
    strong, dstrong = mu * w[0], dmu * w[0] + mu * w[1]
    g, dg = FIRST_TILT * tilt[0], FIRST_TILT * tilt[1]
    film, centre, dfilm, dcentre = lift(c, dc, g, dg, strong, dstrong, ri, ro, sigma1)
    dry, ddry, _, _ = rim_contact(par, s[0], s[1], g, dg)
    share, dshare = 1.0, 0.0
    if dry > 0.0:
        if heated:
            friction, slope = dry_friction(par, dry)
            rub = RUB_HEAT * rises * w[0] * ro / area
            drub = RUB_HEAT * ro / area * (drises * w[0] + rises * w[1])
            thin, dthin = thinning(
                par, film, dfilm, dry, ddry, friction * rub, friction * drub + slope * ddry * rub,
                oil[0] + warmer, oil[1] + dwarmer,
            )  # fmt: skip
            strong, dstrong = strong / thin, (dstrong - strong / thin * dthin) / thin
            film, dfilm = film / thin, (dfilm - film / thin * dthin) / thin
        share = film / (film + dry)
        dshare = (dfilm * (1.0 - share) - ddry * share) / (film + dry)
    if tilt[0] > 0.0:
        g, dg = washer_tilt(par, share, dshare, centre, dcentre, tilt[0], tilt[1], sigma1, sigma2)
    v[LIFT], _, d[LIFT], _ = lift(c, dc, g, dg, strong, dstrong, ri, ro, sigma1)
    v[CONTACT], d[CONTACT], arm, darm = rim_contact(par, s[0], s[1], g, dg)
    shear, dshear = shear_moment(c, dc, g, dg, ri, ro)
    v[FILM_TORQUE], d[FILM_TORQUE] = strong * shear, dstrong * shear + strong * dshear
    friction, dfriction = dry_friction(par, v[CONTACT])
    v[DRY_TORQUE] = friction * arm
    d[DRY_TORQUE] = friction * darm + dfriction * d[CONTACT] * arm
    v[TILT], d[TILT], v[GAP], d[GAP] = g, dg, s[0], s[1]
    # rises in steady state, by the film and by rubbing
    by_film = par[L.P_FILM_HEAT_FRACTION] / area
    power = w[0] * v[FILM_TORQUE]
    dpower = w[1] * v[FILM_TORQUE] + w[0] * d[FILM_TORQUE]
    v[FILM_RISE] = by_film * rises * power
    d[FILM_RISE] = by_film * (drises * power + rises * dpower)
    power = w[0] * v[DRY_TORQUE]
    dpower = w[1] * v[DRY_TORQUE] + w[0] * d[DRY_TORQUE]
    v[RISE] = v[FILM_RISE] + rises / area * power
    d[RISE] = d[FILM_RISE] + (drises * power + rises * dpower) / area
    rim = PEAK_RIM / (par[L.P_CONDUCTIVITY] * ro)
    v[PEAK] = v[RISE] + PEAK_FILM * v[FILM_RISE] + rim * power
    d[PEAK] = d[RISE] + PEAK_FILM * d[FILM_RISE] + rim * dpower


@kernel
def least_gap(
    par: Array, heated: bool, load: float, w: float, tilt: float, oil: float, v: Array, d: Array
) -> tuple[float, int, int]:
    """Return the least gap s [m] that carries ``load`` [N], a status, the number of iterations.

    Newton's method on the logarithm of the force, inside a bracket that grows until it holds.
    ``v`` is left at the solution, ``d`` holds the slopes over s.
    """
    sigma = par[L.D_SIGMA1]
    low, high = -60.0 * sigma, math.inf
    s, target = 3.0 * sigma, math.log(load)
    for n in range(120):
        wedge_forces(par, heated, (s, 1.0), (w, 0.0), (tilt, 0.0), (oil, 0.0), v, d)
        force, slope = v[LIFT] + v[CONTACT], d[LIFT] + d[CONTACT]
        if not math.isfinite(force):
            return s, NOT_FINITE, n
        if force > load:
            low = max(low, s)
        else:
            high = min(high, s)
        miss = math.log(max(force, 1e-300)) - target
        step = miss * force / slope if slope < 0.0 else math.nan
        if abs(miss) < 1e-13 or (abs(step) < 1e-13 * sigma) or high - low < 1e-14 * abs(s):
            return s, OK, n
        s -= step
        if not low < s < high:
            s = 0.5 * (low + high) if high < math.inf else low + max(10.0 * sigma, abs(low))
    return s, MAX_ITERATIONS, 120
