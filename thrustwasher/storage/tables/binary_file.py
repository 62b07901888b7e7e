"""Tables in files of spreadsheets, MATLAB and measuring programs, read by other packages."""

from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import ParameterError
from .measuring_file import INSTALL, read_channels
from .table import LONGEST, Column, Table, is_unit, plain_unit, split_head


def read_binary(path: Path) -> Table:
    """Return the table of an ``.xlsx``, ``.mat`` or ``.mf4`` file.

    Raises
    ------
    ParameterError : the package that reads it is missing, the file is none of these, or it holds no
        columns of one length
    """
    if not path.is_file():
        raise ParameterError(f"{path}: there is no such file")
    ending = path.suffix.lower()
    if ending in (".xlsx", ".xlsm"):
        return _spreadsheet(path)
    return _matlab(path) if ending == ".mat" else read_channels(path)


def _spreadsheet(path: Path) -> Table:
    """Return the first sheet: a line of names, perhaps one of units, then numbers."""
    try:
        from openpyxl import load_workbook
    except ImportError:
        raise ParameterError(f"{path}: openpyxl is required to read it: {INSTALL}") from None
    try:
        with closing(load_workbook(path, read_only=True, data_only=True)) as book:
            sheet = book.worksheets[0]
            rows = [
                (number, [_text(value) for value in row])
                for number, row in enumerate(sheet.iter_rows(values_only=True), 1)
            ]
    except Exception as error:  # of zip, xml or openpyxl: whatever a damaged file brings
        raise ParameterError(f"{path}: cannot be read as a spreadsheet ({error})") from None
    rows = [(n, row) for n, row in rows if any(row) and not row[0].startswith("#")]
    if len(rows) < 2:
        raise ParameterError(f"{path}: a line of column names and one of numbers are required")
    heads = [split_head(cell) for cell in rows[0][1]]
    units, remarks = [unit for _, unit in heads], [f"sheet {sheet.title!r}"]
    second = rows[1][1]
    if not any(units) and any(map(plain_unit, second)) and all(map(is_unit, second)):
        units = [plain_unit(cell) for cell in second]
        remarks.append(f"units from line {rows[1][0]}")
        del rows[1]
    columns = [
        Column(name, unit, [row[i] if i < len(row) else "" for _, row in rows[1:]])
        for i, ((name, _), unit) in enumerate(zip(heads, units, strict=True))
        if name
    ]
    return Table(str(path), columns, [n for n, _ in rows[1:]], remarks)


def _text(value: object) -> str:
    """Return what a cell of a spreadsheet holds."""
    if value is None:
        return ""
    return repr(value) if isinstance(value, float) else str(value).strip()


def _matlab(path: Path) -> Table:
    """Return the vectors of a MATLAB file that have the length most of them have."""
    from scipy.io import loadmat

    try:
        found = loadmat(path, squeeze_me=True)
    except Exception as error:  # whatever a damaged file brings
        cure = " (save it with -v7)" if isinstance(error, NotImplementedError) else ""
        raise ParameterError(f"{path}: cannot be read as a MATLAB file{cure}") from None
    vectors = {}
    for name, value in found.items():
        numeric = isinstance(value, np.ndarray) and value.dtype.kind in "fiub"
        if not name.startswith("_") and numeric and value.ndim == 1:
            vectors[name] = value
    return _of_arrays(path, {name: ("", value) for name, value in vectors.items()})


def _of_arrays(path: Path, arrays: dict[str, tuple[str, Any]]) -> Table:
    """Return the table of arrays with their units."""
    lengths = [len(value) for _, value in arrays.values() if len(value) > 1]
    if not lengths:
        raise ParameterError(f"{path}: has no vector of numbers")
    usual = max(set(lengths), key=lengths.count)
    if usual > LONGEST:
        raise ParameterError(f"{path}: has more than {LONGEST} rows")
    columns = [
        Column(name, plain_unit(unit), [repr(x) for x in np.asarray(value, float).tolist()])
        for name, (unit, value) in arrays.items()
        if len(value) == usual
    ]
    return Table(str(path), columns, list(range(1, usual + 1)), binary=True)
