"""What the parameters of a gear mesh come to before any speed or torque is known.

The pair is involute, seen in the transverse section; the pinion drives. Positions on the line of
action count from the pinion's base tangent point (0) in lengths of C sin(angle), distance of the
axes and pressure angle as the pair works (``working_pair``): that of the gear lies at 1, of a ring
at -1, the pitch point at 1/(ratio + side). ``side`` is 1, of a ring -1.
"""

import math

from ...numerics.arrays import are_finite
from ...numerics.jit import Array, kernel
from ...numerics.status import NOT_FINITE, OK
from . import layout as L
from .contact import alpha_of_oil, compliance
from .flank_temperature import oil_viscosity
from .load_sharing import pitch_of, sharing_rule
from .micropitting import derive_micropitting, thinnest_films
from .path_of_contact import (
    SCUFFING_LUBRICANT,
    base_pitch,
    derive_path,
    even_part,
    flanks_at,
    line_of_action,
    shortest_lines,
)
from .tooth_root import derive_root, root_rule
from .working_pair import are_pointed, is_standard, pair_rule, section, tips, working_section

SIGMA_ROUGH, SIGMA_FINE = 2.26e-6, 0.566e-6  # m, composite RMS of two ground flanks
ROUGHNESS_ROUGH, ROUGHNESS_FINE = 4.5e-5, 1.5e-5  # S of Li & Seireg
MEAN_OVER_RMS = 1.0 / math.sqrt(2.0)  # Ra of a flank, 1.6 and 0.4 um, over the composite RMS

LEAST_EFFECTIVE = 2.143e-5 / 2.873  # the film's term of Li & Seireg's law changes sign there
LARGEST_EFFECTIVE = 0.0864 / 1372.0  # the film has no effect from there on
LEAST_SLIDE_ROLL = 0.27
# Contact limits [Pa]: ISO 6336-5, MQ, as usually quoted; the mechanical ones of Atan's Table 1.
LIMITS = (689.5e6, 434.3e6, 1500e6)  # in the order of the steels
# Young's modulus [Pa], conductivity [W/(m K)], heat capacity [J/(kg K)], density [kg/m3], contact
# limit [Pa] of a gear of nodular iron, grey iron, cast tin bronze: moduli of the elasticity factors
# in ISO 6336-2, limits of irons of 200 HB by ISO 6336-5, both as publicly quoted; the rest, and the
# limit of bronze, are estimates. Poisson's ratio is 0.3.
MATERIALS = (
    (173e9, 32.0, 500.0, 7100.0, 498e6),
    (118e9, 48.0, 500.0, 7200.0, 339e6),
    (103e9, 60.0, 380.0, 8800.0, 300e6),
)
POISSON = 0.3
LEAST_LIMIT = 2e7  # Pa, of a contact limit that is given
COEFFICIENT_AT = 311.15  # K, 38 degC
LEAST_COEFFICIENT = 1e-9  # 1/Pa, of the viscosity, that is given
LEAST_EFFICIENCY = 0.01  # that is given
LEAST_CONTACT = 0.1  # contact ratio of helical teeth
LEAST_TOTAL = 1.01  # contact and overlap ratio together where the first is below 1
RIM = 4.0  # transverse modules from a ring's pitch circle to its outside; an estimate
STILL_COOLING = 50.0  # W/(m2 K), of gears that hardly move, over their pitch cylinders; an estimate


@kernel
def effective_roughness(par: Array) -> float:
    """Return Li & Seireg's S [-]: as given, or that of the surface."""
    given = par[L.P_EFFECTIVE_ROUGHNESS]
    if given > 0.0:
        return float(given)
    return ROUGHNESS_ROUGH if par[L.P_SURFACE] == L.ROUGH else ROUGHNESS_FINE


@kernel
def path_of(par: Array) -> tuple[float, float, float]:
    """Return the start of contact [-], then approach and recess in base pitches."""
    ratio, teeth = par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH]
    side, centre, angle, _ = working_section(par)
    if not is_standard(par):
        line, base = centre * math.sin(angle), centre * math.cos(angle) / (ratio + side)
        tip, tip_gear, _ = tips(par)
        reach = math.sqrt(max(tip_gear * tip_gear - (ratio * base) ** 2, 0.0))
        start, pitch = side * (1.0 - reach / line), 2.0 * math.pi * base / teeth
        approach = (1.0 / (ratio + side) - start) * line / pitch
        reach = math.sqrt(max(tip * tip - base * base, 0.0))
        return start, approach, (reach - line / (ratio + side)) / pitch
    slant = math.cos(par[L.P_HELIX_ANGLE])
    addendum = par[L.P_ADDENDUM] * slant  # over the transverse module
    gear = par[L.P_ADDENDUM_GEAR] * slant if par[L.P_ADDENDUM_GEAR] > 0.0 else addendum
    start = start_of_contact(ratio, teeth, angle, gear, side)
    approach, recess = path_lengths(ratio, teeth, angle, addendum, start, side)
    return start, approach, recess


