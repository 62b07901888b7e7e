"""Where methods fail: each method meets each hazard, and what comes out is judged.

The groups are in files of their own: ``stability_film``, ``stability_balance``,
``stability_loops``, ``stability_time``; what a cell may say is in ``stability_cells``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from typing import Any

from .stability_balance import balance
from .stability_cells import LIES, NONE, OK, SAYS, SLOW, Cell, Group, liars, table
from .stability_film import cavitation
from .stability_loops import closed_forms, heat_loop
from .stability_time import coupling, drift

__all__ = [
    "LIES", "NONE", "OK", "SAYS", "SLOW", "Cell", "Group", "balance", "cavitation", "closed_forms",
    "coupling", "drift", "heat_loop", "liars", "stability", "table",
]  # fmt: skip
Measure = tuple[str, Callable[[], Group]]


def measures(*, quick: bool = False) -> list[Measure]:
    """Return what is measured, in order, by its name."""
    return [
        ("a cavitating film", partial(cavitation, quick=quick)),
        ("the washer's balance", balance),
        ("a flank that its oil heats", heat_loop),
        ("closed forms", closed_forms),
        ("lock-up in co-simulation", coupling),
        ("a shaft that swings", partial(drift, quick=quick)),
    ]


def stability(
    *, quick: bool = False, progress: Callable[[str], None] = print, more: tuple[Measure, ...] = ()
) -> list[dict[str, Any]]:
    """Return all groups, as JSON types; ``more`` are measured after the package's own."""
    groups: list[Group] = []
    for name, made in (*measures(quick=quick), *more):
        progress("where methods fail: " + name)
        groups.append(made())
    return [asdict(g) for g in groups]
