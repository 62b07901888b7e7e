# mypy: disable-error-code="no-any-return"
"""How two gears with profile shift and tips of their own stand to each other.

Tooth counts are above 0, of a ring too; the shift of a ring counts positive outwards, so that a
ring with the shift of its pinion keeps the distance of the axes (ISO 21771 counts it the other way
round). Source: the geometry of involutes, derived; as in DIN 3960 and ISO 21771, which were not at
hand.
"""

import math

from ...numerics.jit import Array, kernel
from . import layout as L

AGREE = 1e-6  # m between a distance of the axes given and that of two shifts, rounding aside
SAME = 1e-12  # relative, of lengths that are the same but for rounding
LEAST_LENGTH = 1e-3  # m of a distance or diameter that is given
NEWTON = 60  # steps of Newton's method; about 6 are taken


@kernel
def section(par: Array) -> tuple[float, float, float, float]:
    """Return side, centre distance [m], transverse angle [rad], cosine of the base helix angle.

    Distance and angle of the reference cylinders: those of the pair without profile shift.
    """
    helix, angle, cos_base = par[L.P_HELIX_ANGLE], par[L.P_PRESSURE_ANGLE], 1.0
    side = -1.0 if par[L.P_INTERNAL] > 0.0 else 1.0
    if helix > 0.0:
        cos_base = math.cos(math.asin(math.sin(helix) * math.cos(angle)))
        angle = math.atan(math.tan(angle) / math.cos(helix))
    centre = par[L.P_CENTRE_DISTANCE]
    if par[L.P_NORMAL_MODULE] > 0.0:
        teeth = par[L.P_PINION_TEETH] * (par[L.P_GEAR_RATIO] + side)
        centre = 0.5 * par[L.P_NORMAL_MODULE] * teeth / math.cos(helix)
    return side, centre, angle, cos_base


@kernel
def is_standard(par: Array) -> bool:
    """Tell if the pair has neither profile shift nor a distance of the axes or tips of its own.

    A distance or tip that is given as the standard pair has it is not its own.
    """
    shifts = par[L.P_PROFILE_SHIFT_PINION] != 0.0 or par[L.P_PROFILE_SHIFT_GEAR] != 0.0
    if shifts or par[L.P_TIP_SHORTENING] != 0.0:
        return False
    distance = par[L.P_WORKING_CENTRE_DISTANCE]
    first, second = par[L.P_TIP_DIAMETER_PINION], par[L.P_TIP_DIAMETER_GEAR]
    if distance == 0.0 and first == 0.0 and second == 0.0:
        return True
    side, centre, _, _ = section(par)
    radius = centre / (par[L.P_GEAR_RATIO] + side)
    module = 2.0 * radius / par[L.P_PINION_TEETH] * math.cos(par[L.P_HELIX_ANGLE])
    given, addendum = par[L.P_ADDENDUM_GEAR], par[L.P_ADDENDUM]
    tip = 2.0 * (radius + addendum * module)
    own = given if given > 0.0 else addendum
    tip_gear = 2.0 * (radius * par[L.P_GEAR_RATIO] + side * own * module)
    same = not distance > 0.0 or abs(distance - centre) <= SAME * centre
    same = same and (not first > 0.0 or abs(first - tip) <= SAME * tip)
    return bool(same and (not second > 0.0 or abs(second - tip_gear) <= SAME * tip_gear))


@kernel
def involute(angle: float) -> float:
    """Return inv(angle) = tan(angle) - angle."""
    return math.tan(angle) - angle


@kernel
def involute_angle(value: float) -> float:
    """Return the angle [rad] whose involute is ``value``, above 0: by Newton's method.

    The involute is convex: from above every step stays above. Started where its series 1/3 x^3 is,
    or its end at a right angle.
    """
    tangent = math.exp(math.log(3.0 * value) / 3.0) + value  # not below that of the angle sought
    for _ in range(NEWTON):
        step = (tangent - math.atan(tangent) - value) * (1.0 + 1.0 / (tangent * tangent))
        tangent -= step
        if abs(step) <= 1e-15 * tangent:
            break
    return math.atan(tangent)


@kernel
def gear_shift(par: Array) -> float:
    """Return the gear's profile shift [-]: as given, or what the distance of the axes asks for."""
    if not par[L.P_PROFILE_SHIFT_GEAR_FROM_DISTANCE] > 0.0:
        return par[L.P_PROFILE_SHIFT_GEAR]
    side, centre, angle, _ = section(par)
    teeth = par[L.P_PINION_TEETH] * (par[L.P_GEAR_RATIO] + side)
    working = math.acos(centre * math.cos(angle) / par[L.P_WORKING_CENTRE_DISTANCE])
    total = 0.5 * teeth * (involute(working) - involute(angle))
    total /= math.tan(par[L.P_PRESSURE_ANGLE])
    return total - side * par[L.P_PROFILE_SHIFT_PINION]


@kernel
def working_involute(par: Array) -> float:
    """Return the involute of the working pressure angle [-] without backlash; not above 0: none."""
    side, _, angle, _ = section(par)
    teeth = par[L.P_PINION_TEETH] * (par[L.P_GEAR_RATIO] + side)
    shifts = side * par[L.P_PROFILE_SHIFT_PINION] + gear_shift(par)
    return involute(angle) + 2.0 * shifts / teeth * math.tan(par[L.P_PRESSURE_ANGLE])


