"""Measured means of recordings, and a model that is stepped along them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....errors import ParameterError, Status
from ....numerics.jit import Array
from ..measured import Measured
from .binned import Run

History = dict[str, Array]
Walk = Callable[[Any, str, Run], "History | Status"]
"""Steps a part (parameters, level) along a run: its outputs (m,), or why it cannot go on."""
Follows = Callable[["Traced", Mapping[str, float]], tuple[Array, Array]]
"""Of recordings and changed parameters: changes of computed and of measured values, (n, columns)
each, a column for one standard deviation of each measured value that inputs follow from."""


@dataclass(frozen=True)
class Traced(Measured):
    """Measured means of runs; a row is a mean, the runs one after the other."""

    runs: tuple[Run, ...] = ()
    walk: Walk | None = field(default=None, repr=False)
    matters: Mapping[str, float] = field(default_factory=dict)
    """By parameter, a change [SI] that would certainly matter; of others their range says it."""
    follows: Follows | None = field(default=None, repr=False)
    """What the scatter of measured values does by inputs that follow from them; None: none do."""

    @property
    def pieces_text(self) -> str:
        """Of how many recordings the values are, if of several."""
        return f" of {len(self.runs)} recordings" if len(self.runs) > 1 else ""

    @property
    def starts(self) -> list[int]:
        """Rows at which the runs begin, and the end."""
        return [0, *np.cumsum([len(run.time) for run in self.runs]).tolist()]

    @property
    def time(self) -> Array:
        """Time of each value in its recording [s], (n,)."""
        return np.asarray(np.concatenate([run.time for run in self.runs])[self.row])

    @property
    def run_of(self) -> Array:
        """Place of each value's run, from 0, (n,)."""
        return np.asarray(np.searchsorted(self.starts, self.row, "right") - 1)

    @property
    def is_open(self) -> NDArray[np.bool_]:
        """Tell of each value if the pack is open there, (n,)."""
        return np.asarray(np.concatenate([run.engaged for run in self.runs])[self.row] == 0)

    @property
    def n_engagements(self) -> int:
        """Engagements in all runs."""
        return int(sum(run.engaged.max(initial=0) for run in self.runs))

    def histories(self, changes: Mapping[str, float]) -> list[History | Status]:
        """Return the outputs along every run with changed parameters, or why there are none."""
        assert self.walk is not None
        try:
            params = replace(self.plan.params[0], **changes)
            return [self.walk(params, self.plan.fidelity, run) for run in self.runs]
        except ParameterError:  # a rule between parameters
            return [Status.BAD_INPUT] * len(self.runs)

    def computed(self, changes: Mapping[str, float]) -> tuple[Array, dict[int, Status]]:
        """Return the outputs [SI] with changed parameters, (n,), and the rows that failed, why."""
        found = np.full(len(self.value), np.nan)
        failed: dict[int, Status] = {}
        place, output, starts = self.run_of, np.array(self.output), self.starts
        for k, history in enumerate(self.histories(changes)):
            if isinstance(history, Status):
                failed |= dict.fromkeys(range(starts[k], starts[k + 1]), history)
                continue
            for name, values in history.items():
                mine = (place == k) & (output == name)
                found[mine] = values[self.row[mine] - starts[k]]
        return found, failed

    def with_run(self, place: int, run: Run) -> "Traced":
        """Return the recordings with another run in one's place."""
        return replace(self, runs=(*self.runs[:place], run, *self.runs[place + 1 :]))

    def shifted(self, seed: int) -> "Traced":
        """Return the recordings with inputs that scatter once more, by what their rows scatter."""
        rng = np.random.default_rng(seed)
        runs = []
        for run in self.runs:
            inputs = dict(run.inputs)
            for name in inputs:
                size = run.scatter.get(name, 0.0) / np.sqrt(run.sizes)
                inputs[name] = inputs[name] + size * rng.standard_normal(len(size))
            runs.append(replace(run, inputs=inputs))
        return replace(self, runs=tuple(runs))

    def slopes(self, changes: Mapping[str, float], names: Sequence[str]) -> Array | None:
        """Return None: along a time history there are differences only."""
        return None

    def drawn_over(self, output: str) -> dict[str, tuple[str, Array]]:
        """Return the time of every value (n,), the recordings one after the other."""
        parts, end = [], 0.0
        for run in self.runs:
            parts.append(run.time - run.time[0] + end)
            end = float(parts[-1][-1]) + 0.05 * float(run.time[-1] - run.time[0])
        return {"time": ("s", np.concatenate(parts)[self.row])}

    def parts(self, output: str, values: Array) -> list[Array]:
        """Return numbers of all values as those of one output, run by run in time."""
        mine, place = self.of(output), self.run_of
        return [values[mine & (place == k)] for k in range(len(self.runs))]
