"""Which runs a study makes: scrambled Sobol' points, groups of sources exchanged between them.

A base point j is a row A_j of independent uniforms. For indices it comes with a second row B_j and,
for each group g of sources, AB_gj: A_j with the columns of the group taken from B_j.

Source: Saltelli et al. 2010, Computer Physics Communications 181, 259-270 (design of its table 2);
Owen 1998 for several independent scrambles of one sequence.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError

Array = NDArray[np.float64]
SCRAMBLES = 8  # independent ones: their differences tell the confidence
LEAST_RUNS, MOST_RUNS = SCRAMBLES, 2**17
MOST_SEED = 2**32 - 1
ROWS = 64  # of a batch, about: a second of a slow model, not too few for warm starts
ROWS_OF_PART = 384  # a washer's draws start one another: a second of them, half the time of each
HALF_CELL = 0.5 / 2**30  # of qmc.Sobol's 30 bits: no point is exactly 0


def rounded_runs(runs: int) -> int:
    """Return the number of base points: ``runs`` or the next power of two; ParameterError."""
    whole = isinstance(runs, int) and not isinstance(runs, bool)
    if not whole or not LEAST_RUNS <= runs <= MOST_RUNS:
        raise ParameterError(
            f"runs = {runs!r}, allowed: a whole number {LEAST_RUNS} .. {MOST_RUNS}, best a power "
            "of two"
        )
    return 1 << (runs - 1).bit_length()


@dataclass(frozen=True, kw_only=True)
class Design:
    """The rows of a study, in the order of its base points: A, B, then AB of each group."""

    a: Array
    """(N, k) uniforms in (0, 1) of the base points; points of one scramble follow each other."""
    b: Array
    """(N, k), of the second points."""
    groups: tuple[tuple[int, ...], ...]
    """Columns of each group that is exchanged; () for a study without indices."""
    rows: int = ROWS
    """Runs of a batch, about."""

    @property
    def n(self) -> int:
        """Base points."""
        return len(self.a)

    @property
    def rows_per_point(self) -> int:
        """Runs that a base point takes."""
        return 2 + len(self.groups) if self.groups else 1

    @property
    def n_rows(self) -> int:
        """Runs in all."""
        return self.n * self.rows_per_point

    @property
    def points_per_batch(self) -> int:
        """Whole base points that are solved together: a power of two, by the design alone."""
        most = max(1, self.rows // self.rows_per_point)
        return min(1 << (most.bit_length() - 1), self.n // SCRAMBLES)

    def batches(self) -> Iterator[tuple[int, Array]]:
        """Yield the first row of each batch with its uniforms (n, k)."""
        step = self.points_per_batch
        for first in range(0, self.n, step):
            yield first * self.rows_per_point, self._rows(slice(first, first + step))

    def _rows(self, points: slice) -> Array:
        a, b = self.a[points], self.b[points]
        if not self.groups:
            return a
        found = np.repeat(a[:, None, :], self.rows_per_point, axis=1)
        found[:, 1] = b
        for g, group in enumerate(self.groups):
            found[:, 2 + g, list(group)] = b[:, list(group)]
        return found.reshape(-1, a.shape[1])


def make_design(
    n: int, k: int, groups: Sequence[tuple[int, ...]], seed: int, rows: int = ROWS
) -> Design:
    """Return the design of ``n`` base points (a power of two from 8 on) of ``k`` sources.

    The base points are the same with and without ``groups``. ParameterError: wrong seed.
    """
    from scipy.stats import qmc  # late: it takes a third of a second

    whole = isinstance(seed, int) and not isinstance(seed, bool)
    if not whole or not 0 <= seed <= MOST_SEED:
        raise ParameterError(f"seed = {seed!r}, allowed: a whole number 0 .. {MOST_SEED}")
    parts = []
    for own in np.random.SeedSequence(seed).spawn(SCRAMBLES):
        random = np.random.default_rng(own)
        drawn = qmc.Sobol(2 * k, scramble=True, seed=random).random(n // SCRAMBLES)
        # Some pairs of columns are uneven in few points: other ones in each scramble.
        parts.append(drawn[:, random.permutation(2 * k)])
    points = np.concatenate(parts) + HALF_CELL
    return Design(a=points[:, :k], b=points[:, k:], groups=tuple(groups), rows=rows)
