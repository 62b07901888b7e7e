"""The whole search: all over the box, then from the best there, then what is shown solved again."""

import hashlib
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...errors import ParameterError, SolveError
from ...model.part_file import PartFile
from ...numerics.jit import kernel_digest
from ...storage.journal import Journal
from ...storage.whole_files import new_folder, whole_folder
from ...units import format_quantity
from ..evaluators.make import evaluator
from ..jobs.progress import shown
from ..jobs.runner import Progress, check_workers
from ..scatter.design import MOST_SEED
from .confirmation import AGAIN, MORE, active_bounds, best_design, costs_of, front_designs
from .design_problem import Problem, read_problem
from .designs import (
    Budget,
    Designs,
    budget_of,
    figures_to_search,
    notes_of,
    warnings_of,
)
from .front import knee
from .multistart import (
    FAR,
    NEAR,
    Means,
    restore_feasibility,
    sample_box,
    search_front,
    search_goals,
)
from .optimum import Design, Optimum
from .robust_search import validated, with_critical_scenarios
from .worker_pool import WorkerPool

if TYPE_CHECKING:
    from ...shift.scene.scene import Scene

JOURNAL = "optimise.journal"
POINTS = 20  # of a front
MOST_POINTS = 200
SHORTER = 2  # searches anew with shorter time steps


