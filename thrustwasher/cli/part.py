"""``thrustwasher part``: write a part file, check one, list the presets."""

import argparse
from dataclasses import replace
from pathlib import Path

from ..errors import ParameterError
from ..model.idle import kept_warnings
from ..model.part_file import (
    PartFile,
    checked_name,
    find_part,
    load_part,
    part_text,
    preset_part,
    preset_parts,
    usual_name,
)
from ..model.record import Model
from ..model.registry import all_models, find_model
from .common import _options, _output

HELP = "write a file of your own part (new), check one, list the presets"
EXAMPLES = (
    "thrustwasher part new clutch --name Pack --set faces=6 --out pack.toml",
    "thrustwasher part list washer",
)
AT_REST = ("N", "N.m", "rad/s")  # units of inputs that are 0 where a part is at rest
SHOWN = 20  # parameters that a line lists
NEW = ("name", "preset", "settings", "out")  # of a new part alone
OPTIONS = {
    "--name NAME": "new: name of the part and of its FMU, default MyMODEL",
    "--preset PRESET": "new: preset to start from, `part list` names them",
    "--out FILE.toml": "new: file to write, default MODEL.toml; never over one",
    "--json": "one JSON object instead of words",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(m.key for m in all_models())
    parser.add_argument("deed", choices=["new", "check", "list"], help="what to do")
    parser.add_argument(
        "subject",
        nargs="?",
        metavar="MODEL|FILE",
        help=f"new: the model, {models}; check: the part file; list: the model, default all",
    )
    _options.add(parser, OPTIONS)
    _options.add_settings(parser, "new: change a parameter; may be repeated")
    _options.add_oil(parser)


def run(arguments: argparse.Namespace) -> int:
    """Do what is asked."""
    if arguments.deed != "list" and not arguments.subject:
        required = "a model, e.g. washer" if arguments.deed == "new" else "a part file"
        raise ParameterError(f"part {arguments.deed}: {required} is required")
    unused = {"new": (), "check": NEW, "list": (*NEW, "oil")}[arguments.deed]
    _options.refuse_unused(arguments, f"part {arguments.deed}", unused)
    {"new": _new, "check": _check, "list": _list}[arguments.deed](arguments)
    return 0


def _new(arguments: argparse.Namespace) -> None:
    model = find_model(arguments.subject)
    spec = model.spec
    start = find_part(spec.key) if arguments.preset is None else preset_part(spec, arguments.preset)
    changes = _options.read_settings(arguments.settings, spec, start)
    oil = _options.read_oil(arguments, spec, changes)
    start = start if oil is None else start.with_oil(oil)
    name = checked_name(arguments.name or usual_name(spec))
    box = start.box or _usual_box(model)
    out = _output.new_part(arguments.out or f"{spec.key}.toml")
    text = part_text(replace(start, name=name, parameters=start.parameters | changes, box=box))
    _output.write_text(out, text)
    _show(arguments, out, load_part(out), f"wrote {out}")


def _usual_box(model: Model) -> dict[str, tuple[float, float]]:
    """Return the box of the default parameters' verification tables, empty without any.

    Loads and speeds begin at rest; those of either sign are meant by their size.
    """
    boxes = model.ladder.boxes.get("default", {}) if model.ladder else {}
    signals = {s.name: s for s in model.spec.inputs}
    found = {}
    for name, (low, high, _) in boxes.items():
        moves, either = signals[name].unit in AT_REST, (signals[name].low or 0.0) < 0.0
        found[name] = ((-high if either else 0.0) if moves else low), high
    return found


def _check(arguments: argparse.Namespace) -> None:
    path = Path(arguments.subject)
    part = load_part(path)
    oil = _options.read_oil(arguments, part.spec, ())
    part = part if oil is None else part.with_oil(oil)
    _show(arguments, path, part, f"{path}: allowed")


def _show(arguments: argparse.Namespace, path: Path, part: PartFile, words: str) -> None:
    """Say what a part file holds; first what of it no longer fits the rest."""
    scatter = part.scattered()
    warnings = [*kept_warnings(part), *_options.part_warnings(part), *scatter.warnings]
    _output.warn(warnings)
    if arguments.json:
        _output.print_json(
            {
                "file": str(path),
                "model": part.spec.key,
                "name": part.name,
                "box": part.box,
                "fidelity": part.fidelity,
                "parameters": _output.parameters_of(part.params),
                "scatter": {
                    s.place.name: {"law": s.law.words(), "source": s.reason}
                    for s in scatter.sources
                },
                "warnings": warnings,
                "oil": part.oil and part.oil.as_dict(part.spec),
            }
        )
        return
    if not warnings:
        words = words.replace(": allowed", ": sound")
    plain, own = part.spec.params(), part.params
    changed = [n for n in part.parameters if getattr(plain, n) != getattr(own, n)]
    given = (
        f"{len(changed)} parameters not at their defaults: " if changed else "all at the defaults"
    )
    named = ", ".join(map(part.own_name, changed[:SHOWN])) + (", .." if changed[SHOWN:] else "")
    print(f"{words}: {part.name}, {part.spec.name}, {given}{named}")
    if part.oil:
        print(part.oil_words)
    for s in scatter.sources:
        print(f"scatter of {s.place.name}: {s.law.words()}; {s.reason or 'given'}")


def _list(arguments: argparse.Namespace) -> None:
    models = [find_model(arguments.subject)] if arguments.subject else all_models()
    found = {m.key: preset_parts(m.spec) for m in models}
    words = {k: {n: p.description for n, p in own.items()} for k, own in found.items()}
    if arguments.json:
        _output.print_json(words)
        return
    for key, own in words.items():
        for name, text in own.items():
            print(f"{key:10} {name:10} {text}")
