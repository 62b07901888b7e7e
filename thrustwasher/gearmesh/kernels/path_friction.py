# mypy: disable-error-code="no-any-return"
"""Friction along the path of contact, and how it changes with load, speed and viscosities.

All changes given are relative. The laws "constant", "iso", "schlenk" and "efficiency" have one
friction for the whole path.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import (
    floored,
    floored_slope,
    soft_least,
    soft_most,
)
from . import layout as L
from .contact import (
    BOUNDARY_SPEED,
    coefficient_at,
    common_law,
    iso_and_slope,
    li_seireg,
    schlenk_and_slopes,
)
from .mesh_point import LEAST_LINE_LOAD
from .path_of_contact import LOSS_LUBRICANT, SCUFFING_LUBRICANT, flanks_at, loss_over_scuffing

LEAST_ROLLING = 0.1  # m/s, below it the standard's mean friction would grow without bound; estimate
# Share of the load on asperities exp(-B ratio^C): Zhou & Hoeprich 1991, whose text was not at hand.
SHARE_B, SHARE_C = 1.8, 1.2
NO_CONTACT = 1e-9


@kernel
def is_uniform(par: Array) -> bool:
    """Tell if one coefficient of friction holds for the whole path whatever the film does."""
    law = par[L.P_FRICTION_LAW]
    varies = law == L.LI_SEIREG or law == L.MIXED_FRICTION
    return not varies


@kernel
def pressed_more(par: Array, viscosity: float) -> tuple[float, float]:
    """Return alpha at the film's temperature over that at 38 degC [-], its log slope.

    ``viscosity`` [Pa s] of the film tells its temperature; the slope is over the log of it.
    """
    scale, b, c = par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_B], par[L.P_VISCOSITY_C]
    return coefficient_at(viscosity, scale, b, c)


@kernel
def film_scale(par: Array, line: float, turning: float, viscosity: float) -> float:
    """Return the film's factor that all positions share: (mu om)^0.7 (alpha/alpha_38)^0.54 w^-0.13.

    ``viscosity`` [Pa s] of the film.
    """
    alpha, _ = pressed_more(par, viscosity)
    film = 0.7 * math.log(viscosity * turning) + 0.54 * math.log(alpha)
    return math.exp(film - 0.13 * math.log(line))


@kernel
def film_change(
    par: Array, viscosity: float, thicker: float, faster: float, heavier: float
) -> float:
    """Return the relative change of ``film_scale``, from those of viscosity, speed and load."""
    _, slope = pressed_more(par, viscosity)
    return 0.7 * (thicker + faster) + 0.54 * slope * thicker - 0.13 * heavier


@kernel
def _law(par: Array, load: float, rolling: float, oil: float) -> float:
    """Return what both mean coefficients are proportional to, at a load per width [N/m]."""
    return common_law(load, rolling, par[L.D_PITCH_RADIUS], oil, par[L.D_MEAN])


@kernel
def way_of_power(par: Array, load: float) -> tuple[float, float]:
    """Return the sign of a torque [N m], smooth through 0 over the least line load, its slope."""
    width = 2.0 * LEAST_LINE_LOAD / par[L.D_LINE]
    s = min(max(load / width, -1.0), 1.0)
    return 0.5 * s * (3.0 - s * s), 1.5 * (1.0 - s * s) / width


@kernel
def known_friction(par: Array, way: float) -> tuple[float, float]:
    """Return the mean coefficient [-] that loses what the efficiency says, its slope over ``way``.

    The loss over the power of the shaft at hand is that coefficient times D_LOSS; both ways of
    power blend where the friction passes through zero.
    """
    lost, drop = par[L.D_LOST_IN], par[L.D_LOST_OUT]
    mean, slope = 0.5 * (lost + drop) / par[L.D_LOSS], 0.5 * (lost - drop) / par[L.D_LOSS]
    return mean + slope * way, slope


@kernel
def mean_friction(
    par: Array, line: float, turning: float, oil: float, way: float
) -> tuple[float, float, float]:
    """Return the mean coefficient [-] that the loss feels, and two slopes.

    By Schlenk's law, that against scuffing, the constant one, or that of the efficiency. The slopes
    are those over the logarithm of the law at a speed that is held, and over the part of it that
    the speed makes. ``way`` of the power as in ``layout.W_WAY``.
    """
    law = par[L.P_FRICTION_LAW]
    if law == L.EFFICIENCY:
        mu, _ = known_friction(par, way)
        return mu, 0.0, 0.0
    if law == L.CONSTANT:
        return par[L.P_CONSTANT_FRICTION], 0.0, 0.0
    scale = par[L.P_FRICTION_SCALE]
    if law == L.ISO or law == L.LI_SEIREG:
        mu, slope = scuffing_friction(par, line, turning, oil)
        return scale * mu, scale * slope, scale * slope
    rolling = floored(par[L.D_ROLLING] * turning, LEAST_ROLLING)
    slow = 2.0 * math.sin(par[L.D_ANGLE]) * BOUNDARY_SPEED
    lubricant = LOSS_LUBRICANT[int(par[L.P_BASE_OIL]) - 1]
    mu, by_law, by_speed = schlenk_and_slopes(
        _law(par, line, rolling, oil), rolling, slow, lubricant, par[L.P_BOUNDARY_FRICTION]
    )
    return scale * mu, scale * by_law, scale * by_speed


@kernel
def scuffing_friction(par: Array, line: float, turning: float, oil: float) -> tuple[float, float]:
    """Return the scuffing standard's mean coefficient [-] and its log slope."""
    rolling = floored(par[L.D_ROLLING] * turning, LEAST_ROLLING)
    law = _law(par, line * par[L.D_UNIT_LOAD] / par[L.D_LOAD], rolling, oil)
    return iso_and_slope(law, SCUFFING_LUBRICANT[int(par[L.P_BASE_OIL]) - 1], par[L.P_F0])


