"""A gear train at one operating point: forces, losses, limits."""

from collections.abc import Iterator, Mapping
from dataclasses import field, make_dataclass
from typing import Any

import numpy as np

from ..errors import SolveError, Status
from ..gearmesh.parameters import SPEC as PAIR
from ..gearmesh.solve import solve_gearmesh
from ..losses.kernels import loss_laws as laws
from ..losses.loss_ranges import (
    DEPTH,
    FAST,
    FROUDE,
    LIGHT_LOAD,
    MIXED,
    OTHER_LAW,
    REYNOLDS,
    viscosity_ratio,
)
from ..model.advice import warnings_of
from ..model.idle import idle_warnings
from ..model.levels import level_named
from ..model.parameters import check_number
from ..model.prepare import filled
from ..model.sensitivity import Differentiable
from ..model.solutions import Asked
from ..numerics.power_flow import BOTH, SELF_LOCKING, power_flow
from ..units import format_quantity
from .kernels import layout as L
from .kernels import step as k
from .parameters import SPEC, TrainParams, pair_of

__all__ = ["TrainParams", "TrainResult", "solve_train"]
LIGHT = 1e-3  # of the load: an axial force that rounding leaves
MORE = 2.0  # times the torque: where both shafts feed in, does it help?
LOCKED = "self-locking: losses grow faster than what drives; no torque of the output turns it"

_REALS = [name for name in SPEC.real_outputs if name != "oil_energy"]  # of a step, not of a point


def _restore(result: Any, state: dict[str, Any]) -> None:
    """Take over a pickled result, also one of an earlier version."""
    if "_asked" in state:
        state = {**state, "_request": state["_asked"]}
    result.__dict__.update(state)


TrainResult: Any = make_dataclass(
    "TrainResult",
    [
        *((name, float | None) for name in _REALS),
        ("flow", str),
        ("status", Status),
        ("fidelity", str),
        ("_request", Asked, field(repr=False, compare=False)),
        ("warnings", tuple[str, ...], field(default=())),
    ],
    bases=(Differentiable,),
    frozen=True,
    namespace={
        "__module__": __name__,
        "__setstate__": _restore,
        "__doc__": """A gear train at one operating point; SI units.

    Fields are the outputs of the FMU; None stands for meshes and shafts that are not there and for
    safeties without a limit, ``efficiency`` is NaN where nothing comes out. ``flow`` says which
    shaft drives, or why there is no efficiency; torques and speeds are positive about one axis.
    """,
    },
)


def solve_train(
    params: Any,
    *,
    torque: float,
    speed: float,
    oil_temperature: float = 353.15,
    fidelity: str = "handbook",
    throw: bool = True,
) -> Any:
    """Return losses, forces and limits of a gear train at one operating point.

    Parameters
    ----------
    params : ``TrainParams``: shafts, bearings, meshes, oil
    torque : on the input shaft [N m], -1e6 .. 1e6; against the speed the output drives
    speed : of the input shaft [rad/s], -5000 .. 5000
    oil_temperature : [K], 233.15 .. 473.15
    fidelity : "handbook"
    throw : False returns the best estimate with its status instead of raising SolveError

    Returns
    -------
    TrainResult; status OUTSIDE_VERIFIED with oil below -20 or above 150 degC, HOT as of a mesh

    Raises
    ------
    ParameterError : an argument is out of range; the message names it
    SolveError : the train locks itself, losses and forces cannot agree

    Notes
    -----
    Source: docs/theory/train.md: statics of rigid shafts; losses of meshes, bearings, churning and
    seals as in their models; ISO 281 for bearings.

    Examples
    --------
    >>> r = solve_train(TrainParams(), torque=150.0, speed=500.0)
    >>> round(r.efficiency, 3), r.flow
    (0.984, 'input to output')
    """
    given = (torque, speed, oil_temperature)
    point = {
        s.name: check_number(s.name, value, s.unit, *s.range)
        for s, value in zip(SPEC.inputs, given, strict=True)
    }
    par = filled(SPEC, params, fidelity, k.NPAR, k.derive)
    out, flags = _stepped(par, [*point.values()])
    status = Status(int(flags[-1]))
    if status.is_failure and throw:
        words = ", ".join(f"{name} = {value:g}" for name, value in point.items())
        locked = status == Status.MAX_ITERATIONS
        raise SolveError(f"{words}: {LOCKED if locked else status.advice}")
    shown = dict(zip(SPEC.real_outputs, out.tolist(), strict=True))
    del shown["oil_energy"]
    shown["efficiency"], flow = flow_of(par, point, shown, status)
    found: dict[str, Any] = shown | dict.fromkeys(SPEC.absent(params) & shown.keys())
    doubts = () if status.is_failure else doubts_of_point(params, point, found)
    return TrainResult(
        **found,
        flow=flow,
        status=status,
        fidelity=level_named(SPEC, fidelity),
        _request=Asked(SPEC.key, params, {**point, "fidelity": fidelity}),
        warnings=(
            *idle_warnings(SPEC.key, params, fidelity),
            *warnings_of(SPEC, status, point, shown, doubts),
        ),
    )


