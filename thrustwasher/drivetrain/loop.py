"""The loop over communication points, in Python; any instance can be stepped so."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from .moves import Move, Pull, Step
from .recorder import Recorder
from .system import System


class Run(NamedTuple):
    """What a loop works on."""

    system: System
    schedule: list[Move]
    time: NDArray[np.float64]
    h: float
    commands: NDArray[np.float64]
    """The shift command at each time."""
    recorder: Recorder


class Watch(NamedTuple):
    """What ends a stretch before its time; places are columns of the recorder."""

    changes: NDArray[np.int64]
    """Values that were others at the point before."""
    bounds: NDArray[np.float64]
    """Rows of place, low, high: values outside."""

    def notices(self, rows: NDArray[np.float64], i: int) -> bool:
        """Tell if point ``i`` is one to look at."""
        if (rows[i, self.changes] != rows[i - 1, self.changes]).any():
            return True
        values = rows[i, self.bounds[:, 0].astype(np.int64)]
        return not ((self.bounds[:, 1] <= values) & (values <= self.bounds[:, 2])).all()


NOTHING = Watch(np.zeros(0, np.int64), np.zeros((0, 3)))


class Loop(Protocol):
    """A way to carry a run from one communication point to another."""

    def advance(self, i: int, stop: int, watch: Watch = NOTHING) -> int:
        """Step from point ``i`` to point ``stop`` and record every point on the way.

        Returns the point reached: ``stop``, or the first that ``watch`` notices. ParameterError or
        SolveError names the part and the time where it failed.
        """


def carry_out(schedule: list[Move], t: float, h: float) -> None:
    """Make the moves of the step from ``t`` to ``t + h``."""
    for move in schedule:
        if isinstance(move, Step):
            move.part.step(t, h)
        elif isinstance(move, Pull):
            move.part.pull()
        else:
            move.change(t, h)


class PythonLoop:
    """Steps the parts one call after another."""

    def __init__(self, run: Run) -> None:
        self.run = run

    def advance(self, i: int, stop: int, watch: Watch = NOTHING) -> int:
        """Step from point ``i`` to point ``stop``."""
        system, schedule, time, h, commands, recorder = self.run
        for k in range(i, stop):
            t = float(time[k])
            system.set_command(float(commands[k + 1]))
            carry_out(schedule, t, h)
            recorder.keep(k + 1)
            if watch.notices(recorder.rows, k + 1):
                return k + 1
        return stop
