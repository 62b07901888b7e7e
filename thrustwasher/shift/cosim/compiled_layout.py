"""Lays a run out for the compiled loop, operations, addresses and buffers, and drives it."""

import ctypes
import sys
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, SolveError
from ...numerics.jit import way
from ..scene.connections import COMMAND
from .loop import Run
from .recorded import Recorded
from .schedule import Correct, Pull
from .system import capable, renamed


def can_compile(run: Run) -> bool:
    """Tell if every part gives its addresses or plays a record, and if kernels are compiled.

    A schedule with corrections runs in Python.
    """
    if way() == "python" or sys.maxsize < 2**32:
        return False
    if any(isinstance(action, Correct) for action in run.schedule):
        return False
    instances = [part.instance for part in run.system.parts.values()]
    return all(hasattr(one, "machine") or isinstance(one, Recorded) for one in instances)


class CompiledLoop:
    """Steps the parts in compiled code; comes back to Python when one has logged something."""

    def __init__(self, run: Run) -> None:
        from . import compiled_loop as c

        self.run, self.codes = run, c
        self.parts = list(run.system.parts.values())
        self._lay_out()
        n, recorder, hub = len(self.parts), run.recorder, run.system.transmission
        self._report = np.zeros(3, np.int64)
        self._spent, self._calls = np.zeros(n), np.zeros(n, np.int64)
        self._back, self._ticks = np.zeros(4, np.int64), np.zeros(2, np.int64)
        clock, tick = wall_clock(self._ticks)
        self._now = np.zeros(recorder.rows.shape[1])
        played = [
            p.instance.at(run.time[:-1]) for p in self.parts if isinstance(p.instance, Recorded)
        ]
        recorded = np.concatenate(played, axis=1) if played else np.zeros((1, 1))
        self._arguments: list[Any] = [
            np.array(self._operations, np.int64),
            np.array(self._places, np.int64),
            self._now,
            self._back.ctypes.data,
            clock,
            tick,
            np.zeros(n),
            self._spent,
            self._calls,
            run.time,
            run.h,
            run.commands,
            recorder.input_place(hub, hub.input_names.index(COMMAND)),
            recorder.rows,
            recorded,
        ]
        self._run(0)  # compiled or loaded before time counts

    def _run(self, stop: int) -> int:
        """Work through the operations up to a point, or until an instance reports something."""
        return self.codes.run_operations(*[*self._arguments, stop, self._report])

    def _lay_out(self) -> None:
        """List the operations of one communication step."""
        self._places: list[int] = []
        self._operations: list[list[int]] = []
        self._played, recorder = 0, self.run.recorder  # columns of what is recorded
        for action in self.run.schedule:
            number = self.parts.index(action.part)
            if isinstance(action, Pull):
                sources, first = action.part.sources, len(self._places)
                for slot, source, output in sources:
                    self._places.append(recorder.input_place(action.part, slot))
                    self._places.append(recorder.output_place(source, output))
                self._add(self.codes.PULL, number, count=len(sources), first=first)
            else:
                self._step(number)

    def _add(self, kind: int, part: int, **columns: int) -> None:
        c = self.codes
        row = [0] * c.WIDTH
        row[c.KIND], row[c.PART] = kind, part
        for name, value in columns.items():
            row[getattr(c, name.upper())] = value
        self._operations.append(row)

    def _step(self, number: int) -> None:
        c, part, recorder = self.codes, self.parts[number], self.run.recorder
        inputs, outputs = recorder.input_place(part, 0), recorder.output_place(part, 0)
        if isinstance(part.instance, Recorded):
            count = len(part.output_names)
            self._add(c.REPLAY, number, count=count, values=self._played, first=outputs)
            self._played += count
            return
        fmu = capable(part.instance).machine()
        call = {"component": fmu.component, "logged": fmu.logged, "third": fmu.third}

        def travel(kind: int, groups: Any, first: int) -> None:
            for group in groups:
                self._add(
                    kind,
                    number,
                    function=group.function,
                    references=group.references,
                    count=len(group.places),
                    values=group.values,
                    type=getattr(c, group.kind),
                    first=len(self._places),
                    **call,
                )
                self._places.extend(first + place for place in group.places)

        self._add(c.BEGIN, number)
        travel(c.SET, fmu.setters, inputs)
        self._add(c.STEP, number, function=fmu.step, **call)
        travel(c.GET, fmu.getters, outputs)
        self._add(c.END, number)

    def advance(self, i: int, stop: int) -> None:
        """Step from point ``i`` to point ``stop``."""
        c, report = self.codes, self._report
        self._now[:] = self.run.recorder.rows[i]
        report[:] = i, 0, 0
        try:
            while self._run(stop) == c.REPORTED:
                self._judge()
        finally:
            self._count()
        self.run.recorder.give_back(self._now)

    def _judge(self) -> None:
        """Raise if the last call failed, as stepping in Python would."""
        c, report = self.codes, self._report
        operation = self._operations[int(report[c.AT_OPERATION]) - 1]
        part = self.parts[operation[c.PART]]
        stage = {c.SET: "set", c.STEP: "step", c.GET: "get"}[operation[c.KIND]]
        try:
            capable(part.instance).judge(stage, int(report[c.LAST_STATUS]))
        except (ParameterError, SolveError) as problem:
            time = float(self.run.time[report[c.AT_POINT]])
            raise renamed(problem, part.name, time) from problem

    def _count(self) -> None:
        """Add calls and time to the instances' own counts."""
        for part, calls, spent in zip(self.parts, self._calls, self._spent, strict=True):
            part.instance.calls += int(calls)
            part.instance.wall_time += float(spent)
        self._calls[:], self._spent[:] = 0, 0.0


def wall_clock(ticks: NDArray[np.int64]) -> tuple[NDArray[np.int64], float]:
    """Return the operating system's clock: (function, its number or -1, place), seconds a tick."""
    place = ticks.ctypes.data
    if sys.platform == "win32":
        library = ctypes.WinDLL("kernel32")
        rate = ctypes.c_int64(0)
        library.QueryPerformanceFrequency(ctypes.byref(rate))
        function, number = library.QueryPerformanceCounter, -1
    else:
        try:
            function, number = ctypes.CDLL(None).clock_gettime, time.CLOCK_MONOTONIC
        except AttributeError:  # costs are then not known, everything else is
            return np.zeros(3, np.int64), 0.0
        rate = ctypes.c_int64(1)
    address = ctypes.cast(function, ctypes.c_void_p).value or 0
    return np.array([address, number, place], np.int64), 1.0 / rate.value
