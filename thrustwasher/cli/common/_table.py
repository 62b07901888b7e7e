"""Columns of a CSV file, found by their names, in SI units."""

import csv
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import ParameterError, refuse_pipe, suggestion
from ...units import parse_quantity
from ._output import note

LONGEST = 1_000_000  # lines; a larger file is not a table of measured points
COMMAS = "; if these are decimal commas they shift the columns: the decimal sign is a point"


def read_columns(
    path: str, units: Mapping[str, str], optional: tuple[str, ...] = (), *, strict: bool = False
) -> dict[str, list[Any]]:
    """Return the columns, each a list of numbers in SI units.

    The head names the columns, with the unit of the numbers in brackets: ``speed [rpm]``; without
    it they are SI. Empty lines and lines that begin with # are passed over, other columns too, with
    a line, unless their name is nearly one of these. Comma,
    semicolon or tab separate; the decimal sign is a point. ``units`` holds the SI unit of every
    column by its name, ``optional`` the names that may be missing. ``strict``: other columns are
    refused unless their names begin with _, and a cell may be empty: None. Errors name line and
    column.
    """
    lines = _lines(path)
    if not lines:
        raise ParameterError(f"{path}: is empty, a line of column names is required first")
    head = lines[0][1]
    separator = max(",;\t", key=head.count)
    names = _cells(head, separator)
    where, passed = _find(path, names, units, optional, strict)
    columns: dict[str, list[Any]] = {name: [] for name in where}
    for number, line in lines[1:]:
        cells = _cells(line, separator)
        if len(cells) > len(names):
            text = f"{path}, line {number}: has {len(cells)} cells, the head names {len(names)}"
            raise ParameterError(text + (COMMAS if separator == "," else ""))
        for name, (index, written) in where.items():
            place = f"{path}, line {number}: {name}"
            if index >= len(cells) or not cells[index].strip():
                if strict:
                    columns[name].append(None)
                    continue
                raise ParameterError(f"{place} is missing")
            columns[name].append(_number(place, cells[index].strip(), written, units[name]))
    if len(lines) == 1:
        raise ParameterError(f"{path}: has column names but no line of numbers")
    if passed:
        note(f"{path}: passed over, as no column that counts: {', '.join(passed)}")
    return columns


def _lines(path: str) -> list[tuple[int, str]]:
    """Return the lines that count, with their numbers in the file."""
    if Path(path).is_dir():
        raise ParameterError(f"{path}: is a folder, a CSV file is required")
    refuse_pipe(path)
    found = []
    try:
        with open(path, encoding="utf-8-sig", newline=None) as stream:
            for number, line in enumerate(stream, 1):
                if number > LONGEST:
                    raise ParameterError(f"{path}: has more than {LONGEST} lines")
                if "\0" in line:
                    raise ParameterError(f"{path}, line {number}: is not text")
                if line.strip(" \t\r\n,;") and not line.lstrip().startswith("#"):
                    found.append((number, line.rstrip("\r\n")))
    except UnicodeDecodeError:
        raise ParameterError(f"{path}: is not UTF-8 text, a CSV file is required") from None
    return found


def _cells(line: str, separator: str) -> list[str]:
    """Return the cells of a line without empty ones at its end, as spreadsheets leave them."""
    cells = [
        cell.strip()
        for cell in next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    ]
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _find(
    path: str, head: list[str], units: Mapping[str, str], optional: tuple[str, ...], strict: bool
) -> tuple[dict[str, tuple[int, str]], list[str]]:
    """Return the place and the written unit of every column, and those passed over."""
    found: dict[str, tuple[int, str]] = {}
    passed = []
    for index, cell in enumerate(head):
        match = re.fullmatch(r"\s*([^\[\]]*?)\s*(?:\[(.*)\])?\s*", cell)
        name = match[1].lower().replace(" ", "_") if match else ""
        if match is None or name not in units:
            hint = suggestion(
                name, set(units) - {*found}, "did you mean {}? ", likeness=0.6 if strict else 0.75
            )
            if cell and not cell.startswith("_"):
                if strict or hint:
                    raise ParameterError(
                        f"{path}: column {cell!r} is not known; {hint}begin its "
                        "name with _ to pass it over"
                    )
                passed.append(cell)
            continue
        if name in found:
            raise ParameterError(f"{path}: has two columns {name}")
        written = (match[2] or "").strip()
        written = "" if written in ("-", "1") else written
        parse_quantity(f"1 {written}", units[name], f"{path}: unit of column {name}")
        found[name] = (index, written)
    missing = [name for name in units if name not in found and name not in optional]
    if missing:
        names = ", ".join(cell.strip() for cell in head)
        raise ParameterError(
            f"{path}: column {missing[0]} is missing; required: {', '.join(units)}; found: {names}"
        )
    return found, passed


def _number(place: str, text: str, written: str, unit: str) -> float:
    """Return a cell in SI units."""
    try:
        float(text)
    except ValueError:
        comma = "; the decimal sign is a point" if re.fullmatch(r"[+-]?\d+,\d+", text) else ""
        raise ParameterError(f"{place} = {text!r}, a number is required{comma}") from None
    return parse_quantity(f"{text} {written}".strip(), unit, place)
