"""The draws of the scatter that decide while searching, and the share of fresh ones at the end."""

import math
from dataclasses import dataclass

import numpy as np

from ..scatter.design import make_design
from ..scatter.estimates import probability_bounds
from .design_problem import Problem
from .designs import Array, Row
from .under_scatter import sources_of
from .worker_pool import WorkerPool

DRAWS = 128  # about the best design of a round
JUDGED = 512  # fresh ones, about the design that is found
ENDS = 0.16, 0.84  # quantiles between which a figure of a load curve counts as straight


@dataclass(frozen=True, kw_only=True)
class Share:
    """Share of fresh draws that meet all limits, and its 95 % confidence interval."""

    value: float
    low: float
    high: float
    draws: int
    figures: dict[str, float]
    """The figures wanted, at the quantile requested."""


def drawn(pool: WorkerPool, row: Row, n: int, seed: int, *, straight: bool) -> tuple[Array, Array]:
    """Return uniforms (n, sources) and the figures that count of draws about a design (n, m).

    ``straight``: by lines between two runs for each source; sources with choices are run in any
    case.
    """
    scatter = sources_of(pool.designs, row)
    uniforms = make_design(n, len(scatter.sources), (), seed).a
    values = scatter.values(uniforms)
    if not straight or any(s.place.choices for s in scatter.sources):
        return uniforms, pool.figures([{**row, **own} for own in values], pool.problem.figures)
    ends = {
        s.place.name: np.asarray(s.law.value(np.array(ENDS)), float).tolist()
        for s in scatter.sources
    }
    rows = [row, *({**row, name: x} for name, pair in ends.items() for x in pair)]
    found = pool.figures(rows, pool.problem.figures, each=8)
    moved = found[1:].reshape(len(ends), 2, -1)
    widths = np.array([[high - low] for low, high in ends.values()])
    nominal = {s.place.name: float(s.place.nominal) for s in scatter.sources}
    offsets = np.array([[own[name] - x for name, x in nominal.items()] for own in values])
    return uniforms, found[0] + offsets @ ((moved[:, 1] - moved[:, 0]) / widths)


def critical(
    problem: Problem, uniforms: Array, draws: Array, share: float
) -> set[tuple[float, ...]]:
    """Return the uniforms of the draws (n, m) at that quantile, of each goal and limit."""
    place = math.ceil(share * len(draws)) - 1
    found = set()
    for column in (*problem.costs(draws).T, *problem.excess(draws).T):
        order = np.argsort(np.where(np.isnan(column), np.inf, column))
        found.add(tuple(uniforms[order[place]].tolist()))
    return found


def judged(problem: Problem, draws: Array) -> Share:
    """Return the share of draws (n, m) that meet all limits."""
    sound = np.isfinite(draws.sum(1))
    with np.errstate(invalid="ignore"):
        met = sound & (problem.excess(draws) <= 0.0).all(1)
    low, high = probability_bounds(met.astype(float))
    assert problem.robust is not None
    costs = np.sort(problem.costs(np.where(sound[:, np.newaxis], draws, np.nan)), axis=0)
    at = costs[math.ceil(problem.robust * len(draws)) - 1]  # NaN is sorted to the end
    signs = [-1.0 if g.most else 1.0 for g in problem.goals]
    names = [g.figure.name for g in problem.goals]
    return Share(
        value=float(met.mean()),
        low=low,
        high=high,
        draws=len(draws),
        figures={n: float(x * sign) for n, x, sign in zip(names, at, signs, strict=True)},
    )
