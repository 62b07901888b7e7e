"""``thrustwasher shift --compare A B``: two shifts on one page."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...errors import ParameterError
from . import _output

PAGE = "compare.html"
Step = Callable[[argparse.Namespace, Any], Any]


def run(arguments: argparse.Namespace, load: Step, simulate: Step) -> int:
    """Run what is a scene, read what is a folder, write the page.

    ``load`` gives the scene of a name, ``simulate`` its result.
    """
    for option in ("scene", "ssp", "no_report", "fmi", "platforms", "scatter"):
        if getattr(arguments, option):
            raise ParameterError(f"--compare: not together with --{option.replace('_', '-')}")
    folder = _output.check_folder(arguments.out, "--out")
    given = [
        _read(n) if Path(n).is_dir() else _scene(arguments, n, load) for n in arguments.compare
    ]
    for scene in given:
        if not isinstance(scene, tuple) and scene.sequence:
            raise ParameterError(f"--compare {scene.name}: has several shifts, allowed: one each")
    found = [one if isinstance(one, tuple) else _run_of(simulate(arguments, one)) for one in given]

    from ...report.html import render
    from ...report.shift.comparison import NAMES, comparison_page, difference_table

    runs = [run for run, _ in found]
    page = render(comparison_page(runs, [picture for _, picture in found]))
    with _output.whole_folder(folder) as draft:
        (draft / PAGE).write_text(page, encoding="utf-8")
    warnings = [
        f"{n}: {text}" for n, run in zip(NAMES, runs, strict=True) for text in run["warnings"]
    ]
    _output.warn(warnings)
    if arguments.json:
        names = ("title", "figures", "events", "phases", "warnings")
        a, b = ({name: run[name] for name in names} for run in runs)
        _output.print_json({"a": a, "b": b, "warnings": warnings, "out": str(folder)})
        return 0
    for text, *values in difference_table(runs).rows:
        print(f"{text}: A {values[0] or '-'}, B {values[1] or '-'}")
    print(f"Report: {folder / PAGE}")
    return 0


def _scene(arguments: argparse.Namespace, name: str, load: Step) -> Any:
    """Return the scene of a name that is no folder."""
    try:
        return load(arguments, name)
    except ParameterError as problem:
        raise ParameterError(f"--compare {name}: is no folder; as a scene: {problem}") from None


def _read(name: str) -> tuple[Any, Any]:
    """Return the run and the picture that a report's folder holds."""
    from ...report.shift.shift_data import read_run

    folder = Path(name)
    if not (folder / "report.html").is_file():
        raise ParameterError(f"--compare {name}: the folder has no report.html")
    run = read_run(folder / "report.html")
    run["settings"] = {"from": f"folder {name}", **run["settings"]}
    try:
        return run, (folder / "overview.png").read_bytes()
    except OSError as problem:
        raise ParameterError(f"--compare {name}: overview.png: {problem.strerror}") from None


def _run_of(result: Any) -> tuple[Any, Any]:
    """Return the run of a finished shift and its picture."""
    from ...report.shift.overview_plot import overview_figure
    from ...report.shift.shift_data import run_data
    from ...report.shift.shift_record import record_of

    record = record_of(result)
    run = run_data(record, {})
    run["settings"] = {"from": f"scene {record.name}", **run["settings"]}
    return run, overview_figure(record)
