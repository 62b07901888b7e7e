"""Work in pieces, each done once: from a journal, by this process, or on all cores."""

from collections.abc import Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Protocol, Self

import numpy as np

from ...storage.journal import Journal
from ..evaluators.evaluator import Effort
from ..jobs.runner import Progress, Runner, Work
from .design_problem import Problem
from .designs import Array, Designs, Row
from .under_scatter import Uniforms, judged_by

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
        effort: Effort = "shown" if self.whole else "search"
        return by.evaluate(self.rows, self.figures, effort).values


class WorkerPool:
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
        self._runner, self._journal, self._show = Runner(workers=workers), journal, progress
        self._done = dict(journal.entries()) if journal else {}
        self._number = self._passed = 0

    def __enter__(self) -> Self:
        self._runner.__enter__()
        self._tell(0)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._runner.__exit__(kind, error, trace)

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

        def take(job: tuple[int, Piece], answer: Array) -> None:
            number, piece = job
            found[number] = answer
            if self._journal:
                self._journal.put(number, np.ascontiguousarray(answer).tobytes())
            self._tell(piece.tries)

        self._runner.run(
            Work(
                solve=_tried,
                context=(self.designs, self.problem),
                open_jobs=lambda _: (job for job in todo if job[0] not in found),
                take=take,
                size=lambda job: job[1].tries,
                left=lambda: self.planned - self._passed,
            )
        )
        if self._journal:
            self._journal.flush()
        self.tries += sum(len(answer) for answer in found.values())
        return [found[number] for number in range(first, self._number)]

    def _tell(self, tries: int) -> None:
        self._passed += tries
        self.planned = max(self.planned, self._passed)
        if self._show:
            self._show(self._passed, self.planned)


def _tried(designs: Designs, problem: Problem, job: tuple[int, Piece]) -> Array:
    """Return what a piece gives."""
    return job[1].run(designs, problem)
