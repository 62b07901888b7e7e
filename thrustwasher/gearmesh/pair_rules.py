"""Rules between the parameters of a gear mesh, and how they say what to change."""

import math
from typing import Any

from ..model.spec import Rule
from .parameter_array import as_array

ALWAYS = "so large that a pair is always in contact"


def _cure(p: Any, gear: str) -> str:
    """Return the minimum profile shift of a gear, in steps of 0.05, with which the pair keeps all.

    And with which a rack does not undercut it; "" if none up to 1 does.
    """
    from .kernels import constants as g
    from .kernels import layout as k

    par = as_array(p)
    teeth = p.pinion_teeth * (1.0 if gear == "pinion" else p.gear_ratio)
    turned = math.atan(math.tan(p.pressure_angle) / math.cos(p.helix_angle))
    least = 1.0 - 0.5 * teeth * math.sin(turned) ** 2 / math.cos(p.helix_angle)
    place = k.P_PROFILE_SHIFT_PINION if gear == "pinion" else k.P_PROFILE_SHIFT_GEAR
    before = par[place]
    for step in range(1, 21):
        par[place] = 0.05 * step
        if par[place] > before and par[place] >= least and not g.broken_rule(par):
            return f", or profile_shift_{gear} = {0.05 * step:g}"
    return ""


def _interference(p: Any) -> str:
    from .kernels import constants as g
    from .kernels.working_pair import is_standard, section

    cure = _cure(p, "pinion")
    if not is_standard(as_array(p)):
        return (
            f"pinion_teeth = {p.pinion_teeth!r}, allowed: more, or a smaller tip of the gear{cure}:"
            f" with profile_shift_pinion = {p.profile_shift_pinion!r} the gear's tips cut below "
            "the pinion's involute (interference)"
        )
    _, _, angle, _ = section(as_array(p))
    gear, slant = p.addendum_gear or p.addendum, math.cos(p.helix_angle)
    if p.internal:
        return (
            f"addendum_gear = {gear!r}, allowed: less for a ring of {p.gear_ratio:g} x "
            f"{p.pinion_teeth} teeth (its tips cut below the pinion's involute: interference)"
        )
    least = math.floor(g.least_teeth(p.gear_ratio, angle, gear * slant)) + 1
    return (
        f"pinion_teeth = {p.pinion_teeth!r}, allowed: {least} and more for gear_ratio = "
        f"{p.gear_ratio:g}, pressure_angle = {math.degrees(p.pressure_angle):g} deg, addendum "
        f"= {gear:g}{cure} (else the gear's tips cut below the pinion's involute: interference)"
    )


def _interference_of_gear(p: Any) -> str:
    return (
        f"addendum = {p.addendum!r}, allowed: less{_cure(p, 'gear')} (the pinion's tips cut below "
        "the gear's involute: interference)"
    )


def _contact_ratio(p: Any) -> str:
    from .kernels import constants as g

    par = as_array(p)
    contact, overlap = sum(g.path_of(par)[1:]), float(g.overlap_ratio(par))
    helical = (
        f", or of helical teeth {g.LEAST_CONTACT:g} and more and together with the overlap ratio "
        f"{g.LEAST_TOTAL:g} and more, here {contact + overlap:.4g} (else the lines of contact "
        "end); more face_width makes more"
        if overlap
        else ""
    )
    return (
        f"addendum = {p.addendum!r}, allowed: {ALWAYS}; the contact ratio is {contact:.4g}, "
        f"allowed: 1 and more{helical}"
    )


def _base_friction(p: Any) -> str:
    from .kernels.constants import effective_roughness

    s = effective_roughness(as_array(p))
    return (
        f"f0 = {p.f0!r}, allowed: {0.0864 - 1372.0 * s:.4g} .. 1 for effective_roughness = {s:g} "
        "(below, a thick film would have negative friction)"
    )


