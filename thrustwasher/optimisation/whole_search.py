"""The whole search: all over the box, then from the best there, then what is shown solved again."""

import hashlib
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ParameterError, SolveError
from ..model.part_file import PartFile
from ..numerics.jit import kernel_digest
from ..scatter.design import MOST_SEED
from ..scatter.propagate import inputs_of, part_or_scene
from ..scatter.study import check_workers
from ..storage.journal import Journal
from ..storage.whole_files import new_folder, whole_folder
from .crew import Crew, Progress
from .design_problem import Limit, Problem, read_problem, shown
from .designs import Array, Designs, Effort, Places
from .front import apart, knee, levels, spread
from .local_search import VIOLATION, LocalSearch
from .optimum import Design, Optimum
from .robustness import DRAWS, JUDGED, Share, critical, drawn, judged
from .under_scatter import Uniforms

if TYPE_CHECKING:
    from ..shift.scene.scene import Scene

JOURNAL = "optimise.journal"
POINTS = 20  # of a front
MOST_POINTS = 200
FAR, NEAR = 0.2, 0.05  # of the box: first steps of the first searches, and of later ones
BINDS = 0.01  # of a limit's figure, or of a variable's range: as near as that it binds
MORE = 1.3  # designs solved again for one of the front
KEPT = 12  # designs that are judged anew by other draws
AGAIN = 3  # designs that are solved again, of those for one figure


def optimise(
    target: "str | Path | PartFile | Scene",
    *,
    vary: Mapping[str, str | tuple[float, float]],
    least: str | Sequence[str] = (),
    most: str | Sequence[str] = (),
    limits: Sequence[str] = (),
    robust: float | None = None,
    points: int = POINTS,
    seed: int = 1,
    at: Mapping[str, Any] | None = None,
    reached: str = "below",
    workers: int | None = None,
    out: str | Path | None = None,
    progress: Progress | None = None,
    finish: Callable[[Optimum, Path], None] | None = None,
) -> Optimum:
    """Return the design of a part or a gear shift with the least or the most of a figure.

    Parameters
    ----------
    target : a part (``load_part``), a scene (``load_scene``), the path of such a file, the name of
        a model or a built-in scene
    vary : what is varied by name (of a scene by path) between two values: "0.3 um:1 um", or two
        numbers [SI]
    least, most : figures wanted: one, or two for a front. Of a washer ``film_lost_load`` and
        ``film_regained_load`` are figures too, the loads of the folds of its load curve
    limits : "FIGURE<=VALUE" or "FIGURE>=VALUE"
    robust : share of the draws of the scatter in which all limits are to be met, 0.5 .. 0.999;
        figures wanted count at that quantile
    points : designs of a front, 3 .. 200
    seed : of the sample, 0 .. 2^32 - 1; the same seed gives the same designs
    at : inputs of a part [SI or with units]; others as in ``propagate``
    reached : of a washer: "below" or "above", as in ``propagate``
    workers : processes; None: one per core where they pay
    out : folder for the journal while it runs, then for ``best.toml`` and, of a front,
        ``front.csv`` and ``front-NN.toml``
    progress : called with designs tried and planned
    finish : called with the result and the folder before it is complete

    Raises
    ------
    ParameterError : something is not allowed, with its name
    SolveError : no design has the figures, or a limit cannot be met: the message says which, and
        the nearest that was found

    Notes
    -----
    Method: a Sobol sample of the box, then local searches from its best, SLSQP with exact slopes
    or COBYQA; a front by limits on its second figure. See docs/command-line/optimise.md. The
    result depends neither on the workers nor on a stop in between.
    """
    began = time.perf_counter()
    check_workers(workers, None)
    for name, value, low, high in (
        ("points", points, 3, MOST_POINTS),
        ("seed", seed, 0, MOST_SEED),
    ):
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise ParameterError(f"{name} = {value!r}, allowed: a whole number {low} .. {high}")
    designs = designs_of(target, at or {}, reached)
    problem = read_problem(
        designs.places,
        designs.figures,
        vary=vary,
        least=[least] if isinstance(least, str) else least,
        most=[most] if isinstance(most, str) else most,
        limits=limits,
        robust=robust,
    )
    folder = None if out is None else Path(out)
    effort = designs.effort(problem.figures, len(problem.variables))
    journal, finished = None, False
    try:
        if folder is not None:
            with new_folder(folder):
                asked = repr((problem, points, seed)).encode()
                identity = {
                    **designs.identity,
                    "search": hashlib.sha256(asked).hexdigest()[:16],
                    "version of thrustwasher": kernel_digest(),
                }
                journal = Journal(folder / JOURNAL, identity, "search")
        with Crew(
            designs,
            problem,
            planned=_planned(problem, effort, points),
            workers=workers,
            journal=journal,
            progress=progress,
        ) as crew:
            found = _Search(crew, effort, points, seed).run()
        found = replace(found, wall_time=time.perf_counter() - began)
        if folder is not None:
            with whole_folder(folder) as draft:
                found.write(draft)
                if finish is not None:
                    finish(found, draft)
        finished = True
    except SolveError:
        finished = True  # the message has all there is
        raise
    finally:
        if journal:
            journal.close(finished=finished)
    return found


