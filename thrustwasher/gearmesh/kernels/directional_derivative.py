# mypy: disable-error-code="no-any-return"
"""How the outputs of the gear mesh change with its inputs: exact, from the numbers of a step.

Most laws are products of powers, so relative changes add up. The flank's temperature is the root
of an equation: its change follows from that equation's slopes at the root.
"""

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import smoothstep_slope, soft_size, soft_size_slope
from ...tribology.greenwood_williamson import bounded_slopes
from . import layout as L
from .contact import thermal_stress
from .flank_temperature import LOWEST_OIL
from .mesh_point import (
    LEAST_LINE_LOAD,
    MECHANICAL,
    SWITCH_FROM,
    SWITCH_WIDTH,
    THERMAL,
    ULTIMATE,
    has_endurance,
    viscosity_follows,
)


@kernel
def film_changes(
    par: Array, field: Array, oil: float, turning: float, load: float, speed: float, change: float
) -> tuple[float, float, float, float]:
    """Return relative changes of film and bulk viscosity, changes [K] of surface and film.

    ``load``, ``speed``: relative changes of the line load and of the speed ``turning`` [rad/s],
    as they count; ``change`` [K] that of the oil's temperature.
    """
    b, width = par[L.P_VISCOSITY_B], 0.5 * load
    cold = max(oil, LOWEST_OIL) - 273.15 + par[L.P_VISCOSITY_C]
    colder = change if oil >= LOWEST_OIL else 0.0
    steep = b / (cold * cold)
    bulk = -steep * colder
    film = 0.7 * (bulk + speed) - 0.13 * load
    shear, cap = bulk + speed - film, 0.0
    if par[L.P_TRACTION_LAW] != L.AMBIENT:
        cap = 0.5 * load
        power = par[L.D_ALPHA] * field[L.F_PRESSURE]
        shear += power * cap if power < 200.0 else 0.0

    _, thins, exponent = viscosity_follows(par)
    rise, slope = field[L.F_SURFACE_RISE], field[L.F_STRESS_SLOPE]
    factor = 0.5 * (speed + width)
    warmth = cold + rise  # rise = factor x stress(rise), solved for the change of the rise
    thinning = exponent * b / (warmth * warmth)
    held = shear + colder * (exponent * steep - thinning)
    stress = slope * held + (1.0 - slope) * cap
    rising = rise * (factor + stress) / (1.0 + rise * slope * thinning)
    stress -= slope * thinning * rising
    surface = change + rising

    if thins and field[L.F_SURFACE] >= LOWEST_OIL:
        hot = field[L.F_SURFACE] - 273.15 + par[L.P_VISCOSITY_C]
        film -= 0.7 * (b * surface / (hot * hot) + bulk)
    half = 0.5 * par[L.D_V1] * turning * field[L.F_FILM] / par[L.P_OIL_CONDUCTIVITY]
    power = -(0.013 + 9e-4 * par[L.D_OIL_CAPACITY] * half) * (speed + film) - 1.003 * (width - film)
    hotter = field[L.F_FILM_RISE] * (speed + width + stress + power)
    return film, bulk, surface, surface + hotter


@kernel
def follow_friction(
    par: Array, field: Array, film: float, bulk: float, load: float, speed: float
) -> float:
    """Return the change of the coefficient of friction; all changes given are relative."""
    if par[L.P_FRICTION_LAW] == L.LI_SEIREG:
        return field[L.F_FRICTION_SLOPE] * film
    held = field[L.F_FRICTION_SLOPE] * (0.2 * load - 0.05 * bulk)
    return held - field[L.F_SPEED_SLOPE] * 0.2 * speed


@kernel
def flash_change(
    par: Array,
    field: Array,
    torque: float,
    load: float,
    speed: float,
    torque_change: float,
    friction: float,
) -> float:
    """Return the change of the flash rise [K]: friction x rubbing load x speed^(1/2) b^(-1/2).

    ``load``, ``speed``, ``friction``: relative changes.
    """
    rise = field[L.F_FLASH]
    line, width = torque * par[L.D_LINE], 2.0 * LEAST_LINE_LOAD
    rubbing = soft_size(line, width)
    if not rubbing > 0.0:
        return 0.0
    grows = soft_size_slope(line, width) * par[L.D_LINE] * torque_change / rubbing
    return rise * (friction + grows + 0.5 * speed - 0.25 * load)


