"""From parameters to a map file: survey, lines solved side by side, check, metadata."""

import math
import os
import platform
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import ParameterError, SolveError
from ...numerics.chebyshev import lines_of
from ...numerics.jit import Array, kernel_digest
from ...plugins import called
from ...processes import Run, run_here, runner
from ...storage.digests import params_digest
from ...storage.journal import Journal
from ...storage.whole_files import whole_file
from ..kernels.layout import O_FLUID_LOAD
from ..kernels.map import map_layout as L
from ..parameters import SPEC, WasherParams
from ..solve import GRIDS
from .map_check import check_map, mesh_of
from .map_file import identity_of, pack
from .map_line import Curve, Line, LineTask, packed, solve_lines
from .map_mesh import Change, Grid, NotSmooth, change_of_mesh
from .map_plan import COARSE, FIELD_FROM, SPARE, TOLERANCE, MapPlan, Place, plan_map
from .map_survey import surveyed

Progress = Callable[[int, int], None]
Terms = tuple[int, ...]
Solve = Callable[[Sequence[Sequence[Place]], Grid, Terms], list[list[Curve]]]
POINTS = 60  # held out
FIDELITIES = ("field", "fine")  # meshes to build from
DIGIT = 2.0**-20  # of the logarithms; what is finer only makes the file large
BATCH = 19  # lines that a worker takes at a time, each from where the one before was


def make_map(
    params: WasherParams,
    out: Path,
    *,
    box: dict[str, tuple[float, float]] | None = None,
    tolerance: float = TOLERANCE,
    fidelity: str | None = None,
    workers: int | None = None,
    points: int = POINTS,
    progress: bool | Callable[[str], Progress] | None = None,
) -> dict[str, Any]:
    """Build a map, check it and write it; return its metadata.

    Parameters
    ----------
    params : the washer
    out : file to write, ``*.twm``; what is solved is kept next to it until the map is done
    box : (low, high) of load [N], speed [rad/s], tilt [rad], oil_temperature [K]
    tolerance : of the torque, relative: of mesh and map together
    fidelity : "fine" or "field", the mesh that is mapped; None: "field" with what a finer mesh
        changes, and if that misses the tolerance "fine"
    workers : processes; None: one per core
    points : held-out points of the check
    progress : True: a bar of tqdm, or a line, on the terminal; or called with a label, returns
        ``show(done, total)``

    Raises
    ------
    ParameterError : a wrong box, tolerance or fidelity, an oil supply of its own temperature, or
        another run makes this file
    SolveError : a node has no solution, or a held-out point misses the tolerance
    """
    if fidelity not in (None, *FIDELITIES):
        raise ParameterError(f"fidelity = {fidelity!r}, allowed: {' or '.join(FIDELITIES)}")
    plan = plan_map(params, box, tolerance)
    show = progress if callable(progress) else partial(_shown, progress)
    must = fidelity is None
    made = partial(_made, plan, out, workers or os.cpu_count() or 1, points, show, must=must)
    usual = "field" if tolerance >= FIELD_FROM else "fine"
    raised = must and usual == "field"
    try:
        return made(fidelity or usual, raised=raised)
    except NotSmooth as problem:
        why = str(problem)
    except _MissedError as problem:
        if not raised:
            raise SolveError(_too_coarse(problem.metadata)) from None
        why = f"the map is {problem.metadata['held_out']['torque']:.1%} off"
    try:
        return made("fine", raised=False, lines=f"{why}: all lines on the finer mesh,")
    except _MissedError as problem:
        raise SolveError(_too_coarse(problem.metadata)) from None


def _shown(progress: bool | None, label: str) -> Progress:
    """Return what shows a step of the build; nothing is shown without it."""
    shown: Progress | None = called("shown_progress")(progress, label) if progress else None
    return shown or (lambda _done, _total: None)


