"""Columns of a Parquet file, with the units that its metadata name."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import ParameterError
from .table import LONGEST, Column, Table, plain_unit, split_head

INSTALL = 'pip install "thrustwasher[sweep]"'


def read_parquet(path: Path) -> Table:
    """Return the columns of numbers.

    Their units are those of the field's metadata (``unit``), of pandas' attributes (``units``), or
    behind their names.

    Raises
    ------
    ParameterError : pyarrow is missing, or the file cannot be read
    """
    try:
        from pyarrow import parquet
    except ImportError:
        raise ParameterError(f"{path}: pyarrow is required to read it: {INSTALL}") from None
    try:
        found = parquet.read_table(path)
    except Exception as error:  # of pyarrow, whatever a damaged file brings
        raise ParameterError(f"{path}: cannot be read as a Parquet file ({error})") from None
    if found.num_rows > LONGEST:
        raise ParameterError(f"{path}: has more than {LONGEST} rows")
    units = _pandas_units(found.schema.metadata or {})
    columns = []
    for field, values in zip(found.schema, found.columns, strict=True):
        name, own = split_head(field.name)
        unit = (field.metadata or {}).get(b"unit", b"").decode() or units.get(field.name, own)
        cells = _cells(values.to_pylist())
        columns.append(Column(name, plain_unit(str(unit)), cells))
    return Table(str(path), columns, list(range(1, found.num_rows + 1)), binary=True)


def _cells(values: list[Any]) -> list[str]:
    """Return the cells of a column; "" for a number that is none."""
    return [
        ""
        if value is None or value != value
        else repr(float(value))
        if isinstance(value, bool | int | float | np.number)
        else str(value)
        for value in values
    ]


def _pandas_units(metadata: dict[bytes, bytes]) -> dict[str, str]:
    """Return the units that pandas wrote next to the table."""
    for key in (b"PANDAS_ATTRS", b"pandas"):
        try:
            attributes = json.loads(metadata.get(key, b"{}"))
        except ValueError:
            continue
        own = attributes.get("attributes", attributes).get("units", {})
        if isinstance(own, dict) and own:
            return {str(name): str(unit) for name, unit in own.items()}
    return {}
