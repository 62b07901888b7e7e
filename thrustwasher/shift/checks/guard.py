"""After a run: what its step is worth, and whether steady states hold for its washers."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from ...errors import ParameterError, SolveError
from ...numerics.jit import Array
from ..cosim.system import Stepping, capable
from ..scene.connections import DIRECT
from ..scene.scene import Scene
from ..shift_result import ShiftResult
from ..warning_texts import Ranked
from .step_error import Make, Run, step_error
from .washer_in_time import InTime, washer_in_time

REMEDY = 'set [washer] thermal_mode = "transient"'


def guarded(result: ShiftResult, make: Make, run: Run) -> ShiftResult:
    """Return a finished shift with what the checks after it have found; as in ``step_error``.

    Both checks leave Python free most of the time: they go side by side.
    """
    error, found = None, list[str]()
    with ThreadPoolExecutor(1) as aside:
        follow = aside.submit(
            followed_washers, result.scene, result.time, result.signals, result.step
        )
        try:
            error = step_error(result, make, run)
            found += map(Ranked, error.warnings())
        except (ParameterError, SolveError) as problem:
            found.append(f"The communication step was not checked: a second run failed ({problem})")
        followed = follow.result()
    for name, washer in followed.items():
        found += washer.warnings(name, REMEDY)
    return replace(result, step_error=error, in_time=followed, found=(*result.found, *found))


def followed_washers(
    scene: Scene, time: Array, signals: Mapping[str, Array], step: float
) -> dict[str, InTime]:
    """Return the washers of a run that were taken as steady, followed in time."""
    return {
        name: washer_in_time(part, name, time, signals, step)
        for name, part in scene.parts.items()
        if name in DIRECT and part.params.thermal_mode != "transient"
    }


def reset(instances: Mapping[str, Stepping]) -> Make:
    """Return what gives the same instances, reset, for another run."""
    fixed = [name for name, instance in instances.items() if not hasattr(instance, "reset")]

    def make(scene: Scene, given: Mapping[str, Stepping]) -> dict[str, Stepping]:
        if missing := [name for name in fixed if name in scene.parts and name not in given]:
            raise ParameterError(f"{', '.join(missing)} cannot be reset")
        for name in scene.parts:
            if name not in given:
                capable(instances[name]).reset()
        return {name: given.get(name, instances[name]) for name in scene.parts}

    return make
