"""Windows of a run of several shifts: where each began, to run it once more from there."""

from collections.abc import Collection, Sequence
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
        self._began: dict[int, list[tuple[Any, list[float], list[float]]]] = {}
        self._next = 0
        self.over = 0  # windows that have ended

    def pass_by(self, time: float) -> None:
        """Keep the present point if a window begins there."""
        i = self._next
        if self.able and i < len(self._starts) and abs(time - self._starts[i]) < NEAR:
            self._next += 1
            self._began[i] = [
                (capable(part.instance).get_state(), list(part.inputs), list(part.outputs))
                for part in self._parts
            ]

    def again(
        self, i: int, window: float, steps: int, drive: Drive, played: dict[str, Recorded]
    ) -> tuple[Array, Array]:
        """Run a window in so many steps and return times and rows.

        Parts that are ``played`` give what was recorded.
        """
        recorder = Recorder(self.system, steps + 1)
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
            driven(self.system, time, drive, recorder.keep)
            return time, recorder.rows
        finally:
            for part, instance in zip(self._parts, own, strict=True):
                part.instance = instance

    def free(self, *, but: Collection[int] = ()) -> None:
        """Give the states back, ``but`` those of some windows; the last one's run goes on."""
        for i in [i for i in self._began if i not in but]:
            for part, (state, _, _) in zip(self._parts, self._began.pop(i), strict=True):
                capable(part.instance).free_state(state)
