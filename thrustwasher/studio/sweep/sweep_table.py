"""The rows of a sweep as columns, and as a file."""

import json
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from ...errors import FIRST_FAILURE, EnvironmentProblem, ParameterError, Status
from ...model.part_file import PartFile
from ...model.registry import find_model
from ...model.solutions import without_idle, words_at_points
from ...model.spec import NAMED
from ...shown import Card, Tabled, Words, column_lines, plain_dict
from ...storage.journal import Block
from ...storage.whole_files import whole_file
from ..evaluators.limits import Beyond, beyond, beyond_ranges, joined
from ..evaluators.lines import output_signals
from ..jobs.cluster import INSTALL
from .csv_text import text_of_rows
from .run_plan import RunPlan
from .sweep_plan import Plan

ADVICE = {
    "peak_temperature": Status.HOT.advice,
    "slip_left": "it has not run out, there is no slip_time: a longer duration, more load or faces",
}
SUFFIXES = (".csv", ".parquet")
NUMBERED = re.compile(r"[a-z]+_\d+_")  # begin names of a mesh or shaft, which may not be there
CHUNK = 10_000  # rows of a piece, a group of Parquet
POOL = "ARROW_DEFAULT_MEMORY_POOL"
TEXT = 2_000  # rows made into text at a time


@dataclass(frozen=True)
class SweepTable(Tabled):
    """All points of a sweep: inputs, varied parameters, outputs, status; SI units.

    ``columns`` maps names to arrays in the order of the rows, as ``pandas.DataFrame`` takes them.
    ``choice`` says why the level ``fidelity`` was chosen, if it was not requested by name.
    Outputs of a failed point are NaN, "" or False; ``status`` says why;
    ``counts`` are the points by status. ``taken`` names the inputs that were not given and where
    their values come from, ``outside`` those of which points lie outside the part's box,
    ``beyond`` the outputs that are beyond what a part bears, ``model`` the key of what was solved.
    """

    columns: dict[str, NDArray[Any]]
    units: dict[str, str]
    fidelity: str = ""
    choice: str = ""
    counts: Mapping[str, int] = field(default_factory=dict)
    taken: str = ""
    outside: tuple[str, ...] = ()
    beyond: tuple[Beyond, ...] = ()
    model: str = ""
    results: tuple[str, ...] = ()
    """Names of what was computed, where that is not what the model calls them."""
    asked: tuple[str, ...] = ()
    """Names of what was varied, in the order in which it was named."""
    words: Mapping[str, Words] = field(default_factory=dict, repr=False)
    """Meaning of columns that the model calls otherwise."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a reader must not miss: points outside the part's box, and those with an advice."""
        limits = (found.text(len(self)) for found in self.beyond)
        hot = max((found.rows for found in self.beyond if found.sign > 0.0), default=0)
        known = {
            "OK",
            *(["HOT"] if hot >= self.counts.get("HOT", 0) else []),
        }  # told with the worst
        advised = (
            f"{n} of {len(self)} points {name}: {Status[name].advice}"
            if name in Status.__members__
            else f"{n} of {len(self)} runs: {name}"
            for name, n in sorted(self.counts.items())
            if name not in known
        )
        return (*self.outside, *advised, *limits)

    def __len__(self) -> int:
        return sum(self.counts.values())

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.columns[name]

    def to_dict(self) -> dict[str, Any]:
        """Return columns with their units and what is to be known of them, as JSON can hold it."""
        own = ("model", "fidelity", "choice", "columns", "units", "counts", "taken", "warnings")
        return plain_dict({name: getattr(self, name) for name in own})

    def outputs(self) -> list[str]:
        """Return the names of the model's outputs among the columns."""
        found = find_model(self.model).spec.outputs if self.model else ()
        known = {*self.results, *(s.name for s in found)}
        return [name for name in self.columns if name in known]

    def axes(self) -> list[str]:
        """Return the other columns that are not the same in all rows, in the order asked."""
        own = {*self.outputs(), "status"}
        first = [name for name in self.asked if name in self.columns]
        others = [name for name in dict.fromkeys([*first, *self.columns]) if name not in own]
        return [name for name in others if len(set(self.columns[name].tolist())) > 1]

    def _axes(self) -> list[str]:
        return self.axes()

    def _columns(self) -> dict[str, NDArray[Any]]:
        return self.columns

    def _words(self) -> dict[str, Words]:
        known = self.words or (words_at_points(find_model(self.model)) if self.model else {})
        return {n: known.get(n, Words())._replace(unit=unit) for n, unit in self.units.items()}

    def _card(self) -> Card:
        title = f"{len(self)} points of {self.model or 'a sweep'}, {self.fidelity}"
        notes = [f"{text[0].upper()}{text[1:]}." for text in (self.choice, self.taken) if text]
        spec = find_model(self.model).spec if self.model else None
        columns = without_idle(spec, self.columns) if spec else self.columns
        return Card(title, column_lines(columns, self._words()), notes, self.warnings)

    @property
    def failures(self) -> dict[str, int]:
        """How many points failed with which status."""
        sound = {s.name for s in Status if not s.is_failure}
        return {name: n for name, n in sorted(self.counts.items()) if name not in sound}


