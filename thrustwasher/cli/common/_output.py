"""What a command leaves behind: one JSON object, a table, or whole files; never half of one."""

import argparse
import csv
import dataclasses
import json
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ...errors import ParameterError
from ...model.solutions import scalars as scalars
from ...model.solutions import status_words as status_words
from ...model.spec import ModelSpec
from ...shown import plain
from ...shown import text_of as text_of
from ...storage.whole_files import new_folder
from ...storage.whole_files import whole_file as whole_file
from ...storage.whole_files import whole_folder as whole_folder
from ._progress import duration as duration
from ._progress import going_on as going_on
from ._progress import time_left as time_left

PLOT_SUFFIXES = (".png", ".svg", ".pdf")
LINES = 16  # of a table on the screen


def parameters_of(params: Any) -> dict[str, Any]:
    """Return the parameters by name."""
    return {f.name: getattr(params, f.name) for f in dataclasses.fields(params)}


def print_json(record: Mapping[str, object]) -> None:
    """Write one JSON object to standard output, numbers in full precision; it has ``warnings``."""
    print(json_text({"warnings": [], **record}))


def json_text(record: Mapping[str, object]) -> str:
    """Return one JSON object as text."""
    return json.dumps(plain(record), indent=2, allow_nan=False)


def print_rows(rows: Sequence[tuple[str, str, str]]) -> None:
    """Write name, value and meaning in columns."""
    names, values = max(len(row[0]) for row in rows), max(len(row[1]) for row in rows)
    for name, value, meaning in rows:
        print(f"  {name:<{names}}  {value:<{values}}  {meaning}".rstrip())


def print_table(
    units: Mapping[str, str], series: Mapping[str, Sequence[object]], width: int
) -> None:
    """Write the columns that have units, of lines that are spread evenly."""
    print("".join(f"{name:>{width}}" for name in units))
    last = len(next(iter(series.values()))) - 1
    for i in sorted({round(last * k / (LINES - 1)) for k in range(LINES)}):
        cells = (text_of(series[name][i], unit) for name, unit in units.items())
        print("".join(f"{cell:>{width}}" for cell in cells))


def columns(spec: ModelSpec, names: Iterable[str], **others: str) -> dict[str, str]:
    """Return the unit of each column: an input or output of the model, or one of the others."""
    units = {s.name: s.unit for s in (*spec.inputs, *spec.outputs)} | others
    return {name: units[name] for name in names}


def note(message: str) -> None:
    """Write a message for a person to standard error."""
    print(message, file=sys.stderr)


def warn(warnings: Iterable[str]) -> None:
    """Write warnings to standard error, a line each; it is called before the figures."""
    for text in warnings:
        note(f"warning: {' '.join(text.split())}")


def add_targets(
    parser: argparse.ArgumentParser, *, plot: str, out: str = "", instead: str = "a table"
) -> None:
    """Add ``--out`` and ``--plot`` where there is something to write or draw, and ``--json``."""
    for option, help in {"--out": out, "--plot": plot}.items():
        if help:
            parser.add_argument(option, metavar="FILE", help=help)
    parser.add_argument("--json", action="store_true", help=f"one JSON object instead of {instead}")


def write_text(path: Path, text: str) -> None:
    """Write a file, all of it or nothing."""
    with whole_file(path) as draft:
        draft.write_text(text, encoding="utf-8")


class Targets(NamedTuple):
    """The files requested, if any."""

    out: Path | None
    plot: Path | None

    def write(self, units: Mapping[str, str], series: Mapping[str, Iterable[object]]) -> None:
        """Write columns as CSV; the unit stands in the head of each."""
        if self.out is None:
            return
        with whole_file(self.out) as draft, draft.open("w", newline="", encoding="utf-8") as stream:
            table = csv.writer(stream)
            table.writerow(f"{name} [{unit}]" if unit else name for name, unit in units.items())
            for row in zip(*(series[name] for name in units), strict=True):
                table.writerow(map(plain, row))
        note(f"wrote {self.out}")

    def draw(self, figure: Any) -> None:
        """Write a figure of matplotlib."""
        assert self.plot is not None
        with whole_file(self.plot) as draft:
            figure.savefig(draft)
        note(f"wrote {self.plot}")


def targets(arguments: argparse.Namespace, suffixes: tuple[str, ...] = (".csv",)) -> Targets:
    """Return the files that ``add_targets`` lets one ask for, checked before any work is done.

    ``suffixes``: endings of tables.
    """
    out, plot = getattr(arguments, "out", None), getattr(arguments, "plot", None)
    return Targets(
        check_file(out, "--out", suffixes) if out else None,
        _check_plot(plot) if plot else None,
    )


def _check_plot(path: str) -> Path:
    """Return the path of a picture if it can be written; no folder is made for it."""
    folder = Path(path).parent
    if not folder.is_dir():
        raise ParameterError(f"--plot {path}: there is no folder {folder}; make it first")
    return check_file(path, "--plot", PLOT_SUFFIXES)


def check_file(path: str, option: str, suffixes: tuple[str, ...] = ()) -> Path:
    """Return the path if a file can be written there, before any work is done."""
    target = Path(path)
    if suffixes and target.suffix.lower() not in suffixes:
        *others, last = suffixes
        words = f"{', '.join(others)} or {last}" if others else last
        raise ParameterError(f"{option} {path}: allowed: a file name ending in {words}")
    if target.is_dir():
        raise ParameterError(f"{option} {path}: is a folder, the name of a file is required")
    check_folder(str(target.parent), option)
    return target


def new_part(path: str) -> Path:
    """Return the path of a part file to write, checked; one that exists is refused."""
    target = check_file(path, "--out", (".toml",))
    if target.exists():
        raise ParameterError(f"--out {target}: exists, and a part file is never overwritten")
    return target


def check_folder(path: str, option: str) -> Path:
    """Return the folder if files can be written there; leave no trace of the test."""
    if not path.strip():
        raise ParameterError(f"{option} {path!r}: the name of a folder is required")
    folder = Path(path).absolute()
    if folder.exists() and not folder.is_dir():
        raise ParameterError(f"{option} {path}: is a file, a folder is required")
    import tempfile  # late: `--help` needs none

    try:
        with new_folder(folder, stays=False), tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = error.strerror or str(error)
        raise ParameterError(f"{option} {path}: cannot be written ({reason})") from None
    return Path(path)
