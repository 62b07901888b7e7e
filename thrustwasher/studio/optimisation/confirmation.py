"""Designs that are shown: solved again on the finest means, those that still hold."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...errors import SolveError
from .archive import Archive
from .design_problem import Problem, shown
from .designs import Array, figures_to_search
from .front import spread
from .multistart import (
    NEAR,
    Means,
    design_text,
    least_below,
    restore_feasibility,
    search_from,
    searched,
)
from .optimum import Design
from .worker_pool import WorkerPool

BINDS = 0.01  # of a limit's figure, or of a variable's range: as near as that it binds
MORE = 1.3  # designs solved again for one of the front
AGAIN = 3  # designs that are solved again, of those for one figure


def solved_again(pool: WorkerPool, archive: Archive, places: Sequence[int]) -> list[Design]:
    """Return designs with all figures, solved on the finest means."""
    designs = pool.designs
    rows = [archive.row(place) for place in places]
    names = tuple(dict.fromkeys([*archive.problem.figures, *figures_to_search(designs)]))
    values = pool.figures(rows, names, whole=True, each=1)
    return [
        Design(
            values=row,
            figures=dict(zip(names, own.tolist(), strict=True)),
            text=designs.file(row),
        )
        for row, own in zip(rows, values, strict=True)
    ]


def values_of(problem: Problem, designs: Sequence[Design]) -> Array:
    """Return the figures that count (n, m)."""
    return np.array([[d.figures[name] for name in problem.figures] for d in designs])


def costs_of(problem: Problem, designs: Sequence[Design]) -> Array:
    """Return what is to be small (n, goals)."""
    return problem.costs(values_of(problem, designs))


def _confirmed(problem: Problem, designs: Sequence[Design]) -> list[Design]:
    """Return those that meet the limits when solved again."""
    values = values_of(problem, designs).reshape(len(designs), -1)
    sound = np.isfinite(values).all(1) & (problem.excess(values) <= 0.0).all(1)
    return [designs[i] for i in np.flatnonzero(sound).tolist()]


def best_design(means: Means, archive: Archive) -> tuple[Archive, Design]:
    """Return the best design for one figure, and what was tried for it.

    What it lacks when it is solved again is made up for once, by tighter limits. SolveError: it
    then has no figures, or misses a limit still.
    """
    problem = archive.problem
    archive = _polished(means, archive)
    for again in (False, True):
        places = _feasible_ranked(archive)[:AGAIN]
        solved = solved_again(means.pool, archive, places)
        if confirmed := _confirmed(problem, solved):
            best = min(confirmed, key=lambda d: float(costs_of(problem, [d])[0, 0]))
            return archive, best
        values = values_of(problem, solved)
        there = np.isfinite(values).all(1)
        if not there.any():
            raise _gone(archive, places[0])
        if again:
            raise _missed(problem, values[there][0])
        before = problem.excess(archive.values[places])
        lacking = (problem.excess(values) - before)[there].max(0)
        archive = replace(archive, margins=archive.margins + np.maximum(lacking, 0.0))
        archive = searched(means, archive, [search_from(means, archive, places[0], 0, NEAR)])
        archive = restore_feasibility(means, archive)
    raise AssertionError  # the second turn has an end


def _polished(means: Means, archive: Archive) -> Archive:
    """Search on the finest means from the best design, if the budget says so."""
    tries = means.budget.polish
    if not tries:
        return archive
    place = int(archive.ranked(0)[0])
    last = search_from(means, archive, place, 0, NEAR, tries=tries, whole=True)
    return searched(means, archive, [last])


def _feasible_ranked(archive: Archive) -> list[int]:
    """Return the places of the feasible designs by rising cost."""
    order = archive.ranked(0)
    found: list[int] = order[archive.violation[order] <= 0.0].tolist()
    return found


def _gone(archive: Archive, place: int) -> SolveError:
    problem = archive.problem
    return SolveError(
        f"the best design has no {', '.join(problem.figures)} when it is solved again, at "
        f"{design_text(problem, archive.row(place))}; narrow the ranges"
    )


def _missed(problem: Problem, values: Array) -> SolveError:
    limit = problem.limits[int(problem.excess(values[np.newaxis])[0].argmax())]
    value = values[problem.figures.index(limit.figure.name)]
    return SolveError(
        f"{limit.words} is met while searching but not when the design is solved again: "
        f"{shown(limit.figure, value)}; set the limit a little wider or narrow the ranges"
    )


def front_designs(means: Means, archive: Archive, tops: Sequence[float]) -> tuple[Design, ...]:
    """Return the designs of the front, solved again, those that are still unbeaten.

    ``tops``: the values of the second cost that were aimed at.
    """
    problem, feasible, most = archive.problem, archive.feasible, int(MORE * means.points)
    more = feasible[spread(archive.costs[feasible], most)].tolist()
    chosen = list(dict.fromkeys([*least_below(archive, tops), *more]))[:most]
    if means.pool.designs.kind == "part":  # solved again it is the same
        chosen = chosen[: means.points]
    confirmed = _confirmed(problem, solved_again(means.pool, archive, sorted(chosen)))
    if not confirmed:
        raise SolveError(
            "no design of the front has its figures within the limits when it is solved again; "
            "set these a little wider or narrow the ranges"
        )
    if problem.robust is not None:  # their own costs are those of the draws
        return tuple(confirmed[: means.points])
    return tuple(confirmed[i] for i in spread(costs_of(problem, confirmed), means.points))


def active_bounds(archive: Archive, best: Design) -> tuple[str, ...]:
    """Return the limits and ends of ranges that the best design touches."""
    problem = archive.problem
    excess = problem.excess(values_of(problem, [best]))[0]
    near = np.abs(excess) <= BINDS * archive.scales[archive.limit_columns]
    found = [x.words for x, touches in zip(problem.limits, near, strict=True) if touches]
    for v in problem.variables:
        share = (best.values[v.name] - v.low) / (v.high - v.low)
        if min(share, 1.0 - share) <= BINDS:
            end, sign = (v.low, ">=") if share < 0.5 else (v.high, "<=")
            found.append(f"{v.name} {sign} {v.text(end)}")
    return tuple(found)
