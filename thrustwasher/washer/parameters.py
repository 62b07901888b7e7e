"""Parameters of the thrust washer; ``interface.toml`` has its inputs and outputs."""

import math
from dataclasses import dataclass
from typing import Any

from ..errors import ParameterError
from ..face_load import Face, even_radius, worn_peak
from ..model.parameters import (
    check_number,
    check_ranges,
    check_rules,
    choice,
    flag,
    quantity,
    renewed,
)
from ..model.part_file import preset_params
from ..model.spec import Rule
from ..model.toml_tables import spec_beside
from ..tribology.holding.parameters import coupling_age, coupling_inertia, holding_choice
from .exchange import EXCHANGE

LEAST_ROUGHNESS = 1.5e-7  # [m] smoother ones make the tilted gap hundreds of sigma: not solved
FRICTION_LAWS = {
    "load": "falls with the logarithm of the mean contact pressure (Jackson & Green Eq 18)",
    "constant": "the constant dry_friction",
}
HEIGHT_LAWS = {
    "surface": "asperity heights scatter like the surface, sigma_s = sigma",
    "summit": "summits scatter less: sigma_s^2 = sigma^2 - 3.717e-4/(density x radius)^2",
}
YIELD_LAWS = {
    "young": "e_y = yield strength over Young's modulus",
    "contact": "e_y = yield strength over the contact modulus E'",
}
CONDUCTION = {
    "all": "temperature varies around the circumference in all three bodies",
    "carrier": "only in the carrier; washer and gear are axisymmetric (they rotate)",
    "rotating": "only in washer and gear; the carrier is axisymmetric (it rotates)",
}
CAVITY_SHEAR = {
    "full": "as if oil filled the gap everywhere, in shear and heat exchange (the paper's torque)",
    "liquid": "both count by the share of the gap that liquid fills",
}
GEAR_FAR_FACE = {
    "oil": "as warm as the oil",
    "insulated": "no heat passes, as in the middle of a planet between two washers",
    "bulk": "at the input far_face_temperature, such as a mesh's bulk temperature",
}
BODY_STORAGE = {
    "slab": "heat takes its time through the thickness of carrier and gear",
    "lumped": "each body has one temperature across its thickness",
}

THERMAL_MODES = {
    "quasi_steady": "steady temperatures at every instant",
    "transient": "carrier, washer and gear store heat (fidelity field or fine)",
}
OUTSIDE_MAP = {
    "hold": "stay at the nearest point of the box: bounded, and off by what lies between",
    "refuse": "no answer: the step fails with NOT_IN_MAP",
    "solve": "solve the field: right, and a thousand times slower than a look-up",
}
THERMAL_STARTS = {
    "steady": "as warm as the first operating point makes it",
    "oil": "everything at oil temperature",
}


BODIES = ("carrier", "washer", "gear")
MATERIAL = {  # property of each body: unit, default, minimum, maximum, what it is
    "youngs_modulus": ("Pa", 201e9, 1e9, 1e12, "Young's modulus"),
    "poisson_ratio": ("1", 0.296, 0.0, 0.49, "Poisson's ratio"),
    "yield_strength": ("Pa", 0.993e9, 1e7, 1e11, "yield strength"),
    "conductivity": ("W/(m.K)", 60.5, 0.1, 500.0, "conductivity"),
    "density": ("kg/m3", 7850.0, 500.0, 25e3, "density"),
    "specific_heat": ("J/(kg.K)", 475.0, 50.0, 5e3, "specific heat"),
}


RADII = ("inner_radius", "outer_radius")
TRANSIENT = (("thermal_mode", "transient"),)
OVER_LOAD = (("friction_law", "load"),)


def _own(name: str, common: str, unit: str, least: float, largest: float) -> Rule:
    """Return the rule of a body's own value: 0, or in the range of the common one."""
    unit = "" if unit == "1" else f" {unit}"
    return Rule(
        f"{name} = {{{name}}}{unit}, allowed: 0 (as {common}) or {least:g} .. {largest:g}{unit}"
    )


def _material(name: str, **extra: object) -> Any:
    """Return the field of a property that all bodies share."""
    unit, default, least, largest, text = MATERIAL[name]
    return quantity(default, unit, least, largest, f"{text} of the bodies", **extra)


def _body(name: str, **extra: object) -> Any:
    """Return the field of one body's own property, 0 if it has the common one."""
    common, body = name.rsplit("_", 1)
    unit, _, _, largest, text = MATERIAL[common]
    return quantity(
        0.0, unit, 0.0, largest, f"{text} of the {body} (0: {common})", overrides=(common,), **extra
    )


def property_of(params: "WasherParams", name: str, body: str) -> float:
    """Return a property of one body: its own, else the one that all have in common."""
    value: float = getattr(params, f"{name}_{body}") or getattr(params, name)
    return value


