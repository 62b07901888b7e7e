"""From parameters to a map file: plan, lines solved side by side, check, card."""

import math
import os
import platform
import time
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import ParameterError, SolveError, naming
from ...numerics.jit import Array, kernel_digest
from ...processes import mapped
from ...storage.digests import params_digest
from ...storage.journal import Journal
from ..kernels.layout import O_FLUID_LOAD
from ..kernels.map import map_layout as L
from ..parameters import WasherParams
from ..solve import GRIDS
from .map_check import check_map
from .map_file import SUFFIX, pack
from .map_line import Line, LineTask, solve_line
from .map_plan import COARSE, SPARE, MapPlan, plan_map

Progress = Callable[[int, int], None]
FIDELITIES = ("field", "fine")  # meshes to build from
BATCH = 4  # lines that a worker takes at a time


def make_map(
    params: WasherParams, out: Path, *, box: dict[str, tuple[float, float]] | None = None,
    fidelity: str = "fine", workers: int | None = None, points: int = 200,
    progress: Callable[[str], Progress] | None = None,
) -> dict[str, Any]:  # fmt: skip
    """Build a map, check it and write it; return its card.

    Parameters
    ----------
    params : the washer
    out : file to write, ``*.twm``; what is solved is kept beside it until the map is done
    box : (low, high) of load [N], speed [rad/s], tilt [rad], oil_temperature [K]
    fidelity : "fine" or "field", the mesh that is mapped
    workers : processes; None: one per core
    points : held-out points of the check
    progress : called with a label, returns ``show(done, total)``

    Raises
    ------
    ParameterError : a wrong box or fidelity, more numbers than a map may have, or another run
        makes this file
    SolveError : a node has no solution
    """
    if fidelity not in FIDELITIES:
        raise ParameterError(f"fidelity = {fidelity!r}, allowed: {' or '.join(FIDELITIES)}")
    plan = plan_map(params, box)
    size = L.DATA + int(np.prod(plan.shape)) * L.LINE
    if size > L.ROOM:
        raise ParameterError(
            f"box: {size} numbers for {plan.shape[0]} x {plan.shape[1]} x {plan.shape[2]} nodes, "
            f"allowed: {L.ROOM}; make the box smaller"
        )
    count = workers or os.cpu_count() or 1
    show = progress or (lambda _label: lambda _done, _total: None)
    draft = out.with_name(f".{out.name}.{os.getpid()}.draft{SUFFIX}")
    # Held to the end: another run that writes this map is refused before it has worked for nothing.
    journal = journal_for(out.with_name(f"{out.name}.journal"), plan, fidelity)
    finished = False
    try:
        began = time.perf_counter()
        data = build_lines(plan, fidelity=fidelity, workers=count, progress=show("lines"),
                           journal=journal)  # fmt: skip
        card = _card(plan, fidelity, time.perf_counter() - began, count)
        _write(draft, data, card)
        verdict = check_map(params, str(draft), points=points, fidelity=fidelity, workers=count,
                            progress=show("held-out points"))  # fmt: skip
        card["held_out"] = asdict(verdict)
        _write(draft, data, card)
        draft.replace(out)
        finished = True
    finally:
        draft.unlink(missing_ok=True)
        journal.close(finished=finished)
    return card


def build_lines(
    plan: MapPlan, *, fidelity: str = "fine", workers: int = 1,
    progress: Progress | None = None, journal: Journal | None = None,
) -> Array:  # fmt: skip
    """Solve all lines of a plan; return the map as one array (see map_layout).

    ``journal`` keeps the lines: a build that was stopped goes on with them. SolveError if a node
    has no solution: a map with a hole is not made.
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
    done = journal.load(lines, flags) if journal else np.zeros(len(tasks), bool)
    rest = np.flatnonzero(~done).tolist()
    with mapped(workers, solve_line, [tasks[i] for i in rest], BATCH) as found:
        for count, (i, line) in enumerate(zip(rest, found, strict=True), int(done.sum()) + 1):
            lines[i] = line
            if journal:
                journal.append(i, lines[i : i + 1], flags[i : i + 1])
            if progress is not None:
                progress(count, len(tasks))
    return data


def journal_for(path: Path, plan: MapPlan, fidelity: str) -> Journal:
    """Return the journal of a map; ParameterError if it is another one's, or another run has it."""
    identity = {
        "parameters": params_digest(plan.params)[:16], "box": str(plan.box), "fidelity": fidelity,
        "kernels": kernel_digest(),
    }  # fmt: skip
    return Journal(path, identity, "map")


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
        thickest=math.sqrt(L.LEAST_REACH**2 + reach * scale), marks=plan.marks, grid=grid,
    )  # fmt: skip


def _write(path: Path, data: Any, card: dict[str, Any]) -> None:
    with naming(path):
        path.write_bytes(pack(data, card))


def _card(plan: MapPlan, fidelity: str, took: float, workers: int) -> dict[str, Any]:
    return {
        "kind": "washer map", "params": asdict(plan.params), "box": plan.box,
        "nodes": plan.shape, "marks": plan.marks, "built_from": fidelity,
        "kernels": kernel_digest(), "build_s": round(took, 1), "workers": workers,
        "machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
        "held_out": None,
    }  # fmt: skip
