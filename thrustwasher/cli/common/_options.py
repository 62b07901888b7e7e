"""Options made from a model's list of inputs and parameters, so that nothing is typed twice."""

import argparse
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, NamedTuple

from ...errors import ParameterError, suggestion
from ...model.idle import idle_warnings
from ...model.oil import refuse_two_ways, sheet_oil
from ...model.parameters import allowed, check_number, earlier_of
from ...model.part_file import (
    PartFile,
    find_part,
    is_part,
    load_part,
    preset_part,
    preset_parts,
    scene_parts,
)
from ...model.point import Point, point_of
from ...model.quantity import of_field
from ...model.record import Model, Option
from ...model.registry import find_model, models_with_points, spec_of
from ...settings import places, split_settings
from ...units import has_unit, parse_quantity
from ._output import note, parameters_of, warn

QUANTITIES = {  # what a quantity is called -> its unit
    "torque": "N.m",
    "force": "N",
    "pressure": "Pa",
    "power": "W",
    "rpm": "rad/s",
    "omega": "rad/s",
    "velocity": "rad/s",
    "rotation": "rad/s",
    "temperature": "K",
    "temp": "K",
}
LIKELY_RPM = 1000.0  # a speed without a unit from here on may be one in rpm
if TYPE_CHECKING:  # they need numpy, which not every command does
    from ...model.oil import Oil
    from ...model.spec import ModelSpec, Signal


def add_inputs(parser: argparse.ArgumentParser, inputs: "Iterable[Signal]") -> None:
    """Add one option per input, with unit, range and default in its help."""
    group = parser.add_argument_group("operating point")
    for signal in inputs:
        span = f"{signal.low:g} .. {signal.high:g} {signal.unit}"
        group.add_argument(
            option_name(signal.name),
            dest=signal.name,
            metavar="QUANTITY",
            help=f"{signal.help} [{signal.unit}]; {span}, default {signal.usual:g} or "
            "the nearest value in the part's [box]",
        )


def other_way(name: str, model: Model) -> str:
    """Return how to give what no option of a model has: as another input, or by ``--set``."""
    spec, given, unit = model.spec, model.inputs(), QUANTITIES.get(name, "")
    instead = model.command.instead if model.command else {}
    for old in spec.inputs:
        new = instead.get(old.name)
        if new and (name == old.name or unit == old.unit):
            how = ", torque times speed" if (old.unit, new.unit) == ("N.m", "W") else ""
            return f"; give {option_name(new.name)}{how}"
    same = [s.name for s in given if s.name == name or s.unit == unit]
    if len(same) == 1:
        return f"; did you mean {option_name(same[0])}?"
    names = [f.name for f in fields(spec.params)]
    inputs = f"; inputs: {', '.join(option_name(s.name) for s in given)}"
    return suggestion(name, names, "; did you mean --set {}=VALUE?", inputs, likeness=0.75)


def inputs_of_all_models() -> dict[str, str]:
    """Return the inputs of all models with the units that they have there."""
    found: dict[str, dict[str, None]] = {}
    for model in models_with_points():
        for place in places(spec_of(model)).values():
            if place.is_input:
                found.setdefault(place.name, {})[f"{place.unit} ({model})"] = None
    return {name: ", ".join(units) for name, units in found.items()}


def _doubts(given: Mapping[str, Any], inputs: "Iterable[Signal]") -> list[str]:
    """Return warnings of speeds without a unit that were probably meant in rpm."""
    found = []
    for s in inputs:
        text = given[s.name]
        bare = text is not None and s.unit == "rad/s" and re.fullmatch(r"\s*[+-]?[\d.]+\s*", text)
        if bare and abs(float(text)) >= LIKELY_RPM:
            rpm = parse_quantity(f"{text} rpm", s.unit, s.name)
            found.append(
                f"{s.name} = {text} without a unit is in rad/s; did you mean {rpm:.6g} "
                f"rad/s ({float(text):g} rpm)? Write the unit"
            )
    return found


