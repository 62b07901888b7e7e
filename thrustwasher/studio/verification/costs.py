"""What a call of a level costs: its compiled step, inputs moving a little from call to call.

That is what a step costs in an FMU. A call of ``solve_*`` from Python adds tens of microseconds to
any level.
"""

from __future__ import annotations

import itertools
import math
import platform
import statistics
import sys
import time
import timeit
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ...model.prepare import fill_table, filled
from ...model.registry import HELPERS, find_spec, kernel_of
from ...model.spec import ModelSpec
from .reference_cache import SOURCES
from .reference_values import ReferencePoint

BATCH = 10e-3  # [s] minimum time between two looks at the clock
REPEATS = 9
# What the thread itself takes, where that is known finely: others on the machine do not count.
CLOCK = time.thread_time if sys.platform == "linux" else time.perf_counter
LEAST = 5e-8  # [s] a call is never taken for less
WALK = 0.003  # load and speed move by so much from call to call
TURN = 20  # calls in one direction
STEP = 1e-3  # s, for parts that have states


@dataclass(frozen=True)
class Timing:
    """Seconds per call over repeats."""

    median: float
    iqr: float
    least: float
    repeats: int
    first: float

    def less(self, spent: float) -> Timing:
        """Return it without what a call costs that does nothing; some is left in any case."""
        median, least = max(self.median - spent, LEAST), max(self.least - spent, LEAST)
        return replace(self, median=median, least=least)


def time_call(
    call: Callable[[], object], *, repeats: int = REPEATS, batch: float = BATCH
) -> Timing:
    """Return the time of a call; the first one is apart."""
    clock = timeit.Timer(call, timer=CLOCK)
    first, once = clock.timeit(1), clock.timeit(1)
    n = max(1, math.ceil(batch / max(once, 1e-7)))
    times = [spent / n for spent in clock.repeat(repeats, n)]
    low, _, high = statistics.quantiles(times, n=4)
    return Timing(statistics.median(times), high - low, min(times), repeats, first)


def idle_step() -> Any:
    """Return the step of the minimum helper: a call of it costs what any call does."""
    return kernel_of(min(map(find_spec, HELPERS), key=lambda spec: len(spec.outputs))).step


def stepper(
    spec: ModelSpec, params: Any, fidelity: str, known: ReferencePoint, step: Any = None
) -> Callable[[], int]:
    """Return a call that makes one step of a level near a point, load and speed a little further.

    ``step`` replaces the kernel's.
    """
    kernel = kernel_of(spec)
    step = step or kernel.step
    par = filled(spec, params, fidelity, kernel.NPAR, kernel.derive)
    branches = SOURCES[spec.key].branches
    first = [known.point.get(s.name, s.usual) for s in spec.inputs]
    inp = np.array([*first, *([branches.get(known.branch or "", 0.0)] if branches else [])])
    state, work = np.zeros(kernel.NSTATE), np.zeros(kernel.NWORK)
    out, iout = np.zeros(kernel.NOUT), np.zeros(max(kernel.NIOUT, 1), np.int32)
    fill_table(spec, params, par, work)
    walk = itertools.cycle(_walk(first[0], first[1], known.branch == "film"))

    def call() -> int:
        inp[0], inp[1] = next(walk)
        return int(step(par, inp, state, work, out, iout, 0.0, STEP))

    call()
    if branches:
        inp[-1] = 0.0  # the branch was requested once, from now on it is remembered
    return call


def _walk(load: float, speed: float, falls: bool) -> list[tuple[float, float]]:
    """Return loads and speeds up and down again; away from the fold, a film's load falls."""
    factors = [1.0 + WALK * (TURN - abs(TURN - k)) for k in range(2 * TURN)]
    return [(load / f if falls else load * f, speed * f) for f in factors]


def call_cost(
    spec: ModelSpec, params: Any, fidelity: str, known: Sequence[ReferencePoint]
) -> float:
    """Return the seconds of a call: the median of a few points of a chart."""
    away = sorted((t for t in known if not t.beside_fold), key=lambda t: t.point["load"])
    some = [away[k * (len(away) - 1) // 4] for k in (1, 2, 3)]
    found = []
    for t in some:
        spent = time_call(stepper(spec, params, fidelity, t, idle_step())).least
        found.append(time_call(stepper(spec, params, fidelity, t)).less(spent))
    return sorted(t.median for t in found)[1]


def cpu() -> str:
    """Return the name of this machine's processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()