RULES = (
    Rule(
        "gear_inner_radius = {gear_inner_radius} m, allowed: between inner_radius {inner_radius} "
        "and outer_radius {outer_radius} m"
    ),
    Rule("outer_radius = {outer_radius} m, allowed: up to 20 x inner_radius ({inner_radius} m)"),
    *(_own(f"roughness_{body}", "roughness", "m", LEAST_ROUGHNESS, 1e-5) for body in BODIES),
    Rule(
        "friction_pressure_min = {friction_pressure_min} Pa, allowed: below "
        "friction_pressure_max ({friction_pressure_max} Pa)"
    ),
    Rule(
        "asperity_density x asperity_radius = {asperity_density} 1/m2 x {asperity_radius} m "
        "leaves no scatter of the summits at roughness = {roughness} m; raise either, or use "
        "asperity_height_law = 'surface'"
    ),
    *(
        _own(f"{name}_{body}", name, unit, least, largest)
        for name, (unit, _, least, largest, _) in MATERIAL.items()
        if least > 0.0
        for body in BODIES
    ),
    *(
        Rule(
            f"yield_strength = {{yield_strength}} Pa, allowed: for {pair} up to their contact "
            "modulus (youngs_modulus = {youngs_modulus} Pa): they could not touch elastically"
        )
        for pair in ("carrier and washer", "washer and gear")
    ),
    Rule(
        "oil_supply_temperature = {oil_supply_temperature} K, allowed: 0 (as oil_temperature) or "
        "233.15 .. 473.15 K"
    ),
    Rule(
        "film_heat_fraction = {film_heat_fraction}, allowed: 1 with oil_cooling, which carries "
        "the film's heat away already"
    ),
    Rule("cavity_shear = liquid, allowed: with oil_cooling, which knows where the liquid is"),
    Rule(
        "thermal_mode = transient, allowed: with fidelity field or fine; a map has "
        "no bodies that could store heat"
    ),
    Rule(
        "gear_far_face = bulk, allowed: with fidelity field or fine; a map is for oil or insulated"
    ),
)


INNER, OUTER = 0.0111, 0.0227  # [m] radii of Jackson & Green's washer
# They measured dry friction over the load on its face, f = 0.48 - 0.05 ln F.
PAPER_FACE = math.pi * (OUTER**2 - INNER**2)  # [m^2]
MEGAPASCAL = 1e6  # [Pa]
NEWTONS = {  # parameters of the dry friction law over the load: unit, minimum, maximum, what it is
    "friction_constant": ("1", 0.0, 2.0, "dry friction at 1 N"),
    "friction_load_min": ("N", 1.0, 1e5, "lower end of the law's range"),
    "friction_load_max": ("N", 1.0, 1e5, "upper end of the law's range"),
}
OVER_PRESSURE = {
    "friction_constant": "friction_reference",
    "friction_load_min": "friction_pressure_min",
    "friction_load_max": "friction_pressure_max",
}


def face_of(inner_radius: float, outer_radius: float) -> float:
    """Return the area of a washer's face [m^2]."""
    return math.pi * (outer_radius**2 - inner_radius**2)


def washer_face(params: Any) -> Face:
    """Return the face between carrier and washer."""
    radii = params.inner_radius, params.outer_radius
    return Face(face_of(*radii), 1, even_radius(*radii), worn_peak(*radii))


def _over_pressure(given: dict[str, Any]) -> dict[str, Any]:
    """Return parameters with a friction law over the load turned into one over the pressure.

    The loads are those on the face of the washer that they are given for. What is given of the
    law over the load makes the whole law that of the paper over the load, as it was in newtons.
    """
    own = {name: given[name] for name in NEWTONS if name in given}
    if not own:
        return given
    full = {"friction_constant": 0.48, "friction_load_min": 260.5, "friction_load_max": 1725.6}
    full |= own
    values = {k: v for k, v in given.items() if k not in NEWTONS}
    for name, value in own.items():
        unit, low, high, _ = NEWTONS[name]
        full[name] = check_number(name, value, unit, low, high)
        if OVER_PRESSURE[name] in values:
            raise ParameterError(
                f"{name} together with {OVER_PRESSURE[name]}, allowed: a law over the load "
                f"or one over "
                "the mean pressure"
            )
    if not full["friction_load_min"] < full["friction_load_max"]:
        raise ParameterError(
            f"friction_load_min = {full['friction_load_min']:g} N, allowed: below "
            f"friction_load_max ({full['friction_load_max']:g} N)"
        )
    face = face_of(values.get("inner_radius", INNER), values.get("outer_radius", OUTER))
    slope = values.get("friction_slope", 0.05)
    values["friction_reference"] = full["friction_constant"] - slope * math.log(MEGAPASCAL * face)
    values["friction_pressure_min"] = full["friction_load_min"] / face
    values["friction_pressure_max"] = full["friction_load_max"] / face
    return values


