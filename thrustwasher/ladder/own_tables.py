"""The map of a part of your own: built unless one is kept that serves."""

from collections.abc import Callable
from contextlib import closing
from typing import Any

from ..errors import ParameterError, SolveError
from ..model.parameters import check_number
from ..model.part_file import PartFile
from ..model.prepare import tables_of
from ..model.spec import Tables
from ..native.files import to_stderr, user_cache
from ..processes import usable_cores
from ..storage.digests import params_digest
from ..storage.journal import Journal, when_free
from .error_table import Box

LINE = 0.021  # seconds that a line of a map takes on one core, about
LONGER = "up to ten times that if all its lines need a finer mesh; --no-maps leaves it out"
Say = Callable[[str], None]


def build_missing(part: PartFile, tol: float, progress: object, say: Say = to_stderr) -> str:
    """Build a part's map unless one of this tolerance is kept that covers its box.

    Returns why there is none, in one line, empty if there is one or its model has no maps.
    ParameterError: the tolerance is not allowed.
    """
    tables = tables_of(part.spec)
    if tables is None:
        return ""
    check_number("tolerance", tol, "1", *tables.tolerances)

    def foretell() -> None:
        takes = tables.lines(part.params, part.box, tol) * LINE / usable_cores()
        say(f"{part.name}: builds a map of its own, once, about {takes:.0f} s; {LONGER}")

    try:
        ensure(tables, part.params, part.box, tol, progress, begin=foretell, say=say)
    except (ParameterError, SolveError) as problem:
        return f"{part.name}: no map of its own: {problem}"
    return ""


def ensure(
    tables: Tables,
    params: Any,
    box: Box,
    tol: float,
    progress: object,
    *,
    workers: int | None = None,
    begin: Callable[[], None] = lambda: None,
    say: Say = to_stderr,
) -> None:
    """Build the map of a part in the user's cache unless one serves; wait for a run that builds it.

    ``begin`` is called before the build. Raises as the build does.
    """
    if serves(tables, params, box, tol):
        return
    lock = user_cache() / "maps" / f"{params_digest(params)[:16]}.lock"
    with closing(when_free(lambda: Journal(lock, {}, "map"), say)):
        if not serves(tables, params, box, tol):  # another run may have built it by now
            begin()
            tables.build(params, box, tol, workers or usable_cores(), progress)


def serves(tables: Tables, params: object, box: Box, tol: float) -> bool:
    """Tell if there is a map of this tolerance that covers a box."""
    try:
        known = tables.box(params)
    except ParameterError:
        return False
    metadata = tables.find(params).metadata
    held_out = metadata.get("held_out", {})
    if held_out is None:  # built without a check of its errors
        return False
    errors = metadata["tolerance"], held_out.get("torque", 0.0)
    return max(errors) <= tol and all(
        known[n][0] <= tables.least(n, (low, high)) and high <= known[n][1]
        for n, (low, high) in box.items()
        if n in known  # a part that any other acts on has no map
    )
