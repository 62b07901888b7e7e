"""Columns by the names that count: ``--column NAME=COLUMN``.

COLUMN is read as the name of a column, exactly, then without a unit behind it; else as
"group:name" of a measuring file; else as a sum or difference of these with + and - between them,
each of which may stand in double quotes.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, suggestion
from ...units import UNITS, unit_size
from .table import Column, Table, several_text, split_head

SHOWN = 20  # names that a message lists
MINUS = "-\u2212"
_QUOTED = re.compile(r'"([^"]*)"')
_SPACED, _CLOSE = re.compile(r"\s+([-+\u2212])\s+"), re.compile(r"\s*([-+\u2212])\s*")


@dataclass(frozen=True)
class Sum(Column):
    """A column that is not made yet: channels of a measuring file with their signs."""

    terms: tuple[tuple[float, Column], ...] = ()


def renamed(table: Table, names: Mapping[str, str]) -> Table:
    """Return the table with columns renamed, or made of others: COLUMN by name, or name and [unit].

    Raises
    ------
    ParameterError : there is no such column, several have this name, a name is given twice, or the
        units of a sum do not agree
    """
    given = [name.partition("[")[0].strip() for name in names]
    twice = [name for name in given if given.count(name) > 1]
    if twice:
        raise ParameterError(f"--column {twice[0]}: is given twice")
    single: dict[int, list[tuple[str, str]]] = {}
    sums, remarks, used = [], [], []
    for head, text in names.items():
        name, unit = split_head(head)
        if (place := _one(table, name, text)) is not None:
            single.setdefault(place, []).append((name, unit))
            continue
        terms = _terms(table, name, text)
        sums.append(_sum(table, name, unit, text, terms))
        used += [column.name for _, column in terms]
        units = dict.fromkeys(column.unit for _, column in terms)
        own = sums[-1].unit or ", ".join(filter(None, units)) or ("" if table.binary else "no unit")
        signed = [f"{'+' if sign > 0.0 else '-'} {_whole(table, c)}" for sign, c in terms]
        behind = f" [{own}]" if own else ""  # of channels that are not read yet
        remarks.append(f"{name} = {' '.join(signed).removeprefix('+ ')}{behind}")
    columns: list[Column] = []
    for i, c in enumerate(table.columns):
        own_names = single.get(i, [])
        columns += [replace(c, name=name, unit=unit or c.unit) for name, unit in own_names]
        if not own_names and c.name not in given:
            columns.append(c)
    return replace(
        table,
        columns=[*columns, *sums],
        remarks=[*table.remarks, *remarks],
        given={**table.given, **dict(zip(given, names.values(), strict=True))},
        used=(*table.used, *used),
    )


def _one(table: Table, name: str, text: str) -> int | None:
    """Return the place of the column that a text names; None if it names none."""
    text = match[1] if (match := _QUOTED.fullmatch(text)) else text
    bare, unit = split_head(text)
    ways = (
        [c.name == text for c in table.columns],
        [bool(unit) and c.name == bare and c.unit in ("", unit) for c in table.columns],
        [bool(c.group) and f"{c.group}:{c.name}" == text for c in table.columns],
    )
    for way in ways:
        found = [i for i, is_it in enumerate(way) if is_it]
        if len(found) > 1:
            same = [table.columns[i] for i in found]
            raise ParameterError(several_text(table.path, name, same))
        if found:
            return found[0]
    return None


def _whole(table: Table, column: Column) -> str:
    """Return a column's name, with its group where several groups have it."""
    alike = [c for c in table.columns if c.name == column.name]
    return f"{column.group}:{column.name}" if len(alike) > 1 and column.group else column.name


def _terms(table: Table, name: str, text: str) -> list[tuple[float, Column]]:
    """Return columns with their signs; ParameterError if one is none."""
    quoted = _QUOTED.findall(text)
    masked = _QUOTED.sub("\0", text)
    first_unknown = text
    for pattern in (_SPACED, _CLOSE):
        parts, rest = pattern.split(masked.strip()), list(quoted)
        words = [rest.pop(0) if part.strip() == "\0" else part.strip() for part in parts[::2]]
        if len(words) < 2 or not all(words):
            continue
        places = [_one(table, name, word) for word in words]
        if None not in places:
            signs = [1.0, *(-1.0 if sign in MINUS else 1.0 for sign in parts[1::2])]
            columns = [table.columns[i] for i in places if i is not None]
            return list(zip(signs, columns, strict=True))
        if first_unknown == text:
            first_unknown = words[places.index(None)]
    known = [column.name for column in table.columns]
    hint = suggestion(first_unknown, known, "did you mean {}? ")
    shown = list(dict.fromkeys(known))
    more = ", .." if len(shown) > SHOWN else ""
    raise ParameterError(
        f"{table.path}: --column {name}={text}: there is no column {first_unknown!r}; "
        f"{hint}found: {', '.join(shown[:SHOWN])}{more}"
    )


def _sum(
    table: Table, name: str, unit: str, text: str, terms: list[tuple[float, Column]]
) -> Column:
    """Return the column of a sum; of a measuring file, whose cells are read later, its terms."""
    if table.binary and not all(column.cells for _, column in terms):
        return Sum(name, unit, [], terms=tuple(terms))
    try:
        return added(table, name, unit, terms)
    except ParameterError as error:
        raise ParameterError(f"{table.path}: --column {name}={text}: {error}") from None


def added(table: Table, name: str, unit: str, terms: list[tuple[float, Column]]) -> Column:
    """Return the sum of columns; ParameterError if their units do not agree."""
    own = [column.unit for _, column in terms]
    together = own[0]
    sizes = [1.0] * len(own)
    if len(set(own)) > 1:
        together, sizes = _common(own, [column.name for _, column in terms])
    size = unit_size(together, "K") if together else None
    if size and (size[1] or together == "K"):
        raise ParameterError("a sum of temperatures is none, allowed: speeds, forces, torques, ..")
    total: NDArray[np.float64] = np.zeros(len(table))
    for (sign, column), factor in zip(terms, sizes, strict=True):
        total = total + sign * factor * _values(table, column)
    cells = ["" if x != x else repr(x) for x in total.tolist()]
    return Column(name, unit or together, cells)


def _common(units: list[str], names: list[str]) -> tuple[str, list[float]]:
    """Return the SI unit of several that measure the same, and the size of each in it."""
    for si in UNITS:
        sizes = [unit_size(unit, si) if unit else None for unit in units]
        known = [size[0] for size in sizes if size]
        if len(known) == len(units):
            return si, known
    told = ", ".join(f"{n} in {u or 'no unit'}" for n, u in zip(names, units, strict=True))
    raise ParameterError(f"units of all columns that agree are required, found: {told}")


def _values(table: Table, column: Column) -> NDArray[np.float64]:
    """Return the numbers of a column, NaN where a cell is empty."""
    found = np.full(len(table), np.nan)
    for i, (cell, line) in enumerate(zip(column.cells, table.lines, strict=True)):
        try:
            found[i] = float(cell) if cell else np.nan
        except ValueError:
            raise ParameterError(
                f"line {line}: {column.name} = {cell!r}, a number is required"
            ) from None
    return found
