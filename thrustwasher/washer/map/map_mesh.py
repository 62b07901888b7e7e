"""What a finer mesh changes on the lines of a map, told by a few lines solved on both.

Where asperities begin to touch near a rim, their load is a layer of the roughness over the tilt,
which a coarse mesh may miss by half. At given contact loads the curves of two meshes differ little,
and smoothly over speed, tilt and oil temperature: polynomials through some lines give all.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np

from ...errors import SolveError
from ...numerics.jit import Array
from .map_line import Curve, fit_of, nodes_of, packed
from .map_plan import MapPlan, Place
from .map_survey import across, torque_difference

FEW, MANY = (3, 3, 3), (5, 3, 5)  # lines along speed, tilt and oil temperature
STRONG = 7.0  # difference of the meshes over the tolerance from which many lines are solved
HARD = (-0.5, 1.0, 0.5)  # where on the axes, each from -1 to 1, meshes differ most
FINEST = (37, 128)
HELD_OUT = 12  # lines that tell if many are enough
MISSED_SHARE = 0.6  # of the tolerance: what may be left on them
MESH_SHARE = 0.25  # of the tolerance: what may be left between mesh and the finest one

Grid = tuple[int, int]
Solve = Callable[[Sequence[Sequence[Place]], Grid], list[list[Curve]]]
Where = tuple[float, float, float]
Pairs = dict[Where, tuple[Curve, Curve]]  # on both meshes


class NotSmooth(SolveError):
    """What a finer mesh changes is not told by few lines."""


class Change(NamedTuple):
    """What to add to a map's lines to have those of ``grid``."""

    lines: Array  # (lines, numbers of a line), as packed
    grid: Grid
    solved: int  # lines on it
    raised: float  # largest difference of the torque that was made good, relative
    left: float | None  # to the finest mesh, at one line; None: not measured


def change_of_mesh(plan: MapPlan, coarse: Grid, fine: Grid, solve: Solve) -> Change:
    """Return what a finer mesh adds; ``solve`` returns the curves of rows of places on a grid.

    NotSmooth: between the lines solved on both meshes the differences are something else.
    """

    def both(places: Iterable[Where]) -> Pairs:
        """Return the curves on both meshes."""
        listed = list(places)
        rows = [[across(plan, where)] for where in listed]  # too far apart for one path
        lines = [[row[0] for row in solve(rows, grid)] for grid in (coarse, fine)]
        return dict(zip(listed, zip(*lines, strict=True), strict=True))

    few = both(_places(plan, FEW))
    raised = max(torque_difference(plan, *pair) for pair in few.values())
    if raised <= STRONG * plan.tolerance:
        return Change(_between(plan, FEW, few), fine, len(few), raised, None)
    many = few | both(where for where in _places(plan, MANY) if where not in few)
    draws = np.random.default_rng(7).uniform(-1.0, 1.0, (HELD_OUT, 3)) * np.sign(plan.patches)
    others = both((x, y, z) for x, y, z in draws.tolist())
    missed = max(_missed(plan, many, where, *pair) for where, pair in others.items())
    if missed > MISSED_SHARE * plan.tolerance:
        raise NotSmooth(f"the coarser mesh is {raised:.1%} off")
    lines = _between(plan, MANY, many)
    place = [[across(plan, HARD)]]
    here, best = solve(place, fine)[0][0], solve(place, FINEST)[0][0]
    left = torque_difference(plan, here, best)
    if left <= MESH_SHARE * plan.tolerance:
        return Change(lines, fine, len(many), raised, left)
    more = packed(best, plan.more_terms) - packed(here, plan.more_terms)
    return Change(lines + more, FINEST, len(many), raised, left)


def _nodes(plan: MapPlan, counts: tuple[int, ...]) -> list[list[float]]:
    return [
        [float(x) for x in np.round(nodes_of(n), 9)] if patches else [0.0]
        for n, patches in zip(counts, plan.patches, strict=True)
    ]


def _places(plan: MapPlan, counts: tuple[int, ...]) -> list[Where]:
    speeds, tilts, oils = _nodes(plan, counts)
    return list(product(speeds, tilts, oils))


def _missed(plan: MapPlan, found: Pairs, place: Where, coarse: Curve, fine: Curve) -> float:
    """Return how far the torque on a line is off after the differences found are added."""
    shares = _shares(_nodes(plan, MANY), np.array([place]))[0]
    pairs = [found[where] for where in _places(plan, MANY)]
    pieces = [
        piece + np.tensordot(shares, [b.pieces[k] - a.pieces[k] for a, b in pairs], 1)
        for k, piece in enumerate(coarse.pieces)
    ]
    return torque_difference(plan, replace(coarse, pieces=pieces), fine)


def _between(plan: MapPlan, counts: tuple[int, ...], found: Pairs) -> Array:
    """Return the differences at all lines of the map: polynomials through those found."""
    nodes = _nodes(plan, counts)
    values = np.array(
        [
            packed(b, plan.more_terms) - packed(a, plan.more_terms)
            for a, b in (found[where] for where in _places(plan, counts))
        ]
    )
    ends = np.array(plan.axes)
    at = np.array([plan.scaled(place) for place in plan.places()])
    width = np.where(ends[:, 1] > ends[:, 0], ends[:, 1] - ends[:, 0], 1.0)
    at = np.clip((2.0 * at - ends[:, 0] - ends[:, 1]) / width, -1.0, 1.0)
    return np.asarray(_shares(nodes, at) @ values)


def _shares(nodes: list[list[float]], at: Array) -> Array:
    """Return what each node's line counts at places on the axes, each from -1 to 1."""
    vander = np.polynomial.chebyshev.chebvander
    first, second, third = (
        vander(x, len(n) - 1) @ fit_of(len(n)) if len(n) > 1 else np.ones((len(x), 1))
        for x, n in zip(at.T, nodes, strict=True)
    )
    return np.asarray(np.einsum("pi,pj,pk->pijk", first, second, third).reshape(len(at), -1))
