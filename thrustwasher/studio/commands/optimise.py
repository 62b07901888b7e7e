"""``thrustwasher optimise``: the best part, load curve or gear shift under limits, or a front."""

import argparse
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...cli.common import _options, _output
from ...errors import ParameterError
from ...settings import split_settings
from ...storage.whole_files import new_folder
from . import _reducer_report
from ._study_target import add_part_options, read_target

if TYPE_CHECKING:
    from ..optimisation.optimum import Optimum

HELP = "find the best design of a part or a shift under limits"
EXAMPLES = (
    'thrustwasher optimise washer --vary "roughness=0.3 um:1 um" --minimise '
    'friction_torque --limit "film_ratio>=3" --load 300 --speed "9100 rpm"',
    "thrustwasher optimise clutch --figures",
)
FOLDER, PICTURE = "optimum", "optimum.png"
VALUES = 'NAME=low:high, e.g. roughness="0.3 um:1 um" or pressure.clutch.points.3="250 kPa:350 kPa"'
OPTIONS = {
    "--vary NAME=low:high ...": "what is varied: a parameter or input, of a scene the path of a "
    'number, e.g. "roughness=0.3 um:1 um", "pressure.clutch.points.3=250 kPa:350 kPa"',
    "--minimise FIGURE ...": "what is to be small; two figures in all make a front",
    "--maximise FIGURE ...": "what is to be large; of a washer film_lost_load too, the load at "
    "which it loses its film",
    "--limit LIMIT ...": '"FIGURE<=VALUE" or "FIGURE>=VALUE", in quotes',
    "--robust SHARE": "share of the draws of [scatter] that are to meet all limits, e.g. 0.95",
    "--points N": "designs of a front; default 20",
    "--seed N": "of the sample; default 1",
    "--figures": "list the figures of the target, and stop",
    "--out DIR": f"folder for best.toml, front.csv, files of the front and a picture, default "
    f"{FOLDER}; stopped, the same command resumes",
    "--json": "one JSON object instead of a table",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    what = "a part file or a scene (.toml, built-in), or a model"
    _options.add_subject(parser, "target", "TARGET", what, asked=True)
    _options.add(parser, OPTIONS)
    parser.set_defaults(out=FOLDER)
    parser.add_argument("--report", metavar="FILE", help=_reducer_report.HELP)
    _options.add_workers(parser, "processes; default: one per core where they pay, 1: none")
    add_part_options(parser)


def run(arguments: argparse.Namespace) -> int:
    """Search, say what was found, write its files."""
    target, at = read_target(arguments)
    if arguments.figures:
        return _list_figures(target, at, arguments.reached)
    report = _reducer_report.target(arguments.report)
    if report and getattr(getattr(target, "spec", None), "key", "") != "train":
        raise ParameterError(f"--report {report}: allowed: of a gear train")
    vary = split_settings(arguments.vary, "--vary", VALUES)
    robust = _share(arguments.robust)
    points = _whole(arguments, "points", 20)
    seed = _whole(arguments, "seed", 1)
    folder = _output.check_folder(arguments.out, "--out")

    from ..optimisation.whole_search import JOURNAL, optimise

    journal = folder / JOURNAL
    tried, show = "the designs that were tried", _output.time_left("optimise:")
    with _output.going_on(arguments, journal, show, tried) as progress:
        with new_folder(folder):
            found = optimise(
                target,
                vary={name: _ends(text) for name, text in vary.items()},
                minimise=arguments.minimise,
                maximise=arguments.maximise,
                limits=arguments.limit,
                robust=robust,
                points=points,
                seed=seed,
                at=at,
                reached=arguments.reached,
                workers=arguments.workers,
                out=folder,
                progress=progress,
                finish=_draw,
            )
    _output.warn(found.warnings)
    if report:
        _write_report(report, target, at or {}, found)
    if arguments.json:
        _output.print_json({**found.to_dict(), "out": str(folder)})
    else:
        say(found, folder)
    return 0


def _write_report(report: Path, part: Any, at: Any, found: "Optimum") -> None:
    """Write the report of the best design of a gear train."""
    from ..evaluators.make import inputs_of

    params, inputs = part.varied(found.best.values)
    values = {f.name: getattr(params, f.name) for f in fields(params)}
    best = replace(part, parameters=values)
    _reducer_report.write(report, best, [inputs_of(part, at) | inputs], optimum=found)


def _ends(text: str) -> str:
    return text.strip().strip("\"'")


def _whole(arguments: argparse.Namespace, name: str, default: int) -> int:
    text = getattr(arguments, name)
    if text is None:
        return default
    if not text.strip().isdecimal() or len(text) > 12:
        raise ParameterError(f"--{name} {text}: allowed: a whole number")
    return int(text)


def _share(text: str | None) -> float | None:
    if text is None:
        return None
    try:
        return float(text)
    except ValueError:
        raise ParameterError(f"--robust {text}: allowed: a number, e.g. 0.95") from None


def _list_figures(target: Any, at: Any, reached: str) -> int:
    from ..optimisation.designs import figures_to_search
    from ..optimisation.whole_search import designs_of

    for name, figure in figures_to_search(designs_of(target, at or {}, reached)).items():
        unit = "" if figure.unit == "1" else f" [{figure.unit}]"
        print(f"{name}{unit}: {figure.help}")
    return 0


def _draw(found: "Optimum", folder: Path) -> None:
    from ..report.model_plots.optimum_plot import optimum_figure

    optimum_figure(found).savefig(folder / PICTURE)


def say(found: "Optimum", folder: Path) -> None:
    """Print the best design, the front, what binds, and where the files are."""
    from ..optimisation.design_problem import shown

    problem = found.problem
    wanted = " and ".join(g.words for g in problem.goals)
    print(f"{found.target}: {wanted}, {found.tries} designs tried in {found.wall_time:.3g} s")
    for note in found.notes:
        print(f"  {note}")
    for figure in problem.every_figure:
        value = shown(figure, found.best.figures[figure.name])
        print(f"  {figure.name} = {value} (was {found.before(figure)})")
    for v in problem.variables:
        print(f"  {v.name} = {v.text(found.best.values[v.name])}")
    if found.front:
        first, second = (g.figure for g in problem.goals)
        print(f"Front of {len(found.front)} designs: {first.name}, {second.name}")
        for number, d in enumerate(found.front, 1):
            cells = (shown(f, d.figures[f.name]) for f in (first, second))
            print(f"  {number:2}  {'  '.join(f'{cell:>14}' for cell in cells)}")
    if found.binding:
        print(f"What binds: {', '.join(found.binding)}")
    if found.share:
        s = found.share
        print(
            f"{100.0 * s.value:.3g} % of {s.draws} fresh draws meet the limits, between "
            f"{100.0 * s.low:.3g} and {100.0 * s.high:.3g} %"
        )
    print(f"Files: {folder / 'best.toml'}, {folder / PICTURE}")
