"""Every loop of the kernels that a test may end: how often it runs at most, what comes out then.

The list is ``loop_bounds.toml``; a test holds it against the kernels' sources.
"""

import tomllib
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple


class Loop(NamedTuple):
    """A loop: module below the package, function, its head; at most so often, and what then."""

    module: str
    function: str
    head: str
    most: str
    then: str


@cache
def _read() -> dict[str, Any]:
    here = Path(__file__)
    return {
        name: tomllib.loads(here.with_name(f"{name}.toml").read_text("utf-8"))
        for name in ("loop_bounds", "step_bounds")
    }


def loops() -> list[Loop]:
    """Return all loops of the list."""
    return [
        Loop(module, *place.split(": ", 1), *about)
        for module, rows in _read()["loop_bounds"].items()
        for place, about in rows.items()
    ]


def bound_of(model: str, fidelity: str) -> str:
    """Return what bounds a step of a level, in words with numbers; "" where none is known."""
    found = _read()["step_bounds"].get(model, {})
    return str(found.get(fidelity, found.get("all", "")))


def work_places(model: str) -> dict[str, str]:
    """Return what the kernels of a model count -> its name in their layout."""
    return dict(_read()["step_bounds"].get(model, {}).get("work", {}))
