"""Recordings in files: columns by their names, in SI units."""

from collections.abc import Mapping, Sequence
from os import PathLike, fspath

import numpy as np

from ....errors import ParameterError, suggestion
from ....numerics.jit import Array
from ....storage.tables.table import Table, numbers
from ....storage.tables.table_file import read_table
from ....units import parse_quantity

SHOWN = 12  # names of columns that do not count


def is_trace(table: Table) -> bool:
    """Tell if the rows of a table are a recording over time."""
    return any(column.plain == "time" for column in table.columns)


def read_trace(
    path: str | PathLike[str], units: Mapping[str, str], measured: Sequence[str]
) -> tuple[dict[str, Array], list[str], list[str]]:
    """Return ``columns_of`` the table in a file."""
    return columns_of(read_table(fspath(path)), units, measured)


def columns_of(
    table: Table, units: Mapping[str, str], measured: Sequence[str]
) -> tuple[dict[str, Array], list[str], list[str]]:
    """Return the columns of a recording, (n,) each [SI], NaN where a cell is empty.

    Also names of columns that were passed over: a recording has more channels than count here.
    One whose name is nearly one of these is refused, unless it begins with _. Third: what was not
    plain, such as samples that are left out.

    Parameters
    ----------
    table : as read
    units : SI unit of every column that counts
    measured : those among them that may have empty cells

    Raises
    ------
    ParameterError : a cell is no number, an input has an empty one; the message names file, line
        and column
    """
    table = table.of_columns(units, measured)
    found: dict[str, Array] = {}
    passed = []
    for column in table.columns:
        name = column.plain
        if name not in units:
            hint = suggestion(name, set(units) - {*found}, "did you mean {}? ", likeness=0.75)
            if column.name and not column.name.startswith("_"):
                if hint and not table.binary:
                    raise ParameterError(
                        f"{table.path}: column {column.name!r} is not known; {hint}begin its name "
                        "with _ to pass it over"
                    )
                passed.append(column.name)
            continue
        if name in found:
            raise ParameterError(f"{table.path}: has two columns {name}")
        parse_quantity(f"1 {column.unit}", units[name], f"{table.path}: unit of column {name}")
        found[name] = np.array(numbers(column, table, units[name], name=name), float)
        holes = np.isnan(found[name])
        if name not in measured and holes.any():
            line = table.lines[int(np.argmax(holes))]
            raise ParameterError(f"{table.path}, line {line}: {name} is missing")
    return found, passed, table.remarks
