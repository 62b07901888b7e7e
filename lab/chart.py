"""``python -m lab.chart``: measure speed against accuracy on this machine, and draw it."""

import argparse
import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from thrustwasher.cli import main_of
from thrustwasher.cli.common import _options, _output
from thrustwasher.errors import ParameterError, refuse_pipe

HELP = "measure error and cost of every way to solve the models here, and draw the charts"
OPTIONS = {
    "--out DIR": "folder for chart.json, chart.html, chart.md and the drawings; default charts",
    "--quick": "few cases and repeats: minutes become half a minute, and the numbers a first look",
    "--draw FILE.json": "measure nothing, draw what an earlier run measured",
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; return its exit status."""
    return main_of(sys.modules[__name__], "python -m lab.chart", argv)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "--only",
        choices=["stability"],
        help="measure nothing, draw this part alone: where methods fail, and the limits of "
        "coupling, as stability.md next to the chart's page; with --out FILE.md that page "
        "alone",
    )
    _options.add(parser, OPTIONS)
    parser.set_defaults(out="charts")


def run(arguments: argparse.Namespace) -> int:
    """Measure, then write the record and what is drawn from it."""
    if arguments.only and arguments.draw:
        raise ParameterError("--only: not together with --draw, which draws what was measured")
    alone = arguments.only and Path(arguments.out).suffix.lower() == ".md"
    target = (_output.check_file if alone else _output.check_folder)(arguments.out, "--out")
    if arguments.only:
        from lab.charts.chart_page import same_everywhere, stability_markdown

        record = same_everywhere()
        page = stability_markdown(record)
    else:
        record = _read(arguments.draw) if arguments.draw else _measured(arguments.quick)
        page = ""
    if alone:
        _output.write_text(target, page)
        _output.note(f"wrote {target}")
        return 0
    try:
        _write(record, target, page)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as problem:
        if not arguments.draw:
            raise
        raise ParameterError(
            f"--draw {arguments.draw}: is no whole chart.json ({type(problem).__name__}: {problem})"
        ) from None
    if arguments.only:
        files = f"{target / 'stability.md'}, chart.html, chart.md, chart.json, a drawing"
    else:
        files = f"{target / 'chart.html'}, chart.md, chart.json and the drawings"
    _output.note(f"wrote {files}")
    return 0


def _measured(quick: bool) -> dict[str, Any]:
    """Return everything that is measured, as JSON types."""
    from lab.charts.surroundings import pin_threads, surroundings

    pin_threads()  # before numpy is loaded
    from lab.charts.chart_page import same_everywhere
    from lab.charts.work_precision import work_precision
    from lab.macro_steps import study
    from thrustwasher.model.registry import models_with_error_tables

    began = time.perf_counter()
    record = surroundings(f"python -m lab.chart{' --quick' if quick else ''}")
    record |= {"quick": quick, "models": {}}
    load, cores = record["machine"]["load"], record["machine"]["cores"]
    if load is not None and load > 0.5 * cores:
        _output.note(f"the machine is busy (load {load} on {cores} cores): ratios may be compared")
    for model in models_with_error_tables():
        record["models"][model] = work_precision(model, quick=quick, progress=_say)
    record["macro_steps"] = study(quick=quick, progress=_say)
    record |= {n: same_everywhere()[n] for n in ("corrections", "stability", "limits")}
    record["run_s"] = time.perf_counter() - began
    return record


def _say(what: str) -> None:
    if sys.stderr.isatty():
        _output.note(what)


def _read(path: str) -> dict[str, Any]:
    """Return the record of an earlier run."""
    from lab.charts.surroundings import SCHEMA
    from thrustwasher.storage.digests import is_broken

    try:
        refuse_pipe(path)
        record = json.loads(Path(path).read_text("utf-8"))
        known = record["schema"] == SCHEMA
    except (ValueError, KeyError, TypeError, RecursionError):
        known = False
    if not known:
        raise ParameterError(f"--draw {path}: is no chart.json of this version")
    if is_broken(record):
        raise ParameterError(f"--draw {path}: was changed since it was measured (check)")
    return dict(record)


def _write(record: dict[str, Any], folder: Path, extra: str = "") -> None:
    """Write record, page and drawings; all of them or none. ``extra``: text of stability.md."""
    from lab.charts.chart_page import markdown, page_of
    from lab.charts.chart_text import front
    from thrustwasher.storage.digests import sealed
    from thrustwasher.studio.report.html import render, save_plots

    studies = dict(record["models"])
    if "macro_steps" in record:
        studies["macro_steps"] = record["macro_steps"]
    fronts = {
        name: {q["name"]: front(s["samples"], q["name"]) for q in s["quantities"]}
        for name, s in studies.items()
    }
    page = page_of(record, fronts)
    with _output.whole_folder(folder) as draft:
        texts = {"chart.md": markdown(page), "chart.html": render(page), "stability.md": extra}
        texts["chart.json"] = json.dumps(sealed(record), indent=1, allow_nan=False)
        for name, text in texts.items():
            if text:
                (draft / name).write_text(text, "utf-8")
        save_plots(page, draft)


if __name__ == "__main__":
    sys.exit(main())
