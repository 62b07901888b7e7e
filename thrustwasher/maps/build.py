"""Building a washer's map: solve the lines of the plan side by side, put them into one array."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import SolveError
from ..kernels import washer_map_layout as L
from ..kernels.washer_outputs import FLUID_LOAD
from ..models.washer import GRIDS
from .journal import Journal
from .line import Line, LineTask, solve_line
from .plan import COARSE, ONSET, SPARE, MapPlan

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]
FIDELITIES = ("field", "fine")  # meshes to build from
BATCH = 4  # lines that a worker takes at a time


def build_lines(
    plan: MapPlan, *, fidelity: str = "fine", workers: int = 1,
    progress: Progress | None = None, journal: Path | None = None,
) -> Array:  # fmt: skip
    """Solve all lines of a plan; return the map as one array (see washer_map_layout).

    Parameters
    ----------
    plan : what to cover
    fidelity : mesh of the solutions, "field" or "fine"
    workers : processes
    progress : called as ``progress(done, total)``
    journal : file that keeps the lines; a build that was stopped goes on with them

    Raises
    ------
    SolveError : a node has no solution; a map with a hole is not made
    """
    speeds, tilts, oils = plan.nodes()
    reach = find_reach(plan)
    tasks = [
        _task(plan, reach, GRIDS[fidelity], speed, tilt, oil)
        for speed in speeds for tilt in tilts for oil in oils
    ]  # fmt: skip
    data = np.empty(L.DATA + len(tasks) * L.LINE)
    data[: L.DATA] = plan.header(reach)
    lines = data[L.DATA :].reshape(len(tasks), L.LINE)
    kept = Journal(journal, np.append(data[: L.DATA - 1], FIDELITIES.index(fidelity)))
    done = len(kept.lines)
    lines[:done] = kept.lines
    with executor(workers) as pool:
        rest = tasks[done:]
        found = pool.map(solve_line, rest, chunksize=BATCH) if pool else map(solve_line, rest)
        for i, line in enumerate(found, done):
            lines[i] = line
            kept.add(line)
            if progress is not None:
                progress(i + 1, len(tasks))
    kept.close()
    return data


@contextmanager
def executor(workers: int) -> Iterator[Executor | None]:
    """Give a pool of processes, or None for one worker."""
    if workers <= 1:
        yield None
        return
    pool = ProcessPoolExecutor(workers, mp_context=get_context("spawn"))
    try:
        yield pool
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def find_reach(plan: MapPlan) -> float:
    """Return how thick a film the lightest load needs: ratio^2 over viscosity x speed [1/Pa].

    Thick films carry in proportion to viscosity x speed and, nearly, to the inverse square of
    their thickness. The corner lines say where the lightest load lies.
    """
    speeds, tilts, oils = plan.nodes()
    light = plan.box["load"][0] / SPARE
    largest = 0.0
    for speed in {speeds[0], speeds[len(speeds) // 2], speeds[-1]}:
        for tilt in {tilts[0], tilts[-1]}:
            for oil in {oils[0], oils[-1]}:
                task = _task(plan, 1.0, COARSE, speed, tilt, oil)
                line = Line(task, COARSE)
                load = line.walker.outputs()[FLUID_LOAD]
                if load <= light:
                    continue
                while load > light:
                    before, last = line.ratio, load
                    line.to(1.3 * line.ratio)
                    load = line.walker.outputs()[FLUID_LOAD]
                share = math.log(last / light) / math.log(last / load)
                ratio = before * (line.ratio / before) ** share
                largest = max(largest, (ratio**2 - L.LEAST_REACH**2) / task.scale)
    if not math.isfinite(largest):
        raise SolveError("map: no film is thick enough for the least load; raise the least load")
    return 1.05 * largest


def _task(
    plan: MapPlan, reach: float, grid: tuple[int, int], speed: float, tilt: float, oil: float
) -> LineTask:
    scale = plan.viscosity(oil) * speed
    return LineTask(
        params=plan.params, speed=speed, tilt=tilt, oil_temperature=oil, scale=scale,
        thickest=math.sqrt(L.LEAST_REACH**2 + reach * scale), onset=ONSET, marks=plan.marks,
        coarse=COARSE, grid=grid,
    )  # fmt: skip
