"""Jobs done by this process until others pay, then by it and others, or on a cluster."""

import pickle
import time
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import lru_cache, partial
from itertools import islice
from types import TracebackType
from typing import Any, Generic, Self, TypeVar

from ...errors import EnvironmentProblem, ParameterError
from ...logs import Carrying, unloaded
from ...processes import local_processes, refuse_import_by_worker, usable_cores
from .cluster import dask_cluster

Job = TypeVar("Job")
Answer = TypeVar("Answer")
Progress = Callable[[int, int], None]

WORTH = 2.0  # [s] of work left; for less it does not pay to start processes
MOST_WORKERS = 256
AHEAD = 2  # jobs that a worker has before it asks for more
RESTARTS = 3


def check_workers(workers: int | None, cluster: object) -> None:
    """Raise ParameterError if the workers make no sense."""
    if workers is not None and not (isinstance(workers, int) and 1 <= workers <= MOST_WORKERS):
        raise ParameterError(f"workers = {workers!r}, allowed: 1 .. {MOST_WORKERS}")
    if workers is not None and cluster is not None:
        raise ParameterError("workers and cluster: allowed: one of them")


@dataclass(frozen=True, kw_only=True)
class Work(Generic[Job, Answer]):
    """Jobs that may be done in any order, by anybody."""

    solve: Callable[..., Answer]
    """``solve(*context, job)``, at the top of a module: workers import it."""
    context: tuple[object, ...] = ()
    """What all jobs share; a worker gets it once, pickled."""
    open_jobs: Callable[[int], Iterator[Job]]
    """The jobs that are not done yet, cut for so many workers."""
    take: Callable[[Job, Answer], None]
    """Takes an answer in; the job is then done."""
    size: Callable[[Job], float]
    left: Callable[[], float]
    """How much is left to do, in what ``size`` counts."""
    most: int = MOST_WORKERS
    """Workers that have something to do."""

    def here(self, job: Job) -> None:
        """Do a job in this process."""
        self.take(job, self.solve(*self.context, job))

    @property
    def is_done(self) -> bool:
        """Whether no job is left."""
        return next(self.open_jobs(1), None) is None


@dataclass(kw_only=True)
class Runner:
    """Does work after work; processes, once started, stay to its end.

    ``workers``: processes on this machine, this one among them; None: as many as there are cores
    where that pays. ``cluster``: address of a Dask scheduler, instead.
    """

    workers: int | None = None
    cluster: Any = None
    _stack: ExitStack = field(default_factory=ExitStack, repr=False)
    _executor: Executor | None = field(default=None, repr=False)
    _others: int = 0
    _timed: list[tuple[float, float]] = field(default_factory=list, repr=False)
    """Size and seconds of what was done here, the first one apart: it loads the kernels."""

    def __enter__(self) -> Self:
        refuse_import_by_worker()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.__exit__(kind, error, trace)

    def run(self, work: Work[Job, Answer]) -> None:
        """Do all open jobs; EnvironmentProblem: workers keep ending, or the cluster is not there.

        Whatever stops it, also Ctrl-C, no worker is left at the end of the runner.
        """
        if self.cluster is not None:
            if not work.is_done:
                self._hand_out(work, self._of_cluster(self.cluster), here=False)
            return
        n = min(usable_cores() if self.workers is None else self.workers, work.most)
        if self._executor is None and self._done_here(work, n):
            return
        for _ in range(RESTARTS):
            try:
                self._hand_out(work, self._processes(max(n - 1, 1)), here=True)
                return
            except BrokenProcessPool as problem:
                self._stack.__exit__(type(problem), problem, problem.__traceback__)
                self._executor = None
        raise EnvironmentProblem(
            "worker processes keep ending before their work is done (too little memory, or a "
            'script without: if __name__ == "__main__":); what is done is kept if there is an '
            "output: run the same again, with fewer workers"
        )

    def _done_here(self, work: Work[Job, Answer], n: int) -> bool:
        """Do jobs in this process until others pay; return whether that was all of them."""
        for job in work.open_jobs(1):
            if n > 1 and self._is_worth_it(work):
                return False
            began = time.perf_counter()
            work.here(job)
            self._timed.append((work.size(job), time.perf_counter() - began))
        return True

    def _is_worth_it(self, work: Work[Job, Answer]) -> bool:
        """Tell if other processes pay: they were requested, or there is much left to do."""
        if self.workers is not None:
            return len(list(islice(work.open_jobs(self.workers), 2))) > 1
        sizes = sum(size for size, _ in self._timed[1:])
        seconds = sum(seconds for _, seconds in self._timed[1:])
        return sizes > 0.0 and seconds / sizes * work.left() > WORTH

    def _processes(self, n: int) -> Executor:
        """Return ``n`` processes next to this one, started at the first call."""
        if self._executor is None:
            self._executor, self._others = self._stack.enter_context(local_processes(n)), n
        return self._executor

    def _of_cluster(self, address: Any) -> Executor:
        if self._executor is None:
            self._executor, self._others = self._stack.enter_context(dask_cluster(address))
        return self._executor

    def _hand_out(self, work: Work[Job, Answer], executor: Executor, *, here: bool) -> None:
        """Have jobs done by the executor, some ahead of each worker; with ``here`` by this too."""
        jobs = work.open_jobs(self._others + here)
        solve: Any = partial(_solve_packed, pickle.dumps((work.solve, work.context)))
        of_cluster = self.cluster is not None  # which hands over what its workers log by itself
        solve = solve if of_cluster else Carrying(solve)
        waiting: dict[Future[Any], Job] = {}
        try:
            while True:
                for job in islice(jobs, AHEAD * self._others - len(waiting)):
                    waiting[executor.submit(solve, job)] = job
                own = list(islice(jobs, 1)) if here else []
                for job in own:
                    work.here(job)
                if not own and not waiting:
                    return
                done, _ = wait(waiting, 0.0 if own else None, FIRST_COMPLETED)
                for future in done:
                    answer = future.result() if of_cluster else unloaded(future.result())
                    work.take(waiting.pop(future), answer)
        except BaseException:
            for future in waiting:
                future.cancel()
            raise


def _solve_packed(packed: bytes, job: object) -> Any:
    solve, context = _unpacked(packed)
    return solve(*context, job)


@lru_cache(maxsize=2)
def _unpacked(packed: bytes) -> Any:
    """Return what all jobs share, once in a worker: what it keeps between them stays."""
    return pickle.loads(packed)
