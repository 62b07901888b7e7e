"""Vectors of a MATLAB file, or of a struct in it."""

from pathlib import Path
from typing import Any

import numpy as np

from ...errors import ParameterError
from .heads import Wanted
from .table import LONGEST, Column, Table


def read_matlab(path: Path, wanted: Wanted) -> Table:
    """Return the vectors that have the length most of them have.

    Those of the file itself; where it has none, or with ``wanted.sheet``, those of a struct. Of a
    struct ``data`` they are in the group ``data``.
    """
    from scipy.io import loadmat

    try:
        found = loadmat(path, simplify_cells=True)
    except Exception as error:  # whatever a damaged file brings
        cure = " (save it with -v7)" if isinstance(error, NotImplementedError) else ""
        raise ParameterError(f"{path}: cannot be read as a MATLAB file{cure}") from None
    groups: dict[str, dict[str, Any]] = {}
    _collect({k: x for k, x in found.items() if not k.startswith("_")}, "", groups)
    groups = {name: own for name, own in groups.items() if _usual(own)}
    if wanted.sheet:
        if wanted.sheet not in groups:
            known = ", ".join(filter(None, groups)) or "none"
            raise ParameterError(f"{path}: --sheet {wanted.sheet}: structs with vectors: {known}")
        return _of_arrays(path, wanted.sheet, groups[wanted.sheet], [f"struct {wanted.sheet}"])
    if "" in groups:
        return _of_arrays(path, "", groups[""], [])
    if not groups:
        raise ParameterError(f"{path}: has no vector of numbers")
    if len(groups) > 1:
        told = ", ".join(f"{name} ({', '.join([*own][:6])})" for name, own in groups.items())
        raise ParameterError(
            f"{path}: has several structs with vectors, name one by --sheet: {told}"
        )
    name = next(iter(groups))
    return _of_arrays(path, name, groups[name], [f"struct {name}"])


def _collect(table: dict[str, Any], prefix: str, groups: dict[str, dict[str, Any]]) -> None:
    """Sort vectors of numbers by the struct that they are in."""
    for name, value in table.items():
        place = f"{prefix}.{name}" if prefix else name
        if isinstance(value, dict):
            _collect(value, place, groups)
        elif isinstance(value, np.ndarray) and value.dtype.kind in "fiub" and value.ndim == 1:
            groups.setdefault(prefix, {})[name] = value


def _usual(arrays: dict[str, Any]) -> int:
    """Return the length that most vectors have; 0 if there is none."""
    lengths = [len(value) for value in arrays.values() if len(value) > 1]
    return max(set(lengths), key=lengths.count, default=0)


def _of_arrays(path: Path, group: str, arrays: dict[str, Any], remarks: list[str]) -> Table:
    """Return the table of the vectors of a struct."""
    usual = _usual(arrays)
    if usual > LONGEST:
        raise ParameterError(f"{path}: has more than {LONGEST} rows")
    columns = [
        Column(name, "", [repr(x) for x in np.asarray(value, float).tolist()], group)
        for name, value in arrays.items()
        if len(value) == usual
    ]
    return Table(str(path), columns, list(range(1, usual + 1)), remarks, binary=True)
