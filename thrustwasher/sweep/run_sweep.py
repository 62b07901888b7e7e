"""Solve a whole sweep: in this process, on all cores, or on a cluster."""

import sys
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import EnvironmentProblem, ParameterError
from ..model.part_file import PartFile
from ..numerics.jit import kernel_digest
from ..processes import local_processes, refuse_import_by_worker, usable_cores
from ..storage.journal import Journal
from .solve_rows import Task, begin, check_rung, output_signals, solve_task
from .sweep_plan import Plan, make_plan
from .sweep_table import INSTALL, SweepTable, check_output, make_table, pieces, write_table

Progress = Callable[[int, int], None]
WORTH = 2.0  # [s] of work left; for less it does not pay to start processes
MOST_WORKERS = 256
TASK_POINTS = 4096
AHEAD = 2  # tasks that a worker has before it asks for more
RESTARTS = 3
ANSWER_TIME = "10s"  # a cluster that takes longer is taken for absent


def run_sweep(
    model: str | PartFile,
    over: Mapping[str, Any] | None = None,
    *,
    at: Mapping[str, Any] | None = None,
    points: Mapping[str, Any] | None = None,
    params: Any = None,
    fidelity: str | None = None,
    out: str | Path | None = None,
    workers: int | None = None,
    cluster: str | None = None,
    progress: Progress | None = None,
    keep: bool = True,
) -> SweepTable:
    """Return the outputs of a model over all combinations of some inputs and parameters.

    Parameters
    ----------
    model : "washer", "clutch" (slipping for ever) or "gearmesh", or a part (``load_part``)
    over : values by name of an input or parameter (``gearmesh`` takes ``power`` for ``load`` too):
        numbers, or a text such as "50:1850:50", "20:1850:x40", "24 degC, 80 degC"
    at : one value by name for what is held; the rest is at the model's defaults, moved into the
        part's box
    points : instead of ``over``, columns of one length by name: every row is a point
    params : parameter object to start from
    fidelity : rung of the model, or "auto:0.01": the cheapest one whose torque the cards verify to
        1 % over all points
    out : file to write, .csv or .parquet; a journal lies beside it until the sweep is done, and
        the same call goes on from there
    workers : processes on this machine; None: as many as there are cores where that pays, 1: none
    cluster : address of a Dask scheduler, e.g. "tcp://10.0.0.1:8786", instead
    progress : called as progress(points done, points in all)
    keep : False: with ``out``, the columns are there alone, and memory does not grow with them

    Returns
    -------
    SweepTable
        The rows do not depend on the workers. A failed point is a row with its status and NaN.

    Raises
    ------
    ParameterError : wrong argument, or ``out`` has a journal of another sweep
    SolveError : with auto, no rung is verified to the tolerance
    EnvironmentProblem : a package is missing, the cluster does not answer, workers keep dying

    Notes
    -----
    Inputs run faster than parameters, and of each the one named first runs fastest. The rows along
    the fastest input are one line: it begins without memory and is walked with warm starts, so
    that a line up in load follows the film branch to its fold, and one down the contact branch. In
    ``points`` every row stands alone unless a column ``line`` gives rows the same number.

    Examples
    --------
    >>> table = run_sweep("clutch", {"load": "1 kN:3 kN:1 kN"}, at={"speed": 10.0})
    >>> table["friction_torque"].round(2).tolist(), table["status"].tolist()
    ([36.26, 68.76, 98.05], ['OK', 'OK', 'OK'])
    """
    refuse_import_by_worker()
    if workers is not None and not (isinstance(workers, int) and 1 <= workers <= MOST_WORKERS):
        raise ParameterError(f"workers = {workers!r}, allowed: 1 .. {MOST_WORKERS}")
    if workers is not None and cluster is not None:
        raise ParameterError("workers and cluster: allowed: one of them")
    target = None if out is None else check_output(out)
    plan = make_plan(model, over or {}, at or {}, points, params, fidelity)
    if len(plan.params) == 1:
        check_rung(plan.spec, plan.fidelity, plan.params[0])
    real, whole = output_signals(plan.spec)
    n = plan.n_rows if keep or not target else 0
    kept = np.full((n, len(real)), np.nan), np.zeros((n, len(whole)), np.int32)
    journal = Journal(journal_of(target), plan.identity) if target else None
    finished = False
    try:
        Run(plan, *kept, journal, progress).solve(workers, cluster)
        table = make_table(plan, *kept)
        if target and journal:
            blocks = journal.blocks(len(real), len(whole))
            counts, found = write_table(pieces(plan, blocks), target)
            table = table if n else replace(table, columns={}, counts=counts, beyond=found)
        finished = True
    finally:
        if journal:
            journal.close(finished=finished)
    return table


def journal_of(out: Path) -> Path:
    """Return the journal that lies beside an output while its sweep is not done."""
    return out.with_name(out.name + ".journal")


