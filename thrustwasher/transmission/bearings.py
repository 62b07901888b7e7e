"""The thrust bearings that sun and ring lean on: their parameters and rules."""

from typing import Any

from ..model.parameters import choice, quantity
from ..model.spec import Rule

# Name -> shafts it lies between and mean radius [m], an estimate of a car-sized set.
BEARINGS = {"sun_bearing": ("sun", "carrier", 0.025), "ring_bearing": ("ring", "case", 0.033)}
SHAFT = {
    "sun": "the sun and what turns with it",
    "carrier": "the carrier, the output",
    "ring": "the ring and what turns with it",
    "case": "the case, which stands",
}


def bearing_fields(name: str) -> dict[str, Any]:
    """Return the parameters of a bearing; without a coefficient there is none."""
    one, other, radius = BEARINGS[name]
    words = f"the {name.partition('_')[0]}'s thrust bearing"
    thrust = (("helix_angle", ">", 0.0),)  # spur teeth give none
    there = {"read_by": ((f"{name}_coefficient", ">", 0.0),)}
    return {
        f"{name}_shaft_1": choice(one, SHAFT, "Shaft", f"one end of {words}", **there),
        f"{name}_shaft_2": choice(other, SHAFT, "Shaft", f"the other end of {words}", **there),
        f"{name}_coefficient": quantity(
            0.0, "1", 0.0, 0.1, f"friction of {words} (0: none)", read_by=thrust
        ),
        f"{name}_mean_radius": quantity(radius, "m", 1e-3, 1.0, f"mean radius of {words}", **there),
    }


def two_ends(name: str) -> Rule:
    """Return the rule that a bearing lies between two shafts."""
    return Rule(
        f"{name}_shaft_2 = {{{name}_shaft_2}}, allowed: another shaft than "
        f"{name}_shaft_1 ({' or '.join(SHAFT)})"
    )


def rubbing(name: str) -> Rule:
    """Return the rule that a bearing takes less than the teeth give."""
    return Rule(
        f"{name}_mean_radius = {{{name}_mean_radius}} m, allowed: with {name}_coefficient "
        f"({{{name}_coefficient}}) x tan(helix_angle) up to a tenth of the sun's pitch "
        "radius, or the bearing takes more than the teeth give"
    )
