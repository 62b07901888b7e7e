"""FMU instances that stay alive and are stepped, through FMPy.

``Instance`` and ``DirectInstance`` (the kernels without an FMU) have one face, so that a master
does not see which of the two it drives. Inputs and outputs go in the order of ``input_names`` and
``output_names``; integers, enumerations and Booleans as floats. Load from one thread: FMPy changes
the working directory while it loads.
"""

import os
from collections.abc import Callable, Mapping, Sequence
from ctypes import c_double
from pathlib import Path
from time import perf_counter
from typing import Any

from ..errors import FIRST_FAILURE, ParameterError, SolveError, Status
from .running import loading
from .running.direct_instance import DirectInstance, Stepped, number, unknown
from .running.loading import WARNING, Message, Messages, unpack
from .running.protocol import Direction, Machine, Protocol, Table, machine_of

__all__ = ["DirectInstance", "Instance", "unpack"]

# What a call of a step is called when it fails, and what is raised then.
STAGES: dict[str, tuple[str, type[Exception]]] = {
    "set": ("setting a value", ParameterError),
    "step": ("step", SolveError),
    "get": ("reading a value", SolveError),
}
WORDS = {2: "discarded", 3: "error", 4: "fatal: the FMU cannot go on"}


class Instance(Stepped):
    """An instantiated co-simulation FMU of FMI 2.0 or 3.0.

    Parameters
    ----------
    path : the FMU
    parameters : values by name, set again after every ``reset``; enumerations as number or name
    name : instance name that messages carry

    A call that fails raises: ParameterError for a value that is not taken over, SolveError for a
    step or solution that failed, with the FMU's own message; after a failed step the FMU is where
    it was before. ``warnings`` keeps the texts of warnings, ``notes`` what else the FMU sent, as
    (status, category, text), for categories switched on with ``log``. ``saves_state``: the FMU can
    save its state; ``gives_derivatives``: it has directional derivatives.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        parameters: Mapping[str, object] | None = None,
        name: str | None = None,
    ) -> None:
        from fmpy.fmi1 import FMICallException

        start = perf_counter()
        self._call_failure = FMICallException
        self.path = Path(path)
        folder = unpack(path)
        self.description = loading.description(folder)
        self.saves_state, self.gives_derivatives = loading.capabilities(folder)
        self._by_name = {v.name: v for v in self.description.modelVariables}
        listed = self.description.modelVariables
        inputs, outputs = ([v for v in listed if v.causality == c] for c in ("input", "output"))
        self.input_names = [v.name for v in inputs]
        self.output_names = [v.name for v in outputs]
        self._status = next((v for v in outputs if v.name == "solver_status"), None)
        self._messages = Messages()
        self.warnings: list[str] = []
        self.notes: list[Message] = []
        self._fmu: Any = loading.instantiate(
            folder, self.description, name or self.path.stem, self._messages
        )
        self._protocol = Protocol(self._fmu, int(self.description.fmiVersion[0]))
        self._inputs, self._outputs = (Table(self._protocol, vs) for vs in (inputs, outputs))
        self._directions: dict[tuple[tuple[str, ...], tuple[str, ...]], Direction] = {}
        self._read: dict[tuple[str, ...], Table] = {}  # what ``get`` was requested
        try:
            self.log(False)
            self._parameters = self._filled(parameters or {}, "parameter")
            self._put(self._parameters)
        except BaseException:
            self.close()
            raise
        self.instantiate_time = perf_counter() - start

    def initialize(
        self, start_time: float = 0.0, inputs: Mapping[str, float] | None = None
    ) -> None:
        """Set the inputs at the start and solve there."""
        start = perf_counter()
        self._call(self._protocol.begin, start_time)
        self._put(self._filled(inputs or {}, "input"))
        self._call(self._fmu.exitInitializationMode)
        status = self._read_status()
        if status >= FIRST_FAILURE:
            raise SolveError(f"{self.path.stem} at the start: {status.name}: {status.advice}")
        self.initialize_time = perf_counter() - start

    def set_inputs(self, values: Sequence[float]) -> None:
        """Set all inputs."""
        start = perf_counter()
        if len(values) != len(self.input_names):
            raise ParameterError(
                f"inputs = {len(values)} values, allowed: {len(self.input_names)} "
                f"({', '.join(self.input_names)})"
            )
        self._inputs.fill(values)
        self._put(self._inputs)
        self.wall_time += perf_counter() - start

    def set_rates(self, rates: Sequence[float]) -> None:
        """Let the inputs, in their order, move straight in the next step [their unit/s]; FMI 2."""
        if self.description.fmiVersion.startswith("3"):
            raise ParameterError(
                "rates of inputs: FMI 2.0 only; FMI 3.0 asks for the inputs itself"
            )
        self._judge(self._protocol.set_rates(self._inputs, rates), *STAGES["set"])

    def step(self, t: float, h: float) -> None:
        """Advance from ``t`` to ``t + h``; SolveError if there is no solution."""
        start = perf_counter()
        self.calls += 1
        try:
            self._judge(self._protocol.step(t, h), *STAGES["step"])
        finally:
            self.wall_time += perf_counter() - start

    def outputs(self) -> list[float]:
        """Return all outputs."""
        start = perf_counter()
        values = self._fetch(self._outputs)
        self.wall_time += perf_counter() - start
        return values

    def get(self, names: Sequence[str]) -> list[float]:
        """Return variables by name."""
        known, asked = self._by_name, tuple(names)
        if asked not in self._read:
            found = [known.get(name) or unknown(name, list(known)) for name in asked]
            self._read[asked] = Table(self._protocol, found)
        return self._fetch(self._read[asked])

    def directional_derivative(
        self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]
    ) -> list[float]:
        """Return how real outputs change along a direction, memory held.

        ``knowns`` are inputs and, as the FMU allows them, parameters.
        """
        start = perf_counter()
        asked = tuple(unknowns), tuple(knowns)
        direction = self._directions.get(asked)
        if direction is None:
            found = (
                [self._named(n, *c) for n in names]
                for names, c in zip(asked, (("output",), ("input", "parameter")), strict=True)
            )
            direction = self._directions[asked] = Direction(self._protocol, *found)
        if len(seed) != len(knowns):
            raise ParameterError(f"seed = {len(seed)} values, allowed: {len(knowns)}")
        direction.seed[:] = list(seed)
        self._judge(direction.get(), "directional derivative")
        self.wall_time += perf_counter() - start
        return direction.slope[:]

    def machine(self) -> Machine:
        """Return the addresses of all that a step needs; valid until ``close``."""
        logged = self._messages.logged
        logged.value = 0
        return machine_of(self._protocol, self._inputs, self._outputs, logged)

    def judge(self, stage: str, status: int) -> None:
        """Raise what a call made past this object would have raised: "set", "step" or "get"."""
        self._messages.logged.value = 0
        self._judge(status, *STAGES[stage])

    def get_state(self) -> Any:
        """Return a handle of the complete state; give it back with ``free_state``."""
        return self._call(self._fmu.getFMUState)

    def set_state(self, state: object) -> None:
        """Go back to a state."""
        self._call(self._fmu.setFMUState, state)

    def free_state(self, state: object) -> None:
        """Give a state back."""
        self._call(self._fmu.freeFMUState, state)

    def serialize(self, state: object) -> bytes:
        """Return a state as bytes."""
        data: bytes = self._call(self._fmu.serializeFMUState, state)
        return data

    def deserialize(self, data: bytes) -> Any:
        """Return a handle of the state in bytes of ``serialize``."""
        return self._call(self._fmu.deserializeFMUState, data)

    def reset(self, parameters: Mapping[str, object] | None = None) -> None:
        """Go back to the start values and the parameters given last; to others from now on."""
        self._call(self._fmu.reset)
        if parameters is not None:
            self._parameters = self._filled(parameters, "parameter")
        self._put(self._parameters)

    def close(self) -> None:
        """Free the instance; calling it again is harmless."""
        fmu, self._fmu = self._fmu, None
        if fmu is not None:
            fmu.freeInstance()

    def log(self, on: bool = True, categories: Sequence[str] = ()) -> None:
        """Choose what goes to ``notes`` next to failures and warnings; none named: everything."""
        known = [c.name for c in self.description.logCategories]
        strange = [c for c in categories if c not in known]
        if strange:
            raise ParameterError(f"category = {strange[0]!r}, allowed: {', '.join(known)}")
        always = [name for name in known if name.startswith("logStatus")]
        chosen = [*always, *(categories or known)] if on else always
        self._call(self._fmu.setDebugLogging, True, list(dict.fromkeys(chosen)))

    def _named(self, name: str, *causalities: str) -> Any:
        v = self._by_name.get(name)
        if v is None or v.causality not in causalities:
            listed = self.description.modelVariables
            unknown(name, [v.name for v in listed if v.causality in causalities])
        return v

    def _filled(self, values: Mapping[str, object], causality: str) -> Table:
        """Return a table that holds values by name."""
        found = [self._named(name, causality) for name in values]
        numbers = []
        for v, value in zip(found, values.values(), strict=True):
            items = v.declaredType.items if v.type == "Enumeration" else ()
            given = number(v.name, value, {i.name: int(i.value) for i in items or ()})
            whole = self._protocol.types[v.type][1] is not c_double
            if whole and given != int(given):
                raise ParameterError(f"{v.name} = {given!r}, allowed: a whole number")
            numbers.append(given)
        table = Table(self._protocol, found)
        table.fill(numbers)
        return table

    def _put(self, table: Table) -> None:
        for group in table.groups:
            self._judge(group.set(), *STAGES["set"])

    def _fetch(self, table: Table) -> list[float]:
        for group in table.groups:
            self._judge(group.get(), *STAGES["get"])
        return table.read()

    def _judge(self, status: int, what: str, kind: type[Exception] = SolveError) -> None:
        """Turn a bad status or a logged error into an exception with the FMU's message."""
        if status > WARNING or self._messages:
            failed = status > WARNING
            word = WORDS.get(status, f"status {status}")
            self._raise_messages(f"{self.path.stem}: {what}: {word}" if failed else "", kind)

    def _call(self, function: Callable[..., Any], *args: object) -> Any:
        """Call FMPy, which raises at a bad status, and judge as above."""
        failed, result = "", None
        try:
            result = function(*args)
        except self._call_failure as problem:
            failed = str(problem)
        if failed or self._messages:
            self._raise_messages(failed)
        return result

    def _raise_messages(self, failed: str, kind: type[Exception] = SolveError) -> None:
        messages, self._messages[:] = list(self._messages), []
        errors = [m.text for m in messages if m.status > WARNING]
        self.warnings += [m.text for m in messages if m.status == WARNING]
        self.notes += [m for m in messages if m.status < WARNING]
        if not (failed or errors):
            return
        status = self._read_status()
        text = "; ".join(errors) or failed
        if not errors and status:
            text += f"; {status.name}: {status.advice}"
        raise (ParameterError if status == Status.BAD_INPUT else kind)(text)

    def _read_status(self) -> Status:
        """Read solver_status plainly, so that reading it cannot fail in turn."""
        if self._status is None:
            return Status.OK
        before = len(self._messages)
        one = Table(self._protocol, [self._status])
        failed = any(group.get() > WARNING for group in one.groups)
        del self._messages[before:]
        return Status.NOT_FINITE if failed else Status(int(one.read()[0]))
