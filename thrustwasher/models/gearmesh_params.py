"""Parameters of the gear mesh: one spur pair, its surfaces, oil, steel and the laws to apply."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..errors import ParameterError
from ._params import check_ranges, choice, count, quantity
from ._rules import check_rules
from .gearmesh_rules import RULES
from .gearmesh_spec import gearmesh_spec

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
        from ..kernels.gear_constants import broken_rule

        check_rules(self, RULES, broken_rule)

    @classmethod
    def preset(cls, name: str, **changes: Any) -> GearMeshParams:
        """Return a named set of parameters ("bounded", "literal", "iso") with further changes.

        >>> GearMeshParams.preset("literal", pinion_teeth=30).face_width
        1.0
        """
        if name not in PRESETS:
            raise ParameterError(f"preset = {name!r}, allowed: {' or '.join(map(repr, PRESETS))}")
        return cls(**(PRESETS[name] | changes))


SPEC = gearmesh_spec(GearMeshParams)
