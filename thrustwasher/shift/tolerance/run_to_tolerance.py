"""A shift at a tolerance: trial runs, a rung for every part, the run and its check."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from ...errors import ParameterError, SolveError
from ...ladder.own_tables import RUNS, build_where_it_pays
from ..checks import step_error
from ..checks.guard import guarded
from ..run import Progress, run_shift
from ..scene.connections import DIRECT
from ..scene.scene import Scene
from ..shift_result import ShiftResult
from .rung_check import check_part
from .selection import select
from .selection_record import Check, CheckRecord, Selected, Selection
from .trial_run import Make, Pool, TrialRuns, step_share, trial_runs, with_rungs


def run_auto(
    scene: Scene,
    make: Make,
    *,
    guard: bool = True,
    build_maps: bool = False,
    progress: Progress | None = None,
    compiled: bool | None = None,
) -> ShiftResult:
    """Simulate a shift; the rung of every part that asks for a tolerance is found here.

    Parameters
    ----------
    scene : what to simulate; ``tolerance`` of a part is the relative error asked for
    make : returns an instance of a part, of the fidelity that stands in it; whoever makes it closes
        it. One that has ``reset`` is used again
    guard : check the run afterwards: its step by a second run with shorter ones, washers that were
        taken as steady by following them in time, and rungs that were chosen; run again a rung
        higher where one does not hold, or in time where a washer of a tolerance is not steady
    build_maps : build the map of a washer that no card speaks of where that pays, and keep it;
        ``make`` has to find it
    progress, compiled : as in ``run_shift``

    Returns
    -------
    ShiftResult : with ``selection``, if rungs were chosen, and with what the checks found

    Raises
    ------
    ParameterError, SolveError : as in ``run_shift``; also if no rung of a part holds its tolerance
    """
    pool = Pool(make)

    def run(now: Scene) -> ShiftResult:
        return run_shift(now, pool.all_of(now), progress=progress, compiled=compiled)

    second, given = partial(run_shift, compiled=compiled), pool.all_but

    scene, remarks = _without_choice(scene)
    wanted = [p.tolerance for p in scene.parts.values() if p.tolerance]
    if not wanted:
        result = run(scene)
        result = replace(result, messages=[*result.messages, *remarks])
        return guarded(result, given, second) if guard else result
    trials = trial_runs(scene, pool, compiled)
    steps = max(1, round((scene.stop_time - scene.start_time) / scene.step))
    if build_maps:
        remarks += _own_maps(scene, trials, steps)
    chosen = select(scene, trials, steps, guard)
    selection = Selection(chosen, step_share(trials, scene.step, min(wanted)), trials.seconds)
    result = run(with_rungs(scene, {c.part: c.rung for c in chosen}))
    if guard:
        result = _checked(result, chosen, pool, run)
        result = _followed(scene, guarded(result, given, second), run, given, second)
    return replace(result, selection=selection, messages=[*result.messages, *remarks])


def _followed(
    scene: Scene, result: ShiftResult, run: Callable[[Scene], ShiftResult], given: step_error.Make,
    second: step_error.Run,
) -> ShiftResult:  # fmt: skip
    """Repeat a run in time where a washer whose rung was to be chosen is not steady in it.

    Where that fails the run before it counts, with its warning, and why.
    """
    if not any(scene.parts[n].tolerance and w.differences for n, w in result.in_time.items()):
        return result
    rungs = {n: p.fidelity for n, p in result.scene.parts.items() if n not in DIRECT}
    try:
        again = guarded(run(with_rungs(_in_time(scene), rungs)), given, second)
    except (ParameterError, SolveError) as problem:
        words = f"A run with thermal_mode transient failed ({problem}); the one before it counts"
        return replace(result, found=(*result.found, words))
    words = "; ".join(text for n, w in result.in_time.items() for text in w.warnings(n, "so"))
    return replace(
        again, guard=result.guard,
        messages=[*again.messages, f"{words} the run was repeated with thermal_mode transient"],
    )  # fmt: skip


def _in_time(scene: Scene) -> Scene:
    """Return the scene with washers whose bodies store heat, at a rung that can follow it."""
    parts = dict(scene.parts)
    for name in DIRECT:
        if (part := parts.get(name)) is not None:
            params = replace(part.params, thermal_mode="transient")
            rung = part.spec.default_fidelity if part.tolerance else part.fidelity
            parts[name] = replace(part, params=params, fidelity=rung, tolerance=None)
    return replace(scene, parts=parts)


def _without_choice(scene: Scene) -> tuple[Scene, list[str]]:
    """Return the scene with default rungs for parts that no card speaks of, and what to say."""
    parts, remarks = dict(scene.parts), []
    for name, part in parts.items():
        if part.tolerance and getattr(part.params, "thermal_mode", "") == "transient":
            parts[name] = replace(part, tolerance=None)
            remarks.append(
                f"{name}: {part.fidelity}, its default; cards speak of steady states, and "
                "thermal_mode is transient"
            )
    return replace(scene, parts=parts), remarks


def _own_maps(scene: Scene, trials: TrialRuns, steps: int) -> list[str]:
    """Build maps of parts that are judged by themselves, where that pays; return what was done."""
    said = []
    for name in DIRECT:
        part = scene.parts.get(name)
        if part is not None and part.tolerance:
            box = trials.box(name, part.spec)
            seen = {n: trials.seen(name, n) for n in box}
            said.append(
                build_where_it_pays(
                    part.spec, part.params, box, tol=part.tolerance, calls=RUNS * steps, needed=seen
                )
            )
    return [words for words in said if words]


def _checked(
    result: ShiftResult, chosen: list[Selected], pool: Pool, run: Callable[[Scene], ShiftResult]
) -> ShiftResult:
    """Check a run and repeat it with higher rungs until every part holds or has its last one.

    Where such a run fails, the last one that came to its end is returned, and why.
    """
    watched = [c for c in chosen if c.verified and c.above]
    checks: list[Check] = []
    again: list[str] = []
    earlier, stopped = 0.0, ""
    while True:
        looked = [check_part(len(again) + 1, c, result, pool) for c in watched]
        found = [check for check in looked if check is not None]
        checks += found
        higher = {check.part: check.above for check in found if not check.holds}
        if not higher:
            break
        words = "run again with " + ", ".join(f"{part} {rung}" for part, rung in higher.items())
        try:
            better = run(with_rungs(result.scene, higher))
        except (ParameterError, SolveError) as problem:
            stopped = f"{words}: it failed, so that the run before it counts ({problem})"
            break
        again.append(words)
        result, earlier = better, earlier + result.wall_time
    if not checks:
        return result
    return replace(result, guard=CheckRecord(checks, again, earlier, stopped))
