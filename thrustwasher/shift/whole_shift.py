"""A gear shift from its scene alone: the run, and the study of its scatter if one is requested."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from ..errors import ParameterError
from ..plugins import called
from .from_fmus import check_levels, fmu_instances, run_scene
from .run import Progress
from .scene.scene import Scene, with_fidelities
from .scene.scene_file import load_scene
from .several_shifts import SequenceResult
from .shift_result import ShiftResult

Levels = str | Sequence[str] | Mapping[str, str]


def run_shift(
    scene: str | Path | Scene = "planetary",
    *,
    step: float | None = None,
    fidelity: Levels | None = None,
    scatter: int | None = None,
    keep: str = "all",
    progress: bool | Progress | None = None,
) -> ShiftResult | SequenceResult:
    """Return the result of a gear shift; its FMUs are built if they are missing, and freed.

    The run is checked as ``thrustwasher shift`` checks it; ``thrustwasher.shift.cosimulate`` takes
    your own instances.

    Parameters
    ----------
    scene : name of a built-in scene, path of a scene file, or what ``load_scene`` returns
    step : communication step [s]; None: the scene's
    fidelity : a level for all parts that have it ("field", "auto:0.01"), or {part: level}; None:
        the scene's
    scatter : also study uncertainty of the figures, by so many base points, 8 .. 131072, rounded up
        to a power of two; it takes that many runs for each source of scatter too
    keep : of a scene with a sequence, "all" points or the "figures" alone: a run of any length
        then fits into memory, and its shifts have no signals
    progress : of the run and its study: True: a bar of tqdm, or a line, on the terminal; or called
        with steps, then runs, done and all

    Returns
    -------
    ShiftResult, with the study as ``scatter`` if one was requested; SequenceResult of a scene with
    a sequence of shifts

    Raises
    ------
    ParameterError : an argument is not allowed; the message names it
    SolveError : the run stopped; the message names part and time

    Examples
    --------
    >>> result = run_shift("msl")  # doctest: +SKIP
    >>> f"{result.figures['lock_time']:.2f} s"  # doctest: +SKIP
    '2.11 s'
    """
    asked = _scene(scene).with_options(step=_seconds(step))
    asked = with_fidelities(asked, _levels(fidelity))
    runs = None
    if scatter is not None:
        runs = called("runs_of_study")(f"scatter = {scatter!r}", asked, scatter)
    if asked.sequence:
        check_levels(asked)
    show = called("shown_progress")(progress, asked.name) if progress else None
    with fmu_instances(asked) as make:
        result = run_scene(asked, make, progress=show, keep=keep)
    if runs is None or isinstance(result, SequenceResult):
        return result
    return replace(result, scatter=called("propagate")(result.scene, runs=runs, progress=progress))


def _scene(given: object) -> Scene:
    if isinstance(given, Scene):
        return given
    if isinstance(given, str | Path):
        return load_scene(given)
    raise ParameterError(f"scene = {given!r}, allowed: a name, the path of a file or a Scene")


def _seconds(step: object) -> float | None:
    if step is None or (isinstance(step, int | float) and not isinstance(step, bool)):
        return step
    raise ParameterError(f"step = {step!r}, allowed: a number of seconds")


def _levels(fidelity: object) -> list[str]:
    if fidelity is None:
        return []
    found = [fidelity] if isinstance(fidelity, str) else fidelity
    if isinstance(fidelity, Mapping):
        found = [f"{part}={level}" for part, level in fidelity.items()]
    if not isinstance(found, Sequence) or not all(isinstance(text, str) for text in found):
        raise ParameterError(
            f"fidelity = {fidelity!r}, allowed: a fidelity level, or {{part: fidelity level}}"
        )
    return list(found)
