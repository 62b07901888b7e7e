# mypy: disable-error-code="no-any-return"
"""The mesh heated by all of its loss: friction along the path, bodies, the hottest position."""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import floored, floored_slope, soft_most, soft_size, soft_size_slope
from ...numerics.status import HOT, OK, OUTSIDE_VERIFIED
from ...tribology.lumped_body import rise_after, rise_changes
from . import layout as L
from .contact import hertz_width
from .directional_derivative import asperity_changes, flash_change
from .mesh_point import (
    HOT_FILM,
    LEAST_LINE_LOAD,
    LEAST_SPEED,
    contact_weight,
    outside,
    stress_asperities,
    thinning,
    viscosity_at,
    viscosity_follows,
)
from .micropitting import fill_micropitting, micropitting_change
from .path_friction import (
    fill_friction,
    film_change,
    film_scale,
    friction_changes,
    is_uniform,
    known_friction,
    way_of_power,
)
from .path_of_contact import flanks_at

HALVINGS = 52


@kernel
def conductance(par: Array, line: float, turning: float) -> tuple[float, float]:
    """Return G [W/K] from bodies to oil, and its slope over the log of w^(1/4) om^(1/2).

    As given, or such that the steady bodies are as much warmer than the oil as ``derive_path``
    says; at least that of gears at rest.
    """
    given, still = par[L.P_BULK_CONDUCTANCE], par[L.D_STILL]
    if given > 0.0:
        return given, 0.0
    free = par[L.D_CONDUCTANCE] * math.sqrt(math.sqrt(line) * turning)
    found, slope = soft_most(free, still, 0.5 * still)
    return found, slope * free


@kernel
def steady_rise(
    par: Array, line: float, turning: float, oil: float, rate: float, cooling: float, work: Array
) -> float:
    """Return how much warmer than the oil [K] the steady bodies are.

    T - T_oil = rate f(T)/G, ``rate`` [W] the loss of a friction of 1 and f the mean friction with a
    film of the bodies' temperature; by halving, from nothing to the largest friction's.
    """
    thin = viscosity_at(par, oil)
    follows, _, _ = viscosity_follows(par)
    if is_uniform(par) or not follows or rate == 0.0:
        return rate * fill_friction(par, line, turning, thin, thin, work) / cooling
    low, high = 0.0, rate * max(par[L.P_F0], par[L.P_LIMITING_TRACTION]) / cooling
    for _ in range(HALVINGS):
        rise = 0.5 * (low + high)
        found = fill_friction(par, line, turning, thin, viscosity_at(par, oil + rise), work)
        if rate * found / cooling > rise:
            low = rise
        else:
            high = rise
    return low


@kernel
def heat_of_loss(
    par: Array,
    torque: float,
    speed: float,
    oil: float,
    drive: float,
    state: Array,
    dt: float,
    work: Array,
) -> int:
    """Fill ``work[:N_FIELD]`` but loss and safety; return 0, an advice or a failure.

    ``drive`` [W]: power that the mesh transmits; the loss is friction x D_LOSS x drive.
    """
    turning = floored(speed, LEAST_SPEED)
    line = floored(torque * par[L.D_LINE], LEAST_LINE_LOAD)
    cooling, _ = conductance(par, line, turning)
    follows, _, _ = viscosity_follows(par)
    thin, rate = viscosity_at(par, oil), par[L.D_LOSS] * drive
    above, began = 0.0, L.OILS
    quasi_steady = par[L.P_THERMAL_MODE] == L.QUASI_STEADY
    if quasi_steady:
        dt = 0.0
    if state[L.S_STARTED] != 0.0 and not quasi_steady:
        above, began = state[L.S_BULK] - oil, L.HELD
    elif par[L.P_THERMAL_START] == L.STEADY_START or quasi_steady:
        above = steady_rise(par, line, turning, oil, rate, cooling, work)
        began = L.STEADY
    viscosity = viscosity_at(par, oil + above) if follows else thin
    power = rate * fill_friction(par, line, turning, thin, viscosity, work)
    after, to_oil = rise_after(par[L.D_BULK_CAPACITY], above, power, cooling, dt)
    work[L.W_BEGAN], work[L.W_FROM], work[L.W_DURATION] = float(began), above, dt
    work[L.F_ITERATIONS] = 0.0
    work[L.F_BULK], work[L.F_OIL_HEAT] = oil + after, to_oil
    work[L.F_STORED] = state[L.S_STORED] + (power - to_oil) * dt
    work[L.F_BULK_VISCOSITY], work[L.F_VISCOSITY] = thin, viscosity
    _fill_hottest(par, torque, line, turning, work)
    fill_micropitting(par, line, turning, oil, thin, work)
    status = OK
    if work[L.F_FILM_TEMPERATURE] > HOT_FILM:
        status = HOT
    elif outside(par, oil, work):
        status = OUTSIDE_VERIFIED
    work[L.F_STATUS] = float(status)
    return status


