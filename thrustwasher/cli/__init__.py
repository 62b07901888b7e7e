# PYTHON_ARGCOMPLETE_OK
"""The command line: one file per command; a new command is that file and its name below.

Commands that the models, their FMUs and shifts do not need lie elsewhere, as ``plugins`` says.

A command module has ``HELP`` (a line), ``EXAMPLES`` (two command lines that run),
``add_arguments(parser)`` and ``run(arguments)``, which returns the exit status. Heavy imports
happen inside ``run``: ``--help`` answers at once. A command that solves a model at one point is no
file: ``common`` makes it from the record, and has what commands share.
"""

import argparse
import errno
import gc
import os
import re
import shlex
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Sequence
from importlib import import_module
from textwrap import wrap
from types import FrameType, ModuleType
from typing import Any, NoReturn

from .. import __version__, plugins
from ..errors import EnvironmentProblem, ParameterError, SolveError, suggestion
from ..model.registry import models_with_points
from . import _completion
from ._streams import named_streams

MODELS = models_with_points()
OF_MODELS = tuple(name for model in MODELS.values() for name in model.commands())
GROUPS = {
    "solve": tuple(name for name in OF_MODELS if name != "map"),
    "build and run": ("build", "shift", "efficiency", "explore", "doctor"),
    "study": ("sweep", "scatter", "optimise", "calibrate", "compare"),
    "files": ("part", "map", "fidelity"),
}
COMMANDS = tuple(name for group in GROUPS.values() for name in group)
DONE, DEFECT, WRONG_INPUT, NO_SOLUTION, PIPE_CLOSED = 0, 1, 2, 3, 141
LONGEST = 2000  # characters of a message
LIKE = 0.75  # of two names from which on one is taken for the other
WIDTH = 79  # of what stands below the examples
SIGNALS: dict[int, str] = {signal.SIGINT: "stopped", signal.SIGTERM: "terminated"}
if hasattr(signal, "SIGHUP"):  # not on Windows
    SIGNALS[signal.SIGHUP] = "the terminal has closed"
PLAIN = "THRUSTWASHER_KERNELS"  # "python": kernels are not compiled
GRACE = 1.0  # s in which another signal to stop does not count
RARELY = 100_000  # new objects between two searches for garbage: imports and plots leave hardly any
EPILOG = (
    "Numbers are SI (kelvin, radian, pascal); with a unit they may be anything sensible: "
    '"24 degC", "3000 rpm", "1 MPa", "0.1 deg". '
    "Exit status: 0 done, 2 the input is wrong, 3 no solution was found."
)


