"""Step doubling: each communication step is made once whole and once in halves, then judged.

The halves are what counts; the whole step is made to be compared with them and rolled back. The
difference in the transmission's speeds and energies, over ``master_tolerance`` times the value and
its nominal value, is the error; above 1 everything goes back and a shorter step is tried. A PI
controller chooses the next length. Lock-up, break-away and slips that change their sign inside a
half are located and become communication points. FMUs do not let their states be combined, so the
halves are not extrapolated any further.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from math import inf
from typing import Any, NamedTuple

import numpy as np

from ...errors import SolveError
from ..cosim.loop import Recorder, Steps
from ..cosim.schedule import carry_out, gauss_seidel
from ..cosim.system import System, with_state
from ..scene.connections import COMMAND, SPEED

NAME = "step-doubling"
LONGEST, SHORTEST = 16.0, 1.0 / 1024.0  # steps, as shares of the first one
MOST = 500_000  # communication points: all signals of so many still fit into memory
SAFETY, LEAST, MORE = 0.9, 0.2, 2.0  # what the next step may be of the one before
ORDER = 2.0  # of one step's error: that of torques and drags held over a step
NOW, BEFORE = 0.7 / ORDER, 0.4 / ORDER  # exponents of the PI controller
ATTEMPTS = 100  # at one step; a tenth of them lead from the longest length to the shortest
CLOSE = 1e-9  # of a step: how closely an event is located
HALVINGS = 60
TURN = 10.0  # of the error of a slip: less is no change of sign
NEAR = 1e-6  # of a step: an event so close to its end is at its end
PAST = (  # outputs that only tell of the past
    "lock_time", "lock_speed", "release_time", "clutch_filled_time", "brake_filled_time",
    "clutch_kiss_time", "brake_kiss_time",
)  # fmt: skip


class Controller:
    """Chooses lengths of steps by the errors of those before (PI)."""

    def __init__(self, first: float) -> None:
        self.h, self.longest, self.shortest = first, LONGEST * first, SHORTEST * first
        self._before, self._calm = 1.0, True

    def accepted(self, h: float, error: float, tried: float) -> None:
        """Take note of a step; the next one may be longer unless one has just been rejected.

        ``tried`` is longer than ``h`` where an event has cut the step.
        """
        error = max(error, 1e-4)
        factor = SAFETY * error**-NOW * self._before**BEFORE
        most = MORE if self._calm else 1.0
        self.h = self._within(max(h * min(max(factor, LEAST), most), 0.5 * min(tried, self.h)))
        self._before, self._calm = error, True

    def rejected(self, h: float, error: float) -> None:
        """Take note of a step that erred too much, or without limit."""
        factor = SAFETY * error ** (-1.0 / ORDER) if error < inf else LEAST
        self.h = self._within(h * max(LEAST, factor))
        self._calm = False

    def _within(self, h: float) -> float:
        return min(max(h, self.shortest), self.longest)


class Held(NamedTuple):
    """A point of a run, in the order of the system's parts."""

    states: list[Any]
    inputs: list[list[float]]
    outputs: list[list[float]]


class Rollback:
    """Holds points of a run and gives them back; ParameterError if a part has no state to save."""

    def __init__(self, system: System) -> None:
        self.parts = list(system.parts.values())
        self._instances = [with_state(part, NAME) for part in self.parts]

    @contextmanager
    def held(self) -> Iterator[Held]:
        """Hold the present point; it can be given back as long as the block lasts."""
        point = Held(
            [instance.get_state() for instance in self._instances],
            [list(part.inputs) for part in self.parts],
            [list(part.outputs) for part in self.parts],
        )
        try:
            yield point
        finally:
            for instance, state in zip(self._instances, point.states, strict=True):
                instance.free_state(state)

    def give_back(self, held: Held) -> None:
        """Go back to a point, which stays held."""
        for part, instance, state, inputs, outputs in zip(
            self.parts, self._instances, *held, strict=True
        ):
            instance.set_state(state)
            part.inputs, part.outputs = list(inputs), list(outputs)


class Seen(NamedTuple):
    """What an event changes."""

    whole: list[float]  # counts and flags of the moving part, such as its number of lock-ups
    slips: list[float]  # speeds it sends to parts that rub


class Events:
    """Finds events in steps of a system.

    A slip that changes its sign is one if it changes by more than ten times ``tolerance`` of its
    nominal value: what rattles about zero within the error is left alone.
    """

    def __init__(self, system: System, command: Callable[[float], float], tolerance: float) -> None:
        self.system, self._command = system, command
        self.hub = hub = system.transmission
        self._keeper = with_state(hub, NAME)
        kinds = [signal.kind for signal in hub.spec.outputs]
        self._whole = [i for i, kind in enumerate(kinds) if kind in ("integer", "boolean")]
        self._slips = sorted({
            output for part in system.friction_parts for slot, source, output in part.sources
            if source is hub and part.input_names[slot] == SPEED
        })  # fmt: skip
        self._least = [TURN * tolerance * (hub.spec.outputs[i].nominal or 1.0) for i in self._slips]

    def seen(self) -> Seen:
        """Return what there is to be seen at the present point."""
        out = self.hub.outputs
        return Seen([out[i] for i in self._whole], [out[i] for i in self._slips])

    def between(self, a: Seen, b: Seen) -> bool:
        """Tell if there was an event between two points: a count or flag, or a slip turned."""
        turned = any(
            x * y < 0.0 and abs(x - y) > least
            for x, y, least in zip(a.slips, b.slips, self._least, strict=True)
        )
        return turned or a.whole != b.whole

    def locate(self, t: float, h: float, before: Seen, state: Any) -> float:
        """Return the time from ``t`` to the first event in a step of length ``h`` that has one.

        The torques of that step are the hub's present inputs, ``state`` is its state at ``t``;
        after it the hub is somewhere in the step. A step of the length returned has the event.
        """
        hub, low, high = self.hub, 0.0, h
        for _ in range(HALVINGS):
            if high - low <= CLOSE * h:
                break
            middle = 0.5 * (low + high)
            self._keeper.set_state(state)
            self.system.set_command(self._command(t + middle))
            hub.step(t, middle)
            if self.between(before, self.seen()):
                high = middle
            else:
                low = middle
        return high


