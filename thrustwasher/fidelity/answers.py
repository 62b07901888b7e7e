"""What a rung says at a held-out point, asked through the same call that a user makes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..errors import SolveError, Status
from ..models._params import as_numbers
from ..store.maps import find_map
from .courses import engagement
from .truths import Truth, Values

OK, FAILED, OUTSIDE, OTHER_SIDE = "ok", "failed", "outside", "other side"


@dataclass(frozen=True)
class Answer:
    """Values of the quantities, and whether they count: one of the words above.

    ``work`` is a count of what was done that needs no machine: iterations, times nodes if the rung
    has a mesh.
    """

    values: Values
    verdict: str
    work: float = 0.0


def answer(model: str, params: Any, fidelity: str, truth: Truth) -> Answer:
    """Return what a rung says at the point of a reference value, on its branch."""
    ask = {"washer": _washer, "clutch": _clutch, "gearmesh": _gearmesh}[model]
    try:
        return ask(params, fidelity, truth)
    except SolveError:
        return Answer({}, FAILED)


def _washer(params: Any, fidelity: str, truth: Truth) -> Answer:
    from ..models.washer import GRIDS, solve_washer

    known = truth.by_mesh.get("x".join(map(str, GRIDS[fidelity])))
    if known is not None:
        return Answer(known, OK)
    point: Any = truth.point
    r = solve_washer(params, **point, fidelity=fidelity, branch=truth.branch, throw=False)
    values: Values = {
        "friction_torque": r.friction_torque, "temperature": r.temperature,
        "film_thickness": r.film_thickness, "film_ratio": r.film_ratio,
    }  # fmt: skip
    work = float(r.iterations * max(r.grid[0] * r.grid[1], 1))
    if fidelity == "map" and (r.fidelity != "map" or r.status is Status.OUTSIDE_VERIFIED):
        return Answer(values, OUTSIDE, work)
    if r.status is Status.NO_BRANCH and truth.beside_fold:
        return Answer(values, OTHER_SIDE, work)
    failed = r.status.is_failure and r.status is not Status.NO_BRANCH
    return Answer(values, FAILED if failed else OK, work)


def _clutch(params: Any, fidelity: str, truth: Truth) -> Answer:
    from ..models.clutch import solve_clutch

    if truth.chart == "engagement":
        return Answer(engagement(params, fidelity, truth.point), OK)
    point: Any = truth.point
    c = solve_clutch(params, **point, fidelity=fidelity)
    values: Values = {
        "friction_torque": c.friction_torque, "temperature": c.temperature,
        "film_thickness": c.film_thickness, "film_ratio": c.film_ratio,
    }  # fmt: skip
    return Answer(values, OK, float(c.iterations))


def _gearmesh(params: Any, fidelity: str, truth: Truth) -> Answer:
    from ..models.gearmesh import solve_gearmesh

    p = truth.point
    g = solve_gearmesh(
        params, power=p["load"] * p["speed"], speed=p["speed"],
        oil_temperature=p["oil_temperature"], fidelity=fidelity,
    )  # fmt: skip
    values: Values = {
        "friction_torque": g.friction_torque, "temperature": g.asperity_temperature,
        "film_thickness": g.film_thickness, "film_ratio": g.film_ratio,
    }  # fmt: skip
    return Answer(values, OK, float(g.iterations))


def holds(model: str, params: Any, fidelity: str) -> bool:
    """Tell if a rung can be used with a parameter set at all; a map may not be there."""
    if fidelity != "map":
        return True
    return find_map(as_numbers(params)) is not None
