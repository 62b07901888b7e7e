"""Losses of bearings, dipping gears, oil pump and shaft seals at one operating point."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import SolveError, Status
from ..model.advice import warnings_of
from ..model.idle import idle_warnings
from ..model.parameters import check_number
from ..model.prepare import filled
from ..model.rungs import rung_named
from ..model.sensitivity import Differentiable
from ..model.solutions import Asked
from ..model.spec import CHURNING_REGIMES
from .kernels import step as k
from .parameters import SHAFTS, SPEC, LossesParams
from .ranges import doubts_of_point

__all__ = ["LossesParams", "LossesResult", "solve_losses"]


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
    _asked: Asked = field(repr=False, compare=False)
    warnings: tuple[str, ...] = ()
    """What a reader must not miss, a line each."""


def solve_losses(
    params: Any,
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
    """Return the losses of a planetary gearbox that are there beside those of its teeth.

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
        fidelity=rung_named(SPEC, fidelity),
        _asked=Asked(SPEC.key, params, {**point, "fidelity": fidelity}),
        warnings=(
            *idle_warnings(SPEC.key, params, fidelity),
            *warnings_of(SPEC, status, point, shown, doubts_of_point(params, point)),
        ),
    )
