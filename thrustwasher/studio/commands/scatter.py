"""``thrustwasher scatter``: uncertainty of the figures of a part or a gear shift."""

import argparse
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...cli.common import _options, _output
from ...errors import ParameterError
from ...model.part_file import SUFFIX
from ...model.registry import models_with_points
from ...shown import text_of
from ...storage.whole_files import new_folder
from ._study_target import add_part_options, read_target

if TYPE_CHECKING:
    from ..scatter.result import Band, Index, ScatterResult

HELP = "uncertainty of results: the scatter of inputs, and what decides it"
EXAMPLES = (
    "thrustwasher scatter clutch --load 3000 --speed 10 --runs 64 --no-indices",
    'thrustwasher scatter washer --load 300 --speed "9100 rpm"',
)
LEAST = 0.02  # a total index below decides nothing
FOLDER, PAGE = "scatter-{}", "scatter.html"  # of a target
DECIDED = "decided by (total index)"
NEAREST = "# thrustwasher scatter: "  # first line of the file of a run, with the file's name
OPTIONS = {
    "--runs N": "base points, rounded up to a power of two; default 1024, of a scene 256",
    "--seed N": "of the sample; default 1",
    "--outputs LIST": "figures and signals to keep, names with commas; default: all",
    "--files": "also write the runs nearest to quantiles of the figures as files to open",
    "--no-indices": "leave out what decides each figure (Sobol' indices): runs / (2 + sources)",
    "--out DIR": "folder for scatter.html and tables, default scatter-TARGET; stopped, the "
    "same command resumes",
    "--cluster ADDRESS": "Dask scheduler, e.g. tcp://10.0.0.1:8786, instead of processes",
    "--json": "one JSON object instead of a table",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(models_with_points())
    what = f"a part file or a scene (.toml, built-in), {models}"
    _options.add_subject(parser, "target", "TARGET", what, asked=True)
    _options.add(parser, OPTIONS)
    parser.add_argument("--indices", choices=["all"], help="all: of a scene's costly figures too")
    add_part_options(parser)
    _options.add_workers(parser, "processes; default: one per core, 1: none")


def run(arguments: argparse.Namespace) -> int:
    """Study the target, say what came out, write its files."""
    if arguments.no_indices and arguments.indices:
        raise ParameterError("--indices all: together with --no-indices, allowed: one of them")
    from ..scatter.design import LEAST_RUNS, MOST_RUNS, MOST_SEED

    runs = _whole(arguments, "runs", LEAST_RUNS, MOST_RUNS)
    seed = _whole(arguments, "seed", 0, MOST_SEED)
    target, at = read_target(arguments)
    file = Path(arguments.target)
    own = file.stem if file.suffix == SUFFIX else arguments.target
    folder = _output.check_folder(
        FOLDER.format(own) if arguments.out is None else arguments.out, "--out"
    )
    if file.resolve().parent == folder.resolve() and _is_nearest(file):
        raise ParameterError(
            f"--out {folder}: {file.name} is there, which the study would replace; choose another "
            "folder"
        )

    from ..scatter.propagate import propagate

    with new_folder(folder), kept_runs(folder, arguments) as progress:
        result = propagate(
            target,
            runs=runs,
            seed=1 if seed is None else seed,
            outputs=_names(arguments.outputs),
            indices=False if arguments.no_indices else arguments.indices or True,
            reached=arguments.reached,
            at=at,
            workers=arguments.workers,
            cluster=arguments.cluster,
            out=folder,
            progress=progress,
            finish=lambda result: write_files(result, target, at, folder, arguments.files),
        )
    _output.warn(result.warnings)
    if arguments.json:
        _output.print_json({**result.to_dict(), "out": str(folder)})
    else:
        say(result, folder)
    return 0


def _whole(arguments: argparse.Namespace, name: str, low: int, high: int) -> int | None:
    """Return the whole number of an option, in its range."""
    text = getattr(arguments, name)
    if text is None:
        return None
    number = int(text) if text.strip().isdecimal() and len(text) <= 12 else -1
    if not low <= number <= high:
        raise ParameterError(f"--{name} {text}: allowed: a whole number {low} .. {high}")
    return number


def _names(text: str | None) -> list[str] | None:
    return None if text is None else [name.strip() for name in text.split(",") if name.strip()]


@contextmanager
def kept_runs(
    folder: Path | None, arguments: argparse.Namespace
) -> Iterator[Callable[[int, int], None]]:
    """Give what shows the progress; if the study stops, say that its journal keeps the runs."""
    from ..scatter.propagate import JOURNAL

    journal = folder and folder / JOURNAL
    kept = "{done} of {total} runs"
    with _output.going_on(arguments, journal, _progress(), kept) as progress:
        yield progress


def _progress() -> Callable[[int, int], None]:
    """Return what says how many runs there are, then how long they take, then shows them pass."""
    show, began, first, told = _output.time_left("scatter:"), 0.0, -1, False

    def progress(done: int, total: int) -> None:
        nonlocal began, first, told
        if first < 0:
            began, first = time.perf_counter(), done
            kept = f", {done} of them done before" if done else ""
            _output.note(f"scatter: {total} runs{kept}")
        elif not told and done < total:
            told = True
            pace = (time.perf_counter() - began) / (done - first)
            _output.note(f"scatter: about {_output.duration(pace * (total - done))} on one core")
        show(done, total)

    return progress


def write_files(
    result: "ScatterResult", target: Any, at: Any, folder: Path, nearest: bool = True
) -> None:
    """Write the page; also the runs ``nearest`` to quantiles of its figures as files to open.

    Files of an earlier study of which this one has none go.
    """
    from ..evaluators.make import evaluator
    from ..report.html import render
    from ..report.scatter import scatter_page
    from ..report.scatter.study_page import MOST_FIGURES, main_figures
    from ..scatter.result import SERIES

    files: dict[str, dict[float, str]] = {}
    made = evaluator(target, at=at)
    with _output.whole_folder(folder) as draft:
        for name in main_figures(result, MOST_FIGURES) if nearest else ():
            for level, values in result.nearest.get(name, {}).items():
                text = made.file(values, draw=True)
                file = f"{name}-{100.0 * level:02.0f}.toml"
                (draft / file).write_text(f"{NEAREST}{file}\n{text}", encoding="utf-8")
                files.setdefault(name, {})[level] = file
        page = render(scatter_page(result, files))
        (draft / PAGE).write_text(page, encoding="utf-8")
    written = {file for by_level in files.values() for file in by_level.values()}
    for path in folder.glob("*.toml"):
        if path.name not in written and _is_nearest(path):
            path.unlink()
    if not result.series and _first_line(folder / SERIES).startswith("time [s],"):
        (folder / SERIES).unlink()


def _is_nearest(path: Path) -> bool:
    """Tell if a file is one that a study wrote under this name."""
    return _first_line(path) == f"{NEAREST}{path.name}\n"


def _first_line(path: Path) -> str:
    """Return the first line of a file, nothing of what cannot be read."""
    try:
        with path.open(encoding="utf-8", errors="replace") as stream:
            return stream.readline(1000)
    except OSError:
        return ""


def say(result: "ScatterResult", folder: Path | None) -> None:
    """Print the bands, what decides them, probabilities, and where the files are."""
    from ..report.scatter.study_page import LEADING

    failed = sum(result.failed.values())
    print(
        f"{result.target}: {result.runs} base points, {result.solves} runs"
        + (f", {failed} failed" if failed else "")
    )
    for note in result.notes:
        print(f"  {note}")
    spread = ("deviation", "by gradient")
    heads = ("figure", "nominal", "5 %", "50 %", "95 %", *spread, "outside", DECIDED)
    first = [name for name in LEADING if name in result.figures and result.model == "train"]
    rows: list[tuple[str, ...]] = [heads]
    for name in dict.fromkeys((*first, *result.figures)):
        band = result.figures[name]
        rows.append(_lost_row(band) if first and name == "efficiency" else _row(name, band))
    widths = [max(len(row[i]) for row in rows) for i in range(len(heads) - 1)]
    for name, *numbers, decided in rows:
        cells = (f"{x:>{w}}" for x, w in zip(numbers, widths[1:], strict=True))
        print(f"  {name:<{widths[0]}}  {'  '.join(cells)}  {decided}".rstrip())
    for name, p in result.probabilities.items():
        print(f"  P({name}) = {p.value:.3g}, between {p.low:.2g} and {p.high:.2g}")
    if folder:
        print(f"Report: {folder / PAGE}")


def _row(name: str, band: "Band") -> tuple[str, ...]:
    values = (band.nominal, *band.quantiles.values())
    linear = float("nan") if band.linear_deviation is None else band.linear_deviation
    shown = [*((x, band.relative) for x in values), (band.standard_deviation, True), (linear, True)]
    cells = (
        text_of(x, band.unit, difference, digits=3) if x == x else "-" for x, difference in shown
    )
    known = [(i.total, n) for n, i in band.indices.items() if _is_sure(i)]
    decided = ", ".join(f"{n} {total:.2f}" for total, n in sorted(known, reverse=True)[:3])
    outside = f"{100.0 * band.outside.value:.3g} %" if band.outside else ""
    return (name, *cells, outside, decided)


def _lost_row(band: "Band") -> tuple[str, ...]:
    """Return the row of an efficiency as the part of the power in that is lost."""
    row = _row("lost of the power in", band)
    values = (band.nominal, *reversed(band.quantiles.values()))
    lost = [f"{100.0 * (1.0 - x):.3g} %" if x > 0.0 else "-" for x in values]
    linear = band.linear_deviation
    spread = [band.standard_deviation, float("nan") if linear is None else linear]
    apart = [f"{100.0 * x:.2g} %" if x == x else "-" for x in spread]
    return (row[0], *lost, *apart, *row[1 + len(lost) + len(apart) :])


def _is_sure(index: "Index") -> bool:
    """Tell if an index is large enough, and larger than what is not known of it."""
    if index.total is None or index.total_confidence is None:
        return False
    return index.total > max(LEAST, index.total_confidence)
