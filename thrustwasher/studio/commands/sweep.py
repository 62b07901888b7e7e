"""``thrustwasher sweep``: a model over all combinations of inputs and parameters."""

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from typing import Any

from ...cli.common import _options, _output
from ...cli.common._options import option_name
from ...cli.common._table import read_columns
from ...errors import ParameterError, SolveError
from ...model.registry import find_model, models_with_points
from ...model.spec import ModelSpec
from ...settings import places, split_settings

VALUES = "NAME=VALUES, e.g. load=50:1850:50 or speed=136,545"
HELP = "solve a model over ranges of inputs and parameters"
EXAMPLES = (
    'thrustwasher sweep washer --over "load=100:500:n9" --speed "9100 rpm" --out sweep.csv',
    'thrustwasher sweep clutch --over "speed [rpm]=50,100,200" --over faces=4,6,8 '
    "--load 3000 --out packs.csv",
)
OPTIONS = {
    "--over NAME=VALUES ...": "vary an input or parameter: load=50:1850:50 (start:stop:step), "
    "load=20:1850:x40 (40 values, equal ratios; n40: even), speed=136,545, "
    '"oil_temperature [degC]=24,80"; may be repeated, the first input runs fastest',
    "--points FILE.csv": "instead of --over, a file with a point in every line",
    "--column NAME=CHANNEL ...": "with --points: column of the file that holds NAME, e.g. "
    "speed=N_SLIP; may be repeated",
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
    parser.add_argument("model", metavar="MODEL|FILE", help=f"{models}, or a part file (.toml)")
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
    part = _options.solvable(arguments.model, arguments.preset)
    spec = part.spec
    at = _held(arguments, spec)
    out = None
    if arguments.out:
        out = _output.check_file(arguments.out, "--out", (".csv", ".parquet"))
    points = _points(arguments.points, spec, arguments.column or ()) if arguments.points else None
    over = split_settings(arguments.over, "--over", VALUES)
    part = _options.with_oil(
        arguments, part, (*at, *(n.partition("[")[0].strip() for n in over), *(points or ()))
    )

    from ..sweep.run_sweep import journal_of, run_sweep
    from ..sweep.sweep_table import write_csv

    began = time.perf_counter()
    journal = journal_of(out) if out else None
    with _output.going_on(arguments, journal, _progress(spec)) as progress:
        table = run_sweep(
            part,
            over,
            at=at,
            points=points,
            fidelity=arguments.fidelity,
            out=out,
            workers=arguments.workers,
            cluster=arguments.cluster,
            progress=progress,
            keep=False,
        )
    for message in filter(None, [table.choice, table.taken]):
        _output.note(message)
    _options.tell_oil(part)
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


def _held(arguments: argparse.Namespace, spec: ModelSpec) -> dict[str, str]:
    """Return what ``--set`` and the inputs' options hold, by name."""
    held = split_settings(arguments.settings, "--set", VALUES)
    known = places(spec)
    for name in _options.inputs_of_all_models():
        value = getattr(arguments, name)
        if value is not None:
            if name not in known or name in held:
                other = _options.other_way(name, find_model(spec.key))
                why = "is given twice" if name in known else f"is no input of {spec.name}{other}"
                raise ParameterError(f"{option_name(name)}: {why}")
            held[name] = value
    return held


def _points(path: str, spec: ModelSpec, names: Sequence[str]) -> dict[str, Any]:
    """Return the columns of a file of points; any of the model's names may be a column."""
    known = places(spec)
    units = {p.name: p.unit for p in known.values() if p.kind in ("real", "integer")}
    columns: dict[str, Any] = dict(
        read_columns(path, {**units, "line": "1"}, (*units, "line"), names=names)
    )
    if not set(columns) - {"line"}:
        inputs = ", ".join(p.name for p in known.values() if p.is_input)
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
