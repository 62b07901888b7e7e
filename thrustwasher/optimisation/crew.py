"""Work in pieces, each done once: from a journal, by this process, or on all cores."""

import pickle
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from functools import lru_cache, partial
from types import TracebackType
from typing import Any, Protocol

import numpy as np

from ..processes import Run, run_here, runner, usable_cores
from ..storage.journal import Journal
from ..sweep.run_sweep import WORTH
from .design_problem import Problem
from .designs import Array, Designs, Row
from .under_scatter import Uniforms, judged_by

Progress = Callable[[int, int], None]
ROWS = 32  # of a piece: a second of a slow model


class Piece(Protocol):
    """Some designs, tried together."""

    @property
    def tries(self) -> int:
        """Designs at most."""

    def width(self, problem: Problem) -> int:
        """Return how many numbers each design gives."""

    def run(self, designs: Designs, problem: Problem) -> Array:
        """Return a row for each design."""


@dataclass(frozen=True, kw_only=True)
class Given:
    """Designs that are known beforehand."""

    rows: tuple[Row, ...]
    figures: tuple[str, ...]
    whole: bool = False
    uniforms: Uniforms = ()

    @property
    def tries(self) -> int:
        """How many they are."""
        return len(self.rows)

    def width(self, _problem: Problem) -> int:
        """Return the number of figures."""
        return len(self.figures)

    def run(self, designs: Designs, problem: Problem) -> Array:
        """Return their figures (n, m)."""
        by = judged_by(designs, problem, self.uniforms)
        return by.solve(self.rows, self.figures, self.whole)


class Crew:
    """Does pieces in their order; the answers depend neither on the workers nor on a stop."""

    def __init__(
        self,
        designs: Designs,
        problem: Problem,
        *,
        planned: int,
        workers: int | None = None,
        journal: Journal | None = None,
        progress: Progress | None = None,
    ) -> None:
        self.designs, self.problem, self.planned = designs, problem, planned
        self.tries = 0
        """Designs that were tried."""
        self._workers, self._journal, self._show = workers, journal, progress
        self._done = dict(journal.entries()) if journal else {}
        self._number = self._passed = 0
        self._run: Run | None = None
        self._stack = ExitStack()

    def __enter__(self) -> "Crew":
        self._stack.__enter__()
        self._tell(0)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.__exit__(kind, error, trace)

    def figures(
        self, rows: Sequence[Row], names: Sequence[str], *, each: int = ROWS, **more: Any
    ) -> Array:
        """Return figures of designs (n, m), ``each`` so many rows a piece; ``more``: of `Given`."""
        pieces = [
            Given(rows=tuple(rows[i : i + each]), figures=tuple(names), **more)
            for i in range(0, len(rows), each)
        ]
        return np.concatenate(self.do(pieces)) if pieces else np.empty((0, len(names)))

    def do(self, pieces: Sequence[Piece]) -> list[Array]:
        """Return what the pieces give, in their order."""
        first, self._number = self._number, self._number + len(pieces)
        found: dict[int, Array] = {}
        todo = []
        for number, piece in enumerate(pieces, first):
            if number in self._done:
                data = np.frombuffer(self._done[number])
                found[number] = data.reshape(-1, piece.width(self.problem))
                self._tell(piece.tries)
            else:
                todo.append((number, piece))
        for (number, piece), answer in zip(todo, self._answers([p for _, p in todo]), strict=True):
            found[number] = answer
            if self._journal:
                self._journal.put(number, np.ascontiguousarray(answer).tobytes())
            self._tell(piece.tries)
        if self._journal:
            self._journal.flush()
        self.tries += sum(len(answer) for answer in found.values())
        return [found[number] for number in range(first, self._number)]

    def _answers(self, pieces: list[Piece]) -> Iterator[Array]:
        """Yield the answers: here until processes pay, then from them."""
        began, done = time.perf_counter(), 0
        while pieces and self._run is None and self._workers in (None, 1):
            pace = (time.perf_counter() - began) / max(done, 1)
            left = pace * (self.planned - self._passed)
            if done and self._workers is None and usable_cores() > 1 and left > WORTH:
                break
            done += pieces[0].tries
            yield pieces.pop(0).run(self.designs, self.problem)
        if not pieces:
            return
        if self._run is None:
            n = self._workers or usable_cores()
            self._run = self._stack.enter_context(runner(n)) if n > 1 else run_here
        job = partial(_run_packed, pickle.dumps((self.designs, self.problem)))
        yield from self._run(job, pieces, 1)

    def _tell(self, tries: int) -> None:
        self._passed += tries
        self.planned = max(self.planned, self._passed)
        if self._show:
            self._show(self._passed, self.planned)


def _run_packed(packed: bytes, piece: Any) -> Array:
    designs, problem = _unpacked(packed)
    found: Array = piece.run(designs, problem)
    return found


@lru_cache(maxsize=2)
def _unpacked(packed: bytes) -> tuple[Designs, Problem]:
    """Return both, once in a worker: what they keep between pieces stays."""
    found: tuple[Designs, Problem] = pickle.loads(packed)
    return found
