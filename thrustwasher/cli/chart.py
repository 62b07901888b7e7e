"""``thrustwasher chart``: measure speed against accuracy on this machine, and draw it."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from pathlib import Path
from typing import Any

from ..errors import ParameterError
from . import _output

HELP = "measure error and cost of every way to solve the models here, and draw the charts"
FOLDER = "charts"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "--out", metavar="DIR", default=FOLDER,
        help=f"folder for chart.json, chart.html, chart.md and the drawings; default {FOLDER}",
    )  # fmt: skip
    parser.add_argument(
        "--quick", action="store_true",
        help="few cases and repeats: minutes become half a minute, and the numbers a first look",
    )  # fmt: skip
    parser.add_argument(
        "--draw", metavar="FILE.json", help="measure nothing, draw what an earlier run measured"
    )


def run(arguments: argparse.Namespace) -> int:
    """Measure, then write the record and what is drawn from it."""
    folder = _output.check_folder(arguments.out, "--out")
    if arguments.draw:
        record = _read(arguments.draw)
    else:
        from ..fidelity.record import pin_threads

        pin_threads()
        command = "thrustwasher chart" + (" --quick" if arguments.quick else "")
        record = _measured(command, quick=arguments.quick)
    _write(record, folder)
    _output.note(f"wrote {folder / 'chart.html'}, chart.md, chart.json and the drawings")
    return 0


def _measured(command: str, *, quick: bool) -> dict[str, Any]:
    """Return everything that is measured, as JSON types."""
    from ..fidelity.record import surroundings
    from ..fidelity.stability import stability
    from ..fidelity.survey import MODELS, survey

    began = time.perf_counter()
    record = {**surroundings(command), "quick": quick, "models": {}}
    load, cores = record["machine"]["load"], record["machine"]["cores"]
    if load is not None and load > 0.5 * cores:
        _output.note(f"the machine is busy (load {load} on {cores} cores): ratios may be compared")
    for model in MODELS:
        record["models"][model] = survey(model, quick=quick, progress=_say)
    record["macro_steps"] = _macro_steps(quick=quick)
    record["stability"] = stability(quick=quick, progress=_say)
    record["run_s"] = time.perf_counter() - began
    return record


def _macro_steps(*, quick: bool) -> dict[str, Any]:
    """Return the study of a shift, its parts stepped in this process."""
    from ..drivetrain.macro_steps import study
    from ..fmu.direct import DirectInstance

    def make(scene: Any) -> dict[str, Any]:
        return {
            name: DirectInstance(part.spec, parameters=part.parameters())
            for name, part in scene.parts.items()
        }

    return study(make, quick=quick, progress=_say)


def _say(what: str) -> None:
    if sys.stderr.isatty():
        _output.note(what)


def _read(path: str) -> dict[str, Any]:
    """Return the record of an earlier run."""
    from ..fidelity.record import SCHEMA

    try:
        record = json.loads(Path(path).read_text("utf-8"))
        known = record["schema"] == SCHEMA
    except (ValueError, KeyError, TypeError):
        known = False
    if not known:
        raise ParameterError(f"--draw {path}: is no chart.json of this version")
    return dict(record)


def _write(record: dict[str, Any], folder: Path) -> None:
    """Write record, page and drawings; all of them or none."""
    os.environ.setdefault("MPLBACKEND", "Agg")
    from ..fidelity.pareto import front
    from ..report.chart_page import html, markdown, page_of, save_drawings

    fronts = {
        model: {q["name"]: front(s["samples"], q["name"]) for q in s["quantities"]}
        for model, s in record["models"].items()
    }
    if "macro_steps" in record:
        steps = record["macro_steps"]
        fronts["macro_steps"] = {
            q["name"]: front(steps["samples"], q["name"]) for q in steps["quantities"]
        }
    page = page_of(record, fronts)
    with _output.whole_folder(folder) as draft:
        (draft / "chart.json").write_text(json.dumps(record, indent=1, allow_nan=False), "utf-8")
        (draft / "chart.md").write_text(markdown(page), "utf-8")
        (draft / "chart.html").write_text(html(page), "utf-8")
        save_drawings(page, draft)
