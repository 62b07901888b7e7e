"""One running model: arrays, checks, lazy outputs, steps; knows no protocol and no FMU."""

from collections.abc import Sequence
from dataclasses import fields
from enum import IntEnum
from functools import partial
from math import isfinite
from struct import pack, unpack
from typing import Any

import numpy as np

from ...errors import FIRST_FAILURE, ParameterError, SolveError, Status
from ...model.prepare import fill_table, is_of_table, wants_table
from ...model.registry import kernel_of
from ...native.load import bound
from ...tribology.holding.memory import N_FIGURES
from ...units import into_range
from ..description.interface import Interface, Variable
from ..model_kernels import content_digest
from .snapshot import ARRAYS, Snapshot
from .warnings import Warnings, is_no_temperature


class Mode(IntEnum):
    """Where an instance is in its life."""

    INSTANTIATED = 0
    INITIALIZING = 1
    STEPPING = 2
    TERMINATED = 3


def rounding_of(t: float, other: float) -> float:
    """Return how far rounding may move times [s] apart: some spacings of the later one.

    A host may count in single precision; then its times are numbers of that.
    """
    (bits,) = unpack("<Q", pack("<d", t))
    spacing = 2.0**-52 if bits & 0x1FFFFFFF else 2.0**-23
    return 4.0 * spacing * max(abs(t), abs(other))


