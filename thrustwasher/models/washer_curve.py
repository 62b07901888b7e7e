"""The whole curve of a washer's solutions over load, with its folds."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, SolveError, Status
from ..kernels import washer_step as kernel
from ..kernels.washer_curve import (
    ACCURACY,
    N_WALK,
    S,
    W,
    enter_curve,
    find_fold,
    step_down,
    walk_to,
)  # fmt: skip
from ..kernels.washer_fields import Bench, Point, size_of_work, washer_fields
from ..kernels.washer_memory import (
    BRANCH_NOW,
    MULTIPLICITY_NOW,
    RATIO_THEN,
    SCAN_OIL,
    SCAN_SPEED,
    SCAN_TILT,
    remember_state,
    size_of_state,
)  # fmt: skip
from ..kernels.washer_model import washer_model
from ..kernels.washer_newton import N_INFO
from ..kernels.washer_outputs import MEAN_TEMPERATURE, RATIO, TORQUE, washer_outputs
from ._buffers import work_array
from ._params import check_number
from .washer import ERRORS, check_point, resolve_grid, result_from
from .washer_constants import NO_MESH, constants
from .washer_params import WasherParams
from .washer_result import WasherResult

Array = NDArray[np.float64]
FINEST = 0.1  # [sigma] between points near contact
SHALLOW = 3e-4  # relative drop of the load that makes a fold; solve_washer uses the same
LABELS = {"film": 1.0, "unstable": 2.0, "contact": 3.0}


@dataclass(frozen=True, slots=True)
class Fold:
    """Where two branches meet and end."""

    kind: str  # "film_lost" (load rising) or "film_regained" (load falling)
    load: float  # [N]
    film_ratio: float  # [-]
    temperature: float  # [K]
    friction_torque: float  # [N m]


@dataclass(frozen=True, slots=True)
class LoadCurve:
    """All solutions at fixed speed, tilt and oil temperature."""

    points: list[WasherResult]  # ordered by falling film_thickness
    folds: list[Fold]  # empty if the curve is single-valued


class _Walker:
    """The kernels' walker with its arrays."""

    def __init__(self, params: WasherParams, point: Point, nodes: tuple[int, int]) -> None:
        self.params, self.pt, self.nodes = params, point, nodes
        self.par = constants(params, nodes)
        self.work = work_array(("washer", nodes), kernel.N_HEAD + size_of_work(*nodes))
        self.m = washer_model(self.par)
        self.bench = Bench(self.par, self.work[kernel.N_HEAD :])
        self.f = washer_fields(self.m, self.bench.work)
        a = N_INFO + kernel.N_FOUND
        b = a + N_WALK
        self.info, self.walk = self.work[:N_INFO], self.work[a:b]
        self.out = self.work[b : b + kernel.N_ALL]
        self.q = self.work[kernel.N_HEAD - 4 : kernel.N_HEAD]
        self.walk[ACCURACY] = 1e-8

    def _check(self, code: int, where: str) -> None:
        if code:
            raise SolveError(
                f"load_curve: {Status(code).advice} ({where}, film of "
                f"{self.walk[S] / self.m.sigma1:.2f} sigma, speed = {self.pt.speed:g} rad/s, "
                f"tilt = {self.pt.tilt:g} rad; tried: steps down to 1e-4 of the first); "
                "use another grid"
            )

    def enter(self, load: float) -> None:
        """Go to where the washer carries less than ``load`` [N]."""
        self._check(enter_curve(self.bench, self.pt, 6.0, self.q, self.info, self.walk), "entry")
        while self.walk[W] > load and self.walk[S] < 1e3 * self.m.sigma1:
            self.to(1.25 * self.walk[S])

    def to(self, s: float) -> None:
        """Walk to a film thickness [m]."""
        self._check(walk_to(self.bench, self.pt, s, self.q, self.info, self.walk), "walking")

    def fold(self, kind: str, upper: float, lower: float) -> Fold:
        """Locate a fold between two film thicknesses and come back."""
        kept = [a.copy() for a in (self.q, self.f.temp, self.f.p, self.walk)]
        self._check(
            find_fold(self.bench, self.pt, upper, lower, self.q, self.info, self.walk), kind
        )
        load = float(self.walk[W])
        out = self.outputs()
        for a, b in zip((self.q, self.f.temp, self.f.p, self.walk), kept, strict=True):
            a[:] = b
        self.f.tag[0] = 0.0
        return Fold(kind, load, out[RATIO], out[MEAN_TEMPERATURE], out[TORQUE])

    def outputs(self) -> list[float]:
        """Return all outputs where the walker stands."""
        pt = self.pt._replace(load=float(self.walk[W]))
        washer_outputs(self.m, pt, self.q, self.f, self.out)
        return [float(x) for x in self.out]

    def result(self, fidelity: str) -> WasherResult:
        """Return a result where the walker stands; its branch is not known yet."""
        pt = self.pt._replace(load=float(self.walk[W]))
        self.outputs()
        state = np.zeros(size_of_state(*self.nodes))
        remember_state(self.bench, pt, self.q, state)
        state[RATIO_THEN] = self.out[RATIO]
        state[SCAN_SPEED], state[SCAN_TILT], state[SCAN_OIL] = pt.speed, pt.tilt, pt.oil_temperature
        point = (pt.load, pt.speed, pt.tilt, pt.oil_temperature)
        return result_from(
            self.params, point, fidelity, self.nodes, state, self.work, Status.OK, 1.0, False,
            ERRORS[fidelity],
        )  # fmt: skip


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
    walker = _Walker(params, point, nodes)
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
