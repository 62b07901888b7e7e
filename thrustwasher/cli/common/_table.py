"""Columns of a table in a file, found by their names, in SI units."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ...errors import ParameterError, suggestion
from ...units import parse_quantity
from ._output import note

if TYPE_CHECKING:
    from ...storage.tables.table import Column, Table

SHOWN = 12  # names of columns that do not count


def read_columns(
    path: str,
    units: Mapping[str, str],
    optional: tuple[str, ...] = (),
    *,
    strict: bool = False,
    names: Sequence[str] = (),
    known: "Table | None" = None,
) -> dict[str, list[Any]]:
    """Return the columns, each a list of numbers in SI units.

    The head names the columns, with the unit of the numbers in brackets: ``speed [rpm]``, or in a
    line of units below; without it they are SI. What a file may look like ``read_table`` says;
    what is unusual about it is printed. Other columns are passed over, with
    a line, unless their name is nearly one of these. ``units`` holds the SI unit of every
    column by its name, ``optional`` the names that may be missing. ``strict``: other columns are
    refused unless their names begin with _, and a cell may be empty: None. ``names``: texts
    NAME=CHANNEL of ``--column``. ``known``: the table, where it was read before and renamed. Errors
    name line and column.
    """
    from ...storage.tables.table import numbers
    from ...storage.tables.table_file import read_table

    table = read_table(path).renamed(renaming(names)) if known is None else known
    table = table.of_columns(units)
    found, passed = _find(table, units, optional, strict)
    columns: dict[str, list[Any]] = {}
    for name, column in found.items():
        columns[name] = numbers(column, table, units[name], name=name)
        if not strict and None in columns[name]:
            line = table.lines[columns[name].index(None)]
            raise ParameterError(f"{path}, line {line}: {name} is missing")
    if table.remarks:
        note(f"{path}: read with {', '.join(table.remarks)}")
    if passed:
        more = f" and {len(passed) - SHOWN} more" if len(passed) > SHOWN else ""
        note(f"{path}: passed over, as no column that counts: {', '.join(passed[:SHOWN])}{more}")
    return columns


def renaming(names: Sequence[str]) -> dict[str, str]:
    """Return channel by name, from texts NAME=CHANNEL."""
    pairs = [text.partition("=") for text in names]
    for text, (name, _, channel) in zip(names, pairs, strict=True):
        if not name.strip() or not channel.strip():
            raise ParameterError(f"--column {text}: allowed: NAME=CHANNEL, e.g. speed=N_SLIP")
    return {name.strip(): channel.strip() for name, _, channel in pairs}


def _find(
    table: "Table", units: Mapping[str, str], optional: tuple[str, ...], strict: bool
) -> tuple[dict[str, "Column"], list[str]]:
    """Return every column by its name, and those passed over."""
    from ...storage.tables.table import time_hint

    path = table.path
    found: dict[str, Column] = {}
    passed = []
    for column in table.columns:
        name = column.plain
        if name not in units:
            hint = suggestion(
                name,
                set(units) - {*found},
                "did you mean {}? ",
                likeness=0.6 if strict else 0.75,
                by_words=strict,  # else a column of its own may share a word with any
            )
            if column.name and not column.name.startswith("_"):
                over_time = time_hint([column]) if strict else ""
                if over_time or ((strict or hint) and not table.binary):
                    hint = over_time or hint
                    raise ParameterError(
                        f"{path}: column {column.name!r} is not known; {hint}begin its "
                        "name with _ to pass it over"
                    )
                passed.append(column.name)
            continue
        if name in found:
            raise ParameterError(f"{path}: has two columns {name}")
        parse_quantity(f"1 {column.unit}", units[name], f"{path}: unit of column {name}")
        found[name] = column
    missing = [name for name in units if name not in found and name not in optional]
    if missing:
        names = ", ".join(column.name for column in table.columns[:SHOWN])
        raise ParameterError(
            f"{path}: column {missing[0]} is missing; required: {', '.join(units)}; found: {names}"
        )
    return found, passed
