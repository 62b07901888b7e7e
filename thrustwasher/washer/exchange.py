"""What the thrust washer shows for model exchange."""

from ..model.spec import Exchange, output
from ..tribology.holding.parameters import BRISTLE, bend_state, largest_capacity

_INPUTS = ("load", "speed", "tilt", "oil_temperature", "far_face_temperature")
_OF_BRISTLE = (
    "friction_torque friction_power friction_coefficient oil_heat throughflow_heat temperature "
    "temperature_max oil_outlet_temperature film_temperature stick_margin"
).split()
_OF_FILM = "film_thickness film_ratio fluid_load_share oil_flow".split()

EXCHANGE = Exchange(
    kernel="thrustwasher.washer.kernels.exchange.unit",
    states=(
        bend_state("bend", "of the bristle that holds the washer at rest"),
        output("energy", "J", 100.0, "heat made by friction since the start"),
    ),
    needs={
        **dict.fromkeys(_OF_BRISTLE, (*_INPUTS, "bend")),
        **dict.fromkeys(_OF_FILM, _INPUTS),
        "energy": ("energy",),
        "oil_energy": ("energy",),
        "der(bend)": (*_INPUTS, "bend"),
        "der(energy)": (*_INPUTS, "bend"),
        "start(bend)": _INPUTS,
    },
    indicators=(
        "the fold that ends the branch, of film or contact, that the washer is on",
        "film ratio 3, from film to mixed",
        "film ratio 1, from mixed to boundary",
        "the temperature from which the washer is hot",
        "200 K mean rise",
        "the ends of what is verified: load, speed, tilt, oil temperature",
        "the ends of the map, outside of which the field is solved",
    ),
    parameters=(
        *BRISTLE,
        largest_capacity("dry at 1 MPa", 3.0),
    ),
    requires={"thermal_mode": 1},
    steps=True,
)
