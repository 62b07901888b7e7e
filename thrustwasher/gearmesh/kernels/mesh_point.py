# mypy: disable-error-code="no-any-return"
"""The mesh at one operating point with the paper's heat: load, film, heat, stress.

Everything is evaluated where contact starts. Near zero the line load counts at least 1 N/m and the
speed at least 1 mrad/s, rounded, so that every number stays finite with a continuous slope.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import floored, smoothstep, soft_size
from ...numerics.status import HOT, OK, OUTSIDE_VERIFIED
from ...tribology.greenwood_williamson import LARGEST_RATIO, area_and_slope, bounded_slopes
from . import contact
from . import flank_temperature as flank
from . import layout as L
from .path_of_contact import LOSS_LUBRICANT, SCUFFING_LUBRICANT

LEAST_LINE_LOAD = 1.0  # N/m
LEAST_SPEED = 1e-3  # rad/s
# Atan's Table 1 (its numbers are bar), of AISI 1020 and 4340: limits over ultimate strength,
# ultimate strength [Pa].
MECHANICAL, THERMAL = (0.63, 0.53), (0.77, 0.40)
ULTIMATE = (434.3e6 / 0.63, 689.5e6 / 0.53)
SWITCH_AT, SWITCH_FROM, SWITCH_WIDTH = 1.4, 1.0, 0.8  # film ratios
HOT_FILM = 523.0  # K
COLDEST, WARMEST = 253.15, 423.15  # K; where the viscosity law is that of a real oil
HOTTEST_ASPERITY = 1000.0  # K; steel has softened


@kernel
def friction_coefficient(
    par: Array, film: float, line_load: float, speed: float, viscosity: float
) -> tuple[float, float, float]:
    """Return the coefficient of friction [-]; ``speed`` of the pinion [rad/s] above 0.

    The other numbers are slopes: over the logarithm of the film with Li & Seireg's law; of a mean
    coefficient over that of its law at a speed that is held, and over the speed's part of it.
    """
    law, scale = par[L.P_FRICTION_LAW], par[L.P_FRICTION_SCALE]
    if law == L.LI_SEIREG:
        mu, slope = contact.li_seireg(film, par[L.D_RADIUS], par[L.P_F0], par[L.D_ROUGHNESS])
        return mu, slope, 0.0
    if law == L.CONSTANT:
        return par[L.P_CONSTANT_FRICTION], 0.0, 0.0
    rolling, kind = par[L.D_ROLLING] * speed, int(par[L.P_BASE_OIL]) - 1
    found = contact.common_law(line_load, rolling, par[L.D_PITCH_RADIUS], viscosity, par[L.D_MEAN])
    if law == L.ISO:
        mu, slope = contact.iso_and_slope(found, SCUFFING_LUBRICANT[kind], par[L.P_F0])
        return scale * mu, scale * slope, scale * slope
    slow = 2.0 * math.sin(par[L.D_ANGLE]) * contact.BOUNDARY_SPEED
    boundary = par[L.P_BOUNDARY_FRICTION]
    mu, held, moved = contact.schlenk_and_slopes(
        found, rolling, slow, LOSS_LUBRICANT[kind], boundary
    )
    return scale * mu, scale * held, scale * moved


@kernel
def contact_weight(par: Array, film_ratio: float) -> float:
    """Return the share [-] of asperity heating: 1 in boundary lubrication, 0 with a full film."""
    if par[L.P_SWITCH] == L.SMOOTH:
        return 1.0 - smoothstep((film_ratio - SWITCH_FROM) / SWITCH_WIDTH)
    if par[L.P_SWITCH] == L.SHARP:
        return 1.0 if film_ratio <= SWITCH_AT else 0.0
    return 1.0


@kernel
def viscosity_follows(par: Array) -> tuple[bool, bool, float]:
    """Return if the shear, then the film too, follows the flank's temperature; power of both.

    The power is that of the viscosity in the shear stress: 0.3 where the film thins with it.
    """
    warm = par[L.P_VISCOSITY_AT] == L.AT_SURFACE
    thins = warm and par[L.P_FILM_VISCOSITY] == L.AT_SURFACE
    exponent = (0.3 if thins else 1.0) if warm else 0.0
    return warm, thins, exponent


@kernel
def viscosity_at(par: Array, temperature: float) -> float:
    """Return the viscosity of the oil [Pa s] at a temperature [K]."""
    scale, b, c = par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_B], par[L.P_VISCOSITY_C]
    return flank.oil_viscosity(temperature, scale, b, c)


@kernel
def thinning(par: Array, temperature: float) -> float:
    """Return the relative slope [1/K] of the viscosity."""
    warmth = temperature - 273.15 + par[L.P_VISCOSITY_C]
    return -par[L.P_VISCOSITY_B] / (warmth * warmth) if temperature >= flank.LOWEST_OIL else 0.0


@kernel
def heat_film(par: Array, oil: float, speed: float, field: Array) -> tuple[int, int]:
    """Fill film, surface and film temperature, viscosities; return (status, iterations).

    ``field`` holds line load, width and pressure already.
    """
    line_load, width, pressure = field[L.F_LINE_LOAD], field[L.F_WIDTH], field[L.F_PRESSURE]
    v1, sliding = par[L.D_V1] * speed, par[L.D_SLIDING] * speed
    bulk = viscosity_at(par, oil)
    film = contact.film_thickness(
        bulk,
        0.5 * speed * (par[L.D_V1] + par[L.D_V2]),
        line_load,
        par[L.D_RADIUS],
        par[L.D_THETA],
        par[L.D_ALPHA],
    )
    shear, cap = bulk * sliding / film, 1e300
    if par[L.P_TRACTION_LAW] != L.AMBIENT:
        shear *= math.exp(min(par[L.D_ALPHA] * pressure, 200.0))
        cap = par[L.P_LIMITING_TRACTION] * pressure
    taken = par[L.D_SHARE] * sliding * width  # heat into the pinion per stress, [m2/s]
    factor = taken * flank.surface_factor(width, v1, par[L.P_CONDUCTIVITY], par[L.D_CAPACITY])
    warm, thins, exponent = viscosity_follows(par)
    surface, stress, slope, status, iterations = flank.heated_flank(
        oil, factor, shear, cap, exponent, par[L.P_VISCOSITY_B], par[L.P_VISCOSITY_C]
    )
    viscosity = viscosity_at(par, surface) if warm else bulk
    if thins:
        film *= math.exp(0.7 * math.log(viscosity / bulk))
    field[L.F_VISCOSITY], field[L.F_FILM], field[L.F_SURFACE] = viscosity, film, surface
    field[L.F_RATIO] = film / par[L.D_SIGMA]
    field[L.F_BULK_VISCOSITY], field[L.F_STRESS_SLOPE] = bulk, slope
    field[L.F_SURFACE_RISE] = factor * stress
    field[L.F_FILM_RISE] = (
        taken
        * stress
        * flank.film_factor(
            film,
            width,
            v1,
            par[L.P_CONDUCTIVITY],
            par[L.D_CAPACITY],
            par[L.P_OIL_CONDUCTIVITY],
            par[L.D_OIL_CAPACITY],
        )
    )
    field[L.F_FILM_TEMPERATURE] = surface + field[L.F_FILM_RISE]
    return status, iterations


@kernel
def asperity_temperature(
    par: Array, field: Array, oil: float, ratio: float, hardness: float
) -> tuple[float, float]:
    """Return (temperature [K], area ratio [-]) of the asperities of a steel of that hardness."""
    area = ratio
    if par[L.P_AREA_LAW] == L.BOUNDED:
        area, _, _ = bounded_slopes(ratio, hardness, field[L.F_PRESSURE])
    weight = field[L.F_WEIGHT]
    if weight == 0.0:
        area_rise = 0.0
    else:
        area_rise = weight * area * field[L.F_FLASH]
    if par[L.P_ASPERITY_BASE] == L.ON_SURFACE:
        if par[L.P_FILM_HEAT] == L.LOSS:  # the flash is in the flank's temperature already
            area_rise -= weight * field[L.F_FLASH]
        return field[L.F_SURFACE] + area_rise, area
    return weight * oil + (1.0 - weight) * field[L.F_FILM_TEMPERATURE] + area_rise, area


@kernel
def has_endurance(par: Array) -> bool:
    """Tell if the paper's endurance under thermal stress holds: its heat, one of its steels."""
    return par[L.P_FILM_HEAT] != L.LOSS and par[L.P_STEEL] != L.CASE_HARDENED


