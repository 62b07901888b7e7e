"""What a call from Python adds to a compiled function, and the machine that seconds belong to."""

from __future__ import annotations

from functools import cache
from typing import Any

from ..store.card_parts import Machine
from .record import surroundings


def empty_step() -> Any:
    """Return a compiled step that takes what every model's step takes and does next to nothing.

    What it costs is what a call from Python adds: taking arrays apart, above all.
    """
    from ..kernels.command_step import step

    return step


@cache
def this_place() -> dict[str, Any]:
    """Return machine and state of the sources, found once."""
    return surroundings("python -m thrustwasher.fidelity.verify")


def this_machine() -> Machine:
    """Return what the seconds depend on."""
    m = this_place()["machine"]
    versions = (m["os"], m["python"], m["numpy"], m["numba"])
    return Machine(m["cpu"], m["cores"] or 1, *versions, threads=1, load=m["load"] or 0.0)
