"""Losses of bearings, churning gears, oil pump and shaft seals at one operating point.

And which laws it is outside the range of.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import SolveError, Status
from ..model.advice import warnings_of
from ..model.idle import idle_warnings
from ..model.levels import level_named
from ..model.parameters import check_number
from ..model.prepare import filled
from ..model.sensitivity import Differentiable
from ..model.solutions import Asked
from ..model.spec import CHURNING_REGIMES
from ..tribology.viscosity import viscosity
from ..units import format_quantity
from .kernels import loss_laws as laws
from .kernels import step as k
from .loss_ranges import (
    FAST,
    LEAST_DEPTH,
    LEAST_LEFT,
    MIXED,
    MOST_DEPTH,
    OTHER_LAW,
    RUBBING,
    viscosity_ratio,
)
from .parameters import SHAFTS, SPEC, LossesParams

__all__ = ["LossesParams", "LossesResult", "solve_losses"]
GEARS = {"input": "input gear", "output": "output gear", "drum": "drum"}
FREEZING, WARM = 273.15, 313.15  # K; WARM: temperature of the viscosity in the formula of seals


@dataclass(frozen=True, slots=True)
class LossesResult(Differentiable):
    """Torques, each positive against a positive speed, and heat of all parts; SI units."""

    input_torque: float
    output_torque: float
    drum_torque: float
    planet_torque: float  # [N m] of one planet, against its carrier
    bearing_power: float  # [W] of main bearings and of the needle bearings of all planets
    churning_power: float
    pump_power: float
    seal_power: float
    oil_heat: float  # [W] the sum
    input_churning_regime: str  # "none", "viscous", "inertial", "between", "centrifugal_viscous"
    output_churning_regime: str  # or "centrifugal_inertial"
    drum_churning_regime: str
    status: Status
    fidelity: str
    _request: Asked = field(repr=False, compare=False)
    warnings: tuple[str, ...] = ()
    """What a reader must not miss, a line each."""


def solve_losses(
    params: object,
    *,
    input_speed: float,
    output_speed: float = 0.0,
    drum_speed: float = 0.0,
    planet_speed: float = 0.0,
    tooth_force: float = 0.0,
    oil_temperature: float = 353.15,
    fidelity: str = "handbook",
    throw: bool = True,
) -> LossesResult:
    """Return the losses of a planetary gearbox in addition to those of its teeth.

    Parameters
    ----------
    params : ``LossesParams``: bearings, gears, seals, pump, oil
    input_speed, output_speed, drum_speed : of these shafts [rad/s], -5000 .. 5000
    planet_speed : of the planets against their carrier [rad/s], -2e4 .. 2e4
    tooth_force : tangential, of one mesh of a planet [N]; its needle bearings bear twice as much
    oil_temperature : [K], 233.15 .. 473.15
    fidelity : "handbook"
    throw : False returns the best estimate with its status instead of raising SolveError

    Returns
    -------
    LossesResult; status OUTSIDE_VERIFIED with oil below -20 or above 150 degC, or where a gear
    churns outside the range of the laws

    Raises
    ------
    ParameterError : an argument is out of range; the message names it
    SolveError : a number is not finite (no case is known)

    Notes
    -----
    Source: docs/theory/losses.md: Palmgren's bearing friction with SKF's factors for thick oil,
    churning after Changenet, Leprince, Ville & Velex (2011), ISO/TR 14179-2 seals, all as publicly
    quoted.

    Examples
    --------
    >>> r = solve_losses(LossesParams(), input_speed=209.44)
    >>> round(r.pump_power, 1)
    588.2
    """
    given = (input_speed, output_speed, drum_speed, planet_speed, tooth_force, oil_temperature)
    point = {
        s.name: check_number(s.name, value, s.unit, s.low or 0.0, s.high or 0.0)
        for s, value in zip(SPEC.inputs, given, strict=True)
    }
    par = filled(SPEC, params, fidelity, k.NPAR, k.derive)
    out, flags = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)
    inputs = np.array([*point.values()])
    k.step(par, inputs, np.zeros(k.NSTATE), np.zeros(k.NWORK), out, flags, 0.0, 0.0)
    status = Status(int(flags[-1]))
    if status.is_failure and throw:
        words = ", ".join(f"{name} = {value:g}" for name, value in point.items())
        raise SolveError(f"{words}: {status.advice}")
    shown: dict[str, Any] = dict(zip(SPEC.real_outputs, out.tolist(), strict=True))
    del shown["oil_energy"]  # of a step, not of a point
    names = ["none", *CHURNING_REGIMES]  # 0: no solution
    shown |= {f"{n}_churning_regime": names[i] for n, i in zip(SHAFTS, flags, strict=False)}
    return LossesResult(
        **shown,
        status=status,
        fidelity=level_named(SPEC, fidelity),
        _request=Asked(SPEC.key, params, {**point, "fidelity": fidelity}),
        warnings=(
            *idle_warnings(SPEC.key, params, fidelity),
            *warnings_of(SPEC, status, point, shown, doubts_of_point(params, point)),
            *_mixed_friction(params, point),
        ),
    )


def doubts_of_point(params: Any, point: Mapping[str, float]) -> Iterator[str]:
    """Yield what lies outside the ranges of the laws at a point, inputs by their names."""
    for shaft in SHAFTS:
        speed = abs(point[f"{shaft}_speed"])
        if getattr(params, f"{shaft}_immersion") > 0.0 and speed > params.speed_smoothing:
            yield from _of_gear(params, shaft, speed, point["oil_temperature"])
    yield from _of_bearings(params, point)
    yield from _of_seals(params, point)


def _of_gear(params: object, shaft: str, speed: float, oil: float) -> Iterator[str]:
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
        if said := FAST.line(30.0 / math.pi * speed * 1e3 * diameter, f"{name} bearings: "):
            yield said
        kind, section = getattr(params, f"{of}_type_constant"), getattr(params, f"{of}_section")
        starving = laws.starved(params.starvation_constant, kind, diameter, section)
        left = laws.thinned(speed, nu, diameter, starving)[0]
        if left < LEAST_LEFT:
            yield (
                f"{name} bearings: heated and starved, {100.0 * left:.2g} % of their viscous "
                "torque is left; drag of the oil around them, which is not in the law, may be more"
            )


def _mixed_friction(params: Any, point: Mapping[str, float]) -> Iterator[str]:
    """Yield a line for the bearings that are deepest in mixed friction by Palmgren's law.

    Of a point alone: in a map of a gear shift's gearbox, where they lose little, it is true of most
    points and says nothing.
    """
    nu, mixed = _thickness(params, point["oil_temperature"]), []
    for name in (*SHAFTS, "planet"):
        own = "planet_bearing" if name == "planet" else f"{name}_bearing"
        speed, diameter = abs(point[f"{name}_speed"]), getattr(params, f"{own}_diameter")
        by_palmgren = name == "planet" or params.bearing_law == "palmgren"
        if by_palmgren and speed > params.speed_smoothing and getattr(params, f"{own}_count"):
            mixed.append((viscosity_ratio(speed, nu, diameter), f"{name} bearings: "))
    if mixed and (said := MIXED.line(*min(mixed))):
        yield said if "planet" in said else said + OTHER_LAW


def _of_seals(params: object, point: Mapping[str, float]) -> Iterator[str]:
    oil = point["oil_temperature"]
    for shaft in SHAFTS:
        rubbing = 0.5 * getattr(params, f"{shaft}_seal_diameter") * abs(point[f"{shaft}_speed"])
        if said := RUBBING.line(rubbing, f"{shaft} seal: "):
            yield said
    bracket = 145.0 - 1.6 * (oil - FREEZING)
    bracket += 350.0 * math.log10(math.log10(max(1e6 * _thickness(params, WARM), 0.5) + 0.8))
    if bracket < laws.LEAST_SEAL and any(getattr(params, f"{s}_seal_diameter") for s in SHAFTS):
        yield (
            f"seals: at {format_quantity(oil, 'K')} their formula falls below {laws.LEAST_SEAL:g}, "
            "its minimum value here; their loss is an estimate"
        )


def _thickness(params: Any, oil: float) -> float:
    """Return the kinematic viscosity [m2/s]."""
    law = params.viscosity_scale, params.viscosity_constant, params.viscosity_exponent
    mu: float = viscosity(oil, *law)[0]
    return mu / float(params.oil_density)
