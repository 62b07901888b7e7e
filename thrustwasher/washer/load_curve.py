"""The whole curve of a washer's solutions over load, with its folds: continuation in the film."""

import dataclasses
import re
from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import ParameterError, SolveError, Status
from ..model.idle import idle_warnings
from ..model.levels import gone_level, level_named
from ..model.parameters import check_number
from ..model.registry import find_model
from ..model.solutions import scalars, words_at_points
from ..numerics.jit import Array
from ..shown import Card, Line, Tabled, Words, column_lines, plain
from ..units import format_quantity
from .kernel_arguments import constants, work_array
from .kernels import continuation
from .kernels import layout as L
from .kernels.constants import washer_model
from .kernels.heat import set_steady
from .kernels.outputs import outputs_at
from .kernels.regime_and_status import point_of
from .kernels.solve import remember_state
from .kernels.whole_curve.points import ROW, follow_curve, name_branches
from .kernels.workspace import fields_of, size_of_state, size_of_work, workspace_of
from .parameters import SPEC, WasherParams
from .sensitivities import Solved, fold_derivatives
from .solve import GRIDS, TILT, check_point, resolve_grid, result_from
from .washer_result import BRANCH_NAMES, FROM_TABLES, Fold, Inputs, WasherResult, advised, lost_text

__all__ = ["Fold", "LoadCurve", "load_curve"]

MOST = next(s.high for s in SPEC.inputs if s.name == "load") or 0.0  # N
WHERE = ("entry", "walking", "at a load")  # the path got stuck


