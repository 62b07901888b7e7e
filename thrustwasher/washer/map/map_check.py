"""Checking a map: random points that it was not built from, solved on the mesh it stands for."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ...errors import BranchError, SolveError
from ...processes import Run, run_here
from ..load_curve import Continuation
from ..parameters import WasherParams
from ..solve import GRIDS, solve_washer
from ..washer_result import WasherResult
from .look_up import WasherMap
from .map_plan import BEND, INPUTS

NEAR = 0.03  # within this share of a fold's load the slope of the curve runs away
FOLD_WITHIN = 0.3  # [sigma] of the map's fold lies the mesh's
TWINS = ("film", "contact")


@dataclass(frozen=True, slots=True)
class Held:
    """How the map differs from the mesh at a held-out point."""

    torque: float  # relative difference
    ratio: float  # difference of film ratios
    rise: float  # K, of the mean temperature
    oil: float  # relative, largest of oil flow, its heat and the film's rise
    near_fold: bool
    point: tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Verdict:
    """Largest differences of a map from the mesh it was built on."""

    points: int
    torque: float  # relative, away from folds
    torque_rms: float
    torque_near_fold: float
    film_ratio: float
    temperature: float  # K
    oil: float  # relative, of oil flow, its heat and the film's rise
    fold_load: float  # relative
    folds: int
    unanswered: int  # points at which one of the two had no answer
    worst: dict[str, float]  # the point of the largest difference in torque


def check_map(
    params: WasherParams,
    path: str,
    *,
    points: int = 200,
    grid: tuple[int, int] = GRIDS["fine"],
    run: Run = run_here,
    progress: Callable[[int, int], None] | None = None,
) -> Verdict:
    """Compare a map file with solutions on a mesh at random points of its box, on both branches.

    ``points`` of them are spread evenly over the logarithms of load, speed and tilt; the map is
    built from none of them. ``grid`` is the mesh of the solutions.
    """
    washer = WasherMap(params, path)
    tasks = [(TWINS[k % 2], point, k % 4 < 2) for k, point in enumerate(_points(washer, points))]
    compare = partial(_compare, params, path, grid)
    held: list[Held] = []
    folds: list[float] = []
    unanswered = 0
    for k, (row, differences, odd) in enumerate(run(compare, tasks, 4)):
        held += [row] if row else []
        folds += differences
        unanswered += odd
        if progress is not None:
            progress(k + 1, len(tasks))
    away = [h for h in held if not h.near_fold]
    torques = np.array([h.torque for h in away] or [0.0])
    worst = max(away, key=lambda h: abs(h.torque), default=None)
    return Verdict(
        points=len(held),
        torque=_largest(h.torque for h in away),
        torque_rms=float(np.sqrt(np.mean(torques**2))),
        torque_near_fold=_largest(h.torque for h in held if h.near_fold),
        film_ratio=_largest(h.ratio for h in away),
        temperature=_largest(h.rise for h in away),
        oil=_largest(h.oil for h in away),
        fold_load=_largest(folds),
        folds=len(folds),
        unanswered=unanswered,
        worst=dict(zip(INPUTS, worst.point, strict=True)) if worst else {},
    )


def mesh_of(metadata: dict[str, Any]) -> tuple[int, int]:
    """Return the mesh that a map with this metadata stands for."""
    n_r, n_t = metadata.get("checked_on") or GRIDS[metadata["built_from"]]
    return int(n_r), int(n_t)


def _points(washer: WasherMap, n: int) -> list[tuple[float, float, float, float]]:
    """Return random points: even in the logarithms, speed as the map's own axis."""
    rng = np.random.default_rng(7)
    box = washer.box
    columns = []
    for name in INPUTS:
        low, high = box[name]
        share = rng.uniform(size=n)
        if name == "speed":
            low = max(low, 1.0)
            a, b = np.arcsinh(low / BEND), np.arcsinh(high / BEND)
            columns.append(BEND * np.sinh(a + share * (b - a)))
        elif name == "oil_temperature":
            columns.append(low + share * (high - low))
        else:
            columns.append(low * (high / low) ** share)
    return [(float(a), float(b), float(c), float(d)) for a, b, c, d in zip(*columns, strict=True)]


def _compare(
    params: WasherParams,
    path: str,
    grid: tuple[int, int],
    task: tuple[str, tuple[float, float, float, float], bool],
) -> tuple[Held | None, list[float], int]:
    """Return the held-out point (None: no such branch), differences of folds, odd answers."""
    washer, (twin, point, with_folds) = WasherMap(params, path), task
    load, speed, tilt, oil = point
    place: dict[str, Any] = {"speed": speed, "tilt": tilt, "oil_temperature": oil}
    mine = [f.load for f in washer.folds(**place)]
    branch = twin if len(mine) == 2 else None  # elsewhere the name only follows the film ratio
    here = washer.look_up(load=load, **place, branch=branch)
    try:
        there = solve_washer(params, load=load, **place, grid=grid, branch=branch)
    except BranchError:
        there = None
    except SolveError:
        return None, [], 1
    differences: list[float] = []
    near = any(abs(load / f - 1.0) < NEAR for f in mine)
    if with_folds and len(mine) == 2 and mine[1] < 0.97 * mine[0]:
        differences = _off_folds(params, washer, place, grid)
    there_is = float(here["branch"]) > 0.0
    if there is None or not there_is:
        return None, differences, int((there is not None or there_is) and not near)
    row = Held(
        near_fold=near,
        point=point,
        torque=float(here["friction_torque"]) / there.friction_torque - 1.0,
        ratio=float(here["film_ratio"]) - there.film_ratio,
        rise=float(here["temperature"]) - there.temperature,
        oil=_largest(_off_oil(here, there)),
    )
    return row, differences, 0


def _off_oil(here: dict[str, Any], there: WasherResult) -> list[float]:
    """Return relative differences of what the oil does."""
    oil = there.oil_temperature
    pairs = [
        (float(here["oil_flow"]), there.oil_flow),
        (float(here["throughflow_heat"]), there.throughflow_heat),
        (float(here["film_temperature"]) - oil, there.film_temperature - oil),
    ]
    return [a / b - 1.0 for a, b in pairs if b > 0.0]


def _off_folds(
    params: WasherParams, washer: WasherMap, place: dict[str, float], grid: tuple[int, int]
) -> list[float]:
    """Return the relative differences of the loads of two folds; none if the mesh has them not."""
    inputs = 1.0, place["speed"], place["tilt"], place["oil_temperature"], 0.0
    curve = Continuation(params, inputs, grid)
    differences = []
    try:
        curve.start(6.0)
        for fold in washer.folds(**place):
            upper, lower = (
                (fold.film_ratio + d) * curve.m.sigma1 for d in (FOLD_WITHIN, -FOLD_WITHIN)
            )
            found = curve.fold(fold.kind, upper, lower)
            differences.append(fold.load / found.load - 1.0)
    except SolveError:
        return []
    return differences


def _largest(values: Iterable[float]) -> float:
    return max(map(abs, values), default=0.0)
