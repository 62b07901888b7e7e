"""Parameters of the driveline losses; ``interface.toml`` has inputs and outputs."""

from dataclasses import dataclass
from typing import Any

from ..model.parameters import check_ranges, check_rules, choice, count, extended, quantity
from ..model.spec import Exchange, Rule, output
from ..model.toml_tables import spec_beside
from ..tribology.holding.parameters import BRISTLE, bend_state
from .kernels.skf_series import RADIAL

# Shaft -> bearings, their mean diameter [m] and load [N] each, gear's diameter and width [m], depth
# over diameter, diameter of the seal [m]; the defaults.
SHAFTS = {
    "input": (2, 0.05, 500.0, 0.1, 0.03, 0.0, 0.045),
    "output": (2, 0.065, 800.0, 0.16, 0.03, 0.2, 0.045),
    "drum": (1, 0.08, 200.0, 0.17, 0.05, 0.0, 0.0),
}
LAWS = {
    "palmgren": "f0 and f1 of Palmgren: for moderate load and a full film",
    "skf": "SKF's model: rolling and sliding friction, mixed too, with constants of the series",
}
FULL_FILM = "friction of ball bearings in full film: 0.05 mineral, 0.04 synthetic, 0.1 gearbox oil"
RULES = (
    Rule(
        "bearing_law = {bearing_law}, bearing_series = {bearing_series}: SKF's model has no "
        "constants for it, allowed: one of its series, or bearing_law = 'palmgren'"
    ),
)


@dataclass(frozen=True, kw_only=True)
class _LossesParams:
    """Bearings, churning gears, seals and oil pump of a planetary gearbox, and its oil.

    The defaults are estimates of a car's automatic transmission of about 300 N m: pump of 15 cm3
    at 10 bar, ATF of about 37 mm2/s at 40 degC, the output gear dips by a fifth of its diameter.
    Factors f0 and f1 are of the size that handbooks of rolling bearings give (Harris 2001; SKF).
    """

    planets: int = count(4, 1, 20, "number of planets: each has planet_torque")
    planet_bearing_count: int = count(
        1, 1, 4, "needle bearings of one planet, which share its load"
    )
    planet_bearing_diameter: float = quantity(
        0.018, "m", 1e-3, 1.0, "mean diameter of a planet's needle bearing"
    )
    planet_viscous_factor: float = quantity(
        6.0, "1", 0.0, 50.0, "f0 of needle bearings: 6 oil mist, 12 oil bath"
    )
    planet_load_factor: float = quantity(
        0.001, "1", 0.0, 0.02, "f1 of needle bearings: half a coefficient of friction of 0.002"
    )
    bearing_viscous_factor: float = quantity(
        2.0,
        "1",
        0.0,
        50.0,
        "f0 of the main bearings: 1 to 3 of ball and cylindrical roller bearings",
        read_by=(("bearing_law", "palmgren"),),
    )
    bearing_load_factor: float = quantity(
        4e-4,
        "1",
        0.0,
        0.02,
        "f1 of the main bearings: 2e-4 to 1e-3",
        read_by=(("bearing_law", "palmgren"),),
    )
    pump_displacement: float = quantity(
        1.5e-5, "m3", 0.0, 1e-2, "oil that the pump moves per turn of the input shaft"
    )
    line_pressure: float = quantity(1e6, "Pa", 0.0, 1e8, "pressure rise of the pump")
    pump_efficiency: float = quantity(
        0.85, "1", 0.1, 1.0, "hydro-mechanical efficiency of the pump"
    )
    oil_volume: float = quantity(6e-3, "m3", 1e-6, 100.0, "oil that the gears dip into")
    oil_density: float = quantity(850.0, "kg/m3", 500.0, 1500.0, "density of the oil")
    viscosity_constant: float = quantity(
        3.545, "1", 0.0, 6.0, "G_o of the Roelands law (0: viscosity is viscosity_scale, constant)"
    )
    viscosity_exponent: float = quantity(
        1.053, "1", 0.2, 3.0, "S_o of the Roelands law", read_by=(("viscosity_constant", ">", 0.0),)
    )
    viscosity_scale: float = quantity(6.31e-5, "Pa.s", 1e-6, 10.0, "scale of the Roelands law")
    speed_smoothing: float = quantity(
        0.1, "rad/s", 1e-6, 100.0, "speed over which the torques pass through zero"
    )

    def __post_init__(self) -> None:
        check_ranges(self)
        from .kernels.step import broken_rule

        check_rules(self, RULES, broken_rule)


