"""Tables that a rung reads: they lie behind the work of its kernel."""

from importlib import import_module
from typing import Any

from ..errors import ParameterError
from .spec import ModelSpec


def wants_table(spec: ModelSpec, par: Any) -> bool:
    """Tell if the rung in ``par`` reads a table."""
    known = _known(spec)
    return bool(known) and par[int(known["SWITCH"])] == known["ON"]


def fill_table(spec: ModelSpec, params: Any, par: Any, work: Any) -> None:
    """Put the table for ``params`` into ``work`` if the rung in ``par`` reads one.

    Raises
    ------
    ParameterError : there is none for these parameters, or it is too large
    """
    if not wants_table(spec, par):
        return
    known = _known(spec)
    module, _, name = spec.table.partition(":")
    table = getattr(import_module(module), name)(params)
    room = work[int(known["AT"]) :]
    if len(table) > len(room):
        raise ParameterError(
            f"the table has {len(table)} numbers, allowed: {len(room)}; make it smaller"
        )
    room[: len(table)] = table


def _known(spec: ModelSpec) -> dict[str, float]:
    """Return what the kernel says about its table; empty if it has none."""
    kernel = import_module(spec.kernel)
    found: dict[str, float] = getattr(kernel, "TABLE", None) or {}
    return found
