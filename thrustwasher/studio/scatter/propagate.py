"""A whole study: from a part, a scene or a function to what is known of its figures."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...errors import ParameterError, SolveError
from ...storage.journal import Journal
from ...storage.whole_files import new_folder, whole_folder
from ..evaluators.make import scattering
from ..jobs.progress import shown
from ..jobs.runner import Progress, check_workers
from .design import LEAST_RUNS, MOST_RUNS, ROWS, ROWS_OF_PART, make_design, rounded_runs
from .evaluation import Runs
from .result import SAMPLE, ScatterResult, write_columns
from .study import Study
from .target import Target, target_of

if TYPE_CHECKING:
    from ...model.part_file import PartFile
    from ...shift.scene.scene import Scene

JOURNAL = "scatter.journal"
RUNS = {"part": 1024, "scene": 256, "function": 1024}
REACHED = ("below", "above")
INDICES = (False, True, "all")


def propagate(
    target: "str | Path | PartFile | Scene | Callable[..., Any]",
    *,
    scatter: Mapping[str, object] | None = None,
    runs: int | None = None,
    seed: int = 1,
    outputs: Sequence[str] | None = None,
    indices: bool | str = True,
    reached: str = "below",
    at: Mapping[str, object] | None = None,
    workers: int | None = None,
    cluster: Any = None,
    out: str | Path | None = None,
    progress: bool | Progress | None = None,
    finish: Callable[[ScatterResult], None] | None = None,
) -> ScatterResult:
    """Return what the scatter of inputs makes of the figures of a part, a scene or a function.

    Parameters
    ----------
    target : a part (``load_part``), a scene (``load_scene``), the path of such a file, the name of
        a model or a built-in scene; or a function that takes numbers by name and returns a number
        or a mapping of numbers
    scatter : instead of the target's own, as a table ``[scatter]``: {"roughness": "10 %"}; a
        function has none of its own: {"x": {"normal": 0.1, "nominal": 2.0}}
    runs : base points, 8 .. 131072; rounded up to a power of two; default 1024, of a scene 256
    seed : of the design, 0 .. 2^32 - 1; the same seed gives the same numbers
    outputs : names of the figures and signals to keep; None: all
    indices : Sobol' indices too, which take runs x (1 + groups of sources) more; "all": of figures
        that are costly as well
    reached : where several solutions exist, the branch: "below", as loaded up from light load, or
        "above"
    at : inputs of a part, as numbers [SI] or "1.2 kN"; others are at its box or their defaults
    workers : processes on this machine; None: as many as there are cores where that pays, 1: none
    cluster : address of a Dask scheduler, e.g. "tcp://10.0.0.1:8786", or a client of it, instead
    out : folder for ``sample.csv``, ``figures.csv``, ``series.csv``; a journal lies there until the
        study is done, and the same call goes on from it
    progress : True: a bar of tqdm, or a line, on the terminal; or called with runs done and all
    finish : called with the result while the journal is still there, for your own files: if
        that fails, the same call goes on with all runs done

    Raises
    ------
    ParameterError : wrong argument, nothing scatters, or ``out`` has a journal of another study
    SolveError : no base run has a solution
    EnvironmentProblem : a package is missing, the cluster does not answer, workers keep dying

    Notes
    -----
    Method: see ``design`` and ``estimates``. The result depends neither on the workers nor on a
    stop in between.

    Examples
    --------
    >>> def area(width=2.0, height=1.0):
    ...     return width * height
    >>> result = propagate(area, scatter={"width": "10 %", "height": "5 %"}, runs=256)
    >>> band = result.figures["value"]
    >>> round(band.nominal, 1), round(band.quantiles[0.95], 1), len(result.sample["value"])
    (2.0, 2.4, 256)
    >>> round(band.indices["width"].total, 1)
    0.8
    """
    began = time.perf_counter()
    check_workers(workers, cluster)
    show = shown(progress, "scatter")
    if indices not in INDICES:
        raise ParameterError(f"indices = {indices!r}, allowed: True, False, 'all'")
    if reached not in REACHED:
        raise ParameterError(f"reached = {reached!r}, allowed: {' or '.join(REACHED)}")
    folder = None if out is None else _folder(out)
    if runs is not None:
        rounded_runs(runs)  # before the target is made, which may take a while
    made, drawn = scattering(target, scatter=scatter, at=at, reached=reached)
    found = target_of(made, drawn, outputs)
    study, warnings = study_of(found, runs=runs, seed=seed, indices=indices)
    journal, finished = None, False
    try:
        if folder is not None:
            settings = {"runs": study.design.n, "seed": seed, "indices": indices}
            with new_folder(folder):
                journal = Journal(folder / JOURNAL, study.identity(**settings), "scatter")
        numbers, codes = study.run(journal, workers=workers, cluster=cluster, progress=show)
        solved = Runs(study, numbers, codes)
        if (solved.base_codes > 0).all():
            if folder is not None:
                with whole_folder(folder) as draft:
                    write_columns(draft / SAMPLE, solved.sample(), solved.units)
            finished = True  # the sample has all there is
            n, why = study.design.n, next(iter(solved.failed))
            raise SolveError(
                f"none of the {n} base runs has a solution, mostly: {why}; check the nominal "
                "values, or narrow the scatter"
            )
        result = solved.result(reached=reached, seed=seed, warnings=warnings)
        result = replace(result, wall_time=time.perf_counter() - began)
        if folder is not None:
            result.write(folder)
        if finish is not None:
            finish(result)
        finished = True
    finally:
        if journal:
            journal.close(finished=finished)
    return result


def study_of(
    target: Target, *, runs: int | None = None, seed: int = 1, indices: bool | str = True
) -> tuple[Study, tuple[str, ...]]:
    """Return the study of a target, and what is to be known of it before it starts."""
    wanted = RUNS[target.kind] if runs is None else runs
    n = rounded_runs(wanted)
    warnings = list(target.warnings)
    warnings += [f"runs = {wanted}: rounded up to {n}, a power of two"] if n != wanted else []
    costly = indices == "all" and bool(target.costly)
    scatter = target.scatter
    groups = [
        group
        for group in (scatter.groups if indices else ())
        if costly or any(target.evaluator.touches(scatter.names[i]) for i in group)
    ]
    rows = ROWS_OF_PART if target.kind == "part" else ROWS
    design = make_design(n, len(scatter.sources), groups, seed, rows)
    return Study(target, design, costly=costly), tuple(warnings)


def _folder(out: str | Path) -> Path:
    if not str(out).strip():
        raise ParameterError(f"out = {out!r}: the name of a folder is required")
    folder = Path(out)
    if folder.exists() and not folder.is_dir():
        raise ParameterError(f"out = {str(out)!r}: is a file, a folder is required")
    return folder


def runs_of_study(where: str, scene: "Scene", runs: Any) -> int:
    """Return the base points of a scene's study; ParameterError, from ``where``, if none can be."""
    from ...shift.scene.places import scene_scatter

    if scene.sequence:
        raise ParameterError(f"{where}: of one shift, allowed: a scene without [sequence]")
    try:
        number = rounded_runs(runs)
    except ParameterError:
        raise ParameterError(
            f"{where}: allowed: a whole number {LEAST_RUNS} .. {MOST_RUNS}, best a power of two"
        ) from None
    if not scene_scatter(scene).sources:
        raise ParameterError(
            f"{where}: nothing scatters in {scene.name}: add [scatter] to the scene, such as "
            'oil_temperature = "3 K"'
        )
    return number
