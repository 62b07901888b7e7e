"""A map of one's own parameters: built when asked for, or with its cards where that pays.

What building costs is estimated from the box: lines and held-out points times the seconds that one
takes. What it saves are calls of the rung that solves.
"""

from collections.abc import Callable
from time import perf_counter
from typing import Any

from ..errors import ParameterError, SolveError
from ..model.parameters import check_number
from ..model.part_file import PartFile
from ..model.prepare import tables_of
from ..model.record import resolve
from ..model.registry import ladder_of
from ..model.spec import ModelSpec, Tables
from ..native.files import to_stderr
from ..processes import usable_cores
from .boxes import Box
from .card import OWN, SAFETY, fresh_cards

MAKER = "thrustwasher.study.own_cards:make_own_cards"
POINTS = 30  # held out, for who waits for a run
# Seconds on one core: a line of a map, a held-out point with its reference, a call of "field"; what
# starting and timing take. Only their ratios count.
LINE, POINT, CALL, ONCE = 0.021, 0.25, 6e-4, 4.0
LONGER = "up to ten times that if all its lines need a finer mesh"
RUNS = 20  # so often a scene is run, or one like it with the same part; chosen here


def build_where_it_pays(
    spec: ModelSpec, params: Any, box: Box, *, tol: float, calls: float, needed: Box | None = None,
    say: Callable[[str], None] = to_stderr,
) -> str:  # fmt: skip
    """Build map and cards for ``box`` if ``calls`` look-ups save more time than that takes.

    ``needed`` is what a kept map has to cover to be left as it is. Returns what was done in one
    line, empty if nothing. Parameters that the shipped cards speak of are left alone.
    """
    tables = tables_of(spec)
    cards = [c for rung in ladder_of(spec.key).kernels for c in fresh_cards(spec.key, rung, params)]
    if tables is None or any(not c.params.name.startswith(OWN) for c in cards):
        return ""
    try:
        if any(c.fidelity == tables.rung for c in cards):
            known = tables.box(params)
            if serves(tables, params, needed or box, tol):
                return ""
            box = {n: (min(a, known[n][0]), max(b, known[n][1])) for n, (a, b) in box.items()
                   if n in known}  # fmt: skip
        lines = tables.lines(params, box, tol / SAFETY)
        takes = (lines * LINE + POINTS * POINT) / usable_cores() + ONCE
        if calls * CALL < takes:
            return ""
        say(f"{spec.key}: builds a map of its own, once, about {takes:.0f} s; {LONGER}")
        began = perf_counter()
        resolve(MAKER)(spec, params, box, tol=tol / SAFETY, points=POINTS)
    except (ParameterError, SolveError) as problem:
        return f"{spec.key}: no map of its own: {problem}"
    return (
        f"{spec.key}: a map of its own and cards from {POINTS} held-out points were made in "
        f"{perf_counter() - began:.0f} s and are kept"
    )


def build_missing(
    part: PartFile, tol: float, progress: Any, say: Callable[[str], None] = to_stderr
) -> str:
    """Build a part's map unless one of this tolerance is kept that covers its box.

    Returns why there is none, in one line, empty if there is one or its model has no maps.
    ParameterError: the tolerance is not allowed.
    """
    tables = tables_of(part.spec)
    if tables is None:
        return ""
    check_number("tolerance", tol, "1", *tables.tolerances)
    try:
        if not serves(tables, part.params, part.box, tol):
            takes = tables.lines(part.params, part.box, tol) * LINE / usable_cores()
            say(f"{part.name}: builds a map of its own, once, about {takes:.0f} s; {LONGER}")
            tables.build(part.params, part.box, tol, usable_cores(), progress)
    except (ParameterError, SolveError) as problem:
        return f"{part.name}: no map of its own: {problem}"
    return ""


def serves(tables: Tables, params: Any, box: Box, tol: float) -> bool:
    """Tell if there is a map of this tolerance that covers a box."""
    try:
        known = tables.box(params)
    except ParameterError:
        return False
    return tables.find(params).card["tolerance"] <= tol and all(
        known[n][0] <= max(low, tables.least(n)) and high <= known[n][1]
        for n, (low, high) in box.items()
        if n in known  # a part that any other acts on has no map
    )
