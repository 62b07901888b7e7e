"""The guard of one part: two instances of it, when they are compared, and what was seen."""

from __future__ import annotations

from time import perf_counter
from typing import NamedTuple

import numpy as np

from ..errors import ParameterError, SolveError, Status
from .blend import Blend
from .guard_plan import Course, Plan, Post, Scale, Switch
from .guard_rules import Memory, decide
from .loop import Run
from .system import ConnectedPart, Stepping

SOON = 4  # a change of regime is looked at this part of a stride after a look, not before
SPEED = "speed"  # the input without which there is nothing to compare
WATCHED = ("regime", "solver_status", "distress")  # outputs whose change is a change of regime


class Held(NamedTuple):
    """What a master that comes back to a point has to give back, beside the instances' states."""

    memory: Memory
    reached: int
    looked: int
    due: int
    since: float
    seen: list[float]
    courses: int


class Sentry:
    """Two rungs of one part: the base serves, the one above follows, or the other way round."""

    def __init__(self, part: ConnectedPart, plan: Plan, run: Run) -> None:
        self.part, self.plan, self.run = part, plan, run
        self.rungs: dict[str, Stepping] = {plan.base: part.instance, plan.above: plan.instance}
        self.memory, self.failed, self.seconds = Memory(), 0, 0.0
        self.looks = {plan.base: [0, 0.0], plan.above: [0, 0.0]}  # calls and time of looks
        self._reached = 0  # the point up to which the other instance has followed
        self._looked, self.due = 0, plan.first or plan.every[0]
        self._courses: list[Course] = []
        self._since = float(run.time[0])
        recorder, names = run.recorder, part.output_names
        first, inputs = recorder.input_place(part, 0), part.input_names
        self._inputs = slice(first, first + len(inputs))
        first = recorder.output_place(part, 0)
        self._outputs = slice(first, first + len(names))
        self.changes = [first + names.index(n) for n in WATCHED if n in names]
        self._status = names.index("solver_status") if "solver_status" in names else None
        self._speed = self._inputs.start + inputs.index(SPEED) if SPEED in inputs else None
        self._scales = [(names.index(s.output), s) for s in plan.scales]
        self._seen: list[float] = []  # outputs of the other instance at the last look
        # Inputs are looked at where they come from: before a step is made with them.
        self.bounds = [
            (float(recorder.output_place(source, output)), *plan.box[inputs[slot]])
            for slot, source, output in part.sources if inputs[slot] in plan.box
        ]  # fmt: skip
        self._follower.initialize(self._since, dict(zip(inputs, part.inputs, strict=True)))

    @property
    def rung(self) -> str:
        """The rung that serves."""
        return self.plan.above if self.memory.up else self.plan.base

    @property
    def other(self) -> str:
        """The rung that follows."""
        return self.plan.base if self.memory.up else self.plan.above

    @property
    def _follower(self) -> Stepping:
        return self.rungs[self.other]

    @property
    def every(self) -> int:
        """Steps between two looks, at present."""
        return self.plan.every[self.memory.up]

    def look(self, i: int) -> Switch | None:
        """Look at point ``i`` if there is a reason to; return the change of rung it calls for."""
        compared = self._is_due(i)
        if self.memory.up and not compared:
            return None
        outside = not self.memory.up and self._outside(i)
        if not (compared or outside) or not self._follow(i):
            return None
        served = self.run.recorder.rows[i, self._outputs].tolist()
        difference, scale, mine, its = self._farthest(served)
        if self.memory.up:
            outside = self._outside(i)
        before, after = self.rung, self.other
        reason = decide(
            self.memory, difference if compared else None, outside, self.plan.tolerance
        )  # fmt: skip
        if reason is None:
            return None
        time = float(self.run.time[i])
        return Switch(time, self.part.name, before, after, reason, scale.output, mine, its)

    def blend(self) -> Blend:
        """Return both instances as one, for the step in which the other takes over."""
        return Blend(self.part.spec, self.rungs[self.other], self.rungs[self.rung])

    def change(self, i: int) -> None:
        """Let the rung that was decided for serve from point ``i`` on."""
        time = float(self.run.time[i])
        self._courses.append(Course(self._since, time, self.other))
        self._since, self._looked, self._reached = time, i, i
        self.due = i + self.every

    def post(self) -> Post:
        """Return what was found."""
        end, m, p = float(self.run.time[-1]), self.memory, self.plan
        courses = [*self._courses, Course(self._since, end, self.rung)]
        return Post(self.part.name, p.base, p.above, p.tolerance, m.checks, self.failed, m.worst,
                    self.seconds, courses)  # fmt: skip

    def hold(self) -> Held:
        """Return what ``give_back`` needs to come back to this point."""
        return Held(self.memory.copy(), self._reached, self._looked, self.due, self._since,
                    list(self._seen), len(self._courses))  # fmt: skip

    def give_back(self, held: Held) -> None:
        """Come back to a point; the states of both instances have to be set as well."""
        self.memory, self._seen = held.memory.copy(), list(held.seen)
        self._reached, self._looked, self.due = held.reached, held.looked, held.due
        self._since = held.since
        del self._courses[held.courses :]
        self.part.instance = self.rungs[self.rung]

    def _is_due(self, i: int) -> bool:
        """Tell if the rungs are to be compared; a change of regime brings the next look forward."""
        rows = self.run.recorder.rows
        if (rows[i, self.changes] != rows[i - 1, self.changes]).any():
            self.due = min(self.due, self._looked + max(1, self.every // SOON))
        if i < self.due:
            return False
        self._looked, self.due = i, i + self.every
        # Nothing turns: no torque in any rung, and no heat.
        return self._speed is None or bool(rows[i, self._speed] != 0.0)

    def _outside(self, i: int) -> bool:
        """Tell if the base is not verified at the coming inputs, or says so itself."""
        row = self.run.recorder.rows[i]
        if any(not low <= row[int(place)] <= high for place, low, high in self.bounds):
            return True
        said = self._seen if self.memory.up else row[self._outputs]
        return self._status is not None and said[self._status] == Status.OUTSIDE_VERIFIED

    def _farthest(self, served: list[float]) -> tuple[float, Scale, float, float]:
        """Return the largest difference, its scale, and the output in both rungs."""
        pairs = [(s, served[k], self._seen[k]) for k, s in self._scales]
        apart = [s.between(b, a) if self.memory.up else s.between(a, b) for s, a, b in pairs]
        k = int(np.argmax(apart))  # the first NaN, if there is one
        return (apart[k], *pairs[k])

    def _follow(self, i: int) -> bool:
        """Let the other instance follow to point ``i``; tell if it could."""
        begin, follower, time = perf_counter(), self._follower, self.run.time
        calls, wall = follower.calls, follower.wall_time
        try:
            if self._reached < i:
                t = float(time[self._reached])
                follower.set_inputs(self.run.recorder.rows[i, self._inputs].tolist())
                follower.step(t, float(time[i]) - t)
                self._reached = i
            self._seen = follower.outputs()
        except (ParameterError, SolveError):
            self.failed += 1
            return False
        finally:
            booked = self.looks[self.other]
            booked[0] += follower.calls - calls
            booked[1] += follower.wall_time - wall
            self.seconds += perf_counter() - begin
        return True
