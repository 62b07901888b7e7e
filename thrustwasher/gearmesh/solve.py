"""Gear mesh: loss, heat, temperatures, contact and thermal stress, safety factors."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ..errors import ParameterError, SolveError, Status
from ..model.advice import warnings_of
from ..model.idle import idle_warnings
from ..model.levels import level_named
from ..model.parameters import check_number
from ..model.prepare import Recent, filled
from ..model.record import Sweep
from ..model.sensitivity import Differentiable
from ..model.solutions import Asked
from .choices import STEELS
from .kernels import layout as k
from .kernels.constants import LIMITS, derive
from .kernels.load_sharing import shared
from .kernels.operating_point import solve_point
from .kernels.working_pair import gear_shift, tips
from .law_ranges import SHORT
from .parameters import (
    LOAD,
    OIL,
    SPEC,
    SPEED,
    GearMeshParams,
    absent_outputs,
    default_of,
)
from .plausibility import doubts_of_parameters, doubts_of_point

SAFETIES = {
    "pitting_safety": "the flanks are expected to pit; lower the torque or choose a wider or "
    "harder gear",
    "scuffing_safety": "the flanks are expected to scuff; lower torque, speed or oil temperature",
    "root_safety": "the teeth are expected to break at the root; lower the torque or choose a "
    "wider gear or a larger module",
    "micropitting_safety": "the film is thinner than permissible_film_ratio allows, the flanks are "
    "expected to micropit; take cooler or thicker oil or smoother flanks",
}
SWEEP = Sweep(
    not_shown=("oil_energy",),  # of a step, not of a point
    least={name: (1.0, f"below 1: {fails}") for name, fails in SAFETIES.items()},
)
__all__ = ["GearMeshParams", "GearMeshResult", "solve_gearmesh"]


@dataclass(frozen=True, slots=True)
class GearMeshResult(Differentiable):
    """A pair of gears at one operating point, seen where its flanks are hottest; SI units.

    With ``film_heat`` "atan" that is where contact starts, but for the fidelity "fine". None stands
    where there is no such number: ``micropitting_safety`` without a ``permissible_film_ratio``,
    ``root_safety`` without a ``root_limit``, endurance under thermal
    stress without the paper's heat and one of its steels.
    """

    friction_torque: float
    """[N m] mean loss of the whole mesh as a torque on the pinion, sign of the speed; 0 at rest."""
    friction_power: float  # [W] heat made by the mesh
    friction_coefficient: float
    """[-] there, of the loss; ``mean_friction`` is what the loss feels along the path."""
    contact_stress: float
    """[Pa] maximum along the path; "atan": sigma_m of Eq 9 with its rounded factor 0.591."""
    hertz_pressure: float  # [Pa] peak of the contact there, 4/pi of its mean
    hertz_width: float  # [m] full width of the contact
    film_thickness: float
    film_ratio: float
    viscosity: float  # [Pa s] of the oil in the film
    surface_temperature: float
    """[K] of the pinion's flank; with ``film_heat`` "loss" it is bulk_temperature + flash_max."""
    film_temperature: float  # [K] highest in the oil film
    asperity_temperature: float  # [K] of the pinion's asperities, of the steel chosen
    flash_rise: float
    """[K] rise by friction there if the whole nominal area carried (no film switch)."""
    area_ratio: float
    """[-] nominal over real contact area that the asperity temperature is taken with."""
    thermal_stress: float  # [Pa] of the steel chosen, from its asperity temperature
    modification_factor: float | None  # [-] K of Atan Eq 12, of the steel chosen
    allowable_ratio: float | None
    """[-] 1/sqrt(1 + K): share of the contact stress that thermal stress leaves allowable."""
    modification_factor_aisi1020: float | None
    modification_factor_aisi4340: float | None
    allowable_ratio_aisi1020: float | None
    allowable_ratio_aisi4340: float | None
    stress_utilization_aisi1020: float | None
    """[-] combined stress over endurance limit (root of the right side of Atan Eq 10)."""
    stress_utilization_aisi4340: float | None
    mean_friction: float  # [-] that the loss feels
    flash_max: float  # [K] maximum flash temperature along the path
    bulk_temperature: float  # [K] of the gears' bodies, steady
    oil_heat: float  # [W] that reaches the oil
    stored_heat: float  # [J] 0: the bodies are steady
    contact_pressure_max: float
    """[Pa] maximum Hertz pressure along the path, load factor included; "atan": without it, where
    contact starts."""
    pitting_stress: float  # [Pa] sigma_H of the pitting calculation
    pitting_safety: float
    scuffing_safety: float
    """[-] scuffing temperature over that of the contact, both above the oil's; the latter counts at
    minimum 1 K, which bounds it."""
    scuffing_margin: float  # [K] scuffing temperature less that of the contact
    film_ratio_gf: float
    """[-] minimum film along the path over the mean Ra, of the micropitting standard; "atan": at
    its start, of Dowson and Higginson."""
    micropitting_at: str
    """Where along the path that film is: "A" start of contact, "E" end, else base pitches from the
    pitch point."""
    micropitting_safety: float | None
    root_stress: float  # [Pa] at the root of the teeth, of the gear with more of it
    root_safety: float | None  # [-] twice root_limit over it, the smaller of both gears
    scuffing_friction: float  # [-] that the flash temperature feels
    normal_module: float  # [m] of the teeth, as given or by centre distance and teeth
    centre_distance: float  # [m] of the axes as they work
    pinion_diameter: float  # [m] of the pitch circle
    gear_diameter: float  # [m] of the pitch circle
    pinion_tip_diameter: float  # [m]
    gear_tip_diameter: float  # [m] of a ring: the inner one
    profile_shift_gear: float  # [-] as given, or by the distance of the axes
    working_pressure_angle: float  # [rad] in the transverse section
    loss_factor: float
    """[-] H_v, load share times sliding over the path of contact: with a constant friction the
    friction_power is that friction times H_v times the power."""
    limits: str
    """What pitting_safety and scuffing_safety rest on; "assumed" if it is a default."""
    start_of_contact: float
    """[-] x_s along the line of action, from the pinion's base tangent point."""
    contact_ratio: float
    overlap_ratio: float  # [-] share of the load that bears evenly, if below 1
    sliding_speed: float  # [m/s] of the flanks there
    slide_roll_ratio: float  # [-] sliding speed over the mean of both rolling speeds
    regime: str
    status: Status
    iterations: int
    fidelity: str
    _request: Asked = field(repr=False, compare=False)
    warnings: tuple[str, ...] = ()
    """What a reader must not miss, a line each."""