def _stepped(par: Any, inputs: list[float]) -> tuple[Any, Any]:
    out, flags = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)
    k.step(par, np.array(inputs), np.zeros(k.NSTATE), np.zeros(k.NWORK), out, flags, 0.0, 0.0)
    return out, flags


def flow_of(
    par: Any, point: Mapping[str, float], shown: Mapping[str, float], status: Status
) -> tuple[float, str]:
    """Return efficiency and a word of ``power_flow.FLOWS``.

    A train locks itself where nothing settles (the output drives), or where more torque at the
    input leaves less at the output.
    """
    if status == Status.MAX_ITERATIONS:
        return float("nan"), SELF_LOCKING
    power = point["torque"] * point["speed"]
    left = shown["output_torque"] * shown["output_speed"]
    efficiency, flow = power_flow(power, left)
    if flow == BOTH and power > 0.0:
        out, flags = _stepped(par, [MORE * point["torque"], *[*point.values()][1:]])
        again = float(out[L.O_OUTPUT_TORQUE] * out[L.O_OUTPUT_SPEED])
        if flags[-1] >= 10 or again < left:
            return float("nan"), SELF_LOCKING
    return efficiency, flow


def doubts_of_point(
    params: Any, point: Mapping[str, float], shown: Mapping[str, Any] | None = None
) -> Iterator[str]:
    """Yield what must not be missed at a point: limits passed, laws outside their ranges.

    ``shown``: the outputs there, solved if not given.
    """
    if shown is None:
        given: dict[str, Any] = {**point}
        found = solve_train(params, **given, throw=False)
        shown = {name: getattr(found, name) for name in _REALS}
    yield from _of_meshes(params, point, shown)
    yield from _of_bearings(params, point, shown)


def _of_meshes(params: Any, point: Mapping[str, float], shown: Mapping[str, Any]) -> Iterator[str]:
    speed, forward = point["speed"], point["torque"] * point["speed"] >= 0.0
    for i in range(int(params.meshes)):
        pair, words = pair_of(params, i), f"mesh {i + 1}: "
        drives = getattr(params, f"mesh_{i + 1}_driver") == "pinion"
        pinion = speed if drives else -speed * pair.gear_ratio
        radius = _pitch_radius(pair)
        power = shown[f"mesh_{i + 1}_tangential_force"] * radius * abs(pinion)
        if abs(pinion) > params.speed_smoothing:
            own = solve_gearmesh(
                pair,
                power=min(power, 1e9) * (1.0 if drives == forward else -1.0),
                speed=max(min(pinion, 5e3), -5e3),
                oil_temperature=point["oil_temperature"],
                throw=False,
            )
            told = idle_warnings(PAIR.key, pair, own.fidelity)  # of the train's parameters
            yield from (
                words + text
                for text in own.warnings
                if "oil_temperature" not in text and text not in told
            )
            yield from _of_churning(params, i, abs(pinion), radius, point["oil_temperature"])
        speed = -speed / pair.gear_ratio if drives else pinion


