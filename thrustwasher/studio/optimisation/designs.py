"""What a search asks of an evaluator, and how much it does with it."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ...errors import Suggesting
from ...model.quantity import Figure
from ..evaluators.evaluator import Array, Evaluator, Row, some_figures, texts

__all__ = ["Array", "Budget", "Designs", "Places", "Row"]

Places = NDArray[np.intp]
NOTE = (
    "while searching the washers have the torque of the scene's own run; the designs shown here "
    "are run again with their washers solved"
)


class Budget(NamedTuple):
    """How much a search does."""

    sample: int
    """Designs that are tried all over the box."""
    starts: int
    """Searches of each round, for one figure."""
    rounds: int
    tries: int
    """Designs that one search tries at most."""
    polish: int = 0
    """Designs that a last search tries on the finest means."""


class Designs(Evaluator, Protocol):
    """An evaluator whose rows are designs."""

    def shorter_step(
        self, rows: Sequence[Row], figures: Sequence[str], gain: float
    ) -> tuple[float | None, str]:
        """Return the time step [s] that designs need, None if theirs does; and a note.

        ``gain``: of the figure that was searched for, relative; 0: not to be considered.
        """

    def with_step(self, step: float) -> "Designs":
        """Return the same with another time step [s]; ParameterError, SolveError: as when made."""


def budget_of(designs: Designs, figures: Sequence[str], variables: int) -> Budget:
    """Return what a search for these figures does.

    Less where each design takes a whole load curve; a scene has no slopes, as a figure such as the
    jerk has corners.
    """
    if designs.kind == "scene":
        return Budget(sample=64 * variables, starts=4, rounds=2, tries=12 + 5 * variables)
    if any(designs.figures[name].of_curve for name in figures):
        return Budget(sample=3 * variables, starts=2, rounds=1, tries=15, polish=4)
    return Budget(sample=16 * variables, starts=3, rounds=2, tries=60)


def figures_to_search(designs: Designs) -> Suggesting[Figure]:
    """Return the figures that a search can be for."""
    return some_figures(designs, (n for n, f in designs.figures.items() if f.kind == "real"))


def notes_of(designs: Designs) -> tuple[str, ...]:
    """Return how designs are evaluated, a line each."""
    if designs.kind == "scene":
        return (NOTE,) if getattr(designs, "played", None) else ()
    return tuple(filter(None, [getattr(designs, "note", "")]))


def warnings_of(designs: Designs) -> tuple[str, ...]:
    """Return what must not be missed of designs, a line each."""
    return texts(designs.remarks, "warning")
