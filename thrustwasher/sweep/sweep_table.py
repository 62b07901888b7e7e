"""The rows of a sweep as columns, and as a file."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FIRST_FAILURE, EnvironmentProblem, ParameterError, Status
from ..model.spec import REGIMES
from ..storage.whole_files import whole_file
from .solve_rows import output_signals
from .sweep_plan import Plan

SUFFIXES = (".csv", ".parquet")
INSTALL = 'pip install "thrustwasher[sweep]"'
CHUNK = 50_000  # rows made into text, or a group of Parquet, at a time


@dataclass(frozen=True)
class SweepTable:
    """All points of a sweep: inputs, varied parameters, outputs, status; SI units.

    ``columns`` maps names to arrays in the order of the rows, as ``pandas.DataFrame`` takes them.
    ``choice`` says why the rung ``fidelity`` was chosen, if it was not asked for by name.
    Outputs of a failed point are NaN, "" or False; ``status`` says why.
    """

    columns: dict[str, NDArray[Any]]
    units: dict[str, str]
    fidelity: str = ""
    choice: str = ""

    def __len__(self) -> int:
        return len(self.columns["status"])

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.columns[name]

    @property
    def failures(self) -> dict[str, int]:
        """How many points failed with which status."""
        failed = {s.name for s in Status if s.is_failure}
        counts = Counter(self.columns["status"].tolist())
        return {name: n for name, n in sorted(counts.items()) if name in failed}


def make_table(plan: Plan, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> SweepTable:
    """Return the table of a plan's outputs, as ``solve_task`` gives them."""
    real, whole = output_signals(plan.spec)
    columns, units = dict(plan.shown), dict(plan.units)
    for i, signal in enumerate(real):
        columns[signal.name], units[signal.name] = numbers[:, i], signal.unit
    failed = flags[:, -1] >= FIRST_FAILURE
    for i, signal in enumerate(whole[:-1]):
        column = flags[:, i]
        if signal.type == "Regime":
            names = np.array(["", *REGIMES], object)
            columns[signal.name] = names[np.where(failed, 0, column)]
        else:
            columns[signal.name] = (column != 0) & ~failed
    names = np.full(max(Status) + 1, "", object)
    for status in Status:
        names[status] = status.name
    columns["status"] = names[flags[:, -1]]
    return SweepTable(columns, units, plan.fidelity, plan.choice)


def check_output(path: str | Path) -> Path:
    """Return the path if the table can be written there; said before any work is done."""
    target = Path(path)
    if target.suffix.lower() not in SUFFIXES:
        raise ParameterError(f"out = {str(path)!r}, allowed: a name ending in .csv or .parquet")
    if target.is_dir():
        raise ParameterError(f"out = {str(path)!r}: is a folder, the name of a file is wanted")
    if target.suffix.lower() == ".parquet":
        _pyarrow()
    return target


def write_table(table: SweepTable, path: Path) -> None:
    """Write CSV or Parquet, as the name ends; the file appears complete or not at all."""
    with whole_file(path) as draft:
        if path.suffix.lower() == ".parquet":
            _write_parquet(table, draft)
        else:
            with draft.open("w", encoding="utf-8", newline="") as stream:
                write_csv(table, stream)


def write_csv(table: SweepTable, stream: IO[str]) -> None:
    """Write the table as CSV: units in the head, numbers in full, empty where a point failed."""
    heads = [f"{name} [{table.units[name]}]" if table.units.get(name, "1") != "1" else name
             for name in table.columns]  # fmt: skip
    stream.write(",".join(heads) + "\n")
    n = len(table)
    for a in range(0, n, CHUNK):
        texts = [_texts(column[a : a + CHUNK]) for column in table.columns.values()]
        stream.write("\n".join(map(",".join, zip(*texts, strict=True))) + "\n")


def _texts(column: NDArray[Any]) -> Sequence[str]:
    """Return the cells of a column; equal numbers, as on a grid, are made into text once."""
    if column.dtype.kind == "b":
        return ["true" if value else "false" for value in column.tolist()]
    if column.dtype.kind != "f":
        return [str(value) for value in column.tolist()]
    bits, where = np.unique(column.view(np.int64), return_inverse=True)
    if len(bits) > len(column) // 2:
        texts = list(map(repr, column.tolist()))
        return [text if text != "nan" else "" for text in texts] if "nan" in texts else texts
    cells = ["" if text == "nan" else text for text in map(repr, bits.view(np.float64).tolist())]
    found: list[str] = np.array(cells, object)[where].tolist()
    return found


def _write_parquet(table: SweepTable, path: Path) -> None:
    """Write the table with its units in the columns' metadata; failed numbers are null."""
    parquet = _pyarrow()[1]
    first = _batch(table, slice(0, CHUNK))
    with parquet.ParquetWriter(path, first.schema) as writer:
        writer.write_table(first)
        for a in range(CHUNK, len(table), CHUNK):
            writer.write_table(_batch(table, slice(a, a + CHUNK)).cast(first.schema))


def _batch(table: SweepTable, rows: slice) -> Any:
    """Return some rows as a table of pyarrow."""
    pa, _ = _pyarrow()
    fields, arrays = [], []
    bad = np.isin(table["status"][rows], [s.name for s in Status if s.is_failure])
    for title, whole in table.columns.items():
        column = whole[rows]
        if column.dtype == object:
            array = pa.array(column.tolist())
            if pa.types.is_string(array.type):
                array = array.dictionary_encode()
        elif column.dtype == bool:
            array = pa.array(np.ascontiguousarray(column), mask=bad)
        else:  # NaN, from a failed point, becomes null
            array = pa.array(np.ascontiguousarray(column), from_pandas=True)
        unit = table.units.get(title, "")
        fields.append(pa.field(title, array.type, metadata={"unit": unit} if unit else None))
        arrays.append(array)
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


def _pyarrow() -> tuple[Any, Any]:
    """Return pyarrow and its Parquet part, or say how to get them."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise EnvironmentProblem(
            f"a Parquet file needs the package pyarrow: {INSTALL}; or choose a name ending in .csv"
        ) from None
    return pyarrow, pyarrow.parquet
