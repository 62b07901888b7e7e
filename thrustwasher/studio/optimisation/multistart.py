"""A sample of the whole box, then local searches from its best: many starts, one archive.

Sources: Sobol' sample: as in ``scipy.stats.qmc``; a front by limits on its second figure: the
epsilon-constraint method, Haimes et al. 1971.
"""

from collections.abc import Sequence
from typing import NamedTuple, Unpack

import numpy as np

from ...errors import SolveError
from .archive import Archive
from .design_problem import Problem, shown
from .designs import Array, Budget, Row
from .front import apart, levels
from .local_search import VIOLATION, LocalSearch, Ways
from .worker_pool import WorkerPool

FAR, NEAR = 0.2, 0.05  # of the box: first steps of the first searches, and of later ones


class Means(NamedTuple):
    """What a search has to search with."""

    pool: WorkerPool
    budget: Budget
    points: int
    """Designs of a front."""
    seed: int


def sample_box(means: Means) -> tuple[Archive, dict[str, float]]:
    """Return designs tried all over the box, and the figures of the one that there is now.

    SolveError: none of them has all figures.
    """
    from scipy.stats import qmc  # late: it takes a third of a second

    pool, problem = means.pool, means.pool.problem
    nominal = {n: float(pool.designs.quantities[n].nominal) for n in problem.names}
    now = problem.point(nominal)
    drawn = qmc.Sobol(len(now), seed=np.random.default_rng(means.seed))
    n = 1 << (means.budget.sample - 1).bit_length()
    points = np.vstack((now, drawn.random(n)))
    rows = [problem.row(u) for u in points]
    values = pool.figures(rows, problem.figures)
    archive = Archive(
        problem=problem,
        points=points,
        values=values,
        scales=_scales(problem, values),
        margins=np.zeros(len(problem.limits)),
    )
    as_it_was = values[0]
    if not np.allclose(list(rows[0].values()), list(nominal.values()), rtol=1e-12, atol=0.0):
        as_it_was = pool.figures([nominal], problem.figures)[0]  # outside the ranges
    return archive, dict(zip(problem.figures, as_it_was.tolist(), strict=True))


def _scales(problem: Problem, values: Array) -> Array:
    """Return the sizes of figures (m,) in a sample (n, m): between its 10 and 90 % quantiles."""
    sound = values[np.isfinite(values).all(1)]
    if not len(sound):
        names = ", ".join(problem.figures)
        raise SolveError(
            f"none of {len(values)} designs has {names}: narrow the ranges that are varied, or "
            "ask for figures that the target has there"
        )
    low, high = np.percentile(sound, [10.0, 90.0], axis=0)
    sizes = np.maximum(np.abs(sound).max(0), 1e-300)
    found: Array = np.maximum(high - low, 1e-3 * sizes)
    return found


def search_from(
    means: Means, archive: Archive, place: int, goal: int, radius: float, **ways: Unpack[Ways]
) -> LocalSearch:
    """Return the local search that begins at a design of the archive."""
    tries: Ways = {"tries": means.budget.tries}
    return LocalSearch(
        start=tuple(archive.points[place].tolist()),
        aim=goal,
        margins=tuple(archive.margins.tolist()),
        uniforms=archive.scenarios,
        scales=tuple(archive.scales.tolist()),
        radius=radius,
        **(tries | ways),
    )


def searched(means: Means, archive: Archive, searches: Sequence[LocalSearch]) -> Archive:
    """Return the archive with what local searches have tried."""
    return archive.with_tried(means.pool.do(searches))


def search_goals(means: Means, archive: Archive, radius: float) -> Archive:
    """Search for the minimum of each goal, from the best that are known."""
    goals = range(len(archive.problem.goals))
    each = max(1, means.budget.starts // len(goals))
    return searched(
        means,
        archive,
        [
            search_from(means, archive, place, goal, radius)
            for goal in goals
            for place in apart(archive.points, archive.ranked(goal), each)
        ],
    )


def search_front(means: Means, archive: Archive) -> tuple[Archive, list[float]]:
    """Search for the minimum first cost at values of the second one, evenly along the front.

    Return the archive and these values; [] and nothing new without a feasible design.
    """
    feasible = archive.feasible
    if not len(feasible):
        return archive, []
    tops = levels(archive.costs[feasible], means.points).tolist()
    tries = means.budget.tries // 2
    searches = [
        search_from(means, archive, place, 0, NEAR, levels=((1, top),), tries=tries)
        for top, place in zip(tops, least_below(archive, tops), strict=True)
    ]
    return searched(means, archive, searches), tops


def least_below(archive: Archive, tops: Sequence[float]) -> list[int]:
    """Return the feasible designs of minimum first cost with at most these values of the second."""
    costs, feasible = archive.costs, archive.feasible
    fitting = (feasible[costs[feasible, 1] <= top] for top in tops)
    return [int(fits[costs[fits, 0].argmin()]) for fits in fitting]


def restore_feasibility(means: Means, archive: Archive) -> Archive:
    """Search for a design inside all limits if there is none yet; SolveError: there is none."""
    if len(archive.feasible):
        return archive
    for radius in (FAR, NEAR):
        starts = apart(archive.points, archive.violation.argsort(), means.budget.starts)
        archive = searched(
            means,
            archive,
            [search_from(means, archive, place, VIOLATION, radius) for place in starts],
        )
        if len(archive.feasible):
            return search_goals(means, archive, NEAR)
    raise _infeasible(archive)


def _infeasible(archive: Archive) -> SolveError:
    """Return what says which limit cannot be met, and the nearest design that was found."""
    problem, columns = archive.problem, archive.limit_columns
    nearest = int(archive.violation.argmin())
    worst = int((archive.excess[nearest] / archive.scales[columns]).argmax())
    limit = problem.limits[worst]
    value = archive.values[nearest, columns[worst]]
    text = f"{limit.words} cannot be met: {shown(limit.figure, value)} is the nearest found"
    others = [x.words for i, x in enumerate(problem.limits) if i != worst]
    if others:
        text += f" with {' and '.join(others)}"
    if problem.robust is not None:
        text += f" at {100.0 * problem.robust:.3g} % of the scatter's draws"
    return SolveError(f"{text}, at {design_text(problem, archive.row(nearest))}")


def design_text(problem: Problem, row: Row) -> str:
    """Return the values of a design as a person reads them."""
    return ", ".join(f"{v.name} = {v.text(row[v.name])}" for v in problem.variables)
