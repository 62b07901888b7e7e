"""``thrustwasher chart``: measure speed against accuracy on this machine, and draw it."""

from __future__ import annotations

import argparse
import json
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
        "--only", choices=("stability",),
        help="measure this part alone: where methods fail, and the limits of coupling, as "
        "stability.md beside the chart's page; with --out FILE.md that page alone",
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
    if arguments.only:
        return _stability_alone(arguments)
    folder = _output.check_folder(arguments.out, "--out")
    if arguments.draw:
        record = _read(arguments.draw)
    else:
        from ..fidelity.surroundings import pin_threads

        pin_threads()
        command = "thrustwasher chart" + (" --quick" if arguments.quick else "")
        record = _measured(command, quick=arguments.quick)
    try:
        _write(record, folder)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as problem:
        if not arguments.draw:
            raise
        raise ParameterError(
            f"--draw {arguments.draw}: is no whole chart.json ({type(problem).__name__}: {problem})"
        ) from None
    _output.note(f"wrote {folder / 'chart.html'}, chart.md, chart.json and the drawings")
    return 0


def _stability_alone(arguments: argparse.Namespace) -> int:
    """Measure and write where methods fail, nothing else."""
    if arguments.draw:
        raise ParameterError("--only: not together with --draw, which draws what was measured")
    alone = Path(arguments.out).suffix.lower() == ".md"
    check = _output.check_file if alone else _output.check_folder
    target = check(arguments.out, "--out")
    from ..fidelity.surroundings import pin_threads, surroundings

    pin_threads()
    command = "thrustwasher chart --only stability" + (" --quick" if arguments.quick else "")
    began = time.perf_counter()
    record = {**surroundings(command), "quick": arguments.quick, "models": {}}
    record |= _stability(quick=arguments.quick)
    record["run_s"] = time.perf_counter() - began
    from ..report.stability_page import stability_markdown

    page = stability_markdown(record)
    if alone:
        with _output.whole_file(target) as draft:
            draft.write_text(page, "utf-8")
        _output.note(f"wrote {target}")
        return 0
    _write(record, target, page)
    _output.note(f"wrote {target / 'stability.md'}, chart.html, chart.md, chart.json, a drawing")
    return 0


def _stability(*, quick: bool) -> dict[str, Any]:
    """Return the stability map with the masters of the driveline, and the limits of coupling."""
    from ..drivetrain.macro_steps import masters
    from ..fidelity.coupling_limits import as_rows, limits
    from ..fidelity.failure_map import stability

    more = (("masters of a shift", lambda: masters(_instances)),)
    groups = stability(quick=quick, progress=_say, more=more)
    _say("limits of coupling")
    return {"stability": groups, "limits": as_rows(limits())}


def _instances(scene: Any) -> dict[str, Any]:
    """Return an instance in this process for each part of a scene."""
    from ..fmu.direct import DirectInstance

    return {
        name: DirectInstance(part.spec, parameters=part.parameters())
        for name, part in scene.parts.items()
    }


def _measured(command: str, *, quick: bool) -> dict[str, Any]:
    """Return everything that is measured, as JSON types."""
    from ..fidelity.models import MODELS
    from ..fidelity.surroundings import surroundings
    from ..fidelity.work_precision import work_precision

    began = time.perf_counter()
    record = {**surroundings(command), "quick": quick, "models": {}}
    load, cores = record["machine"]["load"], record["machine"]["cores"]
    if load is not None and load > 0.5 * cores:
        _output.note(f"the machine is busy (load {load} on {cores} cores): ratios may be compared")
    for model in MODELS:
        record["models"][model] = work_precision(model, quick=quick, progress=_say)
    record["macro_steps"] = _macro_steps(quick=quick)
    record |= _stability(quick=quick)
    record["run_s"] = time.perf_counter() - began
    return record


def _macro_steps(*, quick: bool) -> dict[str, Any]:
    """Return the study of a shift, its parts stepped in this process."""
    from ..drivetrain.macro_steps import study

    return study(_instances, quick=quick, progress=_say)


def _say(what: str) -> None:
    if sys.stderr.isatty():
        _output.note(what)


def _read(path: str) -> dict[str, Any]:
    """Return the record of an earlier run."""
    from ..fidelity.surroundings import SCHEMA
    from ..store.digests import is_broken

    try:
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
    from ..fidelity.pareto import front
    from ..report.chart_page import markdown, page_of
    from ..report.html import render, save_plots
    from ..store.digests import sealed

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
        (draft / "chart.json").write_text(
            json.dumps(sealed(record), indent=1, allow_nan=False), "utf-8"
        )
        (draft / "chart.md").write_text(markdown(page), "utf-8")
        (draft / "chart.html").write_text(render(page), "utf-8")
        if extra:
            (draft / "stability.md").write_text(extra, "utf-8")
        save_plots(page, draft)
