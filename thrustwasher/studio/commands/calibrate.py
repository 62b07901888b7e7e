"""``thrustwasher calibrate``: fit parameters of a model to measured outputs, or a friction law."""

import argparse
import shlex
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...cli.common import _options, _output, _table
from ...errors import ParameterError
from ...model.levels import level_named
from ...model.part_file import PartFile, is_part, part_text, usual_name
from ...model.registry import models_with_points
from ...settings import find_place, places, split_settings
from ...units import format_quantity, parse_quantity
from . import _traces

if TYPE_CHECKING:
    from ...storage.tables.table import Table
    from ..calibration.traces.recording import Traces

HELP = "fit parameters to measured points or recordings over time"
EXAMPLES = (
    "thrustwasher calibrate examples/own/friction.csv --plot fit.png",
    'thrustwasher calibrate clutch examples/ex17_engagement.csv --piston-area "60 '
    'cm2" --fit friction_scale,permeability,fill_time,kiss_pressure --out pack.toml',
)
LAW_UNITS = {
    "speed": "rad/s",
    "sliding_speed": "m/s",
    "load": "N",
    "friction": "1",
    "friction_error": "1",
    "oil_temperature": "K",
}
LAW = "friction"  # what the law is fitted to
LAW_OPTIONAL = ("friction_error", "oil_temperature", "speed", "sliding_speed")
LAW_NEEDED = (("speed", "sliding_speed"), ("load",), ("friction",))
MISFIT = 25.0  # reduced chi-square from which a fit is none: five errors on average
SETTINGS = {"set": "NAME=VALUE", "error": "NAME=VALUE", "bounds": "NAME=LOW:HIGH"}
OPTIONS = {
    "--fit NAMES": "parameters to fit, separated by commas; without PART constants of the "
    "friction law, default plough_weight,shear_floor,stick_speed,decay_speed",
    "--set NAME=VALUE ...": "what is held, and where the fit starts; an input that all points "
    "share; may be repeated",
    "--error NAME=VALUE ...": "standard deviation of an output: friction_torque=2%%, of its value; "
    "may be repeated",
    "--bounds NAME=LOW:HIGH ...": "narrower range of a parameter; may be repeated",
    "--column NAME=COLUMN ...": _table.COLUMN,
    **_table.OPTIONS,
    "--confidence P": "probability of the intervals; above 0, below 1, default 0.95",
    "--preset NAME": "preset to start from, e.g. paper",
    "--fidelity LEVEL": "fidelity level of the model, default the part's",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(models_with_points())
    parser.add_argument(
        "files",
        metavar="[PART] DATA.csv ...",
        nargs="*",
        help=f"PART: {models} or a part file (.toml); DATA.csv: columns named as inputs, "
        "parameters, measured outputs and <output>_error (standard deviation). Without PART "
        "friction of a clutch: speed, load, friction and, if known, friction_error and "
        'oil_temperature. A unit may follow in brackets, as in "speed [rpm]". Files with a column '
        "time are recordings of a clutch: time, load or pressure, speed, friction_torque, "
        "temperature, oil_temperature, drum_speed; several are fitted at once",
    )
    _options.add(parser, OPTIONS | _traces.OPTIONS)
    parser.set_defaults(confidence="0.95")
    _options.add_oil(parser)
    _output.add_targets(
        parser,
        plot="draw points, fit and residuals",
        instead="sentences",
        out="part file to write with the fitted values (.toml); never over one",
    )


def run(arguments: argparse.Namespace) -> int:
    """Read, fit, then print, draw or write."""
    given, paths = _split(arguments.files)
    data = ", ".join(paths)
    from ..calibration.run_calibration import LAWS, calibrate

    part = _options.solvable(given[0] if given else next(iter(LAWS)), arguments.preset)
    settings = split_settings(arguments.set, "--set", "NAME=VALUE")
    part = base = _options.with_oil(arguments, part, settings)
    target, arguments.out = arguments.out and _output.new_part(arguments.out), None
    targets = _output.targets(arguments)
    options: dict[str, Any] = {
        "confidence": parse_quantity(arguments.confidence, "1", "confidence"),
    }
    if arguments.fit is not None:
        options["fit"] = tuple(filter(None, map(str.strip, arguments.fit.split(","))))
    tables, traces = _tables(arguments, part, given, paths)
    if traces:
        columns = _traces.read_recordings(tables, traces)
        options |= _of_traces(arguments, part, traces)
    elif given:
        options |= _of_model(arguments, part, data, tables[0])
        columns = options["data"]
    else:
        if arguments.error or arguments.bounds or arguments.fidelity:
            raise ParameterError("--error, --bounds, --fidelity: allowed: with PART")
        changes = _options.read_settings(arguments.set, part.spec)
        part = replace(part, parameters=part.parameters | changes)
        columns = _table.read_columns(
            data, LAW_UNITS, optional=LAW_OPTIONAL, needed=LAW_NEEDED, known=tables[0]
        )
        options["data"] = columns

    if sys.stderr.isatty():
        runs = "recordings stepped along" if traces else "evaluations"
        options["progress"] = _output.time_left(f"fit, {runs}:")
    began = time.perf_counter()
    found = traces.fit(part, columns, **options) if traces else calibrate(part, **options)
    wall_time = time.perf_counter() - began
    doubts = _doubts(found)
    warnings = [*found.warnings, *doubts]
    _options.tell_oil(part)
    _output.warn(warnings)
    if targets.plot:
        from ..report.result_plots import figure_of

        targets.draw(figure_of(found))
    is_sound = not doubts and all(e.identifiable for e in found.estimates)
    if target and is_sound:
        _write(target, part, found, data)
    elif target:
        _output.note(f"{target} is not written: not all values are determined by the data")
    if arguments.json:
        _output.print_json(
            {
                "data": data,
                "fit": [e.name for e in found.estimates],
                **({} if traces else columns),  # a recording's rows are in its file
                **found.to_dict(),
                "parameters": _output.parameters_of(found.params),
                **_options.oil_record(part),
                "wall_time": wall_time,
                "warnings": warnings,
            }
        )
        return 0
    print(found)
    if is_sound:
        print(f"Use it: {_next(arguments, base, given, found, target)}")
    else:
        print("Do not use these values; the lines above say why.")
    return 0


def _split(files: list[str]) -> tuple[list[str], list[str]]:
    """Return the part, if one is named, and the files of data."""
    is_one = [name in models_with_points() or name.endswith(".toml") for name in files]
    given, paths = files[: int(is_one[:1] == [True])], files[int(is_one[:1] == [True]) :]
    if any(is_one[1:]):
        other = files[is_one.index(True, 1)]
        raise ParameterError(f"{other}: allowed: [PART] DATA.csv ..., one part, named first")
    if not paths or not all(paths):
        raise ParameterError("the file with the measured points is missing (DATA.csv)")
    return given, paths


def _tables(
    arguments: argparse.Namespace, part: PartFile, given: list[str], paths: list[str]
) -> tuple[list["Table"], "Traces | None"]:
    """Return the files' tables, and what fits them if they are recordings."""
    from ..calibration.run_calibration import RECORDED

    kind = RECORDED.get(part.spec.key) if given else None
    if len(paths) > 1 and not kind:
        raise ParameterError(
            f"{paths[1]}: allowed: [PART] DATA.csv, one file; several with {', '.join(RECORDED)}, "
            "as recordings with a column time"
        )
    tables, over_time = _traces.read_tables(
        paths, arguments.column or (), _table.wanted_of(arguments)
    )
    if over_time and not kind and (given or not any(c.name == LAW for c in tables[0].columns)):
        able = next(iter(RECORDED))
        raise ParameterError(
            f"{paths[0]}: has a column time, so it is a recording; allowed: with {able} "
            f"(thrustwasher calibrate {able} {shlex.quote(paths[0])}). Of settled points name the "
            "column _time"
        )
    if kind and _traces.may_be_recording(tables):
        return tables, kind  # whose reader asks about all columns at once
    if not kind or not over_time:
        _traces.refuse_rig(arguments)
        kind = None
    return tables, kind


def _of_traces(arguments: argparse.Namespace, part: PartFile, kind: "Traces") -> dict[str, Any]:
    """Return what fits a part to recordings takes next to these."""
    given = {
        option: split_settings(getattr(arguments, option), f"--{option}", metavar)
        for option, metavar in SETTINGS.items()
    }
    return {
        "errors": given["error"],
        "bounds": _traces.bounds_of(given["bounds"], kind.spec),
        "at": given["set"],
        "fidelity": arguments.fidelity or part.fidelity,
        **_traces.rig_options(arguments),
    }


def _next(
    arguments: argparse.Namespace,
    base: PartFile,
    given: list[str],
    found: Any,
    target: Path | None,
) -> str:
    """Return a command that solves the fitted part with the level of the fit."""
    words = [base.spec.key]
    level = arguments.fidelity and level_named(base.spec, arguments.fidelity)
    chosen = ["--fidelity", level] if level else []
    if target:
        return shlex.join(["thrustwasher", *words, "--part", str(target), *chosen])
    if given and is_part(given[0]):
        words += ["--part", given[0]]
    if arguments.preset:
        words += ["--preset", arguments.preset]
    settings = _settings(found, base)
    if arguments.oil:
        own = base.oil.parameters_for(base.spec) if base.oil else {}
        if own.keys() & settings.keys():  # the fit changed what the oil sets
            fitted = _output.parameters_of(found.params)
            settings = {name: fitted[name] for name in own} | settings
        else:
            words += ["--oil", arguments.oil]
    words += [*chosen, *(x for n, v in settings.items() for x in ("--set", f"{n}={v}"))]
    return shlex.join(["thrustwasher", *words])


def _doubts(found: Any) -> list[str]:
    """Return a line for each sign that nothing was fitted."""
    lines = [
        f"{e.name} = {format_quantity(e.value, e.unit)} is at its {e.at_bound} bound: "
        "the points ask for more; check their units and signs, or give --bounds"
        for e in found.estimates
        if e.at_bound
    ]
    reduced = found.reduced_chi_square or 0.0
    if reduced > MISFIT:
        lines.append(
            f"reduced chi-square {reduced:.3g}: the points lie some {reduced**0.5:.2g} errors off "
            "the fit, nothing fits; check the units and signs of the columns (a torque in N.mm is "
            "1000 times that in N.m), --error, and that the model's output is what was measured"
        )
    return lines


def _of_model(
    arguments: argparse.Namespace, part: PartFile, data: str, table: "Table"
) -> dict[str, Any]:
    """Return what ``calibrate`` takes for a model; ``table``: that of the file."""
    from ..calibration.measured import column_units

    units = column_units(part.spec)
    columns = _table.read_columns(data, units, optional=tuple(units), strict=True, known=table)
    bounds, known = {}, places(part.spec)
    given = {
        option: split_settings(getattr(arguments, option), f"--{option}", metavar)
        for option, metavar in SETTINGS.items()
    }
    for name, text in given["bounds"].items():
        ends = text.split(":")
        if len(ends) != 2:
            raise ParameterError(f"--bounds {name}={text}: allowed: NAME=LOW:HIGH")
        place = find_place(name, known, part.spec)
        bounds[name] = tuple(place.check(end) for end in ends)
    return {
        "data": columns,
        "bounds": bounds,
        "fidelity": arguments.fidelity or part.fidelity,
        "errors": given["error"],
        "at": given["set"],
    }


def _write(target: Path, part: PartFile, found: Any, data: str) -> None:
    """Write the part with the fitted values and a note on them."""
    words = (
        f"{e.name} {e.value:.6g} {e.unit}".removesuffix(" 1")
        + f" ({e.interval[0]:.4g} .. {e.interval[1]:.4g}"
        f"{'' if e.identifiable else ', not determined by the points'})"
        for e in found.estimates
    )
    names = ", ".join(Path(name).name for name in data.split(", "))
    note = f"calibrated on {names}, {100 * found.confidence:g} %: {', '.join(words)}"
    notes = "; ".join(filter(None, (part.notes, note)))
    name = part.name if part.name != part.spec.name else usual_name(part.spec)
    values = _output.parameters_of(found.params)
    fitted = replace(part, name=name, parameters=values, notes=notes)
    _output.write_text(target, part_text(fitted))
    _output.note(f"wrote {target}")


def _settings(found: Any, base: PartFile) -> dict[str, Any]:
    """Return the fitted constants and all that was given in addition, by name."""
    usual = _output.parameters_of(base.params)
    values: dict[str, Any] = {  # a test data set's own are no parameters of the part
        e.name: f"{e.value:.10g}" for e in found.estimates if e.name in usual
    }
    for name, value in _output.parameters_of(found.params).items():
        if value != usual[name]:
            values.setdefault(name, value)
    return values
