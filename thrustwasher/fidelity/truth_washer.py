"""The washer's reference values: fine meshes extrapolated, on each branch that exists."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from ..errors import SolveError
from ..models.washer import WasherResult, solve_washer
from ..models.washer_load_curve import load_curve
from .prolong import solve_on
from .reference_values import extrapolated
from .reference_washer import GRIDS
from .truths import MARGIN, QUANTITIES, Point, Source, Truth, Values

N = [n_r - 1 for n_r, _ in GRIDS]  # intervals along the radius


def mesh_name(grid: tuple[int, int]) -> str:
    """Return a mesh as it is written: "19x64"."""
    return f"{grid[0]}x{grid[1]}"


def washer_truths(params: Any, point: Point) -> list[Truth]:
    """Return the reference's answers at a point, one per branch that exists there.

    They are those of ``reference_washer``; here they start from the default mesh, whose fields are
    carried to finer ones, and what the first of them says is kept. Points where a mesh
    fails are left out.
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
    rows = [{name: float(getattr(r, name)) for name in QUANTITIES} for r in chain[1:]]
    values, uncertainty = extrapolated(rows, (N[1] / N[0], N[2] / N[1]), 2.0)
    by_mesh: dict[str, Values] = {mesh_name(GRIDS[0]): dict(rows[0])}
    return Truth(point, branch, branch, dict(values), uncertainty, beside_fold, by_mesh)


SOURCE = Source(
    solve=washer_truths,
    kernels=("washer_solve", "washer_outputs", "washer_model"),
    fidelity="reference",
    grid=GRIDS[-1],
    routes=tuple(f"{a} x {b} and {c} x {d} nodes, order 2" for (a, b), (c, d) in pairwise(GRIDS)),
)