def prepare(params: GearMeshParams, fidelity: str) -> Any:
    """Return the parameter array of the kernel, constants included."""
    return filled(SPEC, params, fidelity, k.NPAR, derive)


def pinion_torque(power: float, speed: float) -> float:
    """Return the pinion's torque [N m], or refuse one without bound."""
    if power == 0.0:
        return 0.0
    largest = LOAD.high or 0.0
    if abs(power) > largest * abs(speed):
        raise ParameterError(
            f"speed = {speed!r} rad/s, allowed: from {abs(power) / largest:g} rad/s on for power = "
            f"{power:g} W (the pinion's torque power/speed is at most {largest:g} N.m)"
        )
    return power / speed


def under_torque(point: dict[str, float]) -> dict[str, float]:
    """Return the inputs of a gear mesh: the power as a torque of the pinion."""
    power, rest = point["power"], {n: v for n, v in point.items() if n != "power"}
    return {**rest, "load": pinion_torque(power, point["speed"])}


def at_power(inputs: dict[str, float]) -> dict[str, float]:
    """Return the point of a gear mesh with these inputs: the pinion's torque as a power."""
    rest = {n: v for n, v in inputs.items() if n != "load"}
    return {"power": inputs["load"] * inputs["speed"], **rest}


def solve_gearmesh(
    params: GearMeshParams,
    *,
    power: float,
    speed: float,
    oil_temperature: float = 299.85,
    fidelity: str = "field",
    start: GearMeshResult | None = None,
    throw: bool = True,
) -> GearMeshResult:
    """Return temperatures, stresses and loss of a gear mesh at one operating point.

    Parameters
    ----------
    params : the pair, its surfaces, oil, steel and laws
    power : at the pinion [W], -1e9 .. 1e9; below 0 the gear drives, which counts for the
        friction_law "efficiency" alone
    speed : of the pinion [rad/s], -5000 .. 5000; the loss torque takes its sign. 0 is allowed
        without power only: the torque power/speed would have no bound (1e7 N m is the largest)
    oil_temperature : of the oil [K], 233.15 .. 473.15; the gears' bodies are as warm as they get
    fidelity : "field"; "fine": twice as many positions, the paper's heat at every one of them
    start : an earlier result; taken for the sake of one call for all models, not needed: there is
        one solution and it is found from any point
    throw : False returns the best estimate with its status instead of raising SolveError

    Returns
    -------
    GearMeshResult; status HOT if the film is above 523 K, OUTSIDE_VERIFIED where a law is
    stretched (oil below -20 or above 150 degC, asperities above 1000 K, pressure above hardness)

    Raises
    ------
    ParameterError : an argument is out of range; the message names it
    SolveError : the flank's temperature was not found (no case is known)

    Notes
    -----
    Source: docs/theory/gear-mesh.md: ISO 6336-2, -20, -22 as publicly quoted, mesh loss after
    Ohlendorf, Blok's flash temperature; ``film_heat`` "atan": Atan (2005), corrected.

    Examples
    --------
    >>> r = solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0)
    >>> round(r.start_of_contact, 5), round(r.mean_friction, 4), round(r.friction_power, 1)
    (0.08683, 0.0192, 23.9)
    """
    power = check_number("power", power, "W", -1e9, 1e9)
    speed = check_number("speed", speed, "rad/s", SPEED.low or 0.0, SPEED.high or 0.0)
    oil = check_number("oil_temperature", oil_temperature, "K", OIL.low or 0.0, OIL.high or 0.0)
    ready, work = _ready(params, fidelity), np.zeros(k.NWORK)
    torque = abs(pinion_torque(power, speed))
    drive, state = torque * abs(speed), np.zeros(k.NSTATE)
    work[k.W_WAY] = math.copysign(1.0, power)
    par = shared(ready.par, torque, work)
    status = Status(solve_point(par, torque, speed, oil, drive, state, 0.0, work))
    if not np.isfinite(work[: k.N_FIELD]).all():
        status = Status.NOT_FINITE
    if status.is_failure and throw:
        raise SolveError(
            f"power = {power:g} W, speed = {speed:g} rad/s, oil_temperature = {oil:g} K: "
            f"{status.advice}"
        )
    row: list[float] = work[: k.N_FIELD].tolist()
    point = {"power": power, "speed": speed, "oil_temperature": oil, "fidelity": fidelity}
    request = Asked(SPEC.key, params, point)

    def fill() -> dict[str, Any]:
        return _fields(ready, par, row, torque, status, request)

    def say() -> tuple[str, ...]:
        return _warnings(ready, par, row, torque, status, request)

    if par is ready.par:
        return GearMeshResult.later(fill, say, status)
    return GearMeshResult(**fill(), warnings=say())  # or each would keep its ``work``


