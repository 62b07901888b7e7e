"""Rows of numbers that jobs fill in, each once; what a journal has of them is there already."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...storage.journal import Journal
from .runner import Progress


@dataclass(kw_only=True)
class Rows:
    """``n`` rows of numbers (n, p) and whole numbers (n, q), or (0, p), (0, q): not kept here."""

    n: int
    numbers: NDArray[np.float64]
    flags: NDArray[np.int32]
    journal: Journal | None = None
    progress: Progress | None = None
    done: NDArray[np.bool_] = field(init=False)
    n_done: int = field(init=False, default=0)

    def __post_init__(self) -> None:
        self.done = np.zeros(self.n, bool)
        if self.journal:
            for block in self.journal.blocks(self.numbers.shape[1], self.flags.shape[1]):
                self._keep(*block)
        self._show()

    @property
    def left(self) -> int:
        """Rows that are not done."""
        return self.n - self.n_done

    def take(self, first: int, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> None:
        """Take rows in; the journal writes them within a second or at its end."""
        if self.journal:
            self.journal.append(first, numbers, flags)
        self._keep(first, numbers, flags)
        self._show()

    def _keep(self, first: int, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> None:
        rows = slice(first, first + len(numbers))
        if len(self.numbers):
            self.numbers[rows], self.flags[rows] = numbers, flags
        self.done[rows] = True
        self.n_done += len(numbers)

    def _show(self) -> None:
        if self.progress:
            self.progress(self.n_done, self.n)
