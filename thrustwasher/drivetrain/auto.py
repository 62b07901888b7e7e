"""A shift at a tolerance: scout, choose a rung for every part, run under guard."""

from __future__ import annotations

from dataclasses import replace

from ..errors import ParameterError
from .budget import FAR, first_look, seconds_of, step_seconds, strides
from .guard_plan import Plan
from .master import MASTERS
from .result import ShiftResult
from .scene import Scene
from .scout import Make, Pool, scout
from .selection import WITHOUT_PAST, select
from .selection_record import Selected, Selection
from .shift import Progress, run_shift
from .step_share import step_share


def run_auto(
    scene: Scene,
    make: Make,
    *,
    guard: bool = True,
    progress: Progress | None = None,
    compiled: bool | None = None,
) -> ShiftResult:
    """Simulate a shift; the rung of every part that asks for a tolerance is found here.

    Parameters
    ----------
    scene : what to simulate; ``tolerance`` of a part is the relative error asked for
    make : returns an instance of a part, of the fidelity that stands in it; whoever makes it closes
        it. One that has ``reset`` is used again
    guard : watch the run and change a rung where its choice does not hold
    progress, compiled : as in ``run_shift``

    Returns
    -------
    ShiftResult : with ``selection`` and, if there was one, the guard's log

    Raises
    ------
    ParameterError, SolveError : as in ``run_shift``; also if no rung of a part holds its tolerance
    """
    pool = Pool(make)
    scene, remarks = _without_choice(scene)
    asked = [p.tolerance for p in scene.parts.values() if p.tolerance]
    if not asked:
        result = run_shift(scene, pool.all_of(scene), progress=progress, compiled=compiled)
        return replace(result, messages=[*result.messages, *remarks])
    if MASTERS[scene.master].adaptive:
        raise ParameterError(
            f"master = {scene.master!r}, allowed with a fidelity that is to be chosen: masters "
            "with fixed steps; or name the fidelities"
        )
    scouted = scout(scene, pool, compiled)
    steps = max(1, round((scene.stop_time - scene.start_time) / scene.step))
    chosen = select(scene, scouted, steps, guard)
    share = step_share(scouted, scene.step, min(asked))
    selection = Selection(chosen, share, scouted.seconds)
    parts = dict(scene.parts)
    for found in chosen:
        parts[found.part] = replace(parts[found.part], fidelity=found.rung, tolerance=None)
    scene = replace(scene, parts=parts)
    instances = pool.all_of(scene)
    plans = _plans(scene, chosen, pool, steps) if guard else {}
    result = run_shift(
        scene, instances, guards=plans, progress=progress, compiled=compiled
    )  # fmt: skip
    return replace(result, selection=selection, messages=[*result.messages, *remarks])


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


def _plans(scene: Scene, chosen: list[Selected], pool: Pool, steps: int) -> dict[str, Plan]:
    """Return a guard's plan for every part without a past that was chosen and has a rung above."""
    guarded = [c for c in chosen if c.verified and c.above and c.model in WITHOUT_PAST]
    step = step_seconds({n: (p.spec, p.fidelity) for n, p in scene.parts.items()})
    plans = {}
    for c in guarded:
        part, higher = scene.parts[c.part], str(c.above)
        base, above = (seconds_of(part.spec, rung) for rung in (c.rung, higher))
        far = FAR.get(c.model, 1.0)
        every = strides(step, base, above, far=far, guards=len(guarded))
        plans[c.part] = Plan(
            base=c.rung,
            above=higher,
            instance=pool.take(c.part, replace(part, fidelity=higher)),
            scales=c.scales,
            tolerance=c.tolerance,
            box=c.box,
            every=every,
            first=first_look(steps, every[0]),
        )
    return plans