@kernel
def _sheared_rise(par: Array, flank: float, sliding: float) -> tuple[float, float, float]:
    """Return how much hotter than its flanks [K] sheared oil gets, and the slopes of that.

    ln(1 + beta Q)/beta, Q = mu u^2/(8 k), with mu(T) of slope beta at the flank's temperature and
    ambient pressure (Nahme; Gruntfest): no thickness, no load. Slopes over ``flank`` [K] and over
    the log of the ``sliding`` speed.
    """
    free = viscosity_at(par, flank) * sliding * sliding / (8.0 * par[L.P_OIL_CONDUCTIVITY])
    beta = -thinning(par, flank)
    if beta == 0.0:
        return free, 0.0, 2.0 * free
    rise, eased = math.log1p(beta * free) / beta, free / (1.0 + beta * free)
    turn = -2.0 / (flank - 273.15 + par[L.P_VISCOSITY_C])  # relative slope of beta
    return rise, eased * (turn - beta) - rise * turn, 2.0 * eased


@kernel
def _fill_hottest(par: Array, torque: float, line: float, turning: float, work: Array) -> None:
    """Fill contact, film, temperatures and stresses of the hottest position, path's extremes."""
    place, factor = int(work[L.W_PLACE]), par[L.D_FACTOR]
    radius, rolling, sliding = par[L.D_HOT_RADIUS], par[L.D_HOT_ROLLING], par[L.D_HOT_SLIDING]
    borne, film = factor * par[L.D_HOT_SHARE], par[L.D_HOT_FILM]
    if not is_uniform(par):  # the hottest place moves with the inputs
        radius, v1, v2 = flanks_at(par, par[np.uintp(L.D_POSITION + place)])
        rolling, sliding = v1 + v2, abs(v1 - v2)
        borne = factor * par[np.uintp(L.D_PATH_SHARE + place)]
        film = par[np.uintp(L.D_PATH_FILM + place)]
    width = hertz_width(borne * line, radius, par[L.D_THETA])
    work[L.F_LINE_LOAD], work[L.F_WIDTH] = borne * line, width
    work[L.F_PRESSURE] = borne * line / width
    film *= film_scale(par, line, turning, work[L.F_VISCOSITY])
    work[L.F_FILM], work[L.F_RATIO] = film, film / par[L.D_SIGMA]
    work[L.F_PRESSURE_MAX] = 4.0 / math.pi * par[L.D_PRESSURE_MOST] * math.sqrt(factor * line)
    work[L.F_STRESS], work[L.F_SLIDING] = work[L.F_PRESSURE_MAX], sliding * turning
    rubbing = soft_size(torque * par[L.D_LINE], 2.0 * LEAST_LINE_LOAD)
    friction, quarter = work[L.F_SCUFFING_FRICTION], math.sqrt(math.sqrt(line))
    flash = friction * par[np.uintp(L.D_PATH_FLASH + place)] * par[L.D_FLASH_FACTOR]
    flash *= rubbing / quarter * math.sqrt(turning)
    work[L.F_FLASH] = work[L.F_FLASH_MAX] = flash
    work[L.F_SURFACE] = work[L.F_BULK] + flash
    sheared = _sheared_rise(par, work[L.F_SURFACE], work[L.F_SLIDING])[0]
    carried = friction * borne * rubbing * work[L.F_SLIDING]
    carried /= 0.5 * rolling * turning * film * par[L.D_OIL_CAPACITY]
    both = sheared + carried
    work[L.F_FILM_RISE] = sheared * carried / both if both > 0.0 else 0.0
    work[L.F_FILM_TEMPERATURE] = work[L.F_SURFACE] + work[L.F_FILM_RISE]
    work[L.F_WEIGHT] = contact_weight(par, work[L.F_RATIO])
    stress_asperities(par, work[L.F_BULK], work)