@kernel
def asperity_change(
    par: Array,
    field: Array,
    hardness: float,
    body: float,
    load: float,
    changes: tuple[float, float, float, float, float, float],
) -> tuple[float, float]:
    """Return (rise of the asperities over the body [K], its change) for a steel of that hardness.

    ``changes``: of body, surface, film, flash [K], contact weight, free area ratio.
    """
    area, growth = field[L.F_FREE_AREA], changes[5]
    if par[L.P_AREA_LAW] == L.BOUNDED:
        area, by_ratio, by_pressure = bounded_slopes(area, hardness, field[L.F_PRESSURE])
        growth = by_ratio * growth + by_pressure * 0.5 * load
    weight, flash = field[L.F_WEIGHT], field[L.F_FLASH]
    rise, change = 0.0, 0.0
    if weight != 0.0:
        rise = weight * area * flash
        change = changes[4] * area * flash + weight * (growth * flash + area * changes[3])
    if par[L.P_ASPERITY_BASE] == L.ON_SURFACE:
        if par[L.P_FILM_HEAT] == L.LOSS:
            rise -= weight * flash
            change -= changes[4] * flash + weight * changes[3]
        return field[L.F_SURFACE] - body + rise, changes[1] - changes[0] + change
    above = field[L.F_FILM_TEMPERATURE] - body
    change += (1.0 - weight) * (changes[2] - changes[0]) - changes[4] * above
    return (1.0 - weight) * above + rise, change


@kernel
def endurance_change(
    mechanical: float,
    load: float,
    thermal: float,
    hotter: float,
    allowed: float,
    used: float,
    steel: int,
) -> tuple[float, float, float]:
    """Return changes of modification factor, allowable ratio and utilization of a steel.

    ``thermal`` stress [Pa] and its change ``hotter``; ``steel``: 0 AISI 1020, 1 AISI 4340.
    """
    limit, thermal_limit, ultimate = MECHANICAL[steel], THERMAL[steel], ULTIMATE[steel]
    root = limit / thermal_limit / mechanical
    factor = 2.0 * root * root * thermal * (hotter - 0.5 * load * thermal)
    m, per_stress = 1.0 / (limit * ultimate) * mechanical, 1.0 / (thermal_limit * ultimate)
    t = per_stress * per_stress
    more = (0.5 * load * m * m + t * thermal * hotter) / used
    return factor, -0.5 * allowed * allowed * allowed * factor, more


@kernel
def fill_changes(
    par: Array,
    field: Array,
    torque: float,
    oil: float,
    turning: float,
    load: float,
    speed: float,
    torque_change: float,
    change: float,
    dout: Array,
) -> None:
    """Fill the changes of all outputs but loss torque and power."""
    film, bulk, surface, hottest = film_changes(par, field, oil, turning, load, speed, change)
    friction = follow_friction(par, field, film, bulk, load, speed)
    part = friction / field[L.F_FRICTION] if field[L.F_FRICTION] > 0.0 else 0.0
    flash = flash_change(par, field, torque, load, speed, torque_change, part)
    asperity_changes(par, field, change, film, surface, hottest, flash, friction, load, dout)


@kernel
def asperity_changes(
    par: Array,
    field: Array,
    change: float,
    film: float,
    surface: float,
    hottest: float,
    flash: float,
    friction: float,
    load: float,
    dout: Array,
) -> None:
    """Fill the changes that follow from those of body, film (relative), surface, film and flash."""
    body = field[L.F_BULK]
    ratio = field[L.F_RATIO] * film
    weight = 0.0
    if par[L.P_SWITCH] == L.SMOOTH:
        z = (field[L.F_RATIO] - SWITCH_FROM) / SWITCH_WIDTH
        weight = -smoothstep_slope(z) / SWITCH_WIDTH * ratio
    changes = (change, surface, hottest, flash, weight, field[L.F_FREE_AREA_SLOPE] * ratio)
    factor, mechanical = par[L.P_HARDNESS_FACTOR], field[L.F_STRESS]
    stiff = thermal_stress(
        1.0, par[L.P_YOUNGS_MODULUS], par[L.P_POISSON_RATIO], par[L.P_THERMAL_EXPANSION]
    )
    main = 0 if par[L.P_STEEL] == L.AISI1020 else 1
    endures = has_endurance(par)
    for s in range(2):
        rise, more = asperity_change(par, field, factor * ULTIMATE[s], body, load, changes)
        k, allowed, used = 0.0, 0.0, 0.0
        if endures:
            k, allowed, used = endurance_change(
                mechanical,
                load,
                stiff * rise,
                stiff * more,
                field[np.uintp(L.F_ALLOWABLE_1020 + s)],
                field[np.uintp(L.F_UTILIZATION_1020 + s)],
                s,
            )
        dout[np.uintp(L.F_MODIFICATION_1020 + s)] = k
        dout[np.uintp(L.F_ALLOWABLE_1020 + s)] = allowed
        dout[np.uintp(L.F_UTILIZATION_1020 + s)] = used
        if s == main:
            dout[L.F_ASPERITY], dout[L.F_THERMAL] = change + more, stiff * more
            dout[L.F_MODIFICATION], dout[L.F_ALLOWABLE] = k, allowed
    dout[L.F_FILM], dout[L.F_RATIO] = field[L.F_FILM] * film, ratio
    dout[L.F_SURFACE], dout[L.F_FILM_TEMPERATURE] = surface, hottest
    dout[L.F_STRESS] = 0.5 * mechanical * load
    dout[L.F_FLASH], dout[L.F_FRICTION] = flash, friction
