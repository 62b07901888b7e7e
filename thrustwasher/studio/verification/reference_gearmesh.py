"""Reference values of the gear mesh: the line of action by adaptive quadrature and search."""

import math
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np

from ...errors import SolveError
from ...gearmesh.kernels import layout as k
from ...gearmesh.kernels.line_of_action import place_mesh
from ...gearmesh.kernels.mesh_point import mesh_point
from ...gearmesh.kernels.operating_point import solve_point
from ...gearmesh.kernels.path_of_contact import N_NODES, NODES, WEIGHTS, derive_path
from ...gearmesh.parameters import GearMeshParams
from ...gearmesh.solve import pinion_torque, prepare, solve_gearmesh
from ...ladder.error_table import QUANTITIES
from .reference_values import OK, Answer, Point, ReferencePoint, ReferenceValues, Source, Values

TOLERANCE = 1e-12
SEARCHED = 200  # positions on each interval from which the hottest is searched
METHODS = ("adaptive quadrature", "search for the hottest position")
OF_HOTTEST = (
    *("temperature", "film_ratio", "film_thickness"),
    *("flash_rise", "surface_temperature", "film_temperature"),
)
SHOWN = {
    "friction_coefficient": k.F_FRICTION,
    "mean_friction": k.F_MEAN_FRICTION,
    "temperature": k.F_ASPERITY,
    "film_ratio": k.F_RATIO,
    "film_thickness": k.F_FILM,
    "flash_rise": k.F_FLASH,
    "surface_temperature": k.F_SURFACE,
    "bulk_temperature": k.F_BULK,
    "film_temperature": k.F_FILM_TEMPERATURE,
}
ROUNDING = 1e-12  # relative, of values that nothing but rounding moves


def reference_gearmesh(
    params: GearMeshParams, *, power: float, speed: float, oil_temperature: float = 299.85
) -> ReferenceValues:
    """Return loss, temperatures and film of a mesh, resolved along the line of action.

    The same closed forms at every position as in the level `fine`; they were derived a second time
    and agree to 1e-9 (docs/accuracy.md). The loss is integrated adaptively, the hottest position is
    searched on each interval between changes of the load.

    Parameters
    ----------
    params, power [W], speed [rad/s], oil_temperature [K] : as in solve_gearmesh

    Raises
    ------
    ParameterError : an argument is outside its range
    SolveError : the flank's temperature was not found
    """
    from scipy.integrate import quad

    fine = solve_gearmesh(
        params, power=power, speed=speed, oil_temperature=oil_temperature, fidelity="fine"
    )
    torque = abs(pinion_torque(power, speed))
    if params.film_heat == "loss":
        return _of_loss(params, torque, speed, oil_temperature)
    par = prepare(params, "fine")
    total, missed, weight, hottest = 0.0, 0.0, 0.0, np.zeros(k.N_FIELD)
    for first in range(0, int(par[k.D_PLACES]), N_NODES):
        low, high = (float(par[k.D_POSITION + first + i]) for i in (0, N_NODES - 1))
        share = float(par[k.D_PATH_LOSS + first : k.D_PATH_LOSS + first + N_NODES].sum())
        at = _positions(par, first, torque, speed, oil_temperature)
        moment = 0.5 * abs(high * abs(high) - low * abs(low))
        value, error = quad(
            lambda s, at=at: float(at(s)[k.F_FRICTION]) * abs(s),
            low,
            high,
            epsabs=0.0,
            epsrel=TOLERANCE,
            limit=200,
        )
        total += share * value / moment
        missed += share * error / moment
        weight += share
        field = _hottest(at, low, high)
        if field[k.F_ASPERITY] > hottest[k.F_ASPERITY]:
            hottest = field
    friction = total / weight
    loss = float(par[k.D_LOSS]) * torque * friction * float(np.sign(speed))
    values = {
        "friction_torque": loss,
        "friction_coefficient": friction,
        **{name: float(hottest[SHOWN[name]]) for name in OF_HOTTEST},
    }
    uncertainty = {name: ROUNDING * abs(value) for name, value in values.items()}
    uncertainty["friction_torque"] += abs(loss) * missed / max(friction, 1e-300)
    uncertainty["friction_coefficient"] += missed
    if not all(np.isfinite(list(values.values()))):
        raise SolveError(f"reference_gearmesh: {fine.status.advice}; tried: {SEARCHED} positions")
    return ReferenceValues(values, uncertainty, METHODS)


