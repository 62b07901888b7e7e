"""Windows of a run of several shifts: where each began, to run it once more from there."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...numerics.jit import Array
from ..cosim.loop import Drive, Recorder, driven
from ..cosim.recorded import Recorded
from ..cosim.system import System, can, capable
from ..scene.scene import Scene

NEAR = 1e-9  # s


class Windows:
    """Keeps what all parts were where the windows of shifts began; ``free`` gives it back."""

    def __init__(self, system: System, shifts: Sequence[Scene]) -> None:
        self.system, self._parts = system, list(system.parts.values())
        self.able = all(can(part.instance, "saves_state") for part in self._parts)
        self._starts = [shift.start_time for shift in shifts]
        self._began: list[list[tuple[Any, list[float], list[float]]]] = []

    def pass_by(self, time: float) -> None:
        """Keep the present point if a window begins there."""
        i = len(self._began)
        if self.able and i < len(self._starts) and abs(time - self._starts[i]) < NEAR:
            self._began.append(
                [
                    (capable(part.instance).get_state(), list(part.inputs), list(part.outputs))
                    for part in self._parts
                ]
            )

    def again(
        self, i: int, window: float, steps: int, drive: Drive, played: dict[str, Recorded]
    ) -> tuple[Array, Recorder]:
        """Run a window in so many steps; parts that are ``played`` give what was recorded."""
        time = self._starts[i] + window * np.arange(steps + 1) / steps
        own = [part.instance for part in self._parts]
        try:
            for part, began in zip(self._parts, self._began[i], strict=True):
                state, inputs, outputs = began
                if part.name in played:
                    part.instance = played[part.name]
                else:
                    capable(part.instance).set_state(state)
                part.inputs[:], part.outputs = inputs, list(outputs)
            return time, driven(self.system, time, drive)
        finally:
            for part, instance in zip(self._parts, own, strict=True):
                part.instance = instance

    def free(self) -> None:
        """Give all states back."""
        for began in self._began:
            for part, (state, _, _) in zip(self._parts, began, strict=True):
                capable(part.instance).free_state(state)
        self._began.clear()
