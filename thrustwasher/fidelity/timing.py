"""How long a call takes, and on which machine it was measured."""

from __future__ import annotations

import os
import platform
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..store.card_parts import Machine

BATCH = 0.01  # s, least length of one measurement
REPEATS = 11


@dataclass(frozen=True)
class Timing:
    """Seconds per call: median, distance of the quartiles, least."""

    median: float
    iqr: float
    least: float


def time_call(call: Callable[[int], object], repeats: int = REPEATS) -> Timing:
    """Return the seconds per call of ``call(k)``, k = 0, 1, 2, ...

    The first call is dropped, each measurement is a batch of at least 10 ms.
    """
    call(0)
    k, n = 1, 1
    while True:  # find how many calls make a batch
        began = time.perf_counter()
        for i in range(k, k + n):
            call(i)
        span = time.perf_counter() - began
        k += n
        if span >= BATCH:
            break
        n = max(2 * n, int(1.2 * n * BATCH / max(span, 1e-9)))
    each = []
    for _ in range(repeats):
        began = time.perf_counter()
        for i in range(k, k + n):
            call(i)
        each.append((time.perf_counter() - began) / n)
        k += n
    quartiles = statistics.quantiles(each, n=4)
    return Timing(statistics.median(each), quartiles[2] - quartiles[0], min(each))


def overhead(arguments: tuple[object, ...]) -> float:
    """Return the seconds that calling a compiled function from Python takes, by one that is empty.

    ``arguments`` are as the real function gets them: each array costs something.
    """
    import numba

    compiled: Any = numba.njit
    empty = compiled(_nothing)
    return time_call(lambda k: empty(*arguments)).least


def _nothing(*arguments: object) -> int:
    return 0


def this_machine() -> Machine:
    """Return what the seconds depend on."""
    import numba
    import numpy

    return Machine(
        cpu=_cpu(),
        cores=os.cpu_count() or 1,
        os=platform.platform(terse=True),
        python=platform.python_version(),
        numpy=numpy.__version__,
        numba=numba.__version__,
        threads=1,
        load=round(os.getloadavg()[0], 2) if hasattr(os, "getloadavg") else 0.0,
    )


def _cpu() -> str:
    """Return the processor's name."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()
