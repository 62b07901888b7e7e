"""What the wet clutch shows for model exchange."""

from ..model.spec import Exchange, Signal, output
from ..tribology.holding.parameters import BRISTLE, bend_state, largest_capacity
from .kernels.layout import N_RINGS

_INPUTS = ("load", "speed", "oil_temperature", "drum_speed")
_PLATES = tuple(f"plate_temperature_{k}" for k in range(1, N_RINGS + 1))
_HEATED = ("film", *_PLATES)
_ALL = (*_HEATED, "bend")
_OF_STATES = "friction_power friction_torque contact_torque heat_flux".split()
_OF_FILM = "torque_capacity viscous_torque friction_coefficient viscosity".split()
_ON_TORQUE = (*_INPUTS[:2], "drum_speed")


def _plate(place: int, name: str) -> Signal:
    text = f"mean temperature of the steel at ring {place} of a face"
    if place > 1:
        text += " (fidelity fine)"
    return output(name, "K", 300.0, text)


EXCHANGE = Exchange(
    kernel="thrustwasher.clutch.kernels.exchange",
    states=(
        output("film", "1", 1.0, "film ratio as a state, where it is one"),
        bend_state("bend", "of the bristle that holds the pack at rest"),
        output("energy", "J", 1e4, "heat made by friction since the start"),
        *(_plate(k, name) for k, name in enumerate(_PLATES, 1)),
    ),
    needs={
        **dict.fromkeys(_OF_STATES, (*_INPUTS, *_ALL)),
        **dict.fromkeys(_OF_FILM, (*_INPUTS, *_HEATED)),
        "film_thickness": ("load", "film"),
        "film_ratio": ("load", "film"),
        "contact_share": ("load", "film"),
        "temperature": _PLATES,
        "energy": ("energy",),
        "oil_heat": ("load", "oil_temperature", "film", *_PLATES),
        "stored_heat": _PLATES,
        "oil_energy": ("energy", *_PLATES),
        "der(film)": (*_INPUTS, *_HEATED),
        "der(bend)": (*_INPUTS, *_ALL),
        "der(energy)": (*_INPUTS, *_ALL),
        **{f"der({name})": (*_INPUTS, *_ALL) for name in _PLATES},
        "start(film)": ("load",),
        "start(bend)": _INPUTS,
        **{f"start({name})": ("oil_temperature",) for name in _PLATES},
    },
    indicators=(
        "0.98 of the capacity, or 0.95 until the pack is held, below which a lock lasts",
        "the load below which the pack is open",
        "film ratio 3, from film to mixed",
        "film ratio 1, from mixed to boundary",
        "the slip at which boundary friction becomes adhesion",
        "the temperature from which the interface is hot",
    ),
    parameters=(
        *BRISTLE,
        largest_capacity("at 1 MPa and friction 0.12", 300.0),
    ),
    requires={"contact_rise": False},
)
