"""Checking a map: random points that it was not built from, solved on the mesh it stands for."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ...errors import BranchError, SolveError
from ...processes import mapped
from ..load_curve import load_curve
from ..parameters import WasherParams
from ..solve import solve_washer
from .look_up import WasherMap
from .map_plan import BEND, INPUTS

NEAR = 0.03  # within this share of a fold's load the slope of the curve runs away
TWINS = ("film", "contact")


@dataclass(frozen=True, slots=True)
class Held:
    """How the map differs from the mesh at a held-out point."""

    torque: float  # relative difference
    ratio: float  # difference of film ratios
    rise: float  # K, of the mean temperature
    near_fold: bool


@dataclass(frozen=True, slots=True)
class Verdict:
    """Largest differences of a map from the mesh it was built on."""

    points: int
    torque: float  # relative, away from folds
    torque_rms: float
    torque_near_fold: float
    film_ratio: float
    temperature: float  # K
    fold_load: float  # relative
    folds: int
    unanswered: int  # points at which one of the two had no answer


def check_map(
    params: WasherParams, path: str, *, points: int = 200, fidelity: str = "fine",
    workers: int = 1, progress: Callable[[int, int], None] | None = None,
) -> Verdict:  # fmt: skip
    """Compare a map file with solutions on a mesh at random points of its box, on both branches.

    ``points`` of them are spread evenly over the logarithms of load, speed and tilt; the map is
    built from none of them. ``fidelity`` is the mesh of the solutions.
    """
    washer = WasherMap(params, path)
    tasks = [(TWINS[k % 2], point) for k, point in enumerate(_points(washer, points))]
    compare = partial(_compare, params, path, fidelity)
    held: list[Held] = []
    folds: list[float] = []
    unanswered = 0
    with mapped(workers, compare, tasks, 4) as found:
        for k, (row, differences, odd) in enumerate(found):
            held += [row] if row else []
            folds += differences
            unanswered += odd
            if progress is not None:
                progress(k + 1, len(tasks))
    return _verdict(held, folds, unanswered)


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
    params: WasherParams, path: str, fidelity: str,
    task: tuple[str, tuple[float, float, float, float]],
) -> tuple[Held | None, list[float], int]:  # fmt: skip
    """Return the held-out point (None: no such branch), differences of folds, odd answers."""
    washer, (twin, point) = WasherMap(params, path), task
    load, speed, tilt, oil = point
    place: dict[str, Any] = {"speed": speed, "tilt": tilt, "oil_temperature": oil}
    mine = [f.load for f in washer.folds(**place)]
    branch = twin if mine else None  # elsewhere the name only follows the film ratio
    here = washer.look_up(load=load, **place, branch=branch)
    try:
        there = solve_washer(params, load=load, **place, fidelity=fidelity, branch=branch)
    except BranchError:
        there = None
    except SolveError:
        return None, [], 1
    differences: list[float] = []
    near = any(abs(load / f - 1.0) < NEAR for f in mine)
    if len(mine) == 2 and mine[1] < 0.97 * mine[0]:
        box = washer.box["load"]
        top = min(1e4, max(box[1], 1.3 * mine[0]))
        curve = load_curve(params, **place, fidelity=fidelity, load_min=box[0], load_max=top)
        theirs = [f.load for f in curve.folds]
        if len(theirs) == 2:
            differences = [a / b - 1.0 for a, b in zip(mine, theirs, strict=True)]
    there_is = float(here["branch"]) > 0.0
    if there is None or not there_is:
        return None, differences, int((there is not None or there_is) and not near)
    row = Held(
        near_fold=near,
        torque=float(here["friction_torque"]) / there.friction_torque - 1.0,
        ratio=float(here["film_ratio"]) - there.film_ratio,
        rise=float(here["temperature"]) - there.temperature,
    )  # fmt: skip
    return row, differences, 0


def _verdict(held: list[Held], folds: list[float], unanswered: int) -> Verdict:
    away = [h for h in held if not h.near_fold]
    torques = np.array([h.torque for h in away] or [0.0])
    return Verdict(
        points=len(held), torque=_largest(h.torque for h in away),
        torque_rms=float(np.sqrt(np.mean(torques**2))),
        torque_near_fold=_largest(h.torque for h in held if h.near_fold),
        film_ratio=_largest(h.ratio for h in away), temperature=_largest(h.rise for h in away),
        fold_load=_largest(folds), folds=len(folds), unanswered=unanswered,
    )  # fmt: skip


def _largest(values: Iterable[float]) -> float:
    return max(map(abs, values), default=0.0)
