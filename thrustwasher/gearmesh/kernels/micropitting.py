# mypy: disable-error-code="no-any-return"
"""Film along the path of contact against micropitting, each place with its own temperature.

ISO/TS 6336-22 (ISO/TR 15144-1), method B, as publicly quoted; the standard's text was not at hand.
The standard's own friction and its own steady temperature of the bodies go into it, whatever the
loss does. So does its own sharing of the load where two spur pairs are in contact, unless stiffness
shares it; near both ends of the path a helical tooth bears more.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import floored, floored_slope, smoothstep
from . import layout as L
from .contact import pressure_coefficient
from .flank_temperature import LOWEST_OIL
from .mesh_point import thinning
from .path_of_contact import JOINS, base_pitch, even_part, pair_share

LEAST_ROLLING = 0.1  # m/s, sum of the speeds at the pitch point; as of the other mean frictions
BUTTRESS = 0.3  # more load at both ends of the path with an overlap of 1 and more
BUTTRESS_LENGTH = 0.2e-3  # m along the path, times the sine of the base helix angle
AT_END = 1.0 / 3.0  # of the load on a spur pair where contact begins and ends; twice that at B, D
OF_UNITS = math.log(1.6) - 0.7 * math.log(2.0)
SLIDING = 0.22  # power of the sliding parameter


@kernel
def buttress(par: Array, position: float) -> float:
    """Return X_but [-]: what helical teeth bear more at both ends of the path."""
    length = par[L.D_BUTTRESS]
    off = max(min(position + par[L.D_APPROACH], par[L.D_RECESS] - position), 0.0)
    if off >= length:  # spur teeth, whose length is 0, have none
        return 1.0
    return 1.0 + BUTTRESS * min(par[L.D_OVERLAP], 1.0) * (1.0 - off / length)


@kernel
def spur_part(par: Array, position: float, share: float) -> float:
    """Return the share [-] of the load at a place, over ``share``, the equal one of the mesh.

    Of two spur pairs in contact the one that begins or ends bears a third of the load, rising to
    two thirds where the other one leaves; the more overlap, the less of that counts. It fades as
    a place bears more than half of the load, and between contact ratios of 2 and 2.05, so that
    nothing jumps.
    """
    contact, one, two = par[L.D_CONTACT_RATIO], pair_share(par, 1.0), pair_share(par, 2.0)
    if par[L.P_LOAD_SHARING] == L.ELASTIC or not (contact > 1.0 and one > two):
        return 1.0
    reach = min(contact - 1.0, 1.0)  # base pitches in which two pairs are in contact
    off = max(min(position + par[L.D_APPROACH], par[L.D_RECESS] - position, reach), 0.0)
    counts = min(max((one - share) / (one - two), 0.0), 1.0)
    counts *= 1.0 - smoothstep((contact - 2.0) / JOINS)
    uneven = counts * (2.0 * AT_END * (1.0 + off / reach) - 1.0)
    return 1.0 + uneven * (1.0 - even_part(par) / (contact * share))


@kernel
def film_constant(radius: float, rolling: float, load: float, stiff: float) -> float:
    """Return ln of the film [m] at viscosity, speed, line load, pressure coefficient of 1.

    symbol   meaning                                                      unit
    radius   combined radius across the contact line                      m
    rolling  sum of both rolling speeds per speed of the pinion           m
    load     line load there, load factors included, over the nominal     -
    stiff    E_r, reduced modulus                                         Pa

    h = 1600 rho G^0.6 U^0.7 W^-0.13 S^0.22 (um; rho in mm): G = alpha E_r, U = eta (v1 + v2)/
    (2 E_r rho), W = 2 pi p_dyn^2/E_r^2 = w/(E_r rho); the powers of rho and E_r are put together.
    The sliding parameter S is 1 here.
    """
    film = OF_UNITS + 0.43 * math.log(radius) + 0.03 * math.log(stiff)
    return film + 0.7 * math.log(rolling) - 0.13 * math.log(load)


@kernel
def local_film(
    constant: float,
    pressed: float,
    bulk: float,
    flash: float,
    viscosity: tuple[float, float, float],
) -> float:
    """Return ln of the film [m] at a place of the path.

    ``constant`` as of ``film_constant``, ``pressed`` ln of om^0.7 w^-0.13 alpha_38^0.6, ``bulk``
    [K] of the bodies, ``flash`` [K] there, ``viscosity`` the three numbers of its law.
    """
    scale, b, c = viscosity
    cold, hot = max(bulk, LOWEST_OIL) - 273.15 + c, max(bulk + flash, LOWEST_OIL) - 273.15 + c
    alpha, _ = pressure_coefficient(bulk)
    there, _ = pressure_coefficient(bulk + flash)
    sliding = math.log(there / alpha) + b * (1.0 / hot - 1.0 / cold)
    return (
        constant
        + pressed
        + 0.6 * math.log(alpha)
        + 0.7 * (math.log(scale) + b / cold)
        + SLIDING * sliding
    )


@kernel
def thinnest_films(par: Array) -> None:
    """Fill the places of the path that may have the thinnest film, their films and flashes.

    A place whose film constant is no less than another's and whose flash is no more can never
    have the least film: it is left out. Should more than there is room for be left, the last ones
    are dropped; neighbours differ little.
    """
    line, apart = _line(par)
    count = 0
    for k in range(int(par[L.D_PLACES])):
        film, flash = _place_film(par, k, line, apart)
        kept, beaten = 0, False
        for i in range(count):
            other, hot = par[L.D_GF_FILM + i], par[L.D_GF_FLASH + i]
            if other <= film and hot >= flash:
                beaten = True
                break
        if beaten:
            continue
        for i in range(count):
            if film <= par[L.D_GF_FILM + i] and flash >= par[L.D_GF_FLASH + i]:
                continue
            par[L.D_GF + kept] = par[L.D_GF + i]
            par[L.D_GF_FILM + kept] = par[L.D_GF_FILM + i]
            par[L.D_GF_FLASH + kept] = par[L.D_GF_FLASH + i]
            kept += 1
        kept = min(kept, L.N_GF - 1)
        par[L.D_GF + kept] = float(k)
        par[L.D_GF_FILM + kept], par[L.D_GF_FLASH + kept] = film, flash
        count = kept + 1
    par[L.D_GF_PLACES] = float(count)


@kernel
def derive_micropitting(par: Array, lubricant: float) -> None:
    """Fill ln of the standard's mean friction and of the bodies' rise, at load and speed of 1.

    With them the length of the buttresses in base pitches. ``lubricant``: X_L of the base oil.

    mu = 0.045 (K K_Bgamma F_bt/(b v_SigmaC rho_nC))^0.2 eta^-0.05 2.2 (Ra/rho_nC)^0.25 X_L in N/mm,
    m/s, mm, mPa s, um; rise = 7400 (P mu H_v/(a b))^0.72 X_S/1.2 in kW, mm. H_v is that of spur
    teeth with the transverse path of contact.
    """
    radius = 1e3 * par[L.D_PITCH_RADIUS] / par[L.D_COS_BASE]
    load = 1e-3 * par[L.D_FACTOR] * par[L.D_HELICAL] / (par[L.D_ROLLING] * radius)
    rough = 2.2 * math.exp(0.25 * math.log(1e6 * par[L.D_MEAN] / radius))
    friction = math.log(0.045 * lubricant * rough) + 0.2 * math.log(load)
    par[L.D_GF_FRICTION] = friction - 0.05 * math.log(1e3)
    power = 1e-3 * par[L.D_LOSS_SPUR] / par[L.D_LOAD]
    power /= 1e6 * par[L.D_CENTRE] * par[L.P_FACE_WIDTH]
    rise = math.log(7400.0 * par[L.P_LUBRICATION_FACTOR] / 1.2)
    par[L.D_GF_RISE] = rise + 0.72 * math.log(power)
    sine = math.sqrt(max(1.0 - par[L.D_COS_BASE] * par[L.D_COS_BASE], 0.0))
    ratio, teeth, angle = par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH], par[L.D_ANGLE]
    pitch = base_pitch(ratio, teeth, angle, par[L.D_SIDE]) * par[L.D_CENTRE] * math.sin(angle)
    par[L.D_BUTTRESS] = BUTTRESS_LENGTH * sine / pitch


@kernel
def _scales(
    par: Array, line: float, turning: float, viscosity: float
) -> tuple[float, float, float]:
    """Return rise of the bodies [K], flash [K] and ln of the film that all places share."""
    load, speed = math.log(line), math.log(turning)
    rolling = floored(par[L.D_ROLLING] * turning, LEAST_ROLLING) / par[L.D_ROLLING]
    friction = par[L.D_GF_FRICTION] + 0.2 * (load - math.log(rolling))
    friction -= 0.05 * math.log(viscosity)
    rise = math.exp(par[L.D_GF_RISE] + 0.72 * (load + speed + friction))
    heat = math.exp(friction + 0.75 * load + 0.5 * speed)
    pressed = 0.7 * speed - 0.13 * load + 0.6 * math.log(par[L.D_ALPHA])
    return rise, heat, pressed


@kernel
def _line(par: Array) -> tuple[float, float]:
    """Return the length of the line of action [m], the base pitch over it."""
    ratio, angle, side = par[L.P_GEAR_RATIO], par[L.D_ANGLE], par[L.D_SIDE]
    apart = base_pitch(ratio, par[L.P_PINION_TEETH], angle, side)
    return par[L.D_CENTRE] * math.sin(angle), apart


@kernel
def _place_film(par: Array, k: int, line: float, apart: float) -> tuple[float, float]:
    """Return ln of the film's constant and the flash of a friction of 1 at place ``k``.

    ``line``, ``apart`` as ``_line`` returns them.
    """
    ratio, side, position = par[L.P_GEAR_RATIO], par[L.D_SIDE], par[np.uintp(L.D_POSITION + k)]
    x = 1.0 / (ratio + side) + position * apart
    radius = x * (1.0 - side * x) * line / par[L.D_COS_BASE]
    rolling = (x + (1.0 - side * x) / ratio) * line
    share = par[np.uintp(L.D_PATH_SHARE + k)]
    more = par[L.D_FACTOR] * buttress(par, position) * spur_part(par, position, share)
    load, root = more * share, math.sqrt(more)
    film = film_constant(radius, rolling, load, 2.0 / par[L.D_THETA])
    return film, par[np.uintp(L.D_PATH_FLASH + k)] * root * math.sqrt(root)


@kernel
def film_ratio_at(
    par: Array, k: int, line: float, turning: float, oil: float, viscosity: float
) -> float:
    """Return the film over Ra against micropitting [-] at place ``k``; as ``fill_micropitting``."""
    rise, heat, pressed = _scales(par, line, turning, viscosity)
    law = (par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_B], par[L.P_VISCOSITY_C])
    line_of, apart = _line(par)
    film, flash = _place_film(par, k, line_of, apart)
    return math.exp(local_film(film, pressed, oil + rise, heat * flash, law)) / par[L.D_MEAN]


@kernel
def fill_micropitting(
    par: Array, line: float, turning: float, oil: float, viscosity: float, work: Array
) -> None:
    """Fill the least film over Ra, its place, rise of the bodies [K] and flash [K] there.

    ``viscosity`` [Pa s] at the oil's temperature ``oil`` [K]; ``line`` [N/m] the nominal load.
    """
    rise, heat, pressed = _scales(par, line, turning, viscosity)
    law = (par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_B], par[L.P_VISCOSITY_C])
    least, place, most = math.inf, 0, 0.0
    for i in range(int(par[L.D_GF_PLACES])):
        flash = heat * par[np.uintp(L.D_GF_FLASH + i)]
        film = local_film(par[np.uintp(L.D_GF_FILM + i)], pressed, oil + rise, flash, law)
        if film < least:
            least, place, most = film, i, flash
    work[L.F_FILM_GF] = math.exp(least) / par[L.D_MEAN]
    work[L.F_GF_PLACE], work[L.F_GF_RISE] = par[np.uintp(L.D_GF + place)], rise
    work[L.F_GF_FLASH] = most


@kernel
def micropitting_change(
    par: Array, turning: float, oil: float, change: tuple[float, float, float, float], work: Array
) -> float:
    """Return the change of the least film over Ra, at the place that has it.

    ``change``: relative of line load and speed, of the oil [K], relative of its viscosity.
    """
    load, speed, warmer, thin = change
    sum_of_speeds = par[L.D_ROLLING] * turning
    rolls = floored_slope(sum_of_speeds, LEAST_ROLLING) * sum_of_speeds
    rolls *= speed / floored(sum_of_speeds, LEAST_ROLLING)
    friction = 0.2 * (load - rolls) - 0.05 * thin
    bulk = oil + work[L.F_GF_RISE]
    hot = bulk + work[L.F_GF_FLASH]
    dbulk = warmer + work[L.F_GF_RISE] * 0.72 * (load + speed + friction)
    dhot = dbulk + work[L.F_GF_FLASH] * (friction + 0.75 * load + 0.5 * speed)
    alpha = pressure_coefficient(bulk)[1] * dbulk
    there = pressure_coefficient(hot)[1] * dhot
    eta, eta_there = thinning(par, bulk) * dbulk, thinning(par, hot) * dhot
    film = 0.7 * (eta + speed) - 0.13 * load + 0.6 * alpha
    return work[L.F_FILM_GF] * (film + SLIDING * (there - alpha + eta_there - eta))
