"""Parameters, inputs and outputs of the thrust washer: the one list all interfaces come from."""

from dataclasses import dataclass
from functools import partial

from ..model.parameters import check_ranges, check_rules, choice, quantity
from ..model.spec import OIL_PORT, ModelSpec, Rule, Signal, Terminal, output

LEAST_ROUGHNESS = 1.5e-7  # [m] smoother ones make the tilted gap hundreds of sigma: not solved
FRICTION_LAWS = {
    "load": "falls with the logarithm of the total contact force (Jackson & Green Eq 18)",
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
    "rotating": "only in washer and gear; the carrier is axisymmetric",
}

THERMAL_MODES = {
    "quasi_steady": "steady temperatures at every instant",
    "transient": "carrier, washer and gear store heat (fidelity coarse, field or fine)",
}
THERMAL_STARTS = {
    "steady": "as warm as the first operating point makes it",
    "oil": "everything at oil temperature",
}


def _smooth(name: str) -> Rule:
    bounds = f"{LEAST_ROUGHNESS:g} .. 1e-05 m"
    return Rule(f"{name} = {{{name}}} m, allowed: 0 (as roughness) or {bounds}")


RULES = (
    Rule("gear_inner_radius = {gear_inner_radius} m, allowed: between inner_radius {inner_radius} "
         "and outer_radius {outer_radius} m"),
    Rule("outer_radius = {outer_radius} m, allowed: up to 20 x inner_radius ({inner_radius} m)"),
    _smooth("roughness_carrier"),
    _smooth("roughness_washer"),
    _smooth("roughness_gear"),
    Rule("friction_load_min = {friction_load_min} N, allowed: below friction_load_max "
         "({friction_load_max} N)"),
    Rule("asperity_density x asperity_radius = {asperity_density} 1/m2 x {asperity_radius} m "
         "leaves no scatter of the summits at roughness = {roughness} m; raise either, or use "
         "asperity_height_law = 'surface'"),
    Rule("thermal_mode = transient, allowed: with fidelity coarse, field or fine; the others have "
         "no bodies that could store heat"),
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class WasherParams:
    """Geometry, surfaces, oil and friction of a thrust washer between carrier and gear.

    Defaults: Jackson & Green (2006), Table 1, read as radii. Not in the paper and chosen here:
    asperity radius and density, the heat split; see docs/theory/washer.md.
    """

    inner_radius: float = quantity(0.0111, "m", 2e-3, 0.05, "inner radius of the washer")
    outer_radius: float = quantity(0.0227, "m", 3e-3, 0.06, "outer radius of washer and gear face")
    gear_inner_radius: float = quantity(0.0156, "m", 2e-3, 0.06, "inner radius of the gear face")
    carrier_thickness: float = quantity(0.01, "m", 1e-4, 0.1, "thickness of the carrier plate")
    washer_thickness: float = quantity(6.35e-4, "m", 1e-4, 0.02, "thickness of the washer")
    gear_thickness: float = quantity(0.01, "m", 1e-4, 0.1, "thickness of the gear's web")
    roughness: float = quantity(
        5.15e-7, "m", LEAST_ROUGHNESS, 1e-5, "RMS roughness of every surface"
    )
    roughness_carrier: float = quantity(0.0, "m", 0.0, 1e-5, "RMS of the carrier (0: roughness)")
    roughness_washer: float = quantity(0.0, "m", 0.0, 1e-5, "RMS of the washer (0: roughness)")
    roughness_gear: float = quantity(0.0, "m", 0.0, 1e-5, "RMS of the gear face (0: roughness)")
    youngs_modulus: float = quantity(201e9, "Pa", 2e10, 1e12, "Young's modulus of both surfaces")
    poisson_ratio: float = quantity(0.296, "1", 0.0, 0.49, "Poisson's ratio of both surfaces")
    yield_strength: float = quantity(0.993e9, "Pa", 2e8, 1e11, "yield strength of the softer face")
    yield_strain_law: str = choice(
        "young", YIELD_LAWS, "YieldStrainLaw", "modulus that the yield strain refers to"
    )
    asperity_radius: float = quantity(1e-5, "m", 1e-7, 1e-3, "radius of the asperity tips")
    asperity_density: float = quantity(6.865114e9, "1/m2", 1e8, 1e12, "asperities per nominal area")
    asperity_height_law: str = choice(
        "surface", HEIGHT_LAWS, "HeightLaw", "scatter of the asperity heights"
    )
    conductivity: float = quantity(60.5, "W/(m.K)", 1.0, 500.0, "conductivity of the three bodies")
    conduction: str = choice("all", CONDUCTION, "Conduction", "bodies with a 2-D temperature field")
    oil_conductivity: float = quantity(0.145, "W/(m.K)", 0.01, 1.0, "conductivity of the oil")
    viscosity_constant: float = quantity(3.545, "1", 1.0, 6.0, "G_o of the Roelands law")
    viscosity_exponent: float = quantity(1.053, "1", 0.2, 3.0, "S_o of the Roelands law")
    viscosity_scale: float = quantity(6.31e-5, "Pa.s", 1e-6, 1e-2, "scale of the Roelands law")
    friction_law: str = choice("load", FRICTION_LAWS, "FrictionLaw", "law of the dry friction")
    dry_friction: float = quantity(0.15, "1", 0.0, 1.0, "dry friction of the constant law")
    friction_constant: float = quantity(0.48, "1", 0.0, 2.0, "constant of the dry friction law")
    friction_slope: float = quantity(0.05, "1", 0.0, 0.2, "slope of the dry friction law")
    friction_load_min: float = quantity(260.5, "N", 1.0, 1e5, "lower end of the law's range")
    friction_load_max: float = quantity(1725.6, "N", 1.0, 1e5, "upper end of the law's range")
    heat_split: float = quantity(0.5, "1", 0.0, 1.0, "share of the heat that enters the carrier")
    film_heat_fraction: float = quantity(1.0, "1", 0.0, 1.0, "share of film heat into the solids")
    thermal_mode: str = choice(
        "quasi_steady", THERMAL_MODES, "ThermalMode", "how temperatures follow the inputs in time"
    )
    density: float = quantity(7850.0, "kg/m3", 500.0, 25e3, "density of the three bodies")
    specific_heat: float = quantity(475.0, "J/(kg.K)", 50.0, 5e3, "specific heat of the bodies")
    thermal_start: str = choice(
        "steady", THERMAL_STARTS, "ThermalStart", "temperatures at the start, if transient"
    )

    def __post_init__(self) -> None:
        check_ranges(self)
        from .kernels.regime_and_status import broken_rule

        check_rules(self, RULES, broken_rule)


LOAD = Signal(name="load", unit="N", help="axial load on the washer, pressing gear to carrier",
              low=0.0, high=1e4, nominal=300.0, start=300.0)  # fmt: skip
SPEED = Signal(name="speed", unit="rad/s", help="speed of washer and gear against the carrier",
               low=-2000.0, high=2000.0, nominal=500.0, start=545.0)  # fmt: skip
TILT = Signal(name="tilt", unit="rad", help="tilt of the gear about the y axis",
              low=0.0, high=0.01, nominal=2e-3, start=2e-3)  # fmt: skip
OIL = Signal(name="oil_temperature", unit="K", help="temperature of oil and outer faces",
             low=233.15, high=473.15, nominal=300.0, start=297.15)  # fmt: skip
_ALL = ("load", "speed", "tilt", "oil_temperature")
_out = partial(output, depends=_ALL)

SPEC = ModelSpec(
    key="washer",
    name="ThrustWasher",
    help="Tilted thrust washer in mixed lubrication: friction torque, temperature, film thickness",
    params=WasherParams,
    fidelities={
        "closed": "wedge in closed form, oil at its own temperature; no branches",
        "stribeck": "wedge in closed form, one film temperature; one branch, steep at the folds",
        "map": "look-up in charts of fine solutions; the field's answer outside their box",
        "coarse": "8 x 20 graded nodes: torque within 2 % but near a knee of the curve",
        "field": "10 x 32 graded nodes: torque within 0.6 % but near a knee of the curve",
        "fine": "19 x 64 graded nodes: torque within 0.1 % but near a knee of the curve",
    },
    default_fidelity="field",
    inputs=(LOAD, SPEED, TILT, OIL),
    outputs=(
        _out("friction_torque", "N.m", 0.1, "friction torque on the washer, sign of the speed"),
        _out("temperature", "K", 300.0, "area mean of the film temperature over the annulus"),
        _out("film_thickness", "m", 1e-6, "least separation of the mean surfaces of film 1"),
        _out("temperature_max", "K", 300.0, "highest temperature of carrier and washer"),
        _out("film_ratio", "1", 3.0, "film thickness over the combined RMS roughness"),
        _out("fluid_load_share", "1", 1.0, "share of the load that the film carries"),
        _out("friction_coefficient", "1", 0.05, "torque over load and mean friction radius"),
        _out("friction_power", "W", 100.0, "heat made by friction, torque times speed"),
        Signal(name="regime", unit="1", kind="enumeration", type="Regime", depends=_ALL,
               help="lubrication regime of the loaded film"),
        Signal(name="distress", unit="1", kind="boolean", depends=_ALL,
               help="film lost, or more than 200 K mean rise",
               events=("film lost, or more than 200 K mean rise", "film regained")),
        Signal(name="solver_status", unit="1", kind="enumeration", type="SolverStatus",
               depends=_ALL, help="how the last solution was obtained"),
    ),
    kernel="thrustwasher.washer.kernels.step",
    rules=RULES,
    terminals=(
        Terminal(name="shaft", kind="thrustwasher.WasherFlange",
                 help="Slip speed, load and tilt in, friction torque out",
                 members=(("speed", "w", "signal"), ("friction_torque", "tau", "inflow"),
                          ("load", "load", "signal"), ("tilt", "tilt", "signal"))),
        OIL_PORT,
    ),
    table="thrustwasher.washer.map.look_up:TABLES",
    step_size=0.02,  # quasi-steady: the step decides how finely the inputs are followed
    course=((0.0, 100.0, 545.0, 2e-3, 297.15), (0.6, 400.0, 545.0, 2e-3, 310.0),
            (1.0, 200.0, 300.0, 1.5e-3, 310.0)),
    counts=(("Newton iterations", "thrustwasher.washer.kernels.layout:ITERATIONS"),
            ("heat factors made", "thrustwasher.washer.kernels.layout:FACTORED")),
)  # fmt: skip
