"""The workers of a running Dask cluster."""

import sys
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Any

from ...errors import EnvironmentProblem
from ...numerics.jit import kernel_digest

INSTALL = 'pip install "thrustwasher[sweep]"'
ANSWER_TIME = "10s"  # a cluster that takes longer is taken for absent


@contextmanager
def dask_cluster(address: Any) -> Iterator[tuple[Executor, int]]:
    """Give the workers of a running Dask cluster and their number; the cluster stays.

    ``address``: of the scheduler; or a client of it, which stays open, or the cluster itself.

    EnvironmentProblem: no package ``distributed``, no answer, no workers, or another version there.
    """
    try:
        import distributed
    except ImportError:
        raise EnvironmentProblem(
            f"work on a cluster needs the package distributed: {INSTALL}"
        ) from None
    package: Any = distributed  # it has no types
    if isinstance(address, package.Client):
        if address.asynchronous or address.status != "running":
            state = "asynchronous" if address.asynchronous else address.status
            raise EnvironmentProblem(
                f"cluster: its client is {state}, allowed: one that runs and is not asynchronous"
            )
        yield address.get_executor(pure=False), _check_workers(address, address.scheduler.addr)
        return
    if not isinstance(address, str | package.deploy.Cluster):
        raise EnvironmentProblem(
            f"cluster = {address!r}: allowed: address of a Dask scheduler, such as "
            "'tcp://10.0.0.1:8786', a client of it, or a cluster of the package distributed"
        )
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
