"""The command line: one file per command; a new command is that file and its line below.

A command module has ``HELP`` (one sentence), ``add_arguments(parser)`` and ``run(arguments)``,
which returns the exit status. Heavy imports happen inside ``run``: ``--help`` answers at once.
"""

from __future__ import annotations

import argparse
import errno
import gc
import os
import re
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import Any, NoReturn

from ..errors import EnvironmentProblem, ParameterError, SolveError
from ._signals import Watch

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
DONE, DEFECT, WRONG_INPUT, NO_SOLUTION, PIPE_CLOSED = 0, 1, 2, 3, 141
LONGEST = 2000  # characters of a message
RARELY = 100_000  # new objects between two searches for garbage: imports and plots leave hardly any
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
    watch = Watch()
    try:
        if argv is None:  # a program of its own, no function in somebody's process
            watch.begin()
            gc.set_threshold(RARELY)
        status = _dispatch(words)
        watch.close()
        sys.stdout.flush()
        return status
    except BaseException as error:
        watch.close()
        if watch.number or isinstance(error, KeyboardInterrupt):
            return _say(label, watch.word, watch.status)
        return _status_of(error, label)


def _status_of(error: BaseException, label: str) -> int:
    """Say what went wrong in one line and return the exit status."""
    if isinstance(error, SystemExit):  # argparse after --help and --version
        return error.code if isinstance(error.code, int) else DONE
    if isinstance(error, BrokenPipeError):  # the reader, e.g. `head`, has gone: that is its right
        _silence_stdout()
        return PIPE_CLOSED
    if isinstance(error, ParameterError | EnvironmentProblem):  # first: BranchError is both
        return _say(label, str(error), WRONG_INPUT)
    if isinstance(error, SolveError):
        return _say(label, str(error), NO_SOLUTION)
    if isinstance(error, OSError):
        full = error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
        where = error.filename or (_nameless_file() if full else "")
        where = f"{where}: " if where else ""
        return _say(label, f"{where}{error.strerror or error}", WRONG_INPUT)
    if isinstance(error, MemoryError):
        return _say(label, "out of memory; ask for fewer points or a coarser grid", WRONG_INPUT)
    if os.environ.get("THRUSTWASHER_TRACEBACK"):
        raise error
    text = f"defect in thrustwasher: {type(error).__name__}: {error}"
    return _say(label, f"{text} (THRUSTWASHER_TRACEBACK=1 shows where)", DEFECT)


def _nameless_file() -> str:
    """Say what could not be written where the error does not."""
    try:
        sys.stdout.flush()
    except OSError:
        return "standard output"
    return "a temporary file or the cache of compiled kernels (NUMBA_CACHE_DIR)"


class _Parser(argparse.ArgumentParser):
    """A parser whose complaints are one line."""

    def error(self, message: str) -> NoReturn:
        """Raise instead of printing the usage and leaving."""
        raise ParameterError(f"{message} (see {self.prog} --help)")

    def _print_message(self, message: str, file: Any = None) -> None:
        """Write help and version, and raise where that fails, which argparse would not."""
        if message:
            (file or sys.stdout).write(message)
            (file or sys.stdout).flush()


def _dispatch(words: list[str]) -> int:
    """Parse the words and run the command they name."""
    if words and not words[0].startswith("-"):
        if words[0] not in COMMANDS:
            raise ParameterError(
                f"command = {words[0]!r}, allowed in this version: {', '.join(COMMANDS)}"
            )
        command = _command(words[0])
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


def _command(name: str) -> Any:
    """Return the command of that name: a module, or made from the record of a model."""
    models = import_module("._models", __name__).MODELS
    if name in models:
        return import_module("._solve", __name__).PointCommand(models[name])
    return import_module(f".{name}", __name__)


def _overview() -> _Parser:
    """Return the parser of the bare program, whose help lists the commands."""
    lines = [f"  {name:9} {_command(name).HELP}" for name in COMMANDS]
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
    from importlib.metadata import PackageNotFoundError, version

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
    if len(line) > LONGEST:
        line = f"{line[: LONGEST // 2]} ... {line[-LONGEST // 2 :]}"
    print(f"{label}: {line}", file=sys.stderr)
    return status


def _silence_stdout() -> None:
    """Point standard output to nowhere, so that the interpreter's last flush is quiet."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError):
        pass  # a test's stand-in for standard output has no file number