def _over_load(params: "WasherParams") -> dict[str, float]:
    """Return the law over the load that is the one over the mean pressure."""
    face = face_of(params.inner_radius, params.outer_radius)
    slope = params.friction_slope * math.log(MEGAPASCAL * face)
    return {
        "friction_constant": params.friction_reference + slope,
        "friction_load_min": params.friction_pressure_min * face,
        "friction_load_max": params.friction_pressure_max * face,
    }


@renewed(NEWTONS, _over_pressure, _over_load)
@dataclass(frozen=True, slots=True, kw_only=True)
class WasherParams:
    """Geometry, surfaces, oil and friction of a thrust washer between carrier and gear.

    Defaults: Jackson & Green (2006), Table 1, read as radii. Not in the paper and chosen here:
    asperity radius and density, the heat split; see docs/theory/washer.md.
    """

    inner_radius: float = quantity(INNER, "m", 1e-3, 0.5, "inner radius of the washer")
    outer_radius: float = quantity(OUTER, "m", 2e-3, 0.6, "outer radius of washer and gear face")
    gear_inner_radius: float = quantity(
        0.0156, "m", 1e-3, 0.6, "inner radius of the gear face", belongs_to=RADII
    )
    carrier_thickness: float = quantity(0.01, "m", 1e-4, 1.0, "thickness of the carrier plate")
    washer_thickness: float = quantity(6.35e-4, "m", 5e-5, 0.1, "thickness of the washer")
    gear_thickness: float = quantity(0.01, "m", 1e-4, 1.0, "thickness of the gear's web")
    roughness: float = quantity(
        5.15e-7, "m", LEAST_ROUGHNESS, 1e-5, "RMS roughness of every surface"
    )
    roughness_carrier: float = quantity(
        0.0, "m", 0.0, 1e-5, "RMS of the carrier (0: roughness)", overrides=("roughness",)
    )
    roughness_washer: float = quantity(
        0.0, "m", 0.0, 1e-5, "RMS of the washer (0: roughness)", overrides=("roughness",)
    )
    roughness_gear: float = quantity(
        0.0, "m", 0.0, 1e-5, "RMS of the gear face (0: roughness)", overrides=("roughness",)
    )
    youngs_modulus: float = _material("youngs_modulus")
    youngs_modulus_carrier: float = _body("youngs_modulus_carrier")
    youngs_modulus_washer: float = _body("youngs_modulus_washer")
    youngs_modulus_gear: float = _body("youngs_modulus_gear")
    poisson_ratio: float = _material("poisson_ratio")
    poisson_ratio_carrier: float = _body("poisson_ratio_carrier")
    poisson_ratio_washer: float = _body("poisson_ratio_washer")
    poisson_ratio_gear: float = _body("poisson_ratio_gear")
    yield_strength: float = _material("yield_strength")
    yield_strength_carrier: float = _body("yield_strength_carrier")
    yield_strength_washer: float = _body("yield_strength_washer")
    yield_strength_gear: float = _body("yield_strength_gear")
    yield_strain_law: str = choice(
        "young", YIELD_LAWS, "YieldStrainLaw", "modulus that the yield strain refers to"
    )
    asperity_radius: float = quantity(1e-5, "m", 1e-7, 1e-3, "radius of the asperity tips")
    asperity_density: float = quantity(6.865114e9, "1/m2", 1e7, 1e13, "asperities per nominal area")
    asperity_height_law: str = choice(
        "surface", HEIGHT_LAWS, "HeightLaw", "scatter of the asperity heights"
    )
    conductivity: float = _material("conductivity")
    conductivity_carrier: float = _body("conductivity_carrier")
    conductivity_washer: float = _body("conductivity_washer")
    conductivity_gear: float = _body("conductivity_gear")
    conduction: str = choice(
        "carrier", CONDUCTION, "Conduction", "bodies with a 2-D temperature field"
    )
    gear_far_face: str = choice(
        "oil", GEAR_FAR_FACE, "GearFarFace", "what the gear's far face borders on"
    )
    oil_conductivity: float = quantity(0.145, "W/(m.K)", 0.01, 1.0, "conductivity of the oil")
    viscosity_constant: float = quantity(3.545, "1", 1.0, 6.0, "G_o of the Roelands law")
    viscosity_exponent: float = quantity(1.053, "1", 0.2, 3.0, "S_o of the Roelands law")
    viscosity_scale: float = quantity(6.31e-5, "Pa.s", 1e-6, 1e-2, "scale of the Roelands law")
    oil_cooling: bool = flag(True, "whether the oil that flows through the film carries heat away")
    oil_density: float = quantity(850.0, "kg/m3", 500.0, 1500.0, "density of the oil")
    oil_heat_capacity: float = quantity(
        2000.0, "J/(kg.K)", 500.0, 5000.0, "specific heat of the oil"
    )
    oil_supply_temperature: float = quantity(
        0.0,
        "K",
        0.0,
        473.15,
        "temperature of the oil that is drawn in (0: oil_temperature)",
        at_zero="oil_temperature",
        read_by=(("oil_cooling", True),),
    )
    cavity_shear: str = choice(
        "full", CAVITY_SHEAR, "CavityShear", "what the cavity counts as in shear and heat exchange"
    )
    pressure_flow_shear: bool = flag(True, "whether pressure flow counts in torque and heat")
    friction_law: str = choice("load", FRICTION_LAWS, "FrictionLaw", "law of the dry friction")
    dry_friction: float = quantity(
        0.15,
        "1",
        0.0,
        1.0,
        "dry friction of the constant law",
        read_by=(("friction_law", "constant"),),
    )
    friction_reference: float = quantity(
        0.48 - 0.05 * math.log(MEGAPASCAL * PAPER_FACE),
        "1",
        -2.0,
        2.0,
        "dry friction at a mean contact pressure of 1 MPa",
        read_by=OVER_LOAD,
    )
    friction_slope: float = quantity(
        0.05, "1", 0.0, 0.2, "slope of the dry friction law", read_by=OVER_LOAD
    )
    friction_pressure_min: float = quantity(
        260.5 / PAPER_FACE, "Pa", 1.0, 1e9, "lower end of the law's range", read_by=OVER_LOAD
    )
    friction_pressure_max: float = quantity(
        1725.6 / PAPER_FACE, "Pa", 1.0, 1e9, "upper end of the law's range", read_by=OVER_LOAD
    )
    heat_split: float = quantity(
        0.5, "1", 0.0, 1.0, "share of the heat that enters the carrier", tunable=True
    )
    film_heat_fraction: float = quantity(
        1.0, "1", 0.0, 1.0, "share of film heat into the solids", tunable=True
    )
    thermal_mode: str = choice(
        "quasi_steady", THERMAL_MODES, "ThermalMode", "how temperatures follow the inputs in time"
    )
    density: float = _material("density", read_by=TRANSIENT)
    density_carrier: float = _body("density_carrier", read_by=TRANSIENT)
    density_washer: float = _body("density_washer", read_by=TRANSIENT)
    density_gear: float = _body("density_gear", read_by=TRANSIENT)
    specific_heat: float = _material("specific_heat", read_by=TRANSIENT)
    specific_heat_carrier: float = _body("specific_heat_carrier", read_by=TRANSIENT)
    specific_heat_washer: float = _body("specific_heat_washer", read_by=TRANSIENT)
    specific_heat_gear: float = _body("specific_heat_gear", read_by=TRANSIENT)
    body_storage: str = choice(
        "slab",
        BODY_STORAGE,
        "BodyStorage",
        "how carrier and gear store heat, if transient",
        read_by=TRANSIENT,
    )
    thermal_start: str = choice(
        "steady",
        THERMAL_STARTS,
        "ThermalStart",
        "temperatures at the start, if transient",
        read_by=TRANSIENT,
    )
    holding: str = holding_choice("the washer")
    coupling_inertia: float = coupling_inertia()
    coupling_age: int = coupling_age()
    outside_map: str = choice(
        "solve",
        OUTSIDE_MAP,
        "OutsideMap",
        "what fidelity map does outside its box",
        read_by=(("fidelity", "map"),),
        of_a_run=True,
    )

    @classmethod
    def preset(cls, name: str, **changes: object) -> "WasherParams":
        """Return the parameters of a preset, some of them changed.

        ``"paper"``: the equations of Jackson & Green (2006): temperature fields of two dimensions
        in all bodies, no heat carried by the oil, no pressure flow in the torque, lumped bodies.

        Raises
        ------
        ParameterError : no such preset, or a parameter out of range
        """
        made: WasherParams = preset_params(SPEC, name, changes)
        return made

    def __post_init__(self) -> None:
        check_ranges(self)
        from .kernels.regime_and_status import broken_rule

        check_rules(self, RULES, broken_rule)


def _counted() -> tuple[tuple[str, int], ...]:
    from .kernels.layout import FACTORED, ITERATIONS

    return ("Newton iterations", ITERATIONS), ("heat factors made", FACTORED)


SPEC = spec_beside(__file__, WasherParams, RULES, counted=_counted, exchange=EXCHANGE)
