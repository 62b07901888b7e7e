# mypy: disable-error-code="no-any-return"
"""Bending stress at the root of the teeth, nominal: method B of ISO 6336-3 as publicly quoted.

The fillet is that of a rack whose tip is rounded; its tangent at 30 degrees to the middle of the
tooth decides. The load stands at the outer end of single contact. A ring has no rack: its root is
not rated. The standard's own text was not at hand.
"""

import math

from ...numerics.jit import Array, kernel
from . import layout as L
from .working_pair import gear_shift, involute, section, tips

TANGENT = math.pi / 3.0  # the tangent makes 30 degrees with the middle of the tooth
NEWTON = 60  # steps of Newton's method; about 6 are taken
STRESS_CORRECTION = 2.0  # Y_ST, of the test gears behind the limit; other factors of the limit: 1
STEEPEST_HELIX = math.pi / 6.0  # the helix angle counts up to here


@kernel
def corner_left(par: Array) -> float:
    """Return half the width that is left at the rack's tip [modules]: not below 0."""
    angle, radius = par[L.P_PRESSURE_ANGLE], par[L.P_TOOL_TIP_RADIUS]
    left = 0.25 * math.pi - par[L.P_TOOL_ADDENDUM] * math.tan(angle)
    return left - (1.0 - math.sin(angle)) * radius / math.cos(angle)


@kernel
def tangent_angle(teeth: float, shift: float, par: Array) -> float:
    """Return theta [rad] at which the fillet's tangent stands at 30 degrees.

    theta = 2 G/z tan(theta) - H, by Newton's method from 30 degrees.
    """
    deep = par[L.P_TOOL_TIP_RADIUS] - par[L.P_TOOL_ADDENDUM] + shift
    aside = 2.0 / teeth * (0.5 * math.pi - corner_left(par)) - TANGENT
    theta = math.pi / 6.0
    for _ in range(NEWTON):
        tangent = math.tan(theta)
        slope = 1.0 - 2.0 * deep / teeth * (1.0 + tangent * tangent)
        step = (theta - 2.0 * deep / teeth * tangent + aside) / slope
        theta -= step
        if abs(step) <= 1e-14:
            break
    return theta


@kernel
def root_section(teeth: float, shift: float, par: Array) -> tuple[float, float, float]:
    """Return chord and radius of the fillet, its height below the middle of the gear [modules].

    ``teeth`` of the spur gear that stands for a helical one.
    """
    radius = par[L.P_TOOL_TIP_RADIUS]
    deep = radius - par[L.P_TOOL_ADDENDUM] + shift
    theta = tangent_angle(teeth, shift, par)
    reach = deep / math.cos(theta) - radius
    chord = teeth * math.sin(TANGENT - theta) + math.sqrt(3.0) * reach
    turn = math.cos(theta) * (teeth * math.cos(theta) * math.cos(theta) - 2.0 * deep)
    return chord, radius + 2.0 * deep * deep / turn, teeth * math.cos(TANGENT - theta) + reach


@kernel
def root_factors(
    par: Array, teeth: float, shift: float, tip: float, contact: float
) -> tuple[float, float]:
    """Return form factor Y_F and stress correction Y_S [-] of an external gear; 0, 0: none.

    ``tip`` its radius [m], ``contact`` the transverse contact ratio.
    """
    if not corner_left(par) >= 0.0:
        return 0.0, 0.0
    helix, angle = par[L.P_HELIX_ANGLE], par[L.P_PRESSURE_ANGLE]
    _, _, module = tips(par)
    _, _, _, cos_base = section(par)
    virtual = teeth / (cos_base * cos_base * math.cos(helix))
    chord, fillet, below = root_section(virtual, shift, par)
    radius = 0.5 * virtual
    base = radius * math.cos(angle)
    top = radius + tip / module - 0.5 * teeth / math.cos(helix)
    flank = math.sqrt(max(top * top - base * base, 0.0))
    flank -= math.pi * math.cos(angle) * max(contact / (cos_base * cos_base) - 1.0, 0.0)
    load = math.sqrt(flank * flank + base * base)
    pressed = math.acos(base / load)
    half = (0.5 * math.pi + 2.0 * math.tan(angle) * shift) / virtual
    half += involute(angle) - involute(pressed)
    acts = pressed - half
    arm = (math.cos(half) - math.sin(half) * math.tan(acts)) * load - 0.5 * below
    if not (chord > 0.0 and arm > 0.0 and fillet > 0.0):
        return 0.0, 0.0
    form = 6.0 * arm * math.cos(acts) / (chord * chord * math.cos(angle))
    slender, notch = chord / arm, 0.5 * chord / fillet
    correction = (1.2 + 0.13 * slender) * math.exp(math.log(notch) / (1.21 + 2.3 / slender))
    return form, correction


@kernel
def derive_root(par: Array) -> None:
    """Fill the stress at both roots per line load [1/m], and over the limit of each gear [1/N m].

    Y_beta = 1 - eps_beta beta/120 deg with eps_beta at most 1, beta at most 30 deg. Teeth of the
    pinion that bend both ways bear the share ``reversed_bending`` of the limit.
    """
    side, _, angle, _ = section(par)
    tip, tip_gear, module = tips(par)
    helix = min(par[L.P_HELIX_ANGLE], STEEPEST_HELIX)
    slant = 1.0 - min(par[L.D_OVERLAP], 1.0) * helix / (2.0 * math.pi / 3.0)
    scale = par[L.D_FACTOR] * slant * math.cos(angle) / module
    teeth, contact = par[L.P_PINION_TEETH], par[L.D_CONTACT_RATIO]
    form, correction = root_factors(par, teeth, par[L.P_PROFILE_SHIFT_PINION], tip, contact)
    par[L.D_ROOT_PINION], par[L.D_ROOT_GEAR] = scale * form * correction, 0.0
    par[L.D_ROOT_USED] = 0.0
    if not form > 0.0:
        return
    if side > 0.0:
        teeth *= par[L.P_GEAR_RATIO]
        form, correction = root_factors(par, teeth, gear_shift(par), tip_gear, contact)
        par[L.D_ROOT_GEAR] = scale * form * correction
    limit = par[L.P_ROOT_LIMIT]
    if limit > 0.0:
        own = par[L.P_ROOT_LIMIT_GEAR] if par[L.P_ROOT_LIMIT_GEAR] > 0.0 else limit
        worst = max(
            par[L.D_ROOT_PINION] / (par[L.P_REVERSED_BENDING] * limit), par[L.D_ROOT_GEAR] / own
        )
        par[L.D_ROOT_USED] = worst / STRESS_CORRECTION


@kernel
def root_rule(par: Array, contact: float) -> int:
    """Return the number of the rule on the rack that is broken; 0: none.

    ``contact`` the transverse contact ratio.
    """
    if 0.0 < par[L.P_ROOT_LIMIT] < 1e7:
        return 19
    if not par[L.P_ROOT_LIMIT] > 0.0:
        return 0
    if not corner_left(par) >= 0.0:
        return 20
    side, _, _, _ = section(par)
    tip, tip_gear, _ = tips(par)
    teeth = par[L.P_PINION_TEETH]
    form, _ = root_factors(par, teeth, par[L.P_PROFILE_SHIFT_PINION], tip, contact)
    if side > 0.0 and form > 0.0:
        teeth *= par[L.P_GEAR_RATIO]
        form, _ = root_factors(par, teeth, gear_shift(par), tip_gear, contact)
    return 0 if form > 0.0 else 20
