"""``thrustwasher calibrate``: fit parameters of a model to measured outputs, or a friction law."""

import argparse
import shlex
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..errors import ParameterError
from ..model.part_file import PartFile, is_part, part_text, usual_name
from ..model.registry import models_with_points
from ..model.rungs import rung_named
from ..sweep.axes import find_place, places, split_settings
from ..units import format_quantity, parse_quantity
from .common import _options, _output, _table

HELP = "fit parameters of a model to measured outputs, or the clutch's friction law to friction"
LAW_UNITS = {
    "speed": "rad/s",
    "load": "N",
    "friction": "1",
    "friction_error": "1",
    "oil_temperature": "K",
}
LAW_OPTIONAL = ("friction_error", "oil_temperature")
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
    "--column NAME=CHANNEL ...": "column of the file that holds NAME, e.g. speed=N_SLIP or "
    "'speed [rpm]=N_SLIP'; may be repeated",
    "--confidence P": "probability of the intervals; above 0, below 1, default 0.95",
    "--preset NAME": "preset to start from, e.g. paper",
    "--fidelity RUNG": "rung of the model, default the part's",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(models_with_points())
    parser.add_argument(
        "files",
        metavar="[PART] DATA.csv",
        nargs="*",
        help=f"PART: {models} or a part file (.toml); DATA.csv: columns named as inputs, "
        "parameters, measured outputs and <output>_error (standard deviation). Without PART "
        "friction of a clutch: speed, load, friction and, if known, friction_error and "
        'oil_temperature. A unit may follow in brackets, as in "speed [rpm]"',
    )
    _options.add(parser, OPTIONS)
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
    *given, data = arguments.files or [""]
    if len(given) > 1:
        raise ParameterError(f"{data}: allowed: [PART] DATA.csv, one part and one file")
    if not data or data in models_with_points() or data.endswith(".toml"):
        raise ParameterError("the file with the measured points is missing (DATA.csv)")
    with_law = next(key for key, model in models_with_points().items() if model.fits.law)
    part = _options.solvable(given[0] if given else with_law, arguments.preset)
    settings = split_settings(arguments.set, "--set", "NAME=VALUE")
    part = base = _options.with_oil(arguments, part, settings)
    target, arguments.out = arguments.out and _output.new_part(arguments.out), None
    targets = _output.targets(arguments)
    options: dict[str, Any] = {
        "confidence": parse_quantity(arguments.confidence, "1", "confidence")
    }
    if arguments.fit is not None:
        options["fit"] = tuple(filter(None, map(str.strip, arguments.fit.split(","))))
    if given:
        options |= _of_model(arguments, part, data)
        columns = options["data"]
    else:
        if arguments.error or arguments.bounds or arguments.fidelity:
            raise ParameterError("--error, --bounds, --fidelity: allowed: beside PART")
        changes = _options.read_settings(arguments.set, part.spec)
        part = replace(part, parameters=part.parameters | changes)
        names = arguments.column or ()
        columns = _table.read_columns(data, LAW_UNITS, optional=LAW_OPTIONAL, names=names)
        options |= columns

    from ..calibration.model_fit import calibrate

    began = time.perf_counter()
    found = calibrate(part, **options)
    wall_time = time.perf_counter() - began
    doubts = _doubts(found)
    warnings = [*found.warnings, *doubts]
    _options.tell_oil(part)
    _output.warn(warnings)
    if targets.plot:
        from ..report.model_plots.fit_plot import calibration_figure

        targets.draw(calibration_figure(found))
    if target:
        _write(target, part, found, data)
    if arguments.json:
        _output.print_json(
            {
                "data": data,
                "fit": [e.name for e in found.estimates],
                **columns,
                **found.to_dict(),
                "parameters": _output.parameters_of(found.params),
                **_options.oil_record(part),
                "wall_time": wall_time,
                "warnings": warnings,
            }
        )
        return 0
    print(found)
    if doubts or not all(e.identifiable for e in found.estimates):
        print("These values are none to use; the lines above say why.")
    else:
        print(f"Use it: {_command(arguments, base, given)} {_settings(found, base)}")
    return 0


def _command(arguments: argparse.Namespace, base: PartFile, given: list[str]) -> str:
    """Return the command that solves the part with the rung of the fit."""
    words = ["thrustwasher", base.spec.key]
    if given and is_part(given[0]):
        words += ["--part", shlex.quote(given[0])]
    options = {"preset": arguments.preset, "oil": arguments.oil}
    if arguments.fidelity:
        options["fidelity"] = rung_named(base.spec, arguments.fidelity)
    for option, value in options.items():
        if value:
            words += [f"--{option}", shlex.quote(value)]
    return " ".join(words)


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


def _of_model(arguments: argparse.Namespace, part: PartFile, data: str) -> dict[str, Any]:
    """Return what ``calibrate`` takes for a model."""
    from ..calibration.measured import column_units

    units = column_units(part.spec)
    columns = _table.read_columns(
        data, units, optional=tuple(units), strict=True, names=arguments.column or ()
    )
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
    note = f"calibrated on {Path(data).name}, {100 * found.confidence:g} %: {', '.join(words)}"
    notes = "; ".join(filter(None, (part.notes, note)))
    name = part.name if part.name != part.spec.name else usual_name(part.spec)
    values = _output.parameters_of(found.params)
    fitted = replace(part, name=name, parameters=values, notes=notes)
    _output.write_text(target, part_text(fitted))
    _output.note(f"wrote {target}")


def _settings(found: Any, base: PartFile) -> str:
    """Return the options for the fitted constants and for all that was given beside them."""
    values: dict[str, Any] = {e.name: f"{e.value:.10g}" for e in found.estimates}
    usual = _output.parameters_of(base.params)
    for name, value in _output.parameters_of(found.params).items():
        if value != usual[name]:
            values.setdefault(name, value)
    return " ".join(f"--set {name}={value}" for name, value in values.items())