def _of_shaft(name: str) -> dict[str, Any]:
    """Return the parameters of one shaft, in the kernel's order."""
    bearings, diameter, load, gear, width, immersion, seal = SHAFTS[name]
    shaft = "drum" if name == "drum" else f"{name} shaft"
    carried = {"read_by": ((f"{name}_bearing_count", ">", 0),)}
    dipping = {"read_by": ((f"{name}_immersion", ">", 0.0),)}
    fields = {
        "bearing_count": count(bearings, 0, 20, f"main bearings of the {shaft}"),
        "bearing_diameter": quantity(
            diameter,
            "m",
            1e-3,
            2.0,
            f"mean diameter of each main bearing of the {shaft}",
            **carried,
        ),
        "bearing_load": quantity(
            load, "N", 0.0, 1e6, f"radial load of each main bearing of the {shaft}", **carried
        ),
        "gear_diameter": quantity(
            gear,
            "m",
            5e-3,
            5.0,
            f"pitch diameter of the gear of the {shaft} that may dip",
            **dipping,
        ),
        "gear_width": quantity(
            width, "m", 1e-3, 1.0, f"width of the gear of the {shaft}", **dipping
        ),
        "immersion": quantity(
            immersion, "1", 0.0, 0.5, f"depth in the oil over diameter, gear of the {shaft}"
        ),
        "seal_diameter": quantity(
            seal, "m", 0.0, 1.0, f"shaft under the lip seal of the {shaft} (0: no seal)"
        ),
    }
    return {f"{name}_{key}": field for key, field in fields.items()}


_ACTS = {
    "input": ("input_speed", "oil_temperature"),
    "output": ("output_speed", "oil_temperature"),
    "drum": ("drum_speed", "oil_temperature"),
    "planet": ("planet_speed", "tooth_force", "oil_temperature"),
}
_OF_SHAFTS = ("input_bend", "output_bend", "drum_bend")
_ALL = ("input_speed", "output_speed", "drum_speed", "planet_speed", "tooth_force")
_BENDS = (*_OF_SHAFTS, "planet_bend")
EXCHANGE = Exchange(
    kernel="thrustwasher.losses.kernels.exchange",
    states=(
        *(bend_state(f"{name}_bend", f"of the bristle of the speed {name}") for name in _ACTS),
        output("oil_energy", "J", 1e3, "heat that has gone into the oil since the start"),
    ),
    needs={
        **{f"{name}_torque": (f"{name}_bend",) for name in _ACTS},
        "bearing_power": _BENDS,
        "churning_power": _OF_SHAFTS,
        "pump_power": ("input_bend",),
        "seal_power": _OF_SHAFTS,
        "oil_heat": _BENDS,
        "oil_energy": ("oil_energy",),
        **{f"der({name}_bend)": (*acts, f"{name}_bend") for name, acts in _ACTS.items()},
        **{f"start({name}_bend)": acts for name, acts in _ACTS.items()},
        "der(oil_energy)": (*_ALL, "oil_temperature", *_BENDS),
    },
    indicators=(
        *(f"a change of the churning regime of the {name} gear" for name in SHAFTS),
        "the temperatures between which the laws are meant",
    ),
    parameters=BRISTLE,
)
_MORE = {
    "starvation_constant": quantity(
        3e-8,
        "1",
        0.0,
        1e-6,
        "SKF's K_rs, all bearings: 3e-8 low oil bath or jet, 6e-8 oil and air (0: never starved)",
    ),
    "bearing_section": quantity(
        0.45, "1", 0.05, 1.5, "outer less inner diameter over the mean one, main bearings"
    ),
    "bearing_type_constant": quantity(
        3.1,
        "1",
        1.0,
        10.0,
        "SKF's K_Z of the main bearings: 3.1 deep groove ball, 5.1 cylindrical roller",
    ),
    "planet_bearing_section": quantity(
        0.35, "1", 0.05, 1.5, "outer less inner diameter over the mean one, planets' bearings"
    ),
    "planet_bearing_type_constant": quantity(
        5.1,
        "1",
        1.0,
        10.0,
        "SKF's K_Z of the planets' bearings: 5.1 with cage, 6.2 without",
    ),
    "bearing_law": choice(
        "palmgren",
        LAWS,
        "BearingLaw",
        "law of the main bearings' torque; needle bearings of planets follow Palmgren",
    ),
    "bearing_series": choice(
        "none",
        RADIAL,
        "RadialSeries",
        "series of the main bearings in SKF's tables",
        read_by=(("bearing_law", "skf"),),
    ),
    "bearing_sliding_friction": quantity(
        0.05, "1", 0.0, 0.3, FULL_FILM, read_by=(("bearing_law", "skf"),)
    ),
}
LossesParams = extended(
    _LossesParams,
    "LossesParams",
    {k: v for name in SHAFTS for k, v in _of_shaft(name).items()} | _MORE,
)
SPEC = spec_beside(__file__, LossesParams, RULES, exchange=EXCHANGE)