def read_input(text: str, signal: "Signal") -> float:
    """Return an input in SI units, in its range."""
    value = parse_quantity(text, signal.unit, signal.name, difference=signal.relative)
    stated = has_unit(text)
    return check_number(signal.name, value, signal.unit, *signal.range, stated=stated)


def add_parameters(parser: argparse.ArgumentParser, spec: "ModelSpec") -> None:
    """Add ``--part``, ``--set``, ``--oil``, ``--parameters``, ``--preset`` if there are presets."""
    group = parser.add_argument_group("parameters")
    start = group.add_mutually_exclusive_group()
    start.add_argument("--part", metavar="FILE.toml", help="part file that --set starts from")
    if presets := preset_parts(spec):
        words = "; ".join(f"{name}: {part.description}" for name, part in presets.items())
        help = f"preset that --set starts from; {words}".replace("%", "%%")
        start.add_argument("--preset", choices=list(presets), help=help)
    names = {f.name: _default(f) for f in fields(spec.params)}
    first = next(iter(names))
    example = "roughness=4e-7" if "roughness" in names else f"{first}={names[first]}"
    add_settings(group, f"change a parameter, e.g. --set {example}; may be repeated")
    add_oil(group)
    group.add_argument(
        "--parameters",
        action=_ListParameters,
        nargs=0,
        const=spec,
        help=f"list the parameters of {spec.name} with default, unit and range, and stop",
    )


def add(parser: Any, options: Mapping[str, str]) -> None:
    """Add flags (``"--quick": help``) and options of one value (``"--out FILE": help``).

    One that may be repeated has dots behind it: ``"--error NAME=VALUE ..."``.
    """
    for words, help in options.items():
        name, _, metavar = words.partition(" ")
        more: Any = {"metavar": metavar} if metavar else {"action": "store_true"}
        if metavar.endswith(" ..."):
            more = {"metavar": metavar[:-4], "action": "append", "default": []}
        parser.add_argument(name, help=help, **more)


def add_subject(
    parser: Any, name: str, metavar: str, help: str, default: str | None = None, *, asked: bool
) -> None:
    """Add what a command is about, by its place or as ``--scene``; not both.

    ``asked``: it must be given, else it is ``default``.
    """
    either = parser.add_mutually_exclusive_group(required=asked)
    one: Any = {"nargs": "?", "default": argparse.SUPPRESS}  # else it overrules the option
    either.add_argument(name, metavar=metavar, help=help, **one)
    either.add_argument(
        "--scene", dest=name, default=default, metavar="NAME|FILE", help=f"the same as {metavar}"
    )


def add_settings(parser: Any, help: str) -> None:
    """Add ``--set``."""
    look: Any = {"metavar": "NAME=VALUE", "dest": "settings"}
    parser.add_argument("--set", action="append", default=[], help=help, **look)


def add_workers(parser: Any, help: str = "processes; default: all cores") -> None:
    """Add ``--workers``."""
    parser.add_argument("--workers", type=_workers, metavar="N", help=help)


def _workers(text: str) -> int:
    if not text.strip().isdecimal() or len(text) > 6 or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text}, allowed: a whole number from 1 on")
    return int(text)


class PartPoint(NamedTuple):
    """A part at an operating point, as the options give them."""

    part: PartFile
    there: Point
    doubts: list[str]  # of speeds without a unit

    def warn(self, more: Iterable[str]) -> list[str]:
        """Write what the oil is and all warnings, which are returned; called before figures."""
        warnings = [*self.doubts, *self.there.warnings, *more]
        tell_oil(self.part)
        warn(warnings)
        return warnings

    def record(self, warnings: list[str], wall_time: float) -> dict[str, Any]:
        """Return what JSON has of every solution at a point."""
        return {
            "parameters": parameters_of(self.part.params),
            "wall_time": wall_time,
            "taken": {"box": self.there.box, "default": self.there.default},
            "warnings": warnings,
            **oil_record(self.part),
        }


