"""Does measured friction depend on load? The law says no; here the points are asked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .clutch_fit import Problem
from .clutch_information import Information

Array = NDArray[np.float64]

SAME_LOAD = 1e-6  # relative spread of loads below which there is nothing to compare
FOLLOWS = 1e-4  # share of the load's spread that the law's constants must leave free


@dataclass(frozen=True, slots=True)
class LoadTest:
    """Whether the residuals follow the load, the law's constants allowed to give way."""

    change: float | None
    """[-] change of friction over the range of loads, relative to its mean; None: no test."""
    p_value: float | None
    """Probability of a change as large if friction did not depend on load."""
    text: str

    @property
    def is_significant(self) -> bool:
        """True if a test at the 1 % level finds a dependence on load."""
        return self.p_value is not None and self.p_value < 0.01


def load_test(
    problem: Problem, best: Array, load: Array, told: Information, known_errors: bool
) -> LoadTest:
    """Return the test of a term linear in load beside the law's own constants.

    Parameters
    ----------
    problem, best, told : the fit and what it tells
    load : (points,) [N]
    known_errors : the weights are one over known standard deviations
    """
    spread = float(np.ptp(load))
    if spread <= SAME_LOAD * float(load.max()):
        return LoadTest(None, None, "all points have one load: its influence cannot be tested")
    if told.freedom < 2:
        return LoadTest(None, None, "too few points to test the influence of load")
    column = (load - load.mean()) / spread * problem.weight
    basis = np.linalg.svd(problem.slopes(best) * problem.scale, full_matrices=False)[0]
    basis = basis[:, : told.rank]
    free = column - basis @ (basis.T @ column)
    if free @ free < FOLLOWS * (column @ column):
        text = "load changes only together with speed: its influence cannot be told from speed's"
        return LoadTest(None, None, text)
    return _tested(problem, best, free, load, told.freedom - 1, known_errors)


def _tested(
    problem: Problem, best: Array, free: Array, load: Array, freedom: int, known_errors: bool
) -> LoadTest:
    """Return the size of the term and its significance."""
    from scipy.stats import norm, t

    misfit = -problem.misfit(best)
    slope = float(free @ misfit / (free @ free))
    left = max(problem.cost(best) - slope * slope * float(free @ free), 0.0)
    floor = 1e-13 * float(np.abs(problem.friction * problem.weight).max())
    deviation = max(1.0 if known_errors else float(np.sqrt(left / freedom)), floor)
    score = abs(slope) * float(np.sqrt(free @ free)) / deviation
    p_value = 2.0 * float(norm.sf(score) if known_errors else t.sf(score, freedom))
    change = slope / float(problem.friction.mean())
    where = f"from {load.min():g} to {load.max():g} N"
    if p_value < 0.01:
        text = (
            f"friction changes by {100 * change:+.2g} % {where}, more than scatter explains "
            f"(p = {p_value:.2g}); the law knows no load, fit narrower ranges of load one by one"
        )
    else:
        text = (
            f"no dependence on load beyond the scatter ({100 * change:+.2g} % {where}, "
            f"p = {p_value:.2g})"
        )
    return LoadTest(change, p_value, text)