def designs_of(target: Any, at: Mapping[str, Any], reached: str) -> Designs:
    """Return what is varied; ParameterError if there is no such part or scene."""
    found = part_or_scene(str(target)) if isinstance(target, str | Path) else target
    if isinstance(found, PartFile):
        from .part_designs import part_designs

        return part_designs(found, inputs_of(found, at), reached)
    if at:
        raise ParameterError("at: is of a part's inputs; a scene has its own")
    from .scene_designs import SceneDesigns

    return SceneDesigns(found)


def _planned(problem: Problem, effort: Effort, points: int) -> int:
    """Return how many designs are tried, about."""
    found = effort.sample + effort.polish
    if len(problem.goals) == 1:
        return found + effort.rounds * effort.starts * effort.tries + AGAIN
    found += effort.starts * effort.tries + effort.rounds * points * (effort.tries // 2)
    return found + int(MORE * points)


@dataclass
class _Tried:
    """All designs tried so far: places in the cube (n, k) and figures (n, m)."""

    points: Array
    values: Array

    def add(self, problem: Problem, blocks: Sequence[Array]) -> None:
        k = len(problem.variables)
        self.points = np.concatenate((self.points, *(b[:, :k] for b in blocks)))
        self.values = np.concatenate((self.values, *(b[:, k:] for b in blocks)))


class _Search:
    """One search, from the sample to the result."""

    def __init__(self, crew: Crew, effort: Effort, points: int, seed: int) -> None:
        self.crew, self.effort, self.n_points, self.seed = crew, effort, points, seed
        self.problem, self.designs = crew.problem, crew.designs
        self.margins = np.zeros(len(self.problem.limits))
        self.uniforms: Uniforms = ()
        self.levels: list[float] = []
        self.warnings: list[str] = []

    def run(self) -> Optimum:
        """Return what is found."""
        start = self._sample()
        two = len(self.problem.goals) == 2
        for number in range(self.effort.rounds + two):
            self._take_the_draws_that_decide()
            if two and number > 0:
                self._aim_along_the_front()
            else:
                self._aim_at_goals(FAR if number == 0 else NEAR)
            self._meet_limits()
        front = self._front() if two else ()
        best = front[knee(self._costs_of(front))] if two else self._best()
        share = None
        if self.problem.robust is not None:
            best, share = self._judge(best)
        columns = [self.problem.figures.index(g.figure.name) for g in self.problem.goals]
        return Optimum(
            target=self.designs.name,
            kind=self.designs.kind,
            problem=self.problem,
            best=best,
            front=front,
            start=start,
            binding=self._binding(best),
            tries=self.crew.tries,
            share=share,
            tried=self.tried.values[:, columns],
            warnings=(*self.designs.warnings, *self.warnings),
            notes=self.designs.notes,
        )

    def _sample(self) -> dict[str, float]:
        """Try designs all over the box; return the figures of the one that there is now."""
        from scipy.stats import qmc  # late: it takes a third of a second

        problem, places = self.problem, self.designs.places
        nominal = {n: float(places[n].nominal) for n in problem.names}
        now = problem.point(nominal)
        drawn = qmc.Sobol(len(now), seed=np.random.default_rng(self.seed))
        n = 1 << (self.effort.sample - 1).bit_length()
        points = np.vstack((now, drawn.random(n)))
        rows = [problem.row(u) for u in points]
        values = self.crew.figures(rows, problem.figures)
        self.tried = _Tried(points, values)
        sound = values[np.isfinite(values).all(1)]
        if not len(sound):
            names = ", ".join(problem.figures)
            raise SolveError(
                f"none of {len(rows)} designs has {names}: narrow the ranges that are varied, or "
                "ask for figures that the target has there"
            )
        low, high = np.percentile(sound, [10.0, 90.0], axis=0)
        sizes = np.maximum(np.abs(sound).max(0), 1e-300)
        self.scales = np.maximum(high - low, 1e-3 * sizes)
        as_it_was = values[0]
        if not np.allclose(list(rows[0].values()), list(nominal.values()), rtol=1e-12, atol=0.0):
            as_it_was = self.crew.figures([nominal], problem.figures)[0]  # outside the ranges
        return dict(zip(problem.figures, as_it_was.tolist(), strict=True))

    # what is tried next

    def _costs(self) -> Array:
        return self.problem.costs(self.tried.values)

    def _excess(self) -> Array:
        """Return by how much each design tried exceeds its limits; inf without figures."""
        found = self.problem.excess(self.tried.values) + self.margins
        found[~np.isfinite(self.tried.values).all(1)] = np.inf
        return found

    def _outside(self) -> Array:
        """Return how far each design is outside its limits in all, in scales (n,)."""
        columns = [self.problem.figures.index(x.figure.name) for x in self.problem.limits]
        outside = np.maximum(self._excess(), 0.0) / self.scales[columns]
        sound = np.isfinite(self.tried.values).all(1)
        return np.where(sound, outside.sum(1), np.inf)

    def _order(self, aim: int) -> Places:
        """Return the places of designs: those inside by their cost, then the others."""
        return np.lexsort((self._costs()[:, aim], self._outside()))

    def _piece(self, place: int, aim: int, radius: float, **more: Any) -> LocalSearch:
        given = {"tries": self.effort.tries, **more}
        return LocalSearch(
            start=tuple(self.tried.points[place].tolist()),
            aim=aim,
            margins=tuple(self.margins.tolist()),
            uniforms=self.uniforms,
            scales=tuple(self.scales.tolist()),
            radius=radius,
            **given,
        )

    def _do(self, pieces: Sequence[LocalSearch]) -> None:
        self.tried.add(self.problem, self.crew.do(pieces))

    def _aim_at_goals(self, radius: float) -> None:
        """Search for the least of each figure, from the best that are known."""
        goals = range(len(self.problem.goals))
        each = max(1, self.effort.starts // len(goals))
        self._do(
            [
                self._piece(place, aim, radius)
                for aim in goals
                for place in apart(self.tried.points, self._order(aim), each)
            ]
        )

    def _aim_along_the_front(self) -> None:
        """Search for the least first figure at values of the second one, evenly along the front."""
        costs = self._costs()
        inside = np.flatnonzero(self._outside() <= 0.0)
        if not len(inside):
            return
        pieces = []
        self.levels = levels(costs[inside], self.n_points).tolist()
        for top, place in zip(self.levels, self._at_levels(), strict=True):
            level: Any = {"levels": ((1, top),), "tries": self.effort.tries // 2}
            pieces.append(self._piece(place, 0, NEAR, **level))
        self._do(pieces)

    def _at_levels(self) -> list[int]:
        """Return the designs with the least first cost at each value of the second one."""
        costs, inside = self._costs(), np.flatnonzero(self._outside() <= 0.0)
        found = []
        for top in self.levels:
            fits = inside[costs[inside, 1] <= top]
            found.append(int(fits[costs[fits, 0].argmin()]))
        return found

    def _meet_limits(self) -> None:
        """Search for a design inside all limits if there is none yet; SolveError: there is none."""
        if (self._outside() <= 0.0).any():
            return
        for radius in (FAR, NEAR):
            starts = apart(self.tried.points, self._outside().argsort(), self.effort.starts)
            self._do([self._piece(place, VIOLATION, radius) for place in starts])
            if (self._outside() <= 0.0).any():
                self._aim_at_goals(NEAR)
                return
        raise self._cannot_be_met()

    def _cannot_be_met(self) -> SolveError:
        nearest = int(self._outside().argmin())
        excess = self._excess()[nearest]
        columns = [self.problem.figures.index(x.figure.name) for x in self.problem.limits]
        worst = int((excess / self.scales[columns]).argmax())
        limit = self.problem.limits[worst]
        value = self.tried.values[nearest, columns[worst]]
        text = f"{limit.words} cannot be met: {shown(limit.figure, value)} is the nearest found"
        others = [x.words for i, x in enumerate(self.problem.limits) if i != worst]
        if others:
            text += f" with {' and '.join(others)}"
        if self.problem.robust is not None:
            text += f" at {100.0 * self.problem.robust:.3g} % of the scatter's draws"
        return SolveError(f"{text}, at {_words(self.problem, self._row(nearest))}")

    def _row(self, place: int) -> dict[str, float]:
        return self.problem.row(self.tried.points[place])

    # scatter

    def _take_the_draws_that_decide(self) -> None:
        """Choose the draws by the best design so far, and judge the next best by them."""
        if self.problem.robust is None:
            return
        place = int(self._order(0)[0])
        straight = self.effort.polish > 0
        found = drawn(self.crew, self._row(place), DRAWS, self.seed, straight=straight)
        self._judge_by(critical(self.problem, *found, self.problem.robust))

    def _judge_by(self, more: set[tuple[float, ...]]) -> None:
        self.uniforms = tuple(sorted({*self.uniforms, *more}))
        places = apart(self.tried.points, self._order(0), KEPT)
        rows = [self._row(place) for place in places]
        values = self.crew.figures(rows, self.problem.figures, uniforms=self.uniforms, each=2)
        self.tried = _Tried(self.tried.points[places], values)

    def _judge(self, best: Design) -> tuple[Design, Share]:
        """Return the best design and the share of fresh draws; if it fails more draws count."""
        assert self.problem.robust is not None
        share, uniforms, draws = self._share(best, self.seed + 1)
        how = "one design of the front is judged"
        if share.value < self.problem.robust and len(self.problem.goals) == 1:
            level = 1.0 - (1.0 - self.problem.robust) / (len(self.problem.limits) + 1)
            how = "which were tightened once"
            try:
                self._judge_by(critical(self.problem, uniforms, draws, level))
                self._aim_at_goals(NEAR)
                self._meet_limits()
                other = self._best()
            except SolveError as problem:
                how = f"which cannot be tightened ({problem})"
            else:
                best, share = other, self._share(other, self.seed + 2)[0]
        if share.value < self.problem.robust:
            self.warnings.append(
                f"robust: {100.0 * share.value:.3g} % of {share.draws} fresh draws meet the "
                f"limits, {how}; {100.0 * self.problem.robust:.3g} % were asked for"
            )
        return best, share

    def _share(self, design: Design, seed: int) -> tuple[Share, Array, Array]:
        """Return the share of fresh draws that meet the limits; their uniforms and figures."""
        found = drawn(self.crew, design.values, JUDGED, seed, straight=False)
        return judged(self.problem, found[1]), *found

    # what is shown

    def _again(self, places: Sequence[int]) -> list[Design]:
        """Return designs with all figures, solved on the finest means."""
        rows = [self._row(place) for place in places]
        names = tuple(dict.fromkeys([*self.problem.figures, *self.designs.figures]))
        values = self.crew.figures(rows, names, whole=True, each=1)
        return [
            Design(
                values=row,
                figures=dict(zip(names, own.tolist(), strict=True)),
                text=self.designs.text(row),
            )
            for row, own in zip(rows, values, strict=True)
        ]

    def _values_of(self, designs: Sequence[Design]) -> Array:
        return np.array([[d.figures[name] for name in self.problem.figures] for d in designs])

    def _costs_of(self, designs: Sequence[Design]) -> Array:
        return self.problem.costs(self._values_of(designs))

    def _inside(self, designs: Sequence[Design]) -> list[Design]:
        """Return those that meet the limits when solved again."""
        values = self._values_of(designs).reshape(len(designs), -1)
        sound = np.isfinite(values).all(1) & (self.problem.excess(values) <= 0.0).all(1)
        return [designs[i] for i in np.flatnonzero(sound).tolist()]

    def _best(self) -> Design:
        """Return the best design for one figure; what it lacks when solved again is made up for."""
        if self.effort.polish:
            place = int(self._order(0)[0])
            self._do([self._piece(place, 0, NEAR, tries=self.effort.polish, whole=True)])
        for again in (False, True):
            order = self._order(0)
            inside = order[self._outside()[order] <= 0.0]
            places = inside[:AGAIN].tolist()
            solved = self._again(places)
            sound = self._inside(solved)
            if sound:
                return min(sound, key=lambda d: float(self._costs_of([d])[0, 0]))
            values = self._values_of(solved)
            there = np.isfinite(values).all(1)
            if not there.any():
                names = ", ".join(self.problem.figures)
                raise SolveError(
                    f"the best design has no {names} when it is solved again, at "
                    f"{_words(self.problem, self._row(places[0]))}; narrow the ranges"
                )
            if again:
                break
            before = self.problem.excess(self.tried.values[places])
            off = (self.problem.excess(values) - before)[there].max(0)
            self.margins = self.margins + np.maximum(off, 0.0)
            self._do([self._piece(places[0], 0, NEAR)])
            self._meet_limits()
        nearest = values[there][0]
        limit = self._missed(nearest)
        value = nearest[self.problem.figures.index(limit.figure.name)]
        raise SolveError(
            f"{limit.words} is met while searching but not when the design is solved again: "
            f"{shown(limit.figure, value)}; set the limit a little wider or narrow the ranges"
        )

    def _missed(self, values: Array) -> Limit:
        return self.problem.limits[int(self.problem.excess(values[np.newaxis])[0].argmax())]

    def _front(self) -> tuple[Design, ...]:
        """Return the designs of the front, solved again, those that are still unbeaten."""
        inside = np.flatnonzero(self._outside() <= 0.0)
        more = inside[spread(self._costs()[inside], int(MORE * self.n_points))].tolist()
        chosen = list(dict.fromkeys([*self._at_levels(), *more]))
        chosen = chosen[: int(MORE * self.n_points)]
        if self.designs.kind == "part":  # solved again it is the same
            chosen = chosen[: self.n_points]
        solved = self._inside(self._again(sorted(chosen)))
        if not solved:
            raise SolveError(
                "no design of the front has its figures within the limits when it is solved again; "
                "set these a little wider or narrow the ranges"
            )
        if self.problem.robust is not None:  # their own costs are those of the draws
            return tuple(solved[: self.n_points])
        return tuple(solved[i] for i in spread(self._costs_of(solved), self.n_points))

    def _binding(self, best: Design) -> tuple[str, ...]:
        """Return the limits and ends that the best design touches."""
        values = self._values_of([best])
        excess = self.problem.excess(values)[0]
        columns = [self.problem.figures.index(x.figure.name) for x in self.problem.limits]
        near = np.abs(excess) <= BINDS * self.scales[columns]
        found = [x.words for x, touches in zip(self.problem.limits, near, strict=True) if touches]
        for v in self.problem.variables:
            share = (best.values[v.name] - v.low) / (v.high - v.low)
            if min(share, 1.0 - share) <= BINDS:
                end, sign = (v.low, ">=") if share < 0.5 else (v.high, "<=")
                found.append(f"{v.name} {sign} {v.place.text(end)}")
        return tuple(found)


def _words(problem: Problem, row: Mapping[str, float]) -> str:
    return ", ".join(f"{v.name} = {v.place.text(row[v.name])}" for v in problem.variables)