def make_table(
    plan: Plan | RunPlan, numbers: NDArray[np.float64], flags: NDArray[np.int32], first: int = 0
) -> SweepTable:
    """Return the table of outputs as ``solve_task`` gives them, of the plan's rows from one on."""
    if isinstance(plan, RunPlan):
        return _run_table(plan, numbers, flags, first)
    real, whole = output_signals(plan.spec)
    numbers, flags = _parted(numbers, flags, len(real))
    rows = slice(first, first + len(flags))
    columns, units = plan.columns_at(rows), dict(plan.units)
    sets = [plan.spec.absent(params) for params in plan.params if params is not None]
    common = frozenset.intersection(*sets) if sets else frozenset()
    nowhere = {name for name in common if NUMBERED.match(name)}
    for i, signal in enumerate(real):
        if signal.name not in nowhere:
            columns[signal.name], units[signal.name] = numbers[:, i], signal.unit
    failed = flags[:, -1] >= FIRST_FAILURE
    for i, signal in enumerate(whole[:-1]):
        column = flags[:, i]
        if signal.name in nowhere:
            continue
        if signal.type in NAMED:
            names = np.array(["", *NAMED[signal.type]], object)
            columns[signal.name] = names[np.where(failed, 0, column)]
        else:
            columns[signal.name] = (column != 0) & ~failed
    names = np.full(max(Status) + 1, "", object)
    for status in Status:
        names[status] = status.name
    columns["status"] = names[flags[:, -1]]
    counts = {Status(i).name: n for i, n in enumerate(np.bincount(flags[:, -1]).tolist()) if n}
    more = plan.taken, plan.warnings, tuple(beyond(plan.spec, columns)), plan.spec.key
    named: dict[str, Any] = {"asked": plan.asked}
    table = SweepTable(columns, units, plan.fidelity, plan.choice, counts, *more, **named)
    return _as_in_file(table, plan.evaluator.part)


def _as_in_file(table: SweepTable, part: PartFile) -> SweepTable:
    """Return a table with the names that a part's file has for what the model calls otherwise."""
    if not part.names:
        return table
    known = words_at_points(find_model(part.spec.key))
    return replace(
        table,
        columns={part.own_name(name): x for name, x in table.columns.items()},
        units={part.own_name(name): x for name, x in table.units.items()},
        beyond=tuple(
            x._replace(signal=replace(x.signal, name=part.own_name(x.signal.name)))
            for x in table.beyond
        ),
        results=tuple(part.own_name(s.name) for s in part.spec.outputs),
        asked=tuple(map(part.own_name, table.asked)),
        words={
            part.own_name(name): x._replace(help=part.own_text(x.help)) for name, x in known.items()
        },
    )


def _run_table(
    plan: RunPlan, values: NDArray[np.float64], codes: NDArray[np.int32], first: int
) -> SweepTable:
    """Return the table of rows that stand alone."""
    rows, known = slice(first, first + len(codes)), plan.evaluator.figures
    columns = {name: column[rows] for name, column in plan.shown.items()}
    units = dict(plan.units)
    for i, name in enumerate(plan.figures):
        columns[name], units[name] = values[:, i], known[name].unit
    words = {code: plan.status(code) for code in set(codes[:, 0].tolist())}
    status = [words[code] for code in codes[:, 0].tolist()]
    columns["status"] = np.array(status, object)
    numbers = {name: f for name, f in known.items() if f.kind == "real"}
    bounded = plan.evaluator.kind == "engagement"  # of a shift the ranges are what is usual
    found = tuple(beyond_ranges(numbers, columns, ADVICE)) if bounded else ()
    more: dict[str, Any] = {
        "beyond": found,
        "outside": plan.warnings,
        "results": plan.figures,
        "taken": plan.taken,
        "asked": plan.asked,
    }
    return SweepTable(columns, units, counts=Counter(status), **more)


