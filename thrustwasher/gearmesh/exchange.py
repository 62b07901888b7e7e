"""What the gear mesh shows for model exchange."""

from ..model.spec import Exchange, output
from ..tribology.holding.parameters import BRISTLE, bend_state, largest_capacity

_INPUTS = ("load", "speed", "oil_temperature")
_ALL = (*_INPUTS, "body_temperature", "bend")
_OF_STATES = ("friction_torque", "friction_power", "oil_heat")
_OF_BODIES = (
    "temperature film_thickness surface_temperature thermal_stress modification_factor "
    "allowable_ratio film_temperature flash_rise film_ratio friction_coefficient "
    "modification_factor_aisi1020 modification_factor_aisi4340 allowable_ratio_aisi1020 "
    "allowable_ratio_aisi4340 stress_utilization_aisi1020 stress_utilization_aisi4340 "
    "mean_friction flash_max bulk_temperature scuffing_safety scuffing_margin scuffing_friction"
).split()

EXCHANGE = Exchange(
    kernel="thrustwasher.gearmesh.kernels.exchange",
    states=(
        output(
            "body_temperature", "K", 300.0, "temperature of the bodies as a state, where it is one"
        ),
        bend_state("bend", "of the bristle that holds the mesh at rest"),
        output("oil_energy", "J", 1e3, "heat that has gone into the oil since the start"),
    ),
    needs={
        **dict.fromkeys(_OF_STATES, _ALL),
        **dict.fromkeys(_OF_BODIES, (*_INPUTS, "body_temperature")),
        "stored_heat": ("body_temperature",),
        "oil_energy": ("oil_energy",),
        "der(body_temperature)": _ALL,
        "der(bend)": _ALL,
        "der(oil_energy)": _ALL,
        "start(body_temperature)": _INPUTS,
        "start(bend)": _INPUTS,
    },
    indicators=(
        "film ratio 3, from film to mixed",
        "film ratio 1, from mixed to boundary",
        "the temperature from which the film is hot",
        "the ends of the laws: of the oil's temperature, the asperities', their hardness",
    ),
    parameters=(
        *BRISTLE,
        largest_capacity("at rest and pitting_safety 3", 10.0),
    ),
)
