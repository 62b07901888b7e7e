"""Where lines are solved: processes on this machine, or the workers of a Dask cluster.

Both are executors of ``concurrent.futures``; the sweep cannot tell them apart.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any

from ..errors import EnvironmentProblem

ANSWER_TIME = "10s"  # a cluster that takes longer is taken for absent
INSTALL = 'pip install "thrustwasher[sweep]"'


def usable_cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def refuse_import_by_worker() -> None:
    """Stop a worker that runs the user's script again because its main part is not guarded."""
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise EnvironmentProblem(
            "a sweep on several processes was called while a worker imports the script; put the "
            'call below: if __name__ == "__main__":'
        )


@contextmanager
def local_processes(n: int) -> Iterator[Executor]:
    """Give ``n`` fresh processes; whatever happens they are gone at the end."""
    refuse_import_by_worker()
    executor = ProcessPoolExecutor(
        n, mp_context=multiprocessing.get_context("spawn"), initializer=_settle_in
    )
    try:
        yield executor
        executor.shutdown()
    except BaseException:
        _stop_now(executor)
        raise


def _settle_in() -> None:
    """Prepare a worker: Ctrl-C is the parent's business, and without a parent there is no work."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: Any) -> None:
    parent.join()
    os._exit(1)


def _stop_now(executor: Any) -> None:
    """End the workers in the middle of their work; it is done again."""
    processes = list((getattr(executor, "_processes", None) or {}).values())
    executor.shutdown(wait=False, cancel_futures=True)
    for process in processes:
        process.terminate()
    for process in processes:
        process.join(5.0)


@contextmanager
def dask_cluster(address: str) -> Iterator[tuple[Executor, int]]:
    """Give the workers of a running Dask cluster and their number; the cluster stays.

    Raises
    ------
    EnvironmentProblem : no package ``distributed``, no answer, no workers, or another version there
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
    from ..kernels._jit import kernel_digest

    return f"{kernel_digest()} on Python {sys.version_info[0]}"
