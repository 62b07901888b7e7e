"""The command line: one file per command; a new command is that file and its line below.

A command module has ``HELP`` (one sentence), ``add_arguments(parser)`` and ``run(arguments)``,
which returns the exit status. Heavy imports happen inside ``run``: ``--help`` answers at once.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from typing import NoReturn

from ..errors import EnvironmentProblem, ParameterError, SolveError

COMMANDS = (
    "washer",
    "curve",
    "map",
    "clutch",
    "engage",
    "calibrate",
    "gearmesh",
    "shift",
    "sweep",
    "chart",
    "build",
    "cards",
    "doctor",
)
DONE, DEFECT, WRONG_INPUT, NO_SOLUTION, INTERRUPTED, PIPE_CLOSED = 0, 1, 2, 3, 130, 141
EPILOG = (
    "Numbers are SI (kelvin, radian, pascal); with a unit they may be anything sensible: "
    '"24 degC", "3000 rpm", "1 MPa", "0.1 deg". '
    "Exit status: 0 done, 2 the input is wrong, 3 no solution was found."
)


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status; never raises, never shows a traceback."""
    words = list(sys.argv[1:] if argv is None else argv)
    label = f"thrustwasher {words[0]}" if words and words[0] in COMMANDS else "thrustwasher"
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="replace")  # a terminal that knows no µ still gets numbers
    try:
        status = _dispatch(words)
        sys.stdout.flush()
        return status
    except SystemExit as stop:  # argparse after --help and --version
        return stop.code if isinstance(stop.code, int) else DONE
    except BrokenPipeError:  # the reader, e.g. `head`, has gone: that is its right
        _silence_stdout()
        return PIPE_CLOSED
    except KeyboardInterrupt:
        return _say(label, "stopped", INTERRUPTED)
    except (ParameterError, EnvironmentProblem) as error:  # first: BranchError is a SolveError too
        return _say(label, str(error), WRONG_INPUT)
    except SolveError as error:
        return _say(label, str(error), NO_SOLUTION)
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        return _say(label, f"{where}{error.strerror or error}", WRONG_INPUT)
    except Exception as error:
        if os.environ.get("THRUSTWASHER_TRACEBACK"):
            raise
        text = f"defect in thrustwasher: {type(error).__name__}: {error}"
        return _say(label, f"{text} (THRUSTWASHER_TRACEBACK=1 shows where)", DEFECT)


class _Parser(argparse.ArgumentParser):
    """A parser whose complaints are one line."""

    def error(self, message: str) -> NoReturn:
        """Raise instead of printing the usage and leaving."""
        raise ParameterError(f"{message} (see {self.prog} --help)")


def _dispatch(words: list[str]) -> int:
    """Parse the words and run the command they name."""
    if words and not words[0].startswith("-"):
        if words[0] not in COMMANDS:
            raise ParameterError(
                f"command = {words[0]!r}, allowed in this version: {', '.join(COMMANDS)}"
            )
        command = import_module(f".{words[0]}", __name__)
        parser = _Parser(
            prog=f"thrustwasher {words[0]}",
            description=command.HELP,
            epilog=EPILOG,
            allow_abbrev=False,
        )
        command.add_arguments(parser)
        return int(command.run(parser.parse_args(_join_negative_numbers(words[1:]))))
    parser = _overview()
    parser.parse_args(words)
    parser.print_help()
    return DONE


def _overview() -> _Parser:
    """Return the parser of the bare program, whose help lists the commands."""
    lines = [f"  {name:9} {import_module(f'.{name}', __name__).HELP}" for name in COMMANDS]
    parser = _Parser(
        prog="thrustwasher",
        usage="thrustwasher COMMAND [OPTION ...]",
        description="Friction units for drivetrain simulation.\n\ncommands:\n" + "\n".join(lines),
        epilog="thrustwasher COMMAND --help says more.\n" + EPILOG.replace(". ", ".\n"),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"thrustwasher {_version()}")
    return parser


def _version() -> str:
    """Return the installed version, or say that this is a bare checkout."""
    try:
        return version("thrustwasher")
    except PackageNotFoundError:
        return "(not installed)"


def _join_negative_numbers(words: list[str]) -> list[str]:
    """Return the words with ``--speed -300rpm`` as ``--speed=-300rpm``, which argparse takes."""
    joined: list[str] = []
    for word in words:
        after_option = joined and re.fullmatch(r"--[a-z][a-z-]*", joined[-1])
        if after_option and re.match(r"-[0-9.]", word):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def _say(label: str, message: str, status: int) -> int:
    """Write one line to standard error and return the exit status."""
    line = " ".join(message.split())
    print(f"{label}: {line}", file=sys.stderr)
    return status


def _silence_stdout() -> None:
    """Point standard output to nowhere, so that the interpreter's last flush is quiet."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError):
        pass  # a test's stand-in for standard output has no file number
