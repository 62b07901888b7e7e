"""Reference values of the washer: three fine meshes of one family, extrapolated.

A fine mesh starts where a coarser one ended: the solution is carried over.
"""

import dataclasses
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import SolveError, Status
from ...ladder.error_table import QUANTITIES
from ...model.part_file import preset_params
from ...washer.kernel_arguments import constants
from ...washer.kernels.constants import WasherModel, washer_model
from ...washer.kernels.layout import S_FACTOR_VALID, S_FIELDS
from ...washer.kernels.workspace import size_of_state
from ...washer.load_curve import load_curve
from ...washer.parameters import SPEC, WasherParams
from ...washer.solve import GRIDS as MESHES
from ...washer.solve import WasherResult, _solve, solve_washer
from ...washer.washer_result import BRANCHES
from . import reference_values as ref
from .reference_values import Answer, Point, ReferencePoint, ReferenceValues, Source, Values

Array = NDArray[np.float64]
GRIDS = ((19, 64), (28, 96), (37, 128))  # all intervals refined alike, 3 : 2 then 4 : 3
FINER = ((37, 128), (55, 192), (73, 256))
NAMES = (
    "friction_torque",
    "temperature",
    "temperature_max",
    "film_thickness",
    "film_ratio",
    "fluid_load",
    "contact_load",
    "friction_coefficient",
)


def reference_washer(
    params: WasherParams,
    *,
    load: float,
    speed: float,
    tilt: float,
    oil_temperature: float = 297.15,
    branch: str | None = None,
    finer: bool = False,
) -> ReferenceValues:
    """Return the washer's values converged over the mesh, with what they may be off by.

    Parameters
    ----------
    params, load [N], speed [rad/s], tilt [rad], oil_temperature [K], branch : as in solve_washer
    finer : 73 x 256 nodes at the end (a minute or more) instead of 37 x 128 (seconds)

    Returns
    -------
    ReferenceValues : torque in N m, temperatures in K, film in m, loads in N; the maximum of the
        temperature converges slowly, which its uncertainty shows

    Raises
    ------
    ParameterError : an argument is outside its range
    SolveError : a mesh has no solution on the branch

    Notes
    -----
    Extrapolated with order 2 from the two finest meshes; the uncertainty also counts how far the
    value moved from that of the two coarser ones.
    """
    base = solve_washer(
        params, load=load, speed=speed, tilt=tilt, oil_temperature=oil_temperature, branch=branch
    )
    return _converged(base, FINER if finer else GRIDS)[0]


def _converged(
    base: WasherResult, grids: tuple[tuple[int, int], ...]
) -> tuple[ReferenceValues, dict[str, float]]:
    """Return the values on a branch extrapolated over meshes, and what the first mesh gave."""
    result, rows = base, []
    for grid in grids:
        result = solve_on(result, grid)
        if result.status.is_failure or result.branch != base.branch:
            raise SolveError(
                f"reference_washer: {grid[0]} x {grid[1]} nodes have no solution on the branch "
                f"{base.branch!r} at load = {base.load:g} N; tried: from the next coarser mesh; "
                "move the load away from the fold"
            )
        rows.append({name: float(getattr(result, name)) for name in NAMES})
    i, j, k = (n_r - 1 for n_r, _ in grids)  # intervals along the radius
    values, uncertainty = ref.extrapolated(rows, (j / i, k / j), 2.0)
    meshes = ", ".join(f"{a} x {b}" for a, b in grids)
    return ReferenceValues(values, uncertainty, (f"{meshes} nodes, order 2",)), rows[0]


def solve_on(result: WasherResult, grid: tuple[int, int]) -> WasherResult:
    """Return the solution on ``grid``, on the branch of ``result``, started from its fields.

    Where Newton's method does not arrive from there the solver finds the branch by itself, as from
    nothing. The status shows a failure; ``error_estimate`` is that of the named level.
    """
    branch = BRANCHES.get(result.branch, 0.0)
    return _solve(
        result.params, result.point(), "field", grid, branch, interpolate_to_mesh(result, grid)
    )


def interpolate_to_mesh(result: WasherResult, grid: tuple[int, int]) -> WasherResult:
    """Return ``result`` as if it had been found on ``grid``: positions kept, fields resampled."""
    old = washer_model(constants(result.params, result.grid))
    new = washer_model(constants(result.params, grid))
    n_old, n_new = old.per_column * old.n_t + old.n_ring, new.per_column * new.n_t + new.n_ring
    had = result._state[S_FIELDS : S_FIELDS + n_old]
    temperatures = np.zeros(n_new)
    for name, inner_old, inner_new in (
        ("film", 0, 0),
        ("carrier", 0, 0),
        ("washer", 0, 0),
        ("gear", old.i_g, new.i_g),
    ):
        step, to_step = getattr(old, f"{name}_step"), getattr(new, f"{name}_step")
        if name == "film" and step == 0:
            continue
        at, to = getattr(old, f"{name}_at"), getattr(new, f"{name}_at")
        columns = at + step * np.arange(old.n_t)[:, None]
        field = had[columns + np.arange(old.n_r - inner_old)]
        places = to + to_step * np.arange(new.n_t)[:, None] + np.arange(new.n_r - inner_new)
        temperatures[places] = _resampled(field, old, new, inner_old, inner_new)
    pressure = result._state[S_FIELDS + n_old :][: old.n_r * old.n_t].reshape(old.n_t, old.n_r)
    state = np.zeros(size_of_state(*grid))
    state[:S_FIELDS] = result._state[:S_FIELDS]
    state[S_FACTOR_VALID] = 0.0
    state[S_FIELDS : S_FIELDS + n_new] = temperatures
    moved = np.maximum(_resampled(pressure, old, new, 0, 0), 0.0).ravel()
    state[S_FIELDS + n_new :][: moved.size] = moved
    return dataclasses.replace(result, grid=grid, _state=state)