@kernel
def overlap_ratio(par: Array) -> float:
    """Return the overlap ratio eps_beta [-]."""
    side, centre, _, _ = section(par)
    around = 2.0 * math.pi * centre / (par[L.P_GEAR_RATIO] + side) / par[L.P_PINION_TEETH]
    return float(par[L.P_FACE_WIDTH] * math.tan(par[L.P_HELIX_ANGLE]) / around)


@kernel
def derive_geometry(par: Array) -> None:
    """Fill section, path of contact, curvature and speeds where it starts, loads per torque."""
    ratio, teeth = par[L.P_GEAR_RATIO], par[L.P_PINION_TEETH]
    side, centre, angle, cos_base = working_section(par)
    par[L.D_SIDE], par[L.D_CENTRE], par[L.D_ANGLE], par[L.D_COS_BASE] = (
        side,
        centre,
        angle,
        cos_base,
    )
    start, approach, recess = path_of(par)
    par[L.D_START], par[L.D_APPROACH], par[L.D_RECESS] = start, approach, recess
    line, pitch, width = centre * math.sin(angle), centre / (ratio + side), par[L.P_FACE_WIDTH]
    par[L.D_SLIDE_ROLL] = slide_roll(ratio, start, side)
    par[L.D_CONTACT_RATIO] = approach + recess
    par[L.D_OVERLAP] = overlap_ratio(par)
    par[L.D_LOAD] = 1.0 / (width * pitch * math.cos(angle))
    par[L.D_UNIT_LOAD] = 1.0 / (width * pitch)
    par[L.D_LINE] = par[L.P_LOAD_SHARE] / (width * pitch * math.cos(angle))
    if par[L.P_FILM_HEAT] == L.LOSS:
        par[L.D_LINE] = par[L.D_LOAD]
    par[L.D_RADIUS] = start * (1.0 - side * start) * line
    par[L.D_V1] = start * line
    par[L.D_V2] = (1.0 - side * start) * line / ratio
    par[L.D_SLIDING] = line * (1.0 - (ratio + side) * start) / ratio
    apart = base_pitch(ratio, teeth, angle, side) * (ratio + side)
    par[L.D_SLIDE] = apart * line / ratio  # sliding per base pitch from the pitch point
    par[L.D_ROLLING] = 2.0 * pitch * math.sin(angle)
    par[L.D_PITCH_RADIUS] = line * ratio / ((ratio + side) * (ratio + side))
    even = even_part(par)
    spur = loss_factor(ratio, teeth, approach, recess, side)
    wide = wide_loss_factor(ratio, teeth, approach, recess, side)
    par[L.D_LOSS] = ((1.0 - even) * spur + even * wide) / cos_base
    par[L.D_LOSS_SPUR] = spur / cos_base


@kernel
def gear_value(par: Array, given: int, pinion: int, column: int) -> float:
    """Return a number of the gear's material: as given, of its material, or that of the pinion.

    ``given``, ``pinion``: places of the parameters; ``column`` of ``MATERIALS``, -1: Poisson's.
    """
    if par[given] > 0.0:
        return float(par[given])
    material = int(par[L.P_MATERIAL_GEAR])
    if material == L.AS_PINION:
        return float(par[pinion])
    return POISSON if column < 0 else MATERIALS[material - 2][column]


