"""A table as it stands in a file: names, units and cells of its columns."""

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from ...units import UNITS, parse_quantity, unit_size

LONGEST = 2_000_000  # rows; a larger file is none of measured points
UNMEASURED = ("", "-", "--", "nan", "n/a", "na", "#n/a", "null", "none")  # in lower case
RAW = ("V", "mV", "kV", "Volt", "A", "mA")  # units of signals that nobody has scaled yet
CLOCK = re.compile(r"(\d{1,2}):(\d\d):(\d\d(?:[.,]\d+)?)")
CLOCKED = ("", "hh:mm:ss", "hh:mm:ss.fff", "h:m:s")
MANY = 2_000  # rows from which a column is converted as a whole, rounded once in long double


@dataclass(frozen=True)
class Column:
    """One column; ``unit`` as written, "" for none."""

    name: str
    unit: str
    cells: list[str]
    """Numbers with a decimal point; "" where nothing was measured."""
    group: str = ""
    """Of a file whose groups of channels have times of their own: name or number of the group."""

    @property
    def plain(self) -> str:
        """The name as it is looked for."""
        return self.name.lower().replace(" ", "_")


@dataclass(frozen=True)
class Table:
    """Columns in the order of the file."""

    path: str
    columns: list[Column]
    lines: list[int]
    """Number of each row in the file, from 1."""
    remarks: list[str] = field(default_factory=list)
    """What was not plain, such as "decimal commas"."""
    binary: bool = False
    """From a format with many channels, of which those without a known name do not count."""
    parts: tuple[int, ...] = ()
    """Rows of each table in a file that has several of one head, each a recording of its own."""
    name: str = ""
    """Of one of several tables in a file."""
    given: Mapping[str, str] = field(default_factory=dict)
    """Which column was said to hold a name."""
    used: tuple[str, ...] = ()
    """Names of columns that sums and differences are made of."""

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.lines)

    def each(self) -> "list[Table]":
        """Return the tables of a file with several, each by itself."""
        if not self.parts:
            return [self]
        found, start = [], 0
        for k, size in enumerate(self.parts, 1):
            rows = slice(start, start + size)
            columns = [replace(c, cells=c.cells[rows]) for c in self.columns]
            name = f"table {k} (from line {self.lines[start]})"
            own = replace(self, columns=columns, lines=self.lines[rows], parts=(), name=name)
            found.append(own)
            start += size
        return found

    def of_columns(self, names: Collection[str], may_lack: Collection[str] = ()) -> "Table":
        """Return the table with cells of the columns that count; those of a text file stand.

        Parameters
        ----------
        names : plain names of the columns that count
        may_lack : those among them that may have empty cells

        Raises
        ------
        ParameterError : channels of a measuring file have no common rows
        """
        return self


class Columns(dict[str, Any]):
    """Columns [SI] by name, and how they came."""

    units: Mapping[str, str] = MappingProxyType({})
    """As written, of columns that had one."""
    remarks: Sequence[str] = ()
    """What was not plain, if nobody was told."""


def several_text(path: str, name: str, same: Collection[Column]) -> str:
    """Say that several columns could be the one of this name."""
    groups = [column.group for column in same]
    if all(groups) and len(set(groups)) == len(groups):
        first = next(iter(same))
        return (
            f"{path}: channel {first.name} is in the groups {', '.join(map(repr, groups))}; name "
            f'one of them as "{first.group}:{first.name}" (--column "{name}={first.group}:..")'
        )
    where = f" in the group {groups[0]!r}" if groups[0] else ""
    return f"{path}: has two columns {next(iter(same)).plain}{where}"


def without_twins(columns: Sequence[Column]) -> list[Column]:
    """Return columns without those that repeat another with its name, unit and all its numbers."""
    found: list[Column] = []
    for column in columns:
        same = (c for c in found if (c.name, c.unit) == (column.name, column.unit))
        if not column.name or all(c.cells != column.cells for c in same):
            found.append(column)
    return found


def split_head(head: str) -> tuple[str, str]:
    """Return name and unit of a column's head.

    Examples
    --------
    >>> split_head("speed [rpm]"), split_head("load (kN)"), split_head("friction")
    (('speed', 'rpm'), ('load', 'kN'), ('friction', ''))
    """
    match = re.fullmatch(r"\s*([^\[\]()]*?)\s*(?:\[(.*)\]|\((.*)\))?\s*", head)
    if match is None:
        return head.strip(), ""
    return match[1], plain_unit(match[2] or match[3] or "")


def plain_unit(text: str) -> str:
    """Return a unit without brackets; none for a pure number."""
    text = text.strip().strip("[]()").strip()
    return "" if text in ("-", "1", "\u2013") else text


def is_unit(text: str) -> bool:
    """Tell if a text is a unit of anything, or says that there is none."""
    text = plain_unit(text)
    if not text or text in RAW:
        return True
    return any(unit_size(text, unit) for unit in UNITS)


def numbers(
    column: Column, table: Table, unit: str, *, name: str = "", difference: bool = False
) -> list[float | None]:
    """Return a column in the SI unit ``unit``; None where a cell is empty, NaN or n/a.

    A time of day, such as 10:00:01.250, is seconds since midnight.

    Raises
    ------
    ParameterError : a cell is no finite number; the message names file, line and column
    """
    name = name or column.name
    if len(column.cells) > MANY and all(column.cells):
        whole = _converted(column, unit, difference)
        if whole is not None:
            return list(whole.tolist())
    found: list[float | None] = []
    for text, line in zip(column.cells, table.lines, strict=True):
        place = f"{table.path}, line {line}: {name}"
        if text.lower() in UNMEASURED:
            found.append(None)
            continue
        clock = CLOCK.fullmatch(text) if unit == "s" and column.unit in CLOCKED else None
        if clock:
            hours, minutes, seconds = (float(x.replace(",", ".")) for x in clock.groups())
            found.append(3600.0 * hours + 60.0 * minutes + seconds)
            continue
        try:
            float(text)
        except ValueError:
            raise ParameterError(f"{place} = {text!r}, a number is required") from None
        written = f"{text} {column.unit}".strip()
        found.append(parse_quantity(written, unit, place, difference=difference))
    return found


def _converted(column: Column, unit: str, difference: bool) -> NDArray[np.float64] | None:
    """Return all cells at once; None if one of them is no finite number."""
    size = unit_size(column.unit, unit)
    if size is None:
        return None
    factor, offset = np.longdouble(repr(size[0])), np.longdouble(repr(size[1]))
    try:
        values = np.array(column.cells, dtype=np.longdouble)
    except ValueError:
        return None
    with np.errstate(over="ignore"):
        si = np.asarray(values * factor + (0.0 if difference else offset), dtype=np.float64)
    return si if np.isfinite(si).all() else None