class Run:
    """One run of a sweep: hands out tasks and takes in their rows, each once."""

    def __init__(
        self,
        plan: Plan,
        numbers: NDArray[np.float64],
        flags: NDArray[np.int32],
        journal: Journal | None,
        progress: Progress | None,
    ) -> None:
        self.plan, self.numbers, self.flags = plan, numbers, flags  # without rows: not kept
        self.journal, self.progress = journal, progress
        self.done, self.n_done = np.zeros(plan.n_rows, bool), 0
        for block in journal.blocks(numbers.shape[1], flags.shape[1]) if journal else ():
            self._keep(*block)

    def solve(self, workers: int | None, cluster: str | None) -> None:
        """Solve what is not done yet."""
        self._show()
        if cluster is not None:
            with dask_cluster(cluster) as (executor, n):
                self._hand_out(executor, n)
            return
        n = usable_cores() if workers is None else workers
        others = max(min(n, len(self.plan.params_of)) - 1, 1)  # this process works too
        # The first lines here: that compiles the kernels once, for all, and tells the pace.
        asked = workers is not None and n > 1 and self.plan.n_rows > TASK_POINTS
        if not asked:
            self._solve_here(patient=n == 1, asked=workers is not None)
        for _ in range(RESTARTS):
            if self.done.all():
                return
            try:
                with local_processes(others) as executor:
                    if asked:  # processes that are wanted anyway start meanwhile
                        for _ in range(others):
                            executor.submit(begin)
                        self._solve_here(patient=False, asked=True)
                        asked = False
                    self._hand_out(executor, others, here=True)
            except BrokenProcessPool:
                continue
        if not self.done.all():
            raise EnvironmentProblem(
                "worker processes keep ending before their work is done (too little memory, or a "
                'script without: if __name__ == "__main__":); what is done is kept if there is an '
                "output file: run the same again, with fewer workers"
            )

    def _solve_here(self, *, patient: bool, asked: bool) -> None:
        """Solve in this process until processes pay; ``patient``: to the end."""
        began, rows, warm = time.perf_counter(), 0, False
        for task in self._tasks(1):
            self._take(task, *solve_task(task))
            if patient:
                continue
            if asked:
                return
            if warm:
                rows += len(task.inputs)
                pace = (time.perf_counter() - began) / rows
                if pace * (self.plan.n_rows - self.n_done) > WORTH:
                    return
            else:  # the first task has loaded or compiled the kernels: that is not the pace
                warm, began = True, time.perf_counter()

    def _hand_out(self, executor: Executor, n: int, *, here: bool = False) -> None:
        """Solve with ``n`` workers, some tasks ahead of each; with ``here`` in this process too."""
        tasks = self._tasks(n + here)
        waiting: dict[Future[Any], Task] = {}
        try:
            while True:
                for task in islice(tasks, AHEAD * n - len(waiting)):
                    waiting[executor.submit(solve_task, task)] = task
                own = next(tasks, None) if here else None
                if own is not None:
                    self._take(own, *solve_task(own))
                elif not waiting:
                    return
                done, _ = wait(waiting, 0.0 if own else None, FIRST_COMPLETED)
                for future in done:
                    self._take(waiting.pop(future), *future.result())
        except BaseException:
            for future in waiting:
                future.cancel()
            raise

    def _take(self, task: Task, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> None:
        """Take the rows of a task in; the journal writes them within a second or at its end."""
        if self.journal:
            self.journal.append(task.first_row, numbers, flags)
        self._keep(task.first_row, numbers, flags)
        self._show()

    def _keep(self, first: int, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> None:
        rows = slice(first, first + len(numbers))
        if len(self.numbers):
            self.numbers[rows], self.flags[rows] = numbers, flags
        self.done[rows] = True
        self.n_done += len(numbers)

    def _show(self) -> None:
        if self.progress:
            self.progress(self.n_done, self.plan.n_rows)

    def _tasks(self, n: int) -> Iterator[Task]:
        """Give the lines that are not done, some at a time: enough work to be worth the way."""
        plan = self.plan
        size = min(TASK_POINTS, max(1, plan.n_rows // (32 * n)))
        starts = plan.starts.tolist()
        open_lines = np.flatnonzero(~self.done[plan.starts[:-1]]).tolist()
        group: list[int] = []
        for line in open_lines:
            begins = starts[group[0]] if group else 0
            if group and (line != group[-1] + 1 or starts[line + 1] - begins > size):
                yield self._task(group[0], group[-1] + 1)
                group = []
            group.append(line)
        if group:
            yield self._task(group[0], group[-1] + 1)

    def _task(self, a: int, b: int) -> Task:
        """Return the task of lines ``a .. b - 1``."""
        plan = self.plan
        starts = plan.starts[a : b + 1]
        lines, rows = tuple((starts - starts[0]).tolist()), plan.inputs[starts[0] : starts[-1]]
        params = tuple(plan.params[i] for i in plan.params_of[a:b])
        return Task(plan.spec.key, plan.fidelity, int(starts[0]), rows, lines, params)


@contextmanager
def dask_cluster(address: str) -> Iterator[tuple[Executor, int]]:
    """Give the workers of a running Dask cluster and their number; the cluster stays.

    EnvironmentProblem: no package ``distributed``, no answer, no workers, or another version there.
    """
    try:
        import distributed
    except ImportError:
        raise EnvironmentProblem(
            f"a sweep on a cluster needs the package distributed: {INSTALL}"
        ) from None
    package: Any = distributed  # it has no types
    try:
        client = package.Client(address, timeout=ANSWER_TIME)
    except (OSError, ValueError, TypeError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise EnvironmentProblem(f"cluster = {address!r}: does not answer ({reason})") from None
    try:
        n = _check_workers(client, address)
        yield client.get_executor(pure=False), n
    finally:
        client.close()


def _check_workers(client: Any, address: str) -> int:
    """Return the number of threads in the cluster; refuse workers with other kernels."""
    try:
        digests = client.run(_digest)
    except ImportError:
        raise EnvironmentProblem(
            f"cluster = {address!r}: thrustwasher is not installed on its workers"
        ) from None
    if not digests:
        raise EnvironmentProblem(f"cluster = {address!r}: has no workers")
    if set(digests.values()) != {_digest()}:
        raise EnvironmentProblem(
            f"cluster = {address!r}: its workers have another version of thrustwasher"
        )
    return int(sum(client.nthreads().values()))


def _digest() -> str:
    """Return the digest of the kernels that run here."""
    return f"{kernel_digest()} on Python {sys.version_info[0]}"
