"""``thrustwasher sweep``: a model over all combinations of inputs and parameters."""

import argparse
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from ...cli.common import _options, _output
from ...cli.common._options import option_name
from ...cli.common._table import COLUMN, read_columns, wanted_of
from ...cli.common._table import OPTIONS as TABLE
from ...errors import ParameterError, SolveError
from ...model.levels import level_named
from ...model.quantity import Quantity
from ...model.registry import find_model, models_with_points
from ...model.spec import ModelSpec
from ...settings import places, split_settings

if TYPE_CHECKING:
    from ..sweep.run_plan import RunPlan
    from ..sweep.sweep_plan import Plan

VALUES = "NAME=VALUES, e.g. load=50:1850:50 or speed=136,545"
HELP = "solve a model over ranges of inputs and parameters"
EXAMPLES = (
    'thrustwasher sweep washer --over "load=100:500:n9" --speed "9100 rpm" --out sweep.csv',
    'thrustwasher sweep clutch --over "speed [rpm]=50,100,200" --over faces=4,6,8 '
    "--load 3000 --out packs.csv",
    "thrustwasher sweep engage --over inertia=0.1:0.4:n4 --over load=3000,4000 --speed 100",
)
ENGAGE = "engage"
OPTIONS = {
    "--over NAME=VALUES ...": "vary an input or parameter: load=50:1850:50 (start:stop:step), "
    "load=20:1850:x40 (40 values, equal ratios; n40: even), speed=136,545, "
    '"oil_temperature [degC]=24,80"; may be repeated, the first input runs fastest',
    "--points FILE.csv": "instead of --over, a file with a point in every line",
    "--column NAME=COLUMN ...": f"with --points: {COLUMN}",
    **{name: f"with --points: {text}" for name, text in TABLE.items()},
    "--preset NAME": "named set of parameters to start from, e.g. paper",
    "--fidelity LEVEL": "fidelity level of the model, its command's --help lists them; "
    "auto:0.01: the "
    "cheapest whose torque is verified to 1 %% over all points",
    "--out FILE": "table to write, .csv or .parquet; if stopped, the same command resumes. "
    "Without: CSV to standard output",
    "--cluster ADDRESS": "Dask scheduler, e.g. tcp://10.0.0.1:8786, instead of processes",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(models_with_points())
    what = f"{models}, a part file (.toml); {ENGAGE}; a scene (.toml, built-in): each point a shift"
    parser.add_argument("model", metavar="MODEL|FILE", help=what)
    what = f"of {ENGAGE}: the wet pack that closes, a part file, default clutch"
    parser.add_argument("part", metavar="PART", nargs="?", help=what)
    held = "hold an input or parameter at a value, e.g. --set roughness=4e-7; may be repeated"
    _options.add_settings(parser, held)
    _options.add(parser, OPTIONS)
    _options.add_workers(parser, "processes; default: one per core, 1: none")
    _options.add_oil(parser)
    inputs = parser.add_argument_group("inputs that are held (as with --set)")
    for name, units in _options.inputs_of_all_models().items():
        inputs.add_argument(option_name(name), dest=name, metavar="QUANTITY", help=units)


def run(arguments: argparse.Namespace) -> int:
    """Sweep, then write the table and say how it went."""
    from ..evaluators.make import is_at_points

    if arguments.model == ENGAGE:
        return _run_engagements(arguments)
    if arguments.part is not None:
        where = f"sweep {arguments.model} {arguments.part}"
        raise ParameterError(f"{where}: a second name is allowed after {ENGAGE} alone")
    if not is_at_points(arguments.model):
        return _run_scene(arguments)
    part = _options.solvable(arguments.model, arguments.preset)
    spec = part.spec
    at = _held(arguments, spec)
    over = split_settings(arguments.over, "--over", VALUES)
    points = None
    if arguments.points:
        points = _points(arguments, {p.name: p for p in places(spec).values()})
    part = _options.with_oil(
        arguments, part, (*at, *(n.partition("[")[0].strip() for n in over), *(points or ()))
    )
    from ..sweep.sweep_plan import make_plan

    plan = partial(make_plan, part, over, at, points, None, arguments.fidelity)
    return _sweep(arguments, plan, _progress(spec), lambda: _options.tell_oil(part))


def _run_engagements(arguments: argparse.Namespace) -> int:
    """Sweep engagements of a wet pack."""
    from ..evaluators.make import engagements
    from ..sweep.run_plan import make_run_plan

    part = _options.solvable(arguments.part or "clutch", arguments.preset)
    if arguments.fidelity is not None:
        part = replace(part, fidelity=level_named(part.spec, arguments.fidelity))
    part = _options.with_oil(arguments, part, split_settings(arguments.settings, "--set", VALUES))
    evaluator = engagements(part)
    at = _held(arguments, part.spec, [*evaluator.quantities])
    over = split_settings(arguments.over, "--over", VALUES)
    points = _points(arguments, evaluator.quantities) if arguments.points else None
    show = _output.time_left("sweep engage:")
    plan = partial(make_run_plan, evaluator, over, at, points)
    return _sweep(arguments, plan, show, lambda: _options.tell_oil(part))


def _run_scene(arguments: argparse.Namespace) -> int:
    """Sweep gear shifts."""
    from ...shift import load_scene
    from ..evaluators.scene import scene_evaluator
    from ..sweep.run_plan import make_run_plan

    unused = (*_options.inputs_of_all_models(), "preset", "fidelity")
    _options.refuse_unused(arguments, "a scene", unused)
    found = scene_evaluator(load_scene(arguments.model, arguments.oil))
    at = split_settings(arguments.settings, "--set", VALUES)
    over = split_settings(arguments.over, "--over", VALUES)
    points = _points(arguments, found.quantities) if arguments.points else None
    show = _output.time_left(f"sweep {found.name}:")
    plan = partial(make_run_plan, found, over, at, points)
    return _sweep(arguments, plan, show, lambda: None)


def _sweep(
    arguments: argparse.Namespace,
    plan: "Callable[[], Plan | RunPlan]",
    show: Callable[[int, int], None],
    tell: Callable[[], None],
) -> int:
    """Sweep, then write the table and say how it went."""
    from ..sweep.run_sweep import journal_of, run_planned
    from ..sweep.sweep_table import check_output, write_csv

    out = None
    if arguments.out:
        out = check_output(_output.check_file(arguments.out, "--out", (".csv", ".parquet")))
    began = time.perf_counter()
    journal = journal_of(out) if out else None
    with _output.going_on(arguments, journal, show) as progress:
        table = run_planned(
            plan(),
            out,
            workers=arguments.workers,
            cluster=arguments.cluster,
            progress=progress,
            keep=False,
        )
    for message in filter(None, [table.choice, table.taken]):
        _output.note(message)
    tell()
    _output.warn(table.warnings)
    if not out:
        write_csv(table, sys.stdout)
    failed = ", ".join(f"{n} {name}" for name, n in table.failures.items())
    _output.note(
        (f"wrote {out}: " if out else "")
        + f"{len(table)} points in {time.perf_counter() - began:.3g} s"
        + (f", failed: {failed}" if failed else "")
    )
    if sum(table.failures.values()) == len(table):
        raise SolveError(f"no point has a solution ({failed}); narrow the ranges")
    return 0


def _held(
    arguments: argparse.Namespace, spec: ModelSpec, more: Sequence[str] = ()
) -> dict[str, str]:
    """Return what ``--set`` and the inputs' options hold, by name."""
    held = split_settings(arguments.settings, "--set", VALUES)
    known = {*places(spec), *more}
    for name in _options.inputs_of_all_models():
        value = getattr(arguments, name)
        if value is not None:
            if name not in known or name in held:
                other = _options.other_way(name, find_model(spec.key))
                why = "is given twice" if name in known else f"is no input of {spec.name}{other}"
                raise ParameterError(f"{option_name(name)}: {why}")
            held[name] = value
    return held


def _points(arguments: argparse.Namespace, known: Mapping[str, Quantity]) -> dict[str, Any]:
    """Return the columns of a file of points; any of the names may be a column."""
    path, names = arguments.points, arguments.column or ()
    units = {name: p.unit for name, p in known.items() if p.kind in ("real", "integer")}
    columns: dict[str, Any] = dict(
        read_columns(
            path,
            {**units, "line": "1"},
            (*units, "line"),
            names=names,
            wanted=wanted_of(arguments),
        )
    )
    if not set(columns) - {"line"}:
        inputs = ", ".join(p.name for p in known.values() if p.is_input) or "a path of the scene"
        raise ParameterError(f"{path}: no column is an input or parameter, required: {inputs}")
    return columns


def _progress(spec: ModelSpec) -> Callable[[int, int], None]:
    """Return what shows the progress; on a new machine it explains the wait first."""
    show = _output.time_left(f"sweep {spec.key}:")
    begun = False

    def progress(done: int, total: int) -> None:
        nonlocal begun
        if not begun and done < total:
            from ...fmu.model_kernels import is_compiled

            if not is_compiled(spec):
                _output.note(f"compiling the kernels of the {spec.key}, once on this machine")
        begun = True
        show(done, total)

    return progress
