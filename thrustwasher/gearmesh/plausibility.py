"""What to doubt in the numbers of a gear mesh: one line each, with what to do about it."""

import math
from typing import Any

from ..units import format_quantity
from .kernels import constants
from .kernels import layout as k
from .kernels.contact import BOUNDARY_SPEED
from .kernels.mesh_point import LEAST_LINE_LOAD, LEAST_SPEED
from .kernels.operating_point import LEAST_RISE
from .kernels.path_friction import LEAST_ROLLING
from .kernels.working_pair import (
    gear_shift,
    section,
    tip_thickness,
    tips,
    working_section,
)
from .law_ranges import FRICTION, outside_of_pair, outside_of_point
from .parameter_array import as_array
from .parameters import GearMeshParams, centre_distance, default_of

APART = 2.0  # factor between roughness parameters from which they describe two surfaces
WHOLE = 1e-6  # of a tooth, that a number of teeth may be off
AGREE = 1e-3  # between a centre distance and that of module and teeth
THIN = 0.2  # modules; the minimum thickness of a tip that is usual
RACK = 1.0  # modules: straight part of a rack of addendum 1.25, tip radius 0.38
SOFTEST = 2e10  # Pa; below it a gear is no metal
SHARED = 2.05  # contact ratio from which ISO 6336-3 shares the load of a root between pairs
FASTEST = 100.0  # m/s at the pitch line; faster gears have losses that are not in the model


def doubts_of_parameters(p: GearMeshParams) -> list[str]:
    """Return what contradicts itself in parameters."""
    found = [*_teeth(p), *_flanks(p), *_roughness(p), *_fouling(p), *_load_factor(p)]
    return [*found, *_materials(p), *_root(p), *_oil(p), *_locking(p), *outside_of_pair(p)]


def doubts_of_point(
    p: GearMeshParams, par: Any, field: Any, torque: float, speed: float, oil: float
) -> list[str]:
    """Return what to doubt in a solved point: numbers that a minimum value made."""
    if torque * par[k.D_LOAD] < 2.0 * LEAST_LINE_LOAD:
        return [
            f"power = {torque * abs(speed):g} W: hardly any load; pressures, films and safeties "
            f"are those of {LEAST_LINE_LOAD:g} N per metre of face width"
        ]
    if abs(speed) < 2.0 * LEAST_SPEED:
        return [f"speed = {speed:g} rad/s: the film is that of {LEAST_SPEED:g} rad/s"]
    found = [*_stretched(p, par, field, speed), *_lossy(p, field)]
    found += [*_slow(p, par, speed), *outside_of_point(p, par, torque, abs(speed))]
    rise = float(field[k.F_BULK] + field[k.F_FLASH_MAX]) - oil
    if field[k.F_SCUFFING_SAFETY] <= 0.0:
        found.append(
            f"scuffing_safety = {field[k.F_SCUFFING_SAFETY]:.3g}: oil of "
            f"{format_quantity(oil, 'K')} is hotter than what scuffs; check oil_temperature, "
            "fzg_stage and structural_factor"
        )
    elif rise < LEAST_RISE:
        found.append(
            f"scuffing_safety counts a rise of {LEAST_RISE:g} K, the contact is {rise:.2g} K above "
            "the oil; read scuffing_margin instead"
        )
    return found


def _slow(p: GearMeshParams, par: Any, speed: float) -> list[str]:
    """Return lines on speeds below those that the laws of friction were fitted to."""
    if p.film_heat != "loss" or p.friction_law not in FRICTION:
        return []
    rolling = par[k.D_ROLLING] * abs(speed)
    pitch_line, found = rolling / (2.0 * math.sin(par[k.D_ANGLE])), []
    if p.friction_law != "iso" and pitch_line < BOUNDARY_SPEED:
        found.append(
            f"speed = {speed:g} rad/s: {pitch_line:.2g} m/s at the pitch line, below "
            f"{BOUNDARY_SPEED:g} m/s: mean_friction is that of a law for faster gears, at most "
            f"boundary_friction = {p.boundary_friction:g}"
        )
    if rolling < LEAST_ROLLING:
        found.append(
            f"speed = {speed:g} rad/s: the flanks roll with {rolling:.2g} m/s, the friction "
            f"takes {LEAST_ROLLING:g} m/s: the formulas have no bound towards standstill"
        )
    return found


def _lossy(p: GearMeshParams, field: Any) -> list[str]:
    """Return a line on an efficiency that asks for more friction than teeth without a film have."""
    mean = field[k.F_MEAN_FRICTION]
    if p.friction_law != "efficiency" or mean <= p.f0:
        return []
    return [
        f"mean_friction = {mean:.3g} is what the efficiency means, above f0 = {p.f0:g}, that of "
        "teeth without any film: other losses are in it (bearings, churning), or it is not that of "
        "these teeth"
    ]


