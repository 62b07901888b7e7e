"""FMU instances that stay alive and are stepped, through FMPy.

``Instance`` and ``DirectInstance`` (the kernels without an FMU) have one face, so that a master
does not see which of the two it drives. Inputs and outputs go in the order of ``input_names`` and
``output_names``; integers, enumerations and Booleans as floats. Load from one thread: FMPy changes
the working directory while it loads.
"""

import ctypes
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any, Self

from ..errors import FIRST_FAILURE, ParameterError, SolveError, Status
from .direct import DirectInstance, number, unknown
from .loading import WARNING, description, instantiate, unpack

__all__ = ["DirectInstance", "Instance", "unpack"]

TYPES = {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer", "Boolean": "Boolean"}
C_TYPES: dict[str, Any] = {
    "Real": ctypes.c_double, "Integer": ctypes.c_int, "Boolean": ctypes.c_int,
}  # fmt: skip


class _Group:
    """Variables of one FMI type that travel in one call; the C arrays are made once."""

    def __init__(self, kind: str, references: Sequence[int], places: Sequence[int]) -> None:
        self.kind, self.places, self.n = kind, places, len(references)
        self.references = (ctypes.c_uint * self.n)(*references)
        self.values = (C_TYPES[kind] * self.n)()


def _groups(found: Sequence[Any]) -> list[_Group]:
    groups = []
    for kind in C_TYPES:
        places = [i for i, v in enumerate(found) if TYPES[v.type] == kind]
        if places:
            groups.append(_Group(kind, [found[i].valueReference for i in places], places))
    return groups


class Instance:
    """An instantiated FMI 2.0 co-simulation FMU.

    Parameters
    ----------
    path
        The FMU.
    parameters
        Values by name, set again after every ``reset``; enumerations as number or item name.
    name
        Instance name that messages carry.

    A call that fails raises: ParameterError for a value that is not taken over, SolveError for a
    step or solution that failed, with the FMU's own message.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        parameters: Mapping[str, Any] | None = None,
        name: str | None = None,
    ) -> None:
        from fmpy.fmi1 import FMICallException

        start = perf_counter()
        self._call_failure = FMICallException
        self.path = Path(path)
        folder = unpack(path)
        self.description = description(folder)
        self._by_name = {v.name: v for v in self.description.modelVariables}
        chosen = {
            c: [v for v in self.description.modelVariables if v.causality == c]
            for c in ("input", "output")
        }
        self.input_names = [v.name for v in chosen["input"]]
        self.output_names = [v.name for v in chosen["output"]]
        self._inputs, self._outputs = _groups(chosen["input"]), _groups(chosen["output"])
        self._status = next((v for v in chosen["output"] if v.name == "solver_status"), None)
        self._messages: list[tuple[int, str]] = []
        self.warnings: list[str] = []
        self.calls, self.wall_time, self.initialize_time = 0, 0.0, 0.0
        self._fmu: Any = instantiate(folder, self.description, name or self.path.stem,
                                      self._messages)  # fmt: skip
        self._parameters = dict(parameters or {})
        try:
            self._set_named(self._parameters, "parameter")
        except BaseException:
            self.close()
            raise
        self.instantiate_time = perf_counter() - start

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def initialize(
        self, start_time: float = 0.0, inputs: Mapping[str, float] | None = None
    ) -> None:
        """Set the inputs at the start and solve there."""
        start = perf_counter()
        self._call(self._fmu.setupExperiment, None, start_time)
        self._call(self._fmu.enterInitializationMode)
        self._set_named(inputs or {}, "input")
        self._call(self._fmu.exitInitializationMode)
        self._check_status()
        self.initialize_time = perf_counter() - start

    def set_inputs(self, values: Sequence[float]) -> None:
        """Set all inputs."""
        start = perf_counter()
        if len(values) != len(self.input_names):
            raise ParameterError(
                f"inputs = {len(values)} values, allowed: {len(self.input_names)} "
                f"({', '.join(self.input_names)})"
            )
        for group in self._inputs:
            for i, place in enumerate(group.places):
                group.values[i] = values[place] if group.kind == "Real" else int(values[place])
            self._call_group("Set", group)
        self.wall_time += perf_counter() - start

    def step(self, t: float, h: float) -> None:
        """Advance from ``t`` to ``t + h``; SolveError if there is no solution."""
        start = perf_counter()
        self.calls += 1
        try:
            self._call(self._fmu.fmi2DoStep, self._fmu.component, t, h, 0)
        finally:
            self.wall_time += perf_counter() - start

    def outputs(self) -> list[float]:
        """Return all outputs."""
        start = perf_counter()
        values = [0.0] * len(self.output_names)
        for group in self._outputs:
            self._call_group("Get", group)
            for place, value in zip(group.places, group.values, strict=True):
                values[place] = float(value)
        self.wall_time += perf_counter() - start
        return values

    def get(self, names: Sequence[str]) -> list[float]:
        """Return variables by name."""
        found = [self._by_name.get(name) or unknown(name, list(self._by_name)) for name in names]
        values = [0.0] * len(names)
        for group in _groups(found):
            self._call_group("Get", group)
            for place, value in zip(group.places, group.values, strict=True):
                values[place] = float(value)
        return values

    def get_state(self) -> Any:
        """Return a handle of the complete state; give it back with ``free_state``."""
        return self._call(self._fmu.getFMUstate)

    def set_state(self, state: Any) -> None:
        """Go back to a state."""
        self._call(self._fmu.setFMUstate, state)

    def free_state(self, state: Any) -> None:
        """Give a state back."""
        self._call(self._fmu.freeFMUstate, state)

    def serialize(self, state: Any) -> bytes:
        """Return a state as bytes."""
        data: bytes = self._call(self._fmu.serializeFMUstate, state)
        return data

    def deserialize(self, data: bytes) -> Any:
        """Return a handle of the state in bytes of ``serialize``."""
        return self._call(self._fmu.deSerializeFMUstate, data)

    def reset(self) -> None:
        """Go back to the start values and the parameters given at construction."""
        self._call(self._fmu.reset)
        self._set_named(self._parameters, "parameter")

    def close(self) -> None:
        """Free the instance; calling it again is harmless."""
        fmu, self._fmu = self._fmu, None
        if fmu is not None:
            fmu.freeInstance()

    def _set_named(self, values: Mapping[str, Any], causality: str) -> None:
        allowed = [v.name for v in self.description.modelVariables if v.causality == causality]
        for name, value in values.items():
            v = self._by_name[name] if name in allowed else unknown(name, allowed)
            items = v.declaredType.items if v.type == "Enumeration" else ()
            given = number(name, value, {i.name: int(i.value) for i in items or ()})
            group = _Group(TYPES[v.type], [v.valueReference], [0])
            if group.kind != "Real" and given != int(given):
                raise ParameterError(f"{name} = {given!r}, allowed: a whole number")
            group.values[0] = given if group.kind == "Real" else int(given)
            self._call_group("Set", group)

    def _call_group(self, verb: str, group: _Group) -> None:
        call = getattr(self._fmu, f"fmi2{verb}{group.kind}")
        self._call(call, self._fmu.component, group.references, group.n, group.values)

    def _call(self, function: Callable[..., Any], *args: Any) -> Any:
        """Call the FMU; a bad status or a logged error becomes an exception with its message."""
        failed = ""
        result = None
        try:
            result = function(*args)
        except self._call_failure as problem:
            failed = str(problem)
        if failed or self._messages:
            self._raise_messages(failed)
        return result

    def _raise_messages(self, failed: str) -> None:
        messages, self._messages[:] = list(self._messages), []
        errors = [text for status, text in messages if status > WARNING]
        self.warnings += [text for status, text in messages if status == WARNING]
        if not (failed or errors):
            return
        status = self._read_status()
        text = "; ".join(errors) or failed
        if not errors and status:
            text += f"; {status.name}: {status.advice}"
        raise (ParameterError if status == Status.BAD_INPUT else SolveError)(text)

    def _read_status(self) -> Status:
        """Read solver_status plainly, so that reading it cannot fail in turn."""
        if self._status is None:
            return Status.OK
        said = len(self._messages)
        try:
            return Status(self._fmu.getInteger([self._status.valueReference])[0])
        except self._call_failure:
            return Status.NOT_FINITE
        finally:
            del self._messages[said:]

    def _check_status(self) -> None:
        status = self._read_status()
        if status >= FIRST_FAILURE:
            raise SolveError(f"{self.path.stem} at the start: {status.name}: {status.advice}")
