"""Tables in text files: code page, separator and decimal sign are found, or the file is refused."""

import csv
import re
from collections.abc import Sequence
from pathlib import Path

from ...errors import ParameterError
from .table import LONGEST, Column, Table, is_unit, plain_unit, split_head

SEPARATORS = ";\t,"
# spaces and apostrophes that group the digits of large numbers
_SPACES = dict.fromkeys(map(ord, " \u00a0\u2007\u2009\u202f'\u2019"), None)
_WITH_COMMA = re.compile(r"[+-]?(\d{1,3}(\.\d{3})+|\d*),\d+([eE][+-]?\d+)?")
_WITH_POINT = re.compile(r"[+-]?\d*\.\d+([eE][+-]?\d+)?")
_GROUPS_AND_POINT = re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+\.\d*")
_GROUPS = re.compile(r"[+-]?[1-9]\d{0,2}([ \u00a0\u2007\u2009\u202f'\u2019]\d{3})+([.,]\d*)?")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+")
COMMAS = "; if these are decimal commas they shift the columns: separate the cells by semicolons"


def read_text_table(path: Path) -> Table:
    """Return the table of a text file; errors name file and line."""
    text, remarks = _decoded(path)
    lines = _lines(path, text)
    separator = ""
    if lines and (match := re.fullmatch(r"sep=(.)\s*", lines[0][1])):  # a line for Excel
        separator = match[1]
        del lines[0]
    if not lines:
        raise ParameterError(f"{path}: is empty, a line of column names is required first")
    separator = separator or max(SEPARATORS, key=lines[0][1].count)
    heads = [split_head(cell) for cell in _cells(lines[0][1], separator)]
    rows = [(number, _cells(line, separator)) for number, line in lines[1:]]
    names, units = [name for name, _ in heads], [unit for _, unit in heads]
    if rows and not any(units) and _is_units(rows[0][1]):
        number, cells = rows.pop(0)
        units = [plain_unit(cell) for cell in cells] + [""] * (len(names) - len(cells))
        remarks.append(f"units from line {number}")
    for number, cells in rows:
        if len(cells) > len(names):
            said = f"{path}, line {number}: has {len(cells)} cells, the head names {len(names)}"
            raise ParameterError(said + (COMMAS if separator == "," else ""))
    if not rows:
        raise ParameterError(f"{path}: has column names but no line of numbers")
    commas, groups = _signs(path, rows, names)
    remarks += ["decimal commas"] * commas + ["groups of thousands"] * groups
    columns = []
    for i, (name, unit) in enumerate(zip(names, units, strict=True)):
        cells = [row[i] if i < len(row) else "" for _, row in rows]
        if commas:
            cells = [_pointed(cell) for cell in cells]
        elif groups:
            cells = [_ungrouped(cell) for cell in cells]
        columns.append(Column(name, unit, cells))
    return Table(str(path), columns, [number for number, _ in rows], remarks)


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
    """Return the lines that count, with their numbers in the file."""
    found = [
        (number, line)
        for number, line in enumerate(re.split(r"\r\n|\n|\r", text), 1)
        if line.strip(" \t,;") and not line.lstrip().startswith("#")
    ]
    if len(found) > LONGEST:
        raise ParameterError(f"{path}: has more than {LONGEST} lines")
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


def _is_units(cells: Sequence[str]) -> bool:
    """Tell if a line has units and no number; a pure number's unit may be left out."""
    named = [cell for cell in cells if plain_unit(cell)]
    return bool(named) and all(is_unit(cell) for cell in cells) and "1" not in named


def _signs(
    path: Path, rows: Sequence[tuple[int, list[str]]], names: Sequence[str]
) -> tuple[bool, bool]:
    """Tell if the decimal sign is a comma, and if groups of thousands are parted.

    A file has one decimal sign: "1,200" has a group next to "0.5", "1.200" one next to "0,5". A
    file that can be read in two ways is refused.
    """
    first: dict[str, tuple[int, str, str]] = {}
    for number, cells in rows:
        for name, cell in zip(names, cells, strict=False):
            if not name.startswith("_") and not cell.isdigit():
                for kind in _kinds(cell):
                    first.setdefault(kind, (number, name, cell))
    comma = first.get("comma") or first.get("comma or group")
    point = first.get("point") or first.get("point or group")
    is_told = ("comma" in first) != ("point" in first)
    if comma and point and not is_told:
        raise ParameterError(
            f"{path}: line {comma[0]} has {comma[1]} = {comma[2]!r} and line {point[0]} "
            f"{point[1]} = {point[2]!r}, one decimal sign is required"
        )
    if comma and not is_told:
        raise ParameterError(
            f"{path}, line {comma[0]}: {comma[1]} = {comma[2]!r} may have a decimal comma or "
            "groups of thousands; write the numbers with a decimal point, or with digits enough "
            "to tell"
        )
    commas = "comma" in first
    return commas, "group" in first or ("point or group" if commas else "comma or group") in first


def _kinds(cell: str) -> tuple[str, ...]:
    """Return what a number's signs may be: decimal "comma" or "point", and "group"."""
    plain = _plain(cell)
    parted = ("group",) if plain != cell else ()
    if _GROUPS_AND_POINT.fullmatch(plain):
        return "point", "group"
    if _WITH_COMMA.fullmatch(plain):
        return (*parted, "comma or group" if _THOUSANDS.fullmatch(plain) else "comma")
    if _WITH_POINT.fullmatch(plain):
        is_group = _THOUSANDS.fullmatch(plain.replace(".", ","))
        return (*parted, "point or group" if is_group else "point")
    if _THOUSANDS.fullmatch(plain.replace(".", ",")):  # more than one point
        return "point or group", "group"
    return parted


def _plain(cell: str) -> str:
    """Return a cell without the spaces or apostrophes that part its thousands."""
    if cell.isascii() and " " not in cell and "'" not in cell:
        return cell
    return cell.translate(_SPACES) if _GROUPS.fullmatch(cell) else cell


def _ungrouped(cell: str) -> str:
    """Return a cell with a decimal point without what parts its thousands."""
    plain = _plain(cell)
    if _GROUPS_AND_POINT.fullmatch(plain) or _THOUSANDS.fullmatch(plain):
        return plain.replace(",", "")
    return plain


def _pointed(cell: str) -> str:
    """Return a cell with a decimal point for its comma."""
    plain = _plain(cell)
    if _WITH_COMMA.fullmatch(plain) or _THOUSANDS.fullmatch(plain.replace(".", ",")):
        return plain.replace(".", "").replace(",", ".")
    return plain
