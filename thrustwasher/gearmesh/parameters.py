"""Parameters of the gear mesh: a pair of gears, its surfaces, oil, steel and the laws to apply."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..model.parameters import check_ranges, check_rules, choice, count, flag, quantity
from ..model.part_file import preset_params
from ..model.toml_tables import spec_beside
from ..tribology.holding.parameters import coupling_age, coupling_inertia, holding_choice
from .choices import (
    AREA_LAWS,
    ASPERITY_BASES,
    BASE_OILS,
    FILM_HEAT,
    FILM_VISCOSITY,
    FRICTION_LAWS,
    HEAT_PARTITION,
    LOAD_SHARING,
    MATERIALS_GEAR,
    STEELS,
    SURFACES,
    SWITCHES,
    THERMAL_MODES,
    THERMAL_STARTS,
    TRACTION_LAWS,
    VISCOSITY_AT,
)
from .exchange import EXCHANGE
from .pair_rules import RULES
from .parameter_array import as_array


def _constant(place: str) -> Callable[[Any], float]:
    """Return what makes of parameters a constant of the kernel; ``place``: its name in layout."""

    def value(p: "GearMeshParams") -> float:
        from ..model.prepare import filled
        from .kernels import constants, layout

        par = filled(SPEC, p, SPEC.default_fidelity, layout.NPAR, constants.derive)
        return float(par[getattr(layout, place)])

    return value


def _module(p: "GearMeshParams") -> float:
    """Return the normal module [m] by centre distance and teeth."""
    teeth = p.pinion_teeth * (p.gear_ratio - 1.0 if p.internal else p.gear_ratio + 1.0)
    return float(2.0 * centre_distance(p) * math.cos(p.helix_angle) / teeth)


def _working_distance(p: "GearMeshParams") -> float:
    """Return the distance of the axes [m] that the profile shifts make."""
    from .kernels.working_pair import working_section

    return float(working_section(as_array(p))[1])


def _tip(gear: int) -> Callable[[Any], float]:
    """Return what makes of parameters the tip diameter [m] of the pinion (0) or the gear (1)."""

    def value(p: "GearMeshParams") -> float:
        from .kernels.working_pair import tips

        return 2.0 * float(tips(as_array(p))[gear])

    return value


def _relief_length(gear: str) -> Any:
    text = f"length of the {gear}'s relief along the path of contact"
    return quantity(0.0, "m", 0.0, 1.0, text, read_by=((f"tip_relief_{gear}", ">", 0.0),))


OF_ATAN = (("film_heat", "atan"),)
OF_LOSS = (("film_heat", "loss"),)
BY_FILM = tuple(
    ("friction_law", law) for law in ("li-seireg", "iso", "mixed", "schlenk", "efficiency")
)
BY_SPEED = tuple(("friction_law", law) for law in ("mixed", "schlenk"))
BY_SCALE = tuple(("friction_law", law) for law in ("iso", "mixed", "schlenk"))
BY_EFFICIENCY = (("friction_law", "efficiency"),)
BY_STIFFNESS = (("load_sharing", "elastic"),)
TRANSIENT = (("thermal_mode", "transient"),)
BY_ROOT = (("root_limit", ">", 0.0),)
NO_MODULE = (("normal_module", 0.0),)
SIZE = ("gear_ratio", "pinion_teeth", "centre_distance", "normal_module", "face_width")


@dataclass(frozen=True, slots=True, kw_only=True)
class GearMeshParams:
    """A pair of involute gears: geometry, flanks, friction, heat, steel, oil, laws.

    Dimensions and oil: Atan (2005), SAE 30 oil, 20 degrees; not in the paper and chosen here: face
    width, roughness values, f0, pressure viscosity, thermal expansion, the asperity group. The
    sets are made by ``GearMeshParams.preset(name, **changes)``: "paper" (or "bounded")
    has the paper's friction, heat and steel, "literal" takes the paper at its word, per metre of
    face width, "iso" is "paper" with the standard's friction.
    """

    gear_ratio: float = quantity(
        2.0, "1", 0.05, 20.0, "teeth of the gear over those of the pinion, of a ring above 1"
    )
    pinion_teeth: int = count(20, 5, 500, "number of teeth of the pinion")
    centre_distance: float = quantity(
        0.254, "m", 5e-3, 10.0, "distance of the two gear axes", read_by=NO_MODULE
    )
    normal_module: float = quantity(
        0.0,
        "m",
        0.0,
        0.1,
        "normal module, gives the centre distance (0: from centre_distance)",
        overrides=("centre_distance",),
        at_zero=_module,
    )
    pressure_angle: float = quantity(
        0.3490658503988659, "rad", 0.2, 0.6, "pressure angle in the normal section, pitch point"
    )
    helix_angle: float = quantity(
        0.0, "rad", 0.0, 0.7853981633974483, "helix angle on the pitch cylinder, 45 deg at most"
    )
    internal: bool = flag(False, "whether the gear is a ring with internal teeth")
    addendum: float = quantity(1.0, "1", 0.3, 1.5, "addendum of the pinion over the normal module")
    addendum_gear: float = quantity(
        0.0, "1", 0.0, 1.5, "addendum of the gear (0: as addendum)", overrides=("addendum",)
    )
    face_width: float = quantity(0.05, "m", 1e-3, 5.0, "width of the teeth in contact")
    load_factor: float = quantity(
        1.0, "1", 0.5, 5.0, "load factor K of pressures, temperatures and all stresses"
    )
    load_share: float = quantity(
        1.0,
        "1",
        0.05,
        1.0,
        "share of load on the pair that starts, for film_heat atan",
        read_by=OF_ATAN,
    )
    surface: str = choice("rough", SURFACES, "Surface", "finish of the two flanks")
    sigma_rms: float = quantity(
        0.0,
        "m",
        0.0,
        2e-5,
        "composite RMS roughness (0: that of the surface)",
        overrides=("surface",),
        at_zero=_constant("D_SIGMA"),
    )
    effective_roughness: float = quantity(
        0.0,
        "1",
        0.0,
        1e-4,
        "effective roughness S of Li and Seireg (0: that of the surface)",
        overrides=("surface",),
        at_zero=_constant("D_ROUGHNESS"),
        read_by=(("friction_law", "li-seireg"),),
    )
    mean_roughness: float = quantity(
        0.0,
        "m",
        0.0,
        2e-5,
        "mean Ra of both flanks (0: composite RMS over sqrt 2)",
        overrides=("surface", "sigma_rms"),
        at_zero=_constant("D_MEAN"),
    )
    friction_law: str = choice(
        "schlenk", FRICTION_LAWS, "GearFrictionLaw", "law of the friction that makes loss and heat"
    )
    f0: float = quantity(
        0.12,
        "1",
        0.0,
        1.0,
        "coefficient of friction without any film; against scuffing at most that",
        read_by=BY_FILM,
    )
    constant_friction: float = quantity(
        0.05,
        "1",
        0.0,
        1.0,
        "coefficient of the constant law",
        tunable=True,
        read_by=(("friction_law", "constant"),),
    )
    eyring_stress: float = quantity(
        5e6,
        "Pa",
        1e5,
        1e8,
        "Eyring stress of the film, mixed law",
        read_by=(("friction_law", "mixed"),),
    )
    film_heat: str = choice("loss", FILM_HEAT, "FilmHeat", "heat that warms the flanks")
    thermal_mode: str = choice(
        "transient", THERMAL_MODES, "ThermalMode", "how the bodies follow the inputs in time"
    )
    thermal_start: str = choice(
        "steady", THERMAL_STARTS, "ThermalStart", "bodies at the start", read_by=TRANSIENT
    )
    bulk_conductance: float = quantity(
        0.0,
        "W/K",
        0.0,
        1e5,
        "heat of this mesh's bodies to the oil per kelvin (0: by the flash)",
        belongs_to=SIZE,
        read_by=OF_LOSS,
    )
    bulk_heat_capacity: float = quantity(
        0.0,
        "J/K",
        0.0,
        1e8,
        "heat capacity of this mesh's bodies (0: by masses over mates)",
        at_zero=_constant("D_BULK_CAPACITY"),
        belongs_to=SIZE,
        read_by=OF_LOSS,
    )
    lubrication_factor: float = quantity(
        1.0,
        "1",
        0.1,
        3.0,
        "factor X_S of the bulk temperature: 1 dip, 1.2 spray",
        read_by=(("bulk_conductance", 0.0),),
    )
    mates_pinion: int = count(
        1, 1, 100, "gears that mesh with the pinion; a planet of a set has 2, sun and ring"
    )
    mates_gear: int = count(
        1, 1, 100, "gears that mesh with the gear; sun and ring of a set have all its planets"
    )
    steel: str = choice("case-hardened", STEELS, "Steel", "steel that the main outputs are for")
    contact_limit: float = quantity(
        0.0,
        "Pa",
        0.0,
        3e9,
        "allowable contact stress (0: that of the steel)",
        overrides=("steel",),
        at_zero=_constant("D_LIMIT"),
    )
    structural_factor: float = quantity(
        1.0, "1", 0.1, 2.0, "structural factor X_W of the steel against scuffing"
    )
    fzg_stage: int = count(10, 1, 14, "load stage at which the oil fails in the FZG test")
    permissible_film_ratio: float = quantity(
        0.0, "1", 0.0, 10.0, "film over Ra that micropitting takes (0: not given, no safety)"
    )
    youngs_modulus: float = quantity(
        205e9, "Pa", 1e9, 1e12, "Young's modulus, of the gear too if it is not given"
    )
    poisson_ratio: float = quantity(
        0.3, "1", 0.0, 0.49, "Poisson's ratio, of the gear too if it is not given"
    )
    conductivity: float = quantity(
        50.2, "W/(m.K)", 0.1, 500.0, "heat conductivity, of the gear too if it is not given"
    )
    heat_capacity: float = quantity(
        475.0, "J/(kg.K)", 50.0, 5e3, "heat capacity, of the gear too if it is not given"
    )
    density: float = quantity(
        7850.0, "kg/m3", 500.0, 2e4, "density, of the gear too if it is not given"
    )
    thermal_expansion: float = quantity(12e-6, "1/K", 0.0, 1e-4, "thermal expansion of the steel")
    oil_conductivity: float = quantity(0.13, "W/(m.K)", 0.01, 1.0, "heat conductivity of the oil")
    oil_heat_capacity: float = quantity(2010.0, "J/(kg.K)", 500.0, 5e3, "heat capacity of the oil")
    oil_density: float = quantity(880.0, "kg/m3", 500.0, 2e3, "density of the oil")
    viscosity_scale: float = quantity(9.7e-5, "Pa.s", 1e-7, 1e-2, "scale of the viscosity law")
    viscosity_b: float = quantity(
        755.0, "K", 0.0, 2e3, "numerator in the viscosity's exponent", relative=True
    )
    viscosity_c: float = quantity(
        70.0, "K", 60.0, 400.0, "added to degC in the viscosity's exponent", relative=True
    )
    viscosity_at: str = choice(
        "surface", VISCOSITY_AT, "ViscosityAt", "temperature that sets the viscosity"
    )
    film_viscosity: str = choice(
        "surface",
        FILM_VISCOSITY,
        "FilmViscosity",
        "viscosity that the film thickness follows",
        read_by=OF_ATAN,
    )
    pressure_viscosity: float = quantity(
        0.0,
        "1/Pa",
        0.0,
        1e-7,
        "pressure coefficient of the viscosity at 38 degC (0: by base_oil and viscosity)",
        at_zero=_constant("D_ALPHA"),
    )
    heat_partition: str = choice(
        "constant",
        HEAT_PARTITION,
        "HeatPartition",
        "how heat divides between the flanks",
        read_by=OF_ATAN,
    )
    partition_share: float = quantity(
        0.5,
        "1",
        0.0,
        1.0,
        "share of the heat into the pinion",
        read_by=(("heat_partition", "constant"),),
    )
    traction_law: str = choice(
        "ambient", TRACTION_LAWS, "TractionLaw", "shear stress of the oil film", read_by=OF_ATAN
    )
    limiting_traction: float = quantity(
        0.07,
        "1",
        0.01,
        0.2,
        "largest shear stress over the mean pressure",
        read_by=(("friction_law", "mixed"), ("traction_law", "limited")),
    )
    asperity_group: float = quantity(
        0.05, "1", 1e-3, 1.0, "asperities per area x radius x scatter of heights"
    )
    hardness_factor: float = quantity(2.84, "1", 1.0, 10.0, "hardness over ultimate strength")
    area_law: str = choice("bounded", AREA_LAWS, "AreaLaw", "nominal over real contact area")
    area_ratio: float = quantity(
        30.0, "1", 1.0, 1e6, "area ratio of the constant law", read_by=(("area_law", "constant"),)
    )
    switch: str = choice("smooth", SWITCHES, "ContactSwitch", "film ratio where asperities heat")
    asperity_base: str = choice(
        "surface", ASPERITY_BASES, "AsperityBase", "temperature the asperity's rise is added to"
    )
    speed_smoothing: float = quantity(
        0.1, "rad/s", 1e-6, 100.0, "speed over which friction_torque passes through zero"
    )
    profile_shift_pinion: float = quantity(
        0.0, "1", -2.0, 2.0, "profile shift of the pinion over the normal module"
    )
    profile_shift_gear: float = quantity(
        0.0, "1", -5.0, 5.0, "profile shift of the gear, of a ring positive outwards"
    )
    working_centre_distance: float = quantity(
        0.0,
        "m",
        0.0,
        10.0,
        "distance of the axes as they are mounted (0: from the profile shifts)",
        at_zero=_working_distance,
    )
    profile_shift_gear_from_distance: bool = flag(
        False, "whether working_centre_distance decides the gear's profile shift"
    )
    tip_diameter_pinion: float = quantity(
        0.0, "m", 0.0, 10.0, "tip diameter (0: from addendum and profile shift)", at_zero=_tip(0)
    )
    tip_diameter_gear: float = quantity(
        0.0,
        "m",
        0.0,
        20.0,
        "tip diameter of the gear (0: from addendum and profile shift)",
        at_zero=_tip(1),
    )
    tip_shortening: float = quantity(
        0.0,
        "1",
        0.0,
        0.5,
        "by how much the tips of both gears are cut back, over the normal module",
    )

    root_limit: float = quantity(
        0.0, "Pa", 0.0, 3e9, "nominal stress number of the root, sigma_Flim (0: no root safety)"
    )
    tool_addendum: float = quantity(
        1.25, "1", 0.5, 2.0, "addendum of the rack that cuts the teeth, over the normal module"
    )
    tool_tip_radius: float = quantity(
        0.38, "1", 0.02, 0.6, "radius at the tip of that rack, over the normal module"
    )
    reversed_bending: float = quantity(
        1.0,
        "1",
        0.5,
        1.0,
        "share of root_limit for the pinion; 0.7 where its teeth bend both ways, as a planet's",
        read_by=BY_ROOT,
    )
    face_load_factor: float = quantity(
        1.0, "1", 1.0, 5.0, "face load factor of flanks and root, in addition to load_factor"
    )
    mesh_load_factor: float = quantity(
        1.0, "1", 1.0, 2.0, "mesh load factor of flanks and root: uneven load of the planets"
    )
    load_sharing: str = choice(
        "rigid", LOAD_SHARING, "LoadSharing", "how the pairs in contact share the load"
    )
    stiffness_at_ends: float = quantity(
        0.7,
        "1",
        0.1,
        1.0,
        "stiffness of a pair where contact begins and ends over that in the middle; an estimate",
        read_by=BY_STIFFNESS,
    )
    tip_relief_pinion: float = quantity(
        0.0, "m", 0.0, 1e-3, "tip relief of the pinion, normal to the flank", read_by=BY_STIFFNESS
    )
    tip_relief_gear: float = quantity(
        0.0, "m", 0.0, 1e-3, "tip relief of the gear, normal to the flank", read_by=BY_STIFFNESS
    )
    tip_relief_length_pinion: float = _relief_length("pinion")
    tip_relief_length_gear: float = _relief_length("gear")
    base_oil: str = choice("mineral", BASE_OILS, "BaseOil", "base of the oil, for its friction")
    friction_scale: float = quantity(
        1.0,
        "1",
        0.1,
        5.0,
        "multiplies the friction that the law gives for loss and heat, as a loss test asks for",
        read_by=BY_SCALE,
    )
    boundary_friction: float = quantity(
        0.065,
        "1",
        0.01,
        0.3,
        "boundary friction: below 1 m/s at the pitch line the law grows to it at most",
        read_by=BY_SPEED,
    )
    material_gear: str = choice(
        "as-pinion", MATERIALS_GEAR, "GearMaterial", "material of the gear where it has its own"
    )
    youngs_modulus_gear: float = quantity(
        0.0,
        "Pa",
        0.0,
        1e12,
        "Young's modulus of the gear (0: that of its material)",
        overrides=("material_gear",),
        at_zero=_constant("D_MODULUS_GEAR"),
    )
    poisson_ratio_gear: float = quantity(
        0.0,
        "1",
        0.0,
        0.49,
        "Poisson's ratio of the gear (0: that of its material)",
        overrides=("material_gear",),
        at_zero=_constant("D_POISSON_GEAR"),
    )
    conductivity_gear: float = quantity(
        0.0, "W/(m.K)", 0.0, 500.0, "heat conductivity of the gear (0: that of its material)"
    )
    heat_capacity_gear: float = quantity(
        0.0, "J/(kg.K)", 0.0, 5e3, "heat capacity of the gear (0: that of its material)"
    )
    density_gear: float = quantity(
        0.0, "kg/m3", 0.0, 2e4, "density of the gear (0: that of its material)"
    )
    contact_limit_gear: float = quantity(
        0.0,
        "Pa",
        0.0,
        3e9,
        "allowable contact stress of the gear (0: that of its material)",
        at_zero=_constant("D_LIMIT_GEAR"),
    )
    root_limit_gear: float = quantity(
        0.0,
        "Pa",
        0.0,
        3e9,
        "nominal stress number of the gear's root (0: as root_limit)",
        read_by=BY_ROOT,
    )
    efficiency: float = quantity(
        0.98,
        "1",
        0.01,
        1.0,
        "power out over power in, the pinion drives",
        tunable=True,
        read_by=BY_EFFICIENCY,
    )
    efficiency_back: float = quantity(
        0.0,
        "1",
        0.0,
        1.0,
        "power out over power in, the gear drives (0: as efficiency)",
        at_zero="efficiency",
        tunable=True,
        read_by=BY_EFFICIENCY,
    )
    holding: str = holding_choice("the mesh")
    coupling_inertia: float = coupling_inertia()
    coupling_age: int = coupling_age()

    def __post_init__(self) -> None:
        check_ranges(self)
        from .kernels.constants import broken_rule

        check_rules(self, RULES, broken_rule)

    @classmethod
    def preset(cls, name: str, **changes: object) -> "GearMeshParams":
        """Return a named set of parameters ("paper", "literal", "iso") with further changes.

        >>> GearMeshParams.preset("literal", pinion_teeth=30).face_width
        1.0
        """
        made: GearMeshParams = preset_params(SPEC, name, changes)
        return made


def default_of(name: str) -> Any:
    """Return the default of a parameter."""
    return GearMeshParams.__dataclass_fields__[name].default


def centre_distance(params: GearMeshParams) -> float:
    """Return the reference distance [m]: of the axes without profile shift, by module and teeth."""
    from .kernels.working_pair import section

    return float(section(as_array(params))[1])


STEELS_OF_THE_PAPER = ("aisi1020", "aisi4340")
ENDURANCE = ("modification_factor", "allowable_ratio")
ENDURANCE_OF_BOTH = (*ENDURANCE, "stress_utilization")


def absent_outputs(params: GearMeshParams) -> frozenset[str]:
    """Return the outputs that have no value with these parameters: no limit given, no data.

    Endurance under thermal stress is the paper's alone: its heat, and one of its two steels.
    """
    found: set[str] = set()
    if params.permissible_film_ratio == 0.0:
        found.add("micropitting_safety")
    if params.root_limit == 0.0:
        found.add("root_safety")
    if params.film_heat != "atan" or params.steel == "case-hardened":
        both = (f"{name}_{s}" for name in ENDURANCE_OF_BOTH for s in STEELS_OF_THE_PAPER)
        found.update(ENDURANCE, both)
    return frozenset(found)


def _counted() -> tuple[tuple[str, int], ...]:
    from .kernels.layout import F_ITERATIONS

    return (("viscosity iterations", F_ITERATIONS),)


SPEC = spec_beside(
    __file__, GearMeshParams, RULES, counted=_counted, absent=absent_outputs, exchange=EXCHANGE
)
LOAD, SPEED, OIL = SPEC.inputs