@dataclass(frozen=True, slots=True)
class LoadCurve(Tabled):
    """All solutions at fixed speed, tilt and oil temperature."""

    points: list[WasherResult]  # ordered by falling film_thickness
    folds: list[Fold]  # empty if the curve is single-valued
    about_curve: tuple[str, ...] = ()  # warnings of the curve as a whole

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a reader must not miss: of each kind the point of minimum load; folds tell the rest.

        The last point, beyond the range that was requested, does not count.
        """
        idle = idle_warnings(SPEC.key, self.points[0].params)
        found: dict[str, list[str]] = {}
        points = sorted(self.points[:-1], key=lambda p: p.load)
        for p in points:
            for text in [w for w in p.warnings if w not in idle][p.distress :]:
                line = f"at load = {p.load:.4g} N: {text}"
                found.setdefault(re.split(r"[=\d]", text)[0], []).append(line)
        n = len(points)
        lines = (f"{len(texts)} of {n} points, {texts[0]}" for texts in found.values())
        return (*self.about_curve, *idle, *lines)

    def to_dict(self) -> dict[str, Any]:
        """Return points, folds, parameters and warnings as JSON can hold them, SI units."""
        return {
            "points": [scalars(p) for p in self.points],
            "folds": [plain(fold) for fold in self.folds],
            "params": plain(self.points[0].params),
            "warnings": list(self.warnings),
        }

    def _columns(self) -> dict[str, Any]:
        """Return what differs from point to point: the load, then results in words and numbers."""
        signals, known = {s.name for s in SPEC.inputs}, self._words()
        own = [f.name for f in dataclasses.fields(WasherResult) if f.name not in signals]
        names = ("load", *(name for name in own if name in known), "distress")
        return {name: np.array([getattr(p, name) for p in self.points]) for name in names}

    def _words(self) -> dict[str, Words]:
        return words_at_points(find_model(SPEC.key))

    def _card(self) -> Card:
        folds = (
            Line(
                f.kind,
                format_quantity(f.load, "N"),
                f"load of this fold; film ratio {f.film_ratio:.3g}, "
                f"{format_quantity(f.temperature, 'K')}, "
                f"{format_quantity(f.friction_torque, 'N.m')}",
            )
            for f in self.folds
        )
        lines = [*folds, *column_lines(self._columns(), self._words())]
        at = ", ".join(
            f"{s.name} {format_quantity(getattr(self.points[0], s.name), s.unit)}"
            for s in SPEC.inputs
            if s.name != "load" and not s.optional
        )
        none = () if self.folds else ("No fold: one solution at every load here.",)
        return Card(f"load curve of the washer at {at}", lines, none, self.warnings)

    def fold_sensitivities(
        self, parameters: Collection[str] | None = None
    ) -> list[dict[str, float] | None]:
        """Return next to each of ``folds`` {parameter: derivative of its load}, N per SI unit.

        Exact, without a solve per parameter. None: the fold is too flat to be found by its slope.

        Parameters
        ----------
        parameters : names; by default all real ones but those whose 0 stands for a value from
            elsewhere

        Raises
        ------
        ParameterError : a name is none of them

        Notes
        -----
        At a fold psi F_x = 0 for the residuals F over the unknowns x, so that the load W moves by
        dW/dp = -(psi F_p)/(psi F_W); see docs/theory/sensitivity.md.
        """
        return [fold_derivatives(*self.around(fold), parameters) for fold in self.folds]

    def around(self, fold: Fold) -> tuple[Solved, Solved]:
        """Return the solutions that a fold lies between: of more film, of less."""
        below = next(n for n, p in enumerate(self.points) if p.film_ratio < fold.film_ratio)
        return self.points[max(0, below - 1)].solved(), self.points[below].solved()


def load_curve(
    params: WasherParams,
    *,
    speed: float,
    tilt: float = TILT,
    oil_temperature: float = 297.15,
    far_face_temperature: float = 0.0,
    fidelity: str = "field",
    grid: tuple[int, int] | None = None,
    load_min: float = 20.0,
    load_max: float = 3000.0,
) -> LoadCurve:
    """Return all solutions between two loads and the folds where the film is lost and regained.

    The film thickness is prescribed and the load computed, so the curve is followed through both
    folds and along the unstable branch between them.

    Parameters
    ----------
    params, speed [rad/s], tilt [rad], oil_temperature [K], far_face_temperature [K], fidelity, grid
        as in solve_washer
    load_min, load_max : ends of the curve [N]

    Returns
    -------
    LoadCurve : ``points`` by falling film thickness (each with load and branch), ``folds``

    Raises
    ------
    ParameterError : an argument is outside its range
    SolveError : the path along the curve got stuck

    Notes
    -----
    Folds are extrema of the load, located to 1e-5 sigma in film thickness; a pair whose loads
    differ by less than 3e-4 counts as none.

    Examples
    --------
    >>> curve = load_curve(WasherParams(), speed=545.0, tilt=0.002)
    >>> [f"{fold.kind} {fold.load:.0f} N" for fold in curve.folds]
    ['film_lost 958 N', 'film_regained 659 N']
    """
    level = level_named(SPEC, fidelity)
    nodes = resolve_grid(level, grid)
    load_min = check_number("load_min", load_min, "N", 1.0, MOST)
    load_max = check_number("load_max", load_max, "N", load_min, MOST)
    if load_min == load_max:
        raise ParameterError(
            f"load_max = {load_max:g} N, allowed: above load_min; solve_washer gives one load"
        )
    point = check_point(params, load_min, speed, tilt, oil_temperature, far_face_temperature)
    here = Continuation(params, point, nodes)
    points: list[WasherResult] = []
    folds: list[Fold] = []
    while not here.whole[L.ENDED]:
        folds += here.follow(load_min, load_max)
        points += [here.result(level)] if here.whole[L.POINTS] else []
    return LoadCurve(_labelled(points, folds), folds, gone_level(SPEC, fidelity))


def _labelled(points: list[WasherResult], folds: list[Fold]) -> list[WasherResult]:
    """Name each point's branch; what it says follows."""
    named, branches = [], np.empty(len(points))
    ratios, passed = (np.array([p.film_ratio for p in some]) for some in (points, folds))
    name_branches(ratios, passed, branches)
    for p, number in zip(points, branches.tolist(), strict=True):
        branch = BRANCH_NAMES[number]
        rise = p.temperature - p.oil_temperature
        distress = (bool(folds) and branch == "contact") or rise > 200.0
        messages = (lost_text(p.film_ratio, rise), *p.warnings) if distress else p.warnings
        p._state[L.S_BRANCH] = number
        p._state[L.S_MULTIPLICITY] = L.MULTIPLE if folds else L.SINGLE
        status = advised(p.point(), p.temperature_max, distress, Status.OK)
        named.append(
            dataclasses.replace(
                p, branch=branch, distress=distress, status=status, warnings=messages
            )
        )
    return named


def _fold(kind: str, found: Array) -> Fold:
    """Return a fold; ``found``: its load, its outputs."""
    load, *out = found.tolist()
    return Fold(kind, load, out[L.O_RATIO], out[L.O_MEAN], out[L.O_TORQUE])


