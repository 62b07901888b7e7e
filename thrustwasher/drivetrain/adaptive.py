"""A run of a scene with a master that chooses its steps itself."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..errors import ParameterError
from .loop import Run
from .scene import Scene
from .step_doubling import Doubling
from .steps import Steps
from .system import System

Progress = Callable[[int, int], None]


def check_adaptive(scene: Scene, guarded: bool, compiled: bool | None) -> None:
    """Raise ParameterError for what needs steps that are known beforehand."""
    if guarded or compiled:
        what = "guards" if guarded else "compiled = True"
        raise ParameterError(
            f"{what} with master = {scene.master!r}, allowed: with masters of fixed steps"
        )


def run_adaptive(
    scene: Scene, system: System, progress: Progress | None
) -> tuple[Run, Steps]:  # fmt: skip
    """Step an initialized system to the end of its scene."""
    begin, end = scene.start_time, scene.stop_time
    corners = (scene.shift_start, scene.shift_start + scene.shift_duration)
    stops = [*(t for t in corners if begin < t < end), end]
    master = Doubling(system, scene.master_tolerance, scene.command, stops, scene.step)
    master.begin(begin)
    time, said = begin, 0
    while time < end:
        time = master.advance()
        percent = int(100.0 * (time - begin) / (end - begin))
        if progress is not None and percent > said:
            said = percent
            progress(percent, 100)
    steps, recorder = master.steps(), master.recorder
    recorder.rows = recorder.rows[: len(master.time)]
    commands = np.array([scene.command(t) for t in master.time])
    return Run(system, [], np.array(master.time), steps.longest, commands, recorder), steps