def _stretched(p: GearMeshParams, par: Any, field: Any, speed: float) -> list[str]:
    """Return lines on a film that no gap has, and on gears that no model of a mesh alone covers."""
    found = []
    film, width = field[k.F_FILM], field[k.F_WIDTH]
    if film > width:
        found.append(
            f"film_thickness = {film:.3g} m against a contact {width:.3g} m wide: no law of the "
            "film holds there (real teeth starve); loss, film and safeties are no forecast; take "
            "warmer or thinner oil, or more power"
        )
    radius = par[k.D_CENTRE] / (p.gear_ratio + par[k.D_SIDE])
    if abs(speed) * radius > FASTEST:
        found.append(
            f"speed = {speed:g} rad/s: {abs(speed) * radius:.3g} m/s at the pitch line, above "
            f"{FASTEST:g}: windage and dynamic tooth loads are not in the model; check the size"
        )
    return found


def _teeth(p: GearMeshParams) -> list[str]:
    """Return lines on teeth that cannot be, and on a centre distance that is not theirs."""
    found, teeth = [], p.pinion_teeth * p.gear_ratio
    if abs(teeth - round(teeth)) > WHOLE * teeth:
        near = [n for n in (math.floor(teeth), math.ceil(teeth)) if n >= p.pinion_teeth]
        ratios = " or ".join(f"{n / p.pinion_teeth:.10g} ({n} teeth)" for n in near)
        found.append(
            f"gear_ratio = {p.gear_ratio:g}: a gear of {teeth:.6g} teeth; with pinion_teeth = "
            f"{p.pinion_teeth} give {ratios}"
        )
    given, made = p.centre_distance, centre_distance(p)
    if given != default_of("centre_distance") and abs(given - made) > AGREE * made:
        found.append(
            f"normal_module = {p.normal_module:g} m and the teeth give a centre distance of "
            f"{made:.6g} m, not {given:g} m; the distance of the axes as mounted is "
            "working_centre_distance"
        )
    return found


def _flanks(p: GearMeshParams) -> list[str]:
    """Return lines on teeth that are thin at their tips, or undercut by a rack."""
    par = as_array(p)
    found, slant = [], math.cos(p.helix_angle)
    for gear, thickness in zip(("pinion", "gear"), tip_thickness(par), strict=True):
        if thickness < THIN:
            found.append(
                f"the {gear}'s teeth are {thickness:.3g} modules thick at their tips, below "
                f"{THIN:g}: hardened through they break; take less profile shift or a smaller tip "
                "diameter"
            )
    side, _, angle, _ = section(par)
    gears = [("pinion", p.profile_shift_pinion, float(p.pinion_teeth))]
    if side > 0.0:
        gears.append(("gear", gear_shift(par), p.pinion_teeth * p.gear_ratio))
    for gear, shift, teeth in gears:
        least = RACK - 0.5 * teeth * math.sin(angle) ** 2 / slant
        if shift < least:
            found.append(
                f"profile_shift_{gear} = {shift:g}, below {least:.3g}: a rack whose flank is "
                f"straight down to {RACK:g} modules undercuts {teeth:.6g} teeth; the model has the "
                "whole involute"
            )
    return found


def _roughness(p: GearMeshParams) -> list[str]:
    rough = p.surface == "rough"
    of_surface = constants.SIGMA_ROUGH if rough else constants.SIGMA_FINE
    sigma, found = p.sigma_rms or of_surface, []
    words = "sigma_rms" if p.sigma_rms else f"surface {p.surface!r}"
    if p.mean_roughness and _differ(constants.MEAN_OVER_RMS * sigma, p.mean_roughness):
        found.append(
            f"mean_roughness = {p.mean_roughness:g} m against a composite RMS roughness of "
            f"{sigma:g} m ({words}), some {math.sqrt(2.0) * p.mean_roughness:.2g} m would go with "
            "it: film_ratio follows the second, mean_friction and film_ratio_gf the first; give "
            "sigma_rms to match"
        )
    li_seireg = p.friction_law == "li-seireg" and not p.effective_roughness
    if li_seireg and p.sigma_rms and _differ(p.sigma_rms, of_surface):
        found.append(
            f"sigma_rms = {p.sigma_rms:g} m, but friction_law = 'li-seireg' takes the effective "
            f"roughness of surface {p.surface!r}; give effective_roughness"
        )
    return found