class _MissedError(Exception):
    """A held-out point misses the tolerance; the file is not written."""

    def __init__(self, metadata: dict[str, Any]) -> None:
        super().__init__()
        self.metadata = metadata


def _made(
    plan: MapPlan,
    out: Path,
    workers: int,
    points: int,
    show: Callable[[str], Progress],
    fidelity: str,
    *,
    raised: bool,
    must: bool,
    lines: str = "lines",
) -> dict[str, Any]:
    """Build a map on a mesh, check and write it; return its metadata.

    ``must``: it is written only if it keeps the tolerance; _MissedError otherwise.
    """
    # Held to the end: another run that writes this map is refused before it has worked for nothing.
    journal = journal_for(out.with_name(f"{out.name}.journal"), plan, fidelity)
    finished = False
    try:
        began = time.perf_counter()
        with whole_file(out) as draft, runner(workers) as run:
            reach = find_reach(plan)
            plan = survey(plan, reach, run=run, progress=show("survey"))
            data = build_lines(
                plan, reach, fidelity=fidelity, run=run, progress=show(lines), journal=journal
            )
            change = None
            if raised:
                solve, fine = _solver(plan, reach, run, show("finer mesh")), GRIDS["fine"]
                change = change_of_mesh(
                    plan, GRIDS[fidelity], fine, lambda rows, grid: solve(rows, grid, plan.terms)
                )
                numbers = data[L.DATA :].reshape(-1, plan.line)
                numbers += np.round(change.lines / DIGIT) * DIGIT
                data[L.IDENTITY] = identity_of(data)
            metadata = _metadata(plan, fidelity, change, time.perf_counter() - began, workers)
            draft.write_bytes(pack(data, metadata))
            shown = show("held-out points")
            grid = mesh_of(metadata)
            verdict = check_map(
                plan.params, str(draft), grid=grid, run=run, points=points, progress=shown
            )
            metadata["held_out"] = asdict(verdict)
            if must and _missed(metadata):
                raise _MissedError(metadata)
            draft.write_bytes(pack(data, metadata))
        finished = True
    except (SolveError, _MissedError):
        finished = True  # the same again would end here again
        raise
    finally:
        journal.close(finished=finished)
    return metadata


def _missed(metadata: dict[str, Any]) -> bool:
    return bool(metadata["held_out"]["torque"] > metadata["tolerance"])


def _too_coarse(metadata: dict[str, Any]) -> str:
    held, units = metadata["held_out"], {s.name: s.unit for s in SPEC.inputs}
    where = ", ".join(f"{n} = {x:.4g} {units[n]}" for n, x in held["worst"].items())
    return (
        f"map: its torque is {held['torque']:.2%} off at {where}; required: "
        f"{metadata['tolerance']:.2%}. Leave that out of the box, or ask for "
        f"{1.1 * held['torque']:.1g} (--tol)"
    )


def survey(
    plan: MapPlan, reach: float, *, run: Run = run_here, progress: Progress | None = None
) -> MapPlan:
    """Return the plan with what its tolerance needs, measured on the coarse mesh."""
    solve = _solver(plan, reach, run, progress)
    return surveyed(plan, lambda rows, terms: solve(rows, COARSE, terms))


def _solver(plan: MapPlan, reach: float, run: Run, progress: Progress | None) -> Solve:
    """Return what solves rows of neighbours on a grid, with so many coefficients."""

    def solve(rows: Sequence[Sequence[Place]], grid: Grid, terms: Terms) -> list[list[Curve]]:
        tasks = [[LineTask(plan, reach, grid, terms, place) for place in row] for row in rows]
        curves: list[list[Curve]] = []
        for row in run(solve_lines, tasks, 1):
            curves.append(row)
            if progress is not None:
                progress(len(curves), len(tasks))
        return curves

    return solve


