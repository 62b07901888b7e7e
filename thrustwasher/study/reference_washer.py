"""Reference values of the washer: three fine meshes of one family, extrapolated."""

from contextlib import suppress
from itertools import pairwise
from typing import Any

from ..errors import SolveError, Status
from ..ladder.error_table import QUANTITIES
from ..model.part_file import preset_params
from ..washer.load_curve import load_curve
from ..washer.parameters import SPEC, WasherParams
from ..washer.solve import solve_washer
from ..washer.washer_result import BRANCHES
from . import reference_values as ref
from .reference_values import Answer, Point, ReferencePoint, ReferenceValues, Source, Values

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
    point: Any = {"load": load, "speed": speed, "tilt": tilt, "oil_temperature": oil_temperature}
    branch = solve_washer(params, **point, branch=branch).branch
    grids, rows = FINER if finer else GRIDS, []
    for grid in grids:
        result = solve_washer(params, **point, branch=branch, grid=grid, throw=False)
        if result.status.is_failure or result.branch != branch:
            raise SolveError(
                f"reference_washer: {grid[0]} x {grid[1]} nodes have no solution on the branch "
                f"{branch!r} at load = {load:g} N; tried: from nothing; move the load away from "
                "the fold"
            )
        rows.append({name: float(getattr(result, name)) for name in NAMES})
    i, j, k = (n_r - 1 for n_r, _ in grids)  # intervals along the radius
    values, uncertainty = ref.extrapolated(rows, (j / i, k / j), 2.0)
    meshes = ", ".join(f"{a} x {b}" for a, b in grids)
    return ReferenceValues(values, uncertainty, (f"{meshes} nodes, order 2",))


def _at_points(params: Any, point: Point) -> list[ReferencePoint]:
    """Return the reference's answers at a held-out point, one per branch that exists there.

    Points where a mesh fails are left out.
    """
    given: Any = point
    place = {k: v for k, v in given.items() if k != "load"}
    try:
        folds = {f.kind: f.load for f in load_curve(params, **place).folds}
    except SolveError:
        return []
    beside = any(abs(point["load"] / load - 1.0) < ref.MARGIN for load in folds.values())
    found = []
    for asked in _branches(point["load"], folds):
        with suppress(SolveError):
            branch = solve_washer(params, **given, branch=asked).branch
            known = reference_washer(params, **given, branch=branch).of(QUANTITIES)
            found.append(ReferencePoint(point, branch, branch, *known, beside))
    return found


def _branches(load: float, folds: dict[str, float]) -> list[str | None]:
    """Return the branches at a load; None where the curve is single-valued."""
    if len(folds) < 2:
        return [None]
    film = ["film"] if load < folds["film_lost"] else []
    return [*film, *(["contact"] if load > folds["film_regained"] else [])]


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
    tuple(f"{a} x {b} and {c} x {d} nodes, order 2" for (a, b), (c, d) in pairwise(GRIDS)),
    BRANCHES,
)