@kernel
def loss_changes(
    par: Array,
    torque: float,
    speed: float,
    oil: float,
    rate: float,
    more: float,
    seed: Array,
    warms: float,
    work: Array,
    dout: Array,
) -> None:
    """Fill the changes of ``heat_of_loss`` along ``seed``.

    ``rate`` [W] is the loss of a friction of 1, ``more`` its change. The temperature at which a
    step began is held and changes by ``warms`` [K], but for the first one, which begins as its
    inputs say.
    """
    turning = floored(speed, LEAST_SPEED)
    line = floored(torque * par[L.D_LINE], LEAST_LINE_LOAD)
    faster = floored_slope(speed, LEAST_SPEED) * seed[L.I_SPEED] / turning
    pressed = floored_slope(torque * par[L.D_LINE], LEAST_LINE_LOAD) * par[L.D_LINE]
    load, warmer = pressed * seed[L.I_LOAD] / line, seed[L.I_OIL]
    cooling, slope = conductance(par, line, turning)
    cooler = slope * (0.25 * load + 0.5 * faster)
    follows, _, _ = viscosity_follows(par)
    above, dt, viscosity = work[L.W_FROM], work[L.W_DURATION], work[L.F_VISCOSITY]
    mean, thin = work[L.F_MEAN_FRICTION], thinning(par, oil) * warmer
    steep = thinning(par, oil + above) if follows else 0.0
    held = 0.0 if follows else thin  # change of the film's viscosity with the body's held
    dmean, hottest, scuffs = friction_changes(
        par, line, turning, load, faster, thin, viscosity, held, work
    )
    if par[L.P_FRICTION_LAW] == L.EFFICIENCY:
        smooth = work[L.F_SMOOTH_SIGN]
        way, turn = way_of_power(par, torque)
        turns = way * (1.0 - smooth) * (1.0 + smooth) / work[L.W_WIDTH] * seed[L.I_SPEED]
        turns += smooth * turn * seed[L.I_LOAD]
        dmean = hottest = known_friction(par, work[L.W_WAY])[1] * turns
    by_body, hot_by_body, scuffs_by_body = friction_changes(
        par, line, turning, 0.0, 0.0, 0.0, viscosity, steep, work
    )
    dabove = -warmer + warms if work[L.W_BEGAN] == L.HELD else 0.0
    if work[L.W_BEGAN] == L.STEADY:
        rise = more * mean + rate * (dmean + by_body * warmer) - rate * mean / cooling * cooler
        dabove = rise / (cooling - rate * by_body)
    dbody = warmer + dabove
    dmean += by_body * dbody
    hottest += hot_by_body * dbody
    scuffs += scuffs_by_body * dbody
    power, dpower = rate * mean, more * mean + rate * dmean
    dafter, dheat = rise_changes(
        par[L.D_BULK_CAPACITY], above, power, cooling, dt, (dabove, dpower, cooler)
    )
    dafter += warmer
    dout[L.F_MEAN_FRICTION], dout[L.F_FRICTION], dout[L.F_BULK] = dmean, hottest, dafter
    dout[L.F_OIL_HEAT], dout[L.F_STORED] = dheat, 0.0
    film = film_change(par, viscosity, held + steep * dbody, faster, load)
    part = scuffs / work[L.F_SCUFFING_FRICTION] if work[L.F_SCUFFING_FRICTION] > 0.0 else 0.0
    flash = flash_change(par, work, torque, load, faster, seed[L.I_LOAD], part)
    dout[L.F_FLASH] = dout[L.F_FLASH_MAX] = flash
    dout[L.F_SCUFFING_FRICTION] = scuffs
    change = (load, faster, warmer, thin)
    dout[L.F_FILM_GF] = micropitting_change(par, turning, oil, change, work)
    dout[L.F_PRESSURE_MAX] = 0.5 * work[L.F_PRESSURE_MAX] * load
    surface = dafter + flash
    hotter = surface + _film_change(par, work, torque, film, surface, faster, seed, part)
    asperity_changes(par, work, dafter, film, surface, hotter, flash, hottest, load, dout)


@kernel
def _film_change(
    par: Array,
    work: Array,
    torque: float,
    film: float,
    surface: float,
    speed: float,
    seed: Array,
    friction: float,
) -> float:
    """Return the change of the film's rise over the flank [K]; ``friction``: relative change."""
    line, corner = torque * par[L.D_LINE], 2.0 * LEAST_LINE_LOAD
    rubbing, rise = soft_size(line, corner), work[L.F_FILM_RISE]
    if not rise > 0.0:
        return 0.0
    grows = soft_size_slope(line, corner) * par[L.D_LINE] * seed[L.I_LOAD] / rubbing
    sheared, warmer, faster = _sheared_rise(par, work[L.F_SURFACE], work[L.F_SLIDING])
    part = rise / sheared  # that of the carried heat; the rest is the shear's
    carried = friction + grows - film
    return part * part * (warmer * surface + faster * speed) + (1.0 - part) * rise * carried
