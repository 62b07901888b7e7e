"""``thrustwasher build``: make the FMUs."""

import argparse

from ..errors import EnvironmentProblem, ParameterError
from ..model.registry import all_models
from . import _output

HELP = f"build FMUs for co-simulation: {', '.join(model.name for model in all_models())}"
TARGETS = ("native", "python")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "models", nargs="*", metavar="MODEL",
        help="names of FMUs; default: all above. CommandSource, a ramp for a shift command, "
        "is built when named",
    )  # fmt: skip
    parser.add_argument(
        "--target", choices=TARGETS,
        help="native: compiled, needs nothing where it runs (default, if there is a compiler "
        "here); python: needs this package on the machine that runs it",
    )  # fmt: skip
    parser.add_argument(
        "--fmi", type=int, choices=[2, 3], default=2,
        help="FMI version; default 2; 3 for target native only",
    )  # fmt: skip
    parser.add_argument(
        "--platforms", metavar="LIST",
        help="native only: names with commas (linux64, win64, aarch64-linux, darwin-x86_64, "
        "darwin-arm64), all, or local; default: all that the compiler found here can link",
    )  # fmt: skip
    parser.add_argument(
        "--out", metavar="DIR", default="dist",
        help="the FMUs go to DIR/<target>-fmi<N>/<MODEL>.fmu; default dist",
    )  # fmt: skip
    parser.add_argument(
        "--no-maps", action="store_true",
        help="native only: leave out what the washer's fidelity map looks up (2.5 MB); it is "
        "refused then",
    )  # fmt: skip
    parser.add_argument("--json", action="store_true", help="one JSON object with the paths")


def run(arguments: argparse.Namespace) -> int:
    """Build, then name the files."""
    folder = _output.check_folder(arguments.out, "--out")

    from ..fmu.build import build, validate
    from ..model.registry import find_spec

    for model in arguments.models:
        find_spec(model)
    target = chosen_target(arguments.target, arguments.fmi)
    platforms = chosen_platforms(arguments.platforms, target)
    paths = build(
        arguments.models or None, target=target, fmi=arguments.fmi, out=folder,
        platforms=platforms, note=_output.note, maps=not arguments.no_maps,
    )  # fmt: skip
    findings = [f"{path}: {finding}" for path in paths for finding in validate(path)]
    if arguments.json:
        _output.print_json({"fmus": [str(path) for path in paths], "findings": findings})
    else:
        for path in paths:
            print(path)
    for finding in findings:
        _output.note(finding)
    return 3 if findings else 0


def chosen_target(target: str | None, fmi: int = 2) -> str:
    """Return the target asked for, else native, else what needs no compiler."""
    if target:
        return target
    from ..native.link import find_linker

    try:
        find_linker()
    except EnvironmentProblem as problem:
        if fmi != 2:
            raise
        _output.note(f"{problem}; going on with Python FMUs")
        return "python"
    return "native"


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
