"""Rows of all inputs and outputs of all parts, one per communication point."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .system import ConnectedPart, System


class Recorder:
    """An array with a row per point; the inputs of each part stand before its outputs."""

    def __init__(self, system: System, n: int) -> None:
        self.parts = list(system.parts.values())
        self.first: dict[str, int] = {}
        width = 0
        for part in self.parts:
            self.first[part.name] = width
            width += len(part.input_names) + len(part.output_names)
        self.rows: NDArray[np.float64] = np.empty((n, width))

    def keep(self, i: int) -> None:
        """Copy the present values to row ``i``."""
        row, at = self.rows[i], 0
        for part in self.parts:
            for values in (part.inputs, part.outputs):
                row[at : at + len(values)] = values
                at += len(values)

    def make_room(self, i: int) -> None:
        """See to it that there is a row ``i``, for runs whose points are not known beforehand."""
        if i >= len(self.rows):
            self.rows = np.concatenate([self.rows, np.empty_like(self.rows)])

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
            f"{part.name}.{name}" for part in self.parts
            for name in (*part.input_names, *part.output_names)
        ]  # fmt: skip
        return {name: self.rows[:, i] for i, name in enumerate(names)}
