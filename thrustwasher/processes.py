"""Fresh worker processes that end with their work, with their parent, and at Ctrl-C."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any

from .errors import EnvironmentProblem
from .logs import Carrying, keep_from, unloaded, wanted_level

# What a terminal sends to all processes of a command: Ctrl-C, and its end where there is one.
FOR_PARENTS = {signal.SIGINT, getattr(signal, "SIGHUP", signal.SIGINT)}
Run = Callable[[Callable[[Any], Any], Sequence[Any], int], Iterator[Any]]


def usable_cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def refuse_import_by_worker() -> None:
    """Stop a worker that runs the user's script again because its main part is not guarded."""
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise EnvironmentProblem(
            "work on several processes was begun while a worker imports the script; put the call "
            'below: if __name__ == "__main__":'
        )


@contextmanager
def local_processes(n: int) -> Iterator[Executor]:
    """Give ``n`` fresh processes; whatever happens they are gone at the end.

    What they log comes back by ``logs.Carrying`` and ``logs.unloaded``.
    """
    refuse_import_by_worker()
    executor = ProcessPoolExecutor(
        n,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_settle_in,
        initargs=(wanted_level(),),
    )
    try:
        with _interrupts_held():
            for _ in range(n):
                executor.submit(int)  # starts a process
        yield executor
        executor.shutdown()
    except BaseException:
        _stop_now(executor)
        raise


def run_here(job: Callable[[Any], Any], tasks: Sequence[object], _chunksize: int) -> Iterator[Any]:
    """Give what a job makes of each task, in order, by this process."""
    return map(job, tasks)


@contextmanager
def runner(n: int) -> Iterator[Run]:
    """Give what runs jobs as `run_here` does: ``n`` fresh processes; for one, this one."""
    if n <= 1:
        yield run_here
        return
    try:
        with local_processes(n) as pool:
            yield lambda job, tasks, chunksize: map(
                unloaded, pool.map(Carrying(job), tasks, chunksize=chunksize)
            )
    except BrokenProcessPool:
        raise EnvironmentProblem(
            "a worker process has ended before its work was done (too little memory?); what is "
            "solved is kept: run the same again, with fewer workers"
        ) from None


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Hold back what is the parent's business: a process never sees it, not even at its start."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, FOR_PARENTS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _settle_in(level: int) -> None:
    """Prepare a worker: to stop is the parent's business, and without a parent there is no work.

    So is what it logs, from ``level`` on.
    """
    keep_from(level)
    for number in FOR_PARENTS:
        signal.signal(number, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: Any) -> None:
    parent.join()
    os._exit(1)


def _stop_now(executor: Any) -> None:
    """End the workers in the middle of their work; it is done again."""
    processes = list((getattr(executor, "_processes", None) or {}).values())
    tasks, results = executor._call_queue, executor._result_queue  # gone after shutdown
    # The caller's futures are cancelled now or later, by whoever waited for them; some versions of
    # Python fail, in a thread, where a broken pool meets a cancelled future.
    for item in list((getattr(executor, "_pending_work_items", None) or {}).values()):
        item.future = Future()
    executor.shutdown(wait=False, cancel_futures=True)
    for process in processes:
        process.terminate()
    for process in processes:
        process.join(5.0)
    # A worker that ended in the middle of a message leaves a thread of the executor waiting for its
    # rest, and Python waits for that thread: the pipe has to end with its last writer. Nobody reads
    # what is still on its way to the workers either.
    if tasks is not None:
        tasks.cancel_join_thread()
    if results is not None:
        results._writer.close()
