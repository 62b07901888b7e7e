"""An instance as addresses: what a compiled master needs to step it without Python."""

import ctypes
from typing import Any, NamedTuple

from .protocol import Group, Protocol, Table

# C types of values -> how a compiled loop calls them.
KINDS = {
    ctypes.c_double: "real", ctypes.c_int: "int32", ctypes.c_int32: "int32",
    ctypes.c_int64: "int64", ctypes.c_bool: "byte",
}  # fmt: skip


class MachineGroup(NamedTuple):
    """A call that sets or gets values of one type."""

    function: int
    references: int
    """Address of the value references."""
    places: list[int]
    """Where the values stand among all inputs or outputs."""
    kind: str


class Machine(NamedTuple):
    """Addresses, valid as long as the instance lives."""

    third: bool
    """FMI 3: lengths go along with values; a step hands four more places over."""
    component: int
    step: int
    setters: list[MachineGroup]
    getters: list[MachineGroup]
    said: int
    """Address of a number that is not 0 once the FMU has logged something."""


def machine_of(protocol: Protocol, inputs: Table, outputs: Table, said: Any) -> Machine:
    """Return the addresses of an instance."""
    return Machine(
        third=protocol.lengths > 0,
        component=int(protocol.fmu.component),
        step=_address(protocol.function("DoStep")),
        setters=[_group(g, g.set_function) for g in inputs.groups],
        getters=[_group(g, g.get_function) for g in outputs.groups],
        said=ctypes.addressof(said),
    )


def _group(group: Group, function: Any) -> MachineGroup:
    kind = KINDS[group.values._type_]
    references = ctypes.addressof(group.references)
    return MachineGroup(_address(function), references, group.places, kind)


def _address(function: Any) -> int:
    return int(ctypes.cast(function, ctypes.c_void_p).value or 0)
