"""What scatter takes from a limit, and in which share of its draws a design meets all limits."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import ParameterError
from ..model.scatter import Scatter
from ..scatter.design import make_design
from ..scatter.estimates import probability_bounds
from .crew import Crew
from .design_problem import Problem
from .designs import Array, Row

DRAWS = 128  # of every design while it is searched, always the same uniforms
JUDGED = 512  # fresh ones, for the design that is found
ENDS = 0.16, 0.84  # quantiles between which a figure counts as straight
WORST = 10.0  # scales of a figure: a draw without it


@dataclass(frozen=True, kw_only=True)
class Margins:
    """What is added to costs and to what limits are exceeded by."""

    goals: Array
    limits: Array


@dataclass(frozen=True, kw_only=True)
class Share:
    """Share of fresh draws that meet all limits, and its 95 % confidence interval."""

    value: float
    low: float
    high: float
    draws: int
    figures: dict[str, float]
    """The figures wanted, at the quantile asked for."""


def none(problem: Problem) -> Margins:
    """Return no margins."""
    return Margins(goals=np.zeros(len(problem.goals)), limits=np.zeros(len(problem.limits)))


def drawn(crew: Crew, row: Row, n: int, seed: int, *, straight: bool) -> Array:
    """Return the figures that count of ``n`` draws about a design (n, m).

    ``straight``: by lines between two runs for each source; sources with choices are run in any
    case.
    """
    scatter = crew.designs.scatter(row)
    if not scatter.sources:
        raise ParameterError("robust: nothing scatters; add [scatter] to the file")
    values = scatter.values(make_design(n, len(scatter.sources), (), seed).a)
    names = crew.problem.figures
    if not straight or any(s.place.choices for s in scatter.sources):
        return crew.figures([{**row, **own} for own in values], names)
    return _lines(crew, row, scatter, values)


def _lines(crew: Crew, row: Row, scatter: Scatter, values: Sequence[Row]) -> Array:
    ends = scatter_ends(scatter)
    rows = [row, *({**row, name: x} for name, pair in ends.items() for x in pair)]
    found = crew.figures(rows, crew.problem.figures, each=8)
    middle, moved = found[0], found[1:].reshape(len(ends), 2, -1)
    widths = np.array([[high - low] for low, high in ends.values()])
    slopes = (moved[:, 1] - moved[:, 0]) / widths
    offsets = np.array(
        [[own[s.place.name] - float(s.place.nominal) for s in scatter.sources] for own in values]
    )
    drawn: Array = middle + offsets @ slopes
    return drawn


def scatter_ends(scatter: Scatter) -> dict[str, tuple[float, float]]:
    """Return two values of each source, some standard deviation to either side."""
    found = {}
    for source in scatter.sources:
        low, high = np.asarray(source.law.value(np.array(ENDS)), float).tolist()
        found[source.place.name] = low, high
    return found


def margins_of(problem: Problem, draws: Array, at: Array, scales: Array, share: float) -> Margins:
    """Return what ``draws`` (n, m) add to the figures ``at`` the design (m,), in that share."""
    costs, excess = problem.costs(draws), problem.excess(draws)
    own_costs, own_excess = problem.costs(at[np.newaxis])[0], problem.excess(at[np.newaxis])[0]
    of_costs = np.abs(problem.costs(scales[np.newaxis])[0])
    of_limits = scales[[problem.figures.index(x.figure.name) for x in problem.limits]]
    return Margins(
        goals=_quantile(costs - own_costs, of_costs, share),
        limits=_quantile(excess - own_excess, of_limits, share),
    )


def _quantile(moves: Array, scales: Array, share: float) -> Array:
    """Return the value that so many of the rows (n, m) do not exceed; NaN is the worst."""
    worst = WORST * scales
    filled = np.where(np.isnan(moves), worst, np.minimum(moves, worst))
    place = min(math.ceil(share * len(moves)), len(moves)) - 1
    found: Array = np.sort(filled, axis=0)[place]
    return found


def judged(problem: Problem, draws: Array) -> Share:
    """Return the share of draws (n, m) that meet all limits."""
    sound = np.isfinite(draws).all(1)
    with np.errstate(invalid="ignore"):
        met = sound & (problem.excess(draws) <= 0.0).all(1)
    low, high = probability_bounds(met.astype(float))
    assert problem.robust is not None
    zero = np.zeros((1, draws.shape[1]))
    far = np.full(draws.shape[1], np.inf)
    at = margins_of(problem, draws, zero[0], far, problem.robust).goals
    signs = problem.costs(np.ones((1, draws.shape[1])))[0]
    names = [g.figure.name for g in problem.goals]
    return Share(
        value=float(met.mean()),
        low=low,
        high=high,
        draws=len(draws),
        figures=dict(zip(names, (at * signs).tolist(), strict=True)),
    )
