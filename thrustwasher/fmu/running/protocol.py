"""The two FMI versions as one face: how values travel, what a step is, at which addresses.

Calls that every step makes go to the library directly, with arrays made once; the rest goes
through FMPy. FMPy has declared the argument types of all functions when it loaded the library.
"""

import ctypes
from collections.abc import Callable, Sequence
from ctypes import c_bool, c_double, c_int, c_int32, c_int64
from functools import partial
from operator import itemgetter
from typing import Any, NamedTuple

# C types of values -> how a compiled loop calls them.
KINDS = {c_double: "REAL", c_int: "INT32", c_int64: "INT64", c_bool: "BYTE"}
# Of both versions: type of a variable -> (name in calls, C type).
TYPES: dict[int, dict[str, tuple[str, Any]]] = {
    2: {
        "Real": ("Real", c_double),
        "Integer": ("Integer", c_int),
        "Enumeration": ("Integer", c_int),
        "Boolean": ("Boolean", c_int),
    },
    3: {
        "Float64": ("Float64", c_double),
        "Int32": ("Int32", c_int32),
        "Enumeration": ("Int64", c_int64),
        "Boolean": ("Boolean", c_bool),
    },
}


class Protocol:
    """Co-simulation of FMI 2.0 or 3.0, without event mode and early return."""

    def __init__(self, fmu: Any, version: int) -> None:
        self.fmu, self._version = fmu, version
        self.types = TYPES[version]
        self.lengths = version - 2  # times the number of values is handed over next to the values
        self._do_step = self.function("DoStep")
        self._early = (c_bool(), c_bool(), c_bool(), c_double())
        self._rest = (0,) if version == 2 else (False, *(ctypes.byref(x) for x in self._early))

    def begin(self, start_time: float) -> None:
        """Enter initialization at a time."""
        if self._version == 2:
            self.fmu.setupExperiment(startTime=start_time)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=start_time)

    def step(self, t: float, h: float) -> int:
        """Advance and return the status."""
        return self._do_step(self.fmu.component, t, h, *self._rest)

    def set_rates(self, inputs: "Table", rates: Sequence[float]) -> int:
        """Set the first derivatives of inputs, of FMI 2, and return the status."""
        n, group = len(rates), inputs.groups[0]
        values, orders = (c_double * n)(*rates), (c_int * n)(*[1] * n)
        set_them = self.function("SetRealInputDerivatives")
        return set_them(self.fmu.component, group.references, n, orders, values)

    def function(self, name: str) -> Callable[..., int]:
        """Return a function of the library; it returns the status as a number."""
        found: Callable[..., int] = getattr(self.fmu.dll, f"fmi{self._version}{name}")
        return found


def _references(found: Sequence[Any]) -> Any:
    return (ctypes.c_uint * len(found))(*(v.valueReference for v in found))


class Group:
    """Variables of one type that travel in one call."""

    def __init__(self, protocol: Protocol, found: Sequence[Any], places: Sequence[int]) -> None:
        kind, c_type = protocol.types[found[places[0]].type]
        n = len(places)
        self.references = _references([found[i] for i in places])
        self.places = list(places)
        self.values = (c_type * n)()
        self.whole = c_type is not c_double
        lengths = (n,) * protocol.lengths
        call = (protocol.fmu.component, self.references, n, self.values, *lengths)
        # hand the values over, fetch them; both return the status
        self.set = partial(protocol.function(f"Set{kind}"), *call)
        self.get = partial(protocol.function(f"Get{kind}"), *call)


class Table:
    """A list of variables in any mix of types, read and written as floats in its order."""

    def __init__(self, protocol: Protocol, found: Sequence[Any]) -> None:
        self.n = len(found)
        kinds = [protocol.types[v.type][0] for v in found]
        places = ([i for i, k in enumerate(kinds) if k == kind] for kind in dict.fromkeys(kinds))
        self.groups = [Group(protocol, found, own) for own in places]
        travelling = [place for group in self.groups for place in group.places]
        back = [travelling.index(i) for i in range(self.n)]
        in_order = back == list(range(self.n)) or self.n < 2
        self._order: Callable[[list[float]], Any] = list if in_order else itemgetter(*back)

    def fill(self, values: Sequence[float]) -> None:
        """Put values into the arrays; whole numbers lose what is behind the point."""
        for group in self.groups:
            chosen = [values[i] for i in group.places]
            group.values[:] = [int(x) for x in chosen] if group.whole else chosen

    def read(self) -> list[float]:
        """Return the values in the arrays."""
        travelling: list[float] = []
        for group in self.groups:
            values = group.values[:]
            travelling += map(float, values) if group.whole else values
        return list(self._order(travelling))


class Direction:
    """Derivatives of some outputs along a direction of some inputs; the arrays are made once."""

    def __init__(self, protocol: Protocol, unknowns: Sequence[Any], knowns: Sequence[Any]) -> None:
        self.seed = (c_double * len(knowns))()
        self.slope = (c_double * len(unknowns))()
        n_unknown, n_known = len(unknowns), len(knowns)
        named = _references(unknowns), n_unknown, _references(knowns), n_known
        seed = self.seed, *(n_known,) * protocol.lengths
        slope = self.slope, *(n_unknown,) * protocol.lengths
        function = protocol.function("GetDirectionalDerivative")  # returns the status
        self.get = partial(function, protocol.fmu.component, *named, *seed, *slope)


class MachineGroup(NamedTuple):
    """A call that sets or gets values of one type."""

    function: int
    references: int  # address of the value references
    places: list[int]  # where the values stand among all inputs or outputs
    values: int  # address of the values
    kind: str


class Machine(NamedTuple):
    """What a compiled master needs to step an instance: addresses, valid as long as it lives."""

    third: bool  # FMI 3: lengths go along with values; a step hands four more places over
    component: int
    step: int
    setters: list[MachineGroup]
    getters: list[MachineGroup]
    logged: int  # address of a number that is not 0 once the FMU has logged something


def machine_of(protocol: Protocol, inputs: Table, outputs: Table, logged: Any) -> Machine:
    """Return the addresses of an instance."""
    return Machine(
        third=protocol.lengths > 0,
        component=int(protocol.fmu.component),
        step=_address(protocol.function("DoStep")),
        setters=[_group(g, g.set.func) for g in inputs.groups],
        getters=[_group(g, g.get.func) for g in outputs.groups],
        logged=ctypes.addressof(logged),
    )


def _group(group: Group, function: Any) -> MachineGroup:
    kind = KINDS[group.values._type_]
    references = ctypes.addressof(group.references)
    values = ctypes.addressof(group.values)
    return MachineGroup(_address(function), references, group.places, values, kind)


def _address(function: Any) -> int:
    return int(ctypes.cast(function, ctypes.c_void_p).value or 0)