def _parted(
    values: NDArray[np.float64], codes: NDArray[np.int32], n_real: int
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return real outputs, and whole numbers with the status last; 0 where a row failed."""
    whole = np.nan_to_num(values[:, n_real:]).astype(np.int32)
    return values[:, :n_real], np.hstack((whole, codes))


def pieces(plan: Plan | RunPlan, blocks: Iterable[Block]) -> Iterator[SweepTable]:
    """Yield the table of consecutive blocks of rows in pieces."""
    waiting: list[Block] = []
    for block in blocks:
        waiting.append(block)
        first, end = waiting[0][0], block[0] + len(block[2])
        if end - first >= CHUNK or end == plan.n_rows:
            _, *parts = zip(*waiting, strict=True)
            waiting, numbers, flags = [], *map(np.concatenate, parts)
            del block, parts
            yield make_table(plan, numbers, flags, first)
            del numbers, flags  # before the next ones are made


def check_output(path: str | Path) -> Path:
    """Return the path if the table can be written there; said before any work is done."""
    target = Path(path)
    if target.suffix.lower() not in SUFFIXES:
        raise ParameterError(f"out = {str(path)!r}, allowed: a name ending in .csv or .parquet")
    if target.is_dir():
        raise ParameterError(f"out = {str(path)!r}: is a folder, the name of a file is required")
    if target.suffix.lower() == ".parquet":
        _pyarrow()
    return target


def write_table(
    tables: Iterator[SweepTable], path: Path
) -> tuple[Counter[str], tuple[Beyond, ...]]:
    """Write CSV or Parquet, as the name ends, from pieces of a table, whole or not at all.

    Return the points by status, and what is beyond its bound.
    """
    counts, found, writer, schema = Counter[str](), list[Beyond](), None, None
    with whole_file(path) as draft, ExitStack() as stack:
        if path.suffix.lower() != ".parquet":
            stream = stack.enter_context(draft.open("w", encoding="utf-8", newline=""))
        else:
            stream = None
        for table in tables:
            if stream:
                write_csv(table, stream, head=not counts)
            else:
                group = _batch(table)
                if writer is None:
                    schema, more = group.schema, {"use_dictionary": _repeating(table)}
                    writer = _pyarrow()[1].ParquetWriter(draft, schema, **more)
                    stack.enter_context(writer)
                # a cast imports pyarrow.compute, of 12 MB
                writer.write_table(group if group.schema == schema else group.cast(schema))
                del group
            counts.update(table.counts)
            found = joined([*found, *table.beyond])
            del table  # before the next one is made
    return counts, tuple(found)


def write_csv(table: SweepTable, stream: IO[str], *, head: bool = True) -> None:
    """Write the table as CSV: units in the head, numbers in full, empty where a point failed."""
    heads = [
        f"{name} [{table.units[name]}]" if table.units.get(name, "1") != "1" else name
        for name in table.columns
    ]
    if head:
        stream.write(",".join(heads) + "\n")
    n = len(table)
    for a in range(0, n, TEXT):
        columns = [column[a : a + TEXT] for column in table.columns.values()]
        stream.write(text_of_rows(columns, many=a >= CHUNK or not head))


def _repeating(table: SweepTable) -> list[str]:
    """Return the columns whose values come again and again: a dictionary of others only costs."""
    return [
        name
        for name, column in table.columns.items()
        if column.dtype.kind != "f" or len(np.unique(column)) <= len(column) // 2
    ]


def _batch(table: SweepTable) -> Any:
    """Return a table of pyarrow; failed numbers are null.

    Units are in the columns' metadata, and where pandas keeps ``attrs`` in a Parquet file.
    """
    pa, _ = _pyarrow()
    fields, arrays = [], []
    bad = np.isin(table["status"], list(table.failures)) if table.failures else None
    for title, column in table.columns.items():
        array = _arrow(column, bad)
        unit = table.units.get(title, "")
        fields.append(pa.field(title, array.type, metadata={"unit": unit} if unit else None))
        arrays.append(array)
    attributes = {"units": {n: unit for n, unit in table.units.items() if n in table.columns}}
    schema = pa.schema(fields, metadata={"PANDAS_ATTRS": json.dumps(attributes)})
    return pa.Table.from_arrays(arrays, schema=schema)


def _arrow(column: NDArray[Any], bad: NDArray[np.bool_] | None) -> Any:
    """Return a column of pyarrow; numbers that are NaN, and truths of ``bad`` rows, are null.

    It is made of its bytes: to look at numpy's arrays pyarrow imports pandas, of 50 MB.
    """
    pa, _ = _pyarrow()
    n, valid, kind = len(column), None, pa.float64()
    if column.dtype == object:
        words = column.tolist()
        if {*map(type, words)} - {str}:
            return pa.array(words)
        known = {word: i for i, word in enumerate(dict.fromkeys(words))}
        ends = np.cumsum([0, *(len(word.encode()) for word in known)], dtype=np.int32)
        texts = map(pa.py_buffer, (ends, "".join(known).encode()))
        codes = pa.py_buffer(np.fromiter(map(known.__getitem__, words), np.int32, n))
        return pa.DictionaryArray.from_arrays(
            pa.Array.from_buffers(pa.int32(), n, [None, codes]),
            pa.Array.from_buffers(pa.string(), len(known), [None, *texts]),
        )
    if column.dtype == bool:
        kind, values = pa.bool_(), np.packbits(column, bitorder="little")
        lacks = bad
    else:
        values, lacks = np.ascontiguousarray(column, float), np.isnan(column)
    if lacks is not None and lacks.any():
        valid = pa.py_buffer(np.packbits(~lacks, bitorder="little"))
    return pa.Array.from_buffers(kind, n, [valid, pa.py_buffer(values)])


@cache
def _pyarrow() -> tuple[Any, Any]:
    """Return pyarrow and its Parquet part, or say how to get them.

    Where it was not imported before it takes memory from the system: its own pool keeps 13 MB.
    """
    before = os.environ.get(POOL)
    try:
        os.environ.setdefault(POOL, "system")  # looked at when pyarrow is loaded
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise EnvironmentProblem(
            f"a Parquet file needs the package pyarrow: {INSTALL}; or choose a name ending in .csv"
        ) from None
    finally:
        if before is None:
            del os.environ[POOL]
    return pyarrow, pyarrow.parquet
