"""Building a washer's map: solve the lines of the plan side by side, put them into one array."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import EnvironmentProblem, SolveError
from ..kernels import washer_map_layout as L
from ..kernels._jit import kernel_digest
from ..kernels.washer_layout import O_FLUID_LOAD
from ..models.washer import GRIDS
from ..processes import local_processes
from ..store.digests import params_digest
from ..store.journal import Journal
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
    journal : file that keeps the lines; a build that was stopped goes on with them. It stays:
        remove it once the map is safe

    Raises
    ------
    ParameterError : the journal is that of another map, or another run writes it
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
    flags = np.zeros((len(tasks), 1), np.int32)
    kept = Journal(journal, _identity(plan, fidelity), "map") if journal else None
    try:
        done = kept.load(lines, flags) if kept else np.zeros(len(tasks), bool)
        rest = np.flatnonzero(~done).tolist()
        with executor(workers) as pool:
            waiting = [tasks[i] for i in rest]
            found = pool.map(solve_line, waiting, chunksize=BATCH) if pool else map(
                solve_line, waiting
            )  # fmt: skip
            for count, (i, line) in enumerate(zip(rest, found, strict=True), int(done.sum()) + 1):
                lines[i] = line
                if kept:
                    kept.append(i, lines[i : i + 1], flags[i : i + 1])
                if progress is not None:
                    progress(count, len(tasks))
    finally:
        if kept:
            kept.close(finished=False)
    return data


def _identity(plan: MapPlan, fidelity: str) -> dict[str, str]:
    """Return what makes this map another one than the next."""
    return {
        "parameters": params_digest(plan.params)[:16], "box": str(plan.box), "fidelity": fidelity,
        "kernels": kernel_digest(),
    }  # fmt: skip


@contextmanager
def executor(workers: int) -> Iterator[Executor | None]:
    """Give a pool of processes, or None for one worker.

    Raises
    ------
    EnvironmentProblem : a worker process has ended before its work was done
    """
    if workers <= 1:
        yield None
        return
    try:
        with local_processes(workers) as pool:
            yield pool
    except BrokenProcessPool:
        raise EnvironmentProblem(
            "a worker process has ended before its work was done (too little memory?); solved "
            "lines are kept: run the same again, with fewer workers"
        ) from None


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
                load = line.at.outputs()[O_FLUID_LOAD]
                if load <= light:
                    continue
                while load > light:
                    before, last = line.ratio, load
                    line.to(1.3 * line.ratio)
                    load = line.at.outputs()[O_FLUID_LOAD]
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
