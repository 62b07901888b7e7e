"""Parameters of the gear mesh: one spur pair, its surfaces, oil, steel and the laws to apply."""

import math
from dataclasses import dataclass
from functools import partial
from typing import Any

from ..model.parameters import (
    as_numbers,
    check_ranges,
    check_rules,
    choice,
    count,
    from_preset,
    quantity,
)
from ..model.spec import OIL_PORT, ModelSpec, Rule, Signal, Terminal, output

SURFACES = {
    "rough": "rough ground: composite RMS 2.26 um, effective roughness 4.5e-5",
    "fine": "fine ground: composite RMS 0.566 um, effective roughness 1.5e-5",
}
FRICTION_LAWS = {
    "li-seireg": "falls with film over radius (Atan Eq 4); slide/roll ratio above 0.27 only",
    "iso": "mean coefficient of ISO/TS 6336-20, at most f0",
    "constant": "the constant coefficient constant_friction",
}
STEELS = {
    "AISI4340": "high-carbon steel: endurance 0.53 mechanical, 0.40 thermal of 1301 MPa",
    "AISI1020": "low-carbon steel: endurance 0.63 mechanical, 0.77 thermal of 689 MPa",
}
VISCOSITY_AT = {
    "surface": "the film has the viscosity at the flank's temperature, found with it",
    "inlet": "the film has the viscosity of the oil supplied",
}
FILM_VISCOSITY = {
    "surface": "the film thickness follows the same viscosity as the shear",
    "inlet": "the film thickness is made by the oil supplied, whatever the flank does",
}
HEAT_PARTITION = {
    "constant": "the pinion takes the share partition_share",
    "velocity": "the share that makes both flanks equally hot",
}
TRACTION_LAWS = {
    "ambient": "shear stress of the oil at ambient pressure",
    "limited": "viscosity rises with pressure, stress up to limiting_traction x mean pressure",
}
AREA_LAWS = {
    "bounded": "Greenwood-Williamson area, no asperity pressed beyond its hardness",
    "greenwood-williamson": "Greenwood-Williamson area, unbounded (up to a ratio of 1e6)",
    "constant": "the constant ratio area_ratio of nominal over real area",
}
SWITCHES = {
    "smooth": "asperity heating fades out from film ratio 1.0 to 1.8",
    "sharp": "asperity heating up to film ratio 1.4, none above",
    "none": "asperity heating at any film ratio",
}
ASPERITY_BASES = {
    "surface": "the asperity's rise is added to the flank's temperature",
    "bulk": "the asperity's rise is added to the oil's; without contact it is as hot as the film",
}
# Named sets of changes to the defaults, for GearMeshParams.preset.
PRESETS: dict[str, dict[str, Any]] = {
    "bounded": {},
    "literal": {
        "face_width": 1.0, "viscosity_at": "inlet", "area_law": "constant", "area_ratio": 30.0,
        "switch": "none", "asperity_base": "bulk",
    },
    "iso": {"friction_law": "iso"},
}  # fmt: skip


_ALWAYS = "so large that a pair is always in contact"


def _shape(p: Any) -> tuple[float, float, float, float]:
    return p.gear_ratio, float(p.pinion_teeth), p.pressure_angle, p.addendum


def _interference(p: Any) -> str:
    from .kernels import constants as g

    least = math.floor(g.least_teeth(p.gear_ratio, p.pressure_angle, p.addendum)) + 1
    return (
        f"pinion_teeth = {p.pinion_teeth!r}, allowed: {least} and more for gear_ratio = "
        f"{p.gear_ratio:g}, pressure_angle = {math.degrees(p.pressure_angle):g} deg, addendum "
        f"= {p.addendum:g} (with fewer the gear's tips cut below the pinion's involute: "
        "interference)"
    )


def _contact_ratio(p: Any) -> str:
    from .kernels import constants as g

    contact = sum(g.path_lengths(*_shape(p), g.start_of_contact(*_shape(p))))
    return (
        f"addendum = {p.addendum!r}, allowed: {_ALWAYS}; the contact ratio is {contact:.4g}, "
        "allowed: 1 and more"
    )


def _base_friction(p: Any) -> str:
    import numpy as np

    from .kernels.constants import effective_roughness

    s = effective_roughness(np.array(as_numbers(p)))
    return (
        f"f0 = {p.f0!r}, allowed: {0.0864 - 1372.0 * s:.4g} .. 1 for effective_roughness = {s:g} "
        "(below, a thick film would have negative friction)"
    )


def _slide_roll(p: Any) -> str:
    from .kernels import constants as g

    found = g.slide_roll(p.gear_ratio, g.start_of_contact(*_shape(p)))
    return (
        "friction_law = 'li-seireg', allowed: for slide/roll ratios above 0.27 only, here "
        f"{found:.4g} at the start of contact (pinion_teeth = {p.pinion_teeth!r}); use "
        "friction_law = 'iso'"
    )