@kernel
def derive_materials(par: Array) -> None:
    """Fill compliance of both gears together, modulus, heat capacity and effusivity of each."""
    modulus = gear_value(par, L.P_YOUNGS_MODULUS_GEAR, L.P_YOUNGS_MODULUS, 0)
    poisson = gear_value(par, L.P_POISSON_RATIO_GEAR, L.P_POISSON_RATIO, -1)
    conducts = gear_value(par, L.P_CONDUCTIVITY_GEAR, L.P_CONDUCTIVITY, 1)
    stores = gear_value(par, L.P_HEAT_CAPACITY_GEAR, L.P_HEAT_CAPACITY, 2)
    stores *= gear_value(par, L.P_DENSITY_GEAR, L.P_DENSITY, 3)
    par[L.D_THETA] = compliance(par[L.P_YOUNGS_MODULUS], par[L.P_POISSON_RATIO], modulus, poisson)
    par[L.D_CAPACITY] = par[L.P_DENSITY] * par[L.P_HEAT_CAPACITY]
    par[L.D_EFFUSIVITY] = math.sqrt(par[L.P_CONDUCTIVITY] * par[L.D_CAPACITY])
    par[L.D_MODULUS_GEAR], par[L.D_POISSON_GEAR] = modulus, poisson
    par[L.D_CAPACITY_GEAR], par[L.D_EFFUSIVITY_GEAR] = stores, math.sqrt(conducts * stores)


@kernel
def pressure_viscosity(par: Array) -> float:
    """Return the pressure coefficient of the viscosity at 38 degC [1/Pa]: as given, else the oil's.

    Source of the latter: ``alpha_of_oil``.
    """
    given = par[L.P_PRESSURE_VISCOSITY]
    if given > 0.0:
        return float(given)
    scale, b, c = par[L.P_VISCOSITY_SCALE], par[L.P_VISCOSITY_B], par[L.P_VISCOSITY_C]
    thick = oil_viscosity(COEFFICIENT_AT, scale, b, c)
    return alpha_of_oil(int(par[L.P_BASE_OIL]) - 1, thick)


@kernel
def derive_efficiency(par: Array, at_pinion: bool) -> None:
    """Fill what a mesh loses over the power of one shaft, where that feeds in and where it is fed.

    ``at_pinion``: of the pinion's shaft, else the gear's.
    """
    drives, back = par[L.P_EFFICIENCY], par[L.P_EFFICIENCY_BACK]
    back = back if back > 0.0 else drives
    par[L.D_LOST_IN] = 1.0 - (drives if at_pinion else back)
    par[L.D_LOST_OUT] = 1.0 / (back if at_pinion else drives) - 1.0


@kernel
def derive(par: Array) -> int:
    """Fill the constants behind the parameters; return 0, or NOT_FINITE."""
    derive_geometry(par)
    derive_materials(par)
    par[L.D_ALPHA] = pressure_viscosity(par)
    par[L.D_OIL_CAPACITY] = par[L.P_OIL_DENSITY] * par[L.P_OIL_HEAT_CAPACITY]
    rough = par[L.P_SURFACE] == L.ROUGH
    sigma = SIGMA_ROUGH if rough else SIGMA_FINE
    par[L.D_SIGMA] = par[L.P_SIGMA_RMS] if par[L.P_SIGMA_RMS] > 0.0 else sigma
    par[L.D_ROUGHNESS] = effective_roughness(par)
    mean = MEAN_OVER_RMS * par[L.D_SIGMA]
    par[L.D_MEAN] = par[L.P_MEAN_ROUGHNESS] if par[L.P_MEAN_ROUGHNESS] > 0.0 else mean
    by_speed = math.sqrt(par[L.D_V1]) / (math.sqrt(par[L.D_V1]) + math.sqrt(par[L.D_V2]))
    constant = par[L.P_HEAT_PARTITION] == L.CONSTANT_SHARE
    par[L.D_SHARE] = par[L.P_PARTITION_SHARE] if constant else by_speed
    derive_efficiency(par, True)
    derive_factors(par)
    derive_limits(par)
    derive_root(par)
    derive_body(par)
    par[L.D_PLACES] = par[L.D_HOTTEST] = 0.0
    if par[L.P_FILM_HEAT] == L.LOSS or par[L.P_FIDELITY] == L.FINE:
        line_of_action(par, par[L.D_APPROACH], par[L.D_RECESS])
    if par[L.P_FILM_HEAT] == L.LOSS:
        derive_micropitting(par, SCUFFING_LUBRICANT[int(par[L.P_BASE_OIL]) - 1])
        derive_path(par)
        thinnest_films(par)
    return OK if are_finite(par[L.N_PARAM : L.D_POSITION]) else NOT_FINITE