GONE = {  # commands that were: what to call now
    "cards": "thrustwasher fidelity",
    "chart": "python -m lab.chart, in a checkout",
    "worst": "python -m lab.worst, in a checkout",
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status; never raises, never shows a traceback."""
    if argv is None:
        _completion.complete(
            _Parser,
            dict.fromkeys(COMMANDS, ""),
            lambda name, parser: _command(name).add_arguments(parser),
        )
    words = list(sys.argv[1:] if argv is None else argv)
    label = f"thrustwasher {words[0]}" if words and words[0] in COMMANDS else "thrustwasher"
    with named_streams(is_program=argv is None):
        return _ended(lambda: _dispatch(words), label, is_program=argv is None)


def main_of(command: ModuleType, label: str, argv: Sequence[str] | None = None) -> int:
    """Run a command that is a program of its own, as ``main`` does; return its exit status."""
    words = list(sys.argv[1:] if argv is None else argv)
    with named_streams(is_program=argv is None):
        return _ended(lambda: _run(command, label, words), label, is_program=argv is None)


def _ended(run: Callable[[], int], label: str, *, is_program: bool) -> int:
    """Run a command to its end, whatever that is."""
    watch = Watch()
    try:
        if is_program:  # no function in somebody's process
            watch.begin()
            _tell_plain_python()
            gc.set_threshold(RARELY)
            warnings.showwarning = _show_warning  # type: ignore[assignment]
        status = run()
        watch.close()
        sys.stdout.flush()
        return status
    except BaseException as error:
        watch.close()
        if watch.number or isinstance(error, KeyboardInterrupt):
            return _say(label, watch.word, watch.status)
        return _status_of(error, label)


def _tell_plain_python() -> None:
    """Say that the environment keeps kernels from running as machine code."""
    given = {name: os.environ.get(name, "") for name in ("NUMBA_DISABLE_JIT", PLAIN)}
    if given["NUMBA_DISABLE_JIT"] in ("", "0") and given[PLAIN] != "python":
        return
    name = PLAIN if given[PLAIN] == "python" else "NUMBA_DISABLE_JIT"
    print(
        f"note: {name} = {given[name]}: kernels run as plain Python, some hundred times slower; "
        "unset it unless you debug them",
        file=sys.stderr,
    )


def _show_warning(
    message: Warning | str, category: type[Warning], filename: str, lineno: int, *_: Any
) -> None:
    """Write what the author of a file is to know in one line, without the line of source."""
    shown = warnings.formatwarning(message, category, filename, lineno)
    print(f"warning: {message}" if category is FutureWarning else shown, file=sys.stderr)


def _status_of(error: BaseException, label: str) -> int:
    """Say what went wrong in one line and return the exit status."""
    if isinstance(error, SystemExit):  # argparse after --help and --version
        return error.code if isinstance(error.code, int) else DONE
    if isinstance(error, BrokenPipeError):  # the reader, e.g. `head`, has gone: that is its right
        return PIPE_CLOSED
    if isinstance(error, ParameterError | EnvironmentProblem):  # first: BranchError is both
        return _say(label, str(error), WRONG_INPUT)
    if isinstance(error, SolveError):
        return _say(label, str(error), NO_SOLUTION)
    if isinstance(error, OSError):
        where = error.filename or _nameless(error)
        where = f"{where}: " if where else ""
        return _say(label, f"{where}{error.strerror or error}", WRONG_INPUT)
    if isinstance(error, MemoryError):
        return _say(label, "out of memory; ask for fewer points or a coarser grid", WRONG_INPUT)
    if os.environ.get("THRUSTWASHER_TRACEBACK"):
        raise error
    text = f"defect in thrustwasher: {type(error).__name__}: {error}"
    return _say(label, f"{text} (THRUSTWASHER_TRACEBACK=1 shows where)", DEFECT)


def _nameless(error: OSError) -> str:
    """Say what an error is about that has no name of a file."""
    if error.errno == errno.ENOENT:
        try:
            os.getcwd()
        except OSError:
            return "the working directory is gone; go to another one"
    if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
        return "a temporary file or the cache of compiled kernels (NUMBA_CACHE_DIR)"
    return ""


class _Parser(argparse.ArgumentParser):
    """A parser whose complaints are one line, and that takes -300rpm as the value it is."""

    def __init__(self, prog: str, **options: Any) -> None:
        super().__init__(prog, allow_abbrev=False, **options)
        self.meant: Callable[[str, str], str] = lambda _name, spelled: spelled
        self._negative_number_matcher = re.compile(r"-[0-9.]")

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse; an option that takes one value is given once."""
        seen: set[int] = set()
        for word in args or ():
            action = self._option_string_actions.get(word.partition("=")[0])
            if action is None or action.nargs == 0 or isinstance(action.default, list):
                continue
            if id(action) in seen:
                self.error(f"argument {'/'.join(action.option_strings)}: is given twice")
            seen.add(id(action))
        return super().parse_args(args, namespace)

    def error(self, message: str) -> NoReturn:
        """Raise instead of printing the usage and leaving; name what was probably meant."""
        wrong = re.search(r"unrecognized arguments: (--[\w-]+)|invalid choice: '([^']*)'", message)
        hint, file = "", re.search(r"unrecognized arguments: (\S+\.toml)", message)
        if file and "--part" in self._option_string_actions:
            hint = f"; did you mean --part {file[1]}?"
        elif wrong and wrong[2]:
            known = re.findall(r"'([^']*)'", message)[1:]
            hint = suggestion(wrong[2], known, "; did you mean {}?")
        elif wrong:
            bare = [o[2:] for o in self._option_string_actions if o.startswith("--")]
            hint = suggestion(wrong[1][2:], bare, "; did you mean --{}?", likeness=LIKE)
            hint = self.meant(wrong[1][2:].replace("-", "_"), hint)
        raise ParameterError(f"{message}{hint} (see {self.prog} --help)")

    def _print_message(self, message: str, file: Any = None) -> None:
        """Write help and version, and raise where that fails, which argparse would not."""
        if message:
            (file or sys.stdout).write(message)
            (file or sys.stdout).flush()


def _dispatch(words: list[str]) -> int:
    """Parse the words and run the command they name."""
    if words and not words[0].startswith("-"):
        if words[0] in GONE:
            raise ParameterError(f"the command {words[0]} is now {GONE[words[0]]}")
        if words[0] not in COMMANDS:
            hint = suggestion(words[0], COMMANDS, "; did you mean {}?")
            raise ParameterError(
                f"command = {words[0]!r}, allowed in this version: {', '.join(COMMANDS)}{hint}"
            )
        return _run(_command(words[0]), f"thrustwasher {words[0]}", words[1:])
    lines = [
        line
        for group, names in GROUPS.items()
        for line in (f"\n{group}:", *(f"  {name:10} {_help(name)}" for name in names))
    ]
    parser = _Parser(
        prog="thrustwasher",
        usage="thrustwasher COMMAND [OPTION ...]",
        description="Friction units for drivetrain simulation.\n" + "\n".join(lines),
        epilog="thrustwasher COMMAND --help says more.\n" + EPILOG.replace(". ", ".\n"),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"thrustwasher {__version__}")
    parser.parse_args(words)
    parser.print_help()
    return DONE


def _run(command: Any, label: str, words: list[str]) -> int:
    """Parse the words behind a command and run it."""
    parser = _parser(command, label)
    arguments = parser.parse_args(words)
    arguments.command_line = shlex.join([*label.split(), *words])
    return int(command.run(arguments))


def _parser(command: Any, label: str) -> _Parser:
    """Return the parser of a command; its help ends with examples."""
    examples = [f"  {line}" for line in getattr(command, "EXAMPLES", ())]
    parser = _Parser(
        label,
        description=command.HELP,
        epilog="\n".join(
            [*(["examples:", *examples, ""] if examples else []), *wrap(EPILOG, WIDTH)]
        ),
        formatter_class=_Help,
    )
    command.add_arguments(parser)
    parser.meant = getattr(command, "meant", parser.meant)
    return parser


class _Help(argparse.RawDescriptionHelpFormatter):
    """Help whose description is folded to the screen, and whose examples are left as they are."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        if "\n" in text:
            return super()._fill_text(text, width, indent)
        return "\n".join(wrap(text, width))


def _command(name: str) -> Any:
    """Return the command of that name: a module, or made from the record of a model."""
    if name in MODELS:
        return import_module(".common._solve", __name__).PointCommand(MODELS[name])
    if name in plugins.COMMANDS:
        return plugins.command(name)
    return import_module(f".{name}", __name__)


def _help(name: str) -> str:
    """Return what a command does, in a line."""
    try:
        return str(_command(name).HELP)
    except EnvironmentProblem as problem:
        return f"({problem})"


def _say(label: str, message: str, status: int) -> int:
    """Write one line to standard error and return the exit status."""
    line = " ".join(message.split())
    if len(line) > LONGEST:
        line = f"{line[: LONGEST // 2]} ... {line[-LONGEST // 2 :]}"
    print(f"{label}: {line}", file=sys.stderr)
    return status


class Stopped(KeyboardInterrupt):
    """The user or the system wants the command to end."""


class Watch:
    """Which signal asked this process to end, if any: Ctrl-C, SIGTERM, or the terminal's end.

    Only the first one counts while things are tidied up; one that comes a second later stops
    whatever still runs. A stop that arrives as another failure, because some library in between
    takes every exception for its own, is still a stop.
    """

    def __init__(self) -> None:
        self.number = 0
        self._last = float("-inf")

    def begin(self) -> None:
        """Take the signals over; what a parent has switched off stays off."""
        if threading.current_thread() is not threading.main_thread():
            return
        for number in SIGNALS:
            if signal.getsignal(number) in (signal.default_int_handler, signal.SIG_DFL):
                signal.signal(number, self._stop)

    def _stop(self, number: int, _frame: FrameType | None) -> None:
        now = time.monotonic()
        if now - self._last < GRACE:
            return
        self.number, self._last = number, now
        raise Stopped

    def close(self) -> None:
        """Let nothing disturb the last line and the interpreter's end."""
        for number in SIGNALS:
            if signal.getsignal(number) == self._stop:
                signal.signal(number, signal.SIG_IGN)

    @property
    def status(self) -> int:
        """The exit status that shells know."""
        return 128 + (self.number or signal.SIGINT)

    @property
    def word(self) -> str:
        """The message."""
        return SIGNALS.get(self.number, "stopped")
