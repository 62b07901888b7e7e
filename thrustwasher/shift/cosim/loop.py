"""The loop over communication points, in Python; any instance can be stepped so."""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .schedule import Schedule, carry_out, gauss_seidel
from .system import ConnectedPart, System

Drive = Callable[[float, float], None]  # sets the transmission's inputs for a step: its two ends


class Recorder:
    """Inputs and outputs of all parts: a row per point, each part's inputs before its outputs."""

    def __init__(self, system: System, n: int) -> None:
        self.parts = list(system.parts.values())
        self.first: dict[str, int] = {}
        width = 0
        for part in self.parts:
            self.first[part.name] = width
            width += len(part.input_names) + len(part.output_names)
        # NaN: not reached.
        self.rows: NDArray[np.float64] = np.full((n, width), np.nan)

    def keep(self, i: int) -> None:
        """Copy the present values to row ``i``."""
        row, at = self.rows[i], 0
        for part in self.parts:
            for values in (part.inputs, part.outputs):
                row[at : at + len(values)] = values
                at += len(values)

    def give_back(self, row: NDArray[np.float64]) -> None:
        """Let the parts have the values of a row for their present ones."""
        values, at = row.tolist(), 0
        for part in self.parts:
            between = at + len(part.input_names)
            end = between + len(part.output_names)
            part.inputs, part.outputs, at = values[at:between], values[between:end], end

    def input_place(self, part: ConnectedPart, slot: int) -> int:
        """Return the column of an input."""
        return self.first[part.name] + slot

    def output_place(self, part: ConnectedPart, slot: int) -> int:
        """Return the column of an output."""
        return self.first[part.name] + len(part.input_names) + slot

    def signals(self) -> dict[str, NDArray[np.float64]]:
        """Return the columns by name."""
        names = [
            f"{part.name}.{name}"
            for part in self.parts
            for name in (*part.input_names, *part.output_names)
        ]
        return {name: self.rows[:, i] for i, name in enumerate(names)}


class Run(NamedTuple):
    """What a loop works on."""

    system: System
    schedule: Schedule
    time: NDArray[np.float64]
    h: float
    commands: NDArray[np.float64]  # the shift command at each time
    recorder: Recorder


def advance_in_python(run: Run, i: int, stop: int) -> None:
    """Step from point ``i`` to point ``stop``, one call after another, and record every point."""
    system, schedule, time, h, commands, recorder = run
    for k in range(i, stop):
        t = float(time[k])
        system.set_command(float(commands[k + 1]))
        carry_out(schedule, t, h)
        recorder.keep(k + 1)


def driven(
    system: System, time: NDArray[np.float64], drive: Drive, keep: Callable[[int], None]
) -> None:
    """Step the parts in turn over times any distance apart; every point is handed to ``keep``."""
    schedule = gauss_seidel(system)
    keep(0)
    for k, (t, end) in enumerate(pairwise(time), 1):
        drive(float(t), float(end))
        carry_out(schedule, float(t), float(end - t))
        keep(k)