def _slide_roll(p: Any) -> str:
    from .kernels import constants as g

    side = -1.0 if p.internal else 1.0
    found = g.slide_roll(p.gear_ratio, g.path_of(as_array(p))[0], side)
    return (
        "friction_law = 'li-seireg', allowed: for slide/roll ratios above 0.27 only, here "
        f"{found:.4g} at the start of contact (pinion_teeth = {p.pinion_teeth!r}); use "
        "friction_law = 'iso'"
    )


def _distances(p: Any) -> str:
    from .kernels.working_pair import distance_of_shifts, section

    given = p.working_centre_distance
    if p.profile_shift_gear_from_distance:
        _, centre, angle, _ = section(as_array(p))
        return (
            f"working_centre_distance = {given!r} m, allowed: above {centre * math.cos(angle):.9g} "
            "m, the distance at which the base circles touch"
        )
    found = float(distance_of_shifts(as_array(p))[0])
    return (
        f"working_centre_distance = {given!r} m, allowed: {found:.9g} m, that of "
        f"profile_shift_pinion = {p.profile_shift_pinion!r} and profile_shift_gear = "
        f"{p.profile_shift_gear!r}, within 1e-06 m and their digits; give "
        "profile_shift_gear_from_distance = True to have it decide the gear's shift"
    )


def _pointed(p: Any) -> str:
    from .kernels.working_pair import tip_thickness

    first, second = tip_thickness(as_array(p))
    gear, thickness = ("pinion", first) if not first > 0.0 else ("gear", second)
    return (
        f"profile_shift_pinion = {p.profile_shift_pinion!r}, profile_shift_gear = "
        f"{p.profile_shift_gear!r}, allowed: less, or smaller tip diameters: the {gear}'s teeth "
        f"are {thickness:.3g} modules thick at their tips, allowed: above 0"
    )


def _reliefs(p: Any) -> str:
    from .kernels import constants as g
    from .kernels.load_sharing import pitch_of

    par = as_array(p)
    path = 1e3 * float(pitch_of(par) * sum(g.path_of(par)[1:]))
    pairs = (("pinion", p.tip_relief_pinion), ("gear", p.tip_relief_gear))
    given = ", ".join(
        f"tip_relief_length_{gear} = {getattr(p, f'tip_relief_length_{gear}')!r} m together with "
        f"tip_relief_{gear} = {relief!r} m"
        for gear, relief in pairs
    )
    return (
        f"{given}, allowed: a length above 0 for each relief, together at most the path of "
        f"contact, {path:.4g} mm"
    )


