"""How many communication steps a run took, and how long they were."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Steps(NamedTuple):
    """Communication steps taken and rolled back, and the lengths [s] of those taken."""

    accepted: int
    rejected: int
    shortest: float
    longest: float
    located: int
    """Events that became communication points."""
    forced: int
    """Steps of the least length that were taken although they err more than the tolerance."""

    def words(self) -> list[str]:
        """Say what a reader has to know."""
        if not self.forced:
            return []
        return [
            f"{self.forced} steps of the least length err more than master_tolerance; something "
            "jumps there"
        ]


def fixed(n: int, h: float) -> Steps:
    """Return what there is to say of ``n`` equal steps."""
    return Steps(n, 0, h, h, 0, 0)


def varied(time: NDArray[np.float64], rejected: int, located: int, forced: int) -> Steps:
    """Return what there is to say of steps between these times."""
    lengths = np.diff(time)
    return Steps(
        len(lengths), rejected, float(lengths.min()), float(lengths.max()), located, forced
    )
