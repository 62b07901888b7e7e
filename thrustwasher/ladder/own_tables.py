"""A map of one's own part: built unless one is kept that serves."""

from collections.abc import Callable
from typing import Any

from ..errors import ParameterError, SolveError
from ..model.parameters import check_number
from ..model.part_file import PartFile
from ..model.prepare import tables_of
from ..model.spec import Tables
from ..native.files import to_stderr
from ..processes import usable_cores
from .error_table import Box

LINE = 0.021  # seconds that a line of a map takes on one core, about
LONGER = "up to ten times that if all its lines need a finer mesh"


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