def read_point(
    arguments: argparse.Namespace, spec: "ModelSpec", inputs: "Sequence[Signal]"
) -> PartPoint:
    """Return the part and the point that the options give."""
    part, given = read_part(arguments, spec), vars(arguments)
    values = {s.name: read_input(given[s.name], s) for s in inputs if given[s.name] is not None}
    return PartPoint(part, point_of(part, values, inputs), _doubts(given, inputs))


def read_part(arguments: argparse.Namespace, spec: "ModelSpec") -> PartFile:
    """Return part file, preset or the model's defaults with every ``--set`` applied, checked."""
    file, preset = arguments.part, getattr(arguments, "preset", None)
    part = solvable(spec.key, preset) if file is None else load_part(file)
    if part.spec.key != spec.key:
        raise ParameterError(f"--part {file}: is one of {part.spec.name}, allowed: {spec.name}")
    settings = read_settings(arguments.settings, spec, part)
    part = with_oil(arguments, part, settings)
    part = replace(part, parameters=part.parameters | settings)
    part.params  # noqa: B018  (raises what the model says about them)
    return part


def solvable(name: str, preset: str | None = None) -> PartFile:
    """Return the part of a part file or built-in scene, or a model with defaults or a preset.

    ParameterError unless its model is solved at operating points.
    """
    if preset is None and name in scene_parts():
        return find_part(name)
    if not is_part(name):
        spec = spec_of(find_model(name).key)
        return find_part(spec.key) if preset is None else preset_part(spec, preset)
    if preset is not None:
        raise ParameterError(
            f"--preset {preset}: together with the part file {name}, allowed: one of them"
        )
    part = load_part(name)
    spec_of(part.spec.key)
    return part