@kernel
def stress_asperities(par: Array, oil: float, field: Array) -> None:
    """Fill what the asperity temperature brings: area ratio, stress, both steels' endurance.

    A case-hardened steel has the hardness of AISI 4340 here, and no endurance.
    """
    if par[L.P_AREA_LAW] == L.BOUNDED or par[L.P_AREA_LAW] == L.FREE:
        ratio, slope = area_and_slope(field[L.F_RATIO], par[L.P_ASPERITY_GROUP])
    else:
        ratio, slope = min(par[L.P_AREA_RATIO], LARGEST_RATIO), 0.0
    field[L.F_FREE_AREA], field[L.F_FREE_AREA_SLOPE] = ratio, slope
    factor, mechanical = par[L.P_HARDNESS_FACTOR], field[L.F_STRESS]
    modulus, poisson = par[L.P_YOUNGS_MODULUS], par[L.P_POISSON_RATIO]
    expansion = par[L.P_THERMAL_EXPANSION]

    main = 0 if par[L.P_STEEL] == L.AISI1020 else 1
    endures = has_endurance(par)
    for k in range(2):
        thermal_limit, limit, ultimate = THERMAL[k], MECHANICAL[k], ULTIMATE[k]
        temperature, area = asperity_temperature(par, field, oil, ratio, factor * ultimate)
        thermal = contact.thermal_stress(temperature - oil, modulus, poisson, expansion)
        factor_k, allowed = contact.modification(thermal, mechanical, thermal_limit, limit)
        used = contact.utilization(thermal, mechanical, thermal_limit, limit, ultimate)
        if not endures:
            factor_k, allowed, used = L.NO_DATA, L.NO_DATA, L.NO_DATA
        field[np.uintp(L.F_MODIFICATION_1020 + k)] = factor_k
        field[np.uintp(L.F_ALLOWABLE_1020 + k)] = allowed
        field[np.uintp(L.F_UTILIZATION_1020 + k)] = used
        if k == main:
            field[L.F_ASPERITY], field[L.F_AREA], field[L.F_THERMAL] = temperature, area, thermal
            field[L.F_MODIFICATION], field[L.F_ALLOWABLE] = factor_k, allowed