RULES = (
    Rule("pinion_teeth = {pinion_teeth}, allowed: more for gear_ratio = {gear_ratio}, "
         "pressure_angle = {pressure_angle} rad, addendum = {addendum} (with so few the gear's "
         "tips cut below the pinion's involute: interference)", _interference),
    Rule(f"addendum = {{addendum}}, allowed: {_ALWAYS} (contact ratio 1 and more)",
         _contact_ratio),
    Rule("effective_roughness = {effective_roughness}, allowed: 7.459e-06 .. 6.297e-05 for "
         "friction_law = 'li-seireg' (0: that of the surface)"),
    Rule("f0 = {f0}, allowed: 0.0864 - 1372 effective_roughness .. 1 "
         "(below, a thick film would have negative friction)", _base_friction),
    Rule("friction_law = 'li-seireg', allowed: for slide/roll ratios above 0.27 only, not reached "
         "at the start of contact (pinion_teeth = {pinion_teeth}); use friction_law = 'iso'",
         _slide_roll),
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class GearMeshParams:
    """A spur pair at the start of contact: geometry, flanks, friction, steel, oil, laws.

    Defaults: Atan (2005), SAE 30 oil, 20 degrees; not in the paper and chosen here: face width,
    roughness values, f0, pressure viscosity, thermal expansion, the asperity group. The sets in
    PRESETS ("bounded": these defaults, "literal": the paper taken at its word, per metre of face
    width, "iso") are made by ``GearMeshParams.preset(name, **changes)``.
    """

    gear_ratio: float = quantity(2.0, "1", 1.0, 20.0, "teeth of the gear over those of the pinion")
    pinion_teeth: int = count(20, 5, 500, "number of teeth of the pinion")
    centre_distance: float = quantity(0.254, "m", 5e-3, 10.0, "distance of the two gear axes")
    pressure_angle: float = quantity(
        0.3490658503988659, "rad", 0.2, 0.6, "pressure angle of the involute at the pitch point"
    )
    addendum: float = quantity(1.0, "1", 0.3, 1.5, "addendum of both gears over the module")
    face_width: float = quantity(0.05, "m", 1e-3, 5.0, "width of the teeth in contact")
    load_share: float = quantity(1.0, "1", 0.05, 1.0, "share of load on the pair that starts")
    surface: str = choice("rough", SURFACES, "Surface", "finish of the two flanks")
    sigma_rms: float = quantity(
        0.0, "m", 0.0, 2e-5, "composite RMS roughness (0: that of the surface)"
    )
    effective_roughness: float = quantity(
        0.0, "1", 0.0, 1e-4, "effective roughness S of Li and Seireg (0: that of the surface)"
    )
    mean_roughness: float = quantity(
        0.0, "m", 0.0, 2e-5, "Ra for the ISO law (0: composite RMS over sqrt 2)"
    )
    friction_law: str = choice("li-seireg", FRICTION_LAWS, "GearFrictionLaw", "law of the friction")
    f0: float = quantity(0.12, "1", 0.0, 1.0, "coefficient of friction without any film")
    constant_friction: float = quantity(0.05, "1", 0.0, 1.0, "coefficient of the constant law")
    steel: str = choice("AISI4340", STEELS, "Steel", "steel that the main outputs are for")
    youngs_modulus: float = quantity(205e9, "Pa", 2e10, 1e12, "Young's modulus of both gears")
    poisson_ratio: float = quantity(0.3, "1", 0.0, 0.49, "Poisson's ratio of both gears")
    conductivity: float = quantity(50.2, "W/(m.K)", 1.0, 500.0, "heat conductivity of both gears")
    heat_capacity: float = quantity(475.0, "J/(kg.K)", 50.0, 5e3, "heat capacity of both gears")
    density: float = quantity(7850.0, "kg/m3", 500.0, 2e4, "density of both gears")
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
        "surface", FILM_VISCOSITY, "FilmViscosity", "viscosity that the film thickness follows"
    )
    pressure_viscosity: float = quantity(
        2.2e-8, "1/Pa", 1e-9, 1e-7, "pressure coefficient of the viscosity"
    )
    heat_partition: str = choice(
        "constant", HEAT_PARTITION, "HeatPartition", "how heat divides between the flanks"
    )
    partition_share: float = quantity(0.5, "1", 0.0, 1.0, "share of the heat into the pinion")
    traction_law: str = choice(
        "ambient", TRACTION_LAWS, "TractionLaw", "shear stress of the oil film"
    )
    limiting_traction: float = quantity(
        0.07, "1", 0.01, 0.2, "largest shear stress over the mean pressure"
    )
    asperity_group: float = quantity(
        0.05, "1", 1e-3, 1.0, "asperities per area x radius x scatter of heights"
    )
    hardness_factor: float = quantity(2.84, "1", 1.0, 10.0, "hardness over ultimate strength")
    area_law: str = choice("bounded", AREA_LAWS, "AreaLaw", "nominal over real contact area")
    area_ratio: float = quantity(30.0, "1", 1.0, 1e6, "area ratio of the constant law")
    switch: str = choice("smooth", SWITCHES, "ContactSwitch", "film ratio where asperities heat")
    asperity_base: str = choice(
        "surface", ASPERITY_BASES, "AsperityBase", "temperature the asperity's rise is added to"
    )
    speed_smoothing: float = quantity(
        0.1, "rad/s", 1e-6, 100.0, "speed over which friction_torque passes through zero"
    )

    def __post_init__(self) -> None:
        check_ranges(self)
        from .kernels.constants import broken_rule

        check_rules(self, RULES, broken_rule)

    @classmethod
    def preset(cls, name: str, **changes: Any) -> "GearMeshParams":
        """Return a named set of parameters ("bounded", "literal", "iso") with further changes.

        >>> GearMeshParams.preset("literal", pinion_teeth=30).face_width
        1.0
        """
        return from_preset(cls, PRESETS, name, changes)