@kernel
def local_over_loss(par: Array) -> float:
    """Return the friction of the flash over that of the loss [-] where both are local."""
    if par[L.P_FRICTION_LAW] != L.MIXED_FRICTION:
        return 1.0
    kind = int(par[L.P_BASE_OIL]) - 1
    other = LOSS_LUBRICANT[0] * SCUFFING_LUBRICANT[kind] / LOSS_LUBRICANT[kind]
    return other / (loss_over_scuffing(par) * par[L.P_FRICTION_SCALE])


@kernel
def contact_share(ratio: float) -> tuple[float, float]:
    """Return the share of the load on asperities [-], its slope over the log of the film ratio."""
    power = SHARE_B * math.exp(SHARE_C * math.log(ratio))
    share = math.exp(-power)
    return share, -SHARE_C * power * share


@kernel
def film_friction(
    par: Array, k: int, line: float, turning: float, viscosity: float, film: float
) -> tuple[float, float, float, float]:
    """Return the friction [-] of an Eyring film at position ``k``, and log slopes.

    tau = tau_0 asinh(mu exp(alpha p) V_s/(h tau_0)) over the mean pressure p, at most
    limiting_traction. The slopes are those over the shear rate, over the pressure, over alpha.
    """
    pressure = par[np.uintp(L.D_PATH_PRESSURE + k)] * math.sqrt(line)
    eyring, thick = par[L.P_EYRING_STRESS], par[L.D_ALPHA] * pressure
    thick *= pressed_more(par, viscosity)[0]
    sliding = abs(par[np.uintp(L.D_POSITION + k)]) * par[L.D_SLIDE] * turning
    shear = viscosity * math.exp(min(thick, 200.0)) * sliding / (film * eyring)
    stress, steep = eyring * math.asinh(shear), eyring * shear / math.hypot(1.0, shear)
    limit = par[L.P_LIMITING_TRACTION]
    value, slope = soft_least(stress / pressure, limit, 0.1 * limit)
    thicker = thick if thick < 200.0 else 0.0
    by_alpha = slope * steep * thicker / pressure
    return value, slope * steep / pressure, by_alpha - slope * stress / pressure, by_alpha


