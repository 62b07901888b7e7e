"""``python -m lab.worst``: how long the longest step of an FMU takes on this machine."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from thrustwasher.cli import main_of
from thrustwasher.cli.common import _options, _output
from thrustwasher.errors import ParameterError
from thrustwasher.model.registry import all_models, find_model
from thrustwasher.units import format_quantity, parse_quantity

STEPS, MINUTES, SEED = 100_000, 1.0, 1  # by default
HELP = "time the steps of the FMUs one by one here: mean, rare and longest, and what bounds them"
OPTIONS = {
    "--fidelity LEVEL": "this fidelity level alone; default all fidelity levels of the models",
    "--alone": "the FMU of that fidelity level alone (washer map): without the solver",
    "--steps N": f"steps of each of three walks, default {STEPS}; 10000000 for a table to keep",
    "--minutes X": f"longest time of a walk, which then has fewer steps, default {MINUTES:g}",
    "--seed N": f"of the first walk, default {SEED}",
}
COLUMNS = {  # of a file: column -> unit
    "model": "",
    "fidelity": "",
    "bound": "",
    "steps": "",
    "failed": "",
    "mean": "s",
    "rare": "s",
    "longest": "s",
    "raw_longest": "s",
    "ratio": "1",
    "memory": "byte",
    "table": "byte",
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; return its exit status."""
    return main_of(sys.modules[__name__], "python -m lab.worst", argv)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(m.key for m in all_models())
    parser.add_argument("models", nargs="*", metavar="MODEL", help=f"{models}; default all")
    _options.add(parser, OPTIONS)
    _output.add_targets(parser, plot="", out="CSV file of the table")
    _options.add_settings(parser, "change a parameter of the one model; may be repeated")
    parser.set_defaults(steps=str(STEPS), minutes=str(MINUTES), seed=str(SEED))


def run(arguments: argparse.Namespace) -> int:
    """Measure level after level and print a line for each."""
    specs = [find_model(name).spec for name in arguments.models or [m.key for m in all_models()]]
    steps = _whole(arguments.steps, "steps")
    how: dict[str, Any] = {
        "steps": steps,
        "seconds": 60.0 * parse_quantity(arguments.minutes, "1", "minutes"),
    }
    how["seed"] = _whole(arguments.seed, "seed")
    if not how["seconds"] > 0.0:
        raise ParameterError(f"--minutes {arguments.minutes}, allowed: more than 0")
    if arguments.settings and len(specs) != 1:
        raise ParameterError("--set: for one model, e.g. python -m lab.worst clutch --set ...")
    chosen = [(spec, level) for spec in specs for level in _levels(spec, arguments.fidelity)]
    if not chosen:
        known = ", ".join(dict.fromkeys(level for spec in specs for level in spec.levels))
        raise ParameterError(
            f"--fidelity {arguments.fidelity}: no such fidelity level, allowed: {known}"
        )
    settings = _options.read_settings(arguments.settings, specs[0]) if arguments.settings else {}
    targets = _output.targets(arguments)
    from lab.realtime.longest_step import measure
    from thrustwasher.fmu.fmu_cache import fmu_paths

    found = []
    with TemporaryDirectory() as folder:
        if arguments.alone:
            of_one = [find_model(spec.key).of_one_level(spec, level) for spec, level in chosen]
            built = [_alone(spec, level, Path(folder)) for spec, level in chosen]
            chosen = [(spec, level) for spec, (_, level) in zip(of_one, chosen, strict=True)]
        else:
            paths = fmu_paths([spec.name for spec in specs], "native")
            built = [paths[spec.name] for spec, _ in chosen]
        for (spec, level), path in zip(chosen, built, strict=True):
            show = _output.time_left(f"{spec.key} {level}")
            found.append(measure(spec, path, level, settings=settings, progress=show, **how))
    records = [_record(one) for one in found]
    targets.write(COLUMNS, {name: [record[name] for record in records] for name in COLUMNS})
    if arguments.json:
        _output.print_json({"steps": records})
        return 0
    for record in records:
        _show(record)
    return 0


def _alone(spec: Any, level: str, folder: Path) -> Path:
    """Build the FMU of one level of a model for this machine."""
    from thrustwasher.fmu.build import build

    (path,) = build([spec.name], out=folder, local=True, fidelity=level, note=_output.note)
    return path


def _levels(spec: Any, asked: str | None) -> list[str]:
    """Return the levels of a model that are requested."""
    return [level for level in spec.levels if asked in (None, level)]


def _whole(text: str, name: str) -> int:
    """Return a whole number from 1 on."""
    if not text.strip().isdecimal() or len(text) > 12 or int(text) < 1:
        raise ParameterError(f"--{name} {text}, allowed: a whole number from 1 on")
    return int(text)


def _record(one: Any) -> dict[str, Any]:
    """Return what was found as JSON has it."""
    from lab.realtime.loop_bounds import bound_of

    return {**_output.scalars(one), "bound": bound_of(one.model, one.fidelity)}


def _show(record: dict[str, Any]) -> None:
    """Print a level: times, the ratio, the bound, the memory, where the longest step was."""

    def time(name: str) -> str:
        return format_quantity(record[name], "s", digits=3)

    more = f", {record['failed']} failed" if record["failed"] else ""
    print(f"{record['model']} {record['fidelity']}: {record['steps']} steps{more}")
    rows = [
        ("mean", time("mean"), ""),
        ("99.999 %", time("rare"), ""),
        ("longest", time("longest"), f"{record['ratio']:.1f} x mean"),
        ("as it came", time("raw_longest"), "with all that came between"),
        ("bound", record["bound"], ""),
    ]
    counted = [(text, most) for text, most in record["work"].items() if most]
    rows += [(text, str(most), "at most in a step") for text, most in counted]
    if record["memory"] is not None:
        size = f"{(record['memory'] - record['table']) / 1024:.1f} kB"
        table = f"and {record['table'] / 1024:.0f} kB of map" if record["table"] else ""
        rows.append(("memory", size, table))
    point = ", ".join(f"{name} = {value:g}" for name, value in record["point"].items())
    rows.append(("longest at", f"{point}, step {record['step']:g} s", ""))
    width = max(len(name) for name, _, _ in rows)
    for name, value, text in rows:
        print(f"  {name:<{width}}  {value}{'  ' + text if text else ''}")


if __name__ == "__main__":
    sys.exit(main())
