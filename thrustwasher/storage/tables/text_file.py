"""Tables in text files: code page, separator and decimal sign are found, or the file is refused."""

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from ...errors import ParameterError
from .decimal_signs import pointed, signs, ungrouped
from .heads import USUAL, Place, Wanted, chosen, is_number, passed_over, places
from .table import LONGEST, Column, Table, plain_unit, split_head, without_twins

SEPARATORS = ";\t,"
LONGEST_CELL = 5  # lines that a quoted cell may have
COMMAS = "; if these are decimal commas they shift the columns: separate the cells by semicolons"


def read_text_table(path: Path, wanted: Wanted = USUAL) -> Table:
    """Return the table of a text file; errors name file and line."""
    text, remarks = _decoded(path)
    lines = _lines(path, text)
    separator = ""
    if lines and (match := re.fullmatch(r"sep=(.)\s*", lines[0][1])):  # a line for Excel
        separator = match[1]
        del lines[0]
    if not lines:
        raise ParameterError(f"{path}: is empty, a line of column names is required first")
    return _Text(path, lines, separator).table(wanted, remarks)


@dataclass(frozen=True)
class _Text:
    """Lines that count, with their numbers in the file."""

    path: Path
    lines: list[tuple[int, str]]
    separator: str
    """As the file names it; "": each head has its own."""

    def cells(self, i: int, head: int) -> list[str]:
        """Return the cells of a line, parted as those of another."""
        return _cells(self.lines[i][1], self.separator_of(head))

    def separator_of(self, head: int) -> str:
        """Return what parts the cells of a line and of those below it."""
        return self.separator or max(SEPARATORS, key=self.lines[head][1].count)

    def table(self, wanted: Wanted, remarks: list[str]) -> Table:
        """Return the columns of the tables that are read."""
        numbers = [number for number, _ in self.lines]
        found = places(numbers, self.cells, wanted) or [self._first()]
        names = [[" ".join(cell.split()) for cell in self.cells(p.head, p.head)] for p in found]
        picked = chosen(str(self.path), found, names, numbers, wanted)
        remarks += passed_over(found, picked, numbers, lambda i: self.lines[i][1])
        place, heads = found[picked[0]], [split_head(name) for name in names[picked[0]]]
        head = [name for name, _ in heads]
        units = [unit for _, unit in heads]
        if place.units >= 0 and not any(units):
            cells = self.cells(place.units, place.head)
            units = [plain_unit(cell) for cell in cells] + [""] * (len(head) - len(cells))
            remarks.append(f"units from line {numbers[place.units]}")
        parts = [
            [
                (numbers[i], self.cells(i, found[k].head))
                for i in range(found[k].first, found[k].end)
            ]
            for k in picked
        ]
        rows = list(chain.from_iterable(parts))
        self._check(rows, head, self.separator_of(place.head))
        commas, groups = signs(self.path, rows, head)
        remarks += ["decimal commas"] * commas + ["groups of thousands"] * groups
        columns = []
        for i, (name, unit) in enumerate(zip(head, units, strict=False)):
            cells = [row[i] if i < len(row) else "" for _, row in rows]
            if commas:
                cells = [pointed(cell) for cell in cells]
            elif groups:
                cells = [ungrouped(cell) for cell in cells]
            columns.append(Column(name, unit, cells))
        lengths = tuple(map(len, parts)) if len(parts) > 1 else ()
        columns = without_twins(columns)
        return Table(str(self.path), columns, [n for n, _ in rows], remarks, parts=lengths)

    def _first(self) -> Place:
        """Return the place of a table whose head is no head as it should be: for the messages."""
        n = len(self.lines)
        near = (
            i
            for i in range(n - 1)
            if not any(map(is_number, self.cells(i, i)))
            and any(map(is_number, self.cells(i + 1, i)))
        )
        head = next(near, 0)
        return Place(head, -1, head + 1, n)

    def _check(
        self, rows: Sequence[tuple[int, list[str]]], head: Sequence[str], separator: str
    ) -> None:
        """Raise ParameterError for a table without rows, or with rows longer than the head."""
        for number, cells in rows:
            if len(cells) > len(head):
                said = f"{self.path}, line {number}: has {len(cells)} cells, the head names "
                raise ParameterError(f"{said}{len(head)}{COMMAS if separator == ',' else ''}")
        if not any(any(map(is_number, cells)) for _, cells in rows):
            raise ParameterError(f"{self.path}: has column names but no line of numbers")


def _decoded(path: Path) -> tuple[str, list[str]]:
    """Return the text of a file, and what was unusual about its code page."""
    data = path.read_bytes()
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        try:
            return data.decode("utf-16"), ["UTF-16"]
        except UnicodeDecodeError:
            raise ParameterError(f"{path}: begins as UTF-16 text and is none") from None
    if b"\0" in data:
        line = data[: data.index(b"\0")].count(b"\n") + 1
        raise ParameterError(f"{path}, line {line}: is not text")
    try:
        return data.decode("utf-8-sig"), []
    except UnicodeDecodeError:
        pass
    try:
        return data.decode("cp1252"), ["Windows code page 1252"]
    except UnicodeDecodeError:
        raise ParameterError(f"{path}: is neither UTF-8, UTF-16 nor Windows text") from None


def _lines(path: Path, text: str) -> list[tuple[int, str]]:
    """Return the lines that count, with their numbers in the file; a quoted cell may have some."""
    whole = re.split(r"\r\n|\n|\r", text)
    if '"' in text:
        whole = _with_long_cells(whole)
    found = [
        (number, line)
        for number, line in enumerate(whole, 1)
        if line.strip(" \t,;") and not line.lstrip().startswith("#")
    ]
    if len(found) > LONGEST:
        raise ParameterError(f"{path}: has more than {LONGEST} lines")
    return found


def _with_long_cells(lines: list[str]) -> list[str]:
    """Return lines where those of a cell with line ends are one, empty ones behind it."""
    found, i = list(lines), 0
    while i < len(lines):
        if lines[i].count('"') % 2:
            for k in range(i + 1, min(i + LONGEST_CELL, len(lines))):
                if lines[k].count('"') % 2:
                    found[i] = " ".join(lines[i : k + 1])
                    found[i + 1 : k + 1] = [""] * (k - i)
                    i = k
                    break
        i += 1
    return found


def _cells(line: str, separator: str) -> list[str]:
    """Return the cells of a line without empty ones at its end, as spreadsheets leave them."""
    if '"' in line:
        row = next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    else:
        row = line.split(separator)
    cells = [cell.strip() for cell in row]
    while cells and not cells[-1]:
        cells.pop()
    return cells