class _ListParameters(argparse.Action):
    """Print the parameters and leave, as ``--help`` does."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        parser._print_message(f"{parameter_table(self.const)}\n")
        parser.exit()


def read_oil(
    arguments: argparse.Namespace, spec: "ModelSpec", others: Iterable[str]
) -> "Oil | None":
    """Return the oil of ``--oil``; ParameterError if ``others`` set it as well."""
    if arguments.oil is None:
        return None
    oil = sheet_oil("--oil", arguments.oil)
    refuse_two_ways("--oil", oil, spec, others)
    return oil


def with_oil(arguments: argparse.Namespace, part: PartFile, others: Iterable[str]) -> PartFile:
    """Return a part with the oil of ``--oil``; ``others`` that change its own leave it none."""
    others = list(others)
    if (oil := read_oil(arguments, part.spec, others)) is not None:
        return part.with_oil(oil)
    sets = part.oil.parameters_for(part.spec) if part.oil else {}
    if changed := [name for name in others if name in sets]:
        note(f"{', '.join(changed)}: given in addition to the oil of the part, which it is no more")
        return replace(part, oil=None)
    return part


def tell_oil(part: PartFile) -> None:
    """Say what the oil of a part is, if it has a name or a data sheet; called before figures."""
    if part.oil:
        note(part.oil_words)


def part_warnings(part: PartFile) -> list[str]:
    """Return what is to be known of a part that is not solved."""
    return [*idle_warnings(part.spec.key, part.params, part.fidelity), *part.oil_warnings]


def oil_record(part: PartFile) -> dict[str, Any]:
    """Return what JSON says of the oil of a part, if it has a name or a data sheet."""
    return {"oil": part.oil.as_dict(part.spec)} if part.oil else {}


def read_settings(
    settings: Iterable[str], spec: "ModelSpec", part: PartFile | None = None
) -> dict[str, Any]:
    """Return the values that ``--set NAME=VALUE`` gives, by name; ``part`` that they are for."""
    metadata = {f.name: f.metadata for f in fields(spec.params)} | earlier_of(spec.params)
    given = split_settings(settings, "--set", "NAME=VALUE, e.g. roughness=4e-7")
    if part is not None:
        metadata = part.suggesting(metadata)
        given = {part.flat_name(name): text for name, text in given.items()}
    for name, text in given.items():
        if name not in metadata:
            hint = suggestion(name, metadata, "did you mean {}? ")
            if name in {s.name for s in spec.inputs}:
                hint = "it is an input; "
            raise ParameterError(
                f"--set {name}={text}: {spec.name} has no parameter {name!r}; {hint}"
                f"thrustwasher {spec.key} --parameters lists them"
            )
    return {n: of_field(n, 0.0, metadata[n]).check(text) for n, text in given.items()}


def parameter_table(spec: "ModelSpec") -> str:
    """Return the parameters as lines of text: name, default, unit, range, meaning."""
    rows = [("name", "default", "unit", "allowed", "meaning")]
    for f in fields(spec.params):
        m = f.metadata
        unit = "" if m["unit"] == "1" else m["unit"]
        span = allowed(m)
        if m["kind"] in ("real", "integer"):
            span = f"{m['min']:g} .. {m['max']:g}"
        rows.append((f.name, _default(f), unit, span, m["help"]))
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    return "\n".join(
        "  ".join([*(row[i].ljust(widths[i]) for i in range(4)), row[4]]).rstrip() for row in rows
    )


def _default(field: Any) -> str:
    """Return the default of a parameter as it is written."""
    number = field.metadata["kind"] == "real"
    return f"{field.default:.10g}" if number else str(field.default)


def add_fidelity(parser: argparse.ArgumentParser, spec: "ModelSpec", *, auto: bool = False) -> None:
    """Add ``--fidelity`` with a sentence per level, and ``auto`` if there are error tables."""
    words = [f"{name}: {text}" for name, text in spec.levels.items()]
    if auto:
        words.append(
            "auto:0.01: the cheapest fidelity level whose torque is verified to 1 % at this point"
        )
    usual = spec.default_fidelity
    help = "; ".join([*words, f"default {usual} or the part file's"]).replace("%", "%%")
    parser.add_argument("--fidelity", help=help, metavar="LEVEL")


def add_options(parser: argparse.ArgumentParser, options: Iterable[Option]) -> None:
    """Add options that may be left out."""
    for o in options:
        parser.add_argument(option_name(o.name), metavar=o.metavar, choices=o.choices, help=o.help)


def read_options(arguments: argparse.Namespace, options: Iterable[Option]) -> dict[str, Any]:
    """Return the value of every option, None where it was left out."""
    found = {}
    for o in options:
        text = getattr(arguments, o.name)
        found[o.name] = None if text is None else o.read(text)
    return found


def add_oil(parser: Any) -> None:
    """Add ``--oil``."""
    parser.add_argument(
        "--oil",
        metavar="OIL",
        help='oil that sets viscosity and density: a name ("ISO VG 46", "Dexron VI", "SAE '
        '75W-90"; with its base, "ISO VG 320 PAO", friction and film of gears too), or '
        '"kinematic_viscosity_40=46 cSt, kinematic_viscosity_100=6.8 cSt, density_15=870"',
    )


def refuse_unused(
    arguments: argparse.Namespace, what: str, options: Iterable[str], **usual: object
) -> None:
    """Raise ParameterError if an option is given for which a command has no use there.

    ``options`` are names in the parsed arguments, ``usual`` those that have a default, with it.
    """
    known: dict[str, Any] = {**dict.fromkeys(options), **usual}
    for name, default in known.items():
        value = getattr(arguments, name, default)
        if value != default and value not in ([], False):
            option = option_name({"settings": "set", "tolerance": "tol"}.get(name, name))
            given = value if name == "file" else option
            raise ParameterError(f"{given}: has no effect with {what}; leave it out")


def option_name(name: str) -> str:
    """Return the option for an argument: oil_temperature is --oil-temperature."""
    return "--" + name.replace("_", "-")