class Core:
    """Memory and life of one instance.

    Outputs are lazy: a value that changes marks them; the next reading solves once with ``dt = 0``,
    which leaves ``state`` alone, so that readings never change what follows. A step either succeeds
    or leaves everything as it was, except the status that tells why.
    """

    def __init__(self, shown: Interface) -> None:
        kernel = kernel_of(shown.spec)
        self.shown, self.spec, self._derive = shown, shown.spec, kernel.derive
        self._broken_rule = getattr(kernel, "broken_rule", None)
        self.variables = shown.variables
        self.par, given = np.zeros(kernel.NPAR), np.zeros(2 * kernel.NINP)
        self.inp, self.rates = given[: kernel.NINP], given[kernel.NINP :]  # rates: [unit/s]
        self._takes_rates = hasattr(kernel, "NRATES")
        self.state, self.work = np.zeros(kernel.NSTATE), np.zeros(kernel.NWORK)
        self.out, self.iout = np.zeros(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
        taken = given if self._takes_rates else self.inp
        self._arrays = {name: getattr(self, name) for name in (*ARRAYS, "work")}
        handed = {name: a for name, a in self._arrays.items() if name != "rates"}
        told, status = getattr(kernel, "W_TOLD", -1), ("iout", shown.status_slot)
        self._run_start = getattr(kernel, "RUN_START", -1)
        self.told = self.work[told : told + N_FIGURES] if told >= 0 else np.zeros(0)
        self._step = bound(kernel.step, **handed | {"inp": taken})
        self._undo = self.state.copy(), self.out.copy(), self.iout.copy()
        self._zeros = np.zeros(kernel.NOUT)
        self._warnings = Warnings(self)
        self.time, self.mode = 0.0, Mode.INSTANTIATED
        self.dirty, self.prepared = True, False
        self.latch = 0  # the failure to be seen in solver_status until something changes
        self._unsolved = ""  # why the present outputs cannot be had
        # variables whose last value was not taken over, and why if the newest call refused it
        self.refused: dict[int, str] = {}
        self.events: list[str] = []  # what happened in the last step
        self.late = ""  # what is said if the last step did not begin where the one before ended
        self._told_late = False
        self._seen = [0 for _ in shown.switches]  # at the last communication point
        for v in self.variables:
            if v.start is not None:
                self._arrays[v.store][v.slot] = v.start
        # what is called a million times in a run: places of inputs, and how values are read
        real = [v for v in shown.inputs if v.type == "Real"]
        self._places = {v.reference: (v.slot, *v.bounds) for v in real}
        plain = [v.store != "time" and (v.store, v.slot) != status for v in self.variables]
        self._readers = [
            partial(self._arrays[v.store].item, v.slot) if is_plain else partial(self.value, v)
            for v, is_plain in zip(self.variables, plain, strict=True)
        ]

    def set(self, references: Sequence[int], values: Sequence[float], kind: str) -> None:
        """Take over all values or, if one is not allowed, none (ParameterError)."""
        if kind == "Real" and not self.refused and self._take_inputs(references, values):
            return
        taken = []
        found = [self._find(reference, kind) for reference in references]
        for v, given in zip(found, values, strict=True):
            value = into_range(*v.bounds, given)
            problem = self._problem(v, value)
            if problem:
                self.latch = Status.BAD_INPUT
                self._refuse(references, problem)
                raise ParameterError(problem)
            taken.append((v, value))
        for v, value in taken:
            array = self._arrays[v.store]
            if is_no_temperature(v, value):
                value = self.value(v)
                self._warnings.note_zero(v, value)
            if array.item(v.slot) != value:
                array[v.slot] = value
                self.dirty, self.latch, self._unsolved = True, 0, ""
                self.prepared = self.prepared and v.store != "par"
            if self.refused.pop(v.reference, None) is not None and not self.refused:
                self.latch = 0

    def _take_inputs(self, references: Sequence[int], values: Sequence[float]) -> bool:
        """Take over values of real inputs, all within their ranges; else none, and return False."""
        inp, places, slots = self.inp, self._places, []
        if len(references) != len(values):
            return False
        for reference, given in zip(references, values, strict=True):
            place = places.get(reference)
            if place is None or not place[1] <= given <= place[2]:
                return False
            slots.append(place[0])
        for slot, given in zip(slots, values, strict=True):
            if inp.item(slot) != given:
                inp[slot] = given
                self.dirty, self.latch, self._unsolved = True, 0, ""
        return True

    def zeros(self) -> list[str]:
        """Return what has to be said of inputs at 0 K: each once in a run."""
        return self._warnings.zeros()

    def set_rates(self, references: Sequence[int], rates: Sequence[float]) -> None:
        """Let inputs move in the next step, straight, all or none of them (ParameterError)."""
        found = [self._find(reference, "Real") for reference in references]
        for v, rate in zip(found, rates, strict=True):
            problem = ""
            if v.causality != "input":
                problem = f"{v.name}: only Real inputs have a rate of change"
            elif not isfinite(rate):
                text = f"{rate!r} {v.unit}/s, allowed: a finite number"
                problem = f"{v.name}: rate of change = {text}"
            if problem:
                self.latch = Status.BAD_INPUT
                raise ParameterError(problem)
        for v, rate in zip(found, rates, strict=True):
            self.rates[v.slot] = rate

    def _refuse(self, references: Sequence[int], problem: str) -> None:
        """Remember that the values of this call are missing: no step until they are set."""
        self.refused = dict.fromkeys(self.refused, "")
        for reference in references:
            v = self.variables[reference]
            if v.causality in ("input", "parameter") and self._may_set(v):
                self.refused[reference] = problem

    def _may_set(self, v: Variable) -> bool:
        """Tell if an input or parameter may be set now; a map is for one set of parameters."""
        if v.causality == "input" or self.mode < Mode.STEPPING:
            return True
        held = is_of_table(self.spec, self.par, v.slot)
        return v.variability == "tunable" and self.mode == Mode.STEPPING and not held

    def get(self, references: Sequence[int], kind: str) -> list[float]:
        """Return present values; outputs that are out of date are solved first."""
        found = [self._find(reference, kind) for reference in references]
        if self.dirty and any(v.causality == "output" for v in found):
            if not (self.latch and all(v.type_name == "SolverStatus" for v in found)):
                self.refresh()
        return [self.value(v) for v in found]

    def stored(self, references: Sequence[int]) -> list[float]:
        """Return what is stored, solving nothing; 0 for an unknown reference."""
        readers, n = self._readers, len(self._readers)
        return [readers[r]() if 0 <= r < n else 0.0 for r in references]

    def value(self, v: Variable) -> float:
        """Return the present value of a variable."""
        if v.store == "time":
            return self.time
        if self.latch and v.store == "iout" and v.slot == self.shown.status_slot:
            return self.latch
        value: float = self._arrays[v.store].item(v.slot)
        return value

    def _find(self, reference: int, kind: str) -> Variable:
        if not 0 <= reference < len(self.variables):
            raise ParameterError(f"value reference {reference} is unknown in {self.spec.name}")
        v = self.variables[reference]
        is_whole = v.type in ("Enumeration", "Boolean") and kind == "Integer"
        if v.type != kind and not is_whole:
            raise ParameterError(f"{v.name} is of type {v.type}, not {kind}")
        return v

    def _problem(self, v: Variable, value: float) -> str:
        """Say why a value cannot be taken over; empty if it can."""
        if v.causality not in ("input", "parameter"):
            return f"{v.name} is an {v.causality} variable; it cannot be set"
        if not self._may_set(v):
            if self.value(v) == value:  # no change
                return ""
            tuned = v.variability == "tunable" and self.mode == Mode.STEPPING
            held = " with fidelity 'map', made for one value" if tuned else ""
            return (
                f"{v.name} is a fixed parameter{held}; it can be set before the initialization ends"
            )
        low, high = v.bounds
        if low <= value <= high or is_no_temperature(v, value):  # False for NaN
            return ""
        unit = "" if v.unit == "1" else f" {v.unit}"
        allowed = f"{low:g} .. {high:g}{unit}"
        if v.type_name:
            items = self.shown.listed[v.type_name]
            allowed = ", ".join(f"{i.value} ({i.name})" for i in items)
        text = f"{v.name} = {value:g}{unit} is outside {allowed}; the value is not taken over."
        if v.unit == "K" and not v.relative and low <= value + 273.15 <= high:
            text += f" Did you mean {value + 273.15:g} K ({value:g} degC)?"
        return text

    def prepare(self) -> None:
        """Check the rules between parameters and compute the derived constants."""
        if self.prepared:
            return
        failed, self.latch = self.latch, Status.BAD_INPUT
        params = self.parameters()  # raises, naming the rule
        number = self._broken_rule(self.par) if self._broken_rule and self.spec.rules else 0
        if number:  # one that concerns the fidelity too
            raise ParameterError(self.spec.rules[number - 1].message(params))
        rc = self._derive(self.par)
        if rc >= FIRST_FAILURE:
            raise ParameterError(f"the parameters cannot be used: {Status(rc).advice}")
        fill_table(self.spec, params, self.par, self.work)
        self.prepared, self.latch = True, failed

    def parameters(self) -> Any:
        """Return the parameters as the model's dataclass, which checks the rules between them."""
        named: dict[str, Any] = {}
        for f, value in zip(fields(self.spec.params), self.par.tolist(), strict=False):
            kind = f.metadata["kind"]
            if kind == "enumeration":
                value = list(f.metadata["options"])[int(value) - 1]
            elif kind != "real":
                value = bool(value) if kind == "boolean" else int(value)
            named[f.name] = value
        return self.spec.params(**named)

    def begin(self, start_time: float) -> None:
        """Enter initialization at a time [s]."""
        if not isfinite(start_time):
            raise ParameterError(f"start time = {start_time!r} s, allowed: a finite number")
        self.time, self.mode = start_time, Mode.INITIALIZING
        if self._run_start >= 0:
            self.par[self._run_start] = start_time

    def leave_initialization(self) -> None:
        """Check the parameters and solve the start point; after a failure the mode stays."""
        self._check_complete("start", self.time, "parameter")
        self.prepare()
        self.refresh()
        self.mode = Mode.STEPPING
        self.note_switches()  # how a run starts is no event

    def _check_complete(self, what: str, t: float, *causalities: str) -> None:
        """Raise SolveError with the newest refusal while a value is missing."""
        missing = [r for r in self.refused if self.variables[r].causality in causalities]
        if missing:
            self.latch = Status.BAD_INPUT
            why = f"{self.variables[max(missing)].name} was refused before; set it again"
            why = next((self.refused[r] for r in missing if self.refused[r]), why)
            raise SolveError(f"no {what} at t = {t:g} s: {why}")

    def refresh(self) -> None:
        """Bring the outputs up to date, at most once per change; a failure is latched."""
        if not self.dirty:
            return
        if self._unsolved:  # the same inputs would fail again
            raise SolveError(self._unsolved)
        self.prepare()
        rc = self._solve(0.0)
        if rc:
            self.latch, self._unsolved = rc, self._story(rc, f"t = {self.time:g} s")
            raise SolveError(self._unsolved)
        self.dirty = False

    def advance(self, t: float, h: float) -> None:
        """Step from ``t`` to ``t + h``, or raise SolveError and leave everything as it was."""
        if self.mode != Mode.STEPPING:
            raise ParameterError(
                f"a step is not allowed while {self.mode.name.lower()}; initialize first"
            )
        if not (0.0 < h < np.inf and -np.inf < t + h < np.inf):
            self.latch = Status.BAD_INPUT
            raise ParameterError(f"step from t = {t!r} s by {h!r} s, allowed: finite, step > 0")
        self._check_complete("step", t, "input", "parameter")
        if not self.prepared:
            self.prepare()
        before, self.time = self.time, t
        self.late = self.long = ""
        if t + h == t:  # what is left of a run at its end: nothing moves
            self.rates[:], self.events = 0.0, []
            self.refresh()
            return
        rc = self._follow(h)
        if rc:
            self.time, self.latch = before, rc
            raise SolveError(self._story(rc, f"t = {t:g} s, step {h:g} s"))
        self.time, self.latch, self._unsolved = t + h, 0, ""
        if not self._told_late and abs(t - before) > 1e-6 * h + rounding_of(t, before):
            self._told_late = True
            self.late = f"step from t = {t!r} s, but the last one ended at {before!r} s; "
            self.late += "the host's time counts, and this is said once"
        self.long = self._warnings.long_step(h)
        if self._seen:
            self.events = self.note_switches()

    def messages(self) -> list[tuple[str, str]]:
        """Return (category, text) of all that a host has to be told after a step."""
        sent = [("logStatusWarning", text) for text in (self.late, self.long)]
        sent += [("logEvents", text) for text in self.events]
        sent.append(("logNonlinearSystems", self.effort))
        sent += [("logStatusWarning", text) for text in self.advice()]
        return [(category, text) for category, text in sent if text]

    def note_switches(self) -> list[str]:
        """Return one sentence for each event since the last communication point."""
        switches = self.shown.switches
        seen, self._seen = self._seen, [self.iout.item(slot) for slot, _ in switches]
        pairs = zip(switches, seen, self._seen, strict=True)
        return [
            f"{self.here}: {texts[0 if now else 1]}; {self.point(self.shown.point)}"
            for (_, texts), before, now in pairs
            if now != before
        ]

    @property
    def here(self) -> str:
        """Model and time, as sentences begin."""
        return f"{self.spec.name} at t = {self.time:g} s"

    @property
    def effort(self) -> str:
        """What the last solve took, "" if the model's solver counts nothing."""
        counted = [f"{text}: {self.work.item(place):g}" for text, place in self.shown.counts]
        return f"{self.here}, {', '.join(counted)}" if counted else ""

    def _solve(self, h: float) -> int:
        """Call the kernel; after a failure ``state`` and the outputs are what they were."""
        state, out, iout = self._undo
        state[:], out[:], iout[:] = self.state, self.out, self.iout
        rc = self._step(self.time, h)
        if rc < FIRST_FAILURE and self.out.dot(self._zeros) != 0.0:  # NaN if any is not finite
            rc = Status.NOT_FINITE
        if rc < FIRST_FAILURE:
            return 0
        self.state[:], self.out[:], self.iout[:] = state, out, iout
        return int(rc)

    def _follow(self, h: float) -> int:
        """Step along the inputs' rates; then they are those at the end and have no rates.

        A model that takes no rates steps with the inputs at the middle; its outputs are solved anew
        when they are read. What would leave its range ends where the range does.
        """
        if not self.rates.any():
            rc = self._solve(h)
            self.dirty = self.dirty and rc != 0
            return rc
        given, rates = self.inp.copy(), self.rates.copy()
        for v in self.shown.inputs:
            low, high = v.bounds
            value, rate = given.item(v.slot), rates.item(v.slot)
            if rate != 0.0 and not low <= value + rate * h <= high:
                end = high if rate > 0.0 else low
                self.rates[v.slot] = (1.0 - 1e-15) * (end - value) / h
        moved = np.where(self.rates == 0.0, given, given + self.rates * h)
        if not self._takes_rates:
            self.inp[:] = np.where(self.rates == 0.0, given, given + 0.5 * self.rates * h)
        rc = self._solve(h)
        self.inp[:], self.rates[:] = (given, rates) if rc else (moved, 0.0)
        self.dirty = self.dirty if rc else not self._takes_rates
        return rc

    def solve_aside(self) -> None:
        """Let ``work`` belong to the present point; outputs and memory stay as they are."""
        out, iout = self.out.copy(), self.iout.copy()
        self._step(self.time, 0.0)
        self.out[:], self.iout[:] = out, iout

    def _story(self, rc: int, where: str) -> str:
        point = self.point(self.shown.inputs)
        return f"{self.spec.name} at {where}, {point}: {Status(rc).name}: {Status(rc).advice}"

    def point(self, variables: Sequence[Variable]) -> str:
        """Return the values of variables in words."""
        values = [(v, self.value(v)) for v in variables]
        return ", ".join(f"{v.name} = {x:g} {v.unit}".removesuffix(" 1") for v, x in values)

    def advice(self) -> list[str]:
        """Return what the host has to be warned of now, the gravest first: each once in a run."""
        return self._warnings.advice()

    def counts(self) -> list[str]:
        """Return, for the end of a run, how often it was as was warned of once."""
        return self._warnings.counts()

    @property
    def status(self) -> Status:
        """How the last solution was obtained."""
        slot = self.shown.status_slot
        solved = 0 if slot is None else self.iout.item(slot)
        return Status(self.latch or solved)

    def snapshot(self) -> Snapshot:
        """Copy all that decides what comes next."""
        return Snapshot(
            identity=content_digest(self.spec),
            **{name: self._arrays[name].copy() for name in ARRAYS},
            time=self.time,
            mode=int(self.mode),
            dirty=self.dirty,
            prepared=self.prepared,
            latch=int(self.latch),
            refused=np.array(sorted(self.refused), np.int32),
            seen=np.array(self._seen, np.int32),
        )

    def restore(self, snapshot: Snapshot) -> None:
        """Go back to a snapshot of this model and version, or raise ParameterError."""
        mine = content_digest(self.spec)
        fits = all(getattr(snapshot, n).shape == self._arrays[n].shape for n in ARRAYS)
        if snapshot.identity != mine or not fits or len(snapshot.seen) != len(self._seen):
            raise ParameterError(
                f"FMU state of another model or version ({snapshot.identity}), "
                f"allowed: {self.spec.name} {mine}"
            )
        for name in ARRAYS:
            self._arrays[name][:] = getattr(snapshot, name)
        self.time, self.mode = snapshot.time, Mode(snapshot.mode)
        self.dirty, self.prepared = snapshot.dirty, snapshot.prepared
        self.latch, self._unsolved = snapshot.latch, ""
        self._seen, self.events = snapshot.seen.tolist(), []
        self.refused = dict.fromkeys(snapshot.refused.tolist(), "")
        if self.prepared and wants_table(self.spec, self.par):  # it is no part of a snapshot
            fill_table(self.spec, self.parameters(), self.par, self.work)