@kernel
def start_of_contact(
    ratio: float, teeth: float, angle: float, addendum: float, side: float
) -> float:
    """Return the position x_s [-] where contact starts: the gear's addendum circle cuts the line.

    ``ratio`` gear over pinion teeth, ``teeth`` of the pinion, pressure ``angle`` [rad],
    ``addendum`` of the gear over module. Not above 0: its tip meets no involute (interference).
    """
    base = ratio * math.cos(angle)
    tip = ratio + side * (2.0 * addendum / teeth)
    reach = math.sqrt(max(tip * tip - base * base, 0.0))
    return side * (1.0 - reach / ((ratio + side) * math.sin(angle)))


@kernel
def least_teeth(ratio: float, angle: float, addendum: float) -> float:
    """Return the (real) number of pinion teeth at which x_s = 0."""
    s = math.sin(angle) * math.sin(angle) * (1.0 + 2.0 * ratio)
    return 2.0 * addendum * (ratio + math.sqrt(ratio * ratio + s)) / s


@kernel
def slide_roll(ratio: float, start: float, side: float) -> float:
    """Return sliding speed over mean rolling speed [-], 2 |V2 - V1|/(V1 + V2), at ``start``."""
    slide = abs(1.0 - (ratio + side) * start)
    return 2.0 * slide / (1.0 + (ratio - side) * start)


@kernel
def path_lengths(
    ratio: float, teeth: float, angle: float, addendum: float, start: float, side: float
) -> tuple[float, float]:
    """Return (approach, recess): the path before and after the pitch point, in base pitches."""
    line = 0.5 * teeth * (ratio + side) * math.sin(angle)  # C sin(angle) over module
    pitch = math.pi * math.cos(angle)
    approach = (1.0 / (ratio + side) - start) * line / pitch
    tip, base = 0.5 * teeth + addendum, 0.5 * teeth * math.cos(angle)
    recess = (math.sqrt(tip * tip - base * base) - 0.5 * teeth * math.sin(angle)) / pitch
    return approach, recess


@kernel
def _moment(low: float, high: float) -> float:
    """Return the integral of |s| from ``low`` to ``high``."""
    return 0.5 * (high * abs(high) - low * abs(low))


@kernel
def loss_factor(ratio: float, teeth: float, approach: float, recess: float, side: float) -> float:
    """Return H_v [-]: the power lost over the power transmitted, for a friction coefficient of 1.

    Mean over the path of contact when the pairs in contact share the load equally, at any time as
    many as there are: for a contact ratio e from 1 to 2, with the pitch point where one pair is
    alone, it is Ohlendorf's pi (M + 1)/(N M) (1 - e + e1^2 + e2^2).
    """
    whole = math.floor(approach + recess)
    more = approach + recess - whole  # interval of a pitch with one pair more than `whole`
    total = 0.0
    for k in range(int(min(whole, 100.0)) + 1):
        low = -approach + k
        total += _moment(low, low + more) / (whole + 1.0)
        if k < whole:
            total += _moment(low + more, low + 1.0) / max(whole, 1.0)
    return 2.0 * math.pi * (ratio + side) / (teeth * ratio) * total


@kernel
def wide_loss_factor(
    ratio: float, teeth: float, approach: float, recess: float, side: float
) -> float:
    """Return H_v [-] of teeth so wide and helical that the whole path always bears evenly."""
    mean = _moment(-approach, recess) / (approach + recess)
    return 2.0 * math.pi * (ratio + side) / (teeth * ratio) * mean


@kernel
def single_contact_factors(par: Array) -> tuple[float, float]:
    """Return Z_B and Z_D [-], each at least 1: stress where a pair is alone over the pitch point's.

    A pair is alone from B on, where the one before it has left, to D; the less the overlap, the
    more of that counts, none of it from an overlap of 1 on. Beyond a contact ratio of 2 the same
    places bound the contact of two pairs. Source: ISO 6336-2:2006 as publicly quoted.
    """
    pitch, even = flanks_at(par, 0.0)[0], even_part(par)
    before, behind = par[L.D_APPROACH], par[L.D_RECESS]
    first = math.sqrt(pitch / flanks_at(par, max(behind - 1.0, -before))[0])
    second = math.sqrt(pitch / flanks_at(par, min(1.0 - before, behind))[0])
    first, second = max(first, 1.0), max(second, 1.0)
    return first - even * (first - 1.0), second - even * (second - 1.0)