def _pitch_radius(pair: Any) -> float:
    from ..gearmesh.kernels.working_pair import working_section
    from ..gearmesh.parameter_array import as_array

    return float(working_section(as_array(pair))[1]) / (float(pair.gear_ratio) + 1.0)


def _of_churning(params: Any, i: int, pinion: float, radius: float, oil: float) -> Iterator[str]:
    pair, nu = pair_of(params, i), _thickness(params, oil)
    for gear, ratio in (("pinion", 1.0), ("gear", float(pair.gear_ratio))):
        depth = getattr(params, f"mesh_{i + 1}_{gear}_immersion")
        w, r = pinion / ratio, radius * ratio
        froude = w * w * r / laws.GRAVITY
        if depth == 0.0 or froude < laws.LEAST_FR:
            continue
        reynolds = w * r * pair.face_width / nu
        where = f"mesh {i + 1}, {gear}: "
        numbers = ((FROUDE, froude), (REYNOLDS, float(reynolds)), (DEPTH, depth))
        yield from (line for law, value in numbers if (line := law.line(value, where)))


def _of_bearings(
    params: Any, point: Mapping[str, float], shown: Mapping[str, Any]
) -> Iterator[str]:
    speed, nu = abs(point["speed"]), _thickness(params, point["oil_temperature"])
    light, mixed = list[tuple[float, str]](), list[tuple[float, str]]()
    for i in range(1, int(params.meshes) + 2):
        for end in (1, 2):
            name, words = f"shaft_{i}_bearing_{end}", f"shaft {i}, bearing {end}: "
            load, capacity = shown[f"{name}_load"], getattr(params, f"{name}_capacity")
            axial = abs(shown[f"{name}_axial_force"])
            if axial > LIGHT * load and not getattr(params, f"{name}_y_factor"):
                yield (
                    f"{words}takes an axial force of {format_quantity(axial, 'N')} that P "
                    "does not count (y_factor = 0): let the other one take it, or give its Y"
                )
            if load > 0.5 * capacity:
                yield (
                    f"{words}P = {format_quantity(load, 'N')} is above C/2 = "
                    f"{format_quantity(0.5 * capacity, 'N')}, the range of ISO 281's rating life"
                )
            if shown[f"{name}_life"] < params.required_life:
                yield (
                    f"{words}life = {hours(shown[f'{name}_life'])}, below required_life = "
                    f"{hours(params.required_life)}"
                )
            fast = speed * 30.0 / np.pi * 1e3 * getattr(params, f"{name}_diameter")
            if line := FAST.line(fast, words):
                yield line
            if params.bearing_law == "palmgren" and speed > params.speed_smoothing:
                diameter = getattr(params, f"{name}_diameter")
                light.append((load / capacity, words))
                mixed.append((viscosity_ratio(speed, nu, diameter), words))
        if i <= int(params.meshes):
            speed /= _slower(params, i)
    for law, found in ((LIGHT_LOAD, light), (MIXED, mixed)):  # of all bearings the worst
        if found and (line := law.line(*min(found))):
            yield line + OTHER_LAW


def _thickness(params: Any, oil: float) -> float:
    """Return the kinematic viscosity [m2/s]."""
    mu = params.viscosity_scale * np.exp(params.viscosity_b / (oil - 273.15 + params.viscosity_c))
    return float(mu / params.oil_density)


def _slower(params: Any, mesh: int) -> float:
    ratio = float(getattr(params, f"mesh_{mesh}_gear_ratio"))
    return ratio if getattr(params, f"mesh_{mesh}_driver") == "pinion" else 1.0 / ratio


def hours(life: float) -> str:
    """Return a life [s] in words."""
    return format_quantity(life, "s") if life >= 3.6e3 else f"{life / 3600.0:.4g} h"
