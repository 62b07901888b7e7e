"""Where a point lies outside the range of a law: sentences, one each."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from ..tribology.viscosity import viscosity
from ..units import format_quantity
from .kernels import loss_laws as laws
from .parameters import SHAFTS

GEARS = {"input": "input gear", "output": "output gear", "drum": "drum"}
LEAST_DEPTH, MOST_DEPTH = 0.1, 0.5  # over diameter
LEAST_LEFT = 0.1  # of a bearing's viscous torque, from which on it is no longer most of its drag
FREEZING, WARM = 273.15, 313.15  # K; WARM: temperature of the viscosity in the formula of seals


def doubts_of_point(params: Any, point: Mapping[str, float]) -> Iterator[str]:
    """Yield what lies outside the ranges of the laws at a point, inputs by their names."""
    for shaft in SHAFTS:
        speed = abs(point[f"{shaft}_speed"])
        if getattr(params, f"{shaft}_immersion") > 0.0 and speed > params.speed_smoothing:
            yield from _of_gear(params, shaft, speed, point["oil_temperature"])
    yield from _of_bearings(params, point)
    yield from _of_seals(params, point["oil_temperature"])


def _of_gear(params: Any, shaft: str, speed: float, oil: float) -> Iterator[str]:
    radius = 0.5 * getattr(params, f"{shaft}_gear_diameter")
    reynolds = speed * radius * getattr(params, f"{shaft}_gear_width") / _thickness(params, oil)
    froude = speed * speed * radius / laws.GRAVITY
    numbers = [
        ("Froude number", froude, laws.LEAST_FR, laws.MOST_FR),
        ("depth over diameter", getattr(params, f"{shaft}_immersion"), LEAST_DEPTH, MOST_DEPTH),
    ]
    if froude >= laws.LEAST_FR:  # a slower one has a small one of Reynolds too
        numbers.append(("Reynolds number", reynolds, laws.LEAST_RE, laws.MOST_RE))
    for name, value, low, high in numbers:
        if not low <= value <= high:
            side, limit = ("below", low) if value < low else ("above", high)
            yield (
                f"{GEARS[shaft]}: {name} {value:.3g} is {side} {limit:g}, the range of the laws of "
                "churning; its loss is extrapolated"
            )


def _of_bearings(params: Any, point: Mapping[str, float]) -> Iterator[str]:
    nu = _thickness(params, point["oil_temperature"])
    for name in (*SHAFTS, "planet"):
        of = "planet_bearing" if name == "planet" else "bearing"
        own = "planet_bearing" if name == "planet" else f"{name}_bearing"
        speed, diameter = abs(point[f"{name}_speed"]), getattr(params, f"{own}_diameter")
        if speed <= params.speed_smoothing or not getattr(params, f"{own}_count"):
            continue
        kind, section = getattr(params, f"{of}_type_constant"), getattr(params, f"{of}_section")
        starving = laws.starved(params.starvation_constant, kind, diameter, section)
        left = laws.thinned(speed, nu, diameter, starving)[0]
        if left < LEAST_LEFT:
            yield (
                f"{name} bearings: heated and starved, {100.0 * left:.2g} % of their viscous "
                "torque is left; drag of the oil around them, which is not in the law, may be more"
            )


def _of_seals(params: Any, oil: float) -> Iterator[str]:
    bracket = 145.0 - 1.6 * (oil - FREEZING)
    bracket += 350.0 * math.log10(math.log10(max(1e6 * _thickness(params, WARM), 0.5) + 0.8))
    if bracket < laws.LEAST_SEAL and any(getattr(params, f"{s}_seal_diameter") for s in SHAFTS):
        yield (
            f"seals: at {format_quantity(oil, 'K')} their formula falls below {laws.LEAST_SEAL:g}, "
            "its least value here; their loss is an estimate"
        )


def _thickness(params: Any, oil: float) -> float:
    """Return the kinematic viscosity [m2/s]."""
    law = params.viscosity_scale, params.viscosity_constant, params.viscosity_exponent
    mu: float = viscosity(oil, *law)[0]
    return mu / float(params.oil_density)
