"""An FMU of FMI 2.0 as a host in C has it: functions and values by their addresses.

The FMU logs nothing and calls nobody; what a step takes is its own.
"""

import ctypes
import sys
from collections.abc import Mapping, Sequence
from ctypes import c_char_p, c_double, c_int, c_uint, c_void_p
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from lab.realtime import timed_steps as c
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.fmu.description.interface import Interface, Variable
from thrustwasher.fmu.running.loading import description, unpack
from thrustwasher.fmu.running.protocol import TYPES
from thrustwasher.native.link import this_platform

Words = NDArray[np.int64]
CO_SIMULATION = 1
FUNCTIONS = {  # place among the addresses -> name
    c.SET_REAL: "SetReal",
    c.DO_STEP: "DoStep",
    c.GET_STATE: "GetFMUstate",
    c.SET_STATE: "SetFMUstate",
    c.RESET: "Reset",
    c.SETUP: "SetupExperiment",
    c.ENTER: "EnterInitializationMode",
    c.EXIT: "ExitInitializationMode",
}


class Host:
    """A living instance of a native FMU for this machine.

    Parameters
    ----------
    path : the FMU
    shown : what it shows
    parameters : values by name, enumerations as numbers; set again at every restart

    ``calls``, ``parameters``, ``outputs``: what ``timed_steps.run_steps`` takes; valid until
    ``close``. EnvironmentProblem: the FMU does not run here.
    """

    def __init__(self, path: Path, shown: Interface, parameters: Mapping[str, float]) -> None:
        folder, platform = unpack(path), this_platform()
        described = description(folder)
        name = described.coSimulation.modelIdentifier
        file = folder / "binaries" / platform.fmi2 / f"{name}.{platform.extension}"
        try:
            self._library = ctypes.CDLL(str(file))
        except OSError as problem:
            raise EnvironmentProblem(f"{name} cannot be loaded: {problem}") from None
        self._kept: list[Any] = []  # arrays whose addresses are out
        start = self._library.fmi2Instantiate
        start.restype = c_void_p
        start.argtypes = [c_char_p, c_int, c_char_p, c_char_p, c_void_p, c_int, c_int]
        where = (folder / "resources").as_uri().encode()
        guid = described.guid.encode()
        self.component = start(name.encode(), CO_SIMULATION, guid, where, None, 0, 0)
        if not self.component:
            raise EnvironmentProblem(f"{name} cannot be instantiated; run `thrustwasher doctor`")
        chosen = [v for v in shown.parameters if v.name in parameters]
        self.parameters = self._groups(chosen, "Set", parameters)
        self.outputs = self._groups(shown.outputs, "Get", {})
        self.calls = self._addresses(shown.inputs)

    def _address(self, name: str) -> int:
        return int(ctypes.cast(self._library[f"fmi2{name}"], c_void_p).value or 0)

    def _groups(
        self, variables: Sequence[Variable], verb: str, values: Mapping[str, float]
    ) -> Words:
        """Return the calls that set or get variables, a row for each type."""
        rows = []
        for kind, c_type in dict.fromkeys(TYPES[2][v.type] for v in variables):
            own = [v for v in variables if TYPES[2][v.type] == (kind, c_type)]
            real = c_type is c_double
            given = [values.get(v.name, 0.0) for v in own]
            references = self._keep(c_uint, [v.reference for v in own])
            room = self._keep(c_type, given if real else [int(x) for x in given])
            rows.append([self._address(f"{verb}{kind}"), references, len(own), room, int(real)])
        return np.array(rows, np.int64).reshape(-1, 5)

    def _keep(self, c_type: Any, values: Sequence[float]) -> int:
        """Return the address of an array that lives as long as the host."""
        made = (c_type * max(1, len(values)))(*values)
        self._kept.append(made)
        return ctypes.addressof(made)

    def _addresses(self, inputs: Sequence[Variable]) -> Words:
        calls = np.zeros(c.N_ADDRESSES, np.int64)
        calls[c.COMPONENT] = self.component
        for place, name in FUNCTIONS.items():
            calls[place] = self._address(name)
        calls[c.REFERENCES] = self._keep(c_uint, [v.reference for v in inputs])
        calls[c.VALUES] = self._keep(c_double, [v.start or 0.0 for v in inputs])
        calls[c.STATE] = self._keep(c_void_p, [])
        return calls

    def memory(self) -> int | None:
        """Return the bytes of the instance, all that it ever takes; None where nobody knows."""
        if not sys.platform.startswith("linux"):
            return None
        try:
            size = ctypes.CDLL(None).malloc_usable_size
        except AttributeError:
            return None
        size.restype, size.argtypes = ctypes.c_size_t, [c_void_p]
        return int(size(self.component))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Free the saved state and the instance."""
        state = c_void_p.from_address(int(self.calls[c.STATE]))
        free = self._library.fmi2FreeFMUstate
        free.argtypes = [c_void_p, c_void_p]
        if state.value:
            free(self.component, int(self.calls[c.STATE]))
        end = self._library.fmi2FreeInstance
        end.restype, end.argtypes = None, [c_void_p]
        end(self.component)
