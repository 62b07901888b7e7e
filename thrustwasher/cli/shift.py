"""``thrustwasher shift``: the main job, a gear shift of FMUs with its report."""

import argparse
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from threading import Thread
from typing import Any

from ..errors import ParameterError
from ..plugins import called
from ..units import parse_quantity
from .build import chosen_platforms
from .common import _options, _output
from .common._solve import print_ranking

HELP = "run a gear shift as co-simulation of FMUs and write its report"
EXAMPLES = (
    "thrustwasher shift",
    "thrustwasher shift --scene msl --out msl-report",
)
OF_A_RUN = (
    *("scene", "compare", "no_report", "step", "master", "master_tolerance", "fidelity"),
    *("no_guard", "ssp", "fmi", "platforms", "plain", "settings", "oil", "scatter"),
    "sensitivities",
)
REPORT, FOLDER = "report.html", "shift-report"
FMI = ("2", "3")  # versions of a package's FMUs
RUNS, STUDY = "256", "scatter"  # base points of a study, its folder in that of the report
OPTIONS = {
    "--list": "list the built-in scenes with their titles, and stop",
    "--out DIR": "folder for report.html, overview.png and shift.csv; default shift-report",
    "--no-report": "write no files, only say what came out",
    "--step QUANTITY": "communication step [s], if not the scene's; up to a twentieth of the shift",
    "--master NAME": "gauss-seidel, jacobi or linearly-implicit, if not the scene's",
    "--fidelity [PART=]LEVEL ...": "a fidelity level for all parts that have it, or for "
    "one: field, "
    "washer=map; auto:0.01 chooses the cheapest that holds 1 %% and checks it after the run; may "
    "be repeated",
    "--no-guard": "do not check the run afterwards: neither its step, nor whether steady washers "
    "hold, nor fidelity levels that auto chose",
    "--ssp FILE.ssp": "write the shift as an SSP package for other tools, instead of running it",
    "--fmi N": "version of the package's FMUs, 2 or 3; default 2",
    "--platforms LIST": "of the package's FMUs: names with commas, all, or local; default: all "
    "that can be linked here",
    "--plain": "a package for hosts that know real and whole numbers only, as in `build`",
    "--json": "one JSON object with every number",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    what = "a built-in scene (planetary, brake-test, msl, ...) or a TOML file; default planetary"
    _options.add_subject(parser, "scene", "SCENE", what, asked=False)
    _options.add(parser, OPTIONS)
    _options.add_settings(
        parser,
        "of a package: change a parameter of a part or of the system, e.g. --set "
        "clutch.friction_scale=0.9; may be repeated",
    )
    parser.set_defaults(out=FOLDER)
    parser.add_argument(
        "--scatter",
        nargs="?",
        const=RUNS,
        metavar="N",
        help="then study the uncertainty of the figures: the scene's [scatter] through N shifts "
        f"(default {RUNS}) and as many per input, with bands in the report; stopped, the same "
        "command goes on with the study",
    )
    parser.add_argument(
        "--sensitivities",
        nargs="?",
        const="",
        metavar="PATHS",
        help="then rank what one percent more of numbers of the scene changes in lock-up, slip "
        "energy and jerk: paths with commas, as in [scatter]; default pressures and friction",
    )
    parser.add_argument("--master-tolerance", help=argparse.SUPPRESS)
    parser.add_argument("--compare", nargs="*", help=argparse.SUPPRESS)  # is gone
    parser.add_argument(
        "--fmu", choices=["native", "python"], default="native", help="kind of FMU; default native"
    )
    _options.add_oil(parser)


def run(arguments: argparse.Namespace) -> int:
    """Build what is missing, run the shift, write the report."""
    if arguments.list:
        _options.refuse_unused(arguments, "--list", OF_A_RUN, out=FOLDER, fmu="native")
        return _list(arguments.json)
    if arguments.compare is not None:
        raise ParameterError(
            "--compare is gone: thrustwasher explore SCENE writes a page that runs the scene, pins "
            "a run as A and lays others over it"
        )
    if arguments.no_report and arguments.out != FOLDER:
        raise ParameterError(f"--out {arguments.out}: --no-report writes no files; leave one out")
    from ..fmu.shell.platform_libraries import require_linker
    from ..shift.from_fmus import check_levels

    if arguments.fmu == "native" or arguments.ssp:
        require_linker()
    scene = _scene(arguments, arguments.scene or "planetary")
    if scene.sequence:
        if arguments.ssp:
            raise ParameterError(
                "--ssp: a package has one shift, allowed: a scene without [sequence]"
            )
        check_levels(scene)
    if arguments.ssp:
        return _export(arguments, scene)
    for option in ("fmi", "platforms", "plain", "settings"):
        if getattr(arguments, option):
            name = "set" if option == "settings" else option
            raise ParameterError(f"--{name}: for a package only (--ssp FILE.ssp)")
    runs = _scatter_runs(arguments, scene)
    if arguments.sensitivities is not None and (scene.sequence or arguments.fmu == "python"):
        raise ParameterError("--sensitivities: of one shift of native FMUs; leave it out")
    if arguments.sensitivities is not None:
        called("scene_sensitivities")  # before the run, if it is missing
    folder = None if arguments.no_report else _output.check_folder(arguments.out, "--out")
    report = called("write_report") if folder else None

    began = time.perf_counter()
    result, study = _simulate(arguments, scene), None

    def write(study: object) -> None:
        if folder and report:
            with _output.whole_folder(folder) as draft:
                report(result, study, draft)

    try:
        study = _study(arguments, result.scene, runs, folder, write) if runs else None
    finally:  # what stops the study leaves the shift
        if study is None:
            write(None)
    _output.warn([*result.warnings, *(study.warnings if study else ())])
    slopes = _slopes(result.scene, arguments.sensitivities)
    if arguments.json:
        total, out = time.perf_counter() - began, str(folder) if folder else None
        whole = replace(result, scatter=study) if study else result
        told = {**whole.to_dict(), "total_time": total, "out": out}
        _output.print_json(told | ({"sensitivities": slopes} if slopes else {}))
        return 0
    if scene.sequence:
        _say_sequence(result)
    else:
        _say(result, folder)
    if study:
        called("say_study")(study, folder and folder / STUDY)
    if slopes:
        _say_slopes(result, slopes)
    return 0


def _slopes(scene: object, paths: str | None) -> dict[str, dict[str, float | None]]:
    """Return the derivatives that are requested, {} if none are."""
    if paths is None:
        return {}
    names = [path.strip() for path in paths.split(",") if path.strip()]
    found: dict[str, dict[str, float | None]]
    found = called("scene_sensitivities")(scene, paths=names or None)
    return found


def _say_slopes(result: Any, slopes: dict[str, dict[str, float | None]]) -> None:
    """Print what one percent more changes, largest first, and what has no derivative."""
    from ..shift.scene.places import scene_places

    places = scene_places(result.scene)
    units = {f.name: f.unit for f in result.key_figures}
    ranking = {}
    for figure, row in slopes.items():
        known = {path: x for path, x in row.items() if x is not None}
        changes = {path: 0.01 * float(places[path].nominal) * x for path, x in known.items()}
        ordered = sorted(changes.items(), key=lambda item: -abs(item[1]))
        ranking[figure] = units[figure], dict(ordered)
    print_ranking(ranking)
    for figure, row in slopes.items():
        if corners := [path for path, x in row.items() if x is None]:
            print(f"  {figure} has a corner, and no derivative, over {', '.join(corners)}")


def _scatter_runs(arguments: argparse.Namespace, scene: object) -> int | None:
    """Return how many base points a study has, None without one; all that stops it is said here."""
    text = arguments.scatter
    if text is None:
        return None
    number = int(text) if text.strip().isdecimal() and len(text) < 12 else text
    runs: int = called("runs_of_study")(f"--scatter {text}", scene, number)
    if arguments.fmu == "python":
        raise ParameterError("--fmu python: a study runs native FMUs; leave out it or --scatter")
    return runs


def _study(
    arguments: argparse.Namespace,
    scene: object,
    runs: int,
    folder: Path | None,
    write: Callable[[Any], None],
) -> Any:
    """Return the study of a scene; its page and tables go to a folder of their own.

    ``write`` writes the report; the journal goes after all files.
    """
    out = folder and folder / STUDY

    def finish(study: object) -> None:
        if out:
            called("write_study")(study, scene, None, out)
        write(study)

    with called("kept_runs")(out, arguments) as progress:
        return called("propagate")(scene, runs=runs, out=out, progress=progress, finish=finish)


def _list(as_json: bool) -> int:
    """List the built-in scenes."""
    from ..shift import builtin_scenes, load_scene

    titles = {name: load_scene(name).title for name in builtin_scenes()}
    if as_json:
        _output.print_json({"scenes": titles})
    else:
        _output.print_rows([(name, title, "") for name, title in titles.items()])
    return 0


def _scene(arguments: argparse.Namespace, name: str) -> Any:
    """Return the scene of that name with what the options change."""
    from ..shift import load_scene, with_fidelities
    from ..shift.masters.master import FIXED_STEPS

    step = None if arguments.step is None else parse_quantity(arguments.step, "s", "step")
    if arguments.master_tolerance is not None:
        raise ParameterError(f"--master-tolerance: {FIXED_STEPS}")
    scene = load_scene(name, arguments.oil).with_options(step=step, master=arguments.master)
    return with_fidelities(scene, arguments.fidelity)


def _simulate(arguments: argparse.Namespace, scene: Any) -> Any:
    """Return the result of a scene of one shift or several."""
    from ..shift.from_fmus import run_scene

    progress = _output.time_left(scene.name) if sys.stderr.isatty() else None
    # Ctrl-C in an import may leave another one waiting for ever: what draws is loaded by a thread
    # that nobody waits for then, and this one imports nothing of it before that has ended.
    loader = Thread(target=lambda: called("load_report")(), daemon=True)
    with _fmu_instances(scene, arguments.fmu) as make:
        if not arguments.no_report:
            loader.start()
        keep = "figures" if arguments.no_report else "all"
        result = run_scene(scene, make, guard=not arguments.no_guard, progress=progress, keep=keep)
    if loader.is_alive():
        loader.join()
    return result


def _say(result: Any, folder: Path | None) -> None:
    """Print what happened in the shift, and where its report is."""
    from ..shift.account import summary
    from ..shift.account.shift_record import record_of
    from ..shift.account.what_happened import known_texts

    record = record_of(result)
    chosen = result.selection.words() if result.selection else []
    for text in [*chosen, *result.messages, *summary.sentences(record)]:
        print(text)
    for text in known_texts(record):
        print(text)
    missing = f"{record.energy['residual_share']:.1e} of {record.whole_name}"
    errs = f" Error of the step: {record.step_error.words()}." if record.step_error else ""
    print(f"Energy balance: {missing} is missing.{errs}")
    if folder:
        print(f"Report: {folder / REPORT}")
    if result.guard:
        print(f"Check: {result.guard.closing()}.")


def _say_sequence(result: Any) -> None:
    """Print a line per shift of a scene of several."""
    from ..shift.account import summary

    oil = result.oil_temperature - 273.15
    print(
        f"{result.scene.title}: {len(result.shifts)} shifts, oil {oil[0]:.1f} .. {oil[-1]:.1f} degC"
    )
    _output.print_rows(result.lines())
    for text in [*summary.step_words(result), *result.messages]:
        print(text)


def _fmu_instances(scene: Any, target: str) -> Any:
    """Give a function that makes an FMU instance of a part; all are freed in the end."""
    from ..shift.from_fmus import fmu_instances

    return fmu_instances(scene, target)


def _export(arguments: argparse.Namespace, scene: Any) -> int:
    """Write the shift as a package that any SSP master runs, and name it."""
    from ..shift.from_fmus import check_levels

    _options.refuse_unused(arguments, "--ssp", ("no_report", "no_guard", "scatter"), out=FOLDER)
    if arguments.fmu == "python":
        raise ParameterError("--fmu python: a package holds native FMUs only; leave it out")
    if arguments.master not in (None, "jacobi"):
        raise ParameterError(f"--master {arguments.master}: a package is for a parallel master")
    check_levels(scene, "in a package")
    if arguments.fmi not in (None, *FMI):
        raise ParameterError(f"--fmi {arguments.fmi}: allowed: {' or '.join(FMI)}")
    if arguments.settings:
        from ..settings import split_settings
        from ..shift.ssp.changed_values import changed

        words = "NAME=VALUE, e.g. clutch.friction_scale=0.9"
        scene = changed(scene, split_settings(arguments.settings, "--set", words))
    target = _output.check_file(arguments.ssp, "--ssp", (".ssp",))

    from ..native.files import zipped

    platforms = chosen_platforms(arguments.platforms, "native")
    began = time.perf_counter()
    parts = _package(scene, platforms, int(arguments.fmi or FMI[0]), plain=arguments.plain)
    _output.warn(scene.warnings)

    with _output.whole_file(target) as draft:
        draft.write_bytes(zipped(parts))
    if arguments.json:
        total = time.perf_counter() - began
        written = {"ssp": str(target), "files": sorted(parts), "total_time": total}
        _output.print_json(written | {"warnings": scene.warnings})
    else:
        print(target)
    return 0


def _package(scene: Any, platforms: list[str] | None, fmi: int, *, plain: bool) -> dict[str, bytes]:
    """Return all files of the package: the system, its documentation, one FMU per part."""
    from ..fmu.build import pack_native
    from ..fmu.description.model_description import generation_date
    from ..fmu.model_kernels import package_version
    from ..shift.ssp.package import files
    from ..shift.ssp.system_structure import plan, prepared, start_values

    scene = prepared(scene)
    with _fmu_instances(scene, "native") as make:
        instances = {name: make(name, part) for name, part in scene.parts.items()}
        system = plan(scene, start_values(scene, instances))
    tool = f"thrustwasher {package_version()}"
    found = files(system, tool=tool, date=generation_date(), fmi=fmi, plain=plain)
    for part in system.components:
        found[part.source] = pack_native(
            part.spec, fmi=fmi, platforms=platforms, plain=plain, note=_output.note
        )
    return found
