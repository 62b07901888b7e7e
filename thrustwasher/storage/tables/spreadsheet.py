"""Sheets of a workbook: the rule of heads is that of text files."""

from contextlib import closing
from pathlib import Path

from ...errors import ParameterError
from .heads import Place, Wanted, chosen, is_number, passed_over, places
from .measuring_file import INSTALL
from .table import Column, Table, plain_unit, split_head, without_twins

Rows = list[tuple[int, list[str]]]
SHOWN = 5  # names of columns of a sheet in a message


def read_spreadsheet(path: Path, wanted: Wanted) -> Table:
    """Return the table of the one sheet that has one, or of ``wanted.sheet``.

    Raises
    ------
    ParameterError : openpyxl is missing, the file is no workbook, no sheet or several have a table
    """
    sheets = _sheets(path)
    if wanted.sheet:
        if wanted.sheet not in sheets:
            raise ParameterError(
                f"{path}: --sheet {wanted.sheet}: there is no such sheet; found: "
                f"{', '.join(sheets)}"
            )
        sheets = {wanted.sheet: sheets[wanted.sheet]}
    found = {
        name: places([n for n, _ in rows], _cells_of(rows), wanted) for name, rows in sheets.items()
    }
    fitting = [name for name, own in found.items() if own]
    if len(fitting) > 1:
        told = ", ".join(
            f"{name!r} ({', '.join(sheets[name][found[name][0].head][1][:SHOWN])})"
            for name in fitting
        )
        raise ParameterError(
            f"{path}: has several sheets with a table, name one by --sheet: {told}"
        )
    name = fitting[0] if fitting else next(iter(sheets))
    rows = sheets[name]
    if not fitting:
        if len(rows) < 2 or not any(any(map(is_number, row)) for _, row in rows[1:]):
            raise ParameterError(f"{path}: a line of column names and one of numbers are required")
        found[name] = [Place(0, -1, 1, len(rows))]
    return _table(path, name, rows, found[name], wanted)


def _sheets(path: Path) -> dict[str, Rows]:
    """Return the rows that count of every sheet, with their numbers, as texts."""
    try:
        from openpyxl import load_workbook
    except ImportError:
        raise ParameterError(f"{path}: openpyxl is required to read it: {INSTALL}") from None
    try:
        with closing(load_workbook(path, read_only=True, data_only=True)) as book:
            return {
                sheet.title: [
                    (number, row)
                    for number, values in enumerate(sheet.iter_rows(values_only=True), 1)
                    if any(row := _texts(values)) and not row[0].startswith("#")
                ]
                for sheet in book.worksheets
            }
    except Exception as error:  # of zip, xml or openpyxl: whatever a damaged file brings
        raise ParameterError(f"{path}: cannot be read as a spreadsheet ({error})") from None


def _cells_of(rows: Rows):  # type: ignore[no-untyped-def]
    """Return what gives the cells of a row."""
    return lambda i, _: rows[i][1]


def _table(path: Path, name: str, rows: Rows, found: list[Place], wanted: Wanted) -> Table:
    """Return the table of a sheet."""
    numbers = [number for number, _ in rows]
    heads = [rows[p.head][1] for p in found]
    picked = chosen(str(path), found, heads, numbers, wanted)
    place = found[picked[0]]
    split = [split_head(cell) for cell in heads[picked[0]]]
    units, remarks = [unit for _, unit in split], [f"sheet {name!r}"]
    remarks += passed_over(found, picked, numbers, lambda i: ", ".join(filter(None, rows[i][1])))
    if place.units >= 0 and not any(units):
        row = rows[place.units][1]
        units = [plain_unit(row[i]) if i < len(row) else "" for i in range(len(units))]
        remarks.append(f"units from line {numbers[place.units]}")
    parts = [rows[found[k].first : found[k].end] for k in picked]
    data = [row for part in parts for row in part]
    columns = [
        Column(head, unit, [row[i] if i < len(row) else "" for _, row in data])
        for i, ((head, _), unit) in enumerate(zip(split, units, strict=True))
        if head
    ]
    lengths = tuple(map(len, parts)) if len(parts) > 1 else ()
    return Table(str(path), without_twins(columns), [n for n, _ in data], remarks, parts=lengths)


def _texts(values: tuple[object, ...]) -> list[str]:
    """Return the cells of a row without empty ones at its end."""
    row = [_text(value) for value in values]
    while row and not row[-1]:
        row.pop()
    return row


def _text(value: object) -> str:
    """Return what a cell of a spreadsheet holds."""
    if value is None:
        return ""
    return repr(value) if isinstance(value, float) else " ".join(str(value).split())
