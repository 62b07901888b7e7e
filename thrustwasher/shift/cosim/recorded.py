"""A part of a finished run in a second one: there it gives the outputs that were recorded."""

from collections.abc import Mapping, Sequence

import numpy as np

from ...model.spec import ModelSpec
from ...numerics.jit import Array
from ..scene.connections import SPEED


class Recorded:
    """Stands in for a part whose outputs another run has recorded, at other steps.

    What a part gives at the end of a step belongs to its inputs at the step's start: a step from
    ``t`` gets what belongs to ``t``, between recorded points in a straight line. Where the part
    stood still its outputs stay those of before: another run may still slide there, and what
    stands still is not moved by them.
    """

    gives_derivatives = True

    def __init__(
        self, spec: ModelSpec, part: str, time: Array, signals: Mapping[str, Array]
    ) -> None:
        self.input_names, self.output_names = (
            [signal.name for signal in signals] for signals in (spec.inputs, spec.outputs)
        )
        self.calls, self.wall_time, self.instantiate_time, self.initialize_time = 0, 0.0, 0.0, 0.0
        rows = np.column_stack([signals[f"{part}.{name}"] for name in self.output_names])
        moving = signals[f"{part}.{SPEED}"] != 0.0
        moving[:2] = True
        last = np.maximum.accumulate(np.where(moving, np.arange(len(moving)), 0))
        self._time, self._rows = time[:-1], rows[last][1:]
        self._now: list[float] = rows[0].tolist()

    def initialize(self, start_time: float, inputs: Mapping[str, float]) -> None:
        """Have the outputs of the start."""

    def set_inputs(self, values: Sequence[float]) -> None:
        """Pass by: what was recorded knows its inputs."""

    def step(self, t: float, h: float) -> None:
        """Have the outputs that belong to ``t``."""
        self._now = self.at(t).tolist()

    def at(self, t: Array | float) -> Array:
        """Return the outputs that belong to the inputs at one time or, a row each, at several."""
        i = np.clip(np.searchsorted(self._time, t, side="right") - 1, 0, len(self._time) - 2)
        a, b = self._time[i], self._time[i + 1]
        share = np.clip((t - a) / (b - a), 0.0, 1.0)[..., np.newaxis]
        return np.asarray(self._rows[i] + share * (self._rows[i + 1] - self._rows[i]))

    def outputs(self) -> list[float]:
        """Return all outputs."""
        return self._now

    def directional_derivative(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> list[float]:
        """Return zeros: outputs follow time alone."""
        return [0.0] * len(unknowns)
