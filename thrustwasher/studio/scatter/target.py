"""What a study needs to know of what it studies: a part, a gear shift, a function."""

from collections.abc import Iterable, Mapping
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from ...model.quantity import Figure
from ...model.scatter import Scatter

Array = NDArray[np.float64]
Flags = NDArray[np.int32]


class Target(Protocol):
    """What is studied; it can be pickled, for the workers."""

    @property
    def name(self) -> str:
        """Name of the part, scene or function."""

    @property
    def kind(self) -> Literal["part", "scene", "function"]:
        """What it is."""

    @property
    def scatter(self) -> Scatter:
        """What scatters in it."""

    @property
    def figures(self) -> tuple[Figure, ...]:
        """Numbers of a run."""

    @property
    def outcomes(self) -> tuple[str, ...]:
        """What a run says yes (1) or no (0) to, such as ``film_lost``."""

    @property
    def series(self) -> tuple[str, ...]:
        """Signals over ``time``; () if there are none."""

    @property
    def time(self) -> Array:
        """(n_t,) [s], common to all runs; empty without ``series``."""

    @property
    def costly(self) -> tuple[str, ...]:
        """Figures that only runs with ``costly`` give; elsewhere they are NaN."""

    @property
    def identity(self) -> Mapping[str, str]:
        """What makes a study of this target another one, in words by kind; for the journal."""

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why a run failed, by its code less one."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What must not be missed of it, a line each."""

    def touches(self, source: str) -> bool:
        """Tell if any figure but the costly ones depends on a source."""

    def nominal(self) -> Array:
        """Return what the run at the nominal values gives (m,): see ``solve``."""

    def solve(self, rows: list[dict[str, Any]], costly: NDArray[np.bool_]) -> tuple[Array, Flags]:
        """Return what runs give: (n, m) and their codes (n,).

        The columns are figures, outcomes, then the series, signal by signal. Code 0 is a sound run;
        with another the row is NaN and ``reasons`` says why. The answers depend on ``rows`` and
        ``costly`` alone, of all of them: neighbours may start one another.
        """

    def why(self, row: Mapping[str, object]) -> str:
        """Return in words why a row failed; "" if only its run can tell."""

    def doubts(self, base: Array) -> Iterable[str]:
        """Return what single runs would warn of, with the base runs (N, m)."""

    def error(self) -> Mapping[str, float]:
        """Return the numerical error of figures for which it is known, relative."""


def n_columns(target: Target) -> int:
    """Return how many numbers a run gives."""
    alone = len(target.figures) + len(target.outcomes)
    return alone + len(target.series) * len(target.time)