class _Ready:
    """A mesh at a level, ready to be solved again."""

    def __init__(self, params: GearMeshParams, fidelity: str) -> None:
        self.params, self.fidelity, self.level = params, fidelity, level_named(SPEC, fidelity)
        self.par = prepare(params, fidelity)

    @cached_property
    def known(self) -> dict[str, Any]:
        """The fields that are the same at every point, of rigid pairs their sizes too."""
        absent = dict.fromkeys(absent_outputs(self.params))
        own = {"fidelity": self.level, "limits": _limits_assumed(self.params)}
        return {**absent, **own, **_size(self.params, self.par)}

    @cached_property
    def doubts(self) -> list[str]:
        """What is to be said at every point."""
        idle = idle_warnings(SPEC.key, self.params, self.fidelity)
        return [*idle, *doubts_of_parameters(self.params)]


_ready = Recent(_Ready)


def _fields(
    ready: _Ready, par: Any, row: list[float], torque: float, status: Status, request: Asked
) -> dict[str, Any]:
    """Return the fields of a result but its warnings; ``row``: the kernel's field."""
    size = {} if par is ready.par else _size(request.params, par)
    known = {**ready.known, **size, "status": status, "_request": request}
    return _result(par, row, torque, request.point["speed"], known)


def _warnings(
    ready: _Ready, par: Any, row: list[float], torque: float, status: Status, request: Asked
) -> tuple[str, ...]:
    """Return the warnings of a result."""
    _, params, point = request
    speed, oil = point["speed"], point["oil_temperature"]
    doubts = [*ready.doubts, *doubts_of_point(params, par, row, torque, speed, oil)]
    short = [line for line in doubts if SHORT in line]  # that the status is about
    doubts = [line for line in doubts if line not in short]
    messages = warnings_of(SPEC, status, {"oil_temperature": oil}, _shown(row), short)
    return (*messages, *_failures({**_shown(row), **ready.known}, par, row), *doubts)


