"""Columns of a table in a file, found by their names, in SI units."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ...errors import ParameterError
from ._output import note

if TYPE_CHECKING:
    from ...storage.tables.heads import Wanted
    from ...storage.tables.table import Columns, Table

SHOWN = 12  # names of columns that do not count
COLUMN = (
    "column of the file that holds NAME, e.g. speed=N_SLIP or 'speed [rpm]=N_SLIP'; a sum or "
    "difference, 'speed=n_in - n_out'; may be repeated"
)
OPTIONS = {
    "--skip N": "lines above the head of the table, if it is not found as meant",
    "--table N": "of a file with several tables: the number of one, or of several, 1,3",
    "--sheet NAME": "of a workbook: the sheet; of a .mat file: the struct",
}


def read_columns(
    path: str,
    units: Mapping[str, str],
    optional: tuple[str, ...] = (),
    *,
    strict: bool = False,
    names: Sequence[str] = (),
    needed: Sequence[Sequence[str]] = (),
    known: "Table | None" = None,
    wanted: "Wanted | None" = None,
) -> "Columns":
    """Return the columns, each a list of numbers in SI units.

    The head names the columns, with the unit of the numbers in brackets: ``speed [rpm]``, or in a
    line of units below; without it they are SI. What a file may look like ``read_table`` says;
    what is unusual about it is printed. Other columns are passed over, with
    a line, unless their name is nearly one of these. ``units`` holds the SI unit of every
    column by its name, ``optional`` the names that may be missing, ``needed``
    groups of them of which one is required each. ``strict``: other columns are
    refused unless their names begin with _, and a cell may be empty: None. ``names``: texts
    NAME=CHANNEL of ``--column``. ``known``: the table, where it was read before and renamed. Errors
    name line and column.
    """
    from ...storage.tables.known_columns import known_columns
    from ...storage.tables.table import Columns, numbers

    table = named_table(path, names, wanted) if known is None else known
    table = table.of_columns(units)
    needed = needed or [(name,) for name in units if name not in optional]
    found, passed = known_columns(table, units, needed, strict=strict)
    columns = Columns()
    columns.units = {name: column.unit for name, column in found.items() if column.unit}
    for name, column in found.items():
        columns[name] = numbers(column, table, units[name], name=name)
        if not strict and None in columns[name]:
            line = table.lines[columns[name].index(None)]
            raise ParameterError(f"{path}, line {line}: {name} is missing")
    tell(path, table.remarks, passed)
    return columns


def tell(path: str, remarks: Sequence[str], passed: Sequence[str]) -> None:
    """Say what was not plain about a file, and which columns do not count."""
    if remarks:
        note(f"{path}: read with {', '.join(remarks)}")
    if passed:
        more = f" and {len(passed) - SHOWN} more" if len(passed) > SHOWN else ""
        note(f"{path}: passed over, as no column that counts: {', '.join(passed[:SHOWN])}{more}")


def named_table(path: str, names: Sequence[str] = (), wanted: "Wanted | None" = None) -> "Table":
    """Return the table of a file with columns renamed by texts NAME=COLUMN."""
    from ...storage.tables.column_names import renamed
    from ...storage.tables.heads import USUAL
    from ...storage.tables.table_file import read_table

    return renamed(read_table(path, wanted or USUAL), renaming(names))


def wanted_of(arguments: Any) -> "Wanted":
    """Return where the table stands in a file, as ``OPTIONS`` say it."""
    from ...storage.tables.heads import Wanted

    skip = arguments.skip
    tables: tuple[int, ...] = ()
    if skip is not None and not (skip.isdecimal() and len(skip) < 9):
        raise ParameterError(f"--skip {skip}: allowed: a number of lines, 0 or more")
    if arguments.table is not None:
        words = [word.strip() for word in arguments.table.split(",")]
        if not all(word.isdecimal() and len(word) < 9 for word in words):
            raise ParameterError(f"--table {arguments.table}: allowed: numbers, e.g. 2 or 1,3")
        tables = tuple(map(int, words))
    return Wanted(None if skip is None else int(skip), tables, arguments.sheet or "")


def renaming(names: Sequence[str]) -> dict[str, str]:
    """Return channel by name, from texts NAME=CHANNEL."""
    pairs = [text.partition("=") for text in names]
    for text, (name, _, channel) in zip(names, pairs, strict=True):
        if not name.strip() or not channel.strip():
            raise ParameterError(f"--column {text}: allowed: NAME=CHANNEL, e.g. speed=N_SLIP")
    return {name.strip(): channel.strip() for name, _, channel in pairs}