@kernel
def outside(par: Array, oil: float, field: Array) -> bool:
    """Tell if the point lies where the laws are stretched.

    Oil, hardness, softened steel, a contact ratio below 1.
    """
    ultimate = ULTIMATE[0] if par[L.P_STEEL] == L.AISI1020 else ULTIMATE[1]
    return (
        par[L.D_CONTACT_RATIO] < 1.0
        or oil < COLDEST
        or oil > WARMEST
        or field[L.F_ASPERITY] > HOTTEST_ASPERITY
        or field[L.F_PRESSURE] > par[L.P_HARDNESS_FACTOR] * ultimate
    )


@kernel
def mesh_point(par: Array, torque: float, speed: float, oil: float, field: Array) -> int:
    """Fill ``field``, except loss torque and power, at a torque [N m], speed [rad/s], oil [K].

    Signs of torque and speed, both the pinion's, do not matter. Returns 0, an advice or a failure.
    """
    turning = floored(speed, LEAST_SPEED)
    line_load = floored(torque * par[L.D_LINE], LEAST_LINE_LOAD)
    width = contact.hertz_width(line_load, par[L.D_RADIUS], par[L.D_THETA])
    field[L.F_LINE_LOAD], field[L.F_WIDTH] = line_load, width
    field[L.F_PRESSURE] = line_load / width
    field[L.F_STRESS] = contact.surface_stress(line_load, par[L.D_RADIUS], par[L.P_YOUNGS_MODULUS])
    field[L.F_SLIDING] = par[L.D_SLIDING] * turning
    status, iterations = heat_film(par, oil, turning, field)
    friction, slope, by_speed = friction_coefficient(
        par, field[L.F_FILM], line_load, turning, field[L.F_BULK_VISCOSITY]
    )
    field[L.F_FRICTION_SLOPE], field[L.F_SPEED_SLOPE] = slope, by_speed
    field[L.F_SCUFFING_FRICTION] = friction
    rubbing = soft_size(torque * par[L.D_LINE], 2.0 * LEAST_LINE_LOAD)  # no load, no heat
    heat = par[L.D_SHARE] * friction * rubbing * field[L.F_SLIDING]
    rise = flank.flash_rise(heat, width, par[L.D_V1] * turning, par[L.D_EFFUSIVITY])
    field[L.F_FRICTION], field[L.F_FLASH], field[L.F_BULK] = friction, rise, oil
    field[L.F_WEIGHT] = contact_weight(par, field[L.F_RATIO])
    stress_asperities(par, oil, field)
    if status == OK:
        if field[L.F_FILM_TEMPERATURE] > HOT_FILM:
            status = HOT
        elif outside(par, oil, field):
            status = OUTSIDE_VERIFIED
    field[L.F_STATUS], field[L.F_ITERATIONS] = float(status), float(iterations)
    return status