@kernel
def distance_of_shifts(par: Array) -> tuple[float, float]:
    """Return distance of the axes [m] and angle [rad] at which the pair works without backlash."""
    side, centre, angle, _ = section(par)
    if side * par[L.P_PROFILE_SHIFT_PINION] + gear_shift(par) == 0.0:
        return centre, angle
    working = involute_angle(working_involute(par))
    return centre * math.cos(angle) / math.cos(working), working


@kernel
def working_section(par: Array) -> tuple[float, float, float, float]:
    """Return ``section`` with distance [m] and transverse angle [rad] at which the pair works."""
    side, centre, angle, cos_base = section(par)
    if is_standard(par):
        return side, centre, angle, cos_base
    given = par[L.P_WORKING_CENTRE_DISTANCE]
    if given > 0.0:
        return side, given, math.acos(centre * math.cos(angle) / given), cos_base
    distance, working = distance_of_shifts(par)
    return side, distance, working, cos_base


@kernel
def tips(par: Array) -> tuple[float, float, float]:
    """Return the radii of the pinion's and the gear's tips and the normal module [m]."""
    side, centre, _, _ = section(par)
    radius = centre / (par[L.P_GEAR_RATIO] + side)
    module = 2.0 * radius / par[L.P_PINION_TEETH] * math.cos(par[L.P_HELIX_ANGLE])
    shorter = par[L.P_TIP_SHORTENING]
    tip = radius + (par[L.P_ADDENDUM] + par[L.P_PROFILE_SHIFT_PINION] - shorter) * module
    given = par[L.P_ADDENDUM_GEAR]
    addendum = (given if given > 0.0 else par[L.P_ADDENDUM]) - shorter
    gear = radius * par[L.P_GEAR_RATIO] + (side * addendum + gear_shift(par)) * module
    if par[L.P_TIP_DIAMETER_PINION] > 0.0:
        tip = 0.5 * par[L.P_TIP_DIAMETER_PINION]
    if par[L.P_TIP_DIAMETER_GEAR] > 0.0:
        gear = 0.5 * par[L.P_TIP_DIAMETER_GEAR]
    return tip, gear, module


@kernel
def tip_thickness(par: Array) -> tuple[float, float]:
    """Return the thickness of the pinion's and the gear's teeth at their tips over the module [-].

    In the transverse section, over the transverse module. A tip within the base circle counts as
    one on it.
    """
    side, centre, angle, _ = section(par)
    teeth, ratio = par[L.P_PINION_TEETH], par[L.P_GEAR_RATIO]
    tip, gear, _ = tips(par)
    base, slope = centre / (ratio + side) * math.cos(angle), math.tan(par[L.P_PRESSURE_ANGLE])
    turned = involute(math.acos(min(1.0, base / tip)))
    half = (0.5 * math.pi + 2.0 * par[L.P_PROFILE_SHIFT_PINION] * slope) / teeth
    first = 2.0 * tip * (half + involute(angle) - turned)
    turned = involute(math.acos(min(1.0, ratio * base / gear)))
    half = (0.5 * math.pi + side * 2.0 * gear_shift(par) * slope) / (ratio * teeth)
    second = 2.0 * gear * (half + side * (involute(angle) - turned))
    module = 2.0 * centre / (ratio + side) / teeth
    return first / module, second / module


@kernel
def half_digit(shift: float) -> float:
    """Return half a unit of the last digit of a profile shift: of three to six decimals, else 0."""
    if shift == 0.0:
        return 0.0
    unit = 1e-3
    for _ in range(4):
        if abs(shift / unit - round(shift / unit)) < 1e-6:
            return 0.5 * unit
        unit *= 0.1
    return 0.0


@kernel
def are_pointed(par: Array) -> bool:
    """Tell if the teeth of a gear end in a point before its tip."""
    first, second = tip_thickness(par)
    return not (first > 0.0 and second > 0.0)


@kernel
def pair_rule(par: Array) -> int:
    """Return the number of the first rule of shifts and tips that is broken; 0: none."""
    given = par[L.P_WORKING_CENTRE_DISTANCE]
    if 0.0 < given < LEAST_LENGTH:
        return 12
    if 0.0 < par[L.P_TIP_DIAMETER_PINION] < LEAST_LENGTH:
        return 13
    if 0.0 < par[L.P_TIP_DIAMETER_GEAR] < LEAST_LENGTH:
        return 14
    _, centre, angle, _ = section(par)
    if par[L.P_PROFILE_SHIFT_GEAR_FROM_DISTANCE] > 0.0:  # else the gear's shift is given
        if par[L.P_PROFILE_SHIFT_GEAR] != 0.0 or not given > 0.0:
            return 15
        if not centre * math.cos(angle) < given:
            return 16
    if not is_standard(par) and not working_involute(par) > 1e-12:
        return 17
    if given > 0.0:
        digits = half_digit(par[L.P_PROFILE_SHIFT_PINION]) + half_digit(gear_shift(par))
        off = abs(distance_of_shifts(par)[0] - given)
        if not (off <= AGREE + digits * tips(par)[2] and given > centre * math.cos(angle)):
            return 16
    return 18 if not is_standard(par) and are_pointed(par) else 0