class Doubling:
    """Steps an initialized system from start to stop and records every point.

    ``tolerance`` is the relative error of one step, ``first`` the length of the first one [s].
    ``stops`` are times that become communication points; the last one ends the run.
    """

    def __init__(
        self, system: System, tolerance: float, command: Callable[[float], float],
        stops: Sequence[float], first: float,
    ) -> None:  # fmt: skip
        self.system, self._command, self._stops = system, command, sorted(stops)
        self._schedule, self._back = gauss_seidel(system), Rollback(system)
        self._events = Events(system, command, tolerance)
        self._hub = self._back.parts.index(system.transmission)
        self._control = Controller(first)
        self.recorder = Recorder(system, 1024)
        self.time: list[float] = []
        hub = system.transmission
        given = {COMMAND, *(hub.input_names[slot] for slot, *_ in hub.sources)}
        self._scales = [
            (i, tolerance, tolerance * (s.nominal or 1.0))
            for i, s in enumerate(hub.spec.outputs)
            if s.kind == "real" and not given.intersection(s.depends) and s.name not in PAST
        ]  # fmt: skip
        self._rejected = self._located = self._forced = 0

    def advance(self) -> float:
        """Take one step, in halves, and return the time reached."""
        with self._back.held() as start:
            return self._advance(start)

    def _advance(self, start: Held) -> float:
        t, points = self.time[-1], len(self.time)
        stop = next(s for s in self._stops if s > t)
        goal, shortest = self._goal(t, stop), 2.0 * self._control.shortest
        for _ in range(ATTEMPTS):
            event, error = self._attempt(t, goal, start)
            reached = self.time[-1]
            if event is None and (error <= 1.0 or goal - t <= shortest):
                self._forced += error > 1.0
                self._control.accepted(reached - t, error, goal - t)
                return reached
            self._rejected += 1
            del self.time[points:]
            self._back.give_back(start)
            if event is not None:  # it shall lie in the second half
                goal = min(stop, t + 4.0 / 3.0 * (event - t))
            else:
                self._control.rejected((reached if reached > t else goal) - t, error)
                goal = min(self._goal(t, stop), goal)
        raise SolveError(
            f"no step at t = {t:g} s meets master_tolerance; take a shorter step or a larger one"
        )

    def steps(self) -> Steps:
        """Return what was done."""
        lengths = np.diff(self.time)
        shortest, longest = float(lengths.min()), float(lengths.max())
        return Steps(len(lengths), self._rejected, shortest, longest, self._located, self._forced)

    def _goal(self, t: float, stop: float) -> float:
        """Return where the step from ``t`` shall end: no sliver is left before the next stop."""
        h, left = self._control.h, stop - t
        if left <= 1.001 * h:
            return stop
        return t + (min(h, 0.5 * left) if left < 2.0 * h else h)

    def _attempt(self, t: float, goal: float, start: Held) -> tuple[float | None, float]:
        """Make and record two halves; return the time of an event in the first, or their error.

        A step that cannot be solved errs without limit, unless it is as short as can be.
        """
        try:
            event = self._part(t, t + 0.5 * (goal - t))
            if event is not None and event - t > 2.0 * self._control.shortest:
                return event, inf
            if event is None:
                event = self._part(self.time[-1], goal)
            if event is not None:
                self._part(self.time[-1], event, landing=True)
            return None, self._error(start, t, self.time[-1])
        except SolveError:
            if goal - t <= 2.0 * self._control.shortest:
                raise
            return None, inf

    def _part(self, t: float, goal: float, landing: bool = False) -> float | None:
        """Step and record; or stay and return the time of an event that is not at an end."""
        before, h = self._events.seen(), goal - t
        with self._back.held() as start:
            self._step(t, goal)
            if landing:
                self._located += 1
            elif self._events.between(before, self._events.seen()):
                event = self._events.locate(t, h, before, start.states[self._hub])
                self._back.give_back(start)
                if self._control.shortest < event < (1.0 - NEAR) * h:
                    return t + event
                self._step(t, goal)
            self.keep(goal)
            return None

    def _error(self, start: Held, t: float, goal: float) -> float:
        """Return how far a whole step ends from where its halves did, 1: as far as it may."""
        with self._back.held() as end:
            self._back.give_back(start)
            self._step(t, goal)
            whole, halves = self.system.transmission.outputs, end.outputs[self._hub]
            self._back.give_back(end)
        return max(
            abs(whole[i] - halves[i]) / (relative * abs(halves[i]) + least)
            for i, relative, least in self._scales
        )

    def _step(self, t: float, goal: float) -> None:
        self.system.set_command(self._command(goal))
        carry_out(self._schedule, t, goal - t)

    def keep(self, time: float) -> None:
        """Record the present point."""
        if len(self.time) >= MOST:
            raise SolveError(
                f"t = {time:g} s is reached after {MOST} communication points; take a larger "
                "master_tolerance, or coupling 'capacity'"
            )
        self.recorder.keep(len(self.time))
        self.time.append(time)
