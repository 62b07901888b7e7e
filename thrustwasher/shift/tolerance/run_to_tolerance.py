"""A shift at a tolerance: a run with the cheapest levels, the choice, its check, further runs."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from ...errors import ParameterError, SolveError
from ..checks.guard import guarded
from ..cosim.system import Stepping
from ..run import Progress, cosimulate
from ..scene.connections import DIRECT
from ..scene.scene import Part, Scene
from ..shift_result import ShiftResult
from .level_check import check_part
from .selection import first_level, select
from .selection_record import Check, CheckRecord, Selected, Selection

STEP_SHARE = 0.3  # of the tolerance requested is the communication step's
Make = Callable[[str, Part], Stepping]


class Pool:
    """Instances by part, level and parameters; one that has been used is reset."""

    def __init__(self, make: Make) -> None:
        self._make = make
        self._made: dict[tuple[str, str, Any], Stepping] = {}

    def take(self, name: str, part: Part) -> Stepping:
        """Return an instance that has not been started."""
        key = name, part.fidelity, part.params
        used: Any = self._made.get(key)
        if used is not None and hasattr(used, "reset"):
            used.reset()
        else:
            self._made[key] = self._make(name, part)
        return self._made[key]

    def all_of(
        self, scene: Scene, given: Mapping[str, Stepping] | None = None
    ) -> dict[str, Stepping]:
        """Return an instance for every part of a scene, those that are given as they are."""
        known = given or {}
        return {n: known.get(n) or self.take(n, part) for n, part in scene.parts.items()}


def run_auto(
    scene: Scene,
    make: Make,
    *,
    guard: bool = True,
    progress: Progress | None = None,
    compiled: bool | None = None,
) -> ShiftResult:
    """Simulate a shift; the level of every part that asks for a tolerance is found here.

    Parameters
    ----------
    scene : what to simulate; ``tolerance`` of a part is the relative error requested
    make : returns an instance of a part, of the fidelity that stands in it; whoever makes it closes
        it. One that has ``reset`` is used again
    guard : check the run afterwards: its step by a second run with shorter ones, washers that were
        taken as steady by following them in time, and levels that were chosen; run again a level
        higher where one does not hold, or in time where a washer of a tolerance is not steady
    progress, compiled : as in ``cosimulate``

    Returns
    -------
    ShiftResult : with ``selection``, if levels were chosen, and with what the checks found

    Raises
    ------
    ParameterError, SolveError : as in ``cosimulate``; also if no level of a part holds its
        tolerance
    """
    pool = Pool(make)

    def run(now: Scene) -> ShiftResult:
        return cosimulate(now, pool.all_of(now), progress=progress, compiled=compiled)

    def checked(result: ShiftResult) -> ShiftResult:
        return guarded(result, pool.all_of, partial(cosimulate, compiled=compiled))

    scene, remarks = _without_choice(scene)
    asking = {n: p for n, p in scene.parts.items() if p.tolerance}
    result = run(with_levels(scene, {n: first_level(p, guard) for n, p in asking.items()}))
    chosen = select(scene, result, guard)
    levels = {c.part: c.fidelity for c in chosen}
    if any(result.scene.parts[name].fidelity != level for name, level in levels.items()):
        result = run(with_levels(scene, levels))
    if guard:
        result = checked(_checked(result, chosen, pool, run))
        result = _followed(scene, result, lambda again: checked(run(again)))
        remarks += _step_remarks(result, asking.values())
    selection = Selection(chosen) if chosen else None
    return replace(result, selection=selection, messages=[*result.messages, *remarks])


def with_levels(scene: Scene, levels: Mapping[str, str]) -> Scene:
    """Return the scene with these levels, as they stand."""
    changed = {name: scene.parts[name].at(level) for name, level in levels.items()}
    return replace(scene, parts={**scene.parts, **changed})


def _followed(
    scene: Scene, result: ShiftResult, checked_run: Callable[[Scene], ShiftResult]
) -> ShiftResult:
    """Repeat a run in time where a washer whose level was to be chosen is not steady in it.

    Where that fails the run before it counts, with its warning, and why.
    """
    if not any(scene.parts[n].tolerance and w.differences for n, w in result.in_time.items()):
        return result
    levels = {n: p.fidelity for n, p in result.scene.parts.items() if n not in DIRECT}
    try:
        again = checked_run(with_levels(_in_time(scene), levels))
    except (ParameterError, SolveError) as problem:
        words = f"A run with thermal_mode transient failed ({problem}); the one before it counts"
        return replace(result, found=(*result.found, words))
    words = "; ".join(text for n, w in result.in_time.items() for text in w.warnings(n, "so"))
    return replace(
        again,
        guard=result.guard,
        messages=[*again.messages, f"{words} the run was repeated with thermal_mode transient"],
    )


def _in_time(scene: Scene) -> Scene:
    """Return the scene with washers whose bodies store heat, at a level that can follow it."""
    parts = dict(scene.parts)
    for name in DIRECT:
        if (part := parts.get(name)) is not None:
            params = replace(part.params, thermal_mode="transient")
            level = part.spec.default_fidelity if part.tolerance else part.fidelity
            parts[name] = replace(part, params=params, fidelity=level, tolerance=None)
    return replace(scene, parts=parts)


def _without_choice(scene: Scene) -> tuple[Scene, list[str]]:
    """Return the scene with default levels for parts that follow heat in time, and what to say."""
    parts, remarks = dict(scene.parts), []
    for name, part in parts.items():
        if part.tolerance and getattr(part.params, "thermal_mode", "") == "transient":
            parts[name] = replace(part, tolerance=None)
            remarks.append(
                f"{name}: {part.fidelity}, its default; errors are measured in steady states, and "
                "thermal_mode is transient"
            )
    return replace(scene, parts=parts), remarks


def _step_remarks(result: ShiftResult, asking: Iterable[Part]) -> list[str]:
    """Say that the communication step errs by more than its share of the tolerance, if so."""
    share = STEP_SHARE * min((part.tolerance or 1.0 for part in asking), default=math.inf)
    error = result.step_error
    if error is None or error.relative <= share:
        return []
    return [
        f"communication step {error.step:g} s: it errs by about {100.0 * error.relative:.2g} %, "
        f"more than its share of {100.0 * share:.2g} %; {error.step * share / error.relative:.2g} "
        "s would do"
    ]


def _checked(
    result: ShiftResult, chosen: list[Selected], pool: Pool, run: Callable[[Scene], ShiftResult]
) -> ShiftResult:
    """Check a run and repeat it with higher levels until every part holds or has its last one.

    Only parts whose level has changed are checked again: the others' inputs hardly move. Where a
    repeated run fails, the last one that came to its end is returned, and why.
    """
    watched, checks = chosen, list[Check]()
    again: list[str] = []
    earlier, stopped = 0.0, ""
    while True:
        looked = [check_part(len(again) + 1, c, result, pool.take) for c in watched]
        found = [check for check in looked if check is not None]
        checks += found
        higher = {check.part: check.above for check in found if not check.holds}
        if not higher:
            break
        words = "run again with " + ", ".join(f"{part} {level}" for part, level in higher.items())
        try:
            better = run(with_levels(result.scene, higher))
        except (ParameterError, SolveError) as problem:
            stopped = f"{words}: it failed, so that the run before it counts ({problem})"
            break
        again.append(words)
        result, earlier = better, earlier + result.wall_time
        watched = [c for c in chosen if c.part in higher]
    if not checks:
        return result
    return replace(result, guard=CheckRecord(checks, again, earlier, stopped))
