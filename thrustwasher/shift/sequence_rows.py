"""What a run of several shifts keeps of its points: all of them, or the figures alone.

Each shift is read when its window has passed. Where figures are all that is kept, the rows of a
window are forgotten then, and a run of a thousand shifts takes no more memory than one of ten.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..numerics.jit import Array
from .cosim.loop import Recorder
from .cosim.system import System
from .run import result_of
from .scene.connections import DIRECT
from .scene.scene import Scene
from .shift_result import ShiftResult

OIL = "sump.temperature"


def read_shift(shift: Scene, system: System, time: Array, rows: Array) -> ShiftResult:
    """Return one shift's result from its rows; energies count from its start."""
    own = Recorder(system, 0)
    own.rows = rows
    signals = own.signals()
    for part in own.parts:
        for signal in part.spec.outputs:
            if signal.unit == "J" and signal.name != "kinetic_energy":
                name = f"{part.name}.{signal.name}"
                signals[name] = signals[name] - signals[name][0]
    return result_of(shift, time, signals, shift.step, 1.0)


def lasts(shift: ShiftResult) -> float:
    """Return how long a shift takes [s], inf if it does not lock."""
    return shift.figures["lock_after_ramp_start"] or np.inf


class EveryPoint:
    """Keeps the rows of all points."""

    def __init__(self, system: System, shifts: Sequence[Scene], time: Array) -> None:
        self.system, self.time, self.recorder = system, time, Recorder(system, len(time))
        self._scenes, self._ends = shifts, _ends(shifts, time)
        self.shifts: list[ShiftResult] = []

    def keep(self, k: int) -> None:
        """Keep the present values as those of point ``k``."""
        self.recorder.keep(k)
        while len(self.shifts) < len(self._ends) and k == self._ends[len(self.shifts)][1]:
            self._read(self.recorder.rows[slice(*self._span)])

    @property
    def _span(self) -> tuple[int, int]:
        first, last = self._ends[len(self.shifts)]
        return first, last + 1

    def _read(self, rows: Array) -> ShiftResult:
        shift = self._scenes[len(self.shifts)]
        self.shifts.append(read_shift(shift, self.system, self.time[slice(*self._span)], rows))
        return self.shifts[-1]

    @property
    def whole(self) -> dict[int, ShiftResult]:
        """The first and the longest shift, with their signals, by their places."""
        longest = int(np.argmax([lasts(shift) for shift in self.shifts]))
        return {i: self.shifts[i] for i in sorted({0, longest})}

    def points(self) -> tuple[Array, dict[str, Array]]:
        """Return times and signals of what is kept."""
        return self.time, self.recorder.signals()

    def watched(self) -> tuple[Array, dict[str, Array]]:
        """Return times and signals of washers that the run takes as steady."""
        return self.points()


class FiguresAlone(EveryPoint):
    """Keeps each shift's figures, the ends of its window and the point of the hottest oil.

    The first and the longest shift stay whole until the checks after the run, and every point of
    washers that the run takes as steady if these are ``followed`` then.
    """

    def __init__(
        self, system: System, shifts: Sequence[Scene], time: Array, *, followed: bool
    ) -> None:
        super().__init__(system, shifts, time[:0])
        self.time, self._ends = time, _ends(shifts, time)
        self._window = Recorder(system, max(b - a + 1 for a, b in self._ends))
        self._now, self._hot = Recorder(system, 1), -np.inf
        self._names = list(self._now.signals())
        self._kept: dict[int, Array] = {}
        self._hottest = (0, self._now.rows[0])
        self._whole: dict[int, ShiftResult] = {}
        self._oil = self._names.index(OIL) if OIL in self._names else None
        steady = [
            name
            for name, part in (shifts[0].parts.items() if followed else ())
            if name in DIRECT and part.params.thermal_mode != "transient"
        ]
        self._columns = [i for i, n in enumerate(self._names) if n.partition(".")[0] in steady]
        self._followed = np.empty((len(time) if steady else 0, len(self._columns)))

    def keep(self, k: int) -> None:
        """Keep what stays of point ``k``; a window that ends here is read and forgotten."""
        self._now.keep(0)
        row = self._now.rows[0]
        if k in (0, len(self.time) - 1):
            self._kept[k] = row.copy()
        if len(self._followed):
            self._followed[k] = row[self._columns]
        if self._oil is not None and row[self._oil] > self._hot:
            self._hot, self._hottest = row[self._oil], (k, row.copy())
        while len(self.shifts) < len(self._ends):
            first, last = self._ends[len(self.shifts)]
            if first <= k <= last:
                self._window.rows[k - first] = row
            if k in (first, last):
                self._kept[k] = row.copy()
            if k < last:
                return
            self._forget(self._read(self._window.rows[: last - first + 1].copy()))

    def _forget(self, shift: ShiftResult) -> None:
        i = len(self.shifts) - 1
        longest = max(self._whole, default=0)
        if i == 0 or lasts(shift) > lasts(self._whole[longest]):
            self._whole = {j: s for j, s in self._whole.items() if j == 0} | {i: shift}
        self.shifts[i] = replace(
            shift, time=shift.time[[0, -1]], signals={}, said=tuple(shift.warnings)
        )

    @property
    def whole(self) -> dict[int, ShiftResult]:
        """The first and the longest shift, with their signals, by their places."""
        return self._whole

    def points(self) -> tuple[Array, dict[str, Array]]:
        """Return times and signals of what is kept."""
        if self._oil is not None:
            self._kept.setdefault(*self._hottest)
        places = sorted(self._kept)
        rows = np.array([self._kept[k] for k in places])
        return self.time[places], {n: rows[:, i] for i, n in enumerate(self._names)}

    def watched(self) -> tuple[Array, dict[str, Array]]:
        """Return times and signals of washers that the run takes as steady."""
        names = [self._names[i] for i in self._columns]
        return self.time, {n: self._followed[:, i] for i, n in enumerate(names)}


def _ends(shifts: Sequence[Scene], time: Array) -> list[tuple[int, int]]:
    """Return the places of the first and last point of each window."""
    starts = np.searchsorted(time, [s.start_time - 1e-9 for s in shifts])
    ends = np.searchsorted(time, [s.stop_time + 1e-9 for s in shifts])
    return [(int(a), int(b) - 1) for a, b in zip(starts, ends, strict=True)]
