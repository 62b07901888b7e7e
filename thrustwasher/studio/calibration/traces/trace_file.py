"""Recordings in files: columns by their names, in SI units."""

from collections.abc import Mapping, Sequence
from os import PathLike, fspath

import numpy as np

from ....errors import ParameterError
from ....storage.tables.known_columns import known_columns
from ....storage.tables.table import Columns, Table, numbers
from ....storage.tables.table_file import read_table


def is_trace(table: Table) -> bool:
    """Tell if the rows of a table are a recording over time."""
    return any(column.plain == "time" for column in table.columns)


def read_trace(
    path: str | PathLike[str],
    units: Mapping[str, str],
    measured: Sequence[str],
    needed: Sequence[Sequence[str]] = (),
) -> tuple[dict[str, Columns], list[str], list[str]]:
    """Return ``columns_of`` the table in a file."""
    return columns_of(read_table(fspath(path)), units, measured, needed)


def columns_of(
    table: Table,
    units: Mapping[str, str],
    measured: Sequence[str],
    needed: Sequence[Sequence[str]] = (),
) -> tuple[dict[str, Columns], list[str], list[str]]:
    """Return the columns of a file's recordings by name, (n,) each [SI], NaN where a cell is empty.

    A file with one table is one recording. Also names of columns that were passed over: a recording
    has more channels than count here. Third: what was not plain, such as samples that are left out.

    Parameters
    ----------
    table : as read
    units : SI unit of every column that counts
    measured : those among them that may have empty cells
    needed : groups of names; of each group a recording has one, if an unknown column may be it

    Raises
    ------
    ParameterError : a cell is no number, an input has an empty one; the message names file, line
        and column
    """
    table = table.of_columns(units, measured)
    columns, passed = known_columns(table, units, needed, may_lack=True)
    found: dict[str, Columns] = {}
    for own in table.each():
        of_table = Columns()
        of_table.units = {name: c.unit for name, c in columns.items() if c.unit}
        found[f"{table.path}, {own.name}" if own.name else table.path] = of_table
        by_name = {column.plain: column for column in own.columns}
        for name in columns:
            of_table[name] = np.array(numbers(by_name[name], own, units[name], name=name), float)
            holes = np.isnan(of_table[name])
            if name not in measured and holes.any():
                line = own.lines[int(np.argmax(holes))]
                raise ParameterError(f"{table.path}, line {line}: {name} is missing")
    return found, passed, table.remarks
