"""Windows of a run of several shifts: where each began, to run it once more from there."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ...numerics.jit import Array
from ..cosim.loop import Recorder
from ..cosim.recorded import Recorded
from ..cosim.schedule import carry_out, gauss_seidel
from ..cosim.system import System, can, capable
from ..scene.scene import Scene

Drive = Callable[[float, float], None]
NEAR = 1e-9  # s


class Began(NamedTuple):
    """Where a window began, in the order of the system's parts."""

    states: list[Any]
    inputs: list[list[float]]
    outputs: list[list[float]]


class Windows:
    """Keeps what all parts were where the windows of shifts began; ``free`` gives it back."""

    def __init__(self, system: System, shifts: Sequence[Scene]) -> None:
        self.system, self._parts = system, list(system.parts.values())
        self.able = all(can(part.instance, "saves_state") for part in self._parts)
        self._starts = [shift.start_time for shift in shifts]
        self._began: list[Began] = []

    def pass_by(self, time: float) -> None:
        """Keep the present point if a window begins there."""
        i = len(self._began)
        if self.able and i < len(self._starts) and abs(time - self._starts[i]) < NEAR:
            self._began.append(
                Began(
                    [capable(part.instance).get_state() for part in self._parts],
                    [list(part.inputs) for part in self._parts],
                    [list(part.outputs) for part in self._parts],
                )
            )

    def again(
        self, i: int, window: float, steps: int, drive: Drive, played: dict[str, Recorded]
    ) -> tuple[Array, Recorder]:
        """Run a window in so many steps; parts that are ``played`` give what was recorded."""
        began = self._began[i]
        time = self._starts[i] + window * np.arange(steps + 1) / steps
        own = [part.instance for part in self._parts]
        recorder, schedule = Recorder(self.system, len(time)), gauss_seidel(self.system)
        try:
            for part, state, inputs, outputs in zip(self._parts, *began, strict=True):
                if part.name in played:
                    part.instance = played[part.name]
                else:
                    capable(part.instance).set_state(state)
                part.inputs[:], part.outputs = inputs, list(outputs)
            recorder.keep(0)
            for k, (t, end) in enumerate(pairwise(time.tolist()), 1):
                drive(t, end)
                carry_out(schedule, t, end - t)
                recorder.keep(k)
        finally:
            for part, instance in zip(self._parts, own, strict=True):
                part.instance = instance
        return time, recorder

    def free(self) -> None:
        """Give all states back."""
        for began in self._began:
            for part, state in zip(self._parts, began.states, strict=True):
                capable(part.instance).free_state(state)
        self._began.clear()
