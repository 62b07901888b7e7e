"""The guard: watches the run that rungs were chosen for, and changes a rung where it must.

While a cheap rung serves, a second instance of the rung above follows in long strides, is compared
at every look, and takes over at a communication point where the two are too far apart or the cheap
one was not verified. In the step that follows both run and their outputs are mixed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from .guard_plan import GuardLog, Plan, Switch
from .loop import Loop, PythonLoop, Run, Watch
from .sentry import Held, Sentry


class Guard:
    """Drives a run and looks after the rungs of its parts."""

    def __init__(
        self, run: Run, plans: Mapping[str, Plan], make_loop: Callable[[Run], Loop]
    ) -> None:
        self.run, self._make_loop = run, make_loop
        self.sentries = [Sentry(run.system.parts[n], plan, run) for n, plan in plans.items()]
        self.switches: list[Switch] = []
        self._loops: dict[tuple[bool, ...], Loop] = {}
        self._python = PythonLoop(run)
        self._loop()  # compiled before time counts

    def advance(self, i: int, stop: int) -> int:
        """Step from point ``i`` to ``stop``, or to the first point that had to be looked at."""
        stop = min(stop, *(max(s.due, i + 1) for s in self.sentries))
        i = self._loop().advance(i, stop, self._watch())
        if i >= len(self.run.time) - 1:
            return i
        changing = []
        for sentry in self.sentries:
            switch = sentry.look(i)
            if switch:
                self.switches.append(switch)
                changing.append(sentry)
        if not changing:
            return i
        self._blend(changing, i)
        return i + 1

    def log(self) -> GuardLog:
        """Return what was seen and done."""
        return GuardLog([s.post() for s in self.sentries], list(self.switches))

    def hold(self) -> tuple[int, list[Held]]:
        """Return what ``give_back`` needs: part of what a rollback of the master restores."""
        return len(self.switches), [s.hold() for s in self.sentries]

    def give_back(self, held: tuple[int, list[Held]]) -> None:
        """Come back to a point; the instances' own states have to be set as well."""
        del self.switches[held[0] :]
        for sentry, its in zip(self.sentries, held[1], strict=True):
            sentry.give_back(its)

    def _loop(self) -> Loop:
        key = tuple(s.memory.up for s in self.sentries)
        if key not in self._loops:
            self._loops[key] = self._make_loop(self.run)
        return self._loops[key]

    def _watch(self) -> Watch:
        changes = [place for s in self.sentries for place in s.changes]
        bounds = [b for s in self.sentries if not s.memory.up for b in s.bounds]
        return Watch(np.array(changes, np.int64), np.array(bounds).reshape(-1, 3))

    def _blend(self, changing: list[Sentry], i: int) -> None:
        """Make one step with both rungs, then let the new one serve."""
        for s in changing:
            s.part.instance = s.blend()
        try:
            self._python.advance(i, i + 1)
        finally:
            for s in changing:
                s.part.instance = s.rungs[s.rung]
        for s in changing:
            s.change(i + 1)