class Continuation:
    """A place on the curve of solutions, which moves as its film thickness is prescribed."""

    def __init__(self, params: WasherParams, point: Inputs, nodes: tuple[int, int]) -> None:
        """Begin anywhere; ``point`` (5,) holds the inputs."""
        self.par = par = constants(params, nodes)
        self.params, self.nodes = params, nodes
        self.move(point)
        self.work = work_array(("washer", nodes), L.N_HEAD + size_of_work(*nodes))
        self.w = workspace_of(par, self.work)
        self.m, self.f = washer_model(par), fields_of(self.w)
        self.whole, self.row = np.zeros(L.N_WHOLE), np.empty(ROW)
        set_steady(self.m, self.pt, self.f)
        self.w.curve[L.ACCURACY] = 1e-8

    def move(self, point: Inputs) -> None:
        """Take other inputs; the solution stays that of those before."""
        self.inputs = point
        self.pt = point_of(constants(self.params, self.nodes), np.array(point))

    @property
    def film(self) -> float:
        """Film thickness [m]."""
        return float(self.w.curve[L.AT_FILM])

    @property
    def load(self) -> float:
        """Load [N]."""
        return float(self.w.curve[L.AT_LOAD])

    def copy(self) -> list[Array]:
        """Return what `come_back` takes."""
        return [a.copy() for a in self._moving()]

    def come_back(self, kept: list[Array]) -> None:
        """Go back to where a copy was made."""
        for here, then in zip(self._moving(), kept, strict=True):
            here[:] = then
        self.f.tag[L.TAG_VALID] = 0.0

    def _moving(self) -> list[Array]:
        return [self.w.q, self.f.temp, self.f.p, self.w.curve]

    def _check(self, code: int) -> None:
        if code:
            raise SolveError(
                f"load_curve: {Status(code).advice} ({WHERE[int(self.w.curve[L.STUCK])]}, film of "
                f"{self.film / self.m.sigma1:.2f} sigma, speed = {self.pt.speed:g} rad/s, "
                f"tilt = {self.pt.tilt:g} rad, oil_temperature = {self.pt.oil_temperature:g} K; "
                "tried: steps down to 1e-4 of the first); "
                "use another grid"
            )

    def start(self, ratio: float) -> None:
        """Solve from nothing at a film ratio."""
        self._check(continuation.start_at(self.w, self.pt, ratio))

    def to(self, s: float) -> None:
        """Go to a film thickness [m]; where that gets stuck less exactly, or by load."""
        self._check(continuation.go_to_film(self.w, self.pt, s))

    def follow(self, load_min: float, load_max: float) -> list[Fold]:
        """Go on to the next point of the curve, or its end; return the fold that was passed.

        The fold lies between the last two points, before the one that the call leads to.
        """
        self._check(
            follow_curve(
                self.par, np.array(self.inputs), self.work, load_min, load_max, self.whole, self.row
            )
        )
        kind = {1.0: "film_lost", -1.0: "film_regained"}.get(self.whole[L.FOLD])
        return [_fold(kind, self.whole[L.FOLD_LOAD :])] if kind else []

    def fold(self, kind: str, upper: float, lower: float) -> Fold:
        """Locate a fold between two film thicknesses and come back."""
        way, found = 1.0 if kind == "film_lost" else -1.0, np.empty(1 + L.N_ALL)
        self._check(continuation.locate_fold(self.w, self.pt, way, upper, lower, found))
        return _fold(kind, found)

    def outputs(self) -> list[float]:
        """Return all outputs here."""
        outputs_at(self.w, self.pt._replace(load=self.load))
        return [float(x) for x in self.w.outputs]

    def result(self, fidelity: str) -> WasherResult:
        """Return a result; its branch is not known yet."""
        pt = self.pt._replace(load=self.load)
        state = np.zeros(size_of_state(*self.nodes))
        remember_state(self.w, pt, state)
        state[L.S_RATIO] = self.outputs()[L.O_RATIO]
        state[L.S_SCAN_SPEED], state[L.S_SCAN_TILT] = pt.speed, pt.tilt
        state[L.S_SCAN_OIL] = pt.oil_temperature
        return result_from(
            self.params,
            (pt.load, *self.inputs[1:]),
            fidelity,
            self.nodes,
            state,
            self.work,
            Status.OK,
            L.FILM_BRANCH,
            False,
            FROM_TABLES if self.nodes == GRIDS[fidelity] else None,
        )