def build_lines(
    plan: MapPlan,
    reach: float,
    *,
    fidelity: str = "fine",
    run: Run = run_here,
    progress: Progress | None = None,
    journal: Journal | None = None,
) -> Array:
    """Solve all lines of a plan; return the map as one array (see map_layout).

    ``journal`` keeps the lines: a build that was stopped goes on with them. SolveError if a node
    has no solution: a map with a hole is not made.
    """
    places = plan.places()
    data = np.empty(plan.size)
    data[: L.DATA] = plan.header(reach)
    lines = data[L.DATA :].reshape(len(places), plan.line)
    flags = np.zeros((len(places), 1), np.int32)
    done = journal.load(lines, flags) if journal else np.zeros(len(places), bool)
    rest = _neighbours(places, np.flatnonzero(~done).tolist())
    tasks = [LineTask(plan, reach, GRIDS[fidelity], plan.terms, places[i]) for i in rest]
    count = len(places) - len(rest)
    numbers = iter(rest)
    batches = [tasks[k : k + BATCH] for k in range(0, len(tasks), BATCH)]
    for part in run(solve_lines, batches, 1):
        for curve in part:
            i = next(numbers)
            lines[i] = np.round(packed(curve, plan.more_terms) / DIGIT) * DIGIT
            if journal:
                journal.append(i, lines[i : i + 1], flags[i : i + 1])
        count += len(part)
        if progress is not None:
            progress(count, len(places))
    data[L.IDENTITY] = identity_of(data)
    return data


def _neighbours(places: Sequence[Place], required: Sequence[int]) -> list[int]:
    """Return numbers of places so that one is near the next: speeds up and down by turns."""
    rows: dict[tuple[float, float], list[int]] = {}
    for i in sorted(required, key=lambda i: (places[i][1:], places[i][0])):
        rows.setdefault(places[i][1:], []).append(i)
    return [i for k, row in enumerate(rows.values()) for i in (row[::-1] if k % 2 else row)]


def journal_for(path: Path, plan: MapPlan, fidelity: str) -> Journal:
    """Return the journal of a map; ParameterError if it is another one's, or another run has it."""
    identity = {
        "parameters": params_digest(plan.params)[:16],
        "box": str(plan.box),
        "fidelity": fidelity,
        "tolerance": f"{plan.tolerance:g}",
        "kernels": kernel_digest(),
    }
    return Journal(path, identity, "map")


def find_reach(plan: MapPlan) -> float:
    """Return how thick a film the lightest load needs: ratio^2 over viscosity x speed [1/Pa].

    Thick films carry in proportion to viscosity x speed and, nearly, to the inverse square of
    their thickness. The corner lines say where the lightest load lies.
    """
    (slow, fast), tilts, oils = plan.axes
    light = plan.box["load"][0] / SPARE
    largest = 0.0
    for speed in {slow, 0.5 * (slow + fast), fast}:
        for tilt in set(tilts):
            for oil in set(oils):
                task = LineTask(plan, 1.0, COARSE, (), plan.at(speed, tilt, oil))
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
        raise SolveError(
            "map: no film is thick enough for the minimum load; raise the minimum load"
        )
    return 1.05 * largest


def _metadata(
    plan: MapPlan, fidelity: str, change: Change | None, took: float, workers: int
) -> dict[str, Any]:
    """Return a map's metadata; ``change`` is what a finer mesh added."""
    mesh = (
        {"finer_lines": change.solved, "mesh_made_good": change.raised, "mesh_left": change.left}
        if change
        else {}
    )
    return {
        "kind": "washer map",
        "params": asdict(plan.params),
        "box": plan.box,
        "tolerance": plan.tolerance,
        "patches": plan.patches,
        "lines": lines_of(*plan.patches),
        "terms": plan.terms,
        "more_terms": plan.more_terms,
        "marks": plan.marks,
        "built_from": fidelity,
        "checked_on": change.grid if change else GRIDS[fidelity],
        **mesh,
        "kernels": kernel_digest(),
        "build_s": round(took, 1),
        "workers": workers,
        "machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
        "held_out": None,
    }