def _of_loss(params: GearMeshParams, torque: float, speed: float, oil: float) -> ReferenceValues:
    """Return the values of a mesh that its loss heats, on as many positions as there is room for.

    The uncertainty is what half as many, at least the level's `fine`, differ by. Flash and loss of
    a mesh whose friction is the same along the path are closed forms on any number of positions.
    """
    found: list[dict[str, float]] = []
    for most in (k.N_PATH // 2, k.N_PATH):
        par, work = prepare(params, "field"), np.zeros(k.NWORK)
        subdivide(par, most)
        solve_point(par, torque, speed, oil, torque * abs(speed), np.zeros(k.NSTATE), 0.0, work)
        loss = loss_factor(par) * torque * float(np.sign(speed)) * float(work[k.F_MEAN_FRICTION])
        found.append({"friction_torque": loss, **{n: float(work[i]) for n, i in SHOWN.items()}})
    coarse, best = found
    if not all(np.isfinite(list(best.values()))):
        raise SolveError("reference_gearmesh: the outputs are not finite")
    off = {n: abs(v - coarse[n]) + ROUNDING * abs(v) for n, v in best.items()}
    return ReferenceValues(best, off, ("Lobatto's rule on ever shorter intervals",))


def share_at(par: Any, position: float) -> float:
    """Return the load share X of a pair [-] from the pairs in contact, counted."""
    approach, recess = float(par[k.D_APPROACH]), float(par[k.D_RECESS])
    first, last = math.ceil(-approach - position), math.floor(recess - position)
    even, contact = min(float(par[k.D_OVERLAP]), 1.0), float(par[k.D_CONTACT_RATIO])
    return (1.0 - even) / (last - first + 1) + even / contact


def loss_factor(par: Any) -> float:
    """Return H_v [-] as the sum of share x sliding over the intervals, on each a closed form."""
    total = 0.0
    for first in range(0, int(par[k.D_PLACES]), N_NODES):
        low, high = (float(par[k.D_POSITION + first + i]) for i in (0, N_NODES - 1))
        moment = 0.5 * abs(high * abs(high) - low * abs(low))
        total += share_at(par, 0.5 * (low + high)) * moment
    ratio, teeth = float(par[k.P_GEAR_RATIO]), float(par[k.P_PINION_TEETH])
    both = (ratio + float(par[k.D_SIDE])) / (ratio * teeth)
    return float(2.0 * math.pi * both / par[k.D_COS_BASE] * total)


def subdivide(par: Any, most: int) -> None:
    """Cut the intervals of the line of action into equal parts, ``most`` positions in all."""
    pieces = int(par[k.D_PLACES]) // N_NODES
    parts = most // N_NODES // pieces
    old = par[k.D_POSITION : k.D_POSITION + k.N_PATH].copy()
    for n in range(pieces * parts):
        low, high = (float(old[n // parts * N_NODES + i]) for i in (0, N_NODES - 1))
        share = share_at(par, 0.5 * (low + high))
        for i in range(N_NODES):
            at, length = n * N_NODES + i, (high - low) / parts
            s = low + length * (n % parts + NODES[i])
            par[k.D_POSITION + at], par[k.D_PATH_SHARE + at] = s, share
            par[k.D_PATH_LENGTH + at] = length * WEIGHTS[i]
            par[k.D_PATH_LOSS + at] = length * WEIGHTS[i] * abs(s) * share
    par[k.D_PLACES] = float(pieces * parts * N_NODES)
    loss = par[k.D_PATH_LOSS : k.D_PATH_LOSS + int(par[k.D_PLACES])]
    loss /= loss.sum()
    derive_path(par)


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
    """Return the numbers at the hottest position of an interval."""
    from scipy.optimize import minimize_scalar

    grid = np.linspace(low, high, SEARCHED)
    heat = [float(at(s)[k.F_ASPERITY]) for s in grid]
    best = int(np.argmax(heat))
    if 0 < best < SEARCHED - 1:
        found = minimize_scalar(
            lambda s: -float(at(s)[k.F_ASPERITY]),
            method="bounded",
            bounds=(grid[best - 1], grid[best + 1]),
            options={"xatol": 1e-12},
        )
        if -found.fun >= heat[best]:
            return at(float(found.x)).copy()
    return at(float(grid[best])).copy()


def _at_points(params: Any, point: Point) -> list[ReferencePoint]:
    """Return the reference's answer at a held-out point; none where there is none."""
    power, oil = point["load"] * point["speed"], point["oil_temperature"]
    with suppress(SolveError):
        known = reference_gearmesh(params, power=power, speed=point["speed"], oil_temperature=oil)
        return [ReferencePoint(point, None, None, *known.of(QUANTITIES))]
    return []


def _at_case(point: tuple[float, ...], _before: object = ()) -> ReferenceValues:
    """Return the reference's answer at a case of the charts."""
    load, speed, oil = point
    params = GearMeshParams()
    return reference_gearmesh(params, power=load * speed, speed=speed, oil_temperature=oil)


def _answer(params: Any, fidelity: str, known: ReferencePoint) -> Answer:
    p = known.point
    g = solve_gearmesh(
        params,
        power=p["load"] * p["speed"],
        speed=p["speed"],
        oil_temperature=p["oil_temperature"],
        fidelity=fidelity,
    )
    values: Values = {
        "friction_torque": g.friction_torque,
        "temperature": g.asperity_temperature,
        "film_thickness": g.film_thickness,
        "film_ratio": g.film_ratio,
    }
    return Answer(values, OK)


SOURCE = Source(
    _at_points,
    _answer,
    _at_case,
    tuple(
        f"thrustwasher.gearmesh.kernels.{name}"
        for name in ("line_of_action", "constants", "operating_point")
    ),
    None,
    ("adaptive quadrature over the line of action", "search for the hottest position"),
)
