"""The slave of every Python FMU: the protocol of pythonfmu 0.7.0 around ``Core``.

What shapes it: an exception that leaves a callback makes pythonfmu drop references that it goes on
to use, and the second one on an instance ends the process. Therefore no callback ever raises, not
even for Ctrl-C, but ``do_step``, which gives pythonfmu those references first: to return False is
Discard, at which FMPy ends a run in silence. A failure of another callback is logged as an error,
latched in ``solver_status``, and the next step is refused until it is cured. ``__init__`` may
raise: the instantiation then returns NULL.
"""

import _ctypes
import ctypes
import os
import sys
import traceback
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from ...errors import EnvironmentProblem, ParameterError, SolveError, Status
from ...model.registry import find_spec
from ...native.files import to_stderr
from ..description.interface import LOG_CATEGORIES, interface
from ..model_kernels import content_digest, package_version
from ..running.core import Core, Mode
from ..running.snapshot import Snapshot, from_bytes

_at_exit: set[str] = set()  # libraries that release their pointer when the process ends


class Refused(EnvironmentProblem):
    """Why there is no instance or no step; pythonfmu shows ``repr``: the sentence itself."""

    __repr__ = EnvironmentProblem.__str__


def _safe(callback: Callable[..., Any]) -> Callable[..., Any]:
    """Catch everything; return what the callback returns, or False after a failure."""

    @wraps(callback)
    def guarded(self: "Slave", *args: object) -> Any:
        try:
            return callback(self, *args)
        except BaseException as problem:
            self.report(problem)
            return False

    return guarded


def _setter(kind: str) -> Callable[..., Any]:
    """Return the callback that takes over all values of a kind or none."""

    def set_values(self: "Slave", vrs: list[int], values: list[Any]) -> None:
        self.core.set(vrs, values, kind)
        for text in self.core.zeros():
            self.tell(text, Fmi2Status.warning, "logStatusWarning")

    return _safe(set_values)


def _getter(kind: str, convert: Callable[[float], Any]) -> Callable[..., Any]:
    """Return the callback that reads values of a kind, solving first where needed."""

    def get_values(self: "Slave", vrs: list[int]) -> list[Any]:
        try:
            found = self.core.get(vrs, kind)
        except BaseException as problem:  # reported; then the last good ones
            self.report(problem)
            found = self.core.stored(vrs)
        return [convert(value) for value in found]

    return get_values


