"""Tables as Python's users hand them over: a path, a DataFrame of pandas, an MDF of asammdf."""

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ...errors import ParameterError
from .known_columns import known_columns, refuse_misnamed
from .measuring_file import read_channels
from .table import Column, Columns, Table, numbers, plain_unit, split_head
from .table_file import read_table

TIME = "time"


def is_table(data: object) -> bool:
    """Tell if columns are handed over in something that is no mapping of them."""
    return isinstance(data, str | PathLike) or _is_frame(data) or _is_measuring(data)


def columns_given(
    data: Any, units: Mapping[str, str], may_lack: Sequence[str] | None = None
) -> Columns:
    """Return the columns that count [SI] by their names, lists; None where a cell is empty.

    Parameters
    ----------
    data : path of a file; ``pandas.DataFrame``, units in ``attrs["units"]`` or in the heads, its
        index may be time (seconds, Timedelta or Timestamp); ``asammdf.MDF``
    units : SI unit of every name that counts; other columns are passed over
    may_lack : those that may have empty cells; None: all

    Raises
    ------
    ParameterError : as of a file with these columns, or the path names no file
    """
    lacking = tuple(units if may_lack is None else may_lack)
    with TemporaryDirectory() as folder:
        table: Table
        if _is_measuring(data):
            path = Path(data.save(Path(folder) / "given.mf4", overwrite=True))
            table = read_channels(path)
        else:
            table = _of_frame(data) if _is_frame(data) else read_table(data)
        table = table.of_columns(units, lacking)
    sort = known_columns(table, units)
    refuse_misnamed(table, units, sort)
    found = sort.found
    columns = Columns(
        {name: numbers(c, table, units[name], name=name) for name, c in found.items()}
    )
    columns.units = {name: c.unit for name, c in found.items() if c.unit}
    columns.remarks = list(table.remarks)
    if sort.passed:
        columns.remarks.append(f"passed over, as no column that counts: {', '.join(sort.passed)}")
    return columns


def _is_frame(data: Any) -> bool:
    return hasattr(data, "columns") and hasattr(data, "attrs") and hasattr(data, "index")


def _is_measuring(data: Any) -> bool:
    return type(data).__name__ == "MDF" and hasattr(data, "save")


def _of_frame(frame: Any) -> Table:
    """Return the columns of a DataFrame, its index as time if it is one."""
    units = frame.attrs.get("units", {})
    columns = []
    for name in frame.columns:
        bare, unit = split_head(str(name))
        values = frame[name].to_numpy()
        if values.dtype.kind in "fiub":
            cells = ["" if x != x else repr(float(x)) for x in values.tolist()]
        else:
            cells = ["" if x is None or x != x else str(x) for x in values.tolist()]
        columns.append(Column(bare, plain_unit(str(units.get(name, unit))), cells))
    index, name = frame.index, str(frame.index.name or "")
    kind, unit = index.dtype.kind, split_head(name)[1] or str(units.get(name, ""))
    is_time = kind in "mM" or split_head(name)[0].lower() == TIME
    if is_time and all(c.plain != TIME for c in columns):
        values = index.to_numpy()
        if kind in "mM":
            values, unit = (values - values[0]) / np.timedelta64(1, "ns") * 1e-9, "s"
        columns.insert(0, Column(TIME, unit, [repr(float(x)) for x in values.tolist()]))
    if not columns:
        raise ParameterError("DataFrame: has no columns, allowed: those that count")
    return Table("DataFrame", columns, list(range(1, len(frame) + 1)), binary=True)
