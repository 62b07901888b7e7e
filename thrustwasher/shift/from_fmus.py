"""A scene run from FMUs of its own: built if they are missing, freed in the end."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from ..errors import ParameterError
from ..fmu.fmu_cache import fmu_paths
from ..fmu.stepper import Instance
from .run import Progress
from .scene.scene import Part, Scene
from .several_shifts import SequenceResult, run_sequence
from .shift_result import ShiftResult
from .tolerance.run_to_tolerance import Make, run_auto


@contextmanager
def fmu_instances(scene: Scene, target: str = "native") -> Iterator[Make]:
    """Give a function that makes an FMU instance of a part; all are freed in the end."""
    paths = fmu_paths({part.spec.name for part in scene.parts.values()}, target)
    with ExitStack() as alive:

        def make(name: str, part: Part) -> Instance:
            path = paths[part.spec.name]
            return alive.enter_context(Instance(path, parameters=part.parameters(), name=name))

        yield make


def check_levels(scene: Scene, where: str = "with [sequence]") -> None:
    """Refuse a fidelity that is still to be chosen."""
    if open_ := [name for name, part in scene.parts.items() if part.tolerance]:
        raise ParameterError(
            f"fidelity of {', '.join(open_)} = auto, allowed {where}: a fidelity level by "
            f"name, as in "
            f"{open_[0]}={scene.parts[open_[0]].spec.default_fidelity}"
        )


def run_scene(
    scene: Scene,
    make: Make,
    *,
    guard: bool = True,
    progress: Progress | None = None,
    keep: str = "all",
) -> ShiftResult | SequenceResult:
    """Return the result of a scene of one shift or several; arguments as in ``run_auto``.

    ``keep``: of several shifts, as in ``run_sequence``.
    """
    if not scene.sequence:
        return run_auto(scene, make, guard=guard, progress=progress)
    check_levels(scene)
    instances = {name: make(name, part) for name, part in scene.parts.items()}
    return run_sequence(scene, instances, guard=guard, progress=progress, keep=keep)
