"""What a search needs to know of what it varies: a part, a load curve, a gear shift."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ...model.quantity import Figure, Quantity
from ...model.scatter import Scatter

Array = NDArray[np.float64]
Places = NDArray[np.intp]
Row = Mapping[str, Any]  # values [SI] by name


class Effort(NamedTuple):
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


class Designs(Protocol):
    """What is varied; it can be pickled, for the workers."""

    @property
    def kind(self) -> Literal["part", "scene"]:
        """What it is."""

    @property
    def name(self) -> str:
        """Name of the part or scene."""

    @property
    def places(self) -> Mapping[str, Quantity]:
        """What may be varied, with its value now and its range."""

    @property
    def figures(self) -> Mapping[str, Figure]:
        """Numbers of a design by name."""

    @property
    def identity(self) -> Mapping[str, str]:
        """What makes a search another one, in words by kind; for the journal."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What must not be missed, a line each."""

    @property
    def notes(self) -> tuple[str, ...]:
        """How designs are judged, a line each."""

    def effort(self, figures: Sequence[str], variables: int) -> Effort:
        """Return what a search for these figures does."""

    def solve(self, rows: Sequence[Row], figures: Sequence[str], whole: bool = False) -> Array:
        """Return figures of designs (n, m); NaN where there is none.

        ``whole``: as they are shown at the end, on the finest means; else as a search takes them.
        """

    def slopes(
        self, row: Row, figures: Sequence[str], names: Sequence[str], whole: bool = False
    ) -> tuple[Array, Array] | None:
        """Return figures (m,) and their exact slopes (m, k) over variables; None: not known."""

    def scatter(self, row: Row) -> Scatter:
        """Return how a design scatters about its own values."""

    def shorter_step(
        self, rows: Sequence[Row], figures: Sequence[str], gain: float
    ) -> tuple[float | None, str]:
        """Return the time step [s] that designs need, None if theirs does; and a note.

        ``gain``: of the figure that was searched for, relative; 0: not to be considered.
        """

    def with_step(self, step: float) -> "Designs":
        """Return the same with another time step [s]; ParameterError, SolveError: as when made."""

    def text(self, row: Row) -> str:
        """Return a design as the text of a file that runs."""
