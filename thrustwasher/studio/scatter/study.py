"""The runs of a study: in batches of whole base points, on many cores or a cluster, resumable."""

import hashlib
import pickle
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from ...native.files import to_stderr
from ...numerics.jit import kernel_digest
from ...storage.journal import Journal
from ..evaluators.evaluator import Array, Codes
from ..jobs.rows import Rows
from ..jobs.runner import Progress, Runner, Work
from .design import Design
from .target import Target

MOST_NUMBERS = 500_000_000  # 4 GB


class Batch(NamedTuple):
    """Some base points, complete with all that a worker needs to know next to the target."""

    first_row: int
    uniforms: Array  # (n, k)
    costly: NDArray[np.bool_]  # (n,)


class Study:
    """A target and a design; ``costly``: all runs give the costly figures, not only base runs."""

    def __init__(self, target: Target, design: Design, *, costly: bool) -> None:
        self.target, self.design, self.costly = target, design, costly
        numbers = design.n_rows * target.n_columns
        if numbers > MOST_NUMBERS:
            raise ParameterError(
                f"runs = {design.n}: {numbers * 8e-9:.0f} GB of results, allowed: "
                f"{MOST_NUMBERS * 8e-9:.0f} GB; ask for fewer runs, no indices or fewer outputs"
            )

    def identity(self, **more: object) -> dict[str, str]:
        """Return what makes this study another one than the next, for its journal."""
        values = self.target.scatter.values(self.design.a[:1])
        return {
            **self.target.identity,
            **{name: str(value) for name, value in more.items()},
            "scatter": hashlib.sha256(repr(values).encode()).hexdigest()[:16],
            "version of thrustwasher": kernel_digest(),
        }

    def run(
        self,
        journal: Journal | None,
        *,
        workers: int | None = None,
        cluster: Any = None,
        progress: Progress | None = None,
    ) -> tuple[Array, Codes]:
        """Return what all runs give (n_rows, m) and their codes (n_rows,).

        They do not depend on the workers, nor on a stop in between: a batch is solved as a whole.
        """
        n_rows = self.design.n_rows
        rows = Rows(
            n=n_rows,
            numbers=np.full((n_rows, self.target.n_columns), np.nan),
            flags=np.zeros((n_rows, 1), np.int32),
            journal=journal,
            progress=progress,
        )
        batches = self._batches()
        if cluster is not None or workers != 1:
            workers = _sendable(self.target, workers, needed=cluster is not None)
        work = Work(
            solve=_solve,
            context=(self.target,),
            open_jobs=lambda _: (b for b in batches if not rows.done[b.first_row]),
            take=lambda batch, found: rows.take(batch.first_row, *found),
            size=lambda batch: len(batch.costly),
            left=lambda: rows.left,
            most=len(batches),
        )
        with Runner(workers=workers, cluster=cluster) as runner:
            runner.run(work)
        if journal:
            journal.flush()  # a kill while files are written loses nothing
        return rows.numbers, rows.flags[:, 0]

    def _batches(self) -> list[Batch]:
        per_point, found = self.design.rows_per_point, []
        for first, uniforms in self.design.batches():
            costly = np.full(len(uniforms), self.costly)
            costly[::per_point] = True
            found.append(Batch(first, uniforms, costly))
        return found


def _sendable(target: Target, workers: int | None, *, needed: bool) -> int | None:
    """Return the workers for a target: one if it cannot go to others, as a function in another."""
    try:
        pickle.dumps(target)
    except (pickle.PicklingError, AttributeError, TypeError) as problem:
        if not needed and workers is None:
            to_stderr(
                f"{target.name} cannot be sent to other processes ({problem}); it runs in one"
            )
            return 1
        raise ParameterError(
            f"workers: {target.name} cannot be sent to other processes ({problem}); define it at "
            "the top of a module, or use workers = 1"
        ) from None
    return workers


def _solve(target: Target, batch: Batch) -> tuple[Array, Codes]:
    """Return what the runs of a batch give (n, m), NaN where they failed, and codes (n, 1)."""
    numbers, codes = target.solve(target.scatter.values(batch.uniforms), batch.costly)
    codes = np.asarray(codes, np.int32)[:, np.newaxis]
    return np.where(codes != 0, np.nan, numbers), codes
