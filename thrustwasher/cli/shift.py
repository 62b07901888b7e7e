"""``thrustwasher shift``: the main job, a gear shift of FMUs with its report."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from threading import Thread
from typing import Any

from ..errors import ParameterError
from ..units import parse_quantity
from . import _compare, _output, _sequence
from .build import chosen_platforms

HELP = "run a gear shift as co-simulation of FMUs and write its report"
REPORT, TABLE = "report.html", "shift.csv"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "--scene", metavar="NAME|FILE.toml", default="planetary",
        help="a built-in scene (planetary, brake-test, msl, ...) or a TOML file; default planetary",
    )  # fmt: skip
    parser.add_argument(
        "--out", metavar="DIR", default="shift-report",
        help=f"folder for {REPORT}, overview.png and {TABLE}; default shift-report",
    )  # fmt: skip
    parser.add_argument(
        "--compare", nargs=2, metavar=("A", "B"),
        help="two shifts on one page, compare.html: each a report's folder, or a scene, which runs",
    )  # fmt: skip
    parser.add_argument(
        "--no-report", action="store_true", help="write no files, only say what came out"
    )
    parser.add_argument(
        "--step", metavar="QUANTITY", help="communication step [s], if not the scene's"
    )
    parser.add_argument(
        "--master", metavar="NAME",
        help="gauss-seidel, jacobi, linearly-implicit or step-doubling, if not the scene's",
    )  # fmt: skip
    parser.add_argument(
        "--master-tolerance", metavar="NUMBER",
        help="relative error of a step that step-doubling allows, if not the scene's",
    )  # fmt: skip
    parser.add_argument(
        "--fidelity", metavar="[PART=]RUNG", action="append", default=[],
        help="a rung for all parts that have it, or for one: field, washer=map; auto:0.01 chooses "
        "the cheapest that holds 1 %% and checks it after the run; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--no-guard", action="store_true",
        help="with auto: do not check the choice after the run, keep it",
    )  # fmt: skip
    parser.add_argument(
        "--fmu", choices=["native", "python"], default="native",
        help="kind of FMU; default native",
    )  # fmt: skip
    parser.add_argument(
        "--ssp", metavar="FILE.ssp",
        help="write the shift as an SSP package for other tools, instead of running it",
    )  # fmt: skip
    parser.add_argument(
        "--platforms", metavar="LIST",
        help="of the package's FMUs: names with commas, all, or local; default: all that can be "
        "linked here",
    )  # fmt: skip
    parser.add_argument("--json", action="store_true", help="one JSON object with every number")


def run(arguments: argparse.Namespace) -> int:
    """Build what is missing, run the shift, write the report."""
    if arguments.compare:
        return _compare.run(arguments, _scene, _one_shift)
    scene = _scene(arguments, arguments.scene)
    if scene.sequence:
        _sequence.check(arguments, scene)
    if arguments.ssp:
        return _export(arguments, scene)
    if arguments.platforms:
        raise ParameterError("--platforms: for a package only (--ssp FILE.ssp)")
    folder = None if arguments.no_report else _output.check_folder(arguments.out, "--out")

    began = time.perf_counter()
    result = (_shifts if scene.sequence else _one_shift)(arguments, scene)
    if folder:
        with _output.whole_folder(folder) as draft:
            (_sequence.write if scene.sequence else _write)(result, draft)
    if arguments.json:
        more = {} if scene.sequence else {"warnings": _warnings(result)}
        total, out = time.perf_counter() - began, str(folder) if folder else None
        _output.print_json({**result.as_dict(), **more, "total_time": total, "out": out})
    elif scene.sequence:
        _sequence.say(result)
    else:
        _say(result, folder)
    return 0


def _get_ready(arguments: argparse.Namespace) -> None:
    """Load what draws and read the templates while the shift runs: its steps leave Python free."""
    if not arguments.no_report:
        Thread(target=_load_report).start()


def _load_report() -> None:
    from ..report import html
    from ..report.shift import shift_report, summary  # noqa: F401 (it draws)

    html.template()
    summary.words()


def _scene(arguments: argparse.Namespace, name: str) -> Any:
    """Return the scene of that name with what the options change."""
    from ..shift import load_scene, with_fidelities

    step = None if arguments.step is None else parse_quantity(arguments.step, "s", "step")
    tolerance = arguments.master_tolerance
    scene = load_scene(name).with_options(
        step=step, master=arguments.master,
        master_tolerance=None if tolerance is None else parse_quantity(tolerance, "1", "tolerance"),
    )  # fmt: skip
    return with_fidelities(scene, arguments.fidelity)


def _one_shift(arguments: argparse.Namespace, scene: Any) -> Any:
    """Return the result of a scene of one shift."""
    from ..shift import run_auto

    with _fmu_instances(scene, arguments.fmu) as make:
        _get_ready(arguments)
        return run_auto(scene, make, guard=not arguments.no_guard, build_maps=True,
                        progress=_progress(scene))  # fmt: skip


def _shifts(arguments: argparse.Namespace, scene: Any) -> Any:
    """Return the result of a scene of several shifts."""
    from ..shift import run_sequence

    with _fmu_instances(scene, arguments.fmu) as make:
        _get_ready(arguments)
        instances = {name: make(name, part) for name, part in scene.parts.items()}
        return run_sequence(scene, instances, progress=_progress(scene))


def _progress(scene: Any) -> Callable[[int, int], None] | None:
    return _output.time_left(scene.name) if sys.stderr.isatty() else None


def _warnings(result: Any) -> list[str]:
    """Return what a reader must not miss."""
    from ..report.shift import summary
    from ..report.shift.shift_record import record_of

    return summary.warnings(record_of(result))


def _say(result: Any, folder: Path | None) -> None:
    """Print what happened in the shift, and where its report is."""
    from ..report.shift import summary
    from ..report.shift.shift_record import record_of

    record = record_of(result)
    for text in result.selection.words() if result.selection else []:
        print(text)
    for text in [*summary.sentences(record), *summary.warnings(record)]:
        print(text)
    missing = f"{record.energy['residual_share']:.1e} of {record.whole_name}"
    print(f"Energy balance: {missing} is missing.")
    if folder:
        print(f"Report: {folder / REPORT}")
    if result.guard:
        print(f"Check: {result.guard.closing()}.")


@contextmanager
def _fmu_instances(scene: Any, target: str) -> Iterator[Callable[[str, Any], Any]]:
    """Give a function that makes an FMU instance of a part; all are freed in the end."""
    from ..fmu.stepper import Instance
    from ._fmu_cache import fmu_paths

    names = {part.spec.name for part in scene.parts.values()}
    paths = fmu_paths(names, target)
    known = _tables(scene)
    with ExitStack() as alive:

        def make(name: str, part: Any) -> Any:
            nonlocal known
            if _tables(scene) != known:  # a map was built: it goes into the FMU
                known = _tables(scene)
                paths.update(fmu_paths(names, target))
            path = paths[part.spec.name]
            return alive.enter_context(Instance(path, parameters=part.parameters(), name=name))

        yield make


def _tables(scene: Any) -> list[Any]:
    """Return the files in which parts look up, and when they were written."""
    from ..model.prepare import tables_of

    found = filter(None, (tables_of(part.spec) for part in scene.parts.values()))
    return [(path, path.stat().st_mtime_ns) for tables in found for path in tables.paths()]


def _write(result: Any, folder: Path) -> None:
    """Write page, overview and time series into a folder that is still a draft."""
    from ..report.html import render, save_plots
    from ..report.shift.shift_record import record_of
    from ..report.shift.shift_report import shift_page

    page = shift_page(record_of(result))
    (folder / REPORT).write_text(render(page), encoding="utf-8")
    save_plots(page, folder)
    result.write_csv(folder / TABLE)


def _export(arguments: argparse.Namespace, scene: Any) -> int:
    """Write the shift as a package that any SSP master runs, and name it."""
    if arguments.fmu == "python":
        raise ParameterError("--fmu python: a package holds native FMUs only; leave it out")
    if arguments.master not in (None, "jacobi"):
        raise ParameterError(f"--master {arguments.master}: a package is for a parallel master")
    open_ = [name for name, part in scene.parts.items() if part.tolerance]
    if open_:
        raise ParameterError(
            f"fidelity of {', '.join(open_)} = auto, allowed in a package: a rung by name "
            "(--fidelity PART=RUNG)"
        )
    target = _output.check_file(arguments.ssp, "--ssp", (".ssp",))

    from ..native.files import zipped

    platforms = chosen_platforms(arguments.platforms, "native")
    began = time.perf_counter()
    parts = _package(scene, platforms)

    with _output.whole_file(target) as draft:
        draft.write_bytes(zipped(parts))
    if arguments.json:
        total = time.perf_counter() - began
        _output.print_json({"ssp": str(target), "files": sorted(parts), "total_time": total})
    else:
        print(target)
    return 0


def _package(scene: Any, platforms: list[str] | None) -> dict[str, bytes]:
    """Return all files of the package: the system, its documentation, one FMU per part."""
    from ..fmu.build import pack_native
    from ..fmu.description.xml_parts import generation_date
    from ..fmu.model_kernels import package_version
    from ..shift.ssp.package import files
    from ..shift.ssp.system_structure import plan, prepared, start_values

    scene = prepared(scene)
    with _fmu_instances(scene, "native") as make:
        instances = {name: make(name, part) for name, part in scene.parts.items()}
        system = plan(scene, start_values(scene, instances))
    tool = f"thrustwasher {package_version()}"
    found = files(system, tool=tool, date=generation_date())
    for part in system.components:
        found[part.source] = pack_native(part.spec, platforms=platforms, note=_output.note)
    return found