@kernel
def boundary_friction(par: Array, wanted: float, contact: float) -> tuple[float, float]:
    """Return the friction [-] of asperities with that share of it left to them, and its slope."""
    f0 = par[L.P_F0]
    if f0 <= 0.0:
        return 0.0, 0.0
    least, slope = soft_least(wanted / (contact + NO_CONTACT), f0, 0.1 * f0)
    friction, rest = soft_most(least, 0.0, 0.05 * f0)
    return friction, slope * rest


@kernel
def fill_friction(
    par: Array, line: float, turning: float, oil: float, viscosity: float, work: Array
) -> float:
    """Fill friction of all positions and the hottest one's place; return the mean for the loss.

    ``oil`` and ``viscosity`` [Pa s] of the oil supplied and in the film; ``line`` [N/m]. The
    friction of the flash is that against scuffing, of the law "constant" the constant one; where
    friction is local its mean is that.
    """
    mean, work[L.F_FRICTION_SLOPE], work[L.F_SPEED_SLOPE] = mean_friction(
        par, line, turning, oil, work[L.W_WAY]
    )
    place = int(par[L.D_HOTTEST])
    work[L.W_PLACE], work[L.F_FRICTION], work[L.F_MEAN_FRICTION] = float(place), mean, mean
    if is_uniform(par):
        work[L.F_SCUFFING_FRICTION], work[L.F_SCUFFING_SLOPE] = mean, 0.0
        if par[L.P_FRICTION_LAW] != L.CONSTANT:
            found, work[L.F_SCUFFING_SLOPE] = scuffing_friction(par, line, turning, oil)
            work[L.F_SCUFFING_FRICTION] = found
        return mean
    scale = film_scale(par, line, turning, viscosity)
    if par[L.P_FRICTION_LAW] == L.MIXED_FRICTION:
        _share_load(par, line, turning, viscosity, scale, mean, work)
    else:
        for k in range(int(par[L.D_PLACES])):
            radius, _, _ = flanks_at(par, par[L.D_POSITION + k])
            film = par[L.D_PATH_FILM + k] * scale
            work[L.W_FRICTION + k], _ = li_seireg(film, radius, par[L.P_F0], par[L.D_ROUGHNESS])
    mean, hottest = 0.0, -1.0
    for k in range(int(par[L.D_PLACES])):
        friction = work[np.uintp(L.W_FRICTION + k)]
        mean += friction * par[np.uintp(L.D_PATH_LOSS + k)]
        flash = friction * par[np.uintp(L.D_PATH_FLASH + k)]
        if flash > hottest:
            hottest, place = flash, k
    work[L.W_PLACE], work[L.F_MEAN_FRICTION] = float(place), mean
    work[L.F_FRICTION] = work[L.W_FRICTION + place]
    work[L.F_SCUFFING_FRICTION] = local_over_loss(par) * work[L.F_FRICTION]
    return mean


@kernel
def _share_load(
    par: Array,
    line: float,
    turning: float,
    viscosity: float,
    scale: float,
    mean: float,
    work: Array,
) -> None:
    """Fill the friction of film and asperities; that of asperities makes the mean as given."""
    sheared, contact = 0.0, 0.0
    for k in range(int(par[L.D_PLACES])):
        film = par[np.uintp(L.D_PATH_FILM + k)] * scale
        share, _ = contact_share(film / par[L.D_SIGMA])
        found, _, _, _ = film_friction(par, k, line, turning, viscosity, film)
        weight = par[np.uintp(L.D_PATH_LOSS + k)]
        contact += weight * share
        sheared += weight * (1.0 - share) * found
        work[np.uintp(L.W_CONTACT + k)], work[np.uintp(L.W_FRICTION + k)] = share, found
    dry, _ = boundary_friction(par, mean - sheared, contact)
    for k in range(int(par[L.D_PLACES])):
        share = work[np.uintp(L.W_CONTACT + k)]
        sheared = work[np.uintp(L.W_FRICTION + k)]
        work[np.uintp(L.W_FRICTION + k)] = share * dry + (1.0 - share) * sheared