class Slave(Fmi2Slave):  # type: ignore[misc]
    """Base class; the module inside an FMU names the model and what it was built with."""

    model = ""
    version = digest = guid = ""
    log_categories = LOG_CATEGORIES
    start_time = 0.0
    _failure = ""  # the newest

    def __init__(self, **kwargs: object) -> None:
        super().__init__(**kwargs)
        # pythonfmu adds the folder to sys.path once per instantiation: one is enough
        if self.resources in sys.path:
            first = sys.path.index(self.resources)
            sys.path[first + 1 :] = [p for p in sys.path[first + 1 :] if p != self.resources]
        spec = find_spec(self.model)
        _settle_library(self.resources, spec.name)
        if type(self).digest != content_digest(spec):
            theirs, ours = type(self).version, package_version()
            cure = "" if theirs == ours else f"pip install thrustwasher=={theirs}, or "
            problem = Refused(
                f"{spec.name}: this FMU was built with thrustwasher {theirs} (content "
                f"{type(self).digest}), this Python has {ours} (content {content_digest(spec)}): "
                f"{cure}build the FMU again"
            )
            # pythonfmu drops messages unless the host has logging on
            to_stderr(str(problem))
            raise problem
        self.core = Core(interface(spec))

    @_safe
    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Keep the start time."""
        self.start_time = float(start_time)

    @_safe
    def enter_initialization_mode(self) -> None:
        """From here on outputs can be read."""
        self.core.begin(self.start_time)

    @_safe
    def exit_initialization_mode(self) -> None:
        """Check the rules between parameters and solve the start point."""
        try:
            self.core.leave_initialization()
        finally:
            self.core.mode = Mode.STEPPING  # the host cannot be told of a failure and will go on
        for text in self.core.advice():
            self.tell(text, Fmi2Status.warning, "logStatusWarning")

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance; raises after a failure, with everything as it was: the host hears Fatal."""
        if self._advance(current_time, step_size):
            return True
        for dropped in (type(self), self, self._get_log_queue()):
            ctypes.pythonapi.Py_IncRef(ctypes.py_object(dropped))
        raise Refused(self._failure)

    @_safe
    def _advance(self, current_time: float, step_size: float) -> bool:
        self.core.advance(current_time, step_size)
        for category, text in self.core.messages():
            is_warning = category == "logStatusWarning"
            self.tell(text, Fmi2Status.warning if is_warning else Fmi2Status.ok, category)
        return True

    @_safe
    def terminate(self) -> None:
        """Values can still be read."""
        self.core.mode = Mode.TERMINATED
        for text in self.core.counts():
            self.tell(text, Fmi2Status.warning, "logStatusWarning")

    set_real, set_boolean = _setter("Real"), _setter("Boolean")
    set_integer = _setter("Integer")  # enumerations are integers here
    set_string = _setter("String")  # refuses: there are no texts

    get_real, get_integer = _getter("Real", float), _getter("Integer", int)
    get_boolean, get_string = _getter("Boolean", bool), _getter("String", lambda _: "")

    def _get_fmu_state(self) -> Snapshot | None:
        try:
            return self.core.snapshot()
        except BaseException as problem:  # out of memory
            self.report(problem)
            return None

    @_safe
    def _set_fmu_state(self, state: Snapshot | str | None) -> None:
        if not isinstance(state, Snapshot):
            raise ParameterError(state or "FMU state = none, allowed: one that was got before")
        self.core.restore(state)

    @staticmethod
    def _fmu_state_to_bytes(state: Snapshot | str | None) -> bytes:
        return state.to_bytes() if isinstance(state, Snapshot) else b""

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> Snapshot | str:
        """Return the state, or the reason why it is none, for ``_set_fmu_state`` to refuse."""
        try:
            return from_bytes(state)
        except BaseException as problem:
            return str(problem)

    def tell(self, text: str, status: object, category: str | None = None) -> None:
        """Queue a message; FMI gives # and % in texts a meaning, so they are not used."""
        text = text.replace("#", "no. ").replace("%", " percent")
        # a file's name may hold what is no UTF-8, and pythonfmu does not survive such a text
        self.log(text.encode("utf-8", "replace").decode("utf-8"), status, category)

    def report(self, problem: BaseException) -> None:
        """Log a failure in one sentence; a defect also with its traceback."""
        self._failure = str(problem) or type(problem).__name__
        self.tell(self._failure, Fmi2Status.error, "logStatusError")
        if not isinstance(problem, ParameterError | SolveError):
            core = getattr(self, "core", None)
            if core is not None:
                core.latch = Status.NOT_FINITE
            story = "".join(traceback.format_exception(problem))
            self.tell(story, Fmi2Status.ok, "logAll")
        elif isinstance(problem, ParameterError):
            self.core.latch = Status.BAD_INPUT


def _settle_library(folder: str | None, model: str) -> None:
    """Release pythonfmu's global pointer before its destructors do so twice.

    They run when the library is unloaded or the process ends, and release the pointer again if it
    is still set: "corrupted double-linked list". In a Python host the pointer has nothing left to
    do and is emptied at once. Any other host needs it to end the interpreter: there the library
    stays loaded and empties it at exit, before its own destructors.
    """
    if sys.platform != "linux" or not folder:
        return
    path = str(Path(folder).parent / "binaries" / "linux64" / f"{model}.so")
    embedded = not sys.orig_argv
    stay = os.RTLD_NODELETE if embedded else 0
    try:
        library = ctypes.CDLL(path, mode=os.RTLD_NOLOAD | os.RTLD_NOW | stay)
    except OSError:
        return  # loaded from another place
    if not embedded:
        library.finalizePythonInterpreter()
    elif path not in _at_exit:
        _at_exit.add(path)
        release = ctypes.cast(library.finalizePythonInterpreter, ctypes.c_void_p)
        ctypes.CDLL(None).__cxa_atexit(release, None, None)
    _ctypes.dlclose(library._handle)