RULES = (
    Rule(
        "pinion_teeth = {pinion_teeth}, allowed: more for gear_ratio = {gear_ratio}, "
        "pressure_angle = {pressure_angle} rad, addendum = {addendum} (with so few the gear's "
        "tips cut below the pinion's involute: interference)",
        _interference,
    ),
    Rule(
        f"addendum = {{addendum}}, allowed: {ALWAYS} (contact ratio 1 and more, or 1.01 and more "
        "together with the overlap ratio)",
        _contact_ratio,
    ),
    Rule(
        "effective_roughness = {effective_roughness}, allowed: 7.459e-06 .. 6.297e-05 for "
        "friction_law = 'li-seireg' (0: that of the surface)"
    ),
    Rule(
        "f0 = {f0}, allowed: 0.0864 - 1372 effective_roughness .. 1 "
        "(below, a thick film would have negative friction)",
        _base_friction,
    ),
    Rule(
        "friction_law = 'li-seireg', allowed: for slide/roll ratios above 0.27 only, not reached "
        "at the start of contact (pinion_teeth = {pinion_teeth}); use friction_law = 'iso'",
        _slide_roll,
    ),
    Rule(
        "addendum = {addendum}, allowed: less (the pinion's tips cut below the gear's involute: "
        "interference)",
        _interference_of_gear,
    ),
    Rule(
        "film_heat = 'atan', allowed: without helix_angle ({helix_angle} rad), internal "
        "({internal}), addendum_gear ({addendum_gear}), a gear of another material and "
        "friction_law = 'mixed' or 'efficiency': the paper has a spur pair; use film_heat = 'loss'"
    ),
    Rule(
        "contact_limit = {contact_limit} Pa, contact_limit_gear = {contact_limit_gear} Pa, "
        "allowed: 0 (that of the material) or 2e+07 .. 3e+09 Pa"
    ),
    Rule("addendum_gear = {addendum_gear}, allowed: 0 (as addendum) or 0.3 .. 1.5"),
    Rule("normal_module = {normal_module} m, allowed: 0 (from centre_distance) or 1e-4 .. 0.1 m"),
    Rule(
        "permissible_film_ratio = {permissible_film_ratio}, allowed: 0 (no limit is given) or "
        "0.01 .. 10"
    ),
    Rule(
        "working_centre_distance = {working_centre_distance} m, allowed: 0 (from the shifts) or "
        "0.001 .. 10 m"
    ),
    Rule(
        "tip_diameter_pinion = {tip_diameter_pinion} m, allowed: 0 (from addendum and shift) or "
        "0.001 .. 10 m"
    ),
    Rule(
        "tip_diameter_gear = {tip_diameter_gear} m, allowed: 0 (from addendum and shift) or "
        "0.001 .. 20 m"
    ),
    Rule(
        "profile_shift_gear_from_distance = True, allowed: with working_centre_distance "
        "({working_centre_distance} m) and without profile_shift_gear ({profile_shift_gear})"
    ),
    Rule(
        "working_centre_distance = {working_centre_distance} m, allowed: that of "
        "profile_shift_pinion = {profile_shift_pinion} and profile_shift_gear = "
        "{profile_shift_gear} within 1e-06 m and their digits; give "
        "profile_shift_gear_from_distance to have it decide the gear's shift",
        _distances,
    ),
    Rule(
        "profile_shift_pinion = {profile_shift_pinion}, allowed: more, or more profile_shift_gear "
        "({profile_shift_gear}): with so little shift the gears do not mesh without backlash",
    ),
    Rule(
        "profile_shift_pinion = {profile_shift_pinion}, profile_shift_gear = {profile_shift_gear}, "
        "allowed: less, or smaller tip diameters: a tooth is pointed before its tip",
        _pointed,
    ),
    Rule("root_limit = {root_limit} Pa, allowed: 0 (no root safety) or 1e+07 .. 3e+09 Pa"),
    Rule(
        "tool_tip_radius = {tool_tip_radius}, allowed: less, or less tool_addendum "
        "({tool_addendum}): such a rack leaves no root to rate; root_limit = 0 does without"
    ),
    Rule(
        "load_sharing = 'elastic', allowed: with film_heat = 'loss'; the paper's heat has the "
        "share load_share"
    ),
    Rule(
        "load_sharing = 'elastic', allowed: for contact ratios from 1 on and below 3; take another "
        "addendum ({addendum}) or load_sharing = 'rigid'"
    ),
    Rule(
        "tip_relief_length_pinion = {tip_relief_length_pinion} m, tip_relief_length_gear = "
        "{tip_relief_length_gear} m, allowed: above 0 with tip_relief_pinion = "
        "{tip_relief_pinion} m and tip_relief_gear = {tip_relief_gear} m, together at most the "
        "path of contact",
        _reliefs,
    ),
    Rule(
        "youngs_modulus_gear = {youngs_modulus_gear} Pa, root_limit_gear = {root_limit_gear} Pa, "
        "allowed: 0 (not given) or from 1e+09 Pa and from 1e+07 Pa on"
    ),
    Rule(
        "conductivity_gear = {conductivity_gear} W/(m.K), heat_capacity_gear = "
        "{heat_capacity_gear} J/(kg.K), density_gear = {density_gear} kg/m3, allowed: 0 (not "
        "given) or from 0.1, 50 and 500 on"
    ),
    Rule(
        "pressure_viscosity = {pressure_viscosity} 1/Pa, allowed: 0 (by base_oil and viscosity) or "
        "1e-09 .. 1e-07 1/Pa"
    ),
    Rule(
        "efficiency_back = {efficiency_back}, allowed: 0 (as efficiency) or 0.01 .. 1; a pair that "
        "locks itself when the gear drives has none"
    ),
)