def _resampled(
    values: Array, old: WasherModel, new: WasherModel, first_old: int, first_new: int
) -> Array:
    """Return a field (n_theta, n_r) on the new nodes, from node ``first`` outwards.

    Around the circumference all meshes are one map of a uniform one: the index is the coordinate.
    """
    from scipy.interpolate import CubicSpline

    s = np.arange(old.n_t + 1) / old.n_t
    around = CubicSpline(s, np.vstack([values, values[:1]]), bc_type="periodic")
    turned = around(np.arange(new.n_t) / new.n_t)
    along = CubicSpline(old.r[first_old:], turned, axis=1)
    return np.asarray(along(new.r[first_new:]))


def _at_points(params: Any, point: Point) -> list[ReferencePoint]:
    """Return the reference's answers at a held-out point, one per branch that exists there.

    They are those of ``reference_washer``; here they start from the default mesh, whose fields are
    carried to finer ones, and what the first of them says is kept. Points where a mesh fails are
    left out.
    """
    place: Any = {k: v for k, v in point.items() if k != "load"}
    try:
        folds = {f.kind: f.load for f in load_curve(params, **place).folds}
    except SolveError:
        return []
    found = []
    for branch in _branches(point["load"], folds):
        try:
            base = solve_washer(params, load=point["load"], **place, branch=branch)
            known, first = _converged(base, GRIDS)
        except SolveError:
            continue
        beside = any(abs(point["load"] / load - 1.0) < ref.MARGIN for load in folds.values())
        by_mesh: dict[str, Values] = {_mesh_name(GRIDS[0]): {q: first[q] for q in QUANTITIES}}
        found.append(
            ReferencePoint(point, base.branch, base.branch, *known.of(QUANTITIES), beside, by_mesh)
        )
    return found


def _branches(load: float, folds: dict[str, float]) -> list[str | None]:
    """Return the branches at a load; None where the curve is single-valued."""
    if len(folds) < 2:
        return [None]
    film = ["film"] if load < folds["film_lost"] else []
    return [*film, *(["contact"] if load > folds["film_regained"] else [])]


def _mesh_name(grid: tuple[int, ...]) -> str:
    """Return a mesh as it is written: "19x64"."""
    return "x".join(map(str, grid))


def _at_case(
    point: tuple[float, ...], before: tuple[tuple[float, ...], ...] = (), preset: str | None = None
) -> ReferenceValues:
    """Return the reference's answer at a case of the charts, on the branch that leads there."""
    params, result = preset_params(SPEC, preset, {}), None
    for load, speed, tilt, oil, _ in (*before, point):
        result = solve_washer(
            params, load=load, speed=speed, tilt=tilt, oil_temperature=oil, start=result
        )
    load, speed, tilt, oil, _ = point
    branch = result.branch if result else None
    return reference_washer(
        params, load=load, speed=speed, tilt=tilt, oil_temperature=oil, branch=branch
    )


def _answer(params: Any, fidelity: str, known: ReferencePoint) -> Answer:
    on_mesh = known.by_mesh.get(_mesh_name(MESHES[fidelity]))
    if on_mesh is not None:
        return Answer(on_mesh, ref.OK)
    point: Any = known.point
    r = solve_washer(params, **point, fidelity=fidelity, branch=known.branch, throw=False)
    values: Values = {name: getattr(r, name) for name in QUANTITIES}
    if r.fidelity != fidelity:  # the map has handed over to the field
        return Answer(values, ref.OUTSIDE)
    if r.status is Status.NO_BRANCH and known.beside_fold:
        return Answer(values, ref.OTHER_SIDE)
    failed = r.status.is_failure and r.status is not Status.NO_BRANCH
    return Answer(values, ref.FAILED if failed else ref.OK)


SOURCE = Source(
    _at_points,
    _answer,
    _at_case,
    tuple(f"thrustwasher.washer.kernels.{name}" for name in ("solve", "outputs", "constants")),
    GRIDS[-1],
    tuple(f"{a} x {b} and {c} x {d} nodes, order 2" for (a, b), (c, d) in pairwise(GRIDS)),
    BRANCHES,
)
