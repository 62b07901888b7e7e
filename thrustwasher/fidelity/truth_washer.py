"""The washer's reference values: two fine meshes extrapolated, on each branch that exists."""

from __future__ import annotations

from typing import Any

from ..errors import SolveError
from ..models.washer import WasherResult, solve_washer
from ..models.washer_curve import load_curve
from .prolong import solve_on
from .truths import MARGIN, QUANTITIES, Point, Source, Truth, Values

# meshes of one family: all intervals are refined alike
GRIDS = ((19, 64), (28, 96), (37, 128))
GAIN = (36.0 / 27.0) ** 2 - 1.0  # of one refinement at second order


def washer_truths(params: Any, point: Point) -> list[Truth]:
    """Return the reference's answers at a point, one per branch that exists there.

    From the default mesh the solution is carried to finer ones. The value is extrapolated from the
    two finest with second order; the whole correction counts as its uncertainty. Points where a
    mesh fails are left out.
    """
    place: Any = {k: v for k, v in point.items() if k != "load"}
    try:
        folds = {f.kind: f.load for f in load_curve(params, **place).folds}
    except SolveError:
        return []
    found = []
    for branch in _branches(point["load"], folds):
        chain = [solve_washer(params, load=point["load"], **place, branch=branch, throw=False)]
        for grid in GRIDS:
            chain.append(solve_on(chain[-1], grid))
        if all(_good(r, chain[0].branch) for r in chain):
            beside = any(abs(point["load"] / load - 1.0) < MARGIN for load in folds.values())
            found.append(_truth(point, chain[0].branch, chain, beside))
    return found


def _branches(load: float, folds: dict[str, float]) -> list[str | None]:
    """Return the branches at a load; None where the curve is single-valued."""
    if len(folds) < 2:
        return [None]
    film = ["film"] if load < folds["film_lost"] else []
    return [*film, *(["contact"] if load > folds["film_regained"] else [])]


def _good(result: WasherResult, branch: str) -> bool:
    return not result.status.is_failure and result.branch == branch


def _truth(point: Point, branch: str, chain: list[WasherResult], beside_fold: bool) -> Truth:
    """Return the extrapolated values and what the fine mesh said."""
    values: Values = {}
    uncertainty = {}
    for name in QUANTITIES:
        coarse, fine = (float(getattr(r, name)) for r in chain[-2:])
        correction = (fine - coarse) / GAIN
        values[name], uncertainty[name] = fine + correction, abs(correction)
    fine_mesh: Values = {name: float(getattr(chain[1], name)) for name in QUANTITIES}
    return Truth(point, branch, branch, values, uncertainty, beside_fold, {"fine": fine_mesh})


SOURCE = Source(
    solve=washer_truths,
    kernels=("washer_solve", "washer_outputs", "washer_model"),
    fidelity="reference",
    grid=GRIDS[-1],
    routes=("28 x 96 and 37 x 128 nodes extrapolated with order 2", "the correction is the error"),
)
