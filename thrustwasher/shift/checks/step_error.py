"""What the communication step is worth: a second run with shorter steps, and the difference.

In the second run washers give the torque over time that the first one has recorded: they hardly
feed back, and the run costs what packs, meshes and transmission cost. With an error of first order
in the step, x(h) - x is m/(m - 1) times x(h) - x(h/m). Twice the step instead of a fraction of it
would be cheaper and is not used: errors of several steps cross zero there, and long steps are far
from any order.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import floor, log10

from ...numerics.jit import Array
from ..cosim.recorded import Recorded
from ..cosim.system import Stepping
from ..masters.master import MASTERS
from ..scene.connections import DIRECT
from ..scene.scene import MAX_STEPS, STEP_RANGE, Scene
from ..shift_result import ShiftResult
from .step_estimate import LIMITS, StepError, excess

SAFE = 0.8  # of a limit: what an advice has to keep
TRIED = 2.0  # of the step that the error's order says would do: the longest that is tried
LEAST, ENOUGH = 4, 4000  # the second run: steps as short at least; so many of them do
LEAST_HEAT, LEAST_JERK = 1e-4, 1.0  # of the work done, m/s3: shares of less say nothing
Run = Callable[[Scene, Mapping[str, Stepping]], ShiftResult]
Make = Callable[[Scene, Mapping[str, Stepping]], dict[str, Stepping]]


def step_error(result: ShiftResult, make: Make, run: Run) -> StepError:
    """Return what the step of a finished shift is worth.

    ``make`` returns instances for a scene, some of them given; ``run`` runs it. SolveError or
    ParameterError where the second run finds no end.
    """
    scene = result.scene
    played = recorded_parts(scene, result.time, result.signals)

    def again(step: float) -> ShiftResult:
        other = replace(scene, step=step)
        return run(other, make(other, played))

    parts = parts_of_a_step(scene, result.step, result.steps)
    return by_step(result, again(result.step / parts), again)


def recorded_parts(scene: Scene, time: Array, signals: Mapping[str, Array]) -> dict[str, Recorded]:
    """Return stand-ins for the washers of a run."""
    return {
        name: Recorded(part.spec, name, time, signals)
        for name, part in scene.parts.items()
        if name in DIRECT
    }


def parts_of_a_step(scene: Scene, step: float, steps: int) -> float:
    """Return how many steps of the second run make one of the first; 0.5 where there is no room."""
    parts = float(LEAST)
    while steps * parts < ENOUGH:
        parts *= 2.0
    if MASTERS[scene.master].in_python:
        parts /= 2.0
    while parts > 1.0 and (steps * parts > MAX_STEPS or step / parts < STEP_RANGE[0]):
        parts /= 2.0
    return parts if parts > 1.0 else 0.5


def by_step(
    result: ShiftResult, finer: ShiftResult, again: Callable[[float], ShiftResult] | None = None
) -> StepError:
    """Return the errors of a run by one with shorter steps; ``again`` tries a step that would do.

    Where errors are too large the advice is tried in a run of its own, and halved as long as it
    errs too much.
    """
    h, fine = result.step, finer.step
    errors = errors_between(result, finer, h / abs(h - fine))
    advice, over = h, excess(errors)
    if over > 1.0:
        advice = min(rounded(TRIED * h / over), rounded(0.99 * h))
        while again and advice > 2.0 * fine:
            tried = errors_between(again(advice), finer, advice / (advice - fine))
            if excess(tried) <= SAFE:
                break
            advice = rounded(0.5 * advice)
        advice = advice if again else rounded(SAFE * h / over)
    return StepError(step=h, compared_with=fine, advice=advice, **errors)


def errors_between(run: ShiftResult, finer: ShiftResult, factor: float) -> dict[str, float]:
    """Return ``factor`` times the differences of two runs, relative to the finer one's figures."""
    mine, its, start = run.figures, finer.figures, run.scene.shift_start

    def share(name: str, zero: float = 0.0, least: float = 1e-300) -> float | None:
        a, b = mine.get(name), its.get(name)
        if a is None or b is None:
            return None if a is b else 1.0
        return factor * abs(a - b) / max(abs(a - zero), abs(b - zero), least)

    work = LEAST_HEAT * max(abs(run.energy["engine_work"]), abs(run.energy["kinetic"]), 1e-6)
    found = (
        share("lock_time", zero=start),
        share("slip_energy", least=work) or 0.0,
        share("peak_jerk", least=LEAST_JERK),
    )
    return {n: x for n, x in zip(LIMITS, found, strict=True) if x is not None}


def rounded(value: float) -> float:
    """Return the next smaller of 1, 2 and 5 times a power of ten."""
    ten = 10.0 ** floor(log10(value))
    return next(k * ten for k in (5.0, 2.0, 1.0, 0.5) if k * ten <= value * (1.0 + 1e-9))