@kernel
def friction_changes(
    par: Array,
    line: float,
    turning: float,
    load: float,
    speed: float,
    oil: float,
    viscosity: float,
    thicker: float,
    work: Array,
) -> tuple[float, float, float]:
    """Return the changes of the mean friction, of that at the hottest position, of its flash's.

    ``load``, ``speed``, ``oil``: relative changes of line load, speed and supplied oil's viscosity;
    ``thicker`` that of the ``viscosity`` in the film.
    """
    rolling = par[L.D_ROLLING] * turning
    faster = floored_slope(rolling, LEAST_ROLLING) * rolling / floored(rolling, LEAST_ROLLING)
    held, moved = 0.2 * load - 0.05 * oil, -0.2 * faster * speed
    mean = work[L.F_FRICTION_SLOPE] * held + work[L.F_SPEED_SLOPE] * moved
    if is_uniform(par):
        return mean, mean, work[L.F_SCUFFING_SLOPE] * (held + moved)
    film = film_change(par, viscosity, thicker, speed, load)
    if par[L.P_FRICTION_LAW] == L.MIXED_FRICTION:
        stiffer = pressed_more(par, viscosity)[1] * thicker
        change = (film, thicker + speed - film, 0.5 * load, stiffer)
        mean, hottest = _shared_changes(par, line, turning, viscosity, change, mean, work)
        return mean, hottest, local_over_loss(par) * hottest
    scale, mean, hottest = film_scale(par, line, turning, viscosity), 0.0, 0.0
    for k in range(int(par[L.D_PLACES])):
        radius, _, _ = flanks_at(par, par[L.D_POSITION + k])
        here = par[L.D_PATH_FILM + k] * scale
        _, slope = li_seireg(here, radius, par[L.P_F0], par[L.D_ROUGHNESS])
        found = slope * film
        mean += found * par[L.D_PATH_LOSS + k]
        if k == int(work[L.W_PLACE]):
            hottest = found
    return mean, hottest, hottest


@kernel
def _shared_changes(
    par: Array,
    line: float,
    turning: float,
    viscosity: float,
    change: tuple[float, float, float, float],
    mean: float,
    work: Array,
) -> tuple[float, float]:
    """Return the changes of the mixed friction; ``change`` of film, shear rate, pressure, alpha."""
    scale, place = film_scale(par, line, turning, viscosity), int(work[L.W_PLACE])
    standard, _, _ = mean_friction(par, line, turning, work[L.F_BULK_VISCOSITY], work[L.W_WAY])
    contact, more, sheared, grows, here, there = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(int(par[L.D_PLACES])):
        film = par[np.uintp(L.D_PATH_FILM + k)] * scale
        share, steep = contact_share(film / par[L.D_SIGMA])
        found, by_shear, by_pressure, by_alpha = film_friction(
            par, k, line, turning, viscosity, film
        )
        weight = par[np.uintp(L.D_PATH_LOSS + k)]
        moved, rising = steep * change[0], by_shear * change[1] + by_pressure * change[2]
        rising += by_alpha * change[3]
        contact += weight * share
        more += weight * moved
        sheared += weight * (1.0 - share) * found
        grows += weight * ((1.0 - share) * rising - moved * found)
        if k == place:
            here, there = moved, (1.0 - share) * rising - moved * found
    wanted = standard - sheared
    dry, slope = boundary_friction(par, wanted, contact)
    room = contact + NO_CONTACT
    drier = slope * (mean - grows - wanted / room * more) / room
    mean = more * dry + contact * drier + grows
    return mean, here * dry + work[np.uintp(L.W_CONTACT + place)] * drier + there