def _fouling(p: GearMeshParams) -> list[str]:
    """Return a line if a ring's tips foul the pinion's outside the path of contact.

    Both tips pass the point where the tip circles cross; the ring's has to be there first. With
    standard teeth of 20 degrees a ring needs 9 teeth more than its pinion.
    """
    if not p.internal:
        return []
    par = as_array(p)
    _, apart, angle, _ = working_section(par)
    base, r1 = math.cos(angle), apart / (p.gear_ratio - 1.0)  # of the pitch circles
    r2 = r1 * p.gear_ratio
    tip1, tip2, _ = tips(par)
    at1 = (tip2 * tip2 - tip1 * tip1 - apart * apart) / (2.0 * apart * tip1)
    at2 = (apart * apart + tip2 * tip2 - tip1 * tip1) / (2.0 * apart * tip2)
    if abs(at1) >= 1.0 or r2 * base >= tip2:
        return []
    along1, along2 = _involute(math.acos(r1 * base / tip1)), _involute(math.acos(r2 * base / tip2))
    turned = (math.acos(at1) + along1 - _involute(angle)) / p.gear_ratio
    if turned + _involute(angle) - along2 >= math.acos(at2):
        return []
    return [
        f"gear_ratio = {p.gear_ratio:.6g}: a ring of {p.pinion_teeth * p.gear_ratio:g} teeth "
        f"around {p.pinion_teeth}: their tips foul each other next to the path of contact; "
        f"give the "
        "ring more teeth, a smaller addendum_gear or more profile shift"
    ]


def _involute(angle: float) -> float:
    return math.tan(angle) - angle


def _differ(a: float, b: float) -> bool:
    return not 1.0 / APART <= a / b <= APART


def _load_factor(p: GearMeshParams) -> list[str]:
    if p.load_factor == 1.0 or p.film_heat == "loss":
        return []
    return [
        f"load_factor = {p.load_factor:g} moves pitting_stress and pitting_safety alone: with "
        "film_heat = 'atan' pressures, film and temperatures are those of 1; raise power instead"
    ]


def _materials(p: GearMeshParams) -> list[str]:
    """Return lines on gears for which flash, scuffing and limits were not made."""
    gear = p.youngs_modulus_gear or (p.youngs_modulus if p.material_gear == "as-pinion" else 1e11)
    soft = [
        name
        for name, modulus in (("pinion", p.youngs_modulus), ("gear", gear))
        if modulus < SOFTEST
    ]
    if soft:
        return [
            f"the {' and '.join(soft)} of less than {1e-9 * SOFTEST:g} GPa: a polymer; flash, "
            "scuffing and micropitting are not its own, nor are limits that are not given: "
            "polymers fail by temperature, wear and their own endurance"
        ]
    if p.material_gear != "as-pinion":
        return [
            f"material_gear = {p.material_gear!r}: scuffing_safety, micropitting_safety and the "
            "friction are those of steel on steel"
        ]
    return []


def _oil(p: GearMeshParams) -> list[str]:
    """Return a line on an oil whose pressure coefficient no formula has."""
    if p.base_oil != "ester" or p.pressure_viscosity:
        return []
    return [
        "base_oil = 'ester': no standard gives its pressure coefficient, that of a polyalphaolefin "
        "is taken for the films (an estimate); give pressure_viscosity"
    ]


def _locking(p: GearMeshParams) -> list[str]:
    """Return a line on friction that locks the pair one way, of an efficiency below a half."""
    if p.friction_law != "efficiency":
        return []
    names = ("efficiency", "efficiency_back")
    drives, back = p.efficiency, p.efficiency_back or p.efficiency
    return [
        f"{name} = {value:g}, below 0.5: with the same friction the other way the pair is "
        f"self-locking; {other} = {there:g} is taken all the same"
        for name, value, other, there in zip(
            names, (drives, back), names[::-1], (back, drives), strict=True
        )
        if value < 0.5
    ]


def _root(p: GearMeshParams) -> list[str]:
    """Return a line on a root that several pairs share."""
    contact = sum(constants.path_of(as_array(p))[1:])
    helix = math.asin(math.sin(p.helix_angle) * math.cos(p.pressure_angle))
    contact /= math.cos(helix) ** 2
    if p.root_limit == 0.0 or contact < SHARED:
        return []
    share = min(1.0, max(0.7, 2.366 - 0.666 * contact))
    return [
        f"contact ratio {contact:.3g} in the normal section: root_stress has all of the load on "
        f"one pair; for accuracy grades up to 4 ISO 6336-3 takes {share:.2g} of it (Y_DT)"
    ]