def _limits_assumed(params: GearMeshParams) -> str:
    """Return in words what the safeties rest on, and what of it nobody gave."""
    limit = params.contact_limit or LIMITS[list(STEELS).index(params.steel)]
    pitting = "" if params.contact_limit else f" (assumed, {params.steel})"
    scuffing = "" if params.fzg_stage != default_of("fzg_stage") else " (assumed)"
    return f"contact limit {1e-6 * limit:g} MPa{pitting}, FZG stage {params.fzg_stage}{scuffing}"


def _size(p: GearMeshParams, par: Any) -> dict[str, float]:
    """Return the lengths of the pair that module, centre distance and profile shifts make."""
    centre, side = float(par[k.D_CENTRE]), float(par[k.D_SIDE])
    pinion = 2.0 * centre / (p.gear_ratio + side)
    tip, gear_tip, module = tips(par)
    return {
        "normal_module": float(module),
        "pinion_tip_diameter": 2.0 * float(tip),
        "gear_tip_diameter": 2.0 * float(gear_tip),
        "profile_shift_gear": float(gear_shift(par)),
        "working_pressure_angle": float(par[k.D_ANGLE]),
        "loss_factor": float(par[k.D_LOSS]),
        "centre_distance": centre,
        "pinion_diameter": pinion,
        "gear_diameter": pinion * p.gear_ratio,
    }


def _shown(f: list[float]) -> dict[str, Any]:
    """Return the model's outputs by name: they come first in the kernel's field."""
    return dict(zip(SPEC.real_outputs, f, strict=False))


def _result(
    par: Any, f: list[float], torque: float, speed: float, more: dict[str, Any]
) -> dict[str, Any]:
    """Return the fields of a result; ``more`` are those that are known already."""
    loss = f[k.F_MEAN_FRICTION] * float(par[k.D_LOSS]) * torque
    ratio = f[k.F_RATIO]
    shown = _shown(f)
    shown["friction_torque"] = math.copysign(loss, speed) if speed else 0.0
    shown["friction_power"] = loss * abs(speed)
    asperity = shown.pop("temperature")
    del shown["oil_energy"]  # of a step, not of a point
    return dict(
        **(shown | more),
        asperity_temperature=asperity,
        micropitting_at=_place_of_thinnest(par, f),
        hertz_pressure=4.0 / math.pi * f[k.F_PRESSURE],
        hertz_width=f[k.F_WIDTH],
        viscosity=f[k.F_VISCOSITY],
        area_ratio=f[k.F_AREA],
        sliding_speed=f[k.F_SLIDING],
        start_of_contact=float(par[k.D_START]),
        contact_ratio=float(par[k.D_CONTACT_RATIO]),
        overlap_ratio=float(par[k.D_OVERLAP]),
        slide_roll_ratio=float(par[k.D_SLIDE_ROLL]),
        regime="film" if ratio > 3.0 else "mixed" if ratio >= 1.0 else "boundary",
        iterations=int(f[k.F_ITERATIONS]),
    )


def _place_of_thinnest(par: Any, f: list[float]) -> str:
    """Return in words where along the path the film against micropitting is thinnest."""
    if f[k.F_GF_PLACE] < 0.0:
        return "A"
    found = float(par[k.D_POSITION + int(f[k.F_GF_PLACE])])
    for name, end in (("A", -par[k.D_APPROACH]), ("E", par[k.D_RECESS])):
        if abs(found - end) < 1e-9:
            return name
    return f"{found:.4g}"


def _failures(shown: Mapping[str, Any], par: Any, f: list[float]) -> Iterator[str]:
    """Yield a line for each safety below 1."""
    for name, fails in SAFETIES.items():
        safety = shown[name]
        if safety is not None and safety < 1.0:
            at = f" at {_place_of_thinnest(par, f)}" if name.startswith("micropitting") else ""
            yield f"{name} = {safety:.3g}{at}, below 1: {fails}"