@kernel
def helical_factor(contact: float) -> float:
    """Return K_Bgamma [-] over the total contact ratio: helical teeth heat more than their load.

    1 up to 2, then 1 + 0.2 sqrt((eps - 2) (5 - eps)), from 3.5 on 1.3. Source: ISO/TR 13989-1 as
    publicly quoted.
    """
    if contact <= 2.0:
        return 1.0
    if contact >= 3.5:
        return 1.3
    return 1.0 + 0.2 * math.sqrt((contact - 2.0) * (5.0 - contact))


@kernel
def derive_factors(par: Array) -> None:
    """Fill the load factors of both flanks together, K_Bgamma, and what they make of the flash."""
    factor = par[L.P_LOAD_FACTOR] * par[L.P_FACE_LOAD_FACTOR] * par[L.P_MESH_LOAD_FACTOR]
    helical = helical_factor(par[L.D_CONTACT_RATIO] + par[L.D_OVERLAP])
    par[L.D_FACTOR], par[L.D_HELICAL] = factor, helical
    par[L.D_FLASH_FACTOR] = math.exp(0.75 * math.log(factor * helical))


@kernel
def derive_limits(par: Array) -> None:
    """Fill pitting stress per root of the line load, its limits, scuffing temperature's slope."""
    ratio, side = par[L.P_GEAR_RATIO], par[L.D_SIDE]
    angle, contact, even = par[L.D_ANGLE], par[L.D_CONTACT_RATIO], even_part(par)
    zone = 2.0 * par[L.D_COS_BASE] / (math.cos(angle) * math.sin(angle))
    # The standard's form falls below an even sharing of all pairs where the ratio is above 3.
    spur = max((4.0 - contact) / 3.0, 1.0 / contact)
    sharing = spur * (1.0 - even) + even / contact
    if contact < 1.0:
        sharing = 1.0 / shortest_lines(contact, par[L.D_OVERLAP])
    diameter = 2.0 * par[L.D_CENTRE] / (ratio + side)
    elastic = 1.0 / (math.pi * par[L.D_THETA])
    slant = math.cos(par[L.P_HELIX_ANGLE])
    shape = zone * elastic * sharing / slant * (ratio + side) / (ratio * diameter)
    nominal = math.sqrt(shape * math.cos(angle) * par[L.D_FACTOR])
    pinion, gear = single_contact_factors(par)
    par[L.D_PITTING] = nominal * max(pinion, gear)
    limit = LIMITS[int(par[L.P_STEEL]) - 1]
    par[L.D_LIMIT] = par[L.P_CONTACT_LIMIT] if par[L.P_CONTACT_LIMIT] > 0.0 else limit
    own = gear_value(par, L.P_CONTACT_LIMIT_GEAR, L.P_CONTACT_LIMIT, 4)
    par[L.D_LIMIT_GEAR] = own if own > 0.0 else par[L.D_LIMIT]
    used = max(pinion / par[L.D_LIMIT], gear / par[L.D_LIMIT_GEAR])
    par[L.D_PITTING_USED] = nominal * used
    stage = par[L.P_FZG_STAGE]
    par[L.D_SCUFFING] = (0.85 + 1.4 * par[L.P_STRUCTURAL_FACTOR]) * stage * stage


@kernel
def derive_body(par: Array) -> None:
    """Fill heat capacity [J/K] of the bodies and their conductance [W/K] when nothing turns.

    A gear with several mates gives an equal share of its body to each of its meshes.
    """
    pinions, gears = par[L.P_MATES_PINION], par[L.P_MATES_GEAR]
    pinion = par[L.D_CENTRE] / (par[L.P_GEAR_RATIO] + par[L.D_SIDE])
    gear, width = pinion * par[L.P_GEAR_RATIO], par[L.P_FACE_WIDTH]
    disc = gear * gear
    if par[L.D_SIDE] < 0.0:
        rim = RIM * 2.0 * pinion / par[L.P_PINION_TEETH]
        disc = rim * (2.0 * gear + rim)
    stores = pinion * pinion / pinions * par[L.D_CAPACITY] + disc / gears * par[L.D_CAPACITY_GEAR]
    given = par[L.P_BULK_HEAT_CAPACITY]
    par[L.D_BULK_CAPACITY] = given if given > 0.0 else math.pi * width * stores
    par[L.D_STILL] = STILL_COOLING * 2.0 * math.pi * width * (pinion / pinions + gear / gears)


