"""What the thrust washer shows for model exchange."""

from ..model.spec import Exchange, Signal, output
from ..tribology.holding.parameters import BRISTLE, bend_state, largest_capacity

_INPUTS = ("load", "speed", "tilt", "oil_temperature", "far_face_temperature")
# Mean temperatures, which act with `thermal_mode` = transient; else they stay as warm as the oil.
_FACES = ("carrier_temperature", "washer_temperature", "gear_temperature")
_SLOWER = ("carrier_rise_2", "carrier_rise_3", "gear_rise_2", "gear_rise_3", "gear_rise_4")
_OF_BRISTLE = "friction_torque friction_power friction_coefficient throughflow_heat stick_margin"
_OF_FILM = (
    "film_thickness film_ratio fluid_load_share oil_flow temperature temperature_max "
    "oil_outlet_temperature film_temperature"
)
_ALL = (*_INPUTS, "bend", *_FACES)
_STORED = (*_FACES, *_SLOWER)


def _face(body: str) -> Signal:
    text = f"area mean of the {body}'s temperature at its face, in time"
    return output(f"{body}_temperature", "K", 300.0, text)


def _rise(body: str, place: int) -> Signal:
    text = f"what term {place} of the heat's way through the {body} has of its mean temperature"
    return output(f"{body}_rise_{place}", "K", 10.0, text, relative=True)


EXCHANGE = Exchange(
    kernel="thrustwasher.washer.kernels.exchange.unit",
    states=(
        bend_state("bend", "of the bristle that holds the washer at rest"),
        output("energy", "J", 100.0, "heat made by friction since the start"),
        _face("carrier"),
        _rise("carrier", 2),
        _rise("carrier", 3),
        output("washer_temperature", "K", 300.0, "area mean of the washer's temperature, in time"),
        _face("gear"),
        *(_rise("gear", place) for place in (2, 3, 4)),
    ),
    needs={
        **dict.fromkeys(_OF_BRISTLE.split(), _ALL),
        **dict.fromkeys(_OF_FILM.split(), _ALL),
        "oil_heat": (*_ALL, *_SLOWER),
        "energy": ("energy",),
        "stored_heat": _STORED,
        "oil_energy": ("energy", *_STORED),
        "der(bend)": _ALL,
        "der(energy)": _ALL,
        **{f"der({name})": (*_ALL, *_SLOWER) for name in _STORED},
        "start(bend)": _INPUTS,
        **{f"start({name})": _INPUTS for name in _STORED},
    },
    indicators=(
        "the fold that ends the branch that the washer is on; in time where the film is lost",
        "film ratio 3, from film to mixed",
        "film ratio 1, from mixed to boundary",
        "the temperature from which the washer is hot",
        "200 K mean rise",
        "the ends of what is verified: load, speed, tilt, oil temperature",
        "the ends of the map, outside of which the field is solved",
        "what the bodies' fields may be off since they were brought up to date",
    ),
    parameters=(
        *BRISTLE,
        largest_capacity("dry at 1 MPa", 3.0),
    ),
    steps=True,
)