LOAD = Signal(name="load", unit="N.m", help="torque on the pinion, its sign does not matter",
              low=-1e5, high=1e5, nominal=40.0, start=0.0)  # fmt: skip
SPEED = Signal(name="speed", unit="rad/s", help="speed of the pinion, either sign",
               low=-5000.0, high=5000.0, nominal=180.0, start=0.0)  # fmt: skip
OIL = Signal(name="oil_temperature", unit="K", help="temperature of oil and gear bodies",
             low=233.15, high=473.15, nominal=300.0, start=299.85)  # fmt: skip
_ALL = ("load", "speed", "oil_temperature")
_out = partial(output, depends=_ALL)

OUTPUTS = (
    _out("friction_torque", "N.m", 1.0, "mesh loss as a torque on the pinion, sign of speed"),
    _out("temperature", "K", 300.0, "temperature of the pinion's asperities where contact starts"),
    _out("film_thickness", "m", 1e-6, "least film thickness where contact starts"),
    _out("surface_temperature", "K", 300.0, "temperature of the flank where contact starts"),
    _out("contact_stress", "Pa", 2e8, "Hertz contact stress where contact starts",
         depends=("load",)),
    _out("thermal_stress", "Pa", 1e8, "stress from the asperity's temperature rise"),
    _out("modification_factor", "1", 1.0, "squared thermal over contact stress, each by its limit"),
    _out("allowable_ratio", "1", 1.0, "share of contact stress allowed beside thermal stress"),
    _out("film_temperature", "K", 300.0, "highest temperature of the oil film"),
    _out("flash_rise", "K", 10.0, "temperature rise by friction over the nominal area",
         relative=True),
    _out("film_ratio", "1", 1.0, "film thickness over composite RMS roughness"),
    _out("friction_coefficient", "1", 0.1, "coefficient of friction of the flanks"),
    _out("friction_power", "W", 100.0, "heat made by the mesh, torque times speed"),
    _out("modification_factor_aisi1020", "1", 1.0, "modification factor for low-carbon AISI 1020"),
    _out("modification_factor_aisi4340", "1", 1.0, "modification factor for high-carbon AISI 4340"),
    _out("allowable_ratio_aisi1020", "1", 1.0, "share of contact stress allowed for AISI 1020"),
    _out("allowable_ratio_aisi4340", "1", 1.0, "share of contact stress allowed for AISI 4340"),
    _out("stress_utilization_aisi1020", "1", 1.0, "combined stress over endurance of AISI 1020"),
    _out("stress_utilization_aisi4340", "1", 1.0, "combined stress over endurance of AISI 4340"),
    Signal(name="regime", unit="1", kind="enumeration", type="Regime", depends=_ALL,
           help="lubrication regime where contact starts"),
    Signal(name="solver_status", unit="1", kind="enumeration", type="SolverStatus", depends=_ALL,
           help="how the last solution was obtained"),
)  # fmt: skip

SPEC = ModelSpec(
    key="gearmesh",
    name="GearMesh",
    help="Spur gear mesh: loss torque, contact, flank and asperity temperature, endurance",
    params=GearMeshParams,
    fidelities={
        "closed": "Hertz contact, Blok flash temperature, constant friction, oil as supplied",
        "stribeck": "the same as field, viscosity and flank's temperature in closed form",
        "field": "friction over the film, viscosity found with the flank's temperature",
        "fine": "the same at every position of the line of action, the loss their sum",
    },
    default_fidelity="field",
    inputs=(LOAD, SPEED, OIL),
    outputs=OUTPUTS,
    kernel="thrustwasher.gearmesh.kernels.step",
    presets=PRESETS,
    rules=RULES,
    terminals=(
        Terminal(name="shaft", kind="thrustwasher.MeshFlange",
                 help="Speed and torque of the pinion in, its friction torque out",
                 members=(("speed", "w", "signal"), ("friction_torque", "tau", "inflow"),
                          ("load", "load", "signal"))),
        OIL_PORT,
    ),
    # Run up under torque, work, coast down through standstill into reverse.
    course=((0.0, 0.0, 0.0, 300.0), (0.3, 40.0, 180.0, 300.0), (0.6, 60.0, 120.0, 330.0),
            (0.9, 20.0, 0.0, 330.0), (1.0, -20.0, -30.0, 330.0)),
    counts=(("viscosity iterations", "thrustwasher.gearmesh.kernels.layout:F_ITERATIONS"),),
)  # fmt: skip