@kernel
def has_own_material(par: Array) -> bool:
    """Tell if a number of the gear's material differs from the pinion's, whoever gave it."""
    modulus = gear_value(par, L.P_YOUNGS_MODULUS_GEAR, L.P_YOUNGS_MODULUS, 0)
    poisson = gear_value(par, L.P_POISSON_RATIO_GEAR, L.P_POISSON_RATIO, -1)
    conducts = gear_value(par, L.P_CONDUCTIVITY_GEAR, L.P_CONDUCTIVITY, 1)
    stores = gear_value(par, L.P_HEAT_CAPACITY_GEAR, L.P_HEAT_CAPACITY, 2)
    heavy = gear_value(par, L.P_DENSITY_GEAR, L.P_DENSITY, 3)
    metal = modulus != par[L.P_YOUNGS_MODULUS] or poisson != par[L.P_POISSON_RATIO]
    heat = conducts != par[L.P_CONDUCTIVITY] or stores != par[L.P_HEAT_CAPACITY]
    return bool(metal or heat or heavy != par[L.P_DENSITY])


@kernel
def broken_rule(par: Array) -> int:
    """Return the number, from 1, of the first rule the parameters break; 0 if they keep all.

    Every parameter lies in its own range. The numbers are places in the model's list of texts.
    """
    if 0.0 < par[L.P_CONTACT_LIMIT] < LEAST_LIMIT:
        return 8
    if 0.0 < par[L.P_CONTACT_LIMIT_GEAR] < LEAST_LIMIT:
        return 8
    if 0.0 < par[L.P_YOUNGS_MODULUS_GEAR] < 1e9 or 0.0 < par[L.P_ROOT_LIMIT_GEAR] < 1e7:
        return 24
    if 0.0 < par[L.P_CONDUCTIVITY_GEAR] < 0.1 or 0.0 < par[L.P_HEAT_CAPACITY_GEAR] < 50.0:
        return 25
    if 0.0 < par[L.P_DENSITY_GEAR] < 500.0:
        return 25
    if 0.0 < par[L.P_PRESSURE_VISCOSITY] < LEAST_COEFFICIENT:
        return 26
    if 0.0 < par[L.P_EFFICIENCY_BACK] < LEAST_EFFICIENCY:
        return 27
    if 0.0 < par[L.P_ADDENDUM_GEAR] < 0.3:
        return 9
    if 0.0 < par[L.P_NORMAL_MODULE] < 1e-4:
        return 10
    if 0.0 < par[L.P_PERMISSIBLE_FILM_RATIO] < 0.01:
        return 11
    ratio, is_paper = par[L.P_GEAR_RATIO], par[L.P_FILM_HEAT] != L.LOSS
    if not ratio + section(par)[0] > 0.0:
        return 1
    rule = pair_rule(par)
    if rule > 0:
        return rule
    side, _, angle, _ = working_section(par)
    start, approach, recess = path_of(par)
    if not start > 0.0:
        return 1
    reach = approach + recess
    if not reach >= 1.0 and not (
        reach >= LEAST_CONTACT and reach + overlap_ratio(par) >= LEAST_TOTAL
    ):
        return 2
    if par[L.P_FRICTION_LAW] == L.LI_SEIREG:
        s = effective_roughness(par)
        if not LEAST_EFFECTIVE < s < LARGEST_EFFECTIVE:
            return 3
        if not par[L.P_F0] >= 0.0864 - 1372.0 * s:
            return 4
        if not slide_roll(ratio, start, side) > LEAST_SLIDE_ROLL:
            return 5
    if side > 0.0:
        reach *= base_pitch(ratio, par[L.P_PINION_TEETH], angle, side)
        if not start + reach < 1.0:
            return 6
    if are_pointed(par):
        return 18
    beyond = par[L.P_HELIX_ANGLE] > 0.0 or par[L.P_INTERNAL] > 0.0
    own_addendum = par[L.P_ADDENDUM_GEAR] > 0.0
    beyond = beyond or (own_addendum and par[L.P_ADDENDUM_GEAR] != par[L.P_ADDENDUM])
    beyond = beyond or not is_standard(par) or has_own_material(par)
    law = par[L.P_FRICTION_LAW]
    if is_paper and (beyond or law == L.MIXED_FRICTION or law == L.EFFICIENCY):
        return 7
    rule = sharing_rule(par, approach + recess, pitch_of(par))
    return rule if rule > 0 else root_rule(par, approach + recess)
