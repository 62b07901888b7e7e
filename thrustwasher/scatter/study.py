"""The runs of a study: in batches of whole base points, on many cores or a cluster, resumable."""

import hashlib
import pickle
import time
from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError
from ..numerics.jit import kernel_digest
from ..processes import refuse_import_by_worker, runner, usable_cores
from ..storage.journal import Journal
from ..sweep.run_sweep import MOST_WORKERS, WORTH, dask_cluster
from .design import Design
from .target import Array, Flags, Target, n_columns

Progress = Callable[[int, int], None]
MOST_NUMBERS = 500_000_000  # 4 GB


class Batch(NamedTuple):
    """Some base points, complete with all that a worker needs to know beside the target."""

    first_row: int
    uniforms: Array  # (n, k)
    costly: NDArray[np.bool_]  # (n,)


class Study:
    """A target and a design; ``costly``: all runs give the costly figures, not only base runs."""

    def __init__(self, target: Target, design: Design, *, costly: bool) -> None:
        self.target, self.design, self.costly = target, design, costly
        numbers = design.n_rows * n_columns(target)
        if numbers > MOST_NUMBERS:
            raise ParameterError(
                f"runs = {design.n}: {numbers * 8e-9:.0f} GB of results, allowed: "
                f"{MOST_NUMBERS * 8e-9:.0f} GB; ask for fewer runs, no indices or fewer outputs"
            )

    def identity(self, **more: Any) -> dict[str, str]:
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
        cluster: str | None = None,
        progress: Progress | None = None,
    ) -> tuple[Array, Flags]:
        """Return what all runs give (n_rows, m) and their codes (n_rows,).

        They do not depend on the workers, nor on a stop in between: a batch is solved as a whole.
        """
        refuse_import_by_worker()
        n_rows = self.design.n_rows
        numbers = np.full((n_rows, n_columns(self.target)), np.nan)
        flags = np.zeros((n_rows, 1), np.int32)
        done = journal.load(numbers, flags) if journal else np.zeros(n_rows, bool)
        todo = [batch for batch in self._batches() if not done[batch.first_row]]
        show = progress or (lambda _done, _total: None)
        n_done = int(done.sum())
        show(n_done, n_rows)

        def take(batch: Batch, answer: tuple[Array, Flags]) -> None:
            nonlocal n_done
            rows = slice(batch.first_row, batch.first_row + len(batch.costly))
            numbers[rows], flags[rows, 0] = answer
            numbers[rows][flags[rows, 0] != 0] = np.nan
            if journal:
                journal.append(batch.first_row, numbers[rows], flags[rows])
            n_done += len(batch.costly)
            show(n_done, n_rows)

        _hand_out(self.target, todo, take, workers, cluster)
        if journal:
            journal.flush()  # a kill while files are written loses nothing
        return numbers, flags[:, 0]

    def _batches(self) -> list[Batch]:
        per_point, found = self.design.rows_per_point, []
        for first, uniforms in self.design.batches():
            costly = np.full(len(uniforms), self.costly)
            costly[::per_point] = True
            found.append(Batch(first, uniforms, costly))
        return found


def check_workers(workers: int | None, cluster: str | None) -> None:
    """Raise ParameterError if the workers make no sense."""
    if workers is not None and not (isinstance(workers, int) and 1 <= workers <= MOST_WORKERS):
        raise ParameterError(f"workers = {workers!r}, allowed: 1 .. {MOST_WORKERS}")
    if workers is not None and cluster is not None:
        raise ParameterError("workers and cluster: allowed: one of them")


def _hand_out(
    target: Target,
    batches: Sequence[Batch],
    take: Callable[[Batch, tuple[Array, Flags]], None],
    workers: int | None,
    cluster: str | None,
) -> None:
    """Solve batches: here until processes pay, then by ``workers`` of them, or on a cluster."""
    todo = list(batches)
    packed = _packed(target, needed=cluster is not None or (workers or 1) > 1)
    began, n_here = time.perf_counter(), 0
    while todo and cluster is None and workers in (None, 1):
        pace = (time.perf_counter() - began) / max(n_here, 1)
        if packed and workers is None and usable_cores() > 1 and pace * len(todo) > WORTH:
            break
        take(todo[0], _solve(target, todo.pop(0)))
        n_here += 1
    if not todo or packed is None:
        return
    job = partial(_solve_packed, packed)
    if cluster is not None:
        with dask_cluster(cluster) as (executor, _):
            for batch, answer in zip(todo, executor.map(job, todo), strict=True):
                take(batch, answer)
        return
    with runner(min(workers or usable_cores(), len(todo))) as run:
        for batch, answer in zip(todo, run(job, todo, 1), strict=True):
            take(batch, answer)


def _packed(target: Target, *, needed: bool) -> bytes | None:
    """Return the target as it goes to workers; None: it cannot, as a function within another."""
    try:
        return pickle.dumps(target)
    except (pickle.PicklingError, AttributeError, TypeError) as problem:
        if not needed:
            return None
        raise ParameterError(
            f"workers: {target.name} cannot be sent to other processes ({problem}); define it at "
            "the top of a module, or use workers = 1"
        ) from None


def _solve_packed(packed: bytes, batch: Batch) -> tuple[Array, Flags]:
    return _solve(_unpacked(packed), batch)


@lru_cache(maxsize=2)
def _unpacked(packed: bytes) -> Target:
    """Return the target, once in a worker: what it keeps between batches stays."""
    found: Target = pickle.loads(packed)
    return found


def _solve(target: Target, batch: Batch) -> tuple[Array, Flags]:
    return target.solve(target.scatter.values(batch.uniforms), batch.costly)