def optimise(
    target: "str | Path | PartFile | Scene",
    *,
    vary: Mapping[str, str | tuple[float, float]],
    minimise: str | Sequence[str] = (),
    maximise: str | Sequence[str] = (),
    limits: Sequence[str] = (),
    robust: float | None = None,
    points: int = POINTS,
    seed: int = 1,
    at: Mapping[str, object] | None = None,
    reached: str = "below",
    workers: int | None = None,
    out: str | Path | None = None,
    progress: bool | Progress | None = None,
    finish: Callable[[Optimum, Path], None] | None = None,
) -> Optimum:
    """Return the design of a part or a gear shift with the minimum or maximum of a figure.

    Parameters
    ----------
    target : a part (``load_part``), a scene (``load_scene``), the path of such a file, the name of
        a model or a built-in scene
    vary : what is varied by name (of a scene by path) between two values: "0.3 um:1 um", or two
        numbers [SI]
    minimise, maximise : figures: one, or two for a front. Of a washer ``film_lost_load`` and
        ``film_regained_load`` are figures too, the loads of the folds of its load curve
    limits : "FIGURE<=VALUE" or "FIGURE>=VALUE"
    robust : share of the draws of the scatter in which all limits are to be met, 0.5 .. 0.999;
        figures count at that quantile
    points : designs of a front, 3 .. 200
    seed : of the sample, 0 .. 2^32 - 1; the same seed gives the same designs
    at : inputs of a part [SI or with units]; others as in ``propagate``
    reached : of a washer: "below" or "above", as in ``propagate``
    workers : processes; None: one per core where they pay
    out : folder for the journal while it runs, then for ``best.toml`` and, of a front,
        ``front.csv`` and ``front-NN.toml``
    progress : True: a bar of tqdm, or a line, on the terminal; or called with designs tried and
        planned
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
    show = shown(progress, "optimise")
    for name, value, low, high in (
        ("points", points, 3, MOST_POINTS),
        ("seed", seed, 0, MOST_SEED),
    ):
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise ParameterError(f"{name} = {value!r}, allowed: a whole number {low} .. {high}")
    designs = designs_of(target, at or {}, reached)
    part = getattr(designs, "part", None)
    named = str if part is None else part.own_name
    problem = read_problem(
        designs.quantities,
        figures_to_search(designs),
        vary={named(name): ends for name, ends in vary.items()},
        minimise=[*map(named, [minimise] if isinstance(minimise, str) else minimise)],
        maximise=[*map(named, [maximise] if isinstance(maximise, str) else maximise)],
        limits=[*map(named, limits)],
        robust=robust,
    )
    folder = None if out is None else Path(out)
    journals: list[Journal] = []
    finished = False

    def searched(designs: Designs) -> Optimum:
        if folder is not None:
            with new_folder(folder):
                name = f"{len(journals) + 1}-{JOURNAL}" if journals else JOURNAL
                if not (folder / JOURNAL).exists():  # those of a search that is given up
                    for file in folder.glob(f"?-{JOURNAL}"):
                        file.unlink()
                identity = _identity(designs, problem, points, seed)
                journals.append(Journal(folder / name, identity, "search"))
        budget = budget_of(designs, problem.figures, len(problem.variables))
        with WorkerPool(
            designs,
            problem,
            planned=_planned(problem, budget, points),
            workers=workers,
            journal=journals[-1] if journals else None,
            progress=show,
        ) as pool:
            return search(Means(pool, budget, points, seed))

    try:
        found = _searched_with_steps_that_do(designs, searched)
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
        for journal in journals:
            journal.close(finished=finished)
    return found


def _identity(designs: Designs, problem: Problem, points: int, seed: int) -> dict[str, str]:
    """Return what makes a search another one, for its journal."""
    asked = repr((problem, points, seed)).encode()
    return {
        **designs.identity,
        "search": hashlib.sha256(asked).hexdigest()[:16],
        "version of thrustwasher": kernel_digest(),
    }


def _searched_with_steps_that_do(
    designs: Designs, searched: Callable[[Designs], Optimum]
) -> Optimum:
    """Return what is found with time steps that are short enough for it, by a search anew.

    What was found stays where the search with shorter steps finds nothing.
    """
    found, tries, notes, warnings = searched(designs), 0, list[str](), list[str]()
    for left in range(SHORTER, -1, -1):
        rows = [d.values for d in (found.best, *found.front[:1], *found.front[-1:])]
        step, error = designs.shorter_step(rows, found.problem.figures, _gain(found))
        if step is None:
            notes.append(error)
            break
        if not left:
            warnings.append(f"{error}; it may do so in its favour")
            break
        try:
            designs = designs.with_step(step)
            again = searched(designs)
        except (ParameterError, SolveError) as problem:
            at = format_quantity(step, "s", digits=4)
            warnings.append(f"{error}; with steps of {at} nothing is found: {problem}")
            break
        notes.append(f"{error}: searched again with shorter ones")
        found, tries = again, tries + found.tries
    return replace(
        found,
        notes=(*found.notes, *filter(None, notes)),
        warnings=(*found.warnings, *warnings),
        tries=tries + found.tries,
    )


def _gain(found: Optimum) -> float:
    """Return what one figure has gained, relative; 0 where the start is no design to beat."""
    problem = found.problem
    start = np.array([[found.start[name] for name in problem.figures]])
    if found.front or problem.robust is not None or not (problem.excess(start) <= 0.0).all():
        return 0.0
    name = problem.goals[0].figure.name
    now, before = found.best.figures[name], found.start[name]
    gain = abs(now - before) / max(abs(before), 1e-300)
    return gain if np.isfinite(gain) else 0.0


def designs_of(target: Any, at: Mapping[str, Any], reached: str) -> Any:
    """Return what is varied; ParameterError if there is no such part or scene."""
    return evaluator(target, at=at, reached=reached).searched()


def _planned(problem: Problem, budget: Budget, points: int) -> int:
    """Return how many designs are tried, about."""
    found = budget.sample + budget.polish
    if len(problem.goals) == 1:
        return found + budget.rounds * budget.starts * budget.tries + AGAIN
    found += budget.starts * budget.tries + budget.rounds * points * (budget.tries // 2)
    return found + int(MORE * points)


def search(means: Means) -> Optimum:
    """Return what is found: a sample, rounds of local searches, what is shown solved again."""
    pool, problem = means.pool, means.pool.problem
    archive, start = sample_box(means)
    two, tops = len(problem.goals) == 2, list[float]()
    for number in range(means.budget.rounds + two):
        archive = with_critical_scenarios(means, archive)
        if two and number > 0:
            archive, found = search_front(means, archive)
            tops = found or tops
        else:
            archive = search_goals(means, archive, FAR if number == 0 else NEAR)
        archive = restore_feasibility(means, archive)
    front: tuple[Design, ...] = ()
    if two:
        front = front_designs(means, archive, tops)
        best = front[knee(costs_of(problem, front))]
    else:
        archive, best = best_design(means, archive)
    share, warnings = None, warnings_of(pool.designs)
    if problem.robust is not None:
        best, share, archive, more = validated(means, archive, best, problem.robust)
        warnings = (*warnings, *more)
    return Optimum(
        target=pool.designs.name,
        kind=pool.designs.kind,
        problem=problem,
        best=best,
        front=front,
        start=start,
        binding=active_bounds(archive, best),
        tries=pool.tries,
        share=share,
        tried=archive.values[:, [problem.figures.index(g.figure.name) for g in problem.goals]],
        feasible=archive.violation <= 0.0,
        warnings=warnings,
        notes=notes_of(pool.designs),
    )
