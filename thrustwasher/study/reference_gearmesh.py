"""Reference values of the gear mesh: the line of action by adaptive quadrature and search."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..errors import SolveError
from ..gearmesh.kernels import layout as k
from ..gearmesh.kernels.line_of_action import N_NODES, place_mesh
from ..gearmesh.kernels.mesh_point import mesh_point
from ..gearmesh.parameters import GearMeshParams
from ..gearmesh.solve import pinion_torque, prepare, solve_gearmesh
from ..ladder.card_parts import QUANTITIES
from .reference_values import OK, Answer, Point, ReferencePoint, ReferenceValues, Source, Values

TOLERANCE = 1e-12
SEARCHED = 200  # positions on each stretch from which the hottest is searched
ROUNDING = 1e-12  # relative, of values that nothing but rounding moves


def reference_gearmesh(
    params: GearMeshParams, *, power: float, speed: float, oil_temperature: float = 299.85
) -> ReferenceValues:
    """Return loss, temperatures and film of a mesh, resolved along the line of action.

    The same closed forms at every position as in the rung `fine`; they were derived a second time
    and agree to 1e-9 (docs/accuracy.md). The loss is integrated adaptively, the hottest position is
    searched on each stretch between changes of the load.

    Parameters
    ----------
    params, power [W], speed [rad/s], oil_temperature [K] : as in solve_gearmesh

    Raises
    ------
    ParameterError : an argument is outside its range
    SolveError : the flank's temperature was not found
    """
    from scipy.integrate import quad

    fine = solve_gearmesh(params, power=power, speed=speed, oil_temperature=oil_temperature,
                          fidelity="fine")  # fmt: skip
    torque = pinion_torque(power, speed)
    par = prepare(params, "fine")
    total, missed, weight, hottest = 0.0, 0.0, 0.0, np.zeros(k.N_FIELD)
    for first in range(0, int(par[k.D_PLACES]), N_NODES):
        low, high = (float(par[k.D_POSITION + first + i]) for i in (0, N_NODES - 1))
        share = float(par[k.D_PATH_LOSS + first : k.D_PATH_LOSS + first + N_NODES].sum())
        at = _positions(par, first, torque, speed, oil_temperature)
        moment = 0.5 * abs(high * abs(high) - low * abs(low))
        value, error = quad(lambda s, at=at: float(at(s)[k.F_FRICTION]) * abs(s), low, high,
                            epsabs=0.0, epsrel=TOLERANCE, limit=200)  # fmt: skip
        total += share * value / moment
        missed += share * error / moment
        weight += share
        field = _hottest(at, low, high)
        if field[k.F_ASPERITY] > hottest[k.F_ASPERITY]:
            hottest = field
    friction = total / weight
    loss = float(par[k.D_LOSS]) * torque * friction * float(np.sign(speed))
    values = {
        "friction_torque": loss, "friction_coefficient": friction,
        "temperature": float(hottest[k.F_ASPERITY]), "film_ratio": float(hottest[k.F_RATIO]),
        "film_thickness": float(hottest[k.F_FILM]), "flash_rise": float(hottest[k.F_FLASH]),
        "surface_temperature": float(hottest[k.F_SURFACE]),
        "film_temperature": float(hottest[k.F_FILM_TEMPERATURE]),
    }  # fmt: skip
    uncertainty = {name: ROUNDING * abs(value) for name, value in values.items()}
    uncertainty["friction_torque"] += abs(loss) * missed / max(friction, 1e-300)
    uncertainty["friction_coefficient"] += missed
    if not all(np.isfinite(list(values.values()))):
        raise SolveError(f"reference_gearmesh: {fine.status.advice}; tried: {SEARCHED} positions")
    return ReferenceValues(
        values, uncertainty, ("adaptive quadrature at 1e-12", "search for the hottest position")
    )


def _positions(
    par: Any, first: int, torque: float, speed: float, oil: float
) -> Callable[[float], Any]:
    """Return a function of the position: all numbers of the mesh there."""
    one, local, field = par.copy(), np.zeros(k.D_POSITION), np.zeros(k.N_FIELD)

    def at(s: float) -> Any:
        one[k.D_POSITION + first] = s
        place_mesh(one, first, local)
        mesh_point(local, torque, speed, oil, field)
        return field

    return at


def _hottest(at: Callable[[float], Any], low: float, high: float) -> Any:
    """Return the numbers at the hottest position of a stretch."""
    from scipy.optimize import minimize_scalar

    grid = np.linspace(low, high, SEARCHED)
    heat = [float(at(s)[k.F_ASPERITY]) for s in grid]
    best = int(np.argmax(heat))
    if 0 < best < SEARCHED - 1:
        found = minimize_scalar(lambda s: -float(at(s)[k.F_ASPERITY]), method="bounded",
                                bounds=(grid[best - 1], grid[best + 1]),
                                options={"xatol": 1e-12})  # fmt: skip
        if -found.fun >= heat[best]:
            return at(float(found.x)).copy()
    return at(float(grid[best])).copy()


def _at_points(params: Any, point: Point) -> list[ReferencePoint]:
    """Return the reference's answer at a held-out point; none where there is none."""
    try:
        return [ReferencePoint(point, None, None, *_reference(params, **point).of(QUANTITIES))]
    except SolveError:
        return []


def _at_case(point: tuple[float, ...], _before: object = ()) -> ReferenceValues:
    """Return the reference's answer at a case of the charts."""
    return _reference(GearMeshParams(), *point)


def _reference(
    params: GearMeshParams, load: float, speed: float, oil_temperature: float
) -> ReferenceValues:
    return reference_gearmesh(
        params, power=load * speed, speed=speed, oil_temperature=oil_temperature
    )


def _answer(params: Any, fidelity: str, known: ReferencePoint) -> Answer:
    p = known.point
    g = solve_gearmesh(
        params, power=p["load"] * p["speed"], speed=p["speed"],
        oil_temperature=p["oil_temperature"], fidelity=fidelity,
    )  # fmt: skip
    values: Values = {
        "friction_torque": g.friction_torque, "temperature": g.asperity_temperature,
        "film_thickness": g.film_thickness, "film_ratio": g.film_ratio,
    }  # fmt: skip
    return Answer(values, OK, float(g.iterations))


SOURCE = Source(
    _at_points, _answer, _at_case,
    tuple(f"thrustwasher.gearmesh.kernels.{name}" for name in ("line_of_action", "constants")),
    None,
    ("adaptive quadrature over the line of action", "search for the hottest position"),
)  # fmt: skip
