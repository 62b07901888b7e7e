"""The whole curve of a washer's solutions over load, with its folds."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from ..errors import ParameterError
from ..kernels.washer_curve import S, step_down
from ..kernels.washer_fields import Point
from ..kernels.washer_memory import BRANCH_NOW, MULTIPLICITY_NOW
from ._params import check_number
from .washer import check_point, resolve_grid
from .washer_constants import NO_MESH
from .washer_params import WasherParams
from .washer_result import WasherResult
from .washer_walker import Fold, Walker

__all__ = ["Fold", "LoadCurve", "load_curve"]

FINEST = 0.1  # [sigma] between points near contact
SHALLOW = 3e-4  # relative drop of the load that makes a fold; solve_washer uses the same
LABELS = {"film": 1.0, "unstable": 2.0, "contact": 3.0}


@dataclass(frozen=True, slots=True)
class LoadCurve:
    """All solutions at fixed speed, tilt and oil temperature."""

    points: list[WasherResult]  # ordered by falling film_thickness
    folds: list[Fold]  # empty if the curve is single-valued


def load_curve(
    params: WasherParams, *, speed: float, tilt: float, oil_temperature: float = 297.15,
    fidelity: str = "field", grid: tuple[int, int] | None = None, load_min: float = 20.0,
    load_max: float = 3000.0,
) -> LoadCurve:  # fmt: skip
    """Return all solutions between two loads and the folds where the film is lost and regained.

    The film thickness is prescribed and the load computed, so the curve is followed through both
    folds and along the unstable branch between them.

    Parameters
    ----------
    params, speed [rad/s], tilt [rad], oil_temperature [K], fidelity, grid : as in solve_washer
    load_min, load_max : ends of the curve [N]

    Returns
    -------
    LoadCurve : ``points`` by falling film thickness (each with load and branch), ``folds``

    Raises
    ------
    ParameterError : an argument is outside its range
    SolveError : the walk along the curve got stuck

    Notes
    -----
    Folds are extrema of the load, located to 1e-5 sigma in film thickness; a pair whose loads
    differ by less than 3e-4 counts as none.

    Examples
    --------
    >>> curve = load_curve(WasherParams(), speed=545.0, tilt=0.002)
    >>> [f"{fold.kind} {fold.load:.0f} N" for fold in curve.folds]
    ['film_lost 773 N', 'film_regained 441 N']
    """
    nodes = resolve_grid(fidelity, grid)
    if nodes == NO_MESH:
        raise ParameterError(
            f"fidelity = {fidelity!r}, allowed: 'coarse' or 'field' or 'fine'; without a mesh "
            "there is one solution for each load: call solve_washer"
        )
    check_number("load_min", load_min, "N", 1.0, 1e4)
    check_number("load_max", load_max, "N", load_min, 1e4)
    point = Point(*check_point(load_min, speed, tilt, oil_temperature))
    walker = Walker(params, point, nodes)
    walker.enter(load_min)
    points: list[WasherResult] = [walker.result(fidelity)]
    folds: list[Fold] = []
    places = [float(walker.walk[S])]  # smoothed film thicknesses
    top = 0  # the highest point since the film was regained, the lowest since it was lost
    rising = True
    while points[-1].load < load_max or not rising:
        walker.to(step_down(walker.m.sigma1, walker.walk[S], FINEST))
        places.append(float(walker.walk[S]))
        points.append(walker.result(fidelity))
        gain = points[-1].load - points[top].load
        noise = SHALLOW * points[top].load + 1e-3
        if gain < -noise if rising else gain > noise:
            rising = not rising
            kind = "film_regained" if rising else "film_lost"
            folds.append(walker.fold(kind, places[max(0, top - 1)], places[-1]))
            top = len(points) - 1
        elif gain > 0.0 if rising else gain < 0.0:
            top = len(points) - 1
    return LoadCurve(_labelled(points, folds), folds)


def _labelled(points: list[WasherResult], folds: list[Fold]) -> list[WasherResult]:
    """Name each point's branch: by the folds, or on a single-valued curve by the film ratio."""
    named = []
    for p in points:
        passed = sum(p.film_ratio < fold.film_ratio for fold in folds)
        if folds:
            branch = "unstable" if passed % 2 else "contact" if passed else "film"
        else:
            branch = "film" if p.film_ratio >= 3.0 else "contact"
        distress = (bool(folds) and branch == "contact") or (
            p.temperature - p.oil_temperature > 200.0
        )
        p._state[BRANCH_NOW] = LABELS[branch]
        p._state[MULTIPLICITY_NOW] = 2.0 if folds else 1.0
        named.append(dataclasses.replace(p, branch=branch, distress=distress))
    return named
