"""``thrustwasher build``: make the FMUs."""

import argparse
from typing import Any

from ..errors import ParameterError
from ..model.oil import sheet_oil
from ..model.part_file import PartFile, is_part, load_part
from ..model.registry import all_specs, find_spec
from ..model.spec import ModelSpec
from ..units import parse_quantity
from .common import _options, _output

TOL = "0.01"  # by default
HELP = "build FMUs for co-simulation, of all models or of your own part"
EXAMPLES = (
    "thrustwasher build ThrustWasher WetClutch --platforms local --out dist",
    "thrustwasher part new clutch --name Pack --out pack.toml && thrustwasher build "
    "pack.toml --platforms local",
)
OPTIONS = {
    "--platforms LIST": "native only: names with commas (linux64, win64, aarch64-linux, "
    "darwin-x86_64, darwin-arm64), all, or local; default: all (of what was edited: those that "
    "can be linked here)",
    "--out DIR": "the FMUs go to DIR/<target>-fmi<N>/<MODEL>.fmu; default dist",
    "--no-maps": "native only: leave out what the washer's fidelity map looks up (2.5 MB); it is "
    "refused then",
    "--fidelity LEVEL": "native only: an FMU of this fidelity alone; map: the washer without its "
    "solver, in a tenth of the memory",
    "--tol X": "relative error of the torque allowed in the map of a part file's washer, which is "
    "built and kept if there is none; default 0.01",
    "--terminals": "put the plugs into FMI 2.0 FMUs too, where some tools call them an error",
    "--plain": "for hosts that know real and whole numbers only: enumerations and Booleans are "
    "local variables, not outputs, and integers, also as parameters",
    "--sources": "native only: put in C sources too, the same FMU for any C99 compiler, as "
    "real-time hosts want it",
    "--json": "one JSON object with the paths",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "models",
        metavar="MODEL|FILE.toml",
        nargs="*",
        help="names of FMUs, or part files (mine.toml: an FMU with the part's name and values); "
        "default: all above. CommandSource, a ramp for a shift command, is built when named",
    )
    parser.add_argument(
        "--target",
        choices=["native", "python"],
        default="native",
        help="native: compiled, needs nothing where it runs (default); python: needs this package "
        "on the machine that runs it",
    )
    parser.add_argument(
        "--fmi",
        choices=[2, 3],
        default=2,
        type=int,
        help="FMI version; default 2; 3 for target native only",
    )
    _options.add(parser, OPTIONS)
    former = argparse.SUPPRESS  # its name up to 0.23
    parser.add_argument("--plain-outputs", dest="plain", action="store_true", help=former)
    parser.set_defaults(out="dist", tol=TOL)
    _options.add_oil(parser)


def run(arguments: argparse.Namespace) -> int:
    """Build, then name the files."""
    folder = _output.check_folder(arguments.out, "--out")

    from ..fmu.build import build, validate
    from ..ladder.own_tables import build_missing

    tolerance = parse_quantity(arguments.tol, "1", "tol")
    oil = None if arguments.oil is None else sheet_oil("--oil", arguments.oil)
    if not any(map(is_part, arguments.models)):
        _options.refuse_unused(arguments, "models without a part file", (), tol=TOL)
    parts = [load_part(name) for name in filter(is_part, arguments.models)]
    parts = parts if oil is None else [part.with_oil(oil) for part in parts]
    warnings = [text for part in parts for text in _options.part_warnings(part)]
    _output.warn(warnings)
    if arguments.target == "native" and not arguments.no_maps:
        for part in parts:
            if problem := build_missing(part, tolerance, _output.time_left):
                _output.note(problem)
    paths = build(
        arguments.models or None,
        target=arguments.target,
        fmi=arguments.fmi,
        out=folder,
        platforms=chosen_platforms(arguments.platforms, arguments.target),
        note=_output.note,
        maps=not arguments.no_maps,
        terminals=arguments.terminals,
        oil=arguments.oil,
        c_sources=arguments.sources,
        plain=arguments.plain,
        fidelity=arguments.fidelity,
    )
    specs = [spec for spec in _specs(arguments.models, parts) if oil and oil.parameters_for(spec)]
    if oil:
        _output.note(oil.words(*specs))
    else:
        for part in parts:
            _options.tell_oil(part)
    findings = [f"{path}: {finding}" for path in paths for finding in validate(path)]
    if arguments.json:
        found: dict[str, Any] = {"fmus": [str(path) for path in paths], "findings": findings}
        found |= {"oil": oil.as_dict(*specs)} if oil else {}
        _output.print_json({**found, "warnings": warnings})
    else:
        for path in paths:
            print(path)
    for finding in findings:
        _output.note(finding)
    return 3 if findings else 0


def _specs(names: list[str], parts: list[PartFile]) -> list[ModelSpec]:
    """Return the models that are built, each once."""
    specs = [find_spec(name) for name in names if not is_part(name)] if names else all_specs()
    return list({s.key: s for s in [*specs, *(part.spec for part in parts)]}.values())


def chosen_platforms(words: str | None, target: str) -> list[str] | None:
    """Return the platforms that ``--platforms`` names; None: all that can be linked here."""
    if words is None:
        return None
    if target != "native":
        raise ParameterError(f"--platforms {words}: for target native only")
    from ..native.link import this_platform
    from ..native.targets import PLATFORMS

    named = [word.strip() for word in words.split(",")]
    if named == ["all"]:
        return list(PLATFORMS)
    found = [this_platform().name if name == "local" else name for name in named]
    strange = [name for name in found if name not in PLATFORMS]
    if strange:
        options = ", ".join(PLATFORMS)
        raise ParameterError(f"--platforms {words}: {strange[0]!r}, allowed: {options}, all, local")
    return found
