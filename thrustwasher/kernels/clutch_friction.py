# mypy: disable-error-code="no-any-return"
"""What resists in a pack: boundary friction of the asperities and shear of the oil between them."""

import math

import numpy as np
from numpy.typing import NDArray

from . import clutch_layout as L
from ._jit import kernel
from .boundary import shear_ratio
from .film import INV_SQRT2PI, mean_gap
from .lining_table import area_integrals, contact_integral, separation
from .roelands import viscosity

Array = NDArray[np.float64]
FILM, MIXED, BOUNDARY, ADHESIVE = range(1, 5)  # regimes


@kernel
def shear_of(par: Array, slip: float, temperature: float) -> tuple[float, float]:
    """Return the shear ratio s/s_m [-] at a slip [rad/s] and temperature [K], and its slope [1/K].

    The temperature acts by ``shear_temperature_slope`` (0: not at all); the ratio stays in 0 .. 1.
    """
    ratio = shear_ratio(
        slip * par[L.D_RADIUS], par[L.P_SHEAR_FLOOR], par[L.P_STICK_SPEED], par[L.P_DECAY_SPEED],
        par[L.P_KINK_WIDTH],
    )  # fmt: skip
    slope = par[L.P_SHEAR_TEMPERATURE_SLOPE]
    if slope == 0.0:
        return ratio, 0.0
    warm = ratio * (1.0 + slope * (temperature - par[L.P_REFERENCE_TEMPERATURE]))
    if warm >= 1.0 or warm <= 0.0:
        return (1.0 if warm >= 1.0 else 0.0), 0.0
    return warm, ratio * slope


@kernel
def tabled(par: Array, speed: float) -> float:
    """Return the coefficient [-] of the table at a slip speed [m/s]: straight between its points.

    Beyond the last point the last value holds. The slope jumps at the points.
    """
    low, value = 0.0, par[L.P_TABLE_FRICTION_0]
    for k in range(L.N_TABLE):
        high = par[np.uintp(L.P_TABLE_SPEED_1 + 2 * k)]
        after = par[np.uintp(L.P_TABLE_FRICTION_1 + 2 * k)]
        if speed < high:
            return value + (after - value) * (speed - low) / (high - low)
        low, value = high, after
    return value


@kernel
def coefficient_of(par: Array, slip: float, temperature: float) -> tuple[float, float]:
    """Return the coefficient of boundary friction [-] and its slope over temperature [1/K]."""
    if par[L.P_FIDELITY] == L.CLOSED or par[L.P_FRICTION_LAW] == L.CONSTANT_LAW:
        return par[L.P_CONSTANT_FRICTION], 0.0
    if par[L.P_FRICTION_LAW] == L.TABLE_LAW:
        return tabled(par, abs(slip) * par[L.D_RADIUS]), 0.0
    ratio, slope = shear_of(par, slip, temperature)
    return par[L.D_PLOUGH] + par[L.D_ADHESION] * ratio, par[L.D_ADHESION] * slope


@kernel
def settled_ratio(par: Array, load: float, guess: float) -> tuple[float, int, int]:
    """Return (film thickness over roughness where the asperities carry all, status, iterations)."""
    pressure = load / par[L.D_AREA]
    if pressure < L.OPEN_PRESSURE:
        return par[L.D_OPEN_RATIO], L.OK, 0
    return separation(pressure / par[L.D_PRESSURE], guess)


@kernel
def contact_torque(
    par: Array, load: float, slip: float, u: float, temperature: float
) -> tuple[float, float, float, float, float]:
    """Return the torque [N m >= 0] of the asperities at the film ratio ``u``; slopes; pressure.

    (torque, d/du, d/dT [N m/K], contact pressure p_c [Pa], dp_c/du). The asperities never carry
    more than the load, also where a film that still opens presses them harder.
    """
    height, slope = contact_integral(u)
    pressure, rise = par[L.D_PRESSURE] * height, par[L.D_PRESSURE] * slope
    mu, mu_slope = coefficient_of(par, slip, temperature)
    lever = par[L.P_FACES] * par[L.D_RADIUS]
    carried = pressure * par[L.D_AREA]
    grows = rise * par[L.D_AREA]
    if carried > load:
        carried, grows = load, 0.0
    return (
        lever * mu * carried, lever * mu * grows, lever * mu_slope * carried, pressure, rise
    )  # fmt: skip


@kernel
def contact_share(par: Array, u: float) -> tuple[float, float]:
    """Return the share of the nominal area in contact [-] and its slope over the film ratio.

    Source: Greenwood & Tripp 1971, pi^2 (N beta sigma)^2 F_2(u), cut at 1: for a soft lining the
    group is ten times the usual and the formula leaves its range.
    """
    second, first = area_integrals(u)
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
def viscous_torque(
    par: Array, slip: float, u: float, temperature: float
) -> tuple[float, float, float, float, float, float]:
    """Return the torque [N m >= 0] of the oil's shear at |slip|; slopes; viscosity and its slope.

    (torque, d/du, d/dT, eta [Pa s], d eta/dT, share of the area in contact). Couette flow over
    the mean gap h_T where there is no contact. With a given oil supply the gap is full up to the
    slip at which centrifugal force pumps more than is supplied, above it in the proportion of the
    two.
    """
    scale, constant = par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_CONSTANT]
    eta, eta_slope = viscosity(temperature, scale, constant, par[L.P_VISCOSITY_EXPONENT])
    share, share_slope = contact_share(par, u)
    gap, gap_slope = mean_gap(u, 1.0)
    open_share, open_slope = sheared_share(gap_slope, u)
    full = par[L.D_VISCOUS] * eta * abs(slip) / gap
    relative_u = -gap_slope / gap
    relative_t = eta_slope / eta
    if par[L.P_SHEAR_HEATING] != 0.0 and eta_slope < 0.0:
        thinned, steepness = shear_thinned(
            -relative_t * eta * (slip * par[L.D_RADIUS]) * (slip * par[L.D_RADIUS])
            / par[L.P_OIL_CONDUCTIVITY]
        )  # fmt: skip
        full *= thinned
        reduced = 135.0 + temperature - 273.15
        relative_t += steepness * (relative_t - (par[L.P_VISCOSITY_EXPONENT] + 1.0) / reduced)
    if par[L.D_SUPPLY] > 0.0:
        demand = par[L.D_DEMAND] * slip * slip * gap * gap * gap / eta
        if demand > par[L.D_SUPPLY]:
            full *= par[L.D_SUPPLY] / demand
            relative_u *= 4.0
            relative_t += eta_slope / eta
    full *= open_share
    relative_u += open_slope
    torque = full * (1.0 - share)
    return (
        torque,
        torque * relative_u - full * share_slope,
        torque * relative_t,
        eta,
        eta_slope,
        share,
    )


@kernel
def regime_of(par: Array, ratio: float, slip: float) -> int:
    """Return the stage of engagement: the film ratio names it, a full shear ratio is adhesion."""
    if ratio > 3.0:
        return FILM
    if ratio >= 1.0:
        return MIXED
    return ADHESIVE if abs(slip) * par[L.D_RADIUS] <= par[L.P_STICK_SPEED] else BOUNDARY
